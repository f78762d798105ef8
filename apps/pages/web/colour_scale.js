// Colour scales of maps: value -> [r, g, b].

// Blue for -1, white for 0, red for 1, linear between, as difference_colour() of apps/report/picture.h.
export function differenceColour(share) {
  const s = Math.max(-1, Math.min(1, share));
  const [r, g, b] = s < 0 ? [33, 102, 172] : [178, 24, 43];
  const mix = end => Math.round(255 + Math.abs(s) * (end - 255));
  return [mix(r), mix(g), mix(b)];
}

// Grey for 0 .. 1 with a gamma of 2.
export function greyColour(share) {
  const v = Math.round(255 * Math.sqrt(Math.max(0, Math.min(1, share))));
  return [v, v, v];
}

// From dark blue through green to yellow for 0 .. 1 (five stops of matplotlib's viridis).
const kStops = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
export function sequentialColour(share) {
  const at = Math.max(0, Math.min(1, share)) * (kStops.length - 1);
  const i = Math.min(Math.floor(at), kStops.length - 2);
  return kStops[i].map((v, k) => Math.round(v + (at - i) * (kStops[i + 1][k] - v)));
}

export const cssColour = ([r, g, b]) => `rgb(${r},${g},${b})`;

// The scale of a plot's cells (PlotColours of apps/report/plot.h): its colours, by share, and its ends.
export function scaleOf(colours) {
  if (colours.min === null) {
    const full = colours.full_scale;
    return {low: -full, high: full, share: v => v / full, colour: differenceColour, from: -1};
  }
  const at = v => colours.log ? Math.log(v) : v;
  const [low, high] = [at(colours.min), at(colours.full_scale)];
  return {low: colours.min, high: colours.full_scale, share: v => (at(v) - low) / (high - low),
          colour: sequentialColour, from: 0};
}
