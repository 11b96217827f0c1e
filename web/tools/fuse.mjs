// A model's parts fused by boolean union into one surface: what a scan or a sculpted model of it looks like. One mesh, one
// material, no names.
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { root } from './core.mjs';
import { meshGlb } from './glb.mjs';

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
  return meshGlb(points, triangles, {
    generator: 'ParSEL',
    material: { pbrMetallicRoughness: { baseColorFactor: [0.6, 0.6, 0.6, 1], metallicFactor: 0 } },
  });
}
