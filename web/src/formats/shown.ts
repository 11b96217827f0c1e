// What a GLB shows, part by part: triangles where they stand in the scene, for formats that have no nodes.
import { type Accessor, MathUtils, type Node, type Primitive, type Texture, type vec3 } from '@gltf-transform/core';
import type { InstancedMesh, Transform } from '@gltf-transform/extensions';
import { triangleList, trianglesOf } from '../carve/geometry';
import { apply, cofactors, determinant } from '../carve/matrix';
import { plainSurface } from './model';
import { compose, type Matrix } from './placing';

/** Linear red, green and blue, and opacity; 0 to 1. */
type Rgba = readonly [number, number, number, number];

export interface ShownSurface {
  readonly name: string;
  readonly color: Rgba;
  readonly emissive: readonly [number, number, number];
  readonly roughness: number;
  readonly texture: Texture | null;
}

/** Triangles with one surface: numbers a corner, in the scene's frame, in metres. */
export interface ShownPrimitive {
  readonly positions: Float64Array;
  readonly normals: Float64Array | null;
  /** From the upper left of the picture. */
  readonly uvs: Float64Array | null;
  /** Linear red, green and blue, times the surface's. */
  readonly colors: Float64Array | null;
  /** Three corners a triangle, counter-clockwise from outside. */
  readonly triangles: Uint32Array;
  /** Null: nothing is said of it. */
  readonly surface: ShownSurface | null;
}

/** A node with a mesh. */
export interface ShownNode {
  /** Its own name, else that of the nearest node around it that has one; may be empty. */
  readonly name: string;
  readonly primitives: readonly ShownPrimitive[];
}

/** Every time that a node and its mesh are drawn, instances by GPU one by one. Lines and points are left out. */
export function* shownOf(roots: readonly Node[], around = ''): Generator<ShownNode> {
  for (const node of roots) {
    const name = node.getName() || around;
    const primitives = (node.getMesh()?.listPrimitives() ?? []).filter((one) => one.getMode() >= triangleList);
    const isBent = node.getSkin() !== null; // a skeleton places it, at rest where its corners are
    for (const matrix of primitives.length === 0 ? [] : matricesOf(node)) {
      yield { name, primitives: primitives.map((one) => placed(one, isBent ? null : matrix)) };
    }
    yield* shownOf(node.listChildren(), name);
  }
}

/** Where a node's mesh is drawn. */
function matricesOf(node: Node): Matrix[] {
  const own = node.getWorldMatrix();
  const instances = node.getExtension<InstancedMesh>('EXT_mesh_gpu_instancing');
  const attributes = ['TRANSLATION', 'ROTATION', 'SCALE'].map((semantic) => instances?.getAttribute(semantic) ?? null);
  const count = Math.max(...attributes.map((attribute) => attribute?.getCount() ?? 0));
  if (count === 0) return [own];
  const [moves, turns, scales] = attributes as [Accessor | null, Accessor | null, Accessor | null];
  const at = <T extends number[]>(attribute: Accessor | null, i: number, rest: T): T =>
    attribute === null ? rest : (attribute.getElement(i, [...rest]) as T);
  return Array.from({ length: count }, (_, i) => {
    const inner = MathUtils.compose(at(moves, i, [0, 0, 0]), at(turns, i, [0, 0, 0, 1]), at(scales, i, [1, 1, 1]), [
      ...own,
    ] as Matrix);
    return compose(own, inner);
  });
}

/** @param matrix null: where its corners are */
function placed(primitive: Primitive, matrix: Matrix | null): ShownPrimitive {
  const surface = surfaceOf(primitive);
  const info = primitive.getMaterial()?.getBaseColorTextureInfo();
  const turn = matrix === null ? null : cofactors(matrix);
  const isMirrored = matrix !== null && determinant(matrix) < 0;
  const side = isMirrored ? -1 : 1; // what is mirrored looks the other way, as its triangles do
  const direction = (v: readonly number[]): vec3 => {
    const [x = 0, y = 0, z = 1] = v;
    const along = [0, 1, 2].map((row) =>
      turn === null
        ? (v[row] ?? 0)
        : side * ((turn[row] ?? 0) * x + (turn[3 + row] ?? 0) * y + (turn[6 + row] ?? 0) * z),
    );
    const length = Math.hypot(...along) || 1;
    return along.map((value) => value / length) as vec3;
  };
  const read = (semantic: string, size: number, change: (value: number[]) => readonly number[]) => {
    const accessor = primitive.getAttribute(semantic);
    if (accessor === null) return null;
    const values = new Float64Array(size * accessor.getCount());
    const element: number[] = [];
    for (let i = 0; i < accessor.getCount(); i++)
      values.set(change(accessor.getElement(i, element)).slice(0, size), size * i);
    return values;
  };
  const triangles = trianglesOf(primitive);
  for (let i = 0; isMirrored && i < triangles.length; i += 3) triangles.subarray(i + 1, i + 3).reverse();
  const layout = info?.getExtension<Transform>('KHR_texture_transform') ?? null;
  return {
    positions: onGrid(read('POSITION', 3, (p) => (matrix === null ? p : apply(matrix, p))) ?? new Float64Array()),
    normals: read('NORMAL', 3, direction),
    uvs: read(`TEXCOORD_${layout?.getTexCoord() ?? info?.getTexCoord() ?? 0}`, 2, (uv) => laid(layout, uv)),
    colors: read('COLOR_0', 3, (color) => color),
    triangles,
    surface,
  };
}

/**
 * Without what turning leaves: a millionth of a millionth where there was 0. In steps that are far finer than a 32-bit float, so
 * that what is at one becomes no other.
 */
function onGrid(positions: Float64Array): Float64Array {
  const most = positions.reduce((so, value) => Math.max(so, Math.abs(value)), 0);
  const step = most > 0 && Number.isFinite(most) ? 2 ** (Math.ceil(Math.log2(most)) - 40) : 1;
  return positions.map((value) => Math.round(value / step) * step + 0); // −0 is 0
}

/** Texture coordinates as KHR_texture_transform lays them: scaled, turned, moved. */
function laid(layout: Transform | null, [u = 0, v = 0]: readonly number[]): readonly number[] {
  if (layout === null) return [u, v];
  const [su, sv] = layout.getScale();
  const [ou, ov] = layout.getOffset();
  const [c, s] = [Math.cos(layout.getRotation()), Math.sin(layout.getRotation())];
  return [c * su * u + s * sv * v + ou, -s * su * u + c * sv * v + ov];
}

const surfaces = new WeakMap<object, ShownSurface>();

function surfaceOf(primitive: Primitive): ShownSurface | null {
  const material = primitive.getMaterial();
  if (material === null) return null;
  const known = surfaces.get(material) ?? {
    name: material.getName(),
    color: material.getBaseColorFactor() as unknown as Rgba,
    emissive: material.getEmissiveFactor(),
    roughness: material.getRoughnessFactor(),
    texture: material.getBaseColorTexture(),
  };
  surfaces.set(material, known);
  return isPlain(known) ? null : known;
}

/** What is made for files that say nothing of surfaces (model.ts): it has no place in them now either. */
const isPlain = ({ name, color, emissive, texture }: ShownSurface): boolean =>
  name === '' &&
  texture === null &&
  [...color, ...emissive].every((value, i) => Math.abs(value - ([...plainSurface.color, 0, 0, 0][i] ?? 0)) < 1e-6);
