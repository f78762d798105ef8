// Reading, zooming and moving of maps by pointer, wheel and keys.

function listenToPointer(canvas, view, maps) {
  let drag = null;
  const place = event => {
    const box = canvas.getBoundingClientRect();
    return view.placeAt(event.clientX - box.left, event.clientY - box.top, box.width);
  };
  canvas.addEventListener('pointermove', event => {
    if (!maps.ready()) return;
    if (drag) {
      const perPixel = view.width / (canvas.clientWidth * view.zoom);
      view.moveTo(drag.x - (event.clientX - drag.left) * perPixel, drag.y - (event.clientY - drag.top) * perPixel);
    } else {
      maps.read(...place(event));
      maps.draw();
    }
  });
  canvas.addEventListener('pointerdown', event => {
    if (event.button !== 0 || !maps.ready()) return;
    maps.read(...place(event));
    drag = {left: event.clientX, top: event.clientY, x: view.x, y: view.y};
    canvas.setPointerCapture(event.pointerId);
    maps.draw();
  });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, () => { drag = null; });
  canvas.addEventListener('wheel', event => {
    // Out of the whole map, the wheel scrolls the page.
    if (!maps.ready() || (view.zoom === 1 && event.deltaY > 0)) return;
    event.preventDefault();
    view.zoomAbout(Math.exp(-event.deltaY / 400), ...place(event));
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
