// Points in space, found by their neighbourhood: a grid of cells as wide as what is asked for is far.

const none: readonly number[] = [];

export class PointGrid {
  private readonly cells = new Map<number, number[]>();
  private readonly xyz: number[] = [];

  /** @param reach the farthest that nearest() looks */
  constructor(private readonly reach: number) {}

  get count(): number {
    return this.xyz.length / 3;
  }

  add(x: number, y: number, z: number): number {
    const id = this.count;
    this.xyz.push(x, y, z);
    const key = this.key(this.cell(x), this.cell(y), this.cell(z));
    const there = this.cells.get(key);
    if (there === undefined) this.cells.set(key, [id]);
    else there.push(id);
    return id;
  }

  /** The nearest point that is within reach and accepted, or -1. */
  nearest(x: number, y: number, z: number, accepts: (id: number) => boolean = () => true): number {
    const [i, j, k] = [this.cell(x), this.cell(y), this.cell(z)];
    let [best, least] = [-1, this.reach * this.reach];
    for (let a = i - 1; a <= i + 1; a++)
      for (let b = j - 1; b <= j + 1; b++)
        for (let c = k - 1; c <= k + 1; c++) {
          const cell = this.cells.get(this.key(a, b, c));
          if (cell === undefined) continue;
          for (const id of cell) {
            const squared = this.squared(id, x, y, z);
            if (squared > least || !accepts(id)) continue;
            best = id;
            least = squared;
          }
        }
    return best;
  }

  /** Whether any point is within reach. */
  near(x: number, y: number, z: number): boolean {
    const [i, j, k] = [this.cell(x), this.cell(y), this.cell(z)];
    for (let a = i - 1; a <= i + 1; a++)
      for (let b = j - 1; b <= j + 1; b++)
        for (let c = k - 1; c <= k + 1; c++)
          for (const id of this.cells.get(this.key(a, b, c)) ?? none)
            if (this.squared(id, x, y, z) <= this.reach * this.reach) return true;
    return false;
  }

  distance(id: number, x: number, y: number, z: number): number {
    return id < 0 ? Number.POSITIVE_INFINITY : Math.sqrt(this.squared(id, x, y, z));
  }

  private squared(id: number, x: number, y: number, z: number): number {
    const dx = (this.xyz[3 * id] as number) - x;
    const dy = (this.xyz[3 * id + 1] as number) - y;
    const dz = (this.xyz[3 * id + 2] as number) - z;
    return dx * dx + dy * dy + dz * dz;
  }
  private cell(x: number): number {
    return Math.floor(x / this.reach);
  }
  /** Far cells may share a key: their points are looked at and found too far. */
  private key(i: number, j: number, k: number): number {
    return (Math.imul(i, 73856093) ^ Math.imul(j, 19349663) ^ Math.imul(k, 83492791)) >>> 0;
  }
}
