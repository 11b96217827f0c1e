// What differences and intersections leave of parts, held against volumes that are known, and against OpenSCAD's own.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, describe, expect, it } from 'vitest';
import { readStl } from '../../web/src/formats/stl';
import { type CadPart, type CadProgram, type CadTree, meshOf, millimetresOf } from '../../web/src/solid/cad';
import { cutParts, type State } from '../../web/src/solid/cut';
import { cutFile } from '../../web/src/solid/cut_file';
import { CutModel } from '../../web/src/solid/cut_model';
import { loadManifold } from '../../web/src/solid/manifold';
import { partsOf } from '../../web/src/solid/parts';
import { stepsOf } from '../../web/src/solid/steps';
import type { Triangles } from '../../web/src/solid/types';
import { unite } from '../../web/src/solid/unite';
import { cross, type Vec } from '../../web/src/solid/vectors';
import { boundsOf, openEdges, volumeOf, weld } from '../../web/src/solid/weld';
import type { MethodResult } from '../../web/src/worker/protocol';
import { call, loadWithCad } from './module';

const require = createRequire(new URL('../../web/package.json', import.meta.url));
const manifold = await loadManifold(require.resolve('manifold-3d/manifold.wasm'));
const core = await loadWithCad();
const folder = mkdtempSync(join(tmpdir(), 'parsel-cuts-'));
afterAll(() => rmSync(folder, { recursive: true }));

const rest: State = { values: {}, absent: new Set() };
type Role = CadPart['role'];
const box = (id: string, role: Role, centre: number[], size: number[]): CadPart => ({
  id,
  role,
  kind: 'box',
  centre,
  size,
});
const rod = (id: string, role: Role, centre: number[], size: number[], axis = 'y'): CadPart => ({
  id,
  role,
  kind: 'cylinder',
  axis,
  centre,
  size,
});
const program = (parts: CadPart[], tree: CadTree): CadProgram => ({ unit: 'mm', parts, tree });
const added = (given: CadProgram) =>
  new Map(
    given.parts
      .filter(({ role }) => role === 'add')
      .map((part) => [part.id, meshOf(part, millimetresOf(given))] as const),
  );
const cutAt = (given: CadProgram, state = rest) => cutParts(given, added(given), state, manifold);
const volumes = (given: CadProgram, state = rest) =>
  Object.fromEntries([...cutAt(given, state)].map(([id, { volume }]) => [id, volume]));
/** Of the regular polygon with 48 corners in a circle. */
const disc = (radius: number) => 24 * radius ** 2 * Math.sin((2 * Math.PI) / 48);

describe('what is done to each part', () => {
  it('is what stands around it in the program, innermost first', () => {
    const tree: CadTree = ['union', 'a', ['difference', ['union', 'b', ['intersection', 'c', 'd']], 'e', 'f']];
    expect([...stepsOf(tree)]).toEqual([
      ['b', [{ op: 'subtract', by: ['e', 'f'] }]],
      [
        'c',
        [
          { op: 'intersect', by: ['d'] },
          { op: 'subtract', by: ['e', 'f'] },
        ],
      ],
    ]);
  });
});

