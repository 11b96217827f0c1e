// Sloppy boxes: what is one in all instances becomes exactly one, by moves within the tolerance, and nothing else does.
import { describe, expect, it } from 'vitest';
import { type Boxes, type Instance, rounded } from '../../web/src/session/box_rounding';

type Box = Boxes[number];
const box = (
  x: readonly [number, number],
  y: readonly [number, number],
  z: readonly [number, number] = [0, 1],
): Box => [x, y, z];
const size = (one: Box | null | undefined, axis: number) =>
  (one?.[axis]?.[1] ?? Number.NaN) - (one?.[axis]?.[0] ?? Number.NaN);
const farthest = (a: Instance, b: Instance) =>
  Math.max(
    ...a.flatMap((one, i) =>
      (one ?? []).flat().map((value, k) => Math.abs(value - ((b[i] ?? []).flat()[k] ?? Number.NaN))),
    ),
  );

/** Two legs under a top, each a little off. */
const sloppy = (width: number): Instance => [
  box([0, 0.0401], [0, 0.498]),
  box([width - 0.0399, width + 0.003], [0.002, 0.503]),
  box([-0.004, width], [0.5, 0.53]),
];

describe('sloppy boxes', () => {
  it('become flush and alike where they nearly are in all instances', () => {
    const given = [sloppy(0.9), sloppy(1.2)];
    for (const [k, made] of rounded(given, 1).entries()) {
      const [one, other, top] = made;
      expect(one?.[1]?.[1]).toBeCloseTo(top?.[1]?.[0] ?? Number.NaN, 8);
      expect(other?.[1]?.[1]).toBeCloseTo(top?.[1]?.[0] ?? Number.NaN, 8);
      expect(one?.[1]?.[0]).toBeCloseTo(other?.[1]?.[0] ?? Number.NaN, 8);
      expect(one?.[0]?.[0]).toBeCloseTo(top?.[0]?.[0] ?? Number.NaN, 8);
      expect(other?.[0]?.[1]).toBeCloseTo(top?.[0]?.[1] ?? Number.NaN, 8);
      expect(size(one, 1)).toBeCloseTo(size(other, 1), 8);
      expect(farthest(made, given[k] ?? [])).toBeLessThan(0.01);
    }
  });

  it('stay as they are where they differ in one instance', () => {
    const apart: Instance = sloppy(1.2).map((one, i) => (i === 1 && one ? box([1, 1.1], [0.1, 0.4]) : one));
    const [base] = rounded([sloppy(0.9), apart], 1);
    expect(Math.abs((base?.[1]?.[1]?.[1] ?? 0) - (base?.[2]?.[1]?.[0] ?? 0))).toBeGreaterThan(0.001);
    expect(base?.[0]?.[1]?.[1]).toBeCloseTo(base?.[2]?.[1]?.[0] ?? Number.NaN, 8); // the other leg still is
  });

  it('stay as they are where how far apart they are changes', () => {
    const overhang = (by: number): Instance => [box([0, 0.04], [0, 0.5]), box([-by, 0.9], [0.5, 0.53])];
    const edge = ([leg, top]: Instance) => (leg?.[0]?.[0] ?? 0) - (top?.[0]?.[0] ?? 0);
    const [base = [], varied = []] = rounded([overhang(0.004), overhang(0.008)], 1);
    expect(edge(varied) - edge(base)).toBeCloseTo(0.004, 6);
    const [same = []] = rounded([overhang(0.004), overhang(0.005)], 1);
    expect(edge(same)).toBeCloseTo(0, 8);
  });

  it('count where a part is, not where it lacks', () => {
    const without: Instance = sloppy(1.2).map((one, i) => (i === 1 ? null : one));
    const [base, varied] = rounded([sloppy(0.9), without], 1);
    expect(varied?.[1]).toBe(null);
    expect(base?.[1]?.[1]?.[1]).toBeCloseTo(base?.[2]?.[1]?.[0] ?? Number.NaN, 8);
  });

  it('keep thin parts, and curves that no two neighbours show', () => {
    const thin: Instance = [box([0, 1], [0, 0.006]), box([0, 1], [0.006, 0.5])];
    const [sheet] = rounded([thin], 1)[0] ?? [];
    expect(size(sheet, 1)).toBeCloseTo(0.006, 3);
    const curve: Instance = Array.from({ length: 9 }, (_, i) => box([i / 10, i / 10 + 0.03], [0, 0.5 + 0.006 * i]));
    const [made = []] = rounded([curve], 1);
    expect(size(made[8], 1) - size(made[0], 1)).toBeGreaterThan(0.03);
    expect(farthest(made, curve)).toBeLessThanOrEqual(0.01);
  });

  it('that are exact stay so', () => {
    const exact: Instance = [box([0, 0.04], [0, 0.5]), box([0.86, 0.9], [0, 0.5]), box([0, 0.9], [0.5, 0.53])];
    expect(farthest(rounded([exact], 1)[0] ?? [], exact)).toBeLessThan(1e-9);
  });

  it('are rounded alike in whatever unit', () => {
    const inMillimetres = sloppy(0.9).map(
      (one) => one?.map(([low, high]) => [1000 * low, 1000 * high] as const) ?? null,
    );
    const [made = []] = rounded([inMillimetres], 1000);
    const back = made.map((one) => one?.map(([low, high]) => [low / 1000, high / 1000] as const) ?? null);
    expect(farthest(back, rounded([sloppy(0.9)], 1)[0] ?? [])).toBeLessThan(1e-9);
  });
});
