// A new element with these properties and children; `class` and names with a dash are attributes.
export function element(name, properties = {}, ...children) {
  const out = document.createElement(name);
  for (const [key, value] of Object.entries(properties)) {
    if (key === 'class' || key.includes('-') || key === 'role') {
      out.setAttribute(key, value);
    } else {
      out[key] = value;
    }
  }
  out.append(...children);
  return out;
}
