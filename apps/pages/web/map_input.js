// Reading, zooming and moving of maps by pointer, two fingers, wheel and keys.

function listenToPointer(canvas, view, maps) {
  const held = new Map();  // where the pointers that are down are on the canvas, by their ids
  const onCanvas = event => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const place = at => view.placeAt(...at, canvas.clientWidth);
  // The middle of what is held, and how far apart two fingers are.
  const grip = () => {
    const at = [...held.values()];
    return {
      middle: [0, 1].map(i => at.reduce((sum, p) => sum + p[i], 0) / at.length),
      apart: at.length > 1 ? Math.hypot(at[0][0] - at[1][0], at[0][1] - at[1][1]) : 0,
    };
  };
  canvas.addEventListener('pointermove', event => {
    if (!maps.ready()) return;
    if (!held.has(event.pointerId)) {
      maps.read(...place(onCanvas(event)));
      maps.draw();
      return;
    }
    // The place in the middle of the grip goes with it.
    const before = grip();
    held.set(event.pointerId, onCanvas(event));
    const after = grip();
    if (before.apart && after.apart) view.zoomAbout(after.apart / before.apart, ...place(before.middle));
    const [x, y] = place(after.middle);
    const [x0, y0] = place(before.middle);
    view.moveTo(view.x + x0 - x, view.y + y0 - y);
  });
  canvas.addEventListener('pointerdown', event => {
    if (event.button !== 0 || !maps.ready() || held.size === 2) return;
    if (held.size === 0) maps.read(...place(onCanvas(event)));
    held.set(event.pointerId, onCanvas(event));
    canvas.setPointerCapture(event.pointerId);
    maps.draw();
  });
  for (const end of ['pointerup', 'pointercancel']) {
    canvas.addEventListener(end, event => held.delete(event.pointerId));
  }
  canvas.addEventListener('wheel', event => {
    // Out of the whole map, the wheel scrolls the page.
    if (!maps.ready() || (view.zoom === 1 && event.deltaY > 0)) return;
    event.preventDefault();
    view.zoomAbout(Math.exp(-event.deltaY / 400), ...place(onCanvas(event)));
  }, {passive: false});
  canvas.addEventListener('dblclick', () => view.reset());
}

// maps: ready(), place() that is read or else the middle, read(x, y) and draw().
export function listenToMaps(panels, canvases, view, maps) {
  for (const canvas of canvases) listenToPointer(canvas, view, maps);
  const steps = {ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1]};
  panels.addEventListener('keydown', event => {
    if (!maps.ready()) return;
    if (event.key in steps) {
      const far = Math.max(1, Math.round(8 / view.zoom));
      const [x, y] = maps.place().map((v, i) => v + far * steps[event.key][i]);
      maps.read(x, y);
      view.reveal(...maps.place());
    } else if (event.key === '+' || event.key === '-') {
      view.zoomAbout(event.key === '+' ? 1.6 : 1 / 1.6, ...maps.place());
    } else if (event.key === '0') {
      view.reset();
    } else {
      return;
    }
    event.preventDefault();
  });
}
