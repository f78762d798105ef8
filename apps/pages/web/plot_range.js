// What part of the plane a plot shows.

function ends(stated, values) {
  const usable = values.filter(v => Number.isFinite(v) && (!stated.log || v > 0));
  let low = usable.reduce((a, b) => Math.min(a, b), Infinity);
  let high = usable.reduce((a, b) => Math.max(a, b), -Infinity);
  if (!(low <= high)) [low, high] = stated.log ? [0.1, 1] : [0, 1];
  if (stated.log) {
    const margin = Math.max(1.05, (high / low) ** 0.05);
    [low, high] = [low / margin, high * margin];
  } else {
    const margin = high > low ? 0.06 * (high - low) : Math.max(1e-12, 0.1 * Math.abs(high));
    [low, high] = [low - margin, high + margin];
  }
  return [stated.min ?? low, stated.max ?? high];
}

// Of all series with their error bars, or as the axes state.
export function fullRanges({x, y, series}) {
  const all = (s, v, d) => s[v].flatMap((a, i) => s[d] ? [a, a + s[d][i]] : [a]);
  const tall = s => s.std ? s.y.flatMap((a, i) => [a - s.std[i], a + s.std[i]]) : all(s, 'y', 'dy');
  return {x: ends(x, series.flatMap(s => all(s, 'x', 'dx'))), y: ends(y, series.flatMap(tall))};
}

// The smallest ranges around these whose units are equally long in an area of this size.
export function withEqualUnits({x, y}, width, height) {
  const perPixel = Math.max((x[1] - x[0]) / width, (y[1] - y[0]) / height);
  const around = ([a, b], pixels) => [(a + b - perPixel * pixels) / 2, (a + b + perPixel * pixels) / 2];
  return {x: around(x, width), y: around(y, height)};
}

// Ranges `factor` times as long about the same middle, on a log axis that of the logarithms.
export function zoomed(data, {x, y}, factor) {
  const about = (range, log) => {
    const [a, b] = log ? range.map(Math.log) : range;
    const [mid, half] = [(a + b) / 2, factor * (b - a) / 2];
    const out = [mid - half, mid + half];
    return log ? out.map(Math.exp) : out;
  };
  return {x: about(x, data.x.log), y: about(y, data.y.log)};
}
