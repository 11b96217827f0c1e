// Compresses a GLB as exporters do, with the libraries' own encoders.
import { createRequire } from 'node:module';
import { PropertyType, WebIO } from '@gltf-transform/core';
import {
  ALL_EXTENSIONS,
  EXTMeshoptCompression,
  KHRDracoMeshCompression,
  KHRMeshQuantization,
} from '@gltf-transform/extensions';
import { MeshoptEncoder } from 'meshoptimizer/encoder';

const require = createRequire(new URL('../../web/package.json', import.meta.url));

export const compressions = ['Draco', 'Meshopt', 'Meshopt, quantized', 'Meshopt of Khronos'] as const;

/** @param glb positions within ±1, which is the range of the quantized form */
export async function compress(glb: Uint8Array, how: (typeof compressions)[number]): Promise<Buffer> {
  const io = new WebIO().registerExtensions(ALL_EXTENSIONS);
  const document = await io.readBinary(new Uint8Array(glb));
  if (how === 'Draco') {
    const { createEncoderModule } = require('draco3dgltf');
    io.registerDependencies({ 'draco3d.encoder': await createEncoderModule() });
    document.createExtension(KHRDracoMeshCompression).setRequired(true);
  } else {
    await MeshoptEncoder.ready;
    io.registerDependencies({ 'meshopt.encoder': MeshoptEncoder });
    document.createExtension(EXTMeshoptCompression).setRequired(true);
  }
  if (how === 'Meshopt, quantized') {
    document.createExtension(KHRMeshQuantization).setRequired(true);
    for (const accessor of document.getRoot().listAccessors()) {
      const isVertex = accessor.listParents().some(({ propertyType }) => propertyType === PropertyType.PRIMITIVE);
      const array = accessor.getArray();
      if (!isVertex || !(array instanceof Float32Array) || accessor.getType() !== 'VEC3') continue;
      accessor.setArray(Int16Array.from(array, (value) => Math.round(value * 32767))).setNormalized(true);
    }
  }
  const compressed = Buffer.from(await io.writeBinary(document));
  if (how !== 'Meshopt of Khronos') return compressed;
  // As long as the vendor's name, so that it can be put in its place.
  return Buffer.from(compressed.toString('latin1').replaceAll('EXT_meshopt_', 'KHR_meshopt_'), 'latin1');
}
