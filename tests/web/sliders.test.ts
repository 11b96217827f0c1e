// Sliders that travel: what is checked of them, and how they go into a GLB and out again.

import fc from 'fast-check';
import { validateBytes } from 'gltf-validator';
import { describe, expect, it } from 'vitest';
import { embedSliders, slidersIn, withoutSliders } from '../../web/src/program/embedded';
import { cageShapeOf, checkShape } from '../../web/src/program/shape_check';
import { misfitOf, readSliders, slidersOf } from '../../web/src/program/sliders';
import type { CageShape, Result, Shape } from '../../web/src/program/types';
import { type Gltf, toGlb } from '../../web/tools/glb.mjs';
import { stool } from '../e2e/fixture';
import { box, twoBoxes } from './box_shapes';
import { moving } from './fake_core';
import { glbOf } from './shape_glb';

const row: Shape = {
  ...twoBoxes,
  parts: [
    ...[0, 1, 2].map((i) => box(`slat_${i}`, i, [i / 2 - 0.5, 0, 0], [0.1, 0.1, 0.1])),
    { ...box('slats', -1, [0, 0, 0], [0.6, 0.1, 0.1]), virtual: true },
  ],
  relations: [
    {
      id: 't1',
      kind: 'translation',
      parts: ['slat_0', 'slat_1', 'slat_2'],
      parent: 'slats',
      start: [-0.5, 0, 0],
      end: [0.5, 0, 0],
      axis: 0,
      direction: 1,
    },
  ],
};
const sliders = slidersOf(moving('left'), twoBoxes);
const json = (value: unknown) => JSON.parse(JSON.stringify(value));
const value = <T>(result: Result<T>): T => {
  if (!result.ok) throw new Error(`${result.error.place}: ${result.error.cause}`);
  return result.value;
};
const refused = (result: Result<unknown>) => (result.ok ? 'accepted' : `${result.error.place}: ${result.error.cause}`);

describe('a shape from outside', () => {
  it('keeps what evaluation needs, and nothing else', () => {
    const read = value(checkShape(json(row)));
    expect(read).toEqual(cageShapeOf(row));
    expect(read.relations).toEqual(row.relations);
    expect(Object.keys(read.parts[0] ?? {})).toEqual(['id', 'node', 'primitive', 'corners', 'virtual']);
    expect(value(checkShape(json(read)))).toEqual(read);
  });

  it('may have relations of kinds that are not known yet', () => {
    const ground = { id: 'g1', kind: 'ground', parts: ['left'], height: 0 };
    expect(value(checkShape(json({ ...twoBoxes, relations: [ground] }))).relations).toEqual([
      { id: 'g1', kind: 'ground', parts: ['left'] },
    ]);
  });

  const group = row.relations[0];
  it.each<[string, (shape: Record<string, unknown>) => unknown, RegExp]>([
    ['another version', (shape) => ({ ...shape, version: 2 }), /^\/version: version 2 is unknown/],
    ['another format', (shape) => ({ ...shape, format: 'parsel/program' }), /^\/format: not a ParSEL shape/],
    ['a scale of nothing', (shape) => ({ ...shape, frame: { centre: [0, 0, 0], scale: 0 } }), /^\/frame\/scale/],
    ['no frame', ({ frame, ...shape }) => shape, /the key "frame" is missing/],
    ['a part twice', (shape) => ({ ...shape, parts: [...row.parts, row.parts[0]] }), /"slat_0" occurs twice/],
    [
      'seven corners',
      (shape) => ({ ...shape, parts: [{ ...row.parts[0], corners: row.parts[0]?.corners.slice(1) }] }),
      /^\/parts\/0\/corners/,
    ],
    [
      'a corner far away',
      (shape) => ({ ...shape, parts: [{ ...row.parts[0], corners: Array(8).fill([0, 1e300, 0]) }] }),
      /^\/parts\/0\/corners\/0\/1/,
    ],
    [
      'a group of strangers',
      (shape) => ({ ...shape, relations: [{ ...group, parts: ['slat_0', 'x'] }] }),
      /"x" is unknown/,
    ],
    [
      'a group of one',
      (shape) => ({ ...shape, relations: [{ ...group, parts: ['slat_0'] }] }),
      /^\/relations\/0\/parts/,
    ],
    ['a part in two groups', (shape) => ({ ...shape, relations: [group, { ...group, id: 't2' }] }), /in two groups/],
    ['a relation twice', (shape) => ({ ...shape, relations: [group, group] }), /"t1" occurs twice/],
    [
      'an axis of another length',
      (shape) => ({
        ...shape,
        relations: [
          {
            id: 'o1',
            kind: 'rotation',
            parts: ['slat_0', 'slat_1'],
            parent: 'slats',
            centre: [0, 0, 0],
            axis: [0, 2, 0],
            parent_axis: 1,
            radius: 1,
          },
        ],
      }),
      /^\/relations\/0\/axis/,
    ],
    ['a list', () => [], /^: /],
  ])('with %s is refused by its place', (_, spoil, message) => {
    expect(refused(checkShape(spoil(json(row))))).toMatch(message);
  });
});

