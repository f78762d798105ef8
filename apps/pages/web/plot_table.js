// The values of a plot as a table, made when it is opened.
import {element} from './element.js';
import {numberText} from './number_text.js';

export function plotTable(data) {
  const count = data.series.reduce((n, s) => n + s.x.length, 0);
  const details = element('details', {class: 'values'}, element('summary', {}, `${count} values`));
  details.addEventListener('toggle', () => {
    if (details.childElementCount > 1) return;
    const header = ['series', data.x.label, data.y.label, 'std'];
    const hasValue = data.series.some(s => s.value);
    if (hasValue) header.push(data.colours.label);
    const rows = data.series.flatMap(s => s.x.map((x, i) => {
      const cells = [s.name || '–', numberText(x, 6), numberText(s.y[i], 6), numberText(s.std?.[i] ?? null, 3)];
      if (hasValue) cells.push(numberText(s.value?.[i] ?? null, 6));
      return element('tr', {}, ...cells.map(c => element('td', {}, c)));
    }));
    details.append(element('div', {class: 'scroll', tabIndex: 0}, element('table', {},
      element('thead', {}, element('tr', {}, ...header.map(h => element('th', {scope: 'col'}, h)))),
      element('tbody', {}, ...rows))));
  }, {once: false});
  return details;
}
