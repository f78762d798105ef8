// One place of several pictures of equal size at once: zoomed and moved together.

const kMostZoom = 40;

export class MapView {
  // draw(): is called after each change.
  constructor(draw) {
    this.draw = draw;
    this.width = this.height = 1;
    this.reset();
  }
  // Of the pictures, in places of the map; shows all.
  resize(width, height) {
    if (width === this.width && height === this.height) return;
    [this.width, this.height] = [width, height];
    this.reset();
  }
  reset() {
    this.zoom = 1;
    [this.x, this.y] = [this.width / 2, this.height / 2];  // the place in the middle
    this.draw();
  }
  // Keeps the place (x, y) where it is on the screen.
  zoomAbout(factor, x, y) {
    const zoom = Math.max(1, Math.min(kMostZoom, this.zoom * factor));
    const share = this.zoom / zoom;
    [this.x, this.y] = [x + (this.x - x) * share, y + (this.y - y) * share];
    this.zoom = zoom;
    this.clamp();
    this.draw();
  }
  moveTo(x, y) {
    [this.x, this.y] = [x, y];
    this.clamp();
    this.draw();
  }
  clamp() {
    const within = (v, size) => {
      const half = size / 2 / this.zoom;
      return Math.max(half, Math.min(size - half, v));
    };
    this.x = within(this.x, this.width);
    this.y = within(this.y, this.height);
  }
  // So that the place (x, y) is on the screen.
  reveal(x, y) {
    const half = [this.width, this.height].map(size => size / 2 / this.zoom);
    const near = (v, at, h) => Math.max(at - h + 1, Math.min(at + h - 1, v));
    this.moveTo(near(this.x, x, half[0]), near(this.y, y, half[1]));
  }
  // The place at a position on a canvas of this width, both in the same unit.
  placeAt(left, top, width) {
    const perUnit = this.width / (width * this.zoom);
    return [this.x - this.width / 2 / this.zoom + left * perUnit,
            this.y - this.height / 2 / this.zoom + top * perUnit];
  }
  paint(canvas, picture, smooth = false) {
    const ctx = canvas.getContext('2d');
    const size = canvas.width / this.width * this.zoom;
    ctx.setTransform(size, 0, 0, size, canvas.width / 2 - this.x * size, canvas.height / 2 - this.y * size);
    ctx.imageSmoothingEnabled = smooth;
    ctx.drawImage(picture, 0, 0);
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    return [x => (x - this.x) * size + canvas.width / 2, y => (y - this.y) * size + canvas.height / 2];
  }
}
