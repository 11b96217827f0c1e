// Nearest places on a surface, by a tree of boxes.
import { BufferAttribute, BufferGeometry, Vector3 } from 'three';
import { MeshBVH } from 'three-mesh-bvh';
import type { Triangles } from '../solid/types';

export interface Nearest {
  readonly distance: number;
  readonly triangle: number;
}

export class SurfaceTree {
  private readonly tree: MeshBVH;
  private readonly origin: readonly number[];
  private readonly at = new Vector3();
  private readonly found = { point: new Vector3(), distance: 0, faceIndex: 0 };

  constructor(surface: Triangles) {
    this.origin = surface.positions.slice(0, 3).length === 3 ? [...surface.positions.slice(0, 3)] : [0, 0, 0];
    const near = Float32Array.from(surface.positions, (x, i) => x - (this.origin[i % 3] as number));
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(near, 3));
    geometry.setIndex(new BufferAttribute(surface.triangles.slice(), 1));
    this.tree = new MeshBVH(geometry, { indirect: true });
  }

  /** The nearest triangle that is no farther than `reach`, or null. */
  nearest(x: number, y: number, z: number, reach: number): Nearest | null {
    const [ox = 0, oy = 0, oz = 0] = this.origin;
    const hit = this.tree.closestPointToPoint(this.at.set(x - ox, y - oy, z - oz), this.found, 0, reach);
    return hit === null || hit.distance > reach ? null : { distance: hit.distance, triangle: hit.faceIndex };
  }
}

/** Unit normals of a surface's triangles, three numbers each; zero of one without area. */
export function normalsOf({ positions, triangles }: Triangles): Float64Array {
  const normals = new Float64Array(triangles.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * (triangles[t + k] as number)) as [number, number, number];
    const u = [0, 1, 2].map((k) => (positions[b + k] as number) - (positions[a + k] as number));
    const v = [0, 1, 2].map((k) => (positions[c + k] as number) - (positions[a + k] as number));
    const [u0 = 0, u1 = 0, u2 = 0, v0 = 0, v1 = 0, v2 = 0] = [...u, ...v];
    const n = [u1 * v2 - u2 * v1, u2 * v0 - u0 * v2, u0 * v1 - u1 * v0];
    const length = Math.hypot(...n);
    if (length > 0) for (let k = 0; k < 3; k++) normals[t + k] = (n[k] as number) / length;
  }
  return normals;
}
