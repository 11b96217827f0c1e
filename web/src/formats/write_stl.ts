// STL as stl.ts reads it: millimetres, z up, where the model stands. Binary files hold one solid without a name; several parts
// are written as text, a `solid` each under its name.
import type { ShownNode, ShownPrimitive } from './shown';
import { oneLine, shortest, Text } from './text';

const headerLength = 84; // bytes: 80 of anything, and the number of triangles
const triangleLength = 50; // bytes: normal and three corners, 32-bit floats, and two bytes of nothing
const millimetres = 1000; // a metre
/** Text is five times as long; of more triangles than this nobody reads it. */
const mostTextTriangles = 1_000_000;

const trianglesIn = ({ primitives }: ShownNode) =>
  primitives.reduce((sum, { triangles }) => sum + triangles.length / 3, 0);

export interface WrittenStl {
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** Whether several parts became one solid, since text would be too long. */
  readonly isMerged: boolean;
}

/** @param onSolid is told how many are written */
export function writeStl(
  nodes: readonly ShownNode[],
  onSolid: (done: number) => void,
  mostText = mostTextTriangles,
): WrittenStl {
  const total = nodes.reduce((sum, node) => sum + trianglesIn(node), 0);
  if (nodes.length > 1 && total <= mostText) return { bytes: textOf(nodes, onSolid), isMerged: false };
  return { bytes: binaryOf(nodes, total, onSolid), isMerged: nodes.length > 1 };
}

type Three = readonly [number, number, number];

/** The corners of each triangle in the file's frame, as 32-bit floats, and the direction that it faces. */
function* facets({ positions, triangles }: ShownPrimitive): Generator<readonly [Three, Three, Three, Three]> {
  const corner = (i: number): Three => {
    const at = 3 * (triangles[i] ?? 0);
    const [x, y, z] = [positions[at] ?? 0, positions[at + 1] ?? 0, positions[at + 2] ?? 0];
    return [Math.fround(millimetres * x), Math.fround(-millimetres * z), Math.fround(millimetres * y)];
  };
  for (let i = 0; i + 2 < triangles.length; i += 3) {
    const [a, b, c] = [corner(i), corner(i + 1), corner(i + 2)];
    const [u, v] = [b, c].map((p) => [p[0] - a[0], p[1] - a[1], p[2] - a[2]] as const) as [Three, Three];
    const n: Three = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...n) || 1;
    yield [[n[0] / length, n[1] / length, n[2] / length], a, b, c];
  }
}

function textOf(nodes: readonly ShownNode[], onSolid: (done: number) => void): Uint8Array<ArrayBuffer> {
  const text = new Text();
  const spelt = (v: Three) => v.map(shortest).join(' ');
  for (const [i, { name, primitives }] of nodes.entries()) {
    const shown = oneLine(name) || `part ${i + 1}`;
    text.line(`solid ${shown}`);
    for (const primitive of primitives)
      for (const [normal, ...corners] of facets(primitive)) {
        text.line(`facet normal ${spelt(normal)}\nouter loop`);
        for (const one of corners) text.line(`vertex ${spelt(one)}`);
        text.line('endloop\nendfacet');
      }
    text.line(`endsolid ${shown}`);
    onSolid(i + 1);
  }
  return text.bytes('');
}

function binaryOf(nodes: readonly ShownNode[], total: number, onSolid: (done: number) => void) {
  const bytes = new Uint8Array(headerLength + triangleLength * total);
  const view = new DataView(bytes.buffer);
  bytes.set(new TextEncoder().encode('Binary STL, millimetres, z up. Written by ParSEL.'));
  view.setUint32(80, total, true);
  let at = headerLength;
  for (const [i, { primitives }] of nodes.entries()) {
    for (const primitive of primitives)
      for (const four of facets(primitive)) {
        for (const [k, value] of four.flat().entries()) view.setFloat32(at + 4 * k, value, true);
        at += triangleLength;
      }
    onSolid(i + 1);
  }
  return bytes;
}
