// Gaps filled by surfaces built anew, held against what is known of boxes, and read back by the core.
import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { MeshoptSimplifier } from 'meshoptimizer';
import { beforeAll, describe, expect, it } from 'vitest';
import { fillFile } from '../../web/src/fill/file';
import { fillGap } from '../../web/src/fill/fill';
import { contactOf, Parts } from '../../web/src/fill/gap';
import { PointGrid } from '../../web/src/fill/points';
import { loadPoisson } from '../../web/src/fill/poisson';
import { diskSamples, randomNumbers } from '../../web/src/fill/samples';
import { SurfaceTree } from '../../web/src/fill/surface';
import type { FilledGap, Reconstruct } from '../../web/src/fill/types';
import { partsOf } from '../../web/src/solid/parts';
import type { Triangles } from '../../web/src/solid/types';
import { boundsOf } from '../../web/src/solid/weld';
import { toGlb } from '../../web/tools/glb.mjs';
import { stool, stoolGltf } from '../e2e/fixture';
import { boxOf, type Vec } from './boxes';
import { call, loadModule } from './module';

const moved = ({ positions, triangles }: Triangles, by: Vec): Triangles => ({
  positions: positions.map((x, i) => x + (by[i % 3] as number)),
  triangles,
});

const seat = boxOf([0, 0, 420], [400, 400, 450]);
const leg = boxOf([20, 20, 0], [60, 60, 420]);
const half = 360;

let reconstruct: Reconstruct;
beforeAll(async () => {
  // The module is for pages: what it asks of its surroundings when it starts.
  Object.assign(globalThis, { self: { location: { href: '' } }, importScripts: () => {} });
  const { default: create } = await import('parsel-module/poisson.mjs');
  const path = fileURLToPath(new URL('../../build/wasm/wasm/poisson.wasm', import.meta.url));
  const compiled = await WebAssembly.compile(await readFile(path));
  reconstruct = await loadPoisson(create, {
    instantiateWasm(imports, receive) {
      const instance = new WebAssembly.Instance(compiled, imports);
      receive(instance);
      return instance.exports;
    },
  });
  await MeshoptSimplifier.ready;
});

/** The seat and a leg, which comes down by so many millimetres. */
function lowered(by: number): FilledGap | null {
  const parts = new Parts(
    [
      { rest: seat, edited: seat },
      { rest: leg, edited: moved(leg, [0, 0, -by]) },
    ],
    half,
  );
  const contact = contactOf(parts, [0, 1]);
  if (contact === null) return null;
  expect(contact.width).toBeCloseTo(by, 6);
  return fillGap(parts, contact, reconstruct);
}

describe('points of a surface', () => {
  it('lie on it, in the box, no nearer to each other than the radius, everywhere', () => {
    const limits = { low: [0, 0, 440], high: [100, 100, 460] };
    const samples = diskSamples(0, seat, limits, 5, () => true);
    const grid = new PointGrid(5);
    for (const { at, normal } of samples) {
      expect(at.every((x, k) => x >= (limits.low[k] as number) - 1e-9 && x <= (limits.high[k] as number) + 1e-9)).toBe(
        true,
      );
      expect(grid.nearest(...at, (id) => samples[id]?.normal.every((x, k) => x === normal[k]) ?? false)).toBe(-1);
      grid.add(...at);
    }
    const top = new PointGrid(12.5);
    for (const { at, normal } of samples) if (normal[2] === 1) top.add(...at);
    const random = randomNumbers(7);
    for (let i = 0; i < 500; i++) expect(top.near(100 * random(), 100 * random(), 450)).toBe(true);
  });
});

describe('screened Poisson reconstruction', () => {
  it('gives back the box that was sampled, closed', () => {
    const cube = boxOf([0.25, 0.25, 0.25], [0.75, 0.75, 0.75]);
    const samples = diskSamples(0, cube, { low: [0, 0, 0], high: [1, 1, 1] }, 0.02, () => true);
    const { positions, triangles } = reconstruct(
      Float32Array.from(samples.flatMap(({ at, normal }) => [...at, ...normal])),
      6,
    );
    const tree = new SurfaceTree(cube);
    for (let i = 0; i < positions.length; i += 3) {
      const [x = 0, y = 0, z = 0] = positions.subarray(i, i + 3);
      expect(tree.nearest(x, y, z, 1)?.distance).toBeLessThan(0.02);
    }
    const edges = new Map<string, number>();
    for (let t = 0; t < triangles.length; t += 3)
      for (let k = 0; k < 3; k++) {
        const [a, b] = [triangles[t + k] as number, triangles[t + ((k + 1) % 3)] as number];
        const key = `${Math.min(a, b)} ${Math.max(a, b)}`;
        edges.set(key, (edges.get(key) ?? 0) + (a < b ? 1 : -1));
      }
    expect([...edges.values()].every((balance) => balance === 0)).toBe(true);
  });
});

