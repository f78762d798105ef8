// A rig in three dimensions, turned by dragging or by the arrow keys.
import {Color, PerspectiveCamera, Vector3} from 'three';
import {SVGRenderer} from 'three/examples/jsm/renderers/SVGRenderer.js';
import {element} from './element.js';
import {numberText} from './number_text.js';
import {rigScene} from './rig_scene.js';
import {onThemeChange, themeColour} from './theme.js';

const kDegree = Math.PI / 180;
const kFieldOfView_deg = 35;

export function mountRig(host, data) {
  const renderer = new SVGRenderer();
  renderer.setPrecision(1);
  const eye = new PerspectiveCamera(kFieldOfView_deg, 1, 1, 1e6);
  eye.up.set(0, 0, 1);
  const frame = element('div', {
    class: 'view rig', tabIndex: 0, role: 'img',
    'aria-label': 'The rig in three dimensions. Arrow keys turn it, plus and minus zoom, 0 starts again. The positions stand in a table below.',
  }, renderer.domElement);
  const note = element('output', {class: 'readout', 'aria-live': 'off'});
  // About the object: from which side (0: from +x, 90: from +y), how steeply, how near.
  const start = {azimuth: -60, elevation: 25, nearness: 1};
  let at = {...start};
  let parts = null;

  const draw = () => {
    const width = Math.max(200, frame.clientWidth);
    const height = Math.round(Math.min(0.62 * width, 460));
    renderer.setSize(width, height);
    eye.aspect = width / height;
    const [a, e] = [at.azimuth * kDegree, at.elevation * kDegree];
    const wide = Math.min(1, eye.aspect);
    const distance = 0.85 * parts.reach / Math.sin(kFieldOfView_deg * kDegree / 2) / wide / at.nearness;
    const away = new Vector3(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e));
    // The nearer, the more at the object alone.
    const target = parts.centre.clone().lerp(parts.middle, Math.min(1, 1 / at.nearness));
    eye.position.copy(target).addScaledVector(away, distance);
    eye.lookAt(target);
    eye.updateProjectionMatrix();
    eye.updateMatrixWorld();  // labels are placed by it before the renderer does so itself
    parts.light.position.copy(eye.position).sub(target).add(new Vector3(0, 0, distance / 2));
    renderer.render(parts.scene, eye);
    frame.dataset.azimuth = at.azimuth.toFixed(1);
    frame.dataset.elevation = at.elevation.toFixed(1);
    note.textContent = `seen from azimuth ${Math.round(at.azimuth)}°, elevation ${Math.round(at.elevation)}°; ` +
      `grid of ${numberText(parts.cell)} mm at z = ${numberText(parts.z)} mm`;
  };
  const build = () => {
    renderer.setClearColor(new Color(themeColour('paper')));
    parts = rigScene(data, bodies.value);
    draw();
  };
  const look = change => {
    at = {...at, ...change};
    at.azimuth = (at.azimuth + 540) % 360 - 180;
    at.elevation = Math.max(-89, Math.min(89, at.elevation));
    at.nearness = Math.max(0.3, Math.min(20, at.nearness));
    draw();
  };
  // Where a camera stands, and near enough to fill the picture.
  const asCamera = () => {
    const d = new Vector3(...data.cameras[0].at).sub(parts.centre);
    look({azimuth: Math.atan2(d.y, d.x) / kDegree, elevation: Math.asin(d.z / d.length()) / kDegree, nearness: 4});
  };
  const bodies = element('select', {}, ...data.bodies.map(b => element('option', {value: b.name}, b.name)));
  bodies.addEventListener('change', build);
  const button = (text, onClick) => {
    const out = element('button', {type: 'button'}, text);
    out.addEventListener('click', onClick);
    return out;
  };
  const tools = element('div', {class: 'tools'},
    ...(data.bodies.length > 1 ? [element('label', {class: 'choice'}, 'object ', bodies)] : []),
    button('+', () => look({nearness: at.nearness * 1.4})), button('−', () => look({nearness: at.nearness / 1.4})),
    ...(data.cameras.length > 0 ? [button('from the camera', asCamera)] : []),
    button('from above', () => look({azimuth: -90, elevation: 89, nearness: 1})),
    button('start', () => look(start)));
  tools.children[data.bodies.length > 1 ? 1 : 0].setAttribute('aria-label', 'zoom in');
  tools.children[data.bodies.length > 1 ? 2 : 1].setAttribute('aria-label', 'zoom out');
  host.querySelector('.stage').append(tools, frame, note);

  let drag = null;
  frame.addEventListener('pointerdown', event => {
    if (event.button !== 0) return;
    drag = {left: event.clientX, top: event.clientY, ...at};
    frame.setPointerCapture(event.pointerId);
  });
  frame.addEventListener('pointermove', event => {
    if (!drag) return;
    look({azimuth: drag.azimuth - 0.5 * (event.clientX - drag.left),
          elevation: drag.elevation + 0.5 * (event.clientY - drag.top)});
  });
  for (const end of ['pointerup', 'pointercancel']) frame.addEventListener(end, () => { drag = null; });
  frame.addEventListener('wheel', event => {
    if (at.nearness <= 1 && event.deltaY > 0) return;
    event.preventDefault();
    look({nearness: Math.max(1, at.nearness * Math.exp(-event.deltaY / 500))});
  }, {passive: false});
  frame.addEventListener('keydown', event => {
    const change = {
      ArrowLeft: {azimuth: at.azimuth - 5}, ArrowRight: {azimuth: at.azimuth + 5},
      ArrowUp: {elevation: at.elevation + 5}, ArrowDown: {elevation: at.elevation - 5},
      '+': {nearness: at.nearness * 1.2}, '-': {nearness: at.nearness / 1.2}, '0': start,
    }[event.key];
    if (!change) return;
    look(change);
    event.preventDefault();
  });
  onThemeChange(build);
  build();
  new ResizeObserver(draw).observe(frame);
}
