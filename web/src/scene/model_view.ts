// A model in the scene: every part is one instanced draw of its own mesh, whose vertices follow the cage. When the count
// of a group changes, one member's mesh is drawn once an instance and the other members rest.
import * as three from 'three';
import { type CageShape, isGroup } from '../program/types';
import { CageTexture, localFrame } from './cage';
import { depthMaterial, followCage } from './cage_material';
import type { State } from './explode';
import type { LoadedMesh, LoadedModel } from './meshes';

/** Display colour, 0 … 1, and how much of it. */
export type Tint = readonly [red: number, green: number, blue: number, strength: number];
export const noTint: Tint = [0, 0, 0, 0];

/** A mesh in the local coordinates of its hexahedron. */
export interface Surface {
  /** Three numbers a corner. */
  readonly positions: Float32Array<ArrayBuffer>;
  /** Pulled back with the hexahedron's edges. */
  readonly normals: Float32Array<ArrayBuffer>;
  readonly triangles: Uint32Array<ArrayBuffer>;
}

interface PartMesh {
  readonly mesh: three.Mesh<three.InstancedBufferGeometry>;
  rows: three.InstancedBufferAttribute;
}

interface GroupMeshes {
  readonly relation: number;
  readonly members: readonly number[];
  /** As drawn: member and count, -1 and 0 while every member draws itself. */
  source: number;
  count: number;
}

export class ModelView {
  /** A scene of its own, so that picking can draw it alone with a material of its own. */
  readonly root = new three.Scene();
  /** What has no part: lines and points. */
  readonly extras = new three.Group();
  readonly cage: CageTexture;
  readonly #parts: (PartMesh | null)[];
  readonly #groups: GroupMeshes[] = [];
  readonly #tints: Tint[];
  readonly #hidden: boolean[];