describe('parsel/sliders', () => {
  it('is read as it was written', () => {
    const written = slidersOf(moving('left'), twoBoxes, { hidden: ['right'], session: { names: [['left', 'lid']] } });
    const read = value(readSliders(json(written)));
    expect(read.sliders).toEqual(written);
    expect(read.checked.program.layers).toHaveLength(1);
  });

  it('need not fit where it is switched off', () => {
    const written = json(slidersOf(moving('nobody'), twoBoxes, { off: [0] }));
    expect(value(readSliders(written)).checked.program.layers).toEqual([]);
    expect(refused(readSliders({ ...written, off: [] }))).toBe(
      '/program/layers/0/statements/0/part: the part "nobody" is unknown',
    );
  });

  it.each<[string, unknown, RegExp]>([
    ['a newer version', { ...sliders, version: 2 }, /^\/version: version 2 is unknown/],
    ['a newer program', { ...sliders, program: { ...sliders.program, version: 9 } }, /^\/program\/version: version 9/],
    ['an unknown key', { ...sliders, more: 1 }, /^\/more: the key or item "more" is unknown/],
    ['no shape', { ...sliders, shape: undefined }, /^\/shape/],
    ['a program of another format', { ...sliders, program: twoBoxes }, /^\/program/],
    ['deep nesting', { ...sliders, session: { a: JSON.parse(`${'['.repeat(40)}${']'.repeat(40)}`) } }, /nested deeper/],
    ['nothing', null, /^: /],
  ])('with %s is refused by its place', (_, written, message) => {
    expect(refused(readSliders(written))).toMatch(message);
  });
});

describe('sliders and a model', () => {
  const found = cageShapeOf(twoBoxes);
  const [left, right] = found.parts as [CageShape['parts'][0], CageShape['parts'][0]];
  it('belong together when the shapes agree within what other tools do to a file', () => {
    const shaken = left.corners.map(([x, y, z]) => [x + 4e-4, y, z - 4e-4] as const);
    expect(misfitOf(found, { ...found, parts: [right, { ...left, corners: shaken }] })).toBe(null);
  });
  it.each<[string, CageShape, RegExp]>([
    ['a part is missing', { ...found, parts: [left] }, /no part "right"/],
    ['a part is elsewhere', { ...found, parts: [left, { ...right, corners: left.corners }] }, /another place or size/],
    ['a part is another node', { ...found, parts: [left, { ...right, node: 7 }] }, /another node/],
    ['the model is larger', { ...found, frame: { ...found.frame, scale: 2 } }, /another size/],
    ['the model stands elsewhere', { ...found, frame: { ...found.frame, centre: [0, 1, 0] } }, /stands elsewhere/],
  ])('do not when %s', (_, other, message) => {
    expect(misfitOf(found, other)?.cause).toMatch(message);
  });
});

