// A model's parts fused by boolean union into one surface: what a scan or a sculpted model of it looks like. One mesh, one
// material, no names.
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { root } from './core.mjs';

const inWeb = createRequire(join(root, 'web', 'package.json'));
const { runnerImport } = await import(pathToFileURL(inWeb.resolve('vite')).href);
const load = async (file) => (await runnerImport(join(root, 'web', 'src', 'solid', file))).module;
const { partsOf } = await load('parts.ts');
const { shells, weld, boundsOf, joined } = await load('weld.ts');
const { aligned } = await load('align.ts');
const { default: createManifold } = await import(pathToFileURL(inWeb.resolve('manifold-3d/manifold.js')).href);
const manifold = await createManifold();
manifold.setup();
const { Manifold, Mesh } = manifold;

/**
 * @param glb a GLB whose parts are closed
 * @returns {glb, positions: in millimetres, z up, triangles, part: of each triangle, parts: how many there were}
 */
export async function fuse(glb) {
  const parts = await partsOf(glb, new Map());
  const { low, high } = boundsOf(joined(parts).positions);
  const diagonal = Math.hypot(...low.map((x, i) => high[i] - x));
  const flush = aligned(
    parts.map(({ positions }) => positions),
    1e-6 * diagonal,
  );
  const partOf = new Map();
  const solids = parts.flatMap((part, i) =>
    shells(weld({ ...part, positions: flush[i] }, 1e-6 * diagonal)).map(({ positions, triangles }) => {
      const id = Manifold.reserveIDs(1);
      partOf.set(id, i);
      const mesh = { numProp: 3, vertProperties: Float32Array.from(positions), triVerts: triangles };
      const run = { runIndex: Uint32Array.of(0, triangles.length), runOriginalID: Uint32Array.of(id) };
      return new Manifold(new Mesh({ ...mesh, ...run }));
    }),
  );
  const { vertProperties, triVerts, runIndex, runOriginalID } = Manifold.union(solids).getMesh();
  const part = new Uint32Array(triVerts.length / 3);
  for (const [run, id] of runOriginalID.entries()) part.fill(partOf.get(id), runIndex[run] / 3, runIndex[run + 1] / 3);
  return {
    glb: written(vertProperties, triVerts),
    positions: vertProperties,
    triangles: triVerts,
    part,
    parts: parts.length,
  };
}

/** A GLB in metres, y up. */
function written(positions, triangles) {
  const points = new Float32Array(positions.length);
  for (let i = 0; i < points.length; i += 3)
    points.set([positions[i] / 1000, positions[i + 2] / 1000, -positions[i + 1] / 1000], i);
  const bound = (pick) =>
    [0, 1, 2].map((k) => points.reduce((best, x, i) => (i % 3 === k ? pick(best, x) : best), points[k]));
  const json = {
    asset: { version: '2.0', generator: 'ParSEL' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1, material: 0 }] }],
    materials: [{ pbrMetallicRoughness: { baseColorFactor: [0.6, 0.6, 0.6, 1], metallicFactor: 0 } }],
    accessors: [
      {
        bufferView: 0,
        componentType: 5126,
        type: 'VEC3',
        count: points.length / 3,
        min: bound(Math.min),
        max: bound(Math.max),
      },
      { bufferView: 1, componentType: 5125, type: 'SCALAR', count: triangles.length },
    ],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: points.byteLength, target: 34962 },
      { buffer: 0, byteOffset: points.byteLength, byteLength: triangles.byteLength, target: 34963 },
    ],
    buffers: [{ byteLength: points.byteLength + triangles.byteLength }],
  };
  const text = Buffer.from(JSON.stringify(json));
  const chunk = (type, data, fill) => {
    const padding = Buffer.alloc((4 - (data.length % 4)) % 4, fill);
    const head = Buffer.alloc(8);
    head.writeUInt32LE(data.length + padding.length, 0);
    head.writeUInt32LE(type, 4);
    return Buffer.concat([head, data, padding]);
  };
  const binary = Buffer.concat([Buffer.from(points.buffer), Buffer.from(Uint32Array.from(triangles).buffer)]);
  const chunks = Buffer.concat([chunk(0x4e4f534a, text, 0x20), chunk(0x004e4942, binary, 0)]);
  const head = Buffer.alloc(12);
  head.write('glTF', 0);
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + chunks.length, 8);
  return Buffer.concat([head, chunks]);
}
