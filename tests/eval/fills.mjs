// What closing and filling gaps does to the states in which parsel_eval saw a gap: prints a JSON line a state, then the sums.
//   node tests/eval/fills.mjs RESULTS MODELS [--only TEXT]     RESULTS: what parsel_eval wrote of the GLBs in MODELS
// Needs build/native-release/core/parsel and the WebAssembly modules. Lengths are millimetres; each is looked at in the files
// that are written, by code that took no part in writing them save for reading triangles and nearest places on surfaces:
//   gaps         attached parts that touched and came apart: after the edit, closed by parts made longer, filled, left
//   moved        the farthest that a corner that was there has moved by filling
//   apart        the farthest that filled parts are from each other in the file
//   off          the farthest that a new corner is from both parts, in widths of its gap
//   labels       the share of new surface that is nearer to its own part than to the other
//   uv           the farthest that a new corner's texture coordinates are from those of the nearest place of its part
//   overlap      the share of new corners that lie within a third part
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { root } from '../../web/tools/core.mjs';

const web = createRequire(join(root, 'web/package.json'));
const { runnerImport } = await import(pathToFileURL(web.resolve('vite')));
const load = async (file) => {
  const path = join(root, 'web/src', file);
  return (await runnerImport(path, { root: join(root, 'web'), configFile: false, logLevel: 'error' })).module;
};
const { fillFile } = await load('fill/file.ts');
const { loadPoisson } = await load('fill/poisson.ts');
const { SurfaceTree } = await load('fill/surface.ts');
const { boundsOf } = await load('solid/weld.ts');
const { placed, trianglesOf } = await load('solid/parts.ts');
const { NodeIO } = await import(pathToFileURL(web.resolve('@gltf-transform/core')));
const { ALL_EXTENSIONS } = await import(pathToFileURL(web.resolve('@gltf-transform/extensions')));
const { MeshoptSimplifier } = await import(pathToFileURL(web.resolve('meshoptimizer')));
await MeshoptSimplifier.ready;

/** The module is for pages: what it asks of its surroundings when it starts. */
globalThis.self = { location: { href: '' } };
globalThis.importScripts = () => {};
const module = join(root, 'build/wasm/wasm/poisson');
const { default: create } = await import(pathToFileURL(`${module}.mjs`));
const compiled = await WebAssembly.compile(readFileSync(`${module}.wasm`));
const reconstruct = await loadPoisson(create, {
  instantiateWasm(imports, receive) {
    const instance = new WebAssembly.Instance(compiled, imports);
    receive(instance);
    return instance.exports;
  },
});

const [results, models, ...options] = process.argv.slice(2);
if (models === undefined) throw new Error('usage: node fills.mjs RESULTS MODELS [--only TEXT]');
const only = options[0] === '--only' ? options[1] : '';
const tool = join(root, 'build/native-release/core/parsel');
const folder = mkdtempSync(join(tmpdir(), 'fills-'));
const parsel = (...args) => execFileSync(tool, args, { maxBuffer: 2 ** 30, encoding: 'utf8' });
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS);

/** Of the parts in a file: where their triangles stand, and their texture coordinates. */
async function look(glb, parts) {
  const nodes = (await io.readBinary(new Uint8Array(glb))).getRoot().listNodes();
  return parts.map(({ node, primitive: p }) => {
    const primitive = nodes[node]?.getMesh()?.listPrimitives()[p];
    if (!primitive) return null;
    const uv = primitive.getAttribute('TEXCOORD_0');
    return { ...placed(nodes[node], primitive, trianglesOf(primitive)), uv: uv?.getArray() ?? null };
  });
}

const corner = (positions, i) => [positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]];
const minus = (a, b) => a.map((x, k) => x - b[k]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Winding number of a closed surface about a point is about 1 (van Oosterom and Strackee 1983). */
function isWithin(p, { positions, triangles }) {
  let angle = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => minus(corner(positions, triangles[t + k]), p));
    const [la, lb, lc] = [a, b, c].map((v) => Math.hypot(...v));
    angle += 2 * Math.atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4 * Math.PI) > 0.5;
}

