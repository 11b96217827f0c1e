// The file that a CAD program makes, with its parts cut: names, colours and places stay, triangles are what is left.
import { type Document, Logger, type Node, type Primitive, Verbosity, WebIO } from '@gltf-transform/core';
import type { ManifoldToplevel } from 'manifold-3d/manifold';
import type { CadProgram } from './cad';
import { cutParts, type Drawn, type State } from './cut';
import { placed, trianglesOf } from './parts';
import type { Triangles } from './types';
import { cross, dot, type Vec } from './vectors';
import { turnedOver } from './weld';

/**
 * @param glb edited or not
 * @param nodes of the parts that add material, by their ids in the program
 */
export async function cutFile(
  glb: Uint8Array,
  program: CadProgram,
  nodes: ReadonlyMap<string, number>,
  state: State,
  manifold: ManifoldToplevel,
): Promise<Uint8Array<ArrayBuffer>> {
  const io = new WebIO().setLogger(new Logger(Verbosity.SILENT));
  const document = await io.readBinary(new Uint8Array(glb));
  const root = document.getRoot();
  const generator = root.getAsset().generator ?? 'ParSEL';
  const all = root.listNodes();
  const inScene = new Set<Node>();
  (root.getDefaultScene() ?? root.listScenes()[0])?.traverse((node) => void inScene.add(node));
  const found = new Map<string, readonly [Node, Primitive]>();
  const parts = new Map<string, Triangles>();
  for (const [id, number] of nodes) {
    const node = all[number];
    const primitive = node?.getMesh()?.listPrimitives()[0];
    if (node === undefined || primitive === undefined || !inScene.has(node)) continue;
    found.set(id, [node, primitive]);
    parts.set(id, placed(node, primitive, trianglesOf(primitive)));
  }
  for (const [id, { drawn }] of cutParts(program, parts, state, manifold)) {
    const [node] = found.get(id) as readonly [Node, Primitive];
    if (drawn.triangles.length === 0) node.setMesh(null);
    else write(document, node, drawn);
  }
  root.getAsset().generator = generator; // not the library with its version
  for (const mesh of root.listMeshes()) if (mesh.listParents().length < 2) mesh.dispose();
  for (const accessor of root.listAccessors()) if (accessor.listParents().length < 2) accessor.dispose();
  return (await io.writeBinary(document)) as Uint8Array<ArrayBuffer>;
}

/** Gives a node a mesh of its own: others may share the one that it had. */
function write(document: Document, node: Node, drawn: Drawn): void {
  const buffer = document.getRoot().listBuffers()[0] ?? document.createBuffer();
  const [a, b, c, origin] = columns(node.getWorldMatrix());
  const [bc, ca, ab] = [cross(b, c), cross(c, a), cross(a, b)];
  const volume = dot(a, bc);
  const toNode = (p: Vec): Vec => {
    const from = p.map((x, i) => x - (origin[i] as number));
    return [dot(bc, from) / volume, dot(ca, from) / volume, dot(ab, from) / volume];
  };
  const toNodeNormal = (n: Vec): Vec => {
    const turned = [dot(a, n), dot(b, n), dot(c, n)];
    const length = Math.hypot(...turned) || 1;
    return turned.map((x) => x / length) as Vec;
  };
  const positions = new Float32Array(drawn.positions.length);
  const normals = new Float32Array(drawn.normals.length);
  for (let i = 0; i < positions.length; i += 3) {
    positions.set(toNode(yUp(drawn.positions, i, 1 / 1000)), i);
    normals.set(toNodeNormal(yUp(drawn.normals, i, 1)), i);
  }
  const attribute = (array: Float32Array<ArrayBuffer>) =>
    document.createAccessor().setBuffer(buffer).setType('VEC3').setArray(array);
  const facing = volume < 0 ? turnedOver(drawn.triangles) : drawn.triangles; // a node that mirrors turns them over
  const indices = document.createAccessor().setBuffer(buffer).setType('SCALAR').setArray(Uint32Array.from(facing));
  const old = node.getMesh();
  const primitive = document
    .createPrimitive()
    .setMaterial(old?.listPrimitives()[0]?.getMaterial() ?? null)
    .setAttribute('POSITION', attribute(positions))
    .setAttribute('NORMAL', attribute(normals))
    .setIndices(indices);
  node.setMesh(document.createMesh(old?.getName() ?? '').addPrimitive(primitive));
}

/** From z up to y up. */
function yUp(from: Float64Array, at: number, scale: number): Vec {
  const [x = 0, y = 0, z = 0] = from.subarray(at, at + 3);
  return [scale * x, scale * z, -scale * y];
}

/** Of a matrix, column by column: the axes and the origin. */
const columns = (m: readonly number[]) =>
  [0, 4, 8, 12].map((at) => [m[at], m[at + 1], m[at + 2]]) as unknown as readonly [Vec, Vec, Vec, Vec];
