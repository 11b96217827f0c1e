// Translation and rotation groups on flat arrays: what the operators of a group, of its parent and of its members do to
// its instances. The semantics are those of core/edit/evaluate.h. ParSEL supplement §3.2 (top-down and bottom-up modes).
import { CageMotion, writeAxis } from './compile_cage';
import { applyMap } from './compile_operators';
import { countingSlack } from './rounding';
import { type Anchor, type GroupRelation, maxInstances } from './types';

/** What the page reads of a group after evaluate(). */
export interface GroupView {
  readonly relation: GroupRelation;
  /** How many instances there are. */
  readonly count: number;
  /** Corners, instance × 24; valid up to count · 24. A new array whenever the group outgrows it. */
  readonly instances: Float64Array;
  /** The member whose mesh all instances share once the count has changed; -1 while every member is its own. */
  readonly source: number;
  /** Translation: start, end, then nothing. Rotation: centre, axis, radius. See `at`. */
  readonly points: Float64Array;
}

/** Where a group's points stand in GroupView.points. */
export const at = { start: 0, end: 3, centre: 0, axis: 3, radius: 6 } as const;
const pointsSize = 7;

/** Indices into the flat corners of all parts. */
export interface GroupLayout {
  /** Part index of the virtual parent. */
  readonly parent: number;
  /** Part indices of the members, in order. */
  readonly members: readonly number[];
}

/** A group under edit. One object a group for the life of an evaluator; reset() brings it back to rest. */
export class CompiledGroup implements GroupView {
  count: number;
  instances: Float64Array;
  source = -1;
  readonly points = new Float64Array(pointsSize);

  private readonly restInstances: Float64Array;
  private readonly restPoints = new Float64Array(pointsSize);
  /** Rotation: 1 when the axis at rest points along the parent's own, else -1. */
  private readonly axisSign: number;
  private readonly template = new Float64Array(24);
  private readonly cage = new CageMotion();
  /** Vectors in use by one operation: the step (0 … 2), another (3 … 5), a third (6 … 8). */
  private readonly scratch = new Float64Array(9);

  constructor(
    readonly relation: GroupRelation,
    readonly layout: GroupLayout,
    private readonly corners: Float64Array,
  ) {
    this.count = layout.members.length;
    this.restInstances = new Float64Array(this.count * 24);
    for (const [k, member] of layout.members.entries()) {
      this.restInstances.set(corners.subarray(member * 24, member * 24 + 24), k * 24);
    }
    this.instances = this.restInstances.slice();
    if (relation.kind === 'translation') {
      this.restPoints.set([...relation.start, ...relation.end]);
      this.axisSign = 1;
    } else {
      this.restPoints.set([...relation.centre, ...relation.axis, relation.radius]);
      writeAxis(corners, layout.parent * 24, relation.parent_axis, this.scratch, 0);
      const cosine = relation.axis.reduce((sum, x, i) => sum + x * (this.scratch[i] as number), 0);
      this.axisSign = cosine < 0 ? -1 : 1;
    }
    this.points.set(this.restPoints);
  }

  reset(): void {
    this.count = this.layout.members.length;
    this.source = -1;
    this.instances.set(this.restInstances);
    this.points.set(this.restPoints);
  }

  /** Puts the instances where the members' corners are read: member k is instance k, or the last there is. */
  writeMembers(): void {
    const { members } = this.layout;
    for (let k = 0; k < members.length; ++k) {
      const from = 24 * Math.min(k, this.count - 1);
      const to = 24 * (members[k] as number);
      for (let i = 0; i < 24; ++i) this.corners[to + i] = this.instances[from + i] as number;
    }
  }

  /** A geometric operator on one member: it moves that instance alone. */
  moveMember(member: number, map: Float64Array, mask: number): void {
    applyMap(map, this.instances, 24 * member, 8, mask);
  }

  /** A geometric operator on the parent: the instances ride in it (top-down). */
  moveParent(map: Float64Array, mask: number): void {
    const parentAt = this.layout.parent * 24;
    const carried = this.relation.kind === 'translation' ? 2 : 1;
    this.cage.begin(this.corners, parentAt);
    applyMap(map, this.corners, parentAt, 8, mask);
    if (mask === 0xff) {
      applyMap(map, this.instances, 0, 8 * this.count, mask);
      applyMap(map, this.points, 0, carried, mask);
    } else {
      this.cage.end(this.corners, parentAt);
      for (let i = 0; i < 8 * this.count; ++i) this.cage.carry(this.instances, 3 * i);
      for (let i = 0; i < carried; ++i) this.cage.carry(this.points, 3 * i);
    }
    if (this.relation.kind === 'rotation') this.refitRing(this.relation.parent_axis);
  }