/** Texture coordinates at the place of a triangle that is nearest to a point of its plane. */
function uvAt(p, { positions, triangles, uv }, triangle) {
  const ids = [0, 1, 2].map((k) => triangles[3 * triangle + k]);
  const [a, b, c] = ids.map((i) => corner(positions, i));
  const [u, v, w] = [minus(b, a), minus(c, a), minus(p, a)];
  const [uu, uv_, vv, wu, wv] = [dot(u, u), dot(u, v), dot(v, v), dot(w, u), dot(w, v)];
  const area = uu * vv - uv_ * uv_;
  let [s, t] = area > 0 ? [(vv * wu - uv_ * wv) / area, (uu * wv - uv_ * wu) / area] : [0, 0];
  [s, t] = [Math.max(0, s), Math.max(0, t)];
  if (s + t > 1) [s, t] = [s / (s + t), t / (s + t)];
  return [0, 1].map((k) => (1 - s - t) * uv[2 * ids[0] + k] + s * uv[2 * ids[1] + k] + t * uv[2 * ids[2] + k]);
}

const sums = { states: 0, gaps: 0, after_closing: 0, filled: 0, left: 0, why: {}, moved: 0, apart: 0, off: 0 };
const share = { own: 0, area: 0, within: 0, corners: 0 };
let [texture, seconds, triangleCount] = [0, 0, 0];

