// Parts joined, split and cut in the file: what is kept to the byte, what is interpolated, what is closed, and what is refused.
import { Document, type Node, WebIO } from '@gltf-transform/core';
import { validateBytes } from 'gltf-validator';
import { describe, expect, it } from 'vitest';
import { apply } from '../../web/src/carve/matrix';
import { CarveError, type CarveStep, type Plane } from '../../web/src/carve/steps';
import { boxFaces, stool } from '../e2e/fixture';
import { tableInOnePiece } from '../e2e/one_mesh';
import { carve } from './carve_here';

const files = (main: Uint8Array) => ({ main, external: new Map<string, Uint8Array>() });
const read = (glb: Uint8Array) => new WebIO().readBinary(new Uint8Array(glb));
const nodeOf = (document: Document, name: string): Node => {
  const node = document
    .getRoot()
    .listNodes()
    .find((one) => one.getName() === name);
  if (node === undefined) throw new Error(`no node ${name}`);
  return node;
};

type Point = readonly [number, number, number];

/** Triangles of a node in the scene, a corner nine numbers apart. */
function trianglesOf(node: Node): Point[][] {
  const world = node.getWorldMatrix();
  return (node.getMesh()?.listPrimitives() ?? []).flatMap((primitive) => {
    const position = primitive.getAttribute('POSITION');
    const list = [...(primitive.getIndices()?.getArray() ?? [])];
    const corners = list.map((i) => apply(world, position?.getElement(i, []) ?? []) as Point);
    return Array.from({ length: corners.length / 3 }, (_, t) => corners.slice(3 * t, 3 * t + 3));
  });
}
const minus = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a: Point, b: Point): Point => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const normalOf = ([a, b, c]: Point[]): Point => cross(minus(b as Point, a as Point), minus(c as Point, a as Point));
const area = (triangles: Point[][]) => triangles.reduce((sum, one) => sum + Math.hypot(...normalOf(one)) / 2, 0);
/** Six times what triangles bound, as seen from outside counter-clockwise. */
const volume = (triangles: Point[][]) =>
  triangles.reduce((sum, [a, b, c]) => {
    const [p, q, r] = [a, b, c] as [Point, Point, Point];
    const [x, y, z] = cross(q, r);
    return sum + p[0] * x + p[1] * y + p[2] * z;
  }, 0);
/** Edges, by the places of their ends, that run one way more often than the other. */
function openEdges(triangles: Point[][]): number {
  const net = new Map<string, number>();
  for (const corners of triangles) {
    const at = corners.map((point) => point.map((x) => Math.fround(x) + 0).join());
    for (const [k, from] of at.entries()) {
      const to = at[(k + 1) % 3] ?? '';
      const key = from < to ? `${from} ${to}` : `${to} ${from}`;
      if (from !== to) net.set(key, (net.get(key) ?? 0) + (from < to ? 1 : -1));
    }
  }
  return [...net.values()].filter((value) => value !== 0).length;
}
const extent = (triangles: Point[][], axis: number) => {
  const all = triangles.flat().map((point) => point[axis] ?? 0);
  return [Math.min(...all), Math.max(...all)];
};

async function problems(glb: Uint8Array): Promise<string[]> {
  const report = await validateBytes(glb, { maxIssues: 0 });
  return report.issues.messages.filter(({ severity }) => severity < 2).map(({ code, pointer }) => `${code} ${pointer}`);
}

/** Nodes of the stool: 0 seat, 1 to 4 legs (2 is mirrored), 5 back, 6 to 10 slats. */
const seat = 'node:0/0';
const cutSeat = (plane: Plane): CarveStep => ({ kind: 'cut', parts: [seat], plane });

