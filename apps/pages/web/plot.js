// A plot: axes and ranges by uPlot; its series are drawn by plot_series.js. The pointer, or the arrow
// keys, choose a point, whose values are shown; dragging zooms, a double click or 0 shows all again.
import uPlot from 'uplot';
import {element} from './element.js';
import {linearTickTexts, logTicks, tickText} from './log_ticks.js';
import {labelAndUnit, numberText} from './number_text.js';
import {fullRanges, withEqualUnits} from './plot_range.js';
import {drawSeries, nearestPoint} from './plot_series.js';
import {plotLegend} from './plot_legend.js';
import {plotTable} from './plot_table.js';
import {lookColour, onThemeChange, themeColour} from './theme.js';

const kFont = '12px system-ui, sans-serif';
const kReach_px = 30;

function axis(stated, side, scale) {
  const [name, unit] = labelAndUnit(stated.label);
  const out = {
    scale, side, label: unit ? `${name} [${unit}]` : name, font: kFont, labelFont: '11px system-ui, sans-serif', labelSize: 22,
    stroke: () => themeColour('ink'), grid: {stroke: () => themeColour('line'), width: 1},
    ticks: {stroke: () => themeColour('line'), width: 1},
    values: (u, ticks) => stated.log ? ticks.map(tickText) : linearTickTexts(ticks),
  };
  if (side === 3) {
    out.size = (u, values) => 16 + 7 * Math.max(3, ...(values ?? []).map(v => v.length));
  } else {
    out.space = 60;
    out.size = 34;
  }
  if (stated.log) {
    out.filter = (u, ticks) => ticks;
    out.splits = (u, i, min, max) => logTicks(min, max, side === 3 ? 7 : Math.max(3, u.width / 70));
  }
  return out;
}

// What is said of a point: "dipole, fitted: distance d 3.2 mm, r 0.0012 1/mm²".
function pointText(data, at) {
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

export function mountPlot(host, data) {
  const stage = host.querySelector('.stage');
  const readout = element('output', {class: 'readout', 'aria-live': 'polite'});
  const frame = element('div', {
    class: 'plot', tabIndex: 0, role: 'img',
    'aria-label': `${data.title}. Arrow keys read its values, plus and minus zoom, 0 shows all.`,
  });
  stage.append(element('div', {class: 'plot-title'}, data.title), plotLegend(data), frame, readout);
  host.insertBefore(plotTable(data), host.querySelector('figcaption'));

  const full = fullRanges(data);
  let view = full;
  let chosen = null;  // {series, point}
  // Said once on a page.
  const hint = document.querySelector('[data-widget="plot"]') === host
    ? 'Point at a plot, or focus it and press the arrow keys, to read values; drag to zoom.' : '\u00a0';
  const say = () => { readout.textContent = chosen ? pointText(data, chosen) : hint; };
  say();

  const show = (u, ranges) => {
    const {clientWidth: wide, clientHeight: high} = u.over;
    view = data.equal && wide > 0 ? withEqualUnits(ranges, wide, high) : ranges;
    u.setData(u.data);
  };
  const choose = (u, at) => {
    chosen = at;
    say();
    u.redraw(false);
  };
  const zoom = (u, factor) => {
    const about = (range, log) => {
      const [a, b] = log ? range.map(Math.log) : range;
      const [mid, half] = [(a + b) / 2, factor * (b - a) / 2];
      const out = [mid - half, mid + half];
      return log ? out.map(Math.exp) : out;
    };
    show(u, {x: about(view.x, data.x.log), y: about(view.y, data.y.log)});
  };
  const height = width => data.equal ? width : Math.max(240, Math.min(420, 0.72 * width));
  const sizes = () => {
    const width = Math.max(200, frame.clientWidth);
    return {width, height: Math.round(height(width))};
  };
  const scale = (stated, range) => ({
    time: false, auto: true, distr: stated.log ? 3 : 1, dir: stated === data.y && data.y_down ? -1 : 1, range,
  });
  const plot = new uPlot({
    ...sizes(), padding: [8, 14, 0, 0],
    scales: {x: scale(data.x, () => view.x), y: scale(data.y, () => view.y)},
    axes: [axis(data.x, 2, 'x'), axis(data.y, 3, 'y')],
    series: [{}, {show: true, paths: () => null, points: {show: false}}],
    legend: {show: false},
    cursor: {
      drag: {x: true, y: true, setScale: false}, points: {show: false},
      bind: {dblclick: u => () => { show(u, full); return null; }},
    },
    hooks: {
      ready: [u => show(u, full)],  // its area has a size now
      draw: [u => drawSeries(u, data, chosen, {look: lookColour, theme: themeColour})],
      setCursor: [u => {
        const {left, top} = u.cursor;
        if (left < 0) return;
        const at = nearestPoint(u, data, left, top, kReach_px);
        if (at?.series !== chosen?.series || at?.point !== chosen?.point) choose(u, at);
      }],
      setSelect: [u => {
        const {left, top, width, height: tall} = u.select;
        if (width < 4 && tall < 4) return;
        const ordered = (a, b) => a < b ? [a, b] : [b, a];
        const wide = width >= 4, high = tall >= 4;
        const x = wide ? ordered(u.posToVal(left, 'x'), u.posToVal(left + width, 'x')) : view.x;
        const y = high ? ordered(u.posToVal(top + tall, 'y'), u.posToVal(top, 'y')) : view.y;
        u.setSelect({left: 0, top: 0, width: 0, height: 0}, false);
        show(u, {x, y});
      }],
    },
  }, [[0, 1], [null, null]], frame);

  frame.addEventListener('keydown', event => {
    const step = {ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowDown: [1, 0], ArrowUp: [-1, 0]}[event.key];
    if (step) {
      const n = data.series.length;
      const series = ((chosen?.series ?? 0) + step[0] + n) % n;
      const length = data.series[series].x.length;
      const from = chosen && step[0] === 0 ? chosen.point : -Math.min(0, step[1]) - 1;
      const point = step[0] !== 0 ? Math.min(chosen?.point ?? 0, length - 1) : (from + step[1] + length) % length;
      choose(plot, {series, point});
    } else if (event.key === '+' || event.key === '-') {
      zoom(plot, event.key === '+' ? 0.7 : 1 / 0.7);
    } else if (event.key === '0') {
      show(plot, full);
    } else if (event.key === 'Escape') {
      choose(plot, null);
    } else {
      return;
    }
    event.preventDefault();
  });
  onThemeChange(() => plot.redraw(false));
  new ResizeObserver(() => {
    const {width, height: tall} = sizes();
    if (width === plot.width) return;
    plot.setSize({width, height: tall});
    show(plot, full);
  }).observe(frame);
}
