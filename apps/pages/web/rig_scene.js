// The parts of a rig as a scene of three.js: world frame, mm.
import {
  AmbientLight, BufferAttribute, BufferGeometry, DirectionalLight, Group, LineBasicMaterial,
  LineSegments, Mesh, MeshLambertMaterial, Scene, Vector3,
} from 'three';
import {SVGObject} from 'three/examples/jsm/renderers/SVGRenderer.js';
import {themeColour} from './theme.js';

const kSvg = 'http://www.w3.org/2000/svg';
const vector = list => new Vector3(...list);

// A dot and a name, the same size from any distance.
function label(at, text, title, radius, colour) {
  const group = document.createElementNS(kSvg, 'g');
  const part = (name, attributes, content) => {
    const node = document.createElementNS(kSvg, name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    if (content) node.textContent = content;
    group.append(node);
  };
  part('title', {}, title);
  part('circle', {r: radius, fill: colour});
  if (text) part('text', {x: radius + 3, y: 4, fill: themeColour('ink'), 'font-size': 12}, text);
  const object = new SVGObject(group);
  object.position.copy(at);
  object.renderOrder = text ? 2 : 0;  // what has no name may be hidden
  return object;
}

function lines(points, colour, opacity = 1) {
  const out = new LineSegments(new BufferGeometry().setFromPoints(points),
                               new LineBasicMaterial({color: colour, opacity, transparent: opacity < 1}));
  return out;
}

const closed = corners => corners.flatMap((c, i) => [c, corners[(i + 1) % corners.length]]);
const placeText = v => [v.x, v.y, v.z].map(x => x.toFixed(1)).join(', ');

function body(stated) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(stated.vertices), 3));
  geometry.setIndex(stated.triangles);
  const flat = geometry.toNonIndexed();
  flat.computeVertexNormals();
  flat.computeBoundingBox();
  return {name: stated.name, box: flat.boundingBox, mesh: new Mesh(flat, new MeshLambertMaterial({color: '#d9b26f'}))};
}

// The grid of a horizontal plane around `centre`, ten by ten cells of a round size.
function grid(centre, z, extent, colour) {
  const raw = extent / 5;
  const unit = 10 ** Math.floor(Math.log10(raw));
  const cell = [1, 2, 5, 10].map(s => s * unit).find(s => s >= raw);
  const [x0, y0] = [centre.x, centre.y].map(v => Math.round(v / cell) * cell);
  const points = [];
  for (let i = -5; i <= 5; ++i) {
    points.push(new Vector3(x0 + i * cell, y0 - 5 * cell, z), new Vector3(x0 + i * cell, y0 + 5 * cell, z));
    points.push(new Vector3(x0 - 5 * cell, y0 + i * cell, z), new Vector3(x0 + 5 * cell, y0 + i * cell, z));
  }
  const out = lines(points, colour);
  out.renderOrder = -1;
  return {object: out, cell};
}

// The scene with one of the bodies, its centre, the middle of all parts, how far they reach from there, the
// light that goes with the eye, and the cells of the grid at height z.
export function rigScene(data, bodyName) {
  const scene = new Scene();
  const shown = body(data.bodies.find(b => b.name === bodyName) ?? data.bodies[0]);
  const centre = shown.box.getCenter(new Vector3());
  const size = shown.box.getSize(new Vector3()).length();
  const places = [];
  const around = new Group();
  const put = (...objects) => objects.forEach(o => around.add(o));
  const [camera, led, mark] = ['camera', 'led', 'mark'].map(themeColour);
  for (const c of data.cameras) {
    const at = vector(c.at);
    const depth = at.distanceTo(centre);
    const corners = c.corners.map(d => at.clone().addScaledVector(vector(d), depth));
    put(lines([...corners.flatMap(corner => [at, corner]), ...closed(corners)], camera),
        label(at, c.name, `${c.name} at ${placeText(at)} mm`, 5, camera));
    places.push(at);
  }
  for (const l of data.leds) {
    const at = vector(l.at);
    const end = at.clone().addScaledVector(vector(l.axis), 0.4 * at.distanceTo(centre));
    put(lines([at, end], led), label(at, l.name, `${l.name} at ${placeText(at)} mm`, 5, led));
    places.push(at);
  }
  data.marks.forEach((m, i) => {
    put(label(vector(m), '', `mark ${i + 1} at ${m.join(', ')} mm`, 2.5, mark));
    places.push(vector(m));
  });
  if (data.board.length > 0) put(lines(closed(data.board.map(vector)), mark));
  const all = shown.box.clone();
  places.forEach(p => all.expandByPoint(p));
  const reach = 0.5 * all.getSize(new Vector3()).length();
  const z = data.plane_z ?? shown.box.min.z;
  const {object: plane, cell} = grid(centre, z, Math.max(0.7 * size, 0.6 * reach), themeColour('line'));
  const light = new DirectionalLight('#ffffff', 0.65);
  scene.add(plane, shown.mesh, around, new AmbientLight('#ffffff', 0.4), light);
  return {scene, centre, middle: all.getCenter(new Vector3()), reach, light, cell, z};
}