  /** Spacing (or radius) · (1 + slots[slot]). */
  changeDelta(anchor: Anchor, slots: Float64Array, slot: number): void {
    if (this.relation.kind === 'rotation') this.changeRadius(this.relation.parent_axis, slots, slot);
    else this.changeSpacing(anchor, slots, slot);
  }

  /** Instances + floor(slots[slot]), at least 1. All are copies of one template unless the count stays. */
  changeCount(anchor: Anchor, slots: Float64Array, slot: number): void {
    const wanted = this.count + Math.floor((slots[slot] as number) + countingSlack);
    const next = Math.min(maxInstances, Math.max(1, wanted));
    if (next === this.count) return;
    this.reserve(next);
    if (this.relation.kind === 'rotation') this.refillRing(next);
    else this.refillRow(anchor, next);
    this.count = next;
  }

  private reserve(count: number): void {
    if (this.instances.length >= 24 * count) return;
    const grown = new Float64Array(24 * Math.min(maxInstances, Math.max(count, this.instances.length / 12)));
    grown.set(this.instances);
    this.instances = grown;
  }

  // ------------------------------------------------------------------------------------------------- translation

  /** delta, from one instance to the next, to scratch[0 … 2]; with one instance left, that of the shape at rest. */
  private writeDelta(): void {
    const from = this.count > 1 ? this.points : this.restPoints;
    const gaps = (this.count > 1 ? this.count : this.layout.members.length) - 1;
    for (let i = 0; i < 3; ++i)
      this.scratch[i] = ((from[at.end + i] as number) - (from[at.start + i] as number)) / gaps;
  }

  private changeSpacing(anchor: Anchor, slots: Float64Array, slot: number): void {
    if (this.count === 1) return;
    const { points, scratch, count } = this;
    this.writeDelta();
    const fixed = anchor === 'start' ? 0 : anchor === 'end' ? count - 1 : (count - 1) / 2;
    for (let i = 0; i < 3; ++i) {
      const step = (slots[slot] as number) * (scratch[i] as number);
      for (let k = 0; k < count; ++k) {
        for (let c = 24 * k + i; c < 24 * k + 24; c += 3) {
          this.instances[c] = (this.instances[c] as number) + (k - fixed) * step;
        }
      }
      scratch[3 + i] = -fixed * step;
      scratch[6 + i] = (count - 1 - fixed) * step;
      points[at.start + i] = (points[at.start + i] as number) + (scratch[3 + i] as number);
      points[at.end + i] = (points[at.end + i] as number) + (scratch[6 + i] as number);
    }
    this.moveSides();
  }

  private refillRow(anchor: Anchor, next: number): void {
    const { points, scratch, count, template } = this;
    const chosen = anchor === 'end' ? count - 1 : anchor === 'middle' ? Math.floor((count - 1) / 2) : 0;
    if (this.source < 0) this.source = chosen;
    for (let i = 0; i < 24; ++i) template[i] = this.instances[24 * chosen + i] as number;
    this.writeDelta();
    for (let i = 0; i < 3; ++i) {
      const start = points[at.start + i] as number;
      const end = points[at.end + i] as number;
      const middle = (start + end) / 2;
      const delta = scratch[i] as number;
      // Where the template and the ends of the row are: with one instance left, in the middle of start and end.
      const own = count > 1 ? start + chosen * delta : middle;
      let first = own;
      let step = delta;
      if (anchor === 'end') first = own - (next - 1) * delta;
      else if (anchor === 'middle') first = middle - ((next - 1) / 2) * delta;
      else if (anchor === 'fit') {
        first = next > 1 ? start : middle;
        step = next > 1 ? (end - start) / (next - 1) : 0;
      }
      for (let k = 0; k < next; ++k) {
        for (let c = i; c < 24; c += 3) this.instances[24 * k + c] = (template[c] as number) + (first + k * step - own);
      }
      const last = first + (next - 1) * step;
      scratch[3 + i] = anchor === 'fit' ? 0 : first - start;
      scratch[6 + i] = anchor === 'fit' ? 0 : last - end;
      if (anchor === 'fit') continue;
      points[at.start + i] = first;
      points[at.end + i] = last;
    }
    this.moveSides();
  }

