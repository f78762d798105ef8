// The series of a plot on its canvas, and the point nearest to the pointer.
import {cssColour, scaleOf} from './colour_scale.js';

const kLines = new Set(['line', 'dashed', 'line_points']);
const kDots = new Set(['points', 'open_points', 'line_points']);

export const colourIndex = (series, i) => series.look ?? i;

function line(ctx, points, dashed, ratio) {
  ctx.setLineDash(dashed ? [6 * ratio, 4 * ratio] : []);
  ctx.beginPath();
  points.forEach(([x, y], i) => { if (i === 0) ctx.moveTo(x, y); else ctx.lineTo(x, y); });
  ctx.stroke();
  ctx.setLineDash([]);
}

function dot(ctx, [x, y], radius, open) {
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 2 * Math.PI);
  if (open) ctx.stroke(); else ctx.fill();
}

function arrow(ctx, [x0, y0], [x1, y1], ratio) {
  const angle = Math.atan2(y1 - y0, x1 - x0);
  const head = Math.min(7 * ratio, Math.hypot(x1 - x0, y1 - y0));
  ctx.beginPath();
  ctx.moveTo(x0, y0);
  ctx.lineTo(x1, y1);
  for (const turn of [-0.4, 0.4]) {
    ctx.moveTo(x1, y1);
    ctx.lineTo(x1 - head * Math.cos(angle + turn), y1 - head * Math.sin(angle + turn));
  }
  ctx.stroke();
}

function cells(u, ctx, series, colours) {
  const scale = scaleOf(colours);
  series.value.forEach((v, i) => {
    if (v === null) return;
    const [hx, hy] = [series.dx[i] / 2, series.dy[i] / 2];
    const [x0, x1] = [-hx, hx].map(h => u.valToPos(series.x[i] + h, 'x', true));
    const [y0, y1] = [-hy, hy].map(h => u.valToPos(series.y[i] + h, 'y', true));
    ctx.fillStyle = cssColour(scale.colour(scale.share(v)));
    ctx.fillRect(Math.min(x0, x1), Math.min(y0, y1), Math.abs(x1 - x0) + 0.6, Math.abs(y1 - y0) + 0.6);
  });
}

function boxes(u, ctx, series, ratio) {
  const x = series.x.map(v => u.valToPos(v, 'x', true));
  const apart = x.length > 1 ? Math.abs(x[1] - x[0]) : 20 * ratio;
  const bottom = u.bbox.top + u.bbox.height;
  series.y.forEach((v, i) => {
    const top = u.valToPos(v, 'y', true);
    ctx.globalAlpha = 0.4;
    ctx.fillRect(x[i] - apart / 2, top, apart, bottom - top);
    ctx.globalAlpha = 1;
    ctx.strokeRect(x[i] - apart / 2, top, apart, bottom - top);
  });
}

export function drawSeries(u, data, chosen, {look, theme}) {
  const ctx = u.ctx;
  const ratio = devicePixelRatio;
  const place = (x, y) => [u.valToPos(x, 'x', true), u.valToPos(y, 'y', true)];
  ctx.save();
  ctx.beginPath();
  ctx.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
  ctx.clip();
  data.series.forEach((s, k) => {
    ctx.strokeStyle = ctx.fillStyle = look(colourIndex(s, k));
    ctx.lineWidth = 1.8 * ratio;
    if (s.style === 'cells') { cells(u, ctx, s, data.colours); return; }
    if (s.style === 'boxes') { boxes(u, ctx, s, ratio); return; }
    const points = s.x.map((x, i) => place(x, s.y[i]));
    if (s.style === 'arrows') {
      points.forEach((p, i) => arrow(ctx, p, place(s.x[i] + s.dx[i], s.y[i] + s.dy[i]), ratio));
    }
    if (kLines.has(s.style)) line(ctx, points, s.style === 'dashed', ratio);
    if (s.std) {
      ctx.lineWidth = ratio;
      const bottom = u.bbox.top + u.bbox.height;
      points.forEach(([x], i) => {
        const low = s.y[i] - s.std[i];
        const end = data.y.log && !(low > 0) ? bottom : u.valToPos(low, 'y', true);
        line(ctx, [[x, u.valToPos(s.y[i] + s.std[i], 'y', true)], [x, end]], false, ratio);
      });
      ctx.lineWidth = 1.8 * ratio;
    }
    if (kDots.has(s.style)) points.forEach(p => dot(ctx, p, 3 * ratio, s.style === 'open_points'));
  });
  if (chosen) {
    const s = data.series[chosen.series];
    ctx.strokeStyle = theme('ink');
    ctx.lineWidth = 1.5 * ratio;
    dot(ctx, place(s.x[chosen.point], s.y[chosen.point]), 6 * ratio, true);
  }
  ctx.restore();
}

// {series, point} of the point nearest to this position, or the cell that holds it; null if none lies
// within `reach_px`. Points go before lines.
export function nearestPoint(u, data, left, top, reach_px) {
  const [x, y] = [u.posToVal(left, 'x'), u.posToVal(top, 'y')];
  let best = null;
  let least = reach_px;
  data.series.forEach((s, series) => {
    for (let point = 0; point < s.x.length; ++point) {
      if (s.style === 'cells') {
        if (Math.abs(x - s.x[point]) <= s.dx[point] / 2 && Math.abs(y - s.y[point]) <= s.dy[point] / 2 && !best) {
          best = {series, point};
        }
        continue;
      }
      const away = Math.hypot(u.valToPos(s.x[point], 'x') - left, u.valToPos(s.y[point], 'y') - top);
      const distance = kLines.has(s.style) && s.style !== 'line_points' ? away + 8 : away;
      if (distance < least) {
        least = distance;
        best = {series, point};
      }
    }
  });
  return best;
}
