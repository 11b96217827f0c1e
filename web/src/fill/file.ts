// The file of an edited model with its gaps filled: new corners and triangles at the ends of parts that there are. Nodes,
// names, materials, and every corner that was there stay.
import { type Document, Logger, type Node, type Primitive, Verbosity, WebIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { placed, trianglesOf } from '../solid/parts';
import { cross, dot, type Vec } from '../solid/vectors';
import { turnedOver } from '../solid/weld';
import { fillGap } from './fill';
import { boundsOf, contactOf, Parts, relative } from './gap';
import { normalsOf } from './surface';
import type { EditedPart, FilledGap, Patch, Reconstruct, Unfilled } from './types';

/** Of the model's half-diagonal: what is farther apart is no gap between parts that belong together. */
const widest = 0.15;

/** Which primitive of which node a part is, as the core counts them. */
export interface PartPlace {
  readonly node: number;
  readonly primitive: number;
}

export interface Filled {
  readonly glb: Uint8Array<ArrayBuffer>;
  /** Those that there were, closed or left; parts are numbers in the list that was given. */
  readonly gaps: readonly FilledGap[];
  /** Extensions that the file had and this one has not. */
  readonly lost: readonly string[];
}

/**
 * @param rest the file before the edit, and `edited` after it
 * @param pairs of parts that are attached to each other
 * @param onProgress pairs looked at, of all
 */
export async function fillFile(
  rest: Uint8Array,
  edited: Uint8Array,
  parts: readonly PartPlace[],
  pairs: readonly (readonly [number, number])[],
  reconstruct: Reconstruct,
  onProgress: (done: number, total: number) => void = () => {},
): Promise<Filled> {
  const before = await read(rest);
  const after = await read(edited);
  const found = parts.map((place) => {
    const [a, b] = [before.document, after.document].map((document) => primitiveAt(document, place));
    if (!a || !b) return null;
    const own = { rest: surfaceOf(a), edited: surfaceOf(b) };
    const same =
      own.rest.triangles.length === own.edited.triangles.length &&
      own.rest.positions.length === own.edited.positions.length;
    return same ? { ...own, at: b } : null;
  });
  const none = { positions: new Float64Array(0), triangles: new Uint32Array(0) };
  const list = found.map((part): EditedPart => part ?? { rest: none, edited: none });
  const { low, high } = boundsOf(list.flatMap(({ rest: { positions } }) => [...positions]));
  const scale = Math.hypot(...high.map((x, k) => x - (low[k] as number))) / 2;
  const all = new Parts(list, scale);
  const gaps: FilledGap[] = [];
  for (const [i, pair] of pairs.entries()) {
    onProgress(i, pairs.length);
    if (pair.some((part) => (list[part] as EditedPart).rest.triangles.length === 0)) continue;
    const contact = contactOf(all, pair);
    if (contact === null || contact.width <= relative.narrowest * scale) continue;
    const { parts: own, width } = contact;
    const leave = (left: Unfilled) => gaps.push({ parts: own, width, patches: [], left });
    const fixed = own.map((part) => whyFixed(found[part]?.at)).find((why) => why !== null);
    if (width > widest * scale) leave('they are too far apart');
    else if (fixed) leave(fixed);
    else gaps.push(fillGap(all, contact, reconstruct));
  }
  for (const { patches } of gaps) {
    for (const patch of patches) append(after.document, found[patch.part]?.at as Shown, patch);
  }
  if (gaps.every(({ patches }) => patches.length === 0)) return { glb: new Uint8Array(edited), gaps, lost: [] };
  const root = after.document.getRoot();
  for (const accessor of root.listAccessors()) if (accessor.listParents().length < 2) accessor.dispose();
  root.getAsset().generator = after.generator; // not the library with its version
  return { glb: (await after.io.writeBinary(after.document)) as Uint8Array<ArrayBuffer>, gaps, lost: after.lost };
}

const known = new Set(ALL_EXTENSIONS.map(({ EXTENSION_NAME }) => EXTENSION_NAME));

async function read(glb: Uint8Array) {
  const io = new WebIO().setLogger(new Logger(Verbosity.SILENT)).registerExtensions(ALL_EXTENSIONS);
  const { json, resources } = await io.binaryToJSON(new Uint8Array(glb));
  const lost = (json.extensionsUsed ?? []).filter((name) => !known.has(name));
  const required = (json.extensionsRequired ?? []).filter((name) => known.has(name));
  const document = await io.readJSON({ json: { ...json, extensionsRequired: required }, resources });
  return { io, document, lost, generator: json.asset.generator ?? 'ParSEL' };
}

interface Shown {
  readonly node: Node;
  readonly primitive: Primitive;
  readonly number: number;
}

function primitiveAt(document: Document, { node: n, primitive: p }: PartPlace): Shown | null {
  const node = document.getRoot().listNodes()[n];
  const primitive = node?.getMesh()?.listPrimitives()[p];
  return node === undefined || primitive === undefined ? null : { node, primitive, number: p };
}

const surfaceOf = ({ node, primitive }: Shown) => placed(node, primitive, trianglesOf(primitive));

/** Why a part cannot get corners; null where it can. */
function whyFixed(part: Shown | undefined): Unfilled | null {
  if (part === undefined) return 'one is not there any more';
  if (part.node.getSkin() !== null) return 'one bends with a skeleton';
  if (part.primitive.listTargets().length > 0) return 'one has morph targets';
  if (part.node.getExtension('EXT_mesh_gpu_instancing') !== null) return 'one is drawn many times by one node';
  return null;
}

/** The primitive of a node that nothing else shows. */
function ownPrimitive(document: Document, { node, number }: Shown): Primitive {
  const mesh = node.getMesh();
  if (mesh === null) throw new Error('the part has lost its mesh');
  const users = mesh.listParents().filter((parent) => parent.propertyType === 'Node');
  if (users.length < 2) return mesh.listPrimitives()[number] as Primitive;
  const own = document.createMesh(mesh.getName()).setExtras(mesh.getExtras()).setWeights(mesh.getWeights());
  for (const primitive of mesh.listPrimitives()) own.addPrimitive(primitive.clone());
  node.setMesh(own);
  return own.listPrimitives()[number] as Primitive;
}

function append(document: Document, part: Shown, { positions, triangles, places }: Patch): void {
  const primitive = ownPrimitive(document, part);
  const old = trianglesOf(primitive);
  const matrix = part.node.getWorldMatrix();
  const local = toNode(matrix);
  const count = primitive.getAttribute('POSITION')?.getCount() ?? 0;
  const buffer = document.getRoot().listBuffers()[0] ?? document.createBuffer();
  const normals = cornerNormals({ positions, triangles });
  for (const semantic of primitive.listSemantics()) {
    const from = primitive.getAttribute(semantic);
    if (from === null) continue;
    const size = from.getElementSize();
    const exact = semantic === 'POSITION' || from.getNormalized();
    const array =
      exact && !(from.getArray() instanceof Float32Array) ? new Float32Array(size * count) : from.getArray();
    if (array === null) continue;
    const made = from
      .clone()
      .setNormalized(exact ? false : from.getNormalized())
      .setBuffer(buffer)
      .setArray(new (array.constructor as Float32ArrayConstructor)(size * (count + places.length)));
    const element: number[] = [];
    for (let i = 0; i < count; i++) made.setElement(i, from.getElement(i, element));
    for (const [i, place] of places.entries()) {
      if (semantic === 'POSITION') made.setElement(count + i, local.point(at(positions, i)));
      else if (semantic === 'NORMAL') made.setElement(count + i, local.normal(at(normals, i)));
      else {
        const corners = [0, 1, 2].map((k) => [...from.getElement(old[3 * place.triangle + k] as number, element)]);
        const most = place.weights.indexOf(Math.max(...place.weights));
        // Numbers of things cannot be mixed, and directions of a seam should not be.
        const whole = semantic.startsWith('JOINTS') || semantic === 'TANGENT';
        const mixed = (corners[0] as number[]).map((_, k) =>
          place.weights.reduce((sum, w, q) => sum + w * (corners[q]?.[k] ?? 0), 0),
        );
        made.setElement(count + i, whole ? (corners[most] as number[]) : mixed);
      }
    }
    primitive.setAttribute(semantic, made);
  }
  const facing = local.mirrors ? turnedOver(triangles) : triangles;
  const indices = Uint32Array.from([...old, ...[...facing].map((i) => i + count)]);
  primitive.setMode(4).setIndices(document.createAccessor().setBuffer(buffer).setType('SCALAR').setArray(indices));
}

const at = (array: ArrayLike<number>, i: number) => [0, 1, 2].map((k) => array[3 * i + k] as number) as Vec;

/** Area-weighted. */
function cornerNormals(surface: Pick<Patch, 'positions' | 'triangles'>): Float64Array {
  const flat = normalsOf(surface);
  const normals = new Float64Array(surface.positions.length);
  for (const [i, corner] of surface.triangles.entries()) {
    for (let k = 0; k < 3; k++)
      normals[3 * corner + k] = (normals[3 * corner + k] as number) + (flat[i - (i % 3) + k] as number);
  }
  return normals;
}

/** From millimetres, z up, into the coordinates of a node; see placed(). @param m column by column */
function toNode(m: readonly number[]) {
  const [a, b, c, origin] = [0, 4, 8, 12].map((i) => m.slice(i, i + 3)) as unknown as [Vec, Vec, Vec, Vec];
  const [bc, ca, ab] = [cross(b, c), cross(c, a), cross(a, b)];
  const volume = dot(a, bc);
  const yUp = ([x, y, z]: Vec): Vec => [x, z, -y];
  return {
    mirrors: volume < 0,
    point: (p: Vec): Vec => {
      const from = yUp(p).map((x, i) => x / 1000 - (origin[i] as number)) as Vec;
      return [dot(bc, from) / volume, dot(ca, from) / volume, dot(ab, from) / volume];
    },
    normal: (n: Vec): Vec => {
      const turned = [a, b, c].map((axis) => dot(axis, yUp(n)));
      const length = Math.hypot(...turned) || 1;
      return turned.map((x) => x / length) as Vec;
    },
  };
}
