// The words of a plot.
import {labelAndUnit, numberText} from './number_text.js';

// What is said of a point: "dipole, fitted: distance d 3.2 mm, r 0.0012 1/mm²".
export function pointText(data, at) {
  const series = data.series[at.series];
  const of = (label, value, std) => {
    const [name, unit] = labelAndUnit(label);
    const deviation = std === undefined || std === null ? '' : ` ± ${numberText(std, 2)}`;
    return `${name} ${numberText(value)}${deviation}${unit ? ` ${unit}` : ''}`;
  };
  const parts = [of(data.x.label, series.x[at.point]),
                 of(data.y.label, series.y[at.point], series.std?.[at.point])];
  if (series.value) parts.push(of(data.colours.label, series.value[at.point]));
  return (series.name ? `${series.name}: ` : '') + parts.join(', ');
}
