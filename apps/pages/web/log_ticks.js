// Ticks of a logarithmic axis.
import {numberText, superscript} from './number_text.js';

// Positions between min and max, about `most` of them: whole decades (or every n-th), the steps 1 2 5,
// or, within less than a decade, round numbers at equal distances.
export function logTicks(min, max, most) {
  const decades = Math.log10(max / min);
  const out = [];
  if (decades < 1) {
    const raw = (max - min) / most;
    const unit = 10 ** Math.floor(Math.log10(raw));
    const step = unit * [1, 2, 5, 10].find(s => s * unit >= raw);
    for (let k = Math.ceil(min / step); k * step <= max; ++k) out.push(k * step);
    return out;
  }
  const steps = decades * 3 <= most + 2 ? [1, 2, 5] : [1];
  const every = Math.max(1, Math.ceil(decades / most));
  for (let e = Math.floor(Math.log10(min)); e <= Math.log10(max); ++e) {
    if (e % every !== 0) continue;
    for (const s of steps) {
      const tick = Number(`${s}e${e}`);
      if (tick >= min * (1 - 1e-9) && tick <= max * (1 + 1e-9)) out.push(tick);
    }
  }
  return out;
}

// The labels of ticks at equal distances, all with the decimals that the distance needs.
export function linearTickTexts(ticks) {
  const step = ticks.length > 1 ? Math.abs(ticks[1] - ticks[0]) : 0;
  const isRound = d => Math.abs(step * 10 ** d - Math.round(step * 10 ** d)) < 1e-6 && step * 10 ** d > 0.5;
  const decimals = [0, 1, 2, 3, 4, 5, 6].find(isRound) ?? 7;
  return ticks.map(t => decimals < 7 && Math.abs(t) < 1e6 ? t.toFixed(decimals).replace('-', '−') : numberText(t, 6));
}

export function tickText(tick) {
  const exponent = Math.log10(tick);
  const isDecade = tick > 0 && Math.abs(exponent - Math.round(exponent)) < 1e-9;
  return isDecade && Math.abs(exponent) > 3 ? `10${superscript(Math.round(exponent))}` : numberText(tick, 6);
}
