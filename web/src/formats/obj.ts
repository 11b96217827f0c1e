// Wavefront OBJ, by three's OBJLoader. Every `o` and `g` with faces is a node; one that has no name is a node for each of
// its materials, which then names it. Y is up and a unit is a metre: the format says neither, and most exporters do so.
import * as three from 'three';
import { OBJLoader } from 'three/examples/jsm/loaders/OBJLoader.js';
import { Companions } from './companions';
import {
  decodeText,
  FormatError,
  leaf,
  type Model,
  type Node,
  type Primitive,
  rounded,
  type Source,
  toUnit,
} from './model';
import { type Materials, readMaterials } from './mtl';
import { isPlaceholder, printable, shownFile } from './names';

/** Statements that make up what is read; `s` is told by the normals. */
const foreign = /^[ \t]*(?!(?:v|vn|vt|f|o|g|usemtl|mtllib)(?:[ \t]|$))([^\s#][^\s]*).*$/gm;

/** Kinds of statements that draw something which is no face. */
const drawn: ReadonlyMap<string, string> = new Map([
  ['l', 'lines'],
  ['p', 'points'],
  ['curv', 'curves'],
  ['surf', 'free-form surfaces'],
]);

/** Throws a FormatError. */
export function readObj({ path, main, external }: Source): Model {
  const place = shownFile(path);
  const remarks: string[] = [];
  const skipped = new Set<string>();
  // The loader makes lines of a whole object that has one, and warns of every line that it does not know.
  const text = decodeText(main)
    .replace(/\r\n?/g, '\n')
    .replace(/\\\n/g, ' ')
    .replace(foreign, (_, word: string) => {
      const kind = drawn.get(word);
      if (kind !== undefined) skipped.add(kind);
      return '';
    })
    .replace(/^[ \t]*(usemtl|mtllib)(?:[ \t]+|$)/gm, '$1 ');
  if (!/^[ \t]*f[ \t]/m.test(text)) throw new FormatError(withoutFaces(place, /^[ \t]*v[ \t]/m.test(text)));

  const companions = new Companions(path, external);
  const read = new OBJLoader().parse(text);
  const libraries = (read as three.Group & { materialLibraries: string[] }).materialLibraries;
  const materials = readMaterials(findLibraries(libraries, companions, remarks), companions, remarks);
  const hasNormals = /^[ \t]*vn[ \t]/m.test(text);
  const nodes = read.children.flatMap((child) =>
    child instanceof three.Mesh ? nodesOf(child, materials, hasNormals, place) : [],
  );
  if (skipped.size > 0) remarks.push(`Left out: ${[...skipped].join(', ')}.`);
  return { nodes, unit: 1, isZUp: false, remarks };
}

const withoutFaces = (place: string, hasPoints: boolean) =>
  hasPoints
    ? `${place} holds points but no faces. Make a surface of them first (MeshLab, CloudCompare), or export it with faces.`
    : `${place} is empty or damaged: it has no faces. Export it again.`;

function findLibraries(names: readonly string[], companions: Companions, remarks: string[]): Uint8Array[] {
  const found = new Set<Uint8Array>();
  const missing: string[] = [];
  for (const name of names) {
    const whole = companions.find(name);
    // A name may hold blanks, and a line may hold several names.
    const several = whole === undefined ? name.split(/\s+/).map((one) => [one, companions.find(one)] as const) : [];
    for (const bytes of [whole, ...several.map(([, bytes]) => bytes)]) if (bytes !== undefined) found.add(bytes);
    if (whole === undefined && several.every(([, bytes]) => bytes === undefined)) missing.push(printable(name));
  }
  const others = companions.withExtension('mtl');
  const [only] = others;
  if (found.size === 0 && only !== undefined && others.length === 1) return [only]; // renamed since
  if (missing.length > 0) {
    remarks.push(`Without ${missing.slice(0, 3).join(', ')} there are no colours: drop the files together.`);
  }
  return [...found];
}

function nodesOf(mesh: three.Mesh, materials: Materials, hasNormals: boolean, place: string): Node[] {
  const positions = mesh.geometry.getAttribute('position').array;
  if (!positions.every(Number.isFinite)) {
    const where = mesh.name === '' ? place : `${place}, “${printable(mesh.name)}”`;
    throw new FormatError(
      `${where} is damaged: a face has corners that are not in the file, or that are no numbers. Export it again.`,
    );
  }
  const all = [mesh.material].flat();
  const groups = mesh.geometry.groups.length > 0 ? mesh.geometry.groups : [{ start: 0, count: positions.length / 3 }];
  const byMaterial = new Map<string, { start: number; count: number }[]>();
  for (const { start, count, materialIndex = 0 } of groups as three.GeometryGroup[]) {
    const name = all[materialIndex]?.name ?? '';
    const ranges = byMaterial.get(name) ?? [];
    byMaterial.set(name, ranges);
    if (count > 0) ranges.push({ start, count });
  }
  const primitives = [...byMaterial]
    .filter(([, ranges]) => ranges.length > 0)
    .map(([name, ranges]) => [name, primitive(mesh.geometry, ranges, name, materials, hasNormals)] as const);
  if (!isPlaceholder(mesh.name))
    return [
      leaf(
        mesh.name,
        primitives.map(([, one]) => one),
      ),
    ];
  return primitives.map(([name, one]) => leaf(name, [one]));
}

function primitive(
  geometry: three.BufferGeometry,
  ranges: readonly { start: number; count: number }[],
  material: string,
  materials: Materials,
  hasNormals: boolean,
): Primitive {
  const corners = geometry.getAttribute('position').count;
  const values = (name: string): Float32Array | null => {
    if (!geometry.hasAttribute(name)) return null;
    const { array, itemSize, count } = geometry.getAttribute(name);
    if (count !== corners || !array.every(Number.isFinite)) return null;
    const length = ranges.reduce((sum, range) => sum + range.count, 0);
    const found = new Float32Array(length * itemSize);
    let at = 0;
    for (const { start, count: part } of ranges) {
      found.set(array.subarray(start * itemSize, (start + part) * itemSize) as Float32Array, at);
      at += part * itemSize;
    }
    return found;
  };
  const normals = hasNormals ? values('normal') : null;
  const uvs = values('uv');
  const { scale, offset } = materials.placing(material) ?? { scale: [1, 1], offset: [0, 0] };
  for (let i = 0; uvs !== null && i < uvs.length; i += 2) {
    uvs[i] = (uvs[i] as number) * scale[0] + offset[0];
    uvs[i + 1] = 1 - ((uvs[i + 1] as number) * scale[1] + offset[1]); // glTF counts from the top
  }
  return {
    positions: values('position') ?? new Float32Array(),
    indices: null,
    normals: normals === null ? null : toUnit(normals),
    uvs,
    colors: values('color')?.map(rounded) ?? null,
    surface: materials.surface(material),
  };
}
