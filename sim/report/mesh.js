// SPDX-License-Identifier: Apache-2.0
//
// The meshes of a view in WebGL: on the left a camera that goes round, on the right the view's own matrix, so that
// what is on the right is what the pipeline refined for.
import {
  BufferAttribute, BufferGeometry, Camera, ConeGeometry, DoubleSide, LineSegments, Mesh, MeshBasicMaterial,
  LineBasicMaterial, Matrix4, PerspectiveCamera, Scene, ShaderMaterial, Vector3, Vector4, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { choice, h, number, slider } from './dom.js';
import { unpackMesh } from './unpack.js';

// --- Colours --------------------------------------------------------------------------------------

/** Depth and facing have the colours of the pictures (sim/render_legend.c). */
const RAMP = [[250, 243, 214], [217, 234, 196], [158, 212, 187], [97, 181, 189], [60, 143, 184], [50, 102, 168]];
const CYCLE = [[68, 119, 170], [238, 153, 68], [34, 136, 102], [204, 68, 102], [102, 187, 221], [204, 187, 68], [119, 85, 153], [153, 170, 136], [170, 102, 68], [119, 136, 255]];
const FACING = [['front', [0x3d, 0x5a, 0x80]], ['back', [0x98, 0xb4, 0xcf]], ['both: at the silhouette', [0xf6, 0xe3, 0xb4]]];
const END = [
  ['whole: not refined in its generation', [170, 182, 194]],
  ['cut off: a triangle where refinement ends', [226, 120, 60]],
  ['made and sent by the last step', [52, 116, 178]],
];

/** How far the camera on the left is turned at first, in radians: so that one sees what the viewpoint does not. */
const FIRST_TURN = 0.8;

const between = (t) => {
  const place = t * (RAMP.length - 1), k = Math.min(Math.floor(place), RAMP.length - 2);
  return RAMP[k].map((c, i) => Math.round(c + (RAMP[k + 1][i] - c) * (place - k)));
};
const steps = (deepest) => Array.from({ length: deepest + 1 }, (_, g) => g);

/** Each way of colouring: the colour of a face, and a legend of [words, colour]. deepest: of all steps. */
const PAINTS = {
  depth: {
    words: 'depth of refinement',
    of: (mesh, deepest) => (face) => between(deepest ? mesh.depth[face] / deepest : 0),
    legend: (deepest) => steps(deepest).map((g) => [String(g), between(deepest ? g / deepest : 0)]),
  },
  facing: {
    words: 'facing of the viewpoint',
    of: (mesh) => (face) => FACING[mesh.facing[face]][1],
    legend: () => FACING,
  },
  generation: {
    words: 'generation in which it left',
    of: (mesh) => (face) => CYCLE[mesh.generation[face] % CYCLE.length],
    legend: (deepest) => steps(deepest).map((g) => [String(g), CYCLE[g % CYCLE.length]]),
  },
  end: {
    words: 'how it left',
    of: (mesh) => (face) => END[mesh.end[face]][1],
    legend: () => END,
  },
  plain: { words: 'none', of: () => () => [205, 190, 170], legend: () => [] },
};

// --- Geometry -------------------------------------------------------------------------------------

/** Triangles: three corners each, nothing shared, so that each face has a colour of its own. */
function surfaceOf(mesh) {
  let triangles = 0;
  for (const sides of mesh.sides) triangles += sides - 2;
  const position = new Float32Array(9 * triangles);
  let at = 0, first = 0;
  const put = (corner) => {
    const v = 3 * mesh.corner[corner];
    position[at++] = mesh.position[v];
    position[at++] = mesh.position[v + 1];
    position[at++] = mesh.position[v + 2];
  };
  for (const sides of mesh.sides) {
    for (let i = 1; i + 1 < sides; i++) {
      put(first);
      put(first + i);
      put(first + i + 1);
    }
    first += sides;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(position, 3));
  geometry.setAttribute('color', new BufferAttribute(new Uint8Array(9 * triangles), 3, true));
  return geometry;
}

function paintSurface(geometry, mesh, colorOf) {
  const color = geometry.getAttribute('color');
  let at = 0;
  mesh.sides.forEach((sides, face) => {
    const [red, green, blue] = colorOf(face);
    for (let i = 0; i < 3 * (sides - 2); i++) {
      color.array[at++] = red;
      color.array[at++] = green;
      color.array[at++] = blue;
    }
  });
  color.needsUpdate = true;
}

/** The faces' own edges, without the diagonals. */
function wiresOf(mesh) {
  const index = new Uint32Array(2 * mesh.corner.length);
  let at = 0, first = 0;
  for (const sides of mesh.sides) {
    for (let i = 0; i < sides; i++) {
      index[at++] = mesh.corner[first + i];
      index[at++] = mesh.corner[first + (i + 1) % sides];
    }
    first += sides;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(mesh.position, 3));
  geometry.setIndex(new BufferAttribute(index, 1));
  return geometry;
}

/** Light comes from beside the eye; the inside is terracotta, as in the pictures. One normal a face, from the
 *  derivatives of the position. eye is homogeneous: the point p looks towards eye.xyz - p * eye.w. */
function surfaceMaterial(eye, up, mirrored) {
  return new ShaderMaterial({
    side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1, vertexColors: true,
    uniforms: { eye: { value: eye }, up: { value: up }, mirrored: { value: mirrored } },
    vertexShader: `
      varying vec3 place, paint;
      void main() {
        place = position;
        paint = color;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      uniform vec4 eye;
      uniform vec3 up;
      uniform bool mirrored;
      varying vec3 place, paint;
      void main() {
        vec3 normal = cross(dFdx(place), dFdy(place));
        float size = length(normal);
        vec3 view = normalize(eye.xyz - place * eye.w);
        vec3 light = normalize(view + 0.5 * up);
        float bright = size > 0.0 ? abs(dot(normal / size, light)) : 1.0;
        vec3 paper = gl_FrontFacing != mirrored ? paint : mix(paint, vec3(0.72, 0.38, 0.26), 0.8);
        gl_FragColor = vec4(paper * (0.38 + 0.62 * bright), 1.0);
      }`,
  });
}

// --- Cameras --------------------------------------------------------------------------------------

/** What a view's matrix M (clip = M p) says: where the eye is, and which axis looks most upright. */
function readMatrix(m) {
  const matrix = new Matrix4().set(...m), inverse = matrix.clone().invert();
  const eye = new Vector4(0, 0, 1, 0).applyMatrix4(inverse);
  if (Math.abs(eye.w) > 1e-6 * Math.hypot(eye.x, eye.y, eye.z)) eye.divideScalar(eye.w);
  else { eye.w = 0; eye.multiplyScalar(-1); } // from z = -w (near) towards z = w: the eye is the other way
  const rows = [m[4], m[5], m[6]];
  const axis = rows.reduce((best, value, i) => (Math.abs(value) > Math.abs(rows[best]) ? i : best), 0);
  const up = new Vector3().setComponent(axis, Math.sign(rows[axis]) || 1);
  return { matrix, inverse, eye, up, mirrored: matrix.determinant() > 0 };
}

const supported = () => {
  try {
    return Boolean(document.createElement('canvas').getContext('webgl2'));
  } catch {
    return false;
  }
};

function paneOf(id, label) {
  const canvas = h('canvas', { id, tabindex: 0, 'aria-label': label });
  const renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
  renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
  return { canvas, renderer, scene: new Scene(), shown: [] };
}

function resize(pane) {
  const { clientWidth, clientHeight } = pane.canvas;
  pane.renderer.setSize(clientWidth, clientHeight, false);
}

// --- The section ----------------------------------------------------------------------------------

/** meshes: by the view's number as a string. state: {view, onView}. size: [width, height] of the pictures. */
export function meshSection({ meshes, state, size }) {
  if (!Object.keys(meshes).length) return h('p', {}, 'There are no meshes to show; the notes at the end say why.');
  if (!supported()) return h('p', { class: 'warning' }, 'This browser gives no WebGL 2, so meshes cannot be shown.');

  const orbit = paneOf('mesh-orbit', 'The mesh; drag to turn it'), frozen = paneOf('mesh-frozen', 'The mesh from the viewpoint');
  const camera = new PerspectiveCamera(35, 1, 0.01, 100), fixed = new Camera();
  const controls = new OrbitControls(camera, orbit.canvas);
  const wires = h('input', { id: 'mesh-wires', type: 'checkbox', checked: true, onchange: () => show() });
  const legend = h('ul', { class: 'legend' }), words = h('p', { class: 'meshwords', id: 'mesh-words' });
  let paint = 'depth', step = 0, current = null, key = '', view = null;

  const stepSlider = slider({ id: 'mesh-step', label: 'step', count: 1, words: (k) => `${k} of ${view ? view.steps.length - 1 : 0}`, change: (k) => { stop(); step = k; show(); } });
  const play = h('button', { type: 'button', id: 'mesh-play', onclick: () => (timer ? stop() : start()) }, 'play');
  let timer = 0;
  const stop = () => { clearInterval(timer); timer = 0; play.textContent = 'play'; };
  const start = () => {
    play.textContent = 'pause';
    step = 0;
    stepSlider.set(0);
    show();
    timer = setInterval(() => {
      if (step + 1 >= view.steps.length) return stop();
      stepSlider.set(++step);
      return show();
    }, 800);
  };

  function renderOrbit() {
    if (!view) return;
    resize(orbit);
    camera.aspect = orbit.canvas.clientWidth / Math.max(orbit.canvas.clientHeight, 1);
    camera.updateProjectionMatrix();
    if (orbit.material) {
      orbit.material.uniforms.eye.value.set(camera.position.x, camera.position.y, camera.position.z, 1);
      orbit.material.uniforms.up.value.copy(camera.up);
    }
    // The cone would hide the mesh from where it stands.
    const { centre, towards } = orbit.around;
    if (orbit.cone) orbit.cone.visible = camera.position.clone().sub(centre).normalize().distanceTo(towards) > 0.35;
    orbit.renderer.render(orbit.scene, camera);
  }

  function render() {
    renderOrbit();
    resize(frozen);
    frozen.renderer.render(frozen.scene, fixed);
  }

  function frame(look, turn) {
    const [x, y, z, X, Y, Z] = view.box, centre = new Vector3((x + X) / 2, (y + Y) / 2, (z + Z) / 2);
    const radius = Math.max(Math.hypot(X - x, Y - y, Z - z) / 2, 1e-9);
    const towards = new Vector3(look.eye.x, look.eye.y, look.eye.z);
    if (look.eye.w) towards.sub(centre);
    if (!(towards.lengthSq() > 0)) towards.set(0, 0, 1);
    towards.normalize();
    camera.up.copy(look.up);
    camera.near = radius / 100;
    camera.far = radius * 100;
    controls.target.copy(centre);
    const from = towards.clone().applyAxisAngle(look.up, turn);
    camera.position.copy(centre).addScaledVector(from, radius / Math.sin((camera.fov / 2) * (Math.PI / 180)));
    orbit.around = { centre, radius, towards };
    controls.update();
  }

  /** A cone that points from the viewpoint to the mesh. */
  function markerOf({ centre, radius, towards }) {
    const cone = new Mesh(new ConeGeometry(radius / 14, radius / 5, 24), new MeshBasicMaterial({ color: 0xd9534f }));
    cone.position.copy(centre).addScaledVector(towards, 1.05 * radius);
    cone.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), towards.clone().negate());
    return cone;
  }

  function empty(pane) {
    for (const old of pane.shown) {
      pane.scene.remove(old);
      old.geometry.dispose();
      old.material.dispose();
    }
  }

  /** Both panes share the geometry. */
  function putInto(pane, surface, edges, look, opacity) {
    pane.material = surfaceMaterial(look.eye.clone(), look.up.clone(), pane === orbit && look.mirrored);
    pane.shown = [new Mesh(surface, pane.material)];
    if (edges) pane.shown.push(new LineSegments(edges, new LineBasicMaterial({ color: 0x1b2530, transparent: true, opacity })));
    if (pane === orbit) pane.shown.push(pane.cone = markerOf(pane.around));
    for (const object of pane.shown) {
      object.frustumCulled = false;
      pane.scene.add(object);
    }
  }

  function show() {
    const stored = view.steps[step], name = `${key}/${step}`;
    if (current?.name !== name) current = { name, mesh: unpackMesh(stored.data, view.box) };
    const surface = surfaceOf(current.mesh), edges = wires.checked ? wiresOf(current.mesh) : null;
    paintSurface(surface, current.mesh, PAINTS[paint].of(current.mesh, view.deepest));
    // The more edges there are, the paler: what they lie on is to be seen.
    const opacity = Math.min(0.5, 0.5 * (4000 / current.mesh.faces) ** 0.75);
    for (const pane of [orbit, frozen]) {
      empty(pane);
      putInto(pane, surface, edges, view.look, opacity);
    }
    legend.replaceChildren(...PAINTS[paint].legend(view.deepest).map(([text, [red, green, blue]]) =>
      h('li', {}, h('span', { class: 'swatch', style: `background: rgb(${red} ${green} ${blue})` }), text)));
    words.textContent = `After ${step} of ${view.steps.length - 1} steps: ${number(stored.faces)} faces, ${number(stored.vertices)} vertices.`
      + (stored.stored < stored.faces ? ` Decimated for this page: ${number(stored.stored)} of ${number(stored.faces)} faces are shown; pictures and figures are those of all.` : '');
    render();
  }

  function choose() {
    stop();
    const found = meshes[String(state.view)];
    panes.hidden = !found;
    if (!found) {
      legend.replaceChildren();
      words.textContent = `There is no mesh of view ${state.view} in this file.`;
      return;
    }
    const first = view === null, last = view && step === view.steps.length - 1;
    key = String(state.view);
    view = { ...found, look: readMatrix(found.matrix), deepest: found.steps.length - 1 };
    step = first || last ? view.steps.length - 1 : Math.min(step, view.steps.length - 1);
    stepSlider.limit(view.steps.length);
    stepSlider.set(step);
    fixed.projectionMatrix.copy(view.look.matrix);
    fixed.projectionMatrixInverse.copy(view.look.inverse);
    frame(view.look, FIRST_TURN);
    show();
  }

  frozen.canvas.style.aspectRatio = `${size[0]} / ${size[1]}`;
  controls.addEventListener('change', renderOrbit);
  window.addEventListener('resize', () => view && render());
  const panes = h('div', { class: 'panes' },
    h('figure', {}, orbit.canvas, h('figcaption', {}, 'Drag to turn, wheel or two fingers to come nearer. The red cone looks from the viewpoint.')),
    h('figure', {}, frozen.canvas, h('figcaption', {}, 'The same through the view\'s own matrix: this camera stays.')));
  const section = h('div', {},
    h('div', { class: 'controls' },
      stepSlider.element, play,
      choice({ id: 'mesh-paint', label: 'colour', value: paint, options: Object.entries(PAINTS).map(([name, p]) => [name, p.words]), change: (to) => { paint = to; show(); } }),
      h('label', { class: 'check' }, wires, 'edges'),
      h('button', { type: 'button', id: 'mesh-reset', onclick: () => { frame(view.look, 0); renderOrbit(); } }, 'back to the viewpoint')),
    panes, legend, words);
  state.onView(choose);
  requestAnimationFrame(choose); // when the page has given the canvases their size
  return section;
}