describe('a gap', () => {
  it('between faces that touched is filled all around, and nothing lies outside of it', () => {
    const by = 10;
    const filled = lowered(by);
    expect(filled?.left).toBe('');
    const [upper, lower] = filled?.patches ?? [];
    expect([upper?.part, lower?.part]).toEqual([0, 1]);
    const radius = by / 4;
    for (const patch of filled?.patches ?? []) {
      const { low, high } = boundsOf(patch.positions);
      expect(Math.min(...low.slice(0, 2))).toBeGreaterThan(20 - 4 * radius);
      expect(Math.max(...high.slice(0, 2))).toBeLessThan(60 + 4 * radius);
      expect(low[2]).toBeGreaterThan(420 - by - 4 * radius);
      expect(high[2]).toBeLessThan(420 + 2 * radius);
    }
    // At half its height there is a wall wherever one looks from inside.
    const walls = new SurfaceTree({
      positions: Float64Array.from((filled?.patches ?? []).flatMap(({ positions }) => [...positions])),
      triangles: Uint32Array.from([
        ...(upper?.triangles ?? []),
        ...(lower?.triangles ?? []).map((i) => i + (upper?.positions.length ?? 0) / 3),
      ]),
    });
    for (let i = 0; i < 40; i++) {
      const [x, y] = [0, 1].map(
        (k) => 40 + 20 * Math.max(-1, Math.min(1, 1.5 * Math.sin((i / 40) * 2 * Math.PI + (k * Math.PI) / 2))),
      );
      expect(walls.nearest(x as number, y as number, 420 - by / 2, 100)?.distance).toBeLessThan(3 * radius);
    }
  });

  it('has new triangles that belong to the nearer part, next to places of it', () => {
    for (const { part, positions, triangles, places } of lowered(8)?.patches ?? []) {
      const [own, other] = part === 0 ? [seat, moved(leg, [0, 0, -8])] : [moved(leg, [0, 0, -8]), seat];
      const [near, far] = [new SurfaceTree(own), new SurfaceTree(other)];
      expect(places.length).toBe(positions.length / 3);
      expect(Math.max(...triangles)).toBeLessThan(places.length);
      expect(places.every((place) => place.part === part && place.triangle < 12)).toBe(true);
      for (let t = 0; t < triangles.length; t += 3) {
        const centre = [0, 1, 2].map((k) =>
          [0, 1, 2].reduce((sum, q) => sum + (positions[3 * (triangles[t + q] as number) + k] as number) / 3, 0),
        ) as [number, number, number];
        const distances = [near, far].map((tree) => tree.nearest(...centre, 100)?.distance ?? 100);
        expect(distances[0]).toBeLessThan((distances[1] as number) + 2);
      }
    }
  });

  it('that is wider than the parts are thick is left, and says why', () => {
    expect(lowered(60)).toMatchObject({ patches: [], left: expect.stringContaining('does not reach across') });
  });

  it('is none between parts that never touched', () => {
    const parts = new Parts(
      [seat, boxOf([20, 20, 500], [60, 60, 600])].map((part) => ({ rest: part, edited: part })),
      half,
    );
    expect(contactOf(parts, [0, 1])).toBeNull();
  });
});

describe('a file', () => {
  interface Opened {
    parts: { id: string; label: string; node: number; primitive: number; virtual: boolean }[];
    relations: { kind: string; parts: string[] }[];
  }

  it('keeps its nodes, names, materials and corners, and opens as the same parts', async () => {
    const core = await loadModule();
    const shape = call<{ shape: Opened }>(core, 'open', { name: 'stool', external: [] }, [new Uint8Array(stool)]).result
      .shape;
    const legs = shape.parts.filter(({ label, virtual }) => label === 'leg' && !virtual);
    const real = shape.parts.filter(({ virtual }) => !virtual);
    // Legs that share a mesh, one of them lower: the file itself is changed, as an edit would.
    const { json, binary } = stoolGltf();
    const nodes = (json as { nodes: { translation?: number[] }[] }).nodes;
    const node = nodes[legs[0]?.node ?? 0];
    if (node === undefined) throw new Error('the stool has no legs');
    node.translation = (node.translation ?? [0, 0, 0]).map((x, k) => (k === 1 ? x - 0.01 : x));
    const edited = toGlb({ json, binary });
    const pairs = shape.relations.flatMap(({ kind, parts }): [number, number][] => {
      const [a, b] = parts.map((id) => real.findIndex((part) => part.id === id));
      return ['point', 'line', 'face', 'volume'].includes(kind) &&
        a !== undefined &&
        b !== undefined &&
        a >= 0 &&
        b >= 0
        ? [[a, b]]
        : [];
    });
    const { glb, gaps, lost } = await fillFile(new Uint8Array(stool), edited, real, pairs, reconstruct);
    expect(gaps.map(({ left }) => left)).toEqual(['']);
    expect(lost).toEqual([]);
    const [before, after] = [await partsOf(edited, new Map()), await partsOf(glb, new Map())];
    expect(after.map(({ name, node: n }) => [name, n])).toEqual(before.map(({ name, node: n }) => [name, n]));
    const grown = new Set(gaps[0]?.parts.map((i) => real[i]?.node));
    for (const [i, part] of before.entries()) {
      const now = after[i] as (typeof after)[number];
      expect(now.positions.slice(0, part.positions.length)).toEqual(part.positions);
      expect(now.triangles.slice(0, part.triangles.length)).toEqual(part.triangles);
      if (!grown.has(part.node)) expect(now.triangles.length).toBe(part.triangles.length);
    }
    const again = call<{ shape: Opened }>(core, 'open', { name: 'stool', external: [] }, [glb]).result.shape;
    const named = ({ parts }: Opened) =>
      parts.filter(({ virtual }) => !virtual).map(({ label, node: n }) => [label, n]);
    expect(named(again)).toEqual(named(shape));
  });

  it('without a gap comes back byte for byte', async () => {
    const places = [0, 1, 2].map((node) => ({ node, primitive: 0 }));
    const { glb, gaps } = await fillFile(stool, stool, places, [[0, 1]], reconstruct);
    expect(gaps).toEqual([]);
    expect(Buffer.compare(glb, stool)).toBe(0);
  });
});
