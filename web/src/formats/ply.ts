// PLY, ASCII and binary: one node, with the colours of its vertices. Read here, since three's PLYLoader leaves out faces of
// more than four corners without a word, and takes an ASCII file that breaks off for a whole one. Y is up and a unit is a
// metre, as they stand: scanners agree on neither. Format: Turk, "The PLY Polygon File Format" (1994).
import { decodeText, FormatError, leaf, linear, type Model, plainSurface, rounded, type Source, toUnit } from './model';
import { printable, shownFile } from './names';

type Scalar = 'i1' | 'u1' | 'i2' | 'u2' | 'i4' | 'u4' | 'f4' | 'f8';

const scalars: ReadonlyMap<string, Scalar> = new Map([
  ['char', 'i1'],
  ['int8', 'i1'],
  ['uchar', 'u1'],
  ['uint8', 'u1'],
  ['short', 'i2'],
  ['int16', 'i2'],
  ['ushort', 'u2'],
  ['uint16', 'u2'],
  ['int', 'i4'],
  ['int32', 'i4'],
  ['uint', 'u4'],
  ['uint32', 'u4'],
  ['float', 'f4'],
  ['float32', 'f4'],
  ['double', 'f8'],
  ['float64', 'f8'],
]);

/** Largest value of a colour channel of that type. */
const fullColor: Readonly<Record<Scalar, number>> = {
  i1: 127,
  u1: 255,
  i2: 32767,
  u2: 65535,
  i4: 1,
  u4: 1,
  f4: 1,
  f8: 1,
};

interface Property {
  readonly name: string;
  readonly type: Scalar;
  /** Of the number of values of a list; null: one value. */
  readonly count: Scalar | null;
}

interface Element {
  readonly name: string;
  readonly count: number;
  readonly properties: Property[];
}

interface Header {
  readonly format: string;
  readonly elements: readonly Element[];
  readonly texture: string | null;
  /** Where the data begins. */
  readonly end: number;
}

/** The next value of the data. Throws a RangeError at its end. */
type Next = (type: Scalar) => number;

/** Throws a FormatError. */
export function readPly({ path, main }: Source): Model {
  const place = shownFile(path);
  const header = readHeader(main, place);
  const vertex = header.elements.find(({ name }) => name === 'vertex');
  const face = header.elements.find(({ name }) => name === 'face');
  if (vertex === undefined || vertex.count === 0)
    throw new FormatError(`${place} is empty: it has no vertices. Export it again.`);
  if (face === undefined || face.count === 0) throw new FormatError(withoutFaces(header, place));
  const body = main.subarray(header.end);
  const smallest = header.elements.reduce((sum, { count, properties }) => sum + count * properties.length, 0);
  if (smallest > body.length) throw new FormatError(brokenOff(place));

  const next = header.format === 'ascii' ? nextOfText(body, place) : nextOfBytes(body, header.format);
  let vertices: Vertices | null = null;
  let triangles: Uint32Array | null = null;
  try {
    for (const element of header.elements) {
      if (element === vertex) vertices = readVertices(element, next, place);
      else if (element === face) triangles = readFaces(element, next, vertex.count, place);
      else for (let i = 0; i < element.count; i++) skip(element, next);
    }
  } catch (error) {
    if (error instanceof RangeError) throw new FormatError(brokenOff(place));
    throw error;
  }
  if (vertices === null || triangles === null || triangles.length === 0)
    throw new FormatError(withoutFaces(header, place));
  const { positions, normals, colors } = vertices;
  const surface = colors === null ? plainSurface : { ...plainSurface, color: [1, 1, 1, 1] as const };
  const remarks =
    header.texture === null ? [] : [`Left out: the picture ${printable(header.texture)}. Save it as OBJ to keep it.`];
  const mesh = [{ positions, indices: triangles, normals, uvs: null, colors, surface }];
  return { nodes: [leaf('', mesh)], unit: 1, isZUp: false, remarks };
}

const brokenOff = (place: string) =>
  `${place} breaks off: it is shorter than its header says. Export or download it again.`;

function withoutFaces({ elements }: Header, place: string): string {
  const strips = elements.some(({ name }) => name === 'tristrips');
  if (strips) return `${place} holds triangle strips, which are not read. Export it with faces.`;
  const splats = elements.some(({ properties }) => properties.some(({ name }) => name === 'f_dc_0'));
  const what = splats ? 'Gaussian splats' : 'a point cloud';
  return `${place} is ${what}: it has no faces. Make a surface of it first (MeshLab, CloudCompare), and open that.`;
}

function readHeader(bytes: Uint8Array, place: string): Header {
  const start = new TextDecoder('latin1').decode(bytes.subarray(0, 65536));
  const found = /^ply[ \t]*\r?\n([\s\S]*?)^end_header[ \t]*\r?\n/m.exec(start);
  if (found === null || found.index !== 0)
    throw new FormatError(`${place} is empty or damaged: it has no PLY header. Export it again.`);
  let format = '';
  let texture: string | null = null;
  const elements: Element[] = [];
  for (const [i, line] of (found[1] as string).split(/\r?\n/).entries()) {
    const words = line.trim().split(/\s+/);
    const fault = () =>
      new FormatError(`${place}, line ${i + 2} is no part of a PLY header: “${printable(line)}”. Export it again.`);
    if (words[0] === 'format') format = `${words[1]} ${words[2]}`;
    else if (words[0] === 'comment' && words[1] === 'TextureFile') texture = words.slice(2).join(' ');
    else if (words[0] === 'element') {
      const count = Number(words[2]);
      if (!Number.isInteger(count) || count < 0) throw fault();
      elements.push({ name: words[1] ?? '', count, properties: [] });
    } else if (words[0] === 'property') {
      const isList = words[1] === 'list';
      const type = scalars.get(words[isList ? 3 : 1] ?? '');
      const count = isList ? scalars.get(words[2] ?? '') : null;
      const element = elements.at(-1);
      if (type === undefined || count === undefined || element === undefined) throw fault();
      element.properties.push({ name: words[isList ? 4 : 2] ?? '', type, count });
    } else if (!['', 'comment', 'obj_info'].includes(words[0] ?? '')) throw fault();
  }
  const known = /^(ascii|binary_little_endian|binary_big_endian) 1\.0$/.exec(format);
  if (known === null) {
    throw new FormatError(
      `${place} is a PLY of the format “${printable(format)}”, which is not known. Export it as PLY 1.0.`,
    );
  }
  return { format: known[1] as string, elements, texture, end: found[0].length };
}

