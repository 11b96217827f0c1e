// Writes a GLB: what tools and tests make models with.

const chunk = (type, data, fill) => {
  const padding = Buffer.alloc((4 - (data.length % 4)) % 4, fill);
  const head = Buffer.alloc(8);
  head.writeUInt32LE(data.length + padding.length, 0);
  head.writeUInt32LE(type, 4);
  return Buffer.concat([head, data, padding]);
};

export function toGlb({ json, binary }) {
  const text = Buffer.from(JSON.stringify(json));
  const chunks = Buffer.concat([chunk(0x4e4f534a, text, 0x20), chunk(0x004e4942, binary, 0)]);
  const head = Buffer.alloc(12);
  head.write('glTF', 0);
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + chunks.length, 8);
  return Buffer.concat([head, chunks]);
}

/** One mesh of one primitive: points (Float32Array: x, y, z in metres, y up), triangles, and a glTF material, if any. */
export function meshGlb(points, triangles, { generator, material } = {}) {
  const bound = (pick) =>
    [0, 1, 2].map((k) => points.reduce((best, x, i) => (i % 3 === k ? pick(best, x) : best), points[k]));
  const primitive = { attributes: { POSITION: 0 }, indices: 1, ...(material && { material: 0 }) };
  const json = {
    asset: { version: '2.0', ...(generator && { generator }) },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [primitive] }],
    ...(material && { materials: [material] }),
    accessors: [
      {
        bufferView: 0,
        componentType: 5126,
        type: 'VEC3',
        count: points.length / 3,
        min: bound(Math.min),
        max: bound(Math.max),
      },
      { bufferView: 1, componentType: 5125, type: 'SCALAR', count: triangles.length },
    ],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: points.byteLength, target: 34962 },
      { buffer: 0, byteOffset: points.byteLength, byteLength: 4 * triangles.length, target: 34963 },
    ],
    buffers: [{ byteLength: points.byteLength + 4 * triangles.length }],
  };
  const binary = Buffer.concat([Buffer.from(points.buffer), Buffer.from(Uint32Array.from(triangles).buffer)]);
  return toGlb({ json, binary });
}
