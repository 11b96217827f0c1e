// Models of very many triangles, for benchmarks and tests: one mesh each, without names.

/**
 * @param {Float32Array} positions three numbers a corner, in metres
 * @param {Uint32Array} triangles
 * @param {number} [mode] of glTF; 0: points
 * @returns {Buffer} a GLB
 */
export function oneMesh(positions, triangles, mode = 4) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; i++) {
    low[i % 3] = Math.min(low[i % 3], positions[i]);
    high[i % 3] = Math.max(high[i % 3], positions[i]);
  }
  const indexed = triangles.length > 0;
  const json = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ mode, attributes: { POSITION: 0 }, ...(indexed && { indices: 1 }) }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, type: 'VEC3', count: positions.length / 3, min: low, max: high },
      ...(indexed ? [{ bufferView: 1, componentType: 5125, type: 'SCALAR', count: triangles.length }] : []),
    ],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: positions.byteLength },
      ...(indexed ? [{ buffer: 0, byteOffset: positions.byteLength, byteLength: triangles.byteLength }] : []),
    ],
    buffers: [{ byteLength: positions.byteLength + triangles.byteLength }],
  };
  const text = Buffer.from(JSON.stringify(json));
  const padded = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, 0x20)]);
  const chunk = (type, data) => {
    const head = Buffer.alloc(8);
    head.writeUInt32LE(data.length, 0);
    head.writeUInt32LE(type, 4);
    return Buffer.concat([head, data]);
  };
  const binary = Buffer.concat([positions, triangles].map((array) => Buffer.from(array.buffer)));
  const chunks = Buffer.concat([chunk(0x4e4f534a, padded), chunk(0x004e4942, binary)]);
  const head = Buffer.alloc(12);
  head.write('glTF', 0);
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + chunks.length, 8);
  return Buffer.concat([head, chunks]);
}

/**
 * Closed balls on a grid, one mesh.
 * @param {number} balls how many
 * @param {number} rings each has 2 rings (rings − 1) · 2 triangles
 * @param {(x: number, y: number, z: number) => number} [radius] by direction: a scan is no ball
 */
export function ballsOf(balls, rings, radius = () => 0.4) {
  const [across, around] = [Math.ceil(Math.cbrt(balls)), 2 * rings];
  const corners = (rings - 1) * around + 2;
  const positions = new Float32Array(3 * balls * corners);
  const triangles = new Uint32Array(3 * balls * 2 * around * (rings - 1));
  let [p, t] = [0, 0];
  for (let ball = 0; ball < balls; ball++) {
    const centre = [ball % across, Math.floor(ball / across) % across, Math.floor(ball / across ** 2)];
    const first = p / 3;
    const add = (x, y, z) => {
      const r = radius(x, y, z);
      positions.set([centre[0] + r * x, centre[1] + r * y, centre[2] + r * z], p);
      p += 3;
    };
    add(0, 1, 0);
    for (let i = 1; i < rings; i++) {
      const up = (Math.PI * i) / rings;
      for (let j = 0; j < around; j++) {
        const round = (2 * Math.PI * j) / around;
        add(Math.sin(up) * Math.cos(round), Math.cos(up), Math.sin(up) * Math.sin(round));
      }
    }
    add(0, -1, 0);
    const at = (i, j) => first + 1 + (i - 1) * around + (j % around);
    for (let j = 0; j < around; j++) {
      triangles.set([first, at(1, j + 1), at(1, j)], t);
      t += 3;
      for (let i = 1; i < rings - 1; i++) {
        triangles.set([at(i, j), at(i, j + 1), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)], t);
        t += 6;
      }
      triangles.set([at(rings - 1, j), at(rings - 1, j + 1), first + corners - 1], t);
      t += 3;
    }
  }
  return oneMesh(positions, triangles);
}

/** A surface of a million triangles that is creased all over, as scans are: one component. */
export const scan = (rings = 501) => {
  const wave = (x, y, z) => 0.4 + 0.02 * Math.sin(40 * x) * Math.sin(40 * y) * Math.sin(40 * z);
  const grain = (x, y, z) => 0.0004 * Math.sin(1e5 * (x + 3 * y + 7 * z));
  return ballsOf(1, rings, (x, y, z) => wave(x, y, z) + grain(x, y, z));
};

/** Tetrahedra apart from each other, on a grid: what a fractal falls into. */
export function dust(count) {
  const across = Math.ceil(Math.cbrt(count));
  const positions = new Float32Array(12 * count);
  const triangles = new Uint32Array(12 * count);
  for (let i = 0; i < count; i++) {
    const [x, y, z] = [i % across, Math.floor(i / across) % across, Math.floor(i / across ** 2)];
    positions.set([x, y, z, x + 0.5, y, z, x, y + 0.5, z, x, y, z + 0.5], 12 * i);
    triangles.set(
      [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3].map((corner) => 4 * i + corner),
      12 * i,
    );
  }
  return oneMesh(positions, triangles);
}

/** Corners without any triangle. */
export const pointCloud = (count = 1000) =>
  oneMesh(
    Float32Array.from({ length: 3 * count }, (_, i) => Math.sin(i * i)),
    new Uint32Array(0),
    0,
  );
