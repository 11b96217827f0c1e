// From the surfaces of an OBJ file to labelled parts.
//
// A surface is what one object or group has of one material. Its label is the group's name when that says something
// ("leg_upright4_Cylinder.015" does, "Cube.003" and the model's own name do not), else the material's ("cabinetDoor"),
// else there is none and it is anonymous. Where a named group has several materials, the others are called
// "drawer handle".
//
// A surface may hold several instances ("FrontLegs"). It is taken apart into connected components (vertices welded by
// position) when these are all of one size; else the components whose boxes touch are put together first, so that a
// drawer's front keeps its knob and a leg its foot, and what then stands apart are parts of their own. Crumbs go to the
// nearest component. A surface that would become more than 16 parts stays whole: it is a heap of pebbles, a keyboard, a
// plant.

const mostInstances = 16;
/** Lengths below are relative to the diagonal of the model. */
const weldDistance = 1e-5;
const touchDistance = 2e-3;
const crumbSize = 0.02;
/** Area and radius of instances differ by less. */
const sameSize = 0.05;

const primitives =
  'cube|plane|circle|cylinder|sphere|icosphere|uvsphere|torus|cone|tube|curve|beziercurve|beziercircle|nurbs\\w*|grid|' +
  'mesh|object|obj|group|grp|default|defaultmaterial|material|mat|untitled|shape|polysurface|surface|pcube|line|text|' +
  'none|null|geometry|node|part|empty|monkey|suzanne|lathe|extrude|spline|solid|model|texture|textured|color|colour|' +
  'firstcolor|components|wire|initialshadinggroup|lambert|phong|blinn';
const generic = new RegExp(`^(${primitives}|box\\d+|tex\\d*|m\\d+|\\d+)([ _.#-]*\\d+)*$`, 'i');
const blenderMesh = new RegExp(`[_ ](${primitives})([._]\\d+)*$`, 'i');

/** The names that Sweet Home 3D gives to what moves, mirrors or lets light through. */
const sweetHome = [
  [/^sweethome3d_window_mirror(_on_(hinge|rail)_\d+)?_?/, 'mirror '],
  [/^sweethome3d_window_pane(_on_(hinge|rail)_\d+)?_?/, 'window pane '],
  [/^sweethome3d_opening_on_(hinge|rail)_\d+_?/, 'opening '],
  [/^sweethome3d_(unique_)?(hinge|rail|light|ball|mannequin)_?(\d+_?)?/, '$2 '],
  [/^sweethome3d_/, ''],
];

/** What a group's or material's name says, or '' when it says nothing. `not`: names that say nothing here. */
export function meaningOf(name, not = []) {
  let text = name;
  for (const [pattern, replacement] of sweetHome) text = text.replace(pattern, replacement);
  text = text.replace(/\.(jpe?g|png|tga|bmp)/gi, '').trim();
  for (let last = ''; last !== text; ) {
    last = text;
    text = text
      .replace(blenderMesh, '')
      .replace(/[._ -]\d+$/, '')
      .replace(/^(.+)[_ ]\1$/, '$1')
      .trim();
  }
  const bare = text.toLowerCase().replace(/[^a-z]/g, '');
  if (bare.length < 3 || generic.test(text) || not.includes(bare)) return '';
  return text.replaceAll('_', ' ');
}

/**
 * @param {import('./obj.mjs').Obj} obj positions in the units and axes of the result
 * @param {string} modelName
 * @returns {{ label: string, from: 'group' | 'material' | 'nothing', material: string, corners: number[], area: number }[]}
 */
export function partsOf(obj, modelName) {
  const size = diagonal(obj);
  const own = [modelName.toLowerCase().replace(/[^a-z]/g, '')];
  const weld = welded(obj.positions, size * weldDistance);
  const surfaces = obj.surfaces.map((surface) => ({ ...surface, area: measure(obj, surface.corners).area }));
  const largest = new Map(); // of each group
  for (const surface of surfaces) {
    if (surface.area > (largest.get(surface.name)?.area ?? -1)) largest.set(surface.name, surface);
  }
  const parts = [];
  for (const surface of surfaces) {
    const { name, material, corners } = surface;
    // "Chair_Chair_Aluminum" and "leg_leg_Wood": the material is written behind the name.
    const bare = material !== '' && name.endsWith(`_${material}`) ? name.slice(0, -material.length - 1) : name;
    const group = meaningOf(bare, own);
    const stuff = meaningOf(material, own);
    let label = group || stuff;
    if (group !== '' && stuff !== '' && largest.get(name) !== surface) label = `${group} ${stuff}`;
    const from = group !== '' ? 'group' : stuff !== '' ? 'material' : 'nothing';
    for (const instance of instancesOf(obj, corners, weld, size)) {
      const { area } = measure(obj, instance);
      if (area > 1e-9 * size * size)
        parts.push({ label: label || 'anonymous', from, material, corners: instance, area });
    }
  }
  return parts;
}

