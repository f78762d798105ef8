// A plot: axes and ranges by uPlot; its series are drawn by plot_series.js. The pointer, or the arrow
// keys, choose a point, whose values are shown; dragging zooms, a double click or 0 shows all again.
import uPlot from 'uplot';
import {element} from './element.js';
import {plotAxis} from './plot_axis.js';
import {listenToKeys} from './plot_keys.js';
import {plotLegend} from './plot_legend.js';
import {fullRanges, withEqualUnits, zoomed} from './plot_range.js';
import {drawSeries, nearestPoint} from './plot_series.js';
import {plotTable} from './plot_table.js';
import {pointText} from './plot_text.js';
import {lookColour, onThemeChange, themeColour} from './theme.js';

const kReach_px = 30;
const kRight_px = 26;  // half of the widest number below the axis

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
  const zoom = (u, factor) => show(u, zoomed(data, view, factor));
  const height = width => data.equal ? width : Math.max(240, Math.min(420, 0.72 * width));
  const sizes = () => {
    const width = Math.max(200, frame.clientWidth);
    return {width, height: Math.round(height(width))};
  };
  const scale = (stated, range) => ({
    time: false, auto: true, distr: stated.log ? 3 : 1, dir: stated === data.y && data.y_down ? -1 : 1, range,
  });
  const plot = new uPlot({
    ...sizes(), padding: [8, kRight_px, 0, 0],
    scales: {x: scale(data.x, () => view.x), y: scale(data.y, () => view.y)},
    axes: [plotAxis(data.x, 2, 'x'), plotAxis(data.y, 3, 'y')],
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

  listenToKeys(frame, data, {
    chosen: () => chosen, choose: at => choose(plot, at), zoom: factor => zoom(plot, factor),
    showAll: () => show(plot, full),
  });
  onThemeChange(() => plot.redraw(false));
  new ResizeObserver(() => {
    const {width, height: tall} = sizes();
    if (width === plot.width) return;
    plot.setSize({width, height: tall});
    show(plot, full);
  }).observe(frame);
}