function nextOfText(body: Uint8Array, place: string): Next {
  const text = decodeText(body);
  const word = /\S+/g;
  return () => {
    const found = word.exec(text);
    if (found === null) throw new RangeError('end of the file');
    const value = Number(found[0]);
    if (Number.isNaN(value) && !/^[+-]?nan$/i.test(found[0])) {
      throw new FormatError(
        `${place} is damaged: “${printable(found[0])}” stands where a number should. Export it again.`,
      );
    }
    return value;
  };
}

function nextOfBytes(body: Uint8Array, format: string): Next {
  const view = new DataView(body.buffer, body.byteOffset, body.byteLength);
  const little = format === 'binary_little_endian';
  let at = 0;
  const step = (size: number) => {
    at += size;
    return at - size;
  };
  const readers: Readonly<Record<Scalar, () => number>> = {
    i1: () => view.getInt8(step(1)),
    u1: () => view.getUint8(step(1)),
    i2: () => view.getInt16(step(2), little),
    u2: () => view.getUint16(step(2), little),
    i4: () => view.getInt32(step(4), little),
    u4: () => view.getUint32(step(4), little),
    f4: () => view.getFloat32(step(4), little),
    f8: () => view.getFloat64(step(8), little),
  };
  return (type) => readers[type]();
}

function skip({ properties }: Element, next: Next): void {
  for (const property of properties) skipProperty(property, next);
}

function skipProperty({ type, count }: Property, next: Next): void {
  const length = count === null ? 1 : next(count);
  for (let i = 0; i < length; i++) next(type);
}

interface Vertices {
  readonly positions: Float32Array;
  readonly normals: Float32Array | null;
  readonly colors: Float32Array | null;
}

const axes = ['x', 'y', 'z'];
const normalAxes = ['nx', 'ny', 'nz'];
const channels = ['red', 'green', 'blue'];

function readVertices({ properties, count }: Element, next: Next, place: string): Vertices {
  const has = (names: readonly string[]) =>
    names.every((name) => properties.some((property) => property.name === name && property.count === null));
  if (!has(axes)) throw new FormatError(`${place} is damaged: its vertices have no x, y and z. Export it again.`);
  const positions = new Float32Array(3 * count);
  const normals = has(normalAxes) ? new Float32Array(3 * count) : null;
  const colors = has(channels) ? new Float32Array(3 * count) : null;
  const targets = properties.map(({ name, type, count: ofList }) => {
    if (ofList !== null) return null;
    if (axes.includes(name)) return { array: positions, offset: axes.indexOf(name), full: 0 };
    if (normals !== null && normalAxes.includes(name))
      return { array: normals, offset: normalAxes.indexOf(name), full: 0 };
    if (colors === null || !channels.includes(name)) return null;
    return { array: colors, offset: channels.indexOf(name), full: fullColor[type] };
  });
  for (let i = 0; i < count; i++) {
    for (const [k, property] of properties.entries()) {
      const target = targets[k];
      if (target === null || target === undefined) {
        skipProperty(property, next);
        continue;
      }
      const value = next(property.type);
      target.array[3 * i + target.offset] = target.full > 0 ? rounded(linear(value / target.full)) : value;
    }
    if (!positions.subarray(3 * i, 3 * i + 3).every(Number.isFinite)) {
      throw new FormatError(`${place} is damaged: vertex ${i} is not at finite numbers. Export it again.`);
    }
  }
  return { positions, normals: normals === null ? null : toUnit(normals), colors };
}

/** Faces as fans of triangles around their first corner, three indices each. */
function readFaces({ properties, count }: Element, next: Next, vertices: number, place: string): Uint32Array {
  const list = properties.find(({ name, count: ofList }) => ofList !== null && /^vertex_(?:indices|index)$/.test(name));
  if (list === undefined) throw new FormatError(`${place} is damaged: its faces name no vertices. Export it again.`);
  const triangles: number[] = [];
  for (let i = 0; i < count; i++) {
    for (const property of properties) {
      if (property !== list) {
        skipProperty(property, next);
        continue;
      }
      const corners = next(list.count as Scalar);
      let first = 0;
      let last = 0;
      for (let k = 0; k < corners; k++) {
        const corner = next(list.type);
        if (!Number.isInteger(corner) || corner < 0 || corner >= vertices) {
          throw new FormatError(`${place} is damaged: face ${i} has vertex ${corner} of ${vertices}. Export it again.`);
        }
        if (k === 0) first = corner;
        else if (k > 1) triangles.push(first, last, corner);
        last = corner;
      }
    }
  }
  return Uint32Array.from(triangles);
}
