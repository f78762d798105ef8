// Observed, model and difference of the shots of a material, side by side: chosen by shot and channel,
// zoomed and moved together, with the values under the pointer.
import {element} from './element.js';
import {listenToMaps} from './map_input.js';
import {MapShot} from './map_shot.js';
import {MapView} from './map_view.js';
import {numberText} from './number_text.js';
import {scaleBar} from './plot_legend.js';

const kPanels = ['observed', 'model', 'difference'];

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
    shot = await MapShot.unpack(data, stated);
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
      const small = (await MapShot.unpack(data, stated)).picture('difference');
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

  listenToMaps(panels, canvases, view, {ready: () => shot !== null, place: middle, read, draw});
  new ResizeObserver(draw).observe(panels);
  // Unpacked when it comes into view: a page may hold many.
  const seen = new IntersectionObserver(entries => {
    if (!entries.some(e => e.isIntersecting)) return;
    seen.disconnect();
    choose().then(thumbnails);
  }, {rootMargin: '600px'});
  seen.observe(host);
}
