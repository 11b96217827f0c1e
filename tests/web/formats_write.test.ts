// A GLB as OBJ and STL: what is opened again is what there was.
import { Document, WebIO } from '@gltf-transform/core';
import { EXTMeshGPUInstancing, KHRTextureTransform } from '@gltf-transform/extensions';
import { strFromU8, unzipSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import { shortest } from '../../web/src/formats/text';
import { type Written, written } from '../../web/src/formats/write';
import { writeStl } from '../../web/src/formats/write_stl';
import {
  binaryStl,
  boundsOf,
  cornersOf,
  type Files,
  objBox,
  opened,
  samples,
  shapeOf,
  triangles,
} from './format_samples';
import { call, loadModule } from './module';

/** As files that can be opened. */
const filesOf = ({ extension, bytes }: Written): Files =>
  extension === 'zip' ? unzipSync(bytes) : { [`again.${extension}`]: bytes };

const textOf = (files: Files, ending: string) => {
  const [, content = ''] = Object.entries(files).find(([name]) => name.endsWith(ending)) ?? [];
  return typeof content === 'string' ? content : strFromU8(content);
};

const partsOf = (glb: Uint8Array) => {
  const shape = shapeOf(glb);
  const { min, max } = boundsOf(shape);
  return { names: shape.parts.map(({ name }) => name), bounds: [...min, ...max].map((value) => value + 0) }; // −0 is 0
};

describe.each(['obj', 'stl'] as const)('%s, written and opened again', (format) => {
  it('has the same parts where they were', async () => {
    const { glb } = await opened(samples[format]);
    const made = await written(glb, format, 'again');
    expect(made.remarks).toEqual([]);
    const again = await opened(filesOf(made));
    expect(again.remarks).toEqual([]);
    expect(partsOf(again.glb)).toEqual(partsOf(glb));
    expect(await written(glb, format, 'again')).toEqual(made);
    // Once more, from what was written: nothing changes any more.
    expect(filesOf(await written(again.glb, format, 'again'))).toEqual(filesOf(made));
  });

  it('has the parts of models of the gallery', async () => {
    const core = await loadModule();
    const gallery = call<{ models: { id: string }[] }>(core, 'gallery', {});
    for (const [i, { id }] of gallery.result.models.entries()) {
      if (!['chair', 'wagon_wheel', 'windmill'].includes(id)) continue;
      const glb = gallery.buffers[i] as Uint8Array;
      const before = partsOf(glb);
      const after = partsOf((await opened(filesOf(await written(glb, format, id)))).glb);
      expect(after.names.length, id).toBe(before.names.length);
      for (const [k, value] of after.bounds.entries()) expect(value, id).toBeCloseTo(before.bounds[k] ?? Number.NaN, 3);
    }
  }, 60_000);

  it('is no file of nothing', async () => {
    const document = new Document();
    document.createScene().addChild(document.createNode('empty'));
    const glb = await new WebIO().writeBinary(document);
    await expect(written(glb, format, 'nothing')).rejects.toThrow(/no triangle to write. Show some/);
  });
});

describe('OBJ', () => {
  it('keeps materials, pictures and where they lie, and joins corners at one place', async () => {
    const png = Uint8Array.from([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10, 1, 2, 3, 4]);
    const files = {
      'a.obj': `mtllib a.mtl\nvt 0.25 0.75\no lamp\nusemtl dark oak\n${objBox(1, [0, 0, 0], [1, 1, 1])}\nusemtl glass\n${objBox(9, [2, 0, 0], [1, 1, 1]).replaceAll(/(?<=^f.*)\b(\d+)\b/gm, '$1/1')}`,
      'a.mtl': 'newmtl dark oak\nKd 0.5 0.25 0.1\nNs 250\nnewmtl glass\nKd 1 1 1\nd 0.5\nKe 0 0.5 0\nmap_Kd w.png\n',
      'w.png': png,
    };
    const { glb, gltf } = await opened(files);
    const again = filesOf(await written(glb, 'obj', 'again'));
    expect(Object.keys(again)).toEqual(['again.obj', 'again.mtl', 'again_1.png']);
    expect(again['again_1.png']).toEqual(png);
    expect(textOf(again, '.obj').match(/^v /gm)?.length).toBe(16); // of 72 corners
    expect(textOf(again, '.obj').match(/^vt .*$/gm)).toContain('vt 0.25 0.75');
    const read = await opened(again);
    expect(read.gltf.nodes.map(({ name }) => name)).toEqual(['lamp']);
    expect(read.gltf.materials).toEqual(
      gltf.materials.map((material) => ({ ...material, name: material.name?.replace(' ', '_') })),
    );
  });

  it('that never had materials gets none', async () => {
    const { glb } = await opened({ 'a.obj': `o lamp\n${objBox(1, [0, 0, 0], [1, 1, 1])}` });
    expect(Object.keys(filesOf(await written(glb, 'obj', 'again')))).toEqual(['again.obj']);
  });

  it('keeps colours of corners', async () => {
    const colored = (color: string) => samples.ply['box.ply']?.toString().replaceAll('255 128 0', color) ?? '';
    const { glb } = await opened({ 'box.ply': colored('255 128 0') });
    const text = textOf(filesOf(await written(glb, 'obj', 'box')), '.obj');
    expect(text).toMatch(/^v \S+ \S+ \S+ 1 0\.50196\d* 0$/m);
  });

  it('says what it has no place for', async () => {
    const document = new Document();
    const picture = document.createTexture().setImage(Uint8Array.of(1)).setMimeType('image/png');
    const material = document.createMaterial('steel').setMetallicFactor(1).setNormalTexture(picture);
    const { remarks } = await written(await boxGlb(document, (node) => node, material), 'obj', 'a');
    expect(remarks).toEqual(['Left out, since OBJ has no place for it: metal, normal maps.']);
    const stl = await written(await boxGlb(document, (node) => node, material), 'stl', 'a');
    expect(stl.remarks).toEqual(['Left out, since STL has no place for it: colours and pictures.']);
  });
});

/** A box of 1 × 2 × 3 with outward triangles under a node that `place` places. */
async function boxGlb(
  document: Document,
  place: (node: ReturnType<Document['createNode']>) => unknown,
  material: ReturnType<Document['createMaterial']> | null = null,
): Promise<Uint8Array> {
  const [buffer = document.createBuffer()] = document.getRoot().listBuffers();
  const positions = new Float32Array(cornersOf([0, 0, 0], [1, 2, 3]).flat());
  const primitive = document
    .createPrimitive()
    .setMaterial(material)
    .setAttribute('POSITION', document.createAccessor().setType('VEC3').setArray(positions).setBuffer(buffer))
    .setIndices(document.createAccessor().setArray(new Uint16Array(triangles.flat())).setBuffer(buffer));
  const node = document.createNode('box').setMesh(document.createMesh().addPrimitive(primitive));
  place(node);
  const scene = document.createScene().addChild(node);
  document.getRoot().setDefaultScene(scene);
  return new WebIO().registerExtensions([EXTMeshGPUInstancing, KHRTextureTransform]).writeBinary(document);
}

/** Six times the volume inside the triangles of an OBJ; negative when they face inwards. */
function volumeOf(text: string): number {
  const corners = [...text.matchAll(/^v (.*)$/gm)].map(([, line = '']) => line.split(' ').map(Number));
  let sum = 0;
  for (const [, line = ''] of text.matchAll(/^f (.*)$/gm)) {
    const [a = [], b = [], c = []] = line.split(' ').map((corner) => corners[Number.parseInt(corner, 10) - 1] ?? []);
    const at = (v: number[], k: number) => v[k % 3] ?? Number.NaN;
    for (const k of [0, 1, 2]) sum += at(a, k) * (at(b, k + 1) * at(c, k + 2) - at(b, k + 2) * at(c, k + 1));
  }
  return sum;
}

describe('what is mirrored, or drawn many times', () => {
  const objOf = async (place: Parameters<typeof boxGlb>[1], document = new Document()) =>
    textOf(filesOf(await written(await boxGlb(document, place), 'obj', 'box')), '.obj');

  it('faces outwards, however it is placed', async () => {
    expect(volumeOf(await objOf((node) => node))).toBeCloseTo(36);
    expect(volumeOf(await objOf((node) => node.setScale([-1, 2, 1])))).toBeCloseTo(72);
    expect(volumeOf(await objOf((node) => node.setTranslation([5, 0, 0]).setRotation([0, 1, 0, 0])))).toBeCloseTo(36);
  });

  it('is written as often as it is drawn', async () => {
    const document = new Document();
    const moves = document
      .createAccessor()
      .setType('VEC3')
      .setArray(new Float32Array([0, 0, 0, 10, 0, 0, 20, 0, 0]));
    moves.setBuffer(document.createBuffer());
    const batch = document
      .createExtension(EXTMeshGPUInstancing)
      .createInstancedMesh()
      .setAttribute('TRANSLATION', moves);
    const text = await objOf(
      (node) => node.setExtension('EXT_mesh_gpu_instancing', batch).setScale([2, 1, 1]),
      document,
    );
    expect(text.match(/^o box$/gm)?.length).toBe(3);
    expect(Math.max(...[...text.matchAll(/^v (\S+)/gm)].map(([, x]) => Number(x)))).toBe(42);
  });
});

describe('STL', () => {
  it('of one part stays binary, to the corner', async () => {
    const file = binaryStl([1.1, 2.7, 3.3], [10.01, 20.02, 30.03]);
    const { glb } = await opened({ 'box.stl': file });
    const { bytes } = await written(glb, 'stl', 'box');
    expect(bytes.length).toBe(file.length);
    const [now, before] = [new DataView(bytes.buffer), new DataView(file.buffer, file.byteOffset)];
    for (let t = 0; t < 12; t++)
      for (let k = 3; k < 12; k++) {
        const at = 84 + 50 * t + 4 * k;
        expect(now.getFloat32(at, true)).toBeCloseTo(before.getFloat32(at, true), 5);
      }
    expect(new DataView(bytes.buffer).getFloat32(84 + 8, true)).toBe(-1); // the normal of what lies below
  });

  it('of very many triangles in several parts is one solid, which is said', () => {
    const three = { positions: new Float64Array(9), triangles: new Uint32Array(9) };
    const node = { name: 'a', primitives: [{ ...three, normals: null, uvs: null, colors: null, surface: null }] };
    const isMerged = (nodes: (typeof node)[], most: number) => writeStl(nodes, () => {}, most).isMerged;
    expect([isMerged([node, node], 5), isMerged([node, node], 6), isMerged([node], 2)]).toEqual([true, false, false]);
  });
});

it('numbers are as short as they can be without becoming others', () => {
  expect([0.1, 1 / 3, 0, -2, 1e-7, 123456.789].map(shortest)).toEqual([
    '0.1',
    '0.33333334',
    '0',
    '-2',
    '1e-7',
    '123456.79',
  ]);
  for (let i = 0; i < 1000; i++) {
    const value = Math.fround((Math.sin(i * 12.9898) * 43758.5453) / 10 ** (i % 9));
    expect(Math.fround(Number(shortest(value)))).toBe(value);
  }
});
