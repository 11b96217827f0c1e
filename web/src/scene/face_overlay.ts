// Faces of parts as sheets over the model: what two parts have in common, for one.
import * as three from 'three';
import type { LocalTriple } from '../program/types';
import { trilinear } from './cage';

export interface FaceMark {
  /** Index of a part; -1: nothing is drawn. */
  readonly part: number;
  /** One non-zero: the face; else nothing is drawn. */
  readonly feature: LocalTriple;
}

const most = 64;

export class FaceOverlay {
  readonly mesh: three.Mesh;

  constructor() {
    const geometry = new three.BufferGeometry();
    geometry.setAttribute('position', new three.BufferAttribute(new Float32Array(most * 4 * 3), 3));
    geometry.setIndex(Array.from({ length: most }, (_, i) => [0, 1, 2, 2, 1, 3].map((k) => 4 * i + k)).flat());
    const material = { depthTest: false, transparent: true, opacity: 0.45, side: three.DoubleSide };
    this.mesh = new three.Mesh(geometry, new three.MeshBasicMaterial(material));
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 11;
    this.mesh.visible = false;
  }

  /** @param corners of all parts, 24 numbers each */
  update(faces: readonly FaceMark[], corners: Float64Array): void {
    const positions = this.mesh.geometry.getAttribute('position') as three.BufferAttribute;
    let drawn = 0;
    for (const { part, feature } of faces) {
      const free = [0, 1, 2].filter((axis) => feature[axis] === 0);
      if (part < 0 || free.length !== 2 || drawn === most) continue;
      for (let i = 0; i < 4; i++) {
        const local: [number, number, number] = [...feature];
        for (const [bit, axis] of free.entries()) local[axis] = i & (1 << bit) ? 1 : -1;
        const { x, y, z } = trilinear(corners, part * 24, local, scratch);
        positions.setXYZ(4 * drawn + i, x, y, z);
      }
      drawn++;
    }
    positions.needsUpdate = drawn > 0;
    this.mesh.geometry.setDrawRange(0, 6 * drawn);
    this.mesh.visible = drawn > 0;
  }
}

const scratch = new three.Vector3();