describe('a cut', () => {
  it('makes two parts of one, whose surface is that of the one and two lids', async () => {
    const before = trianglesOf(nodeOf(await read(stool), 'seat'));
    const { glb, made, moved, lost } = await carve(files(stool), cutSeat([1, 0, 0, 0.1]));
    const after = await read(glb);
    const [left, right] = ['seat left', 'seat right'].map((name) => trianglesOf(nodeOf(after, name)));
    if (left === undefined || right === undefined) throw new Error('no sides');
    const [height, depth] = [1, 2].map((axis) => extent(before, axis)).map(([low = 0, high = 0]) => high - low);
    expect(area(left) + area(right)).toBeCloseTo(area(before) + 2 * (height ?? 0) * (depth ?? 0), 6);
    expect(extent(left, 0)).toEqual([expect.closeTo(0.1, 6), extent(before, 0)[1]]);
    expect(extent(right, 0)).toEqual([extent(before, 0)[0], expect.closeTo(0.1, 6)]);
    expect(nodeOf(after, 'seat').getMesh()).toBe(null);
    expect(made).toEqual(['node:11/0', 'node:12/0']);
    expect([moved, lost]).toEqual([[], []]);
    expect(await problems(glb)).toEqual([]);
  });

  it('gives both sides the corners on the plane, at the same places to the bit', async () => {
    const { glb } = await carve(files(stool), cutSeat([0.6, 0, 0.8, 0.03]));
    const after = await read(glb);
    const onPlane = (name: string) =>
      [
        ...new Set(
          trianglesOf(nodeOf(after, name))
            .flat()
            .filter(([x, , z]) => Math.abs(0.6 * x + 0.8 * z - 0.03) < 1e-6)
            .map(String),
        ),
      ].sort();
    const [one, two] = ['seat front', 'seat back'].map(onPlane);
    expect(one).toHaveLength(7); // on four edges, and on three of the diagonals of the four faces that it crosses
    expect(two).toEqual(one);
  });

  it('keeps materials, and interpolates what corners carry', async () => {
    const { glb } = await carve(files(stool), { kind: 'cut', parts: ['node:2/0'], plane: [0, 1, 0, 0.31] });
    const after = await read(glb);
    const whole = nodeOf(await read(stool), 'leg')
      .getMesh()
      ?.listPrimitives()[0];
    for (const name of ['leg top', 'leg bottom']) {
      const primitive = nodeOf(after, name).getMesh()?.listPrimitives()[0];
      expect(primitive?.getMaterial()?.getBaseColorFactor()).toEqual(whole?.getMaterial()?.getBaseColorFactor());
      const normals = primitive?.getAttribute('NORMAL');
      const indices = primitive?.getIndices()?.getArray() ?? [];
      const triangles = trianglesOf(nodeOf(after, name));
      const world = nodeOf(after, name).getWorldMatrix();
      for (let i = 0; i < indices.length; i++) {
        const normal = normals?.getElement(indices[i] ?? 0, []) ?? [];
        expect(Math.hypot(...normal)).toBeCloseTo(1, 5);
        // Flat faces: the normal is that of the triangle, on the mirrored leg as well, whose triangles are turned.
        const [nx = 0, ny = 0, nz = 0] = normal;
        const shown: Point = [(world[0] ?? 0) * nx, ny, nz];
        const face = normalOf(triangles[Math.floor(i / 3)] ?? []);
        const size = Math.hypot(...face);
        const along = (shown[0] * face[0] + shown[1] * face[1] + shown[2] * face[2]) / size;
        expect(along).toBeCloseTo(Math.sign(world[0] ?? 1), 3);
      }
    }
  });

  it('of one instance leaves the others alone', async () => {
    const before = await read(stool);
    const { glb } = await carve(files(stool), { kind: 'cut', parts: ['node:1/0'], plane: [0, 1, 0, 0.2] });
    const after = await read(glb);
    for (const n of [2, 3, 4])
      expect(trianglesOf(after.getRoot().listNodes()[n] as Node)).toEqual(
        trianglesOf(before.getRoot().listNodes()[n] as Node),
      );
    const meshes = [2, 3, 4].map((n) => after.getRoot().listNodes()[n]?.getMesh());
    expect(new Set(meshes).size).toBe(1);
  });

  it('goes through several parts, and leaves those that it misses', async () => {
    const parts = [0, 1, 2, 3, 4].map((n) => `node:${n}/0`);
    const { glb, made } = await carve(files(stool), { kind: 'cut', parts, plane: [0, 1, 0, 0.2] });
    expect(made).toHaveLength(8);
    expect((await read(glb)).getRoot().listNodes()[0]?.getMesh()).not.toBe(null);
    expect(await problems(glb)).toEqual([]);
  });

  it('between two boxes that touch gives each its own lid', async () => {
    // The table's top lies on its legs: a cut where they meet.
    const top = trianglesOf((await read(tableInOnePiece)).getRoot().listNodes()[0] as Node);
    const { glb } = await carve(files(tableInOnePiece), { kind: 'cut', parts: [seat], plane: [0, 1, 0, 0.7] });
    const after = await read(glb);
    const [above, below] = ['part top', 'part bottom'].map((name) => trianglesOf(nodeOf(after, name)));
    expect((above?.length ?? 0) + (below?.length ?? 0)).toBe(top.length);
    const lids = (triangles: Point[][] | undefined) =>
      triangles
        ?.filter((one) => one.every(([, y]) => Math.abs(y - 0.7) < 1e-6))
        .map((one) => Math.sign(normalOf(one)[1]));
    expect(lids(above)).toEqual([-1, -1]); // the underside of the top
    expect(lids(below)).toEqual(Array(8).fill(1)); // the upper ends of four legs
  });

  it('says so where there is nothing to cut', async () => {
    await expect(carve(files(stool), cutSeat([1, 0, 0, 9]))).rejects.toThrow(/goes through none of these parts/);
    await expect(carve(files(stool), { kind: 'cut', parts: ['node:5/0'], plane: [1, 0, 0, 0] })).rejects.toThrow(
      CarveError,
    );
    await expect(carve(files(stool), { kind: 'cut', parts: ['seat'], plane: [1, 0, 0, 0] })).rejects.toThrow(
      CarveError,
    );
  });
});

