// STL and PLY as a GLB.
import { describe, expect, it } from 'vitest';
import { binaryStl, cornersOf, namesIn, opened, ply, quads, refusal, samples, shapeOf, solid } from './format_samples';

describe('STL', () => {
  it('is one part when it is binary, whatever its header says', async () => {
    for (const header of ['made by a test', 'solid of a CAD program'])
      expect(await namesIn({ 'bracket.stl': binaryStl([0, 0, 0], [10, 20, 30], header) })).toEqual(['bracket']);
    const longer = Buffer.concat([binaryStl([0, 0, 0], [10, 20, 30], 'solid'), Buffer.from('trailing')]);
    expect(await namesIn({ 'bracket.stl': longer })).toEqual(['bracket']);
  });

  it('turns and scales by a node, not by its corners', async () => {
    const { gltf } = await opened({ 'bracket.stl': binaryStl([0, 0, 0], [10, 20, 30]) });
    const frame = gltf.nodes.find(({ children }) => children !== undefined);
    expect(frame?.scale).toEqual([0.001, 0.001, 0.001]);
    expect(frame?.rotation).toEqual([-Math.SQRT1_2, 0, 0, Math.SQRT1_2]);
    const position = gltf.meshes[0]?.primitives[0]?.attributes['POSITION'] ?? -1;
    expect(gltf.accessors[position]).toMatchObject({ count: 36, max: [10, 20, 30] });
    expect(Object.keys(gltf.meshes[0]?.primitives[0]?.attributes ?? {})).toEqual(['POSITION']);
  });

  it('reads solids with odd names, with none, and in capitals', async () => {
    const odd = solid('my solid facet', [0, 0, 0], [1, 1, 1]) + solid('', [3, 0, 0], [1, 1, 1]);
    expect(await namesIn({ 'a.stl': odd })).toEqual(['my solid facet', 'a']);
    const capitals = solid('seat', [0, 0, 0], [1, 1, 1]).replace(/\b(?:solid|facet|vertex|endsolid)\b/g, (word) =>
      word.toUpperCase(),
    );
    expect(await namesIn({ 'a.stl': capitals })).toEqual(['seat']);
  });

  it.each([
    [
      'a binary file that breaks off',
      binaryStl([0, 0, 0], [1, 1, 1]).subarray(0, 300),
      /says 12 triangles and holds 4/,
    ],
    ['no triangle', Buffer.alloc(84), /holds no triangles/],
    ['an empty solid', 'solid a\nendsolid a\n', /holds no triangles/],
    ['a solid that breaks off', solid('a', [0, 0, 0], [1, 1, 1]).slice(0, -40), /breaks off or is damaged/],
    ['a corner that is no number', solid('a', [0, 0, 0], [1, 1, 1]).replace('vertex 0', 'vertex x'), /damaged/],
    ['infinite corners', binaryStl([0, 0, Number.POSITIVE_INFINITY], [1, 1, 1]), /damaged: .* finite numbers/],
  ])('is refused with %s', async (_, content, sentence) => {
    expect(await refusal({ 'a.stl': content })).toMatch(sentence);
  });
});

describe('PLY', () => {
  it('has the colours of its vertices, and faces with many corners', async () => {
    const { gltf, glb } = await opened(samples.ply);
    const [primitive] = gltf.meshes[0]?.primitives ?? [];
    expect(Object.keys(primitive?.attributes ?? {}).sort()).toEqual(['COLOR_0', 'POSITION']);
    expect(gltf.accessors[primitive?.indices ?? -1]?.count).toBe(36);
    expect(shapeOf(glb).parts.map(({ name }) => name)).toEqual(['box']);
    const five = await opened({ 'a.ply': ply([[0, 1, 2, 3, 7], ...quads]) });
    expect(five.gltf.accessors[five.gltf.meshes[0]?.primitives[0]?.indices ?? -1]?.count).toBe(45);
  });

  it.each(['binary_little_endian', 'binary_big_endian'])('is the same when it is %s', async (format) => {
    const little = format === 'binary_little_endian';
    const header = ply()
      .slice(0, ply().indexOf('end_header\n') + 11)
      .replace('ascii', format);
    const vertices = cornersOf([0, 0, 0], [1, 2, 3]).map((corner) => {
      const bytes = Buffer.alloc(15);
      for (const [k, value] of corner.entries())
        little ? bytes.writeFloatLE(value, 4 * k) : bytes.writeFloatBE(value, 4 * k);
      bytes.set([255, 128, 0], 12);
      return bytes;
    });
    const faces = quads.map((quad) => {
      const bytes = Buffer.alloc(17);
      bytes[0] = 4;
      for (const [k, corner] of quad.entries())
        little ? bytes.writeInt32LE(corner, 1 + 4 * k) : bytes.writeInt32BE(corner, 1 + 4 * k);
      return bytes;
    });
    const binary = Buffer.concat([Buffer.from(header), ...vertices, ...faces]);
    const { glb } = await opened({ 'box.ply': binary });
    expect(Buffer.from(glb).equals(Buffer.from((await opened(samples.ply)).glb))).toBe(true);
    expect(await refusal({ 'box.ply': binary.subarray(0, -1) })).toMatch(/box\.ply breaks off/);
  });

  it.each([
    ['a point cloud', ply([]), /a\.ply is a point cloud: it has no faces\. Make a surface of it first/],
    [
      'Gaussian splats',
      ply([]).replace('property uchar red', 'property float f_dc_0\nproperty uchar red'),
      /Gaussian splats/,
    ],
    ['vertices that are not there', ply([[0, 1, 8]]), /face 0 has vertex 8 of 8/],
    ['a word for a number', ply().replace('255 128', '255 red'), /“red” stands where a number should/],
    ['a newer version', ply().replace('ascii 1.0', 'ascii 2.0'), /format “ascii 2\.0”, which is not known/],
    ['billions of vertices', ply().replace('vertex 8', 'vertex 4000000000'), /breaks off/],
    [
      'a header of another kind',
      ply().replace('property float x', 'property real x'),
      /line 5 is no part of a PLY header/,
    ],
  ])('is refused: %s', async (_, text, sentence) => {
    expect(await refusal({ 'a.ply': text })).toMatch(sentence);
  });
});
