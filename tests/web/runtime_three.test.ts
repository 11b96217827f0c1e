// A scene of GLTFLoader that follows sliders in place: where its meshes are, what rays hit, and that it can be undone.
import { readFileSync } from 'node:fs';
import * as three from 'three';
import { type GLTF, GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { describe, expect, it } from 'vitest';
import { compile, loadProgram, ParselError } from '../../web/runtime/src/index';
import { attachSliders } from '../../web/runtime/src/three/index';
import { embedSliders } from '../../web/src/program/embedded';
import { slidersOf } from '../../web/src/program/sliders';
import type { CageShape, Program, Shape } from '../../web/src/program/types';
import { box, twoBoxes } from './box_shapes';
import { moving } from './fake_core';
import { randomProgram, randomShape } from './random_program';
import { glbOf } from './shape_glb';

interface Vectors {
  shapes: Record<string, Shape>;
  cases: { name: string; shape: string; program: Program; samples: { values: number[] }[] }[];
}
const vectors = JSON.parse(readFileSync(new URL('../golden/program_vectors.json', import.meta.url), 'utf8')) as Vectors;

async function load(glb: Uint8Array): Promise<GLTF> {
  return new GLTFLoader().parseAsync(Uint8Array.from(glb).buffer, '');
}

/** Of corners in the normalised frame, in the file's. */
function boxAround(corners: ArrayLike<number>, from: number, to: number, { centre, scale }: CageShape['frame']) {
  const found = new three.Box3();
  for (let at = from; at < to; at += 3) {
    found.expandByPoint(
      new three.Vector3()
        .fromArray(corners, at)
        .multiplyScalar(scale)
        .add(new three.Vector3(...centre)),
    );
  }
  return found;
}

const distance = (a: three.Box3, b: three.Box3) => Math.max(a.min.distanceTo(b.min), a.max.distanceTo(b.max));

const shifted: Shape = { ...twoBoxes, frame: { centre: [5, 1, -2], scale: 2 } };
const program = moving('left');

async function attached(shape: Shape = shifted) {
  const gltf = await load(glbOf(shape));
  return { gltf, sliders: attachSliders(gltf, slidersOf(program, shape)) };
}

describe('meshes', () => {
  it.each(vectors.cases.map((item) => [item.name, item] as const))(
    'are where the hexahedra are: %s',
    async (_, item) => {
      const shape = vectors.shapes[item.shape] as Shape;
      const gltf = await load(glbOf(shape));
      const record = slidersOf(item.program, shape);
      const sliders = attachSliders(gltf, record);
      const evaluate = compile(loadProgram(record));
      gltf.scene.position.set(0, 3, 0); // what the page does with the scene
      gltf.scene.updateMatrixWorld(true);
      const lifted = new three.Vector3(0, 3, 0);
      for (const { values } of item.samples) {
        for (const [i, { name }] of sliders.parameters.entries()) sliders.set(name, values[i] ?? 0);
        const corners = evaluate(values);
        for (const [original, twin] of sliders.drawn) {
          const part = shape.parts.findIndex(
            ({ node }) =>
              `node ${node}` === gltf.parser.json.nodes[node]?.name &&
              gltf.parser.associations.get(original)?.nodes === node,
          );
          const relation = shape.relations.findIndex(
            ({ parts }, i) => evaluate.groups[i] && parts.includes(shape.parts[part]?.id ?? ''),
          );
          const group = evaluate.groups[relation];
          const drawsAll = group && group.source >= 0;
          if (drawsAll && group.relation.parts[group.source] !== shape.parts[part]?.id) {
            expect(twin.visible).toBe(false);
            continue;
          }
          const expected = drawsAll
            ? boxAround(group.instances, 0, 24 * group.count, shape.frame)
            : boxAround(corners, 24 * part, 24 * part + 24, shape.frame);
          const actual = new three.Box3().setFromObject(twin);
          expect(distance(actual, expected.translate(lifted))).toBeLessThan(1e-5 * shape.frame.scale);
        }
      }
    },
  );

  it('are hit where they have gone, under the name of the file’s own', async () => {
    const { gltf, sliders } = await attached();
    sliders.set('x', 0.3); // upwards, 0.6 m
    gltf.scene.updateMatrixWorld(true);
    const cast = (y: number) =>
      new three.Raycaster(new three.Vector3(5.5, y, 10), new three.Vector3(0, 0, -1)).intersectObject(gltf.scene);
    const [hit] = cast(2);
    expect(hit?.object.name).toBe(gltf.scene.getObjectByName('node_0')?.name);
    expect(hit?.point.z).toBeCloseTo(-1.5, 5);
    expect(cast(0.8)).toEqual([]); // where it was
    expect([...sliders.drawn.keys()]).toContain(hit?.object);
  });

  it('keep names, places, shadows and layers', async () => {
    const gltf = await load(glbOf(shifted));
    const original = gltf.scene.getObjectByName('node_1') as three.Mesh;
    original.layers.set(3);
    original.castShadow = false;
    const world = original.matrixWorld.clone();
    const sliders = attachSliders(gltf, slidersOf(program, shifted));
    const twin = sliders.drawn.get(original);
    expect(original.matrixWorld.equals(world)).toBe(true);
    expect(twin).toMatchObject({ name: original.name, castShadow: false, material: original.material });
    expect(twin?.layers.mask).toBe(original.layers.mask);
  });
});

describe('sliders', () => {
  it('come from the file that holds them', async () => {
    const written = embedSliders(glbOf(shifted), slidersOf(program, shifted, { hidden: ['right'] }));
    if (!written.ok) throw new Error(written.error.cause);
    const gltf = await load(written.value);
    const sliders = attachSliders(gltf);
    expect(sliders.parameters).toEqual([{ name: 'x', request: '', min: -0.35, max: 0.35, value: 0 }]);
    expect([...sliders.drawn.values()].map(({ visible }) => visible)).toEqual([true, false]);
  });

  it('stop at their ends, go back, and refuse what is none', async () => {
    const { sliders } = await attached();
    sliders.set('x', 7);
    expect(sliders.values).toEqual({ x: 0.35 });
    expect(() => sliders.set('y', 0)).toThrow(/no slider of this name; name one of x/);
    expect(() => sliders.set('x', Number.NaN)).toThrow(/NaN is no finite number; give one from -0.35 to 0.35/);
    expect(sliders.values).toEqual({ x: 0.35 });
    sliders.reset();
    expect(sliders.values).toEqual({ x: 0 });
  });

  it('leave no trace when they are disposed of', async () => {
    const gltf = await load(glbOf(shifted));
    const snapshot = () => {
      const found: unknown[] = [];
      gltf.scene.traverse((object) => {
        const { geometry, material } = object as three.Mesh;
        const { onBeforeCompile, customProgramCacheKey } = (material ?? {}) as three.Material;
        found.push([
          object.uuid,
          geometry?.uuid,
          onBeforeCompile,
          customProgramCacheKey,
          (material as three.Material)?.uuid,
        ]);
      });
      return found;
    };
    const before = snapshot();
    const sliders = attachSliders(gltf, slidersOf(program, shifted));
    expect(snapshot()).not.toEqual(before);
    sliders.dispose();
    expect(snapshot()).toEqual(before);
    attachSliders(gltf, slidersOf(program, shifted)).set('x', 0.1); // and again
  });

  it('leave the material of what has no hexahedron alone', async () => {
    const gltf = await load(
      glbOf({ ...shifted, parts: [...shifted.parts, box('stranger', 2, [0, 1, 0], [0.1, 0.1, 0.1])] }),
    );
    const stranger = gltf.scene.getObjectByName('node_2') as three.Mesh;
    const material = stranger.material as three.Material;
    const { onBeforeCompile } = material;
    const sliders = attachSliders(gltf, slidersOf(program, shifted));
    expect(stranger.material).toBe(material);
    expect(material.onBeforeCompile).toBe(onBeforeCompile);
    expect([...sliders.drawn.values()].every((twin) => twin.material !== material)).toBe(true);
  });
});

describe('a step of a slider', () => {
  it('takes less than half a millisecond of script with 100 parts', { timeout: 60_000 }, async () => {
    const shape = randomShape(1, { loose: 100, rows: 0, rings: 0 });
    const gltf = await load(glbOf(shape));
    const record = slidersOf(randomProgram(shape, 2, { layers: 4, statements: 50, amount: 0.25 }), shape);
    const sliders = attachSliders(gltf, record);
    const [{ name } = { name: '' }] = sliders.parameters;
    const steps = 100;
    const round = () => {
      const start = performance.now();
      for (let i = 0; i < steps; i++) sliders.set(name, 0.2 * Math.sin(i));
      return (performance.now() - start) / steps;
    };
    // The best of some: whatever else the machine does spoils the others. tests/bench/runtime.bench.mjs measures.
    expect(Math.min(...Array.from({ length: 10 }, round))).toBeLessThan(0.5);
  });
});

describe('a program that does not fit', () => {
  it.each<[string, Shape, RegExp]>([
    [
      'with a part more',
      { ...shifted, parts: [...shifted.parts, box('lid', 5, [0, 0, 0], [1, 1, 1])] },
      /“lid”: the model has no mesh at node 5/,
    ],
    [
      'of a model that stands elsewhere',
      { ...shifted, frame: { centre: [0, 0, 0], scale: 2 } },
      /“left”: the mesh at node 0 does not lie in its hexahedron/,
    ],
    ['of a larger model', { ...shifted, frame: { ...shifted.frame, scale: 20 } }, /does not lie in its hexahedron/],
  ])('%s is named, and the scene stays as it was', async (_, shape, message) => {
    const gltf = await load(glbOf(shifted));
    const children = gltf.scene.children.length;
    const geometry = (gltf.scene.getObjectByName('node_0') as three.Mesh).geometry;
    expect(() => attachSliders(gltf, slidersOf(program, shape))).toThrow(message);
    expect(gltf.scene.children.length).toBe(children);
    expect((gltf.scene.getObjectByName('node_0') as three.Mesh).geometry).toBe(geometry);
  });

  it('or is not there is named', async () => {
    const gltf = await load(glbOf(shifted));
    expect(() => attachSliders(gltf)).toThrow(/the file holds no program/);
    expect(() => attachSliders(gltf, program)).toThrow(/comes without the shape/);
    expect(() => attachSliders(gltf, moving('nobody'), shifted)).toThrow(ParselError);
    attachSliders(gltf, program, shifted);
  });
});
