// 3MF (core specification 1.3, with objects in files of their own as the production extension has them): the items of the
// build, each with its components placed, as a tree of nodes. Millimetres unless the file says otherwise; z is up. Read
// here, since three's loader wants a DOMParser (which a worker lacks), inflates archives of any size and knows no units.
// Colours of materials and colour groups stay: one for an object where it has one, else of its corners. Pictures and
// supports are left out, and said so.
import { type Unzipped, unzipSync } from 'fflate';
import {
  decodeText,
  FormatError,
  linear,
  type Model,
  type Node,
  type Primitive,
  plainSurface,
  type Source,
} from './model';
import { printable, shownFile } from './names';
import { compose, identity, isPlaced, type Matrix, moved } from './placing';
import { type Attributes, visitXml } from './xml';

/** Metres. */
const units: ReadonlyMap<string, number> = new Map([
  ['micron', 1e-6],
  ['millimeter', 1e-3],
  ['centimeter', 1e-2],
  ['inch', 0.0254],
  ['foot', 0.3048],
  ['meter', 1],
]);

/** Extensions whose lack changes at most colours, by their namespaces, version aside. */
const bearable =
  /\/(?:core|material|production|triangleset|trianglesets|displacement2d)\/\d{4}\/\d{2}$|slic3r|prusa|bambu/i;

/** Nodes that components may unfold to: of objects within objects there are soon billions. */
const mostNodes = 20_000;

type Color = readonly [number, number, number, number];

interface Placed {
  /** Of the object: the file that holds it and its id in there. */
  readonly key: string;
  readonly matrix: Matrix;
}

interface Painted {
  readonly resource: string | undefined;
  readonly indices: readonly (string | undefined)[];
}

interface ThingObject {
  readonly name: string;
  readonly type: string;
  readonly resource: string | undefined;
  readonly index: string | undefined;
  readonly vertices: number[];
  readonly triangles: number[];
  /** By triangle, where it has paint of its own. */
  readonly paint: Map<number, Painted>;
  readonly components: Placed[];
}

interface Archive {
  readonly objects: Map<string, ThingObject>;
  readonly colors: Map<string, Color[]>;
  readonly items: Placed[];
  readonly left: Set<string>;
  unit: number;
}

/** @param limit bytes that the archive may unfold to. Throws a FormatError. */
export function readThreeMf({ path, main }: Source, limit: number): Model {
  const place = shownFile(path);
  const files = unpack(main, place, limit);
  const root = rootOf(files, place);
  const archive: Archive = { objects: new Map(), colors: new Map(), items: [], left: new Set(), unit: 1e-3 };
  const waiting = [root];
  const seen = new Set(waiting);
  for (let file = waiting.pop(); file !== undefined; file = waiting.pop()) {
    const bytes = files[file];
    if (bytes === undefined)
      throw new FormatError(`${place} is damaged: it names ${printable(file)}, which it lacks. Export it again.`);
    readDocument(decodeText(bytes), file, file === root, archive, place);
    for (const { components } of archive.objects.values())
      for (const { key } of components) {
        const other = key.slice(0, key.lastIndexOf('#'));
        if (!seen.has(other)) waiting.push(other);
        seen.add(other);
      }
  }
  const nodes = build(archive, place);
  if (nodes.length === 0)
    throw new FormatError(`${place} is empty: nothing in it is placed on the plate. Export it with its objects.`);
  const remarks = archive.left.size > 0 ? [`Left out: ${[...archive.left].join(', ')}.`] : [];
  return { nodes, unit: archive.unit, isZUp: true, remarks };
}

function unpack(bytes: Uint8Array, place: string, limit: number): Unzipped {
  let sum = 0;
  const filter = ({ name, originalSize }: { name: string; originalSize: number }) => {
    if (!/\.(?:model|rels)$/i.test(name)) return false;
    sum += originalSize; // what fflate makes room for, whatever is inside
    if (sum > limit) throw new FormatError(`${place} is too large when it is unpacked. Open a smaller model.`);
    return true;
  };
  try {
    const files = unzipSync(bytes, { filter });
    return Object.fromEntries(Object.entries(files).map(([name, content]) => [name.replace(/^\/+/, ''), content]));
  } catch (error) {
    if (error instanceof FormatError) throw error;
    throw new FormatError(
      `${place} is empty or damaged: it is no archive that can be unpacked. Export or download it again.`,
    );
  }
}

