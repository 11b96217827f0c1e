// A GLB without any name: what most models of the world look like. Geometry, materials and the order of nodes stay.

const named = [
  'nodes',
  'meshes',
  'materials',
  'scenes',
  'textures',
  'images',
  'samplers',
  'accessors',
  'bufferViews',
  'buffers',
  'cameras',
  'skins',
  'animations',
];

/** Models of the gallery that come once more without their names, as <id>_nameless. */
export const namelessIds = [
  'chair',
  'armchair',
  'bench',
  'bookcase',
  'desk',
  'dining_table',
  'cabinet',
  'bed',
  'ladder',
  'floor_lamp',
];

/** Models of the gallery that come once more as one surface, their parts fused, as <id>_fused. */
export const fusedIds = ['bench', 'desk'];

/** @param glb bytes of a GLB. @returns bytes of another */
export function withoutNames(glb) {
  const view = new DataView(glb.buffer, glb.byteOffset, glb.byteLength);
  const length = view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(glb.subarray(20, 20 + length)));
  delete json.extras;
  for (const list of named)
    for (const one of json[list] ?? []) {
      delete one.name;
      delete one.extras;
    }
  const text = new TextEncoder().encode(JSON.stringify(json));
  const padded = text.length + ((4 - (text.length % 4)) % 4);
  const rest = glb.subarray(20 + length);
  const out = new Uint8Array(20 + padded + rest.length).fill(0x20);
  out.set(glb.subarray(0, 20));
  out.set(text, 20);
  out.set(rest, 20 + padded);
  const head = new DataView(out.buffer);
  head.setUint32(8, out.length, true);
  head.setUint32(12, padded, true);
  return out;
}
