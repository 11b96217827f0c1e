// The triangles of a GLB part by part, where they stand in the scene: in millimetres, z up, front towards -y, as printers
// and their programs count.
import { type JSONDocument, Logger, type Node, type Primitive, Verbosity, WebIO } from '@gltf-transform/core';
import { KHRMeshQuantization } from '@gltf-transform/extensions';
import type { Part } from './types';
import { turnedOver } from './weld';

const millimetres = 1000; // a metre

/** @param names of parts, by `node/primitive` as the core counts them; others are called after their node. */
export async function partsOf(glb: Uint8Array, names: ReadonlyMap<string, string>): Promise<Part[]> {
  const io = new WebIO().setLogger(new Logger(Verbosity.SILENT)).registerExtensions([KHRMeshQuantization]);
  const document = await io.readJSON(plain(await io.binaryToJSON(new Uint8Array(glb))));
  const root = document.getRoot();
  const numbers = new Map(root.listNodes().map((node, i) => [node, i]));
  const scene = root.getDefaultScene() ?? root.listScenes()[0];
  const parts: Part[] = [];
  scene?.traverse((node) => {
    const number = numbers.get(node) ?? -1;
    for (const [i, primitive] of (node.getMesh()?.listPrimitives() ?? []).entries()) {
      const triangles = trianglesOf(primitive);
      if (triangles.length === 0) continue;
      const name = names.get(`${number}/${i}`) ?? (node.getName() || `node ${number}`);
      parts.push({ name, node: number, ...placed(node, primitive, triangles) });
    }
  });
  return parts;
}

/** Without pictures and without what only they need: the triangles are all that is asked for. */
function plain({ json, resources }: JSONDocument): JSONDocument {
  const required = (json.extensionsRequired ?? []).filter((name) => name === KHRMeshQuantization.EXTENSION_NAME);
  const { images: _, textures: __, materials: ___, ...rest } = json;
  const meshes = (json.meshes ?? []).map((mesh) => ({
    ...mesh,
    primitives: mesh.primitives.map(({ material: ____, ...primitive }) => primitive),
  }));
  return { json: { ...rest, meshes, extensionsRequired: required }, resources };
}

/** Corners of triangles in threes, of strips and fans too; none of lines and points. */
export function trianglesOf(primitive: Primitive): Uint32Array {
  const indices = primitive.getIndices()?.getArray();
  const count = indices?.length ?? primitive.getAttribute('POSITION')?.getCount() ?? 0;
  const at = (i: number) => indices?.[i] ?? i;
  const mode = primitive.getMode();
  if (mode === 4) return Uint32Array.from({ length: count - (count % 3) }, (_, i) => at(i));
  if ((mode !== 5 && mode !== 6) || count < 3) return new Uint32Array(0);
  const triangles = new Uint32Array(3 * (count - 2));
  for (let i = 0; i + 2 < count; i++) {
    const odd = i % 2; // of a strip, every second one is the other way round
    const corners = mode === 6 ? [0, i + 1, i + 2] : [i + odd, i + 1 - odd, i + 2];
    triangles.set(corners.map(at), 3 * i);
  }
  return triangles;
}

/** Where the corners of a node's primitive stand in the scene. */
export function placed(
  node: Node,
  primitive: Primitive,
  triangles: Uint32Array,
): Pick<Part, 'positions' | 'triangles'> {
  const accessor = primitive.getAttribute('POSITION');
  const m = node.getWorldMatrix();
  const count = accessor?.getCount() ?? 0;
  const positions = new Float64Array(3 * count);
  const p: number[] = [];
  for (let i = 0; i < count; i++) {
    accessor?.getElement(i, p);
    const [x = 0, y = 0, z = 0] = p;
    const along = (row: number) =>
      millimetres * ((m[row] ?? 0) * x + (m[row + 4] ?? 0) * y + (m[row + 8] ?? 0) * z + (m[row + 12] ?? 0));
    positions[3 * i] = along(0);
    positions[3 * i + 1] = -along(2);
    positions[3 * i + 2] = along(1);
  }
  return { positions, triangles: isMirrored(m) ? turnedOver(triangles) : triangles };
}

/** Whether a matrix, column by column, turns triangles over. */
function isMirrored(m: readonly number[]): boolean {
  const [a = 0, b = 0, c = 0, , d = 0, e = 0, f = 0, , g = 0, h = 0, i = 0] = m;
  return a * (e * i - f * h) - d * (b * i - c * h) + g * (b * f - c * e) < 0;
}
