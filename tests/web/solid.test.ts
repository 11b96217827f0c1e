// Parts united for printers, held against what is known of them: volumes of boxes, edges in pairs, our own readers.
import { createRequire } from 'node:module';
import { describe, expect, it } from 'vitest';
import { convert } from '../../web/src/formats/convert';
import type { Format } from '../../web/src/formats/model';
import { fileLimits } from '../../web/src/session/files';
import { loadManifold } from '../../web/src/solid/manifold';
import { partsOf } from '../../web/src/solid/parts';
import { writeStl } from '../../web/src/solid/stl';
import { writeThreeMf } from '../../web/src/solid/threemf';
import type { Part, Solid } from '../../web/src/solid/types';
import { unite } from '../../web/src/solid/unite';
import { turnedOver, volumeOf, weld } from '../../web/src/solid/weld';
import { stool } from '../e2e/fixture';
import { boxOf, type Vec } from './boxes';

const require = createRequire(new URL('../../web/package.json', import.meta.url));
const manifold = await loadManifold(require.resolve('manifold-3d/manifold.wasm'));

const box = (name: string, low: Vec, high: Vec): Part => ({ name, node: 0, ...boxOf(low, high) });

const made = (parts: readonly Part[]) => unite(parts, manifold, false, () => {});
function solidOf(parts: readonly Part[]): Solid {
  const { solid, faults } = made(parts);
  expect(faults).toEqual([]);
  return solid as Solid;
}

