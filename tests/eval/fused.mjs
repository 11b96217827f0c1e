// Models of the gallery fused by boolean union into one surface without names, and split again: how much of the surface
// lands in the right part.
//
//   node tests/eval/fused.mjs [--write FOLDER] [MODEL…]
//
// A piece and a part belong together one to one, so that as much area as possible is theirs: what is over on either side is
// in the wrong part. Area is that of the fused surface, each triangle of which Manifold knows the part of.

import { mkdirSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { argv } from 'node:process';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { loadCore, root } from '../../web/tools/core.mjs';
import { fuse } from '../../web/tools/fuse.mjs';

const inWeb = createRequire(join(root, 'web', 'package.json'));
const { runnerImport } = await import(inWeb.resolve('vite'));
const { partsOf } = (await runnerImport(join(root, 'web', 'src', 'solid', 'parts.ts'))).module;

/** Area and key of each triangle; keys are the places of its corners, in whichever order. */
function* triangles({ positions, triangles: corners }) {
  const at = (i) => positions.subarray(3 * corners[i], 3 * corners[i] + 3);
  for (let i = 0; i < corners.length; i += 3) {
    const [a, b, c] = [at(i), at(i + 1), at(i + 2)];
    const [u, v] = [b, c].map((p) => [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
    const area = Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
    const key = [a, b, c]
      .map((p) => [...p].map((x) => Math.fround(x / 1000)).join())
      .sort()
      .join(' ');
    yield { area, key };
  }
}

/** The largest sum of areas of pairs in which nobody is twice (Kuhn 1955, by shortest augmenting paths). */
export function bestPairs(areas) {
  const size = Math.max(areas.length, ...areas.map((row) => row.length));
  const cost = (i, j) => -(areas[i - 1]?.[j - 1] ?? 0);
  const [u, v, mate] = [0, 0, 0].map(() => new Float64Array(size + 1));
  for (let i = 1; i <= size; i++) {
    const way = new Int32Array(size + 1);
    const least = new Float64Array(size + 1).fill(Infinity);
    const used = new Uint8Array(size + 1);
    mate[0] = i;
    let j0 = 0;
    do {
      used[j0] = 1;
      let delta = Infinity;
      let next = 0;
      for (let j = 1; j <= size; j++) {
        if (used[j]) continue;
        const reduced = cost(mate[j0], j) - u[mate[j0]] - v[j];
        if (reduced < least[j]) [least[j], way[j]] = [reduced, j0];
        if (least[j] < delta) [delta, next] = [least[j], j];
      }
      for (let j = 0; j <= size; j++) {
        if (used[j]) {
          u[mate[j]] += delta;
          v[j] -= delta;
        } else least[j] -= delta;
      }
      j0 = next;
    } while (mate[j0] !== 0);
    for (; j0 !== 0; j0 = way[j0]) mate[j0] = mate[way[j0]];
  }
  return v[0];
}

/** @returns {parts, pieces, by: how it was split, share: of the surface in the right part, and both GLBs} */
export async function measureFused(core, name, glb) {
  const fused = await fuse(glb);
  core('open', { name, external: [] }, [fused.glb]);
  const { result, buffers } = core('split', { by: 'auto', fine: 0.5 });
  const partOf = new Map();
  let [i, total] = [0, 0];
  for (const { area, key } of triangles(fused)) {
    partOf.set(key, fused.part[i++]);
    total += area;
  }
  const split = await partsOf(buffers[0], new Map());
  const areas = split.map((piece) => {
    const row = new Float64Array(fused.parts);
    for (const { area, key } of triangles(piece)) row[partOf.get(key)] += area;
    return row;
  });
  const share = bestPairs(areas) / total;
  return { parts: fused.parts, pieces: result.parts, by: result.by, share, fused: fused.glb, split: buffers[0] };
}

if (argv[1] && import.meta.url === pathToFileURL(argv[1]).href) {
  const { values, positionals } = parseArgs({ options: { write: { type: 'string' } }, allowPositionals: true });
  const core = await loadCore();
  const { result, buffers } = core('gallery', {});
  let [count, sum, enough] = [0, 0, 0];
  for (const [index, { id }] of result.models.entries()) {
    if (positionals.length > 0 && !positionals.includes(id)) continue;
    const { parts, pieces, share, fused, split } = await measureFused(core, id, buffers[index]);
    const [has, made] = [parts, pieces].map((value) => String(value).padStart(3));
    console.log(
      `${id.padEnd(14)} ${has} parts  ${made} pieces  ${(100 * share).toFixed(1).padStart(5)} % of the surface`,
    );
    if (values.write) {
      mkdirSync(values.write, { recursive: true });
      writeFileSync(join(values.write, `${id}_fused.glb`), fused);
      writeFileSync(join(values.write, `${id}_split.glb`), split);
    }
    count++;
    sum += share;
    if (share >= 0.7) enough++;
  }
  console.log(`${count} models: ${((100 * sum) / count).toFixed(1)} % in the mean; 70 % or more of ${enough}`);
}
