// What the readers of other formats hand over: a tree of named nodes with their meshes, before it becomes a GLB (glb.ts).

/** Refused, in sentences for people: the place, what is wrong, what to do. */
export class FormatError extends Error {}

/** Formats that are read, by the extension of their files. */
export const formats = ['obj', '3mf', 'ply', 'stl'] as const;
export type Format = (typeof formats)[number];

/** A file to read, and what lies beside it. */
export interface Source {
  /** Its path among the files that were opened together, extension and all. */
  readonly path: string;
  readonly main: Uint8Array;
  /** The other files by their paths. */
  readonly external: ReadonlyMap<string, Uint8Array>;
}

export interface Texture {
  readonly bytes: Uint8Array;
  readonly type: 'image/png' | 'image/jpeg';
}

export interface Surface {
  readonly name: string;
  /** Linear red, green and blue, and opacity; 0 to 1. */
  readonly color: readonly [number, number, number, number];
  /** Linear red, green and blue; 0 to 1. */
  readonly emissive: readonly [number, number, number];
  /** 0 (a mirror) to 1. */
  readonly roughness: number;
  readonly texture: Texture | null;
}

export const plainSurface: Surface = {
  name: '',
  color: [0.8, 0.8, 0.8, 1],
  emissive: [0, 0, 0],
  roughness: 1,
  texture: null,
};

/** Triangles with one surface. */
export interface Primitive {
  /** Three numbers a corner, in the file's own frame and unit. */
  readonly positions: Float32Array;
  /** Three a triangle; null where the corners come in threes. */
  readonly indices: Uint32Array | null;
  /** Unit vectors, one a corner; null: flat. */
  readonly normals: Float32Array | null;
  /** Two numbers a corner, from the upper left of the picture. */
  readonly uvs: Float32Array | null;
  /** Linear red, green and blue of each corner, 0 to 1, times the surface's. */
  readonly colors: Float32Array | null;
  readonly surface: Surface;
}

export interface Node {
  /** As in the file; what to call it when that says nothing is decided in names.ts. */
  name: string;
  /** Column by column, 16 numbers, of a translation, rotation and scales; null: in place. */
  readonly matrix: readonly number[] | null;
  /** One array that several nodes share is one mesh. Empty: none. */
  readonly mesh: readonly Primitive[];
  readonly children: readonly Node[];
}

export interface Model {
  readonly nodes: readonly Node[];
  /** Metres a unit; 1 where the format has no unit. */
  readonly unit: number;
  /** Whether the file's z is up; else its y is, as in glTF. */
  readonly isZUp: boolean;
  /** What was left out or could not be found, in sentences. */
  readonly remarks: readonly string[];
}

export const leaf = (name: string, mesh: readonly Primitive[]): Node => ({ name, matrix: null, mesh, children: [] });

export const fileName = (path: string): string => path.slice(path.lastIndexOf('/') + 1);
export const baseName = (path: string): string => fileName(path).replace(/\.[^.]+$/, '');

/** UTF-8, or what older programs of the West wrote. */
export function decodeText(bytes: Uint8Array): string {
  try {
    return new TextDecoder('utf-8', { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder('windows-1252').decode(bytes);
  }
}

/**
 * A colour channel of sRGB, 0 to 1, as linear light. Rounded, since browsers differ in the last digits of a power, and one
 * file must give the same bytes in all of them: links find their model by its hash.
 */
export function linear(channel: number): number {
  const clamped = Math.min(Math.max(channel, 0), 1);
  return rounded(clamped <= 0.04045 ? clamped / 12.92 : ((clamped + 0.055) / 1.055) ** 2.4);
}

/** A channel of linear light as sRGB; both 0 to 1. */
export function nonLinear(channel: number): number {
  const clamped = Math.min(Math.max(channel, 0), 1);
  return rounded(clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * clamped ** (1 / 2.4) - 0.055);
}

/** To six digits. */
export const rounded = (value: number): number => Math.round(value * 1e6) / 1e6;

/** Directions made unit vectors, in place. What has none (zero, not a number) becomes +z: a triangle without area. */
export function toUnit(normals: Float32Array): Float32Array {
  for (let i = 0; i < normals.length; i += 3) {
    const [x = 0, y = 0, z = 0] = normals.subarray(i, i + 3);
    const length = Math.sqrt(x * x + y * y + z * z);
    const isDirection = length > 0 && Number.isFinite(length);
    normals.set(isDirection ? [x / length, y / length, z / length] : [0, 0, 1], i);
  }
  return normals;
}