/** The document that the archive's relations call its model, else the usual one. */
function rootOf(files: Unzipped, place: string): string {
  let root: string | undefined;
  const relations = files['_rels/.rels'];
  if (relations !== undefined) {
    visitXml(decodeText(relations), `${place}, _rels/.rels`, {
      open(name, attributes) {
        const isModel = name === 'Relationship' && attributes.get('Type')?.endsWith('/3dmodel');
        if (isModel) root ??= attributes.get('Target')?.replace(/^\/+/, '');
      },
      close() {},
    });
  }
  root ??= Object.keys(files).find((file) => /^3D\/[^/]+\.model$/i.test(file));
  if (root === undefined)
    throw new FormatError(`${place} is no 3MF: there is no model in the archive. Export it again.`);
  return root;
}

function readDocument(text: string, file: string, isRoot: boolean, archive: Archive, place: string): void {
  const where = `${place}, ${printable(file)}`;
  const keyOf = (id: string | undefined, other = file) => `${other.replace(/^\/+/, '')}#${id ?? ''}`;
  let object: ThingObject | null = null;
  let colors: Color[] | null = null;
  const number = (attributes: Attributes, name: string) => {
    const value = Number(attributes.get(name) ?? Number.NaN);
    if (!Number.isFinite(value)) throw new FormatError(`${where} is damaged: a ${name} is no number. Export it again.`);
    return value;
  };
  const placed = (attributes: Attributes): Placed => ({
    key: keyOf(attributes.get('objectid'), attributes.get('path')),
    matrix: matrixOf(attributes.get('transform'), where),
  });

  visitXml(text, where, {
    open(name, attributes) {
      if (name === 'vertex') object?.vertices.push(...['x', 'y', 'z'].map((axis) => number(attributes, axis)));
      else if (name === 'triangle') {
        if (object === null) return;
        const resource = attributes.get('pid');
        const indices = ['p1', 'p2', 'p3'].map((corner) => attributes.get(corner));
        const own = resource !== undefined || indices[0] !== undefined;
        if (own) object.paint.set(object.triangles.length / 3, { resource: resource && keyOf(resource), indices });
        object.triangles.push(...['v1', 'v2', 'v3'].map((corner) => number(attributes, corner)));
      } else if (name === 'object') {
        const resource = attributes.get('pid');
        object = {
          name: attributes.get('name') ?? '',
          type: attributes.get('type') ?? 'model',
          resource: resource && keyOf(resource),
          index: attributes.get('pindex'),
          vertices: [],
          triangles: [],
          paint: new Map(),
          components: [],
        };
        archive.objects.set(keyOf(attributes.get('id')), object);
      } else if (name === 'component') object?.components.push(placed(attributes));
      else if (name === 'item') {
        if (isRoot) archive.items.push(placed(attributes));
      } else if (name === 'basematerials' || name === 'colorgroup') {
        colors = [];
        archive.colors.set(keyOf(attributes.get('id')), colors);
      } else if (name === 'base') colors?.push(colorOf(attributes.get('displaycolor')));
      else if (name === 'color') colors?.push(colorOf(attributes.get('color')));
      else if (name === 'texture2dgroup') archive.left.add('pictures');
      else if (name === 'beamlattice') archive.left.add('beam lattices');
      else if (name === 'model') {
        refuseUnknown(text, attributes.get('requiredextensions') ?? '', where);
        const unit = units.get(attributes.get('unit') ?? 'millimeter');
        if (unit === undefined)
          throw new FormatError(
            `${where} measures in “${printable(attributes.get('unit') ?? '')}”, which is no unit of 3MF.`,
          );
        if (isRoot) archive.unit = unit;
      }
    },
    close(name) {
      if (name === 'object') object = null;
      else if (name === 'basematerials' || name === 'colorgroup') colors = null;
    },
  });
}

/** Refuses extensions without which the file says that it cannot be read, other than those that are. */
function refuseUnknown(text: string, required: string, where: string): void {
  const head = /<[^<]*?\bmodel\b([^>]*)>/.exec(text)?.[1] ?? '';
  for (const prefix of required.split(/\s+/).filter(Boolean)) {
    const spaces = [...head.matchAll(/xmlns:([^\s=]+)\s*=\s*["']([^"']*)["']/g)];
    const space = spaces.find(([, name]) => name === prefix)?.[2] ?? prefix;
    if (bearable.test(space)) continue;
    throw new FormatError(
      `${where} needs the extension ${printable(space)}, which is not read. Export it as plain triangles.`,
    );
  }
}

/** #RRGGBB or #RRGGBBAA, of sRGB. */
function colorOf(text: string | undefined): Color {
  const digits = /^\s*#([\da-f]{6})([\da-f]{2})?\s*$/i.exec(text ?? '');
  if (digits === null) return plainSurface.color;
  const [, rgb = '', alpha = 'ff'] = digits;
  const channel = (at: number) => linear(Number.parseInt(rgb.slice(at, at + 2), 16) / 255);
  return [channel(0), channel(2), channel(4), Number.parseInt(alpha, 16) / 255];
}