describe('sliders in a GLB', () => {
  const bytes = (text: string) => {
    const glb = toGlb({ json: {}, binary: Buffer.from([1, 2, 3, 4]) });
    const raw = Buffer.from(text);
    const padded = Buffer.concat([raw, Buffer.alloc((4 - (raw.length % 4)) % 4, 0x20)]);
    const rest = glb.subarray(20 + glb.readUInt32LE(12));
    const head = Buffer.from(glb.subarray(0, 20));
    head.writeUInt32LE(20 + padded.length + rest.length, 8);
    head.writeUInt32LE(padded.length, 12);
    return new Uint8Array(Buffer.concat([head, padded, rest]));
  };

  it.each([
    '{}',
    '{"asset":{"version":"2.0"}}',
    '{ "asset" : {"version":"2.0"} , "extras":{"a":"}\\"{,"} }',
    '{"extras": { "parseley":[1,{"parsel":2}], "b":-1.5e3 },"asset":{}}',
    '\n{\t"a":"\\\\","extras":{"x":"\\u007d"},"ü":"漢字 🪑"}',
  ])('leave %s as it was when they are taken out', (text) => {
    const glb = bytes(text);
    const written = value(embedSliders(glb, sliders));
    expect(value(slidersIn(written))?.sliders).toEqual(sliders);
    expect(value(embedSliders(written, sliders))).toEqual(written);
    expect(value(withoutSliders(written))).toEqual(glb);
    expect(value(withoutSliders(glb))).toBe(glb);
    expect(value(slidersIn(glb))).toBe(null);
  });

  it('leave any JSON as it was', { timeout: 60_000 }, () => {
    const objects = fc.dictionary(fc.string(), fc.jsonValue());
    const roots = fc
      .tuple(objects, fc.option(objects), fc.constantFrom(undefined, 1, '\t'))
      .map(([root, extras, indent]) => {
        const { parsel: _, ...own } = extras ?? {};
        const withExtras = Object.keys(own).length === 0 ? {} : { extras: own };
        const { extras: __, ...rest } = root;
        return JSON.stringify({ ...rest, ...withExtras }, null, indent);
      });
    fc.assert(
      fc.property(roots, (text) => {
        const glb = bytes(text);
        const written = value(embedSliders(glb, sliders));
        expect(value(slidersIn(written))?.sliders).toEqual(sliders);
        expect(value(withoutSliders(written))).toEqual(glb);
      }),
    );
  });

  it('pass the Khronos validator', async () => {
    for (const glb of [glbOf(twoBoxes), glbOf(twoBoxes, { extras: { mine: 1 } }), new Uint8Array(stool)]) {
      const written = value(embedSliders(glb, sliders));
      expect((await validateBytes(written, { maxIssues: 0 })).issues.messages).toEqual(
        (await validateBytes(glb, { maxIssues: 0 })).issues.messages,
      );
    }
  });

  const gltf = (root: Record<string, unknown>): Gltf => ({ json: root, binary: Buffer.alloc(4) });
  it.each<[string, Uint8Array, RegExp]>([
    ['no GLB', Buffer.from('{"asset":{}}, and more of it'), /^byte 0: this is no GLB/],
    ['a short one', Buffer.from('glTF'), /^byte 0: this is no GLB/],
    ['glTF 1', Buffer.from(stool).fill(1, 4, 5), /^byte 4: GLB version 1/],
    ['one that breaks off', Buffer.from(stool.subarray(0, 200)), /^byte 12: the JSON chunk/],
    ['extras that are no object', toGlb(gltf({ extras: 'mine' })), /^\/extras: the extras of the file are no object/],
    ['broken JSON', bytes('{"a":'), /^: this is no JSON/],
    ['a list', bytes('[]'), /^byte 20: the JSON chunk holds no object/],
  ])('cannot be put into %s', (_, glb, message) => {
    expect(refused(embedSliders(glb, sliders))).toMatch(message);
  });

  it('that are damaged are refused by their place', () => {
    const glb = toGlb(gltf({ extras: { parsel: { ...sliders, version: 3 } } }));
    expect(refused(slidersIn(glb))).toBe('/extras/parsel/version: version 3 is unknown');
  });
});