const insideOut = (part: Part): Part => ({ ...part, triangles: turnedOver(part.triangles) });
/** Without its last face. */
const opened = (part: Part): Part => ({ ...part, triangles: part.triangles.subarray(0, 30) });
/** Several as one part. */
function asOne(name: string, parts: readonly Part[]): Part {
  const positions: number[] = [];
  const triangles: number[] = [];
  for (const part of parts) {
    const first = positions.length / 3;
    positions.push(...part.positions);
    triangles.push(...part.triangles.map((corner) => corner + first));
  }
  return { name, node: 0, positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}
/** A box with an upper corner pushed down through its floor: closed, and running through itself. */
function pushedThrough(name: string): Part {
  const part = box(name, [0, 0, 0], [10, 10, 10]);
  const positions = part.positions.slice();
  for (let i = 0; i < positions.length; i += 3)
    if (positions.subarray(i, i + 3).every((value) => value === 10)) positions.set([5, 3, -5], i);
  return { ...part, positions };
}

/** Directed edges that lack their counterpart. */
function unpaired(triangles: ArrayLike<number>): number {
  const count = new Map<string, number>();
  for (let i = 0; i < triangles.length; i += 3)
    for (let k = 0; k < 3; k++) {
      const edge = `${triangles[i + k]}>${triangles[i + ((k + 1) % 3)]}`;
      count.set(edge, (count.get(edge) ?? 0) + 1);
    }
  return [...count].filter(([edge, n]) => n !== 1 || count.get(edge.split('>').reverse().join('>')) !== 1).length;
}

describe('parts that are united', () => {
  it.each([
    ['that overlap', [box('a', [0, 0, 0], [10, 10, 10]), box('b', [5, 5, 5], [15, 15, 15])], 2 * 1000 - 125, 1],
    ['that share a face', [box('a', [0, 0, 0], [10, 10, 10]), box('b', [10, 0, 0], [30, 10, 10])], 3000, 1],
    ['one in the other', [box('a', [0, 0, 0], [10, 10, 10]), box('b', [2, 2, 2], [3, 3, 3])], 1000, 1],
    ['that are apart', [box('a', [0, 0, 0], [10, 10, 10]), box('b', [20, 0, 0], [22, 10, 10])], 1200, 2],
  ])('boxes %s have the volume that boxes have', (_, parts, volume, pieces) => {
    const solid = solidOf(parts);
    expect(unpaired(solid.triangles)).toBe(0);
    expect(solid.volume).toBeCloseTo(volume, 3);
    expect(volumeOf(solid)).toBeCloseTo(volume, 3);
    expect(solid.pieces).toBe(pieces);
  });

  it('many bars that cross have the volume that counting cubes gives', () => {
    const bars: Part[] = [];
    const cells = new Set<string>();
    for (let i = 0; i < 5; i++) {
      for (const axis of [0, 1]) {
        const across = [2 * i + 1, 2 * i + 2] as const;
        const [x, y] = axis === 0 ? [[0, 11] as const, across] : [across, [0, 11] as const];
        bars.push(box(`bar ${axis}`, [x[0], y[0], 0], [x[1], y[1], 1]));
        for (let k = 0; k < 11; k++) cells.add(axis === 0 ? `${k},${2 * i + 1}` : `${2 * i + 1},${k}`);
      }
    }
    const solid = solidOf(bars);
    expect(solid.volume).toBeCloseTo(cells.size, 3);
    expect(unpaired(solid.triangles)).toBe(0);
  });

  it('a box in a box that faces inwards is a hollow, and one that faces inwards alone is turned', () => {
    const outer = box('ball', [0, 0, 0], [10, 10, 10]);
    const inner = insideOut(box('ball', [2, 2, 2], [8, 8, 8]));
    expect(solidOf([asOne('ball', [outer, inner])]).volume).toBeCloseTo(1000 - 216, 3);
    const { solid, turned } = made([insideOut(outer)]);
    expect(solid?.volume).toBeCloseTo(1000, 3);
    expect(turned).toEqual(['ball']);
  });

  it('triangles that stand there twice, or back to back between two boxes of one part, do not count', () => {
    const [a, b] = [box('a', [0, 0, 0], [10, 10, 10]), box('b', [10, 0, 0], [20, 10, 10])];
    expect(solidOf([asOne('both', [a, b])]).volume).toBeCloseTo(2000, 3);
    expect(solidOf([asOne('twice', [a, a])]).volume).toBeCloseTo(1000, 3);
  });

  it('two boxes of one part that meet along an edge are two solids', () => {
    const part = asOne('stairs', [box('a', [0, 0, 0], [10, 10, 10]), box('b', [10, 10, 0], [20, 20, 10])]);
    expect(solidOf([part]).volume).toBeCloseTo(2000, 3);
  });

  it('corners that rounding has pulled apart are one', () => {
    const part = box('a', [0, 0, 0], [1000, 10, 10]);
    const shaken = part.positions.map((value, i) => value + 1e-5 * Math.sin(7 * i));
    expect(solidOf([{ ...part, positions: shaken }]).volume).toBeCloseTo(100_000, -1);
  });

  it('the primitives of a node that are closed together are one solid', () => {
    const whole = box('seat', [0, 0, 0], [10, 10, 10]);
    const halves = [whole.triangles.subarray(0, 18), whole.triangles.subarray(18)];
    const parts = halves.map((triangles, i) => ({ ...whole, name: `seat ${i}`, triangles }));
    expect(solidOf(parts).volume).toBeCloseTo(1000, 3);
    const elsewhere = parts.map((part, node) => ({ ...part, node }));
    expect(made(elsewhere).faults.map(({ kind }) => kind)).toEqual(['open', 'open']);
  });
});

describe('what bounds no solid', () => {
  const sound = box('seat', [0, 0, 0], [10, 10, 10]);
  it.each([
    ['open', opened(box('leg', [0, 0, 0], [1, 1, 9])), 'is open at 4 edges'],
    ['crossing', pushedThrough('leg'), 'runs through itself'],
    ['flat', asOne('leg', [opened(sound), insideOut(opened(sound))]), 'is a surface without thickness'],
  ])('is named, and nothing is made: %s', (kind, part, text) => {
    const { solid, faults } = made([sound, part]);
    expect(solid).toBeNull();
    expect(faults).toEqual([{ name: 'leg', kind, text }]);
  });

  it('is left out when that is asked for', () => {
    const { solid, faults } = unite([sound, opened(box('leg', [0, 0, 0], [1, 1, 99]))], manifold, true, () => {});
    expect(solid?.volume).toBeCloseTo(1000, 3);
    expect(faults).toHaveLength(1);
    expect(unite([opened(sound)], manifold, true, () => {}).solid).toBeNull();
  });
});

describe('a file for printers', () => {
  const parts = [box('a', [0, 0, 0], [10, 10, 10]), box('b', [5, 5, 5], [15, 15, 15.5])];
  const solid = solidOf(parts);
  const files = {
    stl: (scale: number) => writeStl(solid, scale),
    '3mf': (scale: number) => writeThreeMf(solid, scale, 'a <chair> & "more"\u0001'),
  };
  /** As our own reader has it: in millimetres again, corners merged. */
  async function reread(bytes: Uint8Array, format: Format) {
    const source = { path: `model.${format}`, main: bytes, external: new Map() };
    const { glb, remarks } = await convert(source, format, fileLimits.bytes);
    expect(remarks).toEqual([]);
    const read = await partsOf(glb, new Map());
    expect(read).toHaveLength(1);
    return read[0] as Part;
  }

  it.each(['stl', '3mf'] as const)('%s opens in our own reader, closed, with its size and volume', async (format) => {
    for (const scale of [1, 0.01]) {
      const part = await reread(files[format](scale), format);
      const again = weld(part, 1e-6);
      expect(again.open).toBe(0);
      expect(unpaired(again.triangles)).toBe(0);
      expect(again.triangles.length).toBe(solid.triangles.length);
      expect(volumeOf(again) / scale ** 3).toBeCloseTo(solid.volume, 2);
      const on = [0, 1, 2].map((axis) => again.positions.filter((_, i) => i % 3 === axis));
      for (const [axis, values] of on.entries()) {
        expect(Math.min(...values)).toBeCloseTo(0, 5); // on the plate
        expect(Math.max(...values) / scale).toBeCloseTo([15, 15, 15.5][axis] as number, 3);
      }
    }
  });

  it('3MF names its object, whatever is in the name', async () => {
    expect((await reread(files['3mf'](1), '3mf')).name).toBe('a <chair> & "more"');
  });

  it('the same solid gives the same bytes', () => {
    for (const write of Object.values(files)) expect(Buffer.from(write(1)).equals(Buffer.from(write(1)))).toBe(true);
  });
});

describe('the parts of a file', () => {
  it('stand where they stand in the scene, in millimetres with z up, mirrored ones right side out', async () => {
    const parts = await partsOf(new Uint8Array(stool), new Map([['0/0', 'the seat']]));
    expect(parts.map(({ name }) => name)).toEqual(['the seat', 'leg', 'leg', 'leg', 'leg', ...Array(5).fill('slat')]);
    const volumes = parts.map((part) => volumeOf(part));
    expect(volumes[0]).toBeCloseTo(500 * 40 * 400, -2);
    for (const leg of volumes.slice(1, 5))
      expect(leg).toBeCloseTo(12 * 0.5 * 20 ** 2 * Math.sin(Math.PI / 6) * 400, -2);
    for (const slat of volumes.slice(5)) expect(slat).toBeCloseTo(30 * 300 * 12, -2);
    const [seat] = parts;
    const z = seat?.positions.filter((_, i) => i % 3 === 2) ?? [];
    expect([Math.min(...z), Math.max(...z)].map(Math.round)).toEqual([400, 440]);
  });
});
