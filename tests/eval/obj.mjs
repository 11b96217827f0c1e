// Wavefront OBJ and MTL, as far as furniture libraries use them: polygons by object, group and material; lines, points
// and curves are left out.

/**
 * @typedef {{ name: string, material: string, corners: number[] }} Surface triangles of one object or group and one
 *   material: three corners each, (position, texture coordinate, normal) indices, -1 where there is none
 * @typedef {{ positions: number[], uvs: number[], normals: number[], surfaces: Surface[] }} Obj positions and normals ×
 *   3, texture coordinates × 2
 */

/** @param {string} text @returns {Obj} throws an Error on an index without its vertex or a number that is none */
export function readObj(text) {
  const obj = { positions: [], uvs: [], normals: [], surfaces: [] };
  const surfaces = new Map();
  let name = '';
  let material = '';
  let surface = null;
  for (const line of text.replaceAll(/\\\r?\n/g, ' ').split(/\r?\n/)) {
    const [word, ...rest] = line.trim().split(/\s+/);
    if (word === 'v') pushNumbers(obj.positions, rest, 3);
    else if (word === 'vt') pushNumbers(obj.uvs, rest, 2);
    else if (word === 'vn') pushNumbers(obj.normals, rest, 3);
    else if (word === 'o' || word === 'g' || word === 'usemtl') {
      if (word === 'usemtl') material = rest.join(' ');
      else name = rest.join(' ');
      surface = null;
    } else if (word === 'f') {
      if (surface === null) {
        const key = `${name}\n${material}`;
        if (!surfaces.has(key)) surfaces.set(key, { name, material, corners: [] });
        surface = surfaces.get(key);
      }
      const corners = rest.map((corner) => readCorner(corner, obj));
      for (const i of triangulate(corners.map(([v]) => obj.positions.slice(3 * v, 3 * v + 3)))) {
        surface.corners.push(...corners[i]);
      }
    }
  }
  obj.surfaces = [...surfaces.values()].filter(({ corners }) => corners.length > 0);
  return obj;
}

function pushNumbers(target, words, count) {
  for (let i = 0; i < count; i++) {
    const value = Number(words[i] ?? 0);
    if (!Number.isFinite(value)) throw new Error(`"${words[i]}" is not a number`);
    target.push(value);
  }
}

function readCorner(corner, { positions, uvs, normals }) {
  const counts = [positions.length / 3, uvs.length / 2, normals.length / 3];
  return corner
    .split('/')
    .concat('', '')
    .slice(0, 3)
    .map((word, i) => {
      if (word === '') return -1;
      const index = Number(word) < 0 ? counts[i] + Number(word) : Number(word) - 1;
      if (index >= 0 && index < counts[i]) return index;
      if (i > 0) return -1; // a face without its texture or normal can still be shown
      throw new Error(`face corner ${corner} has no vertex`);
    });
}

/** Ear clipping in the polygon's own plane; a fan where that finds no ear. @returns indices, three a triangle */
function triangulate(points) {
  if (points.length < 4) return points.length === 3 ? [0, 1, 2] : [];
  const normal = [0, 0, 0]; // Newell's
  points.forEach((p, i) => {
    const q = points[(i + 1) % points.length];
    for (let k = 0; k < 3; k++) {
      const [a, b] = [(k + 1) % 3, (k + 2) % 3];
      normal[k] += (p[a] - q[a]) * (p[b] + q[b]);
    }
  });
  const drop = normal.map(Math.abs).indexOf(Math.max(...normal.map(Math.abs)));
  const [a, b] = normal[drop] < 0 ? [(drop + 2) % 3, (drop + 1) % 3] : [(drop + 1) % 3, (drop + 2) % 3];
  const turn = (i, j, k) =>
    (points[j][a] - points[i][a]) * (points[k][b] - points[i][b]) -
    (points[j][b] - points[i][b]) * (points[k][a] - points[i][a]);
  const left = points.map((_, i) => i);
  const triangles = [];
  while (left.length > 3) {
    let ear = left.findIndex((j, at) => {
      const [i, k] = [left.at(at - 1), left[(at + 1) % left.length]];
      if (turn(i, j, k) <= 0) return false;
      return left.every(
        (p) => p === i || p === j || p === k || turn(i, j, p) < 0 || turn(j, k, p) < 0 || turn(k, i, p) < 0,
      );
    });
    if (ear < 0) ear = 1;
    triangles.push(left.at(ear - 1), left[ear], left[(ear + 1) % left.length]);
    left.splice(ear, 1);
  }
  return [...triangles, ...left];
}

/**
 * @param {string} text
 * @returns {Map<string, { colour: number[], opacity: number, shininess: number, texture: string | null }>} by name;
 *   colour as written, that is in sRGB; texture: the file name as written
 */
export function readMtl(text) {
  const materials = new Map();
  let material = null;
  for (const line of text.split(/\r?\n/)) {
    const [word, ...rest] = line.trim().split(/\s+/);
    if (word === 'newmtl') {
      material = { colour: [0.8, 0.8, 0.8], opacity: 1, shininess: 0, texture: null };
      materials.set(rest.join(' '), material);
    } else if (material === null) continue;
    else if (word === 'Kd') material.colour = [0, 1, 2].map((i) => Number(rest[i] ?? rest[0]));
    else if (word === 'd') material.opacity = Number(rest[0]);
    else if (word === 'Ns') material.shininess = Number(rest[0]);
    // Options such as -s 1 1 1 stand before the name.
    else if (word === 'map_Kd') material.texture = rest.join(' ').replace(/^(-\w+ ([\d.-]+ )*)+/, '');
  }
  return materials;
}
