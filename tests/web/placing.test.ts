// How a model stands and how large it is: what seems wrong, what a turn does, and the way back to the file.
import { type Node, WebIO } from '@gltf-transform/core';
import { validateBytes } from 'gltf-validator';
import { describe, expect, it } from 'vitest';
import { apply } from '../../web/src/carve/matrix';
import {
  asInFile,
  axesOf,
  type Direction,
  directions,
  type Placing,
  turnedRound,
  turnedTo,
  turnedUp,
  vectorOf,
} from '../../web/src/carve/placing';
import type { Shape, ShapeRelation, Vec3 } from '../../web/src/program/types';
import { extentOf, isPlaced, placingOf, seemsDrawnIn, seemsFront, seemsUp } from '../../web/src/session/placing';
import { readSaved } from '../../web/src/share/saved';
import { stool } from '../e2e/fixture';
import { box, oneBox } from './box_shapes';
import { carve } from './carve_here';

const dot = (a: readonly number[], b: readonly number[]) => a.reduce((sum, value, i) => sum + value * (b[i] ?? 0), 0);
/** Where a direction of the file goes. */
const shown = (placing: Placing, direction: readonly number[]) => axesOf(placing).map((axis) => dot(axis, direction));

describe('a turn', () => {
  it.each(directions.filter((up) => up !== '+y'))('makes %s up, and is one', (up) => {
    const turned = turnedUp(asInFile, up);
    expect(shown(turned, vectorOf(up)).map((x) => x + 0)).toEqual([0, 1, 0]);
    const [x, y, z] = axesOf(turned);
    expect(dot([(x[1] ?? 0) * (y[2] ?? 0) - (x[2] ?? 0) * (y[1] ?? 0)], [1]) - (z[0] ?? 0)).toBeCloseTo(0, 12); // right-handed
  });

  it('of a model that was turned before is about how it stands then', () => {
    const back = turnedUp(asInFile, '+z');
    let now = back;
    for (let i = 0; i < 3; i++) now = turnedUp(now, '+z');
    expect(now).toEqual(asInFile);
    expect(turnedUp(back, '-z')).toEqual(asInFile);
    expect(turnedUp(turnedUp(asInFile, '+x'), '-x')).toEqual(asInFile);
  });

  it('round brings what is on its right to its front, and comes back after four', () => {
    const once = turnedRound(asInFile);
    expect(shown(once, [-1, 0, 0]).map((x) => x + 0)).toEqual([0, 0, 1]); // its right is −x
    expect(turnedRound(turnedRound(turnedRound(once)))).toEqual(asInFile);
  });
});

it.each([
  ['+z', [0, 0, 1]],
  ['-x', [-1, 0, 0]],
  ['-z', [0, 0, -1]],
  ['+x', [1, 0, 0]],
] as const)('turned until %s is the front, that is the front, and up stays', (side, vector) => {
  const turned = turnedTo(asInFile, side);
  expect(shown(turned, vector).map((x) => x + 0)).toEqual([0, 0, 1]);
  expect(shown(turned, [0, 1, 0]).map((x) => x + 0)).toEqual([0, 1, 0]);
});

describe('in the file', () => {
  const read = (glb: Uint8Array) => new WebIO().readBinary(new Uint8Array(glb));
  const files = (main: Uint8Array) => ({ main, external: new Map<string, Uint8Array>() });
  async function points(glb: Uint8Array): Promise<number[][]> {
    const nodes = (await read(glb)).getRoot().listNodes();
    return nodes.flatMap((node: Node) => {
      const position = node.getMesh()?.listPrimitives()[0]?.getAttribute('POSITION');
      const count = position?.getCount() ?? 0;
      return Array.from({ length: count }, (_, i) => apply(node.getWorldMatrix(), position?.getElement(i, []) ?? []));
    });
  }

  it('one node above all turns and scales; taken back, the model is where it was', async () => {
    const before = await points(stool);
    const step = { kind: 'place', up: '+z', front: '-y', metres: 0.01 } as const;
    const placed = await carve(files(stool), step);
    expect(placed).toMatchObject({ moved: [], made: [] });
    for (const [i, [x = 0, y = 0, z = 0]] of (await points(placed.glb)).entries()) {
      const [bx = 0, by = 0, bz = 0] = before[i] ?? [];
      expect(x).toBeCloseTo(0.01 * bx, 6);
      expect(y).toBeCloseTo(0.01 * bz, 6);
      expect(z).toBeCloseTo(-0.01 * by, 6);
    }
    const report = await validateBytes(placed.glb, { maxIssues: 0 });
    expect(report.issues.messages.filter(({ severity }) => severity < 2)).toEqual([]);

    // Another placing takes the place of the first: there is one such node.
    const again = await carve(files(placed.glb), { kind: 'place', ...asInFile });
    expect(await points(again.glb)).toEqual(before);
    const count = (await read(again.glb)).getRoot().listNodes().length;
    expect(count).toBe((await read(stool)).getRoot().listNodes().length + 1);
  });

  it('is remembered by the steps, the last of which counts', () => {
    const place = { kind: 'place', up: '+z', front: '-y', metres: 1 } as const;
    const main = new Uint8Array([1]);
    const whole = { name: 'chair', main, external: new Map() };
    expect(placingOf(whole)).toEqual(asInFile);
    expect(isPlaced(whole)).toBe(false);
    const steps = [place, { kind: 'divide', part: 'node:1/0' } as const];
    expect(placingOf({ ...whole, carved: { from: whole, steps } })).toMatchObject({ up: '+z', metres: 1 });
    expect(isPlaced({ ...whole, carved: { from: whole, steps } })).toBe(true);
    const back = { kind: 'place', ...asInFile } as const;
    expect(isPlaced({ ...whole, carved: { from: whole, steps: [...steps, back] } })).toBe(false);
  });

  it('is refused from elsewhere where the front is up as well', () => {
    const session = (up: string, front: string, metres: number) => ({
      format: 'parsel/session',
      version: 1,
      model: { name: 'chair', sha256: 'a'.repeat(64) },
      program: { format: 'parsel/program', version: 1, shape: { name: 'chair', sha256: '' }, layers: [] },
      off: [],
      hidden: [],
      names: [],
      carved: [{ kind: 'place', up, front, metres }],
    });
    expect(readSaved(session('+z', '-y', 0.01))).toMatchObject({ ok: true, saved: { carved: [{ up: '+z' }] } });
    for (const bad of [session('+z', '-z', 1), session('up', '+z', 1), session('+z', '+x', 0)])
      expect(readSaved(bad)).toMatchObject({ ok: true, lost: ['what was done to the parts by hand'] });
  });
});

