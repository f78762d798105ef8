// Colours of the page as the reader prefers them, light or dark.

const dark = matchMedia('(prefers-color-scheme: dark)');

// Calls `draw` whenever the reader's preference changes.
export function onThemeChange(draw) {
  dark.addEventListener('change', draw);
}

// The value of a colour of the page's style, such as 'ink', 'line' or 'soft'.
export function themeColour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

// The looks of apps/report/plot.h, by Okabe and Ito, with light grey for black in the dark.
const kLooks = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#000000', '#b8a800'];
const kLooksInTheDark = ['#4aa3df', '#f0803c', '#2bc79a', '#dd95bd', '#f0b429', '#8ccdf2', '#e8e8e8', '#f0e442'];

export function lookColour(look) {
  const looks = dark.matches ? kLooksInTheDark : kLooks;
  return looks[look % looks.length];
}
