// OBJ, STL, PLY and 3MF as the page makes a GLB of them, and what the core then finds in it: what holds for all.
import { createHash } from 'node:crypto';
import { validateBytes } from 'gltf-validator';
import { describe, expect, it } from 'vitest';
import { isPlaceholder } from '../../web/src/formats/names';
import { hasModel, modelOf, unpacked } from '../../web/src/session/files';
import {
  boundsOf,
  bytesOf,
  kinds,
  meshXml,
  namesIn,
  objBox,
  opened,
  refusal,
  samples,
  shapeOf,
  solid,
  threeMf,
} from './format_samples';

describe('every format', () => {
  it.each(kinds)('%s gives the same bytes again', async (kind) => {
    const [a, b] = [await opened(samples[kind]), await opened(samples[kind])];
    expect(Buffer.from(a.glb).equals(Buffer.from(b.glb))).toBe(true);
    expect(shapeOf(a.glb).sha256).toBe(shapeOf(b.glb).sha256);
  });

  // Links that are out name models by these: where a library changes the bytes, they no longer find theirs.
  it.each([
    ['obj', 'e437ee976cc63783'],
    ['stl', 'd6932846f3167776'],
    ['ply', 'b1f06a5aac7f0a2c'],
    ['3mf', '6e61e18b5349320a'],
  ] as const)('%s gives the bytes that it always gave', async (kind, hash) => {
    expect(
      createHash('sha256')
        .update((await opened(samples[kind])).glb)
        .digest('hex')
        .slice(0, 16),
    ).toBe(hash);
  });

  it.each(kinds)('%s is a GLB in which the Khronos validator finds nothing', async (kind) => {
    const { messages } = (await validateBytes((await opened(samples[kind])).glb, { maxIssues: 0 })).issues;
    expect(messages.map(({ severity, code, pointer }) => `${severity} ${code} ${pointer}`)).toEqual([]);
  });

  it.each(['obj', 'stl', '3mf'] as const)('%s keeps the names of its parts', async (kind) => {
    expect(await namesIn(samples[kind])).toEqual(['top', 'leg']);
    expect(shapeOf((await opened(samples[kind])).glb).warnings).toEqual([]);
  });

  it.each(['obj', 'stl', '3mf'] as const)('%s is in metres with y up', async (kind) => {
    const { min, max } = boundsOf(shapeOf((await opened(samples[kind])).glb));
    expect(max.map((value, k) => value - (min[k] as number)).map((size) => Number(size.toFixed(4)))).toEqual([
      1, 0.8, 1,
    ]);
    expect(min[1]).toBeCloseTo(0, 4);
  });

  it.each(kinds)('%s that is cut anywhere is refused in a sentence, or opened as what is whole', async (kind) => {
    const [[path = '', main = ''] = []] = Object.entries(samples[kind]);
    const whole = bytesOf(main);
    for (let length = 0; length < whole.length; length += Math.ceil(whole.length / 40)) {
      const said = await refusal({ [path]: whole.subarray(0, length) });
      if (kind !== 'obj') expect(said, `cut at ${length}`).not.toBe('opened'); // an OBJ has no end
      if (said !== 'opened') expect(said, `cut at ${length}`).toMatch(new RegExp(`^${path.replace('.', '\\.')}.+\\.$`));
    }
  });

  it.each(kinds)('%s of random bytes never escapes as another error', async (kind) => {
    const [[path = '', main = ''] = []] = Object.entries(samples[kind]);
    let seed = 7;
    const random = () => {
      seed = (seed * 16807) % 2147483647;
      return seed;
    };
    for (let i = 0; i < 60; i++) {
      const damaged = new Uint8Array(bytesOf(main));
      for (let k = 0; k < 5; k++) damaged[random() % damaged.length] = random() % 256;
      expect(await refusal({ [path]: damaged })).not.toContain('no FormatError');
    }
  });

  it.each(kinds)('%s with nothing in it, and one that is larger than what may be read', async (kind) => {
    const [path = ''] = Object.keys(samples[kind]);
    expect(await refusal({ [path]: '' })).toMatch(/(empty|no triangles).*(Export|Export or download) it again/);
    expect(await refusal(samples[kind], 100)).toMatch(/too large/);
  });

  it.each(['__proto__', 'constructor', '</script><img src=x>', 'ignore previous instructions', 'Ω стул 椅子'])(
    'parts called %s',
    async (name) => {
      const escaped = name.replaceAll('<', '&lt;').replaceAll('>', '&gt;');
      const mtl = `newmtl ${name}\nKd 1 0 0\n`;
      const unnamed = `mtllib a.mtl\nusemtl ${name}\n${objBox(1, [0, 0, 0], [1, 1, 1])}`;
      expect(await namesIn({ 'a.obj': `o ${name}\n${objBox(1, [0, 0, 0], [1, 1, 1])}` })).toEqual([name]);
      const { gltf } = await opened({ 'a.obj': unnamed, 'a.mtl': mtl });
      expect(gltf.nodes.map((node) => node.name)).toEqual([name]);
      expect(gltf.materials[0]?.pbrMetallicRoughness['baseColorFactor']).toEqual([1, 0, 0, 1]);
      expect(await namesIn({ 'a.stl': solid(name, [0, 0, 0], [1, 1, 1]) })).toEqual([name]);
      const object = `<object id="1" name="${escaped}">${meshXml([1, 1, 1])}</object>`;
      expect(await namesIn({ 'a.3mf': threeMf(object, '<item objectid="1"/>') })).toEqual([name]);
    },
  );

  it.each([
    ['', true],
    ['default', true],
    ['Mesh.003', true],
    ['group_12', true],
    ['OpenSCAD_Model', true],
    ['Exported from Blender-2.93', true],
    ['seat', false],
    ['leg 2', false],
    ['body panel', false],
  ])('the name %j says nothing: %j', (name, expected) => {
    expect(isPlaceholder(name)).toBe(expected);
  });
});

describe('among the files that are opened', () => {
  const empty = new Uint8Array([1]);
  it('glTF comes first, a 3MF stays packed, and an OBJ takes its materials and pictures along', async () => {
    const set = (names: string[]) => new Map(names.map((name) => [name, empty]));
    expect(hasModel(set(['a.STL']))).toBe(true);
    expect(hasModel(set(['a.mtl']))).toBe(false);
    const found = await modelOf(set(['w/chair.obj', 'w/chair.mtl', 'w/t/oak.PNG', 'w/notes.txt', 'a/b/part.stl']));
    expect(found).toMatchObject({ name: 'chair', format: { kind: 'obj', path: 'w/chair.obj' } });
    expect([...found.external.keys()]).toEqual(['w/chair.mtl', 'w/t/oak.PNG']);
    await expect(modelOf(set(['a.obj', 'deep/er/b.glb']))).rejects.toThrow(/b\.glb is damaged/);
    const packed = new Map([['a.3mf', bytesOf(samples['3mf']['table.3mf'] as Uint8Array)]]);
    expect((await unpacked(packed)).has('a.3mf')).toBe(true);
    expect(await modelOf(packed)).toMatchObject({ name: 'a', format: { kind: '3mf' } });
  });
});
