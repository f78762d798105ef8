// An axis of a plot, for uPlot.
import {linearTickTexts, logTicks, tickText} from './log_ticks.js';
import {labelAndUnit} from './number_text.js';
import {themeColour} from './theme.js';

const kFont = '12px system-ui, sans-serif';

// stated: PlotAxis of apps/report/plot.h; side: 2 below, 3 to the left; scale: its name.
export function plotAxis(stated, side, scale) {
  const [name, unit] = labelAndUnit(stated.label);
  const out = {
    scale, side, label: unit ? `${name} [${unit}]` : name, font: kFont, labelFont: '11px system-ui, sans-serif', labelSize: 22,
    stroke: () => themeColour('ink'), grid: {stroke: () => themeColour('line'), width: 1},
    ticks: {stroke: () => themeColour('line'), width: 1},
    values: (u, ticks) => stated.log ? ticks.map(tickText) : linearTickTexts(ticks),
  };
  if (side === 3) {
    // Room for ticks and gap, and for the widest number in a wide font.
    out.size = (u, values) => 20 + 8 * Math.max(3, ...(values ?? []).map(v => v.length));
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
