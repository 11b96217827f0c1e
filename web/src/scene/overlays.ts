// What is drawn over the model while something is selected: the hexahedron with its chosen feature, the points of
// attachments, planes and axes of symmetries. A few fixed buffers, rewritten when the state changes.
import * as three from 'three';
import { type CageShape, isAttachment, isReflection, type LocalTriple, type Vec3 } from '../program/types';
import { localFrame, trilinear } from './cage';
import { type FaceMark, FaceOverlay } from './face_overlay';

const maxPoints = 256;

export interface Highlight {
  /** Part whose hexahedron is drawn, or -1. */
  readonly part: number;
  readonly feature: LocalTriple;
  /** Relation indices whose points, planes and axes are drawn. */
  readonly relations: readonly number[];
  /** Faces that are drawn besides. */
  readonly faces?: readonly FaceMark[];
}

/** In the normalised frame: a point, a direction of length 1, and how far it shall reach. */
export interface Sheet {
  readonly origin: Vec3;
  readonly normal: Vec3;
  readonly reach: number;
}

export interface OverlayColours {
  readonly accent: three.ColorRepresentation;
  readonly quiet: three.ColorRepresentation;
}

/** Corner k → its edges towards corners k ^ 1, k ^ 2, k ^ 4, each once: twelve. */
const edgePairs: readonly (readonly [number, number])[] = Array.from({ length: 8 }, (_, k) =>
  [1, 2, 4].filter((bit) => !(k & bit)).map((bit) => [k, k | bit] as const),
).flat();

