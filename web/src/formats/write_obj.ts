// Wavefront OBJ with its MTL and pictures, as obj.ts and mtl.ts read them: an `o` a node, y up, a unit a metre.
import type { Texture } from '@gltf-transform/core';
import { nonLinear } from './model';
import type { ShownNode, ShownPrimitive, ShownSurface } from './shown';
import { oneLine, shortest, Text } from './text';

/**
 * Files by name, the OBJ first. Corners of an object that are at one place are one, so that programs that edit meshes find
 * its faces joined.
 * @param name of the files, without extension
 * @param onObject is told how many are written
 */
export function writeObj(
  nodes: Iterable<ShownNode>,
  name: string,
  onObject: (done: number) => void,
): ReadonlyMap<string, Uint8Array<ArrayBuffer>> {
  const library = new Library(name);
  const text = new Text();
  const next: Counts = { v: 1, vt: 1, vn: 1 };
  let done = 0;
  for (const node of nodes) {
    text.line(`o ${oneLine(node.name) || `part ${done + 1}`}`);
    const known = { v: new Map(), vt: new Map(), vn: new Map() };
    for (const primitive of node.primitives) {
      if (primitive.surface !== null) text.line(`usemtl ${library.nameOf(primitive.surface)}`);
      writePrimitive(text, primitive, known, next);
    }
    onObject(++done);
  }
  const files = library.files();
  const head = files.size > 0 ? `mtllib ${name}.mtl\n` : '';
  return new Map([[`${name}.obj`, text.bytes(`# Written by ParSEL. Metres, y up.\n${head}`)], ...files]);
}

type Kind = 'v' | 'vt' | 'vn';
type Counts = Record<Kind, number>;

/** The lines of values that are new, then the faces. */
function writePrimitive(
  text: Text,
  shown: ShownPrimitive,
  known: Record<Kind, Map<string, number>>,
  next: Counts,
): void {
  const { positions, normals, uvs, colors, triangles } = shown;
  const written = new Map<number, string>();
  const numberOf = (kind: Kind, values: readonly number[]) => {
    const line = values.map(shortest).join(' ');
    const number = known[kind].get(line);
    if (number !== undefined) return number;
    text.line(`${kind} ${line}`);
    known[kind].set(line, next[kind]);
    return next[kind]++;
  };
  const corner = (i: number) => {
    const ready = written.get(i);
    if (ready !== undefined) return ready;
    const three = (array: Float64Array) => [...array.subarray(3 * i, 3 * i + 3)];
    const v = numberOf('v', [...three(positions), ...(colors === null ? [] : three(colors).map(nonLinear))]);
    const vt = uvs === null ? '' : numberOf('vt', [uvs[2 * i] ?? 0, 1 - (uvs[2 * i + 1] ?? 0)]);
    const vn = normals === null ? '' : numberOf('vn', three(normals));
    const made = vn === '' ? (vt === '' ? `${v}` : `${v}/${vt}`) : `${v}/${vt}/${vn}`;
    written.set(i, made);
    return made;
  };
  const faces: string[] = [];
  for (let i = 0; i + 2 < triangles.length; i += 3)
    faces.push(`f ${[0, 1, 2].map((k) => corner(triangles[i + k] ?? 0)).join(' ')}`);
  for (const face of faces) text.line(face);
}

/** Materials under names of their own, and the pictures that they show. */
class Library {
  readonly #names = new Map<ShownSurface, string>();
  readonly #pictures = new Map<Texture, string>();
  constructor(readonly name: string) {}

  nameOf(surface: ShownSurface): string {
    const known = this.#names.get(surface);
    if (known !== undefined) return known;
    const taken = new Set(this.#names.values());
    const base = oneLine(surface.name).replace(/\s+/g, '_') || 'material';
    let [made, number] = [base, 1];
    while (taken.has(made)) made = `${base}_${++number}`;
    this.#names.set(surface, made);
    return made;
  }

  files(): Map<string, Uint8Array<ArrayBuffer>> {
    const files = new Map<string, Uint8Array<ArrayBuffer>>();
    if (this.#names.size === 0) return files;
    const text = new Text();
    for (const [surface, name] of this.#names) for (const line of this.#lines(surface, name)) text.line(line);
    files.set(`${this.name}.mtl`, text.bytes(''));
    for (const [texture, path] of this.#pictures) files.set(path, new Uint8Array(texture.getImage() ?? []));
    return files;
  }

  *#lines({ color, emissive, roughness, texture }: ShownSurface, name: string): Generator<string> {
    const spelt = (values: readonly number[]) => values.map((value) => shortest(nonLinear(value))).join(' ');
    yield `newmtl ${name}`;
    yield `Kd ${spelt(color.slice(0, 3))}`;
    if (emissive.some((channel) => channel > 0)) yield `Ke ${spelt(emissive)}`;
    if (color[3] < 1) yield `d ${shortest(color[3])}`;
    yield `Ns ${shortest(1000 * (1 - roughness) ** 2)}`; // as mtl.ts reads it
    if (texture !== null && texture.getImage() !== null) yield `map_Kd ${this.#pathOf(texture)}`;
  }

  #pathOf(texture: Texture): string {
    const type = /^image\/(\w+)$/.exec(texture.getMimeType())?.[1] ?? 'png';
    const number = this.#pictures.size + 1;
    const path = this.#pictures.get(texture) ?? `${this.name}_${number}.${type === 'jpeg' ? 'jpg' : type}`;
    this.#pictures.set(texture, path);
    return path;
  }
}
