// STL, by three's STLLoader: one node a solid, colours and normals ignored (a triangle is flat whatever the file says). The
// format has neither unit nor axes; millimetres with z up is what printers and CAD programs write and read.
import { STLLoader } from 'three/examples/jsm/loaders/STLLoader.js';
import { decodeText, FormatError, leaf, type Model, type Node, plainSurface, type Source } from './model';
import { shownFile } from './names';

const headerLength = 84; // bytes: 80 of anything, and the number of triangles
const triangleLength = 50; // bytes

/** Throws a FormatError. */
export function readStl({ path, main }: Source): Model {
  const place = shownFile(path);
  const nodes = isText(main) ? readText(decodeText(main), place) : [readBinary(main, place)];
  return { nodes, unit: 1e-3, isZUp: true, remarks: [] };
}

/** Binary files may begin with "solid" too; then their length tells, or that there is no facet. */
function isText(bytes: Uint8Array): boolean {
  const start = new TextDecoder('latin1').decode(bytes.subarray(0, 4096));
  if (!/^\s*(?:\u00ef\u00bb\u00bf)?\s*solid\b/i.test(start)) return false;
  if (bytes.length >= headerLength && bytes.length === headerLength + triangleLength * trianglesOf(bytes)) return false;
  return /\b(?:facet|endsolid)\b/i.test(start);
}

const trianglesOf = (bytes: Uint8Array) =>
  new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength).getUint32(80, true);

const soup = (name: string, positions: Float32Array): Node =>
  leaf(name, [{ positions, indices: null, normals: null, uvs: null, colors: null, surface: plainSurface }]);

function readBinary(bytes: Uint8Array, place: string): Node {
  if (bytes.length < headerLength)
    throw new FormatError(`${place} is empty or damaged: it is no STL. Export it again.`);
  const triangles = trianglesOf(bytes);
  const length = headerLength + triangleLength * triangles;
  if (triangles === 0) throw new FormatError(empty(place));
  if (length > bytes.length) {
    const held = Math.floor((bytes.length - headerLength) / triangleLength);
    throw new FormatError(
      `${place} breaks off or is no STL: it says ${triangles} triangles and holds ${held}. Export or download it again.`,
    );
  }
  const geometry = new STLLoader().parse(new Uint8Array(bytes.subarray(0, length)).buffer);
  return soup('', geometry.getAttribute('position').array as Float32Array);
}

const empty = (place: string) => `${place} holds no triangles. Export it again, with something selected.`;
const notNumbers = (place: string) => `${place} is damaged: corners of a facet are no numbers. Export it again.`;
/** What the loader takes for a corner. */
const corner = /\bvertex(?:\s+[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?){3}(?=\s)/g;
const counted = (text: string, what: RegExp) => text.match(what)?.length ?? 0;

function readText(original: string, place: string): Node[] {
  const names: string[] = [];
  // The loader wants small letters, takes the next line for a missing name, and stumbles over names with its keywords.
  const text = original
    .replace(/^\ufeff/, '')
    .replace(/^[ \t]*solid\b[ \t]*(.*)$/gim, (_, name: string) => {
      names.push(name.trim());
      return 'solid s';
    })
    .replace(/^[ \t]*endsolid\b.*$/gim, 'endsolid')
    .replace(/\b(?:facet|normal|outer|loop|vertex|endloop|endfacet)\b/gi, (word) => word.toLowerCase())
    .replace(/\bfacet\s+normal(?:\s+\S+){3}/g, 'facet normal 0 0 1')
    .trimStart();
  const facets = counted(text, /\bfacet\b/g);
  if (facets === 0) throw new FormatError(empty(place));
  const ended = counted(text, /\bendfacet\b/g);
  const isWhole = ended === facets && counted(text, /^endsolid$/gm) === names.length;
  if (!isWhole || counted(text, /\bvertex\b/g) !== 3 * facets || counted(text, /\bnormal\b/g) !== facets) {
    throw new FormatError(
      `${place} breaks off or is damaged: ${ended} of ${facets} facets in ${names.length} solids are whole. Export it again.`,
    );
  }
  if (counted(text, corner) !== 3 * facets) throw new FormatError(notNumbers(place));
  const geometry = new STLLoader().parse(text);
  const positions = geometry.getAttribute('position').array as Float32Array;
  if (positions.length !== 9 * facets)
    throw new FormatError(`${place} is damaged: it has facets outside of its solids. Export it again.`);
  return geometry.groups
    .map(({ start, count }, i) => soup(names[i] ?? '', positions.slice(3 * start, 3 * (start + count))))
    .filter(({ mesh }) => mesh.some((primitive) => primitive.positions.length > 0));
}
