// Observed, model and difference of the shots of a material, side by side: chosen by shot and channel,
// zoomed and moved together, with the values under the pointer.
import {differenceColour, greyColour} from './colour_scale.js';
import {element} from './element.js';
import {kClipped, kStates, kUsed, unpack} from './map_data.js';
import {MapView} from './map_view.js';
import {numberText} from './number_text.js';
import {scaleBar} from './plot_legend.js';

const kBehind = [28, 30, 34];
const kUnused = [120, 120, 120];
const kClippedColour = [213, 0, 50];
const kLeftOut = [230, 159, 0];
const kPanels = ['observed', 'model', 'difference'];
const kObservedStep_percent = 0.01;
const kDifferenceStep = 0.01;

// In percent of the brightest row in use.
class Shot {
  constructor(stated, map, fullScale_percent, rows, observed, difference, state) {
    Object.assign(this, {stated, map, rows, state, fullScale_percent});
    this.observed = Float32Array.from(observed, v => v * kObservedStep_percent);
    this.difference = Float32Array.from(difference, v => v * kDifferenceStep * fullScale_percent);
  }
  static async unpack(data, stated) {
    const map = data.maps[stated.map];
    map.unpacked ??= unpack(map.rows, Int32Array, 3);
    return new Shot(stated, map, data.full_scale_percent, await map.unpacked,
                    await unpack(stated.observed, Int16Array, 2),
                    await unpack(stated.difference, Int16Array, 2), await unpack(stated.state, Uint8Array, 1));
  }
  colour(panel, row) {
    if (this.state[row] !== kUsed) {
      if (panel !== 'observed') return kUnused;
      return this.state[row] === kClipped ? kClippedColour : kLeftOut;
    }
    if (panel === 'difference') return differenceColour(this.difference[row] / this.fullScale_percent);
    const model = panel === 'model' ? this.difference[row] : 0;
    return greyColour((this.observed[row] - model) / 100);
  }
  // A canvas of the map's size.
  picture(panel) {
    const {width, height} = this.map;
    const canvas = element('canvas', {width, height});
    const image = new ImageData(width, height);
    this.rows.forEach((row, i) => {
      image.data.set(row === 0 ? kBehind : this.colour(panel, row - 1), 4 * i);
      image.data[4 * i + 3] = 255;
    });
    canvas.getContext('2d').putImageData(image, 0, 0);
    return canvas;
  }
  // What is known of the place (x, y) of the map.
  text(x, y) {
    const {x0, y0, step, width} = this.map;
    const pixel = v => Math.floor(v) * step + Math.floor(step / 2);
    const place = `x ${x0 + pixel(x)} y ${y0 + pixel(y)} px: `;
    const row = this.rows[Math.floor(y) * width + Math.floor(x)] - 1;
    if (row < 0) return `${place}no patch`;
    if (this.state[row] !== kUsed) return `${place}patch ${row}, not used (${kStates[this.state[row]]})`;
    const [o, d] = [this.observed[row], this.difference[row]];
    return `${place}patch ${row}, observed ${numberText(o)} %, model ${numberText(o - d)} %, ` +
      `difference ${d > 0 ? '+' : ''}${numberText(d, 3)} %`;
  }
}

function choice(label, names, onChange) {
  const select = element('select', {}, ...names.map(n => element('option', {value: n}, n)));
  select.addEventListener('change', onChange);
  return [element('label', {class: 'choice'}, label, select), select];
}

function button(text, label, onClick) {
  const out = element('button', {type: 'button', 'aria-label': label, title: label}, text);
  out.addEventListener('click', onClick);
  return out;
}