async function measure(model, edit, x) {
  const glb = readFileSync(join(models, `${model}.glb`));
  const shape = JSON.parse(parsel('inspect', join(models, `${model}.glb`)));
  const program = join(results, 'programs', model, `${edit}.json`);
  const [layer] = JSON.parse(readFileSync(program, 'utf8')).layers;
  const recounted = layer.statements.filter(({ op }) => op === 'change_count').map(({ relation }) => relation);
  const moving = shape.relations.flatMap(({ id, parts }) => (recounted.includes(id) ? parts : []));
  const real = shape.parts.filter(({ virtual }) => !virtual);
  const pairs = shape.relations.flatMap(({ kind, parts }) => {
    const joined = ['point', 'line', 'face', 'volume'].includes(kind) && parts.every((id) => !moving.includes(id));
    const [a, b] = parts.map((id) => real.findIndex((part) => part.id === id));
    return joined && a >= 0 && b >= 0 ? [[a, b]] : [];
  });
  const write = (...how) => {
    const file = join(folder, 'out.glb');
    parsel(
      'apply',
      join(models, `${model}.glb`),
      program,
      '--set',
      `${layer.parameter.name}=${x}`,
      '--force',
      ...how,
      '-o',
      file,
    );
    return readFileSync(file);
  };
  const [edited, longer] = [write(), write('--repair')];
  const places = real.map(({ node, primitive }) => ({ node, primitive }));
  // Nothing is rebuilt where nothing can be: that counts gaps.
  const nothing = () => ({ positions: new Float32Array(0), triangles: new Uint32Array(0) });
  const open = (await fillFile(glb, edited, places, pairs, nothing)).gaps;
  const begin = process.cpuUsage().user;
  const { glb: filled, gaps } = await fillFile(glb, longer, places, pairs, reconstruct);
  seconds += (process.cpuUsage().user - begin) / 1e6;
  const [before, after] = [await look(longer, places), await look(filled, places)];
  const line = { model, edit, x, gaps: open.length, after_closing: gaps.length };
  line.filled = gaps.filter(({ left }) => left === '').length;
  line.left = gaps
    .filter(({ left }) => left !== '')
    .map(({ parts, width, left }) => [...parts.map((p) => real[p].id), width, left]);
  const worst = { moved: 0, apart: 0, off: 0, uv: 0 };
  const bounds = before.map((mesh) => mesh && boundsOf(mesh.positions));
  for (const [i, was] of before.entries()) {
    for (const [k, value] of (was?.positions ?? []).entries())
      worst.moved = Math.max(worst.moved, Math.abs(value - after[i].positions[k]));
  }
  for (const { parts, width, patches } of gaps.filter(({ left }) => left === '')) {
    const trees = parts.map((part) => new SurfaceTree(before[part]));
    const [a, b] = parts.map((part) => new SurfaceTree(after[part]));
    let least = Number.POSITIVE_INFINITY;
    for (const [tree, part] of [
      [a, parts[1]],
      [b, parts[0]],
    ]) {
      const { positions } = after[part];
      for (let i = before[part].positions.length / 3; i < positions.length / 3; i++)
        least = Math.min(least, tree.nearest(...corner(positions, i), 1e9).distance);
    }
    worst.apart = Math.max(worst.apart, least);
    for (const { part, positions, triangles } of patches) {
      const numbers = new Map();
      for (let i = before[part].positions.length / 3; i < after[part].positions.length / 3; i++)
        numbers.set(
          corner(after[part].positions, i)
            .map((v) => v.toFixed(3))
            .join(),
          i,
        );
      const [own, other] = parts[0] === part ? trees : [trees[1], trees[0]];
      triangleCount += triangles.length / 3;
      for (let t = 0; t < triangles.length; t += 3) {
        const [p, q, r] = [0, 1, 2].map((k) => corner(positions, triangles[t + k]));
        const centre = p.map((v, k) => (v + q[k] + r[k]) / 3);
        const area = Math.hypot(...cross(minus(q, p), minus(r, p))) / 2;
        share.area += area;
        if (own.nearest(...centre, 1e9).distance <= other.nearest(...centre, 1e9).distance) share.own += area;
      }
      for (let i = 0; i < positions.length / 3; i++) {
        const p = corner(positions, i);
        const [near, far] = [own.nearest(...p, 1e9), other.nearest(...p, 1e9)];
        worst.off = Math.max(worst.off, Math.min(near.distance, far.distance) / width);
        share.corners++;
        const inside = before.some((mesh, m) => {
          if (mesh === null || parts.includes(m)) return false;
          const { low, high } = bounds[m];
          return p.every((v, k) => v > low[k] && v < high[k]) && isWithin(p, mesh);
        });
        if (inside) share.within++;
        const { uv } = after[part];
        if (uv === null) continue;
        const at = numbers.get(p.map((v) => v.toFixed(3)).join());
        if (at === undefined) continue;
        const wanted = uvAt(p, before[part], near.triangle);
        worst.uv = Math.max(worst.uv, Math.hypot(uv[2 * at] - wanted[0], uv[2 * at + 1] - wanted[1]));
      }
    }
  }
  sums.states++;
  sums.gaps += open.length;
  sums.after_closing += gaps.length;
  sums.filled += line.filled;
  sums.left += line.left.length;
  for (const [, , , why] of line.left) sums.why[why] = (sums.why[why] ?? 0) + 1;
  for (const key of ['moved', 'apart', 'off']) sums[key] = Math.max(sums[key], worst[key]);
  texture = Math.max(texture, worst.uv);
  process.stdout.write(`${JSON.stringify({ ...line, ...worst })}\n`);
}

const records = readFileSync(join(results, 'results.jsonl'), 'utf8')
  .trim()
  .split('\n')
  .map((line) => JSON.parse(line));
/** Narrower ones are none; of the half-diagonal. */
const narrowest = 0.002;
for (const { kind, model, edit, ends = [] } of records) {
  if (kind !== 'edit' || !`${model}/${edit}`.includes(only)) continue;
  for (const { x, gap } of ends) if (gap > narrowest) await measure(model, edit, x);
}
rmSync(folder, { recursive: true });
const { own, area, within, corners } = share;
process.stdout.write(
  `${JSON.stringify({ ...sums, labels: own / area, overlap: within / corners, uv: texture, triangles: triangleCount, seconds })}\n`,
);
