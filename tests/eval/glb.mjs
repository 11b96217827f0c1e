// Writes parts as a GLB: a node, a mesh and a primitive each.

/**
 * @param {{ label: string, material: string, corners: number[] }[]} parts
 * @param {import('./obj.mjs').Obj} obj
 * @param {(name: string) => { colour: number[], opacity: number, shininess: number, image: Uint8Array | null }} materialOf
 *   image: PNG or JPEG
 * @param {object} asset what glTF's asset says besides its version
 * @returns {Buffer}
 */
export function writeGlb(parts, obj, materialOf, asset) {
  const chunks = [];
  let length = 0;
  const json = { asset: { version: '2.0', ...asset }, scene: 0, scenes: [{ nodes: parts.map((_, i) => i) }] };
  Object.assign(json, { nodes: [], meshes: [], materials: [], accessors: [], bufferViews: [] });
  const view = (bytes, target) => {
    json.bufferViews.push({ buffer: 0, byteOffset: length, byteLength: bytes.byteLength, ...(target && { target }) });
    const padding = Buffer.alloc((4 - (bytes.byteLength % 4)) % 4);
    chunks.push(Buffer.from(bytes.buffer, bytes.byteOffset, bytes.byteLength), padding);
    length += bytes.byteLength + padding.length;
    return json.bufferViews.length - 1;
  };
  const accessor = (array, componentType, type, width, extra) => {
    const target = type === 'SCALAR' ? 34963 : 34962;
    json.accessors.push({
      bufferView: view(array, target),
      componentType,
      type,
      count: array.length / width,
      ...extra,
    });
    return json.accessors.length - 1;
  };
  const materials = new Map();
  const materialIndex = (name) => {
    if (!materials.has(name)) {
      materials.set(name, json.materials.length);
      json.materials.push(material(name, materialOf(name)));
    }
    return materials.get(name);
  };
  const material = (name, { colour, opacity, shininess, image }) => {
    const linear = colour.map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
    const baseColorFactor = [...(image ? [1, 1, 1] : linear), opacity];
    // Blinn-Phong's exponent as roughness (Walter et al. 2007, §5.4).
    const pbr = { baseColorFactor, metallicFactor: 0, roughnessFactor: Math.sqrt(2 / (Math.max(0, shininess) + 2)) };
    if (image) {
      json.images ??= [];
      json.textures ??= [];
      json.images.push({ bufferView: view(image), mimeType: image[0] === 0x89 ? 'image/png' : 'image/jpeg' });
      json.textures.push({ source: json.images.length - 1 });
      pbr.baseColorTexture = { index: json.textures.length - 1 };
    }
    return { name, pbrMetallicRoughness: pbr, doubleSided: true, ...(opacity < 1 && { alphaMode: 'BLEND' }) };
  };
  for (const part of parts) {
    const { positions, normals, uvs, indices } = vertices(part.corners, obj);
    const bounds = (pick) =>
      [0, 1, 2].map((k) => positions.reduce((best, x, i) => (i % 3 === k ? pick(best, x) : best), positions[k]));
    const attributes = {
      POSITION: accessor(positions, 5126, 'VEC3', 3, { min: bounds(Math.min), max: bounds(Math.max) }),
    };
    if (normals) attributes.NORMAL = accessor(normals, 5126, 'VEC3', 3);
    if (uvs) attributes.TEXCOORD_0 = accessor(uvs, 5126, 'VEC2', 2);
    const primitive = {
      attributes,
      indices: accessor(indices, 5125, 'SCALAR', 1),
      material: materialIndex(part.material),
    };
    json.nodes.push({ name: part.label, mesh: json.meshes.length });
    json.meshes.push({ primitives: [primitive] });
  }
  json.buffers = [{ byteLength: length }];
  return assemble(json, Buffer.concat(chunks));
}

/** Corners become vertices, equal ones shared. */
function vertices(corners, obj) {
  const hasNormals = corners.every((index, i) => i % 3 !== 2 || index >= 0);
  const hasUvs = corners.every((index, i) => i % 3 !== 1 || index >= 0);
  const numbers = new Map();
  const indices = new Uint32Array(corners.length / 3);
  const unique = [];
  for (let i = 0; i < indices.length; i++) {
    const [v, t, n] = corners.slice(3 * i, 3 * i + 3);
    const key = `${v}/${hasUvs ? t : ''}/${hasNormals ? n : ''}`;
    if (!numbers.has(key)) {
      numbers.set(key, unique.length);
      unique.push([v, t, n]);
    }
    indices[i] = numbers.get(key);
  }
  const gather = (source, width, which) =>
    Float32Array.from({ length: unique.length * width }, (_, i) => {
      return source[width * unique[Math.floor(i / width)][which] + (i % width)];
    });
  const normals = hasNormals ? gather(obj.normals, 3, 2) : null;
  for (let i = 0; i < (normals?.length ?? 0); i += 3) {
    const size = Math.hypot(normals[i], normals[i + 1], normals[i + 2]);
    if (size > 0) for (let k = 0; k < 3; k++) normals[i + k] /= size;
    else normals[i + 1] = 1;
  }
  // OBJ's texture coordinates start at the bottom, glTF's at the top.
  const uvs = hasUvs ? gather(obj.uvs, 2, 1).map((x, i) => (i % 2 === 1 ? 1 - x : x)) : null;
  return { positions: gather(obj.positions, 3, 0), normals, uvs, indices };
}

function assemble(json, binary) {
  const chunk = (type, data, filler) => {
    const padded = Buffer.concat([data, Buffer.alloc((4 - (data.length % 4)) % 4, filler)]);
    const header = Buffer.alloc(8);
    header.writeUInt32LE(padded.length, 0);
    header.writeUInt32LE(type, 4);
    return Buffer.concat([header, padded]);
  };
  const body = Buffer.concat([
    chunk(0x4e4f534a, Buffer.from(JSON.stringify(json)), 0x20),
    chunk(0x004e4942, binary, 0),
  ]);
  const header = Buffer.alloc(12);
  header.writeUInt32LE(0x46546c67, 0);
  header.writeUInt32LE(2, 4);
  header.writeUInt32LE(12 + body.length, 8);
  return Buffer.concat([header, body]);
}