describe('the holes of a cut', () => {
  type Corner = readonly [number, number, number];
  const boxCorners = ([x, y, z]: Corner, [w, h, d]: Corner): Corner[] =>
    Array.from({ length: 8 }, (_, k) => [
      x + (k & 1 ? w / 2 : -w / 2),
      y + (k & 2 ? h / 2 : -h / 2),
      z + (k & 4 ? d / 2 : -d / 2),
    ]);
  const quads = (faces: readonly (readonly number[])[]) =>
    faces.flatMap(([a = 0, b = 0, c = 0, d = 0]) => [a, b, c, a, c, d]);
  /** A part of these corners and triangles; texture coordinates are x and z. */
  async function model(corners: readonly Corner[], triangles: readonly number[]): Promise<Uint8Array> {
    const document = new Document();
    const accessor = (type: 'VEC2' | 'VEC3', values: number[]) =>
      document.createAccessor().setType(type).setArray(Float32Array.from(values)).setBuffer(buffer);
    const buffer = document.createBuffer();
    const indices = document.createAccessor().setArray(Uint16Array.from(triangles)).setBuffer(buffer);
    const primitive = document
      .createPrimitive()
      .setIndices(indices)
      .setAttribute('POSITION', accessor('VEC3', corners.flat()))
      .setAttribute(
        'TEXCOORD_0',
        accessor(
          'VEC2',
          corners.flatMap(([x, , z]) => [x, z]),
        ),
      );
    const node = document.createNode('thing').setMesh(document.createMesh().addPrimitive(primitive));
    document.createScene().addChild(node);
    return new WebIO().writeBinary(document);
  }
  async function cut(glb: Uint8Array, plane: Plane) {
    const done = await carve(files(glb), { kind: 'cut', parts: [seat], plane });
    const after = await read(done.glb);
    const [, ...nodes] = after.getRoot().listNodes();
    return { ...done, nodes, sides: nodes.map(trianglesOf) };
  }
  const whole = async (glb: Uint8Array) => trianglesOf((await read(glb)).getRoot().listNodes()[0] as Node);

  it('are closed on both sides, whichever way the plane stands, and again when a side is cut again', async () => {
    const before = trianglesOf(nodeOf(await read(stool), 'seat'));
    const once = await carve(files(stool), cutSeat([0.6, 0, 0.8, 0.03]));
    const sides = ['seat front', 'seat back'];
    const after = await read(once.glb);
    const found = sides.map((name) => trianglesOf(nodeOf(after, name)));
    expect(found.map(openEdges)).toEqual([0, 0]);
    expect(found.reduce((sum, side) => sum + volume(side), 0)).toBeCloseTo(volume(before), 8);
    for (const side of found) expect(volume(side)).toBeGreaterThan(0);
    expect(once.open).toEqual([]);
    const twice = await carve(files(once.glb), { kind: 'cut', parts: once.made, plane: [-0.8, 0, 0.6, 0.01] });
    expect(twice.made).toHaveLength(4);
    const quarters = await read(twice.glb);
    const all = twice.made.map((key) => trianglesOf(quarters.getRoot().listNodes()[Number(key.slice(5, -2))] as Node));
    expect(all.map(openEdges)).toEqual([0, 0, 0, 0]);
    expect(all.reduce((sum, side) => sum + volume(side), 0)).toBeCloseTo(volume(before), 8);
    expect(await problems(twice.glb)).toEqual([]);
  });

  it('of a mirrored instance are closed as those of the others', async () => {
    const before = trianglesOf((await read(stool)).getRoot().listNodes()[2] as Node);
    const { glb, open } = await carve(files(stool), { kind: 'cut', parts: ['node:2/0'], plane: [0, 1, 0, 0.2] });
    const after = await read(glb);
    const found = ['leg top', 'leg bottom'].map((name) => trianglesOf(nodeOf(after, name)));
    expect(open).toEqual([]);
    expect(found.map(openEdges)).toEqual([0, 0]);
    expect(volume(before)).toBeLessThan(0); // the node mirrors: whoever draws it turns the triangles
    for (const side of found) expect(volume(side)).toBeLessThan(0);
    expect(found.reduce((sum, side) => sum + volume(side), 0)).toBeCloseTo(volume(before), 8);
  });

  it('are rings where the solid is hollow, and several where it is', async () => {
    const [outer, inner, other] = [
      boxCorners([0, 0, 0], [4, 4, 4]),
      boxCorners([0, 0, 0], [2, 2, 2]),
      boxCorners([9, 0, 0], [2, 2, 2]),
    ];
    const out = quads(boxFaces);
    const inwards = quads(boxFaces.map((face) => [...face].reverse())).map((corner) => corner + 8);
    const glb = await model([...outer, ...inner, ...other], [...out, ...inwards, ...out.map((corner) => corner + 16)]);
    const { sides, open } = await cut(glb, [0, 1, 0, 0.25]);
    expect(open).toEqual([]);
    expect(sides.map(openEdges)).toEqual([0, 0]);
    expect(sides.map((side) => volume(side) / 6)).toEqual([
      expect.closeTo(16 * 1.75 - 4 * 0.75 + 4 * 0.75, 5),
      expect.closeTo(16 * 2.25 - 4 * 1.25 + 4 * 1.25, 5),
    ]);
    expect(area(sides[0] ?? [])).toBeCloseTo(16 + 16 * 1.75 + 4 + 8 * 0.75 + 4 + 8 * 0.75 + (16 - 4) + 4, 5);
  });

  it('of a solid that is inside out look as it does', async () => {
    const glb = await model(boxCorners([0, 0, 0], [2, 2, 2]), quads(boxFaces.map((face) => [...face].reverse())));
    const { sides, open } = await cut(glb, [0, 1, 0, 0.5]);
    expect([open, sides.map(openEdges)]).toEqual([[], [0, 0]]);
    expect(sides.map((side) => volume(side) / 6)).toEqual([expect.closeTo(-2, 6), expect.closeTo(-6, 6)]);
  });

  it('are closed where the plane lies in a face, on the side that lacks it', async () => {
    // A step: an L of six corners, drawn up; the cut lies in its lower tread.
    const outline = [
      [0, 0],
      [2, 0],
      [2, 1],
      [1, 1],
      [1, 2],
      [0, 2],
    ] as const;
    const corners = [0, 1].flatMap((z) => outline.map(([x, y]) => [x, y, z] as const));
    const ends = [0, 1, 2, 0, 2, 3, 0, 3, 5, 3, 4, 5];
    const walls = outline.flatMap((_, i) => {
      const next = (i + 1) % 6;
      return [i, next, next + 6, i, next + 6, i + 6];
    });
    const back = ends.map((_, i) => ends[i - (i % 3) + ((3 - (i % 3)) % 3)] ?? 0);
    const glb = await model(corners, [...walls, ...back, ...ends.map((corner) => corner + 6)]);
    expect(openEdges(await whole(glb))).toBe(0);
    const { sides } = await cut(glb, [0, 1, 0, 1]);
    expect(sides.map(openEdges)).toEqual([0, 0]);
    expect(sides.map((side) => volume(side) / 6)).toEqual([expect.closeTo(1, 6), expect.closeTo(2, 6)]);
    expect(area(sides[1] ?? [])).toBeCloseTo(2 * (2 + 2 + 1), 6); // the tread is there once
  });

  it('carry what the corners around them do, and look along the plane’s normal', async () => {
    const { nodes } = await cut(await model(boxCorners([0, 0, 0], [2, 2, 2]), quads(boxFaces)), [0, 1, 0, 0.5]);
    for (const node of nodes) {
      const primitive = node.getMesh()?.listPrimitives()[0];
      const [position, texture] = ['POSITION', 'TEXCOORD_0'].map((semantic) => primitive?.getAttribute(semantic));
      for (let i = 0; i < (position?.getCount() ?? 0); i++) {
        const [x = 0, , z = 0] = position?.getElement(i, []) ?? [];
        expect(texture?.getElement(i, [])).toEqual([expect.closeTo(x, 6), expect.closeTo(z, 6)]);
      }
    }
    const { glb } = await carve(files(stool), cutSeat([0, 0.6, 0.8, 0.27]));
    const after = await read(glb);
    for (const [name, sign] of [
      ['seat front', -1],
      ['seat back', 1],
    ] as const) {
      const primitive = nodeOf(after, name).getMesh()?.listPrimitives()[0];
      const normals = primitive?.getAttribute('NORMAL');
      const all = Array.from({ length: normals?.getCount() ?? 0 }, (_, i) => normals?.getElement(i, []) ?? []);
      const lid = all.filter(([, y = 0, z = 0]) => Math.abs(sign * (0.6 * y + 0.8 * z) - 1) < 1e-5);
      expect(lid.length).toBeGreaterThan(3);
    }
  });

  it('stay open where there is no solid, and the part is named', async () => {
    const sheet = await model(
      [
        [0, 0, 0],
        [1, 0, 0],
        [1, 1, 0],
        [0, 1, 0],
      ],
      [0, 1, 2, 0, 2, 3],
    );
    const { open, sides } = await cut(sheet, [1, 0, 0, 0.5]);
    expect(open).toEqual(['thing']);
    expect(sides.map(area)).toEqual([expect.closeTo(0.5, 6), expect.closeTo(0.5, 6)]);
    // Without its lid a box is none either.
    const box = await model(boxCorners([0, 0, 0], [2, 2, 2]), quads(boxFaces.slice(1)));
    expect((await cut(box, [0, 1, 0, 0.5])).open).toEqual(['thing']);
  });
});

