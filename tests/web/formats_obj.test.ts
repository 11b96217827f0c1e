// OBJ and its materials as a GLB.
import { describe, expect, it } from 'vitest';
import { namesIn, objBox, opened, refusal, samples, shapeOf } from './format_samples';

describe('OBJ', () => {
  const box = (first: number, x = 0) => objBox(first, [x, 0, 0], [1, 1, 1]);

  it('has the colours of its MTL', async () => {
    const { gltf, remarks } = await opened(samples.obj);
    expect(remarks).toEqual([]);
    const { baseColorFactor, roughnessFactor, metallicFactor } = gltf.materials[0]?.pbrMetallicRoughness ?? {};
    expect(baseColorFactor).toEqual([0.214041, 0.050876, 0.010023, 1]);
    expect([roughnessFactor, metallicFactor]).toEqual([0.5, 0]);
  });

  it('is split by materials where an object has no name, and keeps them together where it has one', async () => {
    const faces = `${box(1)}\nusemtl b\n${box(9, 2)}`;
    const unnamed = await opened({ 'thing.obj': `usemtl a\n${faces}` });
    expect(unnamed.gltf.nodes.map(({ name }) => name)).toEqual(['a', 'b']);
    const named = await opened({ 'thing.obj': `o lamp\nusemtl a\n${faces}` });
    expect(named.gltf.nodes.map(({ name }) => name)).toEqual(['lamp']);
    expect(named.gltf.meshes[0]?.primitives.length).toBe(2);
  });

  it('calls what has no name after the file, with numbers', async () => {
    expect(await namesIn({ 'my chair.obj': `g default\n${box(1)}\ng Mesh.001\n${box(9, 2)}` })).toEqual([
      'my chair 1',
      'my chair 2',
    ]);
    expect(await namesIn({ 'chair.obj': box(1) })).toEqual(['chair']);
  });

  it('keeps faces of an object that has lines and points as well, and says what it left out', async () => {
    const { glb, remarks } = await opened({ 'a.obj': `o part\n${box(1)}\nl 1 2 3\np 1\ncurv 0 1 1 2\nvp 1 2\n` });
    expect(shapeOf(glb).parts.length).toBe(1);
    expect(remarks).toEqual(['Left out: lines, points, curves.']);
  });

  it('keeps corners where they are, and twice where they are twice', async () => {
    const { gltf } = await opened({ 'a.obj': box(1) });
    const position = gltf.meshes[0]?.primitives[0]?.attributes['POSITION'] ?? -1;
    expect(gltf.accessors[position]?.count).toBe(36);
  });

  it('takes line ends and continued lines of every kind, and negative indices', async () => {
    const text = 'v 0 0 0\r\nv 1 0 0\r\nv 0 1 \\\r\n 0\r\nv 0 0 1\rusemtl\tx\nf -4 -3 -2\nf 1 2 4\nf 1 3 4\nf 2 3 4\n';
    const { gltf } = await opened({ 'a.obj': text });
    expect(gltf.accessors.some(({ count }) => count === 12)).toBe(true);
  });

  it('says which files are missing, and opens', async () => {
    const { remarks } = await opened({ 'a.obj': `mtllib other.mtl\no part\n${box(1)}` });
    expect(remarks).toEqual(['Without other.mtl there are no colours: drop the files together.']);
    const mtl = 'newmtl m\nmap_Kd https://example.org/wood.png\nnewmtl n\nmap_Kd C:\\pictures\\old.tga\n';
    const found = await opened({
      'b/a.obj': `mtllib a.mtl\no part\nusemtl m\n${box(1)}`,
      'b/a.mtl': mtl,
      'b/old.tga': 'x',
    });
    expect(found.remarks).toEqual([
      'Not among the files: https://example.org/wood.png; drop them together with the model.',
      'Left out: C:\\pictures\\old.tga, since a GLB holds PNG and JPEG pictures alone.',
    ]);
  });

  it('takes pictures byte by byte, with v from the top', async () => {
    const png = Uint8Array.from([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10, 1, 2, 3, 4]);
    const text = 'mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.25\nvt 1 0.25\nvt 0 1\nf 1/1 2/2 3/3\n';
    const mtl = 'newmtl m\nKd 0 0 0\nmap_Kd -s 2 1 1 textures/wood.png\n';
    const { glb, gltf } = await opened({ 'a.obj': text, 'a.mtl': mtl, 'textures/Wood.png': png });
    const [image] = gltf.images ?? [];
    expect(image?.mimeType).toBe('image/png');
    const view = gltf.bufferViews[image?.bufferView ?? -1] ?? { byteLength: 0 };
    const start = 20 + new DataView(glb.buffer).getUint32(12, true) + 8 + (view.byteOffset ?? 0);
    expect(glb.slice(start, start + view.byteLength)).toEqual(png);
    expect(gltf.materials[0]?.pbrMetallicRoughness['baseColorFactor'] ?? [1, 1, 1, 1]).toEqual([1, 1, 1, 1]);
    const uv = gltf.accessors[gltf.meshes[0]?.primitives[0]?.attributes['TEXCOORD_0'] ?? -1];
    expect(uv?.count).toBe(3);
  });

  it.each([
    ['points alone', 'v 0 0 0\nv 1 0 0\n', /a\.obj holds points but no faces\. Make a surface of them first/],
    ['corners that are not there', 'o seat\nv 0 0 0\nf 1 2 3\n', /a\.obj, “seat” is damaged: a face has corners/],
    ['corners that are no numbers', 'v 0 0 x\nv 1 0 0\nv 0 1 0\nf 1 2 3\n', /no numbers/],
    ['another text', 'hello', /is empty or damaged: it has no faces/],
  ])('is refused with %s', async (_, text, sentence) => {
    expect(await refusal({ 'a.obj': text })).toMatch(sentence);
  });
});
