// A glTF file of any form as glTF-Transform takes it: a .glb, or a .gltf with what it refers to.
import type { JSONDocument, WebIO } from '@gltf-transform/core';

/** A file, and what it refers to by path. */
export interface GltfFiles {
  readonly main: Uint8Array;
  readonly external: ReadonlyMap<string, Uint8Array>;
}

export async function readJson({ main, external }: GltfFiles, io: WebIO): Promise<JSONDocument> {
  const bytes = new Uint8Array(main); // gltf-transform wants a buffer of its own
  const binary = bytes[0] === 0x67 && bytes[1] === 0x6c; // "gl", else "{"
  const { json, resources }: JSONDocument = binary
    ? await io.binaryToJSON(bytes)
    : { json: JSON.parse(new TextDecoder().decode(bytes)), resources: {} };
  for (const { uri } of [...(json.buffers ?? []), ...(json.images ?? [])]) {
    const found = uri === undefined ? undefined : external.get(decodeURIComponent(uri));
    if (uri !== undefined && found !== undefined) resources[uri] = new Uint8Array(found);
  }
  return { json, resources };
}