describe('a split', () => {
  it('makes a part of each piece, and they are the whole', async () => {
    const before = trianglesOf((await read(tableInOnePiece)).getRoot().listNodes()[0] as Node);
    const { glb, made } = await carve(files(tableInOnePiece), { kind: 'divide', part: seat });
    const after = await read(glb);
    expect(made).toHaveLength(6);
    const pieces = made.map((key) => trianglesOf(after.getRoot().listNodes()[Number(key.slice(5, -2))] as Node));
    expect(pieces.map((piece) => piece.length)).toEqual(Array(6).fill(12));
    expect(pieces.flat()).toEqual(before);
    expect(await problems(glb)).toEqual([]);
  });
  it('says so where a part hangs together, doubled corners or not', async () => {
    await expect(carve(files(stool), { kind: 'divide', part: seat })).rejects.toThrow(/hangs together.*Cut it/);
  });
});

describe('a join', () => {
  it('makes one part of several, in place of the first, also of mirrored and turned ones', async () => {
    const before = await read(stool);
    const keys = [2, 1, 6].map((n) => `node:${n}/0`); // the mirrored leg first; a slat of another material is refused
    await expect(carve(files(stool), { kind: 'join', parts: keys })).rejects.toThrow(/several materials/);
    const { glb, made } = await carve(files(stool), { kind: 'join', parts: keys.slice(0, 2) });
    const after = await read(glb);
    const joined = after.getRoot().listNodes().at(-1) as Node;
    expect(made).toEqual(['node:11/0']);
    expect(joined.getName()).toBe('leg');
    const whole = [2, 1].flatMap((n) => trianglesOf(before.getRoot().listNodes()[n] as Node));
    const found = trianglesOf(joined);
    expect(found).toHaveLength(whole.length);
    expect(area(found)).toBeCloseTo(area(whole), 6);
    for (const axis of [0, 1, 2]) {
      const [low = 0, high = 0] = extent(whole, axis);
      expect(extent(found, axis)).toEqual([expect.closeTo(low, 6), expect.closeTo(high, 6)]);
    }
    // Every triangle looks out of the leg that it is on, as seen: the node mirrors, and turns what looks inwards.
    const seen = joined.getWorldMatrix()[0] ?? 1;
    for (const one of found) {
      const centre = one.reduce<Point>(
        (sum, p) => [sum[0] + p[0] / 3, sum[1] + p[1] / 3, sum[2] + p[2] / 3],
        [0, 0, 0],
      );
      const axis = [Math.sign(centre[0]) * 0.2, 0.2, 0.15] as Point;
      const out = minus(centre, axis);
      const face = normalOf(one);
      expect(Math.sign(seen) * (face[0] * out[0] + face[1] * out[1] + face[2] * out[2])).toBeGreaterThan(0);
    }
    expect(await problems(glb)).toEqual([]);
  });

  it('takes a cut back', async () => {
    const whole = trianglesOf(nodeOf(await read(stool), 'seat'));
    const cut = await carve(files(stool), cutSeat([1, 0, 0, 0]));
    const { glb } = await carve(files(cut.glb), { kind: 'join', parts: cut.made });
    const joined = trianglesOf((await read(glb)).getRoot().listNodes().at(-1) as Node);
    expect(area(joined)).toBeCloseTo(area(whole), 6);
    expect(extent(joined, 0)).toEqual(extent(whole, 0));
  });

  it('of one part, or of one with itself, is refused', async () => {
    await expect(carve(files(stool), { kind: 'join', parts: [seat] })).rejects.toThrow(/Select several/);
    await expect(carve(files(stool), { kind: 'join', parts: [seat, seat] })).rejects.toThrow(/itself/);
  });
});