describe('a part that is cut', () => {
  it('has a hole through both faces in which the cutter ends', () => {
    const given = program(
      [box('plate', 'add', [0.15, 0.05, 0], [20.3, 10.1, 20]), rod('hole', 'cut', [0.15, 0.05, 0], [6, 10.1, 6])],
      ['difference', 'plate', 'hole'],
    );
    expect(volumes(given)['plate']).toBeCloseTo((20.3 * 20 - disc(3)) * 10.1, 2);
    const drawn = cutAt(given).get('plate')?.drawn as Triangles;
    // Nothing is left across the hole, not even a film.
    const inHole = drawn.triangles.filter((corner) => {
      const [x = 0, y = 0] = drawn.positions.subarray(3 * corner, 3 * corner + 3);
      return Math.hypot(x - 0.15, y) < 2.5;
    });
    expect(inHole).toHaveLength(0);
  });

  it('is what lies in both of an intersection, and nothing where they are apart', () => {
    const parts = [box('a', 'add', [0, 0, 0], [10, 10, 10]), box('b', 'meet', [5, 5, 5], [10, 10, 10])];
    expect(volumes(program(parts, ['intersection', 'a', 'b']))['a']).toBeCloseTo(125, 4);
    const apart = program([parts[0] as CadPart, box('b', 'meet', [50, 0, 0], [1, 1, 1])], ['intersection', 'a', 'b']);
    expect(cutAt(apart).get('a')?.drawn.triangles).toHaveLength(0);
  });

  it('is cut by what is left of a cutter that is cut itself', () => {
    const given = program(
      [
        box('block', 'add', [0, 0, 0], [10, 10, 10]),
        box('slot', 'cut', [0, 0, 0], [4, 4, 10]),
        box('bridge', 'cut', [0, 0, 0], [4, 4, 2]),
      ],
      ['difference', 'block', ['difference', 'slot', 'bridge']],
    );
    expect(volumes(given)['block']).toBeCloseTo(1000 - 4 * 4 * 8, 3);
  });

  it('keeps the other parts of its union, each cut for itself', () => {
    const given = program(
      [
        box('left', 'add', [-5, 0, 0], [10, 10, 10]),
        box('right', 'add', [5, 0, 0], [10, 10, 10]),
        box('groove', 'cut', [0, 5, 0], [4, 2, 10]),
        box('foot', 'add', [0, -20, 0], [1, 1, 1]),
      ],
      ['union', ['difference', ['union', 'left', 'right'], 'groove'], 'foot'],
    );
    const found = volumes(given);
    expect(Object.keys(found)).toEqual(['left', 'right']);
    for (const id of ['left', 'right']) expect(found[id]).toBeCloseTo(1000 - 2 * 1 * 10, 3);
  });

  it('follows the numbers of what cuts it, and is whole where that is absent', () => {
    const given = program(
      [box('plate', 'add', [0, 0, 0], [20, 2, 20]), rod('hole', 'cut', [0, 0, 0], [4, 4, 4])],
      ['difference', 'plate', 'hole'],
    );
    const wider = { values: { 'hole.sx': 8, 'hole.sz': 8, 'hole.cx': 1 }, absent: new Set<string>() };
    expect(volumes(given, wider)['plate']).toBeCloseTo((400 - disc(4)) * 2, 3);
    expect(volumes(given, { values: {}, absent: new Set(['hole']) })['plate']).toBeCloseTo(800, 3);
  });

  it('is in millimetres whatever the unit of its program', () => {
    const parts = [box('a', 'add', [0, 0, 0], [1, 1, 1]), box('b', 'cut', [0.5, 0, 0], [1, 2, 2])];
    const given = { ...program(parts, ['difference', 'a', 'b']), unit: 'in' };
    expect(volumes(given)['a']).toBeCloseTo(25.4 ** 3 / 2, 1);
  });
});

/** Programs whose round parts have 48 sides in OpenSCAD as well. */
const texts: Readonly<Record<string, string>> = {
  'a plate with holes': `$fn = 48;
difference() { cube([60, 40, 5]); for (x = [10, 30, 50]) translate([x, 20, 0]) cylinder(h = 5, r = 4); }`,
  'a cup': `$fn = 48;
difference() { cylinder(h = 80, r1 = 25, r2 = 35); translate([0, 0, 3]) cylinder(h = 77, r1 = 22, r2 = 32); }`,
  'holes along every axis': `$fn = 48;
difference() { cube(30, center = true); for (a = [[0, 0, 0], [90, 0, 0], [0, 90, 0]]) rotate(a) cylinder(h = 40, r = 8, center = true); }`,
  'an intersection, mirrored and scaled': `$fn = 48;
mirror([1, 0, 0]) scale([1, 2, 0.5]) translate([5, 0, 0]) intersection() { cube([20, 20, 20]); translate([10, 10, -1]) cylinder(h = 30, r = 11); }`,
  'differences in differences, and what stands beside them': `$fn = 48;
difference() {
  union() { cube([40, 40, 10]); translate([10, 10, 10]) cube([20, 20, 20]); }
  difference() { translate([20, 20, -5]) cylinder(h = 50, r = 6); translate([0, 0, 4]) cube([40, 40, 3]); }
  translate([-1, 18, 20]) cube([50, 4, 5]);
}
translate([50, 0, 0]) intersection() { cube([10, 10, 10]); translate([2, 2, 2]) cube([10, 10, 10]); translate([-3, -3, -3]) cube([10, 10, 10]); }`,
  'cutters that end in faces that have no round numbers': `$fn = 48;
difference() {
  translate([1 / 3, 1 / 7, 0]) cube([100 / 3, 50 / 7, 10 / 3]);
  translate([1 / 3 + 2, 1 / 7 + 1, 0]) cube([10 / 3, 10 / 7, 10 / 3]);
  translate([1 / 3 + 20, 1 / 7 + 25 / 7, 0]) cylinder(h = 10 / 3, r = 9 / 7);
  translate([1 / 3, 1 / 7, 7 / 3]) cube([5 / 3, 50 / 7, 1]);
}`,
  'a hexagonal nut': `difference() { cylinder(h = 8, r = 10, $fn = 6); translate([0, 0, -1]) cylinder(h = 10, r = 5, $fn = 8); }`,
};

