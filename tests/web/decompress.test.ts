// Compressed models, decompressed as the page does it, against the same models plain.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { describe, expect, it } from 'vitest';
import type { Shape } from '../../web/src/program/types';
import type { ModelFiles } from '../../web/src/scene/load';
import { gltfJson } from '../../web/src/session/files';
import { decompress } from '../../web/src/worker/decompress';
import { toGlb } from '../../web/tools/glb.mjs';
import { stool, stoolGltf } from '../e2e/fixture';
import { compress, compressions } from './compressed';
import { loadModule } from './module';

const require = createRequire(new URL('../../web/package.json', import.meta.url));
const dracoModule = async () => {
  const bytes = await readFile(require.resolve('draco3dgltf/draco_decoder_gltf.wasm'));
  return new Uint8Array(bytes).buffer;
};
const files = (main: Uint8Array, external: ModelFiles['external'] = new Map()): ModelFiles => ({
  name: 'model',
  main,
  external,
});
const plain = async (main: Uint8Array) => (await decompress(files(main), dracoModule)).glb;

interface Node {
  name: string;
  extras?: object;
}

const core = await loadModule();
function shapeOf(glb: Uint8Array): Shape {
  const parameters = JSON.stringify({ name: 'model', external: [] });
  const reply = JSON.parse(core.invoke('open', parameters, [new Uint8Array(glb)], null).json);
  if (reply.error) throw new Error(`${reply.error.place}: ${reply.error.cause}`);
  return reply.result.shape;
}

/** A model of the gallery, as the core makes it. */
function galleryModel(id: string): Uint8Array {
  const { json, buffers } = core.invoke('gallery', '{}', [], null);
  const models = JSON.parse(json).result.models as { id: string }[];
  const found = buffers[models.findIndex((model) => model.id === id)];
  if (found === undefined) throw new Error(`the gallery has no ${id}`);
  return found;
}

/** What has to be the same: parts and where they come from, relations. */
const outline = ({ parts, relations }: Shape) => ({
  parts: parts.map(({ id, label, name, node, primitive }) => ({ id, label, name, node, primitive })),
  relations: relations.map(({ id, kind, parts: tied }) => ({ id, kind, parts: tied })),
});

describe.each(compressions)('a model compressed with %s', (how) => {
  it.each([
    ['the stool', stool],
    ['the chair of the gallery', galleryModel('chair')],
  ])('becomes the shape that it was: %s', async (_, glb) => {
    const compressed = await compress(glb, how);
    expect(gltfJson(compressed)?.['extensionsRequired']).toBeDefined();
    const before = shapeOf(glb);
    const after = shapeOf(await plain(compressed));
    expect(after.warnings).toEqual(before.warnings);
    expect(outline(after)).toEqual(outline(before));
    const corners = (shape: Shape) => shape.parts.flatMap((part) => part.corners.flat());
    const now = corners(after);
    const worst = Math.max(...corners(before).map((value, i) => Math.abs(value - (now[i] as number))));
    expect(worst).toBeLessThan(1e-3); // of the half-diagonal: the encoders round positions
  });

  it('keeps names, extras, materials and the number of nodes, and is no longer compressed', async () => {
    const { json, binary } = stoolGltf();
    const nodes = (json['nodes'] as Node[]).map((node, i) => ({ ...node, extras: { label: `l${i}` } }));
    const compressed = await compress(toGlb({ json: { ...json, nodes }, binary }), how);
    const before = gltfJson(compressed) ?? {};
    const after = gltfJson(await plain(compressed)) ?? {};
    const named = (list: unknown) => (list as Node[]).map(({ name, extras }) => ({ name, extras }));
    expect(named(after['nodes'])).toEqual(named(nodes));
    expect(after['materials']).toEqual(before['materials']);
    expect(after['asset']).toEqual(before['asset']);
    expect(JSON.stringify(after)).not.toMatch(/draco|meshopt_/i);
  });

  it('gives the same bytes again', async () => {
    const compressed = await compress(stool, how);
    expect(Buffer.from(await plain(compressed)).equals(Buffer.from(await plain(compressed)))).toBe(true);
  });

  it('is refused when it breaks off or is damaged, at any place', async () => {
    const compressed = await compress(stool, how);
    for (let length = 12; length < compressed.length - 4; length += Math.ceil(compressed.length / 12)) {
      await expect(plain(compressed.subarray(0, length)), `cut at ${length}`).rejects.toThrow();
    }
  });
});

describe('decompression', () => {
  it('reads a .gltf whose buffer has an escaped name', async () => {
    const compressed = await compress(stool, 'Meshopt');
    const json = gltfJson(compressed) as { buffers: { uri?: string }[] };
    const start = 20 + compressed.readUInt32LE(12) + 8;
    (json.buffers[0] as { uri?: string }).uri = 'my%20data.bin';
    const external = new Map([['my data.bin', new Uint8Array(compressed.subarray(start))]]);
    const { glb } = await decompress(files(Buffer.from(JSON.stringify(json)), external), dracoModule);
    expect(outline(shapeOf(glb))).toEqual(outline(shapeOf(stool)));
  });

  it('names the extensions that it loses, and reads the file all the same', async () => {
    const compressed = await compress(stool, 'Draco');
    const text = compressed.subarray(20, 20 + compressed.readUInt32LE(12)).toString();
    const json = JSON.parse(text);
    for (const list of ['extensionsUsed', 'extensionsRequired']) json[list].push('ACME_unheard_of');
    const binary = compressed.subarray(20 + text.length + 8);
    const { glb, lost } = await decompress(files(toGlb({ json, binary })), dracoModule);
    expect(lost).toEqual(['ACME_unheard_of']);
    expect(outline(shapeOf(glb))).toEqual(outline(shapeOf(stool)));
  });
});