export function mountMaps(host, data) {
  const unique = key => [...new Set(data.shots.map(s => s[key]))];
  let shot = null;
  let at = null;  // place that is read, in the map
  let pictures = [];
  const readout = element('output', {class: 'readout', 'aria-live': 'polite'});
  const canvases = kPanels.map(() => element('canvas', {}));
  const panels = element('div', {
    class: 'panels view', tabIndex: 0, role: 'img',
    'aria-label': 'Maps of observation, model and difference. Arrow keys read values, plus and minus zoom, 0 shows all.',
  }, ...kPanels.map((name, i) => element('div', {class: 'panel'}, element('span', {}, name), canvases[i])));

  const draw = () => {
    if (!shot) return;
    canvases.forEach((canvas, i) => {
      const width = Math.round(canvas.clientWidth * devicePixelRatio);
      canvas.width = width;
      canvas.height = Math.round(width * shot.map.height / shot.map.width);
      const [toX, toY] = view.paint(canvas, pictures[i]);
      if (!at) return;
      const ctx = canvas.getContext('2d');
      for (const [colour, wide] of [['#000', 3], ['#fff', 1]]) {
        ctx.strokeStyle = colour;
        ctx.lineWidth = wide * devicePixelRatio;
        ctx.strokeRect(toX(Math.floor(at[0])) - 4, toY(Math.floor(at[1])) - 4, 8, 8);
      }
    });
    panels.dataset.zoom = view.zoom.toFixed(2);
    readout.textContent = at ? shot.text(...at)
      : `rms of the difference ${numberText(shot.stated.rms_percent, 2)} %; point at a map to read values in percent of the brightest place.`;
  };
  const view = new MapView(draw);
  const read = (x, y) => {
    at = [Math.max(0, Math.min(shot.map.width - 1, x)), Math.max(0, Math.min(shot.map.height - 1, y))];
  };

  const choose = async () => {
    const stated = data.shots.find(s => s.file === files.value && s.channel === channels.value) ??
      data.shots.find(s => s.file === files.value);
    channels.value = stated.channel;
    shot = await Shot.unpack(data, stated);
    pictures = kPanels.map(panel => shot.picture(panel));
    at = null;
    view.resize(shot.map.width, shot.map.height);
    for (const b of overview.children) b.setAttribute('aria-pressed', String(b.stated === stated));
    draw();
  };
  const [fileChoice, files] = choice('shot ', unique('file'), choose);
  const [channelChoice, channels] = choice('channel ', unique('channel'), choose);
  const middle = () => at ?? [view.x, view.y];
  const tools = element('div', {class: 'tools'}, fileChoice, channelChoice,
    button('+', 'zoom in', () => view.zoomAbout(1.6, ...middle())),
    button('−', 'zoom out', () => view.zoomAbout(1 / 1.6, ...middle())),
    button('all', 'show all', () => view.reset()),
    scaleBar({label: 'difference [%]', full_scale: data.full_scale_percent, min: null, log: false}));

  // All differences at once, small: a press chooses one.
  const overview = element('div', {class: 'overview', role: 'group', 'aria-label': 'differences of all shots'});
  const thumbnails = async () => {
    for (const stated of data.shots) {
      const name = `${stated.file} ${stated.channel}, rms ${numberText(stated.rms_percent, 2)} %`;
      const small = (await Shot.unpack(data, stated)).picture('difference');
      const entry = button('', name, () => {
        files.value = stated.file;
        channels.value = stated.channel;
        choose();
      });
      entry.stated = stated;
      entry.append(small, element('span', {}, `${stated.file.replace(/\.[^.]*$/, '')} ${stated.channel}`));
      entry.setAttribute('aria-pressed', String(shot?.stated === stated));
      overview.append(entry);
    }
  };
  host.querySelector('.stage').append(tools, readout, panels, overview);

  let drag = null;
  for (const canvas of canvases) {
    const place = event => {
      const box = canvas.getBoundingClientRect();
      return view.placeAt(event.clientX - box.left, event.clientY - box.top, box.width);
    };
    canvas.addEventListener('pointermove', event => {
      if (!shot) return;
      if (drag) {
        const perPixel = view.width / (canvas.clientWidth * view.zoom);
        view.moveTo(drag.x - (event.clientX - drag.left) * perPixel, drag.y - (event.clientY - drag.top) * perPixel);
      } else {
        read(...place(event));
        draw();
      }
    });
    canvas.addEventListener('pointerdown', event => {
      if (event.button !== 0) return;
      if (shot) read(...place(event));
      drag = {left: event.clientX, top: event.clientY, x: view.x, y: view.y};
      canvas.setPointerCapture(event.pointerId);
      draw();
    });
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, () => { drag = null; });
    canvas.addEventListener('wheel', event => {
      // Out of the whole map, the wheel scrolls the page.
      if (!shot || (view.zoom === 1 && event.deltaY > 0)) return;
      event.preventDefault();
      view.zoomAbout(Math.exp(-event.deltaY / 400), ...place(event));
    }, {passive: false});
    canvas.addEventListener('dblclick', () => view.reset());
  }
  panels.addEventListener('keydown', event => {
    const step = {ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1]}[event.key];
    if (!shot) return;
    if (step) {
      const [x, y] = middle();
      const far = Math.max(1, Math.round(8 / view.zoom));
      read(x + far * step[0], y + far * step[1]);
      view.reveal(...at);
    } else if (event.key === '+' || event.key === '-') {
      view.zoomAbout(event.key === '+' ? 1.6 : 1 / 1.6, ...middle());
    } else if (event.key === '0') {
      view.reset();
    } else {
      return;
    }
    event.preventDefault();
  });
  new ResizeObserver(draw).observe(panels);
  // Unpacked when it comes into view: a page may hold many.
  const seen = new IntersectionObserver(entries => {
    if (!entries.some(e => e.isIntersecting)) return;
    seen.disconnect();
    choose().then(thumbnails);
  }, {rootMargin: '600px'});
  seen.observe(host);
}