interface Read {
  readonly cad: CadProgram;
  readonly glb: Uint8Array;
  /** By id in the program. */
  readonly nodes: ReadonlyMap<string, number>;
}
function read(text: string): Read {
  const { result, buffers } = call<MethodResult<'open_cad'>>(core, 'open_cad', { name: 'm' }, [Buffer.from(text)]);
  const drawn = result.parts.filter(({ role }) => role === 'add');
  return {
    cad: result.cad as unknown as CadProgram,
    glb: buffers[0] as Uint8Array,
    nodes: new Map(drawn.map(({ id }, node) => [id, node])),
  };
}

/** Square millimetres: a film across a hole has no volume, but an area. */
function areaOf({ positions, triangles }: Triangles): number {
  let sum = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => {
      const at = 3 * (triangles[i + k] as number);
      return positions.subarray(at, at + 3);
    }) as [Float64Array, Float64Array, Float64Array];
    const [u, v] = [b, c].map((end) => [0, 1, 2].map((k) => (end[k] as number) - (a[k] as number)) as Vec) as [
      Vec,
      Vec,
    ];
    sum += Math.hypot(...cross(u, v)) / 2;
  }
  return sum;
}

/** What OpenSCAD renders. */
function rendered(text: string): Triangles {
  writeFileSync(join(folder, 'in.scad'), text);
  const { status, stderr } = spawnSync('openscad', ['-o', 'out.stl', 'in.scad'], { cwd: folder, encoding: 'utf8' });
  expect(status, stderr).toBe(0);
  const main = new Uint8Array(readFileSync(join(folder, 'out.stl')));
  const { nodes } = readStl({ path: 'out.stl', main, external: new Map() });
  const positions = Float64Array.from(nodes[0]?.mesh[0]?.positions ?? []);
  return { positions, triangles: Uint32Array.from({ length: positions.length / 3 }, (_, i) => i) };
}

const hasOpenScad = spawnSync('openscad', ['--version']).error === undefined;
const title = `in OpenSCAD${hasOpenScad ? '' : ' (skipped: it is not installed; apt-get install openscad)'}`;

describe.each(Object.entries(texts))('%s', (_, text) => {
  const { cad, glb, nodes } = read(text);

  it('has parts of the form and place that the core draws', async () => {
    for (const [id, mesh] of added(cad)) {
      const drawn = (await partsOf(glb, new Map())).find(({ node }) => node === nodes.get(id)) as Triangles;
      expect(Math.abs(volumeOf(mesh) / volumeOf(drawn) - 1)).toBeLessThan(1e-4);
      const [own, core] = [boundsOf(mesh.positions), boundsOf(drawn.positions)];
      for (const [i, x] of [...own.low, ...own.high].entries())
        expect(x).toBeCloseTo([...core.low, ...core.high][i] as number, 3);
    }
  });

  it.skipIf(!hasOpenScad)(`has the volume and the surface of what is rendered ${title}`, async () => {
    const cut = await partsOf(await cutFile(glb, cad, nodes, rest, manifold), new Map());
    const { solid, faults } = unite(cut, manifold, false, () => {});
    expect(faults).toEqual([]);
    if (solid === null) throw new Error('nothing is left');
    const wanted = rendered(text);
    expect(Math.abs(solid.volume / volumeOf(wanted) - 1)).toBeLessThan(1e-4);
    expect(Math.abs(areaOf(solid) / areaOf(wanted) - 1)).toBeLessThan(1e-4);
    expect(openEdges(solid.triangles)).toBe(0);
  });

  it('comes out of its hexahedra as it is, where it was cut', async () => {
    const parts = await partsOf(glb, new Map());
    const boxes = [...nodes].map(([id, node]) => ({ id, node, rest: cornersOf(parts[node] as Triangles) }));
    const corners = Float64Array.from(boxes.flatMap((one) => [...one.rest]));
    const straight = cutAt(cad);
    for (const cut of new CutModel(cad, boxes, parts).cut(corners, rest, manifold)) {
      const { id, rest: own } = boxes[cut.box] as (typeof boxes)[number];
      const { low, high } = boundsOf(own);
      const positions = Float64Array.from(cut.positions, (x, i) => {
        const [a, b] = [low[i % 3] as number, high[i % 3] as number];
        return (a + b + x * (b - a)) / 2;
      });
      const mesh = weld({ positions, triangles: cut.triangles }, 1e-3);
      expect(mesh.open).toBe(0);
      expect(Math.abs(volumeOf(mesh) / (straight.get(id)?.volume ?? 0) - 1)).toBeLessThan(1e-4);
    }
  });
});

/** Of the box around a mesh: bits 0, 1, 2 of a corner's number say on which side of x, y, z it is. */
function cornersOf({ positions }: Triangles): Float64Array {
  const { low, high } = boundsOf(positions);
  return Float64Array.from({ length: 24 }, (_, i) => {
    const [corner, axis] = [Math.floor(i / 3), i % 3];
    return (corner & (1 << axis) ? high : low)[axis] as number;
  });
}