export class Overlays {
  readonly root = new three.Group();
  readonly #box: three.LineSegments;
  readonly #feature: three.Mesh;
  readonly #featureLine: three.Line;
  readonly #guide: three.Line;
  readonly #points: three.Points;
  readonly #faces = new FaceOverlay();
  readonly #planes: three.Mesh[] = [];
  readonly #ruler = new three.Line(buffer(2), new three.LineBasicMaterial({ depthTest: false, transparent: true }));
  readonly #marks = new three.Points(
    buffer(2),
    new three.PointsMaterial({ size: 10, sizeAttenuation: false, depthTest: false, transparent: true }),
  );
  readonly #sheet = new three.Mesh(
    new three.PlaneGeometry(2, 2),
    new three.MeshBasicMaterial({ transparent: true, opacity: 0.3, side: three.DoubleSide, depthWrite: false }),
  );
  readonly #planeMaterial: three.MeshBasicMaterial;
  #highlight: Highlight = { part: -1, feature: [0, 0, 0], relations: [] };
  /** Of each attachment, and of what stands on the floor: its points in local coordinates of its first part. */
  readonly #attachments = new Map<number, { part: number; local: Vec3[] }>();

  constructor(private readonly shape: CageShape) {
    const lines = new three.LineBasicMaterial({ depthTest: false, transparent: true, opacity: 0.9 });
    this.#box = new three.LineSegments(buffer(24), lines);
    this.#feature = new three.Mesh(
      buffer(4).setIndex([0, 1, 2, 2, 1, 3]),
      new three.MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.35, side: three.DoubleSide }),
    );
    this.#featureLine = new three.Line(buffer(2), new three.LineBasicMaterial({ depthTest: false }));
    this.#guide = new three.Line(buffer(2), new three.LineBasicMaterial({ transparent: true, opacity: 0.55 }));
    this.#guide.visible = false;
    this.#points = new three.Points(
      buffer(maxPoints),
      new three.PointsMaterial({ size: 9, sizeAttenuation: false, depthTest: false, transparent: true }),
    );
    this.#planeMaterial = new three.MeshBasicMaterial({
      transparent: true,
      opacity: 0.14,
      side: three.DoubleSide,
      depthWrite: false,
    });
    this.#ruler.visible = this.#marks.visible = false;
    const fixed = [this.#box, this.#feature, this.#featureLine, this.#guide, this.#points, this.#ruler, this.#marks];
    for (const object of fixed) {
      object.frustumCulled = false;
      object.renderOrder = 10;
      this.root.add(object);
    }
    this.#sheet.visible = false;
    this.root.add(this.#faces.mesh, this.#sheet);
    const index = new Map(shape.parts.map((part, i) => [part.id, i]));
    for (const [i, relation] of shape.relations.entries()) {
      if (!isAttachment(relation)) continue;
      const part = index.get(relation.parts[0] ?? '') ?? 0;
      const { centre, inverse } = localFrame(shape.parts[part]?.corners ?? []);
      const local = relation.points.map((point) => {
        const v = new three.Vector3(...point).sub(centre).applyMatrix3(inverse);
        return [v.x, v.y, v.z] as const;
      });
      this.#attachments.set(i, { part, local });
    }
  }

  setColours({ accent, quiet }: OverlayColours): void {
    const coloured = [
      this.#feature,
      this.#featureLine,
      this.#guide,
      this.#points,
      this.#box,
      this.#faces.mesh,
      this.#sheet,
      this.#ruler,
      this.#marks,
    ];
    for (const object of coloured) {
      (object.material as three.LineBasicMaterial).color.set(accent);
    }
    this.#planeMaterial.color.set(quiet);
  }

  show(highlight: Highlight, corners: Float64Array): void {
    this.#highlight = highlight;
    for (const plane of this.#planes) plane.visible = false;
    let planes = 0;
    for (const i of highlight.relations) {
      const relation = this.shape.relations[i];
      if (relation && isReflection(relation)) this.#placePlane(planes++, relation.origin, relation.normal);
    }
    this.update(corners);
  }

  /** A line through a point, as long as anybody pulls; null takes it away. */
  guide(line: { readonly from: Vec3; readonly axis: Vec3 } | null): void {
    this.#guide.visible = line !== null;
    if (line === null) return;
    const positions = this.#guide.geometry.getAttribute('position') as three.BufferAttribute;
    for (const end of [0, 1]) {
      const point = scratch.set(...line.axis).multiplyScalar(end === 0 ? -3 : 3);
      positions.setXYZ(end, point.x + line.from[0], point.y + line.from[1], point.z + line.from[2]);
    }
    positions.needsUpdate = true;
  }

  /** The points that a ruler goes between, and the line; none takes it away. */
  ruler(points: readonly Vec3[]): void {
    this.#ruler.visible = points.length === 2;
    this.#marks.visible = points.length > 0;
    for (const geometry of [this.#ruler.geometry, this.#marks.geometry]) {
      const positions = geometry.getAttribute('position') as three.BufferAttribute;
      for (const [i, point] of points.entries()) positions.setXYZ(i, ...point);
      positions.needsUpdate = true;
    }
    this.#marks.geometry.setDrawRange(0, points.length);
  }

  /** A sheet across a direction, through a point; null takes it away. */
  sheet(plane: Sheet | null): void {
    this.#sheet.visible = plane !== null;
    if (plane === null) return;
    this.#sheet.position.set(...plane.origin);
    this.#sheet.quaternion.setFromUnitVectors(new three.Vector3(0, 0, 1), scratch.set(...plane.normal));
    this.#sheet.scale.setScalar(1.15 * plane.reach);
  }

  /** Follows the state; allocates nothing. */
  update(corners: Float64Array): void {
    const { part, feature, relations } = this.#highlight;
    this.#box.visible = part >= 0;
    this.#feature.visible = this.#featureLine.visible = false;
    let points = 0;
    const positions = this.#points.geometry.getAttribute('position') as three.BufferAttribute;
    const add = (point: three.Vector3) => {
      if (points < maxPoints) positions.setXYZ(points++, point.x, point.y, point.z);
    };
    if (part >= 0) {
      const box = this.#box.geometry.getAttribute('position') as three.BufferAttribute;
      for (const [i, pair] of edgePairs.entries()) {
        for (const [end, corner] of pair.entries()) {
          const at = part * 24 + corner * 3;
          box.setXYZ(2 * i + end, corners[at] ?? 0, corners[at + 1] ?? 0, corners[at + 2] ?? 0);
        }
      }
      box.needsUpdate = true;
      this.#showFeature(corners, part, feature, add);
    }
    for (const relation of relations) {
      const attachment = this.#attachments.get(relation);
      for (const local of attachment?.local ?? [])
        add(trilinear(corners, (attachment?.part ?? 0) * 24, local, scratch));
    }
    positions.needsUpdate = true;
    this.#points.geometry.setDrawRange(0, points);
    this.#points.visible = points > 0;
    this.#faces.update(this.#highlight.faces ?? [], corners);
  }

  dispose(): void {
    this.root.traverse((object) => {
      if (!(object instanceof three.Mesh || object instanceof three.Line || object instanceof three.Points)) return;
      object.geometry.dispose();
      object.material.dispose();
    });
  }

  /** A face as a sheet, an edge as a line, a corner as a point. */
  #showFeature(corners: Float64Array, part: number, feature: LocalTriple, add: (point: three.Vector3) => void): void {
    const free = [0, 1, 2].filter((axis) => feature[axis] === 0);
    if (free.length === 3) return;
    if (free.length === 0) add(trilinear(corners, part * 24, feature, scratch));
    if (free.length === 0) return;
    const shown = free.length === 2 ? this.#feature : this.#featureLine;
    const positions = shown.geometry.getAttribute('position') as three.BufferAttribute;
    for (let i = 0; i < 2 ** free.length; i++) {
      const local: [number, number, number] = [...feature];
      for (const [bit, axis] of free.entries()) local[axis] = i & (1 << bit) ? 1 : -1;
      const { x, y, z } = trilinear(corners, part * 24, local, scratch);
      positions.setXYZ(i, x, y, z);
    }
    positions.needsUpdate = true;
    shown.visible = true;
  }

  #placePlane(number: number, origin: Vec3, normal: Vec3): void {
    let plane = this.#planes[number];
    if (plane === undefined) {
      plane = new three.Mesh(new three.PlaneGeometry(2, 2), this.#planeMaterial);
      this.#planes.push(plane);
      this.root.add(plane);
    }
    plane.visible = true;
    plane.position.set(...origin);
    plane.quaternion.setFromUnitVectors(new three.Vector3(0, 0, 1), scratch.set(...normal));
  }
}

const scratch = new three.Vector3();

function buffer(vertices: number): three.BufferGeometry {
  return new three.BufferGeometry().setAttribute(
    'position',
    new three.BufferAttribute(new Float32Array(3 * vertices), 3),
  );
}
