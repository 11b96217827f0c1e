// Draco- and Meshopt-compressed glTF to a plain GLB, which the core and the scene both read. Nodes and primitives keep
// their indices, and names, extras, materials and animations stay; KHR_mesh_quantization, which comes with Meshopt, stays
// as it is. Runs in a worker of its own (decompress.worker.ts).
import { type JSONDocument, Logger, Verbosity, WebIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { MeshoptDecoder } from 'meshoptimizer/decoder';
import { readJson } from '../formats/read_gltf';
import type { ModelFiles } from '../scene/load';

const compressions = ['KHR_draco_mesh_compression', 'EXT_meshopt_compression'];
const known = new Set(ALL_EXTENSIONS.map(({ EXTENSION_NAME }) => EXTENSION_NAME));

export interface Decompressed {
  /** A GLB with everything in it: buffers and images. */
  readonly glb: Uint8Array<ArrayBuffer>;
  /** Extensions of the file that did not come through. */
  readonly lost: readonly string[];
}

/**
 * The same files give the same bytes, so that a link finds its model by hash.
 * @param dracoModule the bytes of draco_decoder_gltf.wasm, asked for when the file needs them
 * Throws an Error when the compressed data is damaged.
 */
export async function decompress(files: ModelFiles, dracoModule: () => Promise<ArrayBuffer>): Promise<Decompressed> {
  const io = new WebIO().setLogger(new Logger(Verbosity.SILENT)).registerExtensions(ALL_EXTENSIONS);
  const { json, resources } = await read(files, io);
  const used = json.extensionsUsed ?? [];
  if (used.includes('KHR_draco_mesh_compression')) {
    const { default: createDecoder } = await import('draco3dgltf/draco_decoder_gltf_nodejs.js');
    io.registerDependencies({ 'draco3d.decoder': await createDecoder({ wasmBinary: await dracoModule() }) });
  }
  await MeshoptDecoder.ready;
  io.registerDependencies({ 'meshopt.decoder': MeshoptDecoder });

  const lost = used.filter((name) => !known.has(name));
  const required = (json.extensionsRequired ?? []).filter((name) => known.has(name));
  const document = await io.readJSON({ json: { ...json, extensionsRequired: required }, resources });
  const root = document.getRoot();
  for (const extension of root.listExtensionsUsed()) {
    if (compressions.includes(extension.extensionName)) extension.dispose();
  }
  const [buffer = document.createBuffer(), ...others] = root.listBuffers(); // a GLB has one
  for (const accessor of root.listAccessors()) accessor.setBuffer(buffer);
  for (const other of others) other.dispose();
  root.getAsset().generator = json.asset.generator ?? 'ParSEL'; // not the library with its version: it would be in the hash
  return { glb: await io.writeBinary(document), lost };
}

async function read(files: ModelFiles, io: WebIO): Promise<JSONDocument> {
  const { json, resources } = await readJson(files, io);
  // The Khronos extension is the vendor's under another name: same fields, and the decoder reads both bit streams.
  const text = JSON.stringify(json).replaceAll('"KHR_meshopt_compression"', '"EXT_meshopt_compression"');
  return { json: JSON.parse(text), resources };
}
