// Names and colours of a plot's series, and the colour scale of its cells.
import {cssColour, scaleOf} from './colour_scale.js';
import {element} from './element.js';
import {labelAndUnit, numberText} from './number_text.js';
import {colourIndex} from './plot_series.js';
import {lookColour, onThemeChange} from './theme.js';

export function plotLegend(data) {
  const out = element('div', {class: 'legend'});
  data.series.forEach((s, i) => {
    if (!s.name) return;
    const mark = element('span', {class: `mark mark-${s.style}`});
    const paint = () => mark.style.setProperty('color', lookColour(colourIndex(s, i)));
    paint();
    onThemeChange(paint);
    out.append(element('span', {class: 'entry'}, mark, s.name));
  });
  if (data.series.some(s => s.style === 'cells')) out.append(scaleBar(data.colours));
  return out;
}

export function scaleBar(colours) {
  const scale = scaleOf(colours);
  const stops = Array.from({length: 9}, (_, i) => {
    const share = scale.from + (1 - scale.from) * i / 8;
    return cssColour(scale.colour(share));
  });
  const bar = element('span', {class: 'scale-bar'});
  bar.style.background = `linear-gradient(to right, ${stops.join(',')})`;
  const [name, unit] = labelAndUnit(colours.label);
  const low = numberText(scale.low, 3), high = numberText(scale.high, 3);
  return element('span', {class: 'entry'}, `${name}${unit ? ` [${unit}]` : ''}: `,
                 element('span', {class: 'scale'}, low, bar, high));
}