/** Twelve numbers, row by row of a matrix that points are multiplied with from the left. */
function matrixOf(text: string | undefined, where: string): Matrix {
  if (text === undefined || text.trim() === '') return identity;
  const t = text.trim().split(/\s+/).map(Number);
  const [a, b, c, d, e, f, g, h, i, x, y, z] = t as [number, ...number[]];
  const matrix = [a, b, c, 0, d, e, f, 0, g, h, i, 0, x, y, z, 1] as Matrix;
  if (t.length !== 12 || !t.every(Number.isFinite)) {
    throw new FormatError(
      `${where} is damaged: the transform “${printable(text)}” is not twelve numbers. Export it again.`,
    );
  }
  return matrix;
}

function build({ objects, colors, items, left }: Archive, place: string): Node[] {
  const meshes = new Map<ThingObject, readonly Primitive[]>();
  const meshOf = (object: ThingObject, key: string) => {
    const known = meshes.get(object);
    if (known !== undefined) return known;
    const mesh = object.triangles.length === 0 ? [] : [primitiveOf(object, key, colors, place)];
    meshes.set(object, mesh);
    return mesh;
  };
  let count = 0;
  /** @param above a matrix that could not be a node's, and so goes into its vertices and what is placed in it */
  const unfold = ({ key, matrix: own }: Placed, above: Matrix, around: readonly ThingObject[]): Node[] => {
    const object = objects.get(key);
    const id = printable(key.slice(key.lastIndexOf('#') + 1));
    if (object === undefined)
      throw new FormatError(`${place} is damaged: it places object ${id}, which it lacks. Export it again.`);
    if (around.includes(object))
      throw new FormatError(`${place} is damaged: object ${id} contains itself. Export it again.`);
    if (++count > mostNodes) throw new FormatError(`${place} places more than 20,000 objects. Open a part of it.`);
    if (/support$/.test(object.type)) {
      left.add('supports');
      return [];
    }
    const matrix = compose(above, own);
    const isNode = isPlaced(matrix);
    const inner = isNode ? identity : matrix;
    const children = object.components.flatMap((component) => unfold(component, inner, [...around, object]));
    const still = meshOf(object, key);
    const mesh = isNode ? still : still.map((primitive) => moved(primitive, matrix));
    if (mesh.length === 0 && children.length === 0) return [];
    return [{ name: object.name, matrix: isNode && matrix !== identity ? matrix : null, mesh, children }];
  };
  return items.flatMap((item) => unfold(item, identity, []));
}

function primitiveOf(object: ThingObject, key: string, colors: Archive['colors'], place: string): Primitive {
  const { vertices, triangles, paint, resource, index } = object;
  const count = vertices.length / 3;
  const isHere = (corner: number) => Number.isInteger(corner) && corner >= 0 && corner < count;
  const wrong = triangles.findIndex((corner) => !isHere(corner));
  if (wrong >= 0) {
    const name = printable(object.name || key.slice(key.lastIndexOf('#') + 1));
    throw new FormatError(
      `${place}, object ${name} is damaged: triangle ${Math.floor(wrong / 3)} has vertex ${triangles[wrong]} of ${count}. Export it again.`,
    );
  }
  const colorAt = (from: string | undefined, at: string | undefined) =>
    (from === undefined ? undefined : colors.get(from)?.[Number(at ?? 0)]) ?? plainSurface.color;
  const whole = colorAt(resource, index);
  const flat = { normals: null, uvs: null };
  if (paint.size === 0) {
    const surface = { ...plainSurface, color: whole };
    const positions = Float32Array.from(vertices);
    return { ...flat, positions, indices: Uint32Array.from(triangles), colors: null, surface };
  }
  // A corner has another colour in each triangle, so that triangles cannot share it.
  const painted = new Float32Array(3 * triangles.length);
  const positions = new Float32Array(3 * triangles.length);
  for (const [i, corner] of triangles.entries()) {
    const own = paint.get(Math.floor(i / 3));
    const at = own?.indices[i % 3] ?? own?.indices[0] ?? index;
    const color = own === undefined ? whole : colorAt(own.resource ?? resource, at);
    painted.set(color.slice(0, 3), 3 * i);
    for (let k = 0; k < 3; k++) positions[3 * i + k] = vertices[3 * corner + k] as number;
  }
  return { ...flat, positions, indices: null, colors: painted, surface: { ...plainSurface, color: [1, 1, 1, 1] } };
}
