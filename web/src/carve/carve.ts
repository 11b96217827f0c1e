// Parts put together, taken apart and cut by hand, in the file itself: what comes after knows nothing of it, and the result
// opens everywhere with the same parts. Nodes keep their indices, places, names and children; new parts are new children.
// The corners that no step is about stay as they were, to the byte. The same file and step give the same bytes, in every browser, so that
// a link finds its model by its hash.
import { type Document, Logger, type Mesh, type Node, type Primitive, Verbosity, WebIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { readJson } from '../formats/read_gltf';
import type { Triangulate } from './caps';
import type { Side } from './cut';
import { chosen, pieces, places, triangleList, trianglesOf } from './geometry';
import { joined } from './join';
import { axesOf, type Placing, placingNode } from './placing';
import { sidesOf } from './sides';
import { type Carved, CarveError, type CarveStep, type PartKey, type Plane, partKeyOf, partOf } from './steps';

const known = new Set(ALL_EXTENSIONS.map(({ EXTENSION_NAME }) => EXTENSION_NAME));

/** More parts than that are no help: the splitting of the whole model knows how to join what is small. */
const mostPieces = 200;

export interface CarveFiles {
  readonly main: Uint8Array;
  readonly external: ReadonlyMap<string, Uint8Array>;
}

/**
 * Throws a CarveError when the step cannot be done; then nothing was.
 * @param triangulate closes what is cut (solid/manifold.ts); asked for by cuts alone
 */
export async function carve(
  files: CarveFiles,
  step: CarveStep,
  triangulate: () => Promise<Triangulate>,
): Promise<Carved> {
  const io = new WebIO().setLogger(new Logger(Verbosity.SILENT)).registerExtensions(ALL_EXTENSIONS);
  const { json, resources } = await readJson(files, io);
  const lost = (json.extensionsUsed ?? []).filter((name) => !known.has(name));
  const required = (json.extensionsRequired ?? []).filter((name) => known.has(name));
  const document = await io.readJSON({ json: { ...json, extensionsRequired: required }, resources });
  const carver = new Carver(document);
  if (step.kind === 'cut') carver.cut(step, await triangulate());
  else carver.run(step);
  const root = document.getRoot();
  for (const accessor of root.listAccessors())
    if (accessor.listParents().every((parent) => parent === root)) accessor.dispose();
  const [buffer = document.createBuffer(), ...others] = root.listBuffers(); // a GLB has one
  for (const accessor of root.listAccessors()) accessor.setBuffer(buffer);
  for (const other of others) other.dispose();
  root.getAsset().generator = json.asset.generator ?? 'ParSEL'; // not the library with its version: it would be in the hash
  return { glb: (await io.writeBinary(document)) as Uint8Array<ArrayBuffer>, lost, ...carver.result() };
}

/** A part among the nodes of the file. */
export interface Place {
  readonly key: PartKey;
  readonly node: Node;
  readonly mesh: Mesh;
  readonly primitive: Primitive;
}

class Carver {
  readonly #nodes: Node[];
  /** Primitives as they were keyed before. */
  readonly #before = new Map<Primitive, PartKey[]>();
  readonly #made: Node[] = [];
  readonly #open: string[] = [];

  constructor(readonly document: Document) {
    this.#nodes = document.getRoot().listNodes();
  }

  run(step: Exclude<CarveStep, { kind: 'cut' }>): void {
    if (step.kind === 'place') this.#stand(step);
    else if (step.kind === 'divide') this.#divide(this.#place(step.part));
    else this.#join(step.parts.map((key) => this.#place(key)));
  }

  /** Which parts have other keys now, and which are new. */
  result(): Pick<Carved, 'moved' | 'made' | 'open'> {
    const nodes = this.document.getRoot().listNodes();
    const moved: [PartKey, PartKey][] = [];
    for (const [n, node] of nodes.entries())
      for (const [p, primitive] of (node.getMesh()?.listPrimitives() ?? []).entries()) {
        const now = partKeyOf(n, p);
        const was = this.#before.get(primitive)?.find((key) => partOf(key).node === n);
        if (was !== undefined && was !== now) moved.push([was, now]);
      }
    return { moved, made: this.#made.map((node) => partKeyOf(nodes.indexOf(node), 0)), open: this.#open };
  }

  #place(key: PartKey): Place {
    const at = partOf(key);
    const node = this.#nodes[at.node];
    const mesh = node?.getMesh();
    const primitive = mesh?.listPrimitives()[at.primitive];
    if (node === undefined || !mesh || primitive === undefined)
      throw new CarveError('A part of this model is not there. Open the model as it was and try again.');
    const name = node.getName() || 'This part';
    if (node.getSkin() !== null)
      throw new CarveError(`${name} bends with a skeleton and stays whole. Choose another part.`);
    if (primitive.listTargets().length > 0)
      throw new CarveError(`${name} changes its form by morph targets and stays whole. Choose another part.`);
    if (node.getExtension('EXT_mesh_gpu_instancing') !== null)
      throw new CarveError(`${name} is drawn many times by one node and stays whole. Choose another part.`);
    return { key, node, mesh, primitive };
  }

  /** The node's mesh without a primitive, which other nodes keep. */
  #takeOut({ node, primitive }: Place): void {
    const mesh = node.getMesh();
    if (mesh === null) return;
    const n = this.#nodes.indexOf(node);
    for (const [p, other] of mesh.listPrimitives().entries()) {
      const keys = this.#before.get(other) ?? [];
      if (!keys.some((key) => partOf(key).node === n)) this.#before.set(other, [...keys, partKeyOf(n, p)]);
    }
    const left = mesh.listPrimitives().filter((other) => other !== primitive);
    const isShared = mesh.listParents().filter((parent) => this.#nodes.includes(parent as Node)).length > 1;
    if (left.length === 0) node.setMesh(null);
    else if (isShared) {
      const own = this.document.createMesh(mesh.getName()).setExtras(mesh.getExtras());
      for (const other of left) own.addPrimitive(other);
      node.setMesh(own);
    } else mesh.removePrimitive(primitive);
    if (left.length === 0 && !isShared) mesh.dispose();
    if (primitive.listParents().every((parent) => parent === this.document.getRoot())) primitive.dispose();
  }

  /** A child of a node that is a part of its own. */
  #add(node: Node, name: string, primitive: Primitive): void {
    const mesh = this.document.createMesh(name).addPrimitive(primitive);
    const made = this.document.createNode(name).setMesh(mesh);
    node.addChild(made);
    this.#made.push(made);
  }

  /** A primitive of some corners of another and triangles between them. */
  #primitive(source: Primitive, { corners, triangles }: Side): Primitive {
    const made = source.clone().setMode(triangleList);
    for (const semantic of source.listSemantics()) {
      const attribute = source.getAttribute(semantic);
      if (attribute !== null) made.setAttribute(semantic, chosen(attribute, semantic, corners));
    }
    const indices = corners.length < 65535 ? Uint16Array.from(triangles) : triangles;
    return made.setIndices(this.document.createAccessor().setType('SCALAR').setArray(indices));
  }

  #divide(place: Place): void {
    const { node, primitive } = place;
    const position = primitive.getAttribute('POSITION');
    if (position === null) throw new CarveError('This part has no corners. Export the model again.');
    const triangles = trianglesOf(primitive);
    const { of, count } = pieces(triangles, places(position));
    const name = node.getName() || 'part';
    if (count < 2)
      throw new CarveError(`${name} hangs together: there is nothing to split. Cut it by a plane instead.`);
    if (count > mostPieces)
      throw new CarveError(
        `${name} falls into ${count.toLocaleString('en')} pieces. Split the whole model instead: that joins what is small.`,
      );
    const sides = Array.from({ length: count }, () => ({ corners: [] as number[], triangles: [] as number[] }));
    const numbers = new Map<number, number>(); // a corner belongs to one piece, unless pieces touch there
    for (const [t, piece] of of.entries()) {
      const side = sides[piece];
      if (side === undefined) continue;
      for (let k = 0; k < 3; k++) {
        const corner = triangles[3 * t + k] ?? 0;
        const known = numbers.get(corner * count + piece) ?? side.corners.length;
        if (known === side.corners.length) side.corners.push(corner);
        numbers.set(corner * count + piece, known);
        side.triangles.push(known);
      }
    }
    const parts = sides.map((side) =>
      this.#primitive(primitive, { corners: side.corners, triangles: Uint32Array.from(side.triangles) }),
    );
    this.#takeOut(place);
    for (const [i, part] of parts.entries()) this.#add(node, `${name} ${i + 1}`, part);
  }

  cut({ parts, plane }: Extract<CarveStep, { kind: 'cut' }>, triangulate: Triangulate): void {
    const cuts = parts.flatMap((key) => {
      const place = this.#place(key);
      const cut = sidesOf(place, plane, triangulate);
      return cut === null ? [] : [{ place, ...cut }];
    });
    if (cuts.length === 0)
      throw new CarveError('The plane goes through none of these parts. Drag it into one and cut again.');
    const names = sideNames(plane);
    for (const { place, sides, isOpen } of cuts) {
      const name = place.node.getName() || 'part';
      if (isOpen) this.#open.push(name);
      const made = sides.map((side) => this.#primitive(place.primitive, side));
      this.#takeOut(place);
      for (const [i, part] of made.entries()) this.#add(place.node, `${name} ${names[i]}`, part);
    }
  }

  /** One node above all others turns and scales them. */
  #stand(placing: Placing): void {
    const root = this.document.getRoot();
    const scene = root.getDefaultScene() ?? root.listScenes()[0];
    if (scene === undefined) throw new CarveError('This file shows no scene. Export the model again.');
    let above = this.#nodes.find((node) => node.getName() === placingNode);
    if (above === undefined) {
      above = this.document.createNode(placingNode);
      for (const child of scene.listChildren()) {
        scene.removeChild(child);
        above.addChild(child);
      }
      scene.addChild(above);
    }
    const axes = axesOf(placing);
    const column = (i: number) => [...axes.map((axis) => placing.metres * (axis[i] ?? 0)), 0];
    above.setMatrix([...column(0), ...column(1), ...column(2), 0, 0, 0, 1] as Parameters<Node['setMatrix']>[0]);
  }

  #join(at: readonly Place[]): void {
    const [first, ...others] = at;
    if (first === undefined || others.length === 0)
      throw new CarveError('One part alone cannot be joined. Select several.');
    if (new Set(at.map(({ key }) => key)).size < at.length) throw new CarveError('A part cannot be joined to itself.');
    const part = joined(this.document, at);
    const name = first.node.getName() || 'part';
    for (const place of at) this.#takeOut(place);
    this.#add(first.node, name, part);
  }
}

/** What the two sides are called, the upper side of the plane first: the object's left is +x, its front +z. */
function sideNames([x, y, z]: Plane): readonly [string, string] {
  const [ax, ay, az] = [Math.abs(x), Math.abs(y), Math.abs(z)];
  const [positive, negative, sign] =
    ay >= ax && ay >= az
      ? (['top', 'bottom', y] as const)
      : ax >= az
        ? (['left', 'right', x] as const)
        : (['front', 'back', z] as const);
  return sign > 0 ? [positive, negative] : [negative, positive];
}