  constructor(
    readonly shape: CageShape,
    readonly loaded: LoadedModel,
  ) {
    this.cage = new CageTexture(shape);
    this.#tints = shape.parts.map(() => noTint);
    this.#hidden = shape.parts.map(() => false);
    const index = new Map(shape.parts.map((part, i) => [`${part.node}/${part.primitive}`, i]));
    this.#parts = shape.parts.map(() => null);
    const shadow = depthMaterial(this.cage.uniform);
    const patched = new Set<three.Material>();
    const toShape = new three.Matrix4()
      .makeScale(1 / shape.frame.scale, 1 / shape.frame.scale, 1 / shape.frame.scale)
      .multiply(turnedOnto(shape.frame.axes))
      .multiply(new three.Matrix4().makeTranslation(new three.Vector3(...shape.frame.centre).negate()));

    for (const loadedMesh of loaded.meshes) {
      const part = index.get(`${loadedMesh.node}/${loadedMesh.primitive}`);
      if (part === undefined || this.#parts[part]) continue;
      const geometry = cageGeometry(loadedMesh, toShape, shape.parts[part]?.corners ?? []);
      const rows = new three.InstancedBufferAttribute(new Float32Array([part]), 1);
      geometry.setAttribute('cageRow', rows);
      geometry.instanceCount = 1;
      for (const material of [loadedMesh.mesh.material].flat()) {
        if (!patched.has(material)) followCage(material, this.cage.uniform, true);
        // What faces the light would shade itself, where both sides are drawn.
        if (material.side === three.DoubleSide) material.shadowSide = three.BackSide;
        patched.add(material);
      }
      const mesh = new three.Mesh(geometry, loadedMesh.mesh.material as three.Material);
      mesh.customDepthMaterial = shadow;
      mesh.castShadow = mesh.receiveShadow = true;
      mesh.frustumCulled = false; // its bounds are those of the cage, not of `position`
      mesh.matrixAutoUpdate = false;
      this.#parts[part] = { mesh, rows };
      this.root.add(mesh);
    }
    for (const object of loaded.rest) {
      const copy = object.clone(false);
      copy.matrixAutoUpdate = false;
      copy.matrix.multiplyMatrices(toShape, object.matrixWorld);
      this.extras.add(copy);
    }
    const partOf = new Map(shape.parts.map((part, i) => [part.id, i]));
    for (const [relation, detail] of shape.relations.entries()) {
      if (!isGroup(detail)) continue;
      const members = detail.parts.map((id) => partOf.get(id) ?? -1);
      this.#groups.push({ relation, members, source: -1, count: 0 });
    }
  }

  /** Shows a state: uploads corners, and changes draws only where a count has changed. */
  update(state: State): void {
    const moved = this.cage.write(state);
    for (const group of this.#groups) {
      const view = state.groups[group.relation];
      const source = view?.source ?? -1;
      const count = source < 0 ? 0 : (view?.count ?? 0);
      if (!moved && source === group.source && count === group.count) continue;
      group.source = source;
      group.count = count;
      this.#redraw(group);
    }
  }

  /** Of a part and, when its group is drawn from one mesh, of the instance that it stands for. */
  setTint(part: number, tint: Tint): void {
    if (this.#tints[part] === tint) return;
    this.#tints[part] = tint;
    this.cage.setTint(part, ...tint);
    for (const group of this.#groups) if (group.source >= 0 && group.members.includes(part)) this.#tintInstances(group);
  }

  tintOf(part: number): Tint {
    return this.#tints[part] ?? noTint;
  }

  setHidden(part: number, hidden: boolean): void {
    this.#hidden[part] = hidden;
    const drawn = this.#parts[part];
    if (drawn) drawn.mesh.visible = this.#isDrawn(part);
  }

  /** Draws a part as what is left of it; by its instances, too. */
  setSurface(part: number, { positions, normals, triangles }: Surface): void {
    const geometry = this.#parts[part]?.mesh.geometry;
    if (geometry === undefined) return;
    geometry.dispose(); // forgets the old attributes' buffers
    for (const name of Object.keys(geometry.attributes)) if (name !== 'cageRow') geometry.deleteAttribute(name);
    geometry.setAttribute('position', new three.BufferAttribute(positions, 3));
    geometry.setAttribute('normal', new three.BufferAttribute(normals, 3));
    geometry.setIndex(new three.BufferAttribute(triangles, 1));
    geometry.clearGroups();
  }

  /** The part that a row of the cage belongs to, or -1. */
  partOfRow(row: number): number {
    if (row < this.shape.parts.length) return row;
    for (const group of this.#groups) {
      const number = row - this.cage.rowOfInstance(group.relation, 0);
      if (number >= 0 && number < group.count) {
        return group.members[Math.min(number, group.members.length - 1)] ?? -1;
      }
    }
    return -1;
  }

  /** The mesh that a part is drawn from; null for virtual parts and what could not be read. */
  meshOf(part: number): three.Mesh<three.InstancedBufferGeometry> | null {
    return this.#parts[part]?.mesh ?? null;
  }

  dispose(): void {
    for (const part of this.#parts) {
      part?.mesh.geometry.dispose();
      part?.mesh.customDepthMaterial?.dispose();
    }
    this.cage.dispose();
    this.loaded.dispose();
  }

  #isDrawn(part: number): boolean {
    const group = this.#groups.find(({ members }) => members.includes(part));
    return !this.#hidden[part] && (group === undefined || group.source < 0 || group.members[group.source] === part);
  }

  #redraw(group: GroupMeshes): void {
    for (const [number, member] of group.members.entries()) {
      const part = this.#parts[member];
      if (!part) continue;
      part.mesh.visible = this.#isDrawn(member);
      const instances = group.source === number ? group.count : 0;
      const size = Math.max(1, instances);
      if (part.rows.count < size) {
        part.rows = new three.InstancedBufferAttribute(new Float32Array(2 * size), 1);
        part.mesh.geometry.dispose(); // forgets the old attribute's buffer
        part.mesh.geometry.setAttribute('cageRow', part.rows);
      }
      for (let i = 0; i < size; i++) {
        part.rows.setX(i, instances > 0 ? this.cage.rowOfInstance(group.relation, i) : member);
      }
      part.rows.needsUpdate = true;
      part.mesh.geometry.instanceCount = size;
    }
    this.#tintInstances(group);
  }

  #tintInstances(group: GroupMeshes): void {
    for (let i = 0; i < group.count; i++) {
      const member = group.members[Math.min(i, group.members.length - 1)] ?? -1;
      this.cage.setTint(this.cage.rowOfInstance(group.relation, i), ...(this.#tints[member] ?? noTint));
    }
  }
}

/** From the file's axes to the model's own. */
function turnedOnto(axes: CageShape['frame']['axes']): three.Matrix4 {
  const turn = new three.Matrix4();
  if (axes === undefined) return turn;
  const [x, y, z] = axes;
  return turn.set(...x, 0, ...y, 0, ...z, 0, 0, 0, 0, 1);
}

/**
 * The mesh in the local coordinates of its hexahedron at rest: `position` = (u,v,w), `normal` and `tangent` pulled back
 * with the box's edges, everything else shared with the file's geometry.
 */
function cageGeometry(
  { mesh }: LoadedMesh,
  toShape: three.Matrix4,
  corners: Parameters<typeof localFrame>[0],
): three.InstancedBufferGeometry {
  const source = mesh.geometry;
  const frame = localFrame(corners);
  const toModel = new three.Matrix4().multiplyMatrices(toShape, mesh.matrixWorld);
  const geometry = new three.InstancedBufferGeometry();
  for (const [name, attribute] of Object.entries(source.attributes)) geometry.setAttribute(name, attribute);
  geometry.setIndex(source.index);
  for (const { start, count, materialIndex } of source.groups) geometry.addGroup(start, count, materialIndex);

  const v = new three.Vector3();
  const map = (name: string, itemSize: number, convert: () => void) => {
    const from = source.getAttribute(name);
    if (from === undefined) return;
    const to = new three.BufferAttribute(new Float32Array(from.count * itemSize), itemSize);
    for (let i = 0; i < from.count; i++) {
      v.fromBufferAttribute(from, i);
      convert();
      to.setXYZ(i, v.x, v.y, v.z);
      if (itemSize === 4) to.setW(i, from.getW(i));
    }
    geometry.setAttribute(name, to);
  };
  map('position', 3, () => v.applyMatrix4(toModel).sub(frame.centre).applyMatrix3(frame.inverse));
  const normalMatrix = new three.Matrix3().getNormalMatrix(toModel);
  const pullBack = frame.edges.clone().transpose();
  map('normal', 3, () => v.applyMatrix3(normalMatrix).normalize().applyMatrix3(pullBack).normalize());
  map('tangent', 4, () => v.transformDirection(toModel).applyMatrix3(frame.inverse));
  if (toModel.determinant() < 0) flipWinding(geometry);
  return geometry;
}

/** A mirrored node turns its triangles over, which three sees by the node's matrix; ours is in the positions. */
function flipWinding(geometry: three.BufferGeometry): void {
  const count = geometry.index?.count ?? geometry.getAttribute('position').count;
  const flipped = new Uint32Array(count);
  for (let i = 0; i < count; i++) {
    const from = i % 3 === 0 ? i : i % 3 === 1 ? i + 1 : i - 1;
    flipped[i] = geometry.index?.getX(from) ?? from;
  }
  geometry.setIndex(new three.BufferAttribute(flipped, 1));
}