  /** The parent's side at the first instance moves by scratch[3 … 5], the other by scratch[6 … 8] (bottom-up). */
  private moveSides(): void {
    const { relation, corners } = this;
    if (relation.kind !== 'translation') return;
    for (let k = 0; k < 8; ++k) {
      const sign = (k >> relation.axis) & 1 ? 1 : -1;
      const motion = sign === relation.direction ? 6 : 3;
      const to = this.layout.parent * 24 + 3 * k;
      for (let i = 0; i < 3; ++i) corners[to + i] = (corners[to + i] as number) + (this.scratch[motion + i] as number);
    }
  }

  // ---------------------------------------------------------------------------------------------------- rotation

  /** The vector from the axis to the centre of an instance, to scratch[0 … 2]. */
  private writeSpoke(instance: number): void {
    const { points, scratch } = this;
    let along = 0;
    for (let i = 0; i < 3; ++i) {
      let sum = 0;
      for (let c = 24 * instance + i; c < 24 * instance + 24; c += 3) sum += this.instances[c] as number;
      scratch[i] = sum / 8 - (points[at.centre + i] as number);
      along += (scratch[i] as number) * (points[at.axis + i] as number);
    }
    for (let i = 0; i < 3; ++i) scratch[i] = (scratch[i] as number) - along * (points[at.axis + i] as number);
  }

  private changeRadius(parentAxis: number, slots: Float64Array, slot: number): void {
    const { points, scratch, corners } = this;
    const a = slots[slot] as number;
    for (let k = 0; k < this.count; ++k) {
      this.writeSpoke(k);
      for (let c = 0; c < 24; ++c) {
        this.instances[24 * k + c] = (this.instances[24 * k + c] as number) + a * (scratch[c % 3] as number);
      }
    }
    const parentAt = this.layout.parent * 24;
    const first = (parentAxis + 1) % 3;
    const second = (parentAxis + 2) % 3;
    writeAxis(corners, parentAt, first, scratch, 0);
    writeAxis(corners, parentAt, second, scratch, 3);
    const step = a * (points[at.radius] as number);
    for (let k = 0; k < 8; ++k) {
      const s = (k >> first) & 1 ? step : -step;
      const t = (k >> second) & 1 ? step : -step;
      const to = parentAt + 3 * k;
      for (let i = 0; i < 3; ++i) {
        corners[to + i] = (corners[to + i] as number) + s * (scratch[i] as number) + t * (scratch[3 + i] as number);
      }
    }
    points[at.radius] = (points[at.radius] as number) * (1 + a);
  }

  /** Instance k is instance 0 turned by k · 2π/next about the axis; the parent stays. */
  private refillRing(next: number): void {
    const { points, template, instances } = this;
    if (this.source < 0) this.source = 0;
    for (let i = 0; i < 24; ++i) template[i] = instances[i] as number;
    const ax = points[at.axis] as number;
    const ay = points[at.axis + 1] as number;
    const az = points[at.axis + 2] as number;
    for (let k = 1; k < next; ++k) {
      const angle = (2 * Math.PI * k) / next;
      const cosine = Math.cos(angle);
      const sine = Math.sin(angle);
      for (let c = 0; c < 24; c += 3) {
        const x = (template[c] as number) - (points[at.centre] as number);
        const y = (template[c + 1] as number) - (points[at.centre + 1] as number);
        const z = (template[c + 2] as number) - (points[at.centre + 2] as number);
        const along = (1 - cosine) * (ax * x + ay * y + az * z);
        const to = 24 * k + c;
        instances[to] = (points[at.centre] as number) + cosine * x + sine * (ay * z - az * y) + along * ax;
        instances[to + 1] = (points[at.centre + 1] as number) + cosine * y + sine * (az * x - ax * z) + along * ay;
        instances[to + 2] = (points[at.centre + 2] as number) + cosine * z + sine * (ax * y - ay * x) + along * az;
      }
    }
  }

  /** After the parent has moved: the axis follows the parent's, the radius the instances. */
  private refitRing(parentAxis: number): void {
    const { points, scratch } = this;
    if (writeAxis(this.corners, this.layout.parent * 24, parentAxis, scratch, 3)) {
      for (let i = 0; i < 3; ++i) points[at.axis + i] = this.axisSign * (scratch[3 + i] as number);
    }
    let sum = 0;
    for (let k = 0; k < this.count; ++k) {
      this.writeSpoke(k);
      const x = scratch[0] as number;
      const y = scratch[1] as number;
      const z = scratch[2] as number;
      sum += Math.sqrt(x * x + y * y + z * z);
    }
    points[at.radius] = sum / this.count;
  }
}