describe('every step', () => {
  const steps: CarveStep[] = [
    { kind: 'cut', parts: [seat, 'node:3/0'], plane: [0, 0.8, 0.6, 0.25] },
    { kind: 'divide', part: seat },
    { kind: 'join', parts: ['node:1/0', 'node:2/0', 'node:3/0'] },
  ];
  it.each(steps)('gives the same bytes again: $kind', async (step) => {
    const main = step.kind === 'divide' ? tableInOnePiece : stool;
    const once = await carve(files(main), step);
    expect(await carve(files(main), step)).toEqual(once);
  });

  it('tells which parts of a mesh have other numbers', async () => {
    // Two primitives in one node: the seat's mesh gets a second one.
    const document = await read(stool);
    const [node] = document.getRoot().listNodes();
    const other = document.getRoot().listMeshes()[1]?.listPrimitives()[0];
    if (other) node?.getMesh()?.addPrimitive(other.clone());
    const two = await new WebIO().writeBinary(document);
    const { moved, made, glb } = await carve(files(two), cutSeat([1, 0, 0, 0.05]));
    expect(moved).toEqual([['node:0/1', 'node:0/0']]);
    expect(made).toHaveLength(2);
    expect((await read(glb)).getRoot().listNodes()[0]?.getMesh()?.listPrimitives()).toHaveLength(1);
  });

  it('refuses what bends', async () => {
    const document = await read(stool);
    const target = document.createPrimitiveTarget();
    const primitive = document.getRoot().listMeshes()[0]?.listPrimitives()[0];
    target.setAttribute('POSITION', primitive?.getAttribute('POSITION') ?? null);
    primitive?.addTarget(target);
    const bending = await new WebIO().writeBinary(document);
    await expect(carve(files(bending), cutSeat([1, 0, 0, 0]))).rejects.toThrow(/morph targets and stays whole/);
  });
});
