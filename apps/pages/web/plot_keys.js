// Reading and zooming of a plot by keys: the arrows step through points and series.

// The point that a step leads to: [of series, of points], each -1, 0 or 1.
function stepped({series}, chosen, [ofSeries, ofPoints]) {
  const next = ((chosen?.series ?? 0) + ofSeries + series.length) % series.length;
  const length = series[next].x.length;
  if (ofSeries !== 0) return {series: next, point: Math.min(chosen?.point ?? 0, length - 1)};
  const from = chosen?.point ?? (ofPoints > 0 ? -1 : 0);
  return {series: next, point: (from + ofPoints + length) % length};
}

// plot: chosen() and choose(point or null), zoom(factor), showAll().
export function listenToKeys(frame, data, plot) {
  const steps = {ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowDown: [1, 0], ArrowUp: [-1, 0]};
  frame.addEventListener('keydown', event => {
    if (event.key in steps) {
      plot.choose(stepped(data, plot.chosen(), steps[event.key]));
    } else if (event.key === '+' || event.key === '-') {
      plot.zoom(event.key === '+' ? 0.7 : 1 / 0.7);
    } else if (event.key === '0') {
      plot.showAll();
    } else if (event.key === 'Escape') {
      plot.choose(null);
    } else {
      return;
    }
    event.preventDefault();
  });
}