/** @returns {number[][]} the surface's corners, whole or taken apart */
function instancesOf(obj, corners, weld, size) {
  let pieces = components(corners, weld).map((list) => ({ corners: list, ...measure(obj, list) }));
  pieces = mergeCrumbs(pieces, obj, size);
  if (pieces.length > 1 && pieces.length <= mostInstances && pieces.every((piece) => alike(piece, pieces[0]))) {
    return pieces.map((piece) => piece.corners);
  }
  const apart = mergeTouching(pieces, size * touchDistance);
  return apart.length <= mostInstances ? apart : [corners];
}

const alike = (a, b) =>
  Math.abs(a.area - b.area) < sameSize * b.area && Math.abs(a.radius - b.radius) < sameSize * b.radius;

/** Triangles that share welded vertices. @returns {number[][]} corners */
function components(corners, weld) {
  const root = new Map();
  const find = (v) => {
    let top = v;
    while (root.get(top) !== top) top = root.get(top);
    for (let at = v; at !== top; ) [at] = [root.get(at), root.set(at, top)];
    return top;
  };
  const vertex = (i) => weld[corners[3 * i]];
  for (let i = 0; i < corners.length / 3; i++) if (!root.has(vertex(i))) root.set(vertex(i), vertex(i));
  for (let i = 0; i < corners.length / 3; i += 3) {
    for (const k of [1, 2]) root.set(find(vertex(i + k)), find(vertex(i)));
  }
  const lists = new Map();
  for (let i = 0; i < corners.length / 3; i += 3) {
    const top = find(vertex(i));
    if (!lists.has(top)) lists.set(top, []);
    const list = lists.get(top);
    for (let k = 3 * i; k < 3 * i + 9; k++) list.push(corners[k]);
  }
  return [...lists.values()];
}

/** Pieces that are small beside the model and the surface's largest go to the nearest larger one. */
function mergeCrumbs(pieces, obj, size) {
  const largest = Math.max(...pieces.map((piece) => piece.extent));
  const isCrumb = (piece) => piece.extent < Math.min(crumbSize * size, largest / 2);
  const kept = pieces.filter((piece) => !isCrumb(piece)).map((piece) => ({ ...piece, lists: [piece.corners] }));
  for (const crumb of pieces.filter(isCrumb)) {
    kept.reduce((best, piece) => (gap(piece, crumb) < gap(best, crumb) ? piece : best)).lists.push(crumb.corners);
  }
  return kept.map(({ lists, ...piece }) => {
    if (lists.length === 1) return piece;
    const list = lists.flat();
    return { corners: list, ...measure(obj, list) };
  });
}

/** @returns {number[][]} corners of the pieces whose boxes are nearer than `distance` to each other, put together */
function mergeTouching(pieces, distance) {
  const group = pieces.map((_, i) => i);
  for (let i = 0; i < pieces.length; i++) {
    for (let j = 0; j < i; j++) {
      if (group[i] === group[j] || gap(pieces[i], pieces[j]) > distance) continue;
      const [from, to] = [group[i], group[j]];
      for (let k = 0; k < group.length; k++) if (group[k] === from) group[k] = to;
    }
  }
  return [...new Set(group)].map((g) => pieces.filter((_, i) => group[i] === g).flatMap((piece) => piece.corners));
}

/** Distance between boxes. */
const gap = (a, b) => Math.hypot(...[0, 1, 2].map((k) => Math.max(0, a.low[k] - b.high[k], b.low[k] - a.high[k])));

/** Area, bounds, diagonal of the bounds, and root mean square distance of the vertices from their mean. */
function measure({ positions }, corners) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const sum = [0, 0, 0];
  let squares = 0;
  let area = 0;
  for (let i = 0; i < corners.length; i += 9) {
    const [p, q, r] = [3 * corners[i], 3 * corners[i + 3], 3 * corners[i + 6]];
    const u = (k) => positions[q + k] - positions[p + k];
    const v = (k) => positions[r + k] - positions[p + k];
    area += Math.hypot(u(1) * v(2) - u(2) * v(1), u(2) * v(0) - u(0) * v(2), u(0) * v(1) - u(1) * v(0)) / 2;
    for (const vertex of [p, q, r]) {
      for (let k = 0; k < 3; k++) {
        const x = positions[vertex + k];
        if (x < low[k]) low[k] = x;
        if (x > high[k]) high[k] = x;
        sum[k] += x;
        squares += x * x;
      }
    }
  }
  const count = corners.length / 3;
  const spread = squares / count - sum.reduce((total, s) => total + (s / count) ** 2, 0);
  const extent = Math.hypot(...high.map((h, k) => h - low[k]));
  return { area, low, high, extent, radius: Math.sqrt(Math.max(0, spread)) };
}

function diagonal({ positions, surfaces }) {
  return surfaces.length === 0
    ? 0
    : measure(
        { positions },
        surfaces.flatMap(({ corners }) => corners),
      ).extent;
}

/** A number for every position, the same for those in the same cell of a grid. */
function welded(positions, cell) {
  const cells = new Map();
  const numbers = new Int32Array(positions.length / 3);
  for (let i = 0; i < numbers.length; i++) {
    const key = [0, 1, 2].map((k) => Math.round(positions[3 * i + k] / cell)).join();
    if (!cells.has(key)) cells.set(key, cells.size);
    numbers[i] = cells.get(key);
  }
  return numbers;
}