/** A stool of a seat and four legs whose own up is a direction; its sides are mirror images. */
function standing(up: Direction, legs = 4): Shape {
  const placing = turnedUp(asInFile, up);
  const axes = axesOf(placing);
  // From how it would stand to where it is: what `up` says is +y there.
  const turn = (point: Vec3): Vec3 =>
    [0, 1, 2].map((i) => axes.reduce((sum, axis, k) => sum + (axis[i] ?? 0) * (point[k] ?? 0), 0)) as unknown as Vec3;
  const size = (half: Vec3): Vec3 => turn(half).map(Math.abs) as unknown as Vec3;
  const places = [
    [0.5, 0.4],
    [-0.5, 0.4],
    [0.5, -0.4],
    [-0.5, -0.4],
  ].slice(0, legs);
  const mirror: ShapeRelation = {
    id: 'r1',
    kind: 'reflection',
    parts: ['leg 0', 'leg 1'],
    origin: [0, 0, 0],
    normal: turn([1, 0, 0]),
    corner_map: [1, 0, 3, 2, 5, 4, 7, 6],
  };
  return {
    ...oneBox,
    frame: { centre: [0, 0, 0], scale: 0.5 },
    parts: [
      box('seat', 0, turn([0, 0.6, 0]), size([0.6, 0.05, 0.5])),
      ...places.map(([x = 0, z = 0], i) => box(`leg ${i}`, 1 + i, turn([x, 0, z]), size([0.05, 0.55, 0.05]))),
      box('back', 9, turn([0, 1, -0.45]), size([0.6, 0.4, 0.05])),
    ],
    relations: [mirror],
  };
}

describe('what seems to be up', () => {
  it.each(directions.filter((up) => up !== '+y'))('is %s where the feet say so', (up) => {
    expect(seemsUp(standing(up))).toBe(up);
  });
  it('is left alone where it stands, or nobody can say', () => {
    expect(seemsUp(standing('+y'))).toBe(null);
    expect(seemsUp(standing('+z', 2))).toBe(null);
    expect(seemsUp(oneBox)).toBe(null);
  });
  it('is left alone where mirror images speak against it', () => {
    const lying = standing('+z');
    const across = lying.relations.map((relation) => ({ ...relation, normal: vectorOf('+z') })) as ShapeRelation[];
    expect(seemsUp({ ...lying, relations: across })).toBe(null);
  });
});

describe('what seems to be the front', () => {
  /** A case with panels where labels say. */
  const of = (...labels: [label: string, centre: Vec3][]): Shape => ({
    ...oneBox,
    parts: [
      box('case', 0, [0, 0, 0], [0.5, 0.5, 0.5]),
      ...labels.map(([label, centre], i) => box(label, i + 1, centre, [0.1, 0.1, 0.1])),
    ],
  });
  it.each<[string, Direction, Shape]>([
    ['what is called front', '+x', of(['Drawer front', [0.6, 0, 0.05]])],
    ['what is called back, across from it', '-x', of(['BackPanel', [0.6, 0, 0]])],
    ['both', '-z', of(['front_door', [0.1, 0, -0.6]], ['rear', [0, 0, 0.6]])],
  ])('is told by %s', (_, front, shape) => {
    expect(seemsFront(shape)).toBe(front);
  });
  it.each<[string, Shape]>([
    ['stands as it should', of(['back', [0, 0, -0.6]])],
    ['has no such labels', of(['door', [0.6, 0, 0]], ['backpack', [0.6, 0, 0]])],
    ['has labels that contradict each other', of(['front door', [0.6, 0, 0]], ['back door', [0.6, 0, 0]])],
    ['has them in corners', of(['front left leg', [0.6, 0, -0.6]])],
    ['has them in the middle', of(['front', [0.1, 0, 0]])],
  ])('is left alone where the model %s', (_, shape) => {
    expect(seemsFront(shape)).toBe('+z');
  });
});

describe('the unit of the file', () => {
  const sized = (scale: number): Shape => ({ ...standing('+y'), frame: { centre: [0, 0, 0], scale } });
  const longest = Math.max(...extentOf(sized(1)));
  it.each<[string, number, number | null]>([
    ['a chair in metres', 0.9, null],
    ['a chair in millimetres', 900, 0.001],
    ['a chair in centimetres', 92, 0.01],
    ['a chair in inches, as one in centimetres', 36, 0.01],
    ['a house', 12, null],
    ['a chair that was made smaller a thousand times', 0.0009, 1000],
    ['a button', 0.03, null],
  ])('of %s, %d units long, is seen', (_, length, metres) => {
    expect(seemsDrawnIn(sized(length / longest), asInFile)).toBe(metres);
  });
  it('is not guessed again when it was given', () => {
    expect(seemsDrawnIn(sized(900 / longest), { ...asInFile, metres: 0.5 })).toBe(null);
  });
});
