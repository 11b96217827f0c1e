export interface Gltf {
  json: Record<string, unknown>;
  binary: Buffer;
}
export function toGlb(gltf: Gltf): Buffer;
export function meshGlb(
  points: Float32Array,
  triangles: ArrayLike<number>,
  options?: { generator?: string; material?: object },
): Buffer;
