// STL, binary: what every slicer reads. It has neither unit nor names; millimetres with z up are what is meant.
import type { Solid } from './types';

const headerLength = 84; // bytes: 80 of anything, and the number of triangles
const triangleLength = 50; // bytes: normal and three corners, 32-bit floats, and two bytes of nothing

/**
 * In the positive octant, where the format wants it.
 * @param scale of the millimetres
 */
export function writeStl({ positions, triangles, low }: Solid, scale: number): Uint8Array<ArrayBuffer> {
  const corners = Float32Array.from(positions, (x, i) => scale * (x - (low[i % 3] as number)));
  const at = (corner: number) => corners.subarray(3 * corner, 3 * corner + 3) as unknown as Corner;
  // Rounding may bring two corners together; what then has no area goes, and the rest is as closed as before.
  const kept: (readonly [Corner, Corner, Corner])[] = [];
  for (let i = 0; i < triangles.length; i += 3) {
    const three = [0, 1, 2].map((k) => at(triangles[i + k] as number)) as [Corner, Corner, Corner];
    const [a, b, c] = three;
    if (!same(a, b) && !same(b, c) && !same(c, a)) kept.push(three);
  }
  const bytes = new Uint8Array(headerLength + triangleLength * kept.length);
  const view = new DataView(bytes.buffer);
  bytes.set(new TextEncoder().encode('Binary STL, millimetres, z up. Written by ParSEL.'));
  view.setUint32(80, kept.length, true);
  for (const [i, three] of kept.entries()) {
    const start = headerLength + triangleLength * i;
    for (const [k, value] of [normalOf(...three), ...three].flatMap((v) => [...v]).entries())
      view.setFloat32(start + 4 * k, value, true);
  }
  return bytes;
}

type Corner = readonly [number, number, number];

const same = (a: Corner, b: Corner) => a[0] === b[0] && a[1] === b[1] && a[2] === b[2];

function normalOf(a: Corner, b: Corner, c: Corner): Corner {
  const [ux, uy, uz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
  const [vx, vy, vz] = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
  const n: Corner = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
  const length = Math.hypot(...n);
  return length > 0 ? [n[0] / length, n[1] / length, n[2] / length] : [0, 0, 0];
}
