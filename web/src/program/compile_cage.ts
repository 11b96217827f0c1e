// Points that ride in a cage: their local coordinates in a hexahedron, and where its trilinear map takes them when its
// corners move. All on flat arrays, nothing allocated.

const newtonSteps = 32;
const converged = 1e-12;
/** Jacobian determinants up to this are singular: that of a cube with edges of two millionths. */
const singular = 1e-18;

// Scratch, not state: every function fills what it reads. Nothing here outlives a call, and there is one thread.
/** Local coordinates u, v, w. */
const local = new Float64Array(3);
/** Residual of the trilinear map at `local` (0 … 2), its derivatives by u, v, w (3 … 11), the step (12 … 14). */
const system = new Float64Array(15);

/**
 * Moves points[at … at + 2] by Σ Nₖ(u) (afterₖ − beforeₖ), where u are its local coordinates in the cage `before`.
 * before: 24 numbers from 0; after: 24 numbers from `afterAt`.
 */
export function carryPoint(
  points: Float64Array,
  at: number,
  before: Float64Array,
  after: Float64Array,
  afterAt: number,
): void {
  locate(points, at, before);
  const u = local[0] as number;
  const v = local[1] as number;
  const w = local[2] as number;
  let x = 0;
  let y = 0;
  let z = 0;
  for (let k = 0; k < 8; ++k) {
    const weight = ((k & 1 ? 1 + u : 1 - u) * (k & 2 ? 1 + v : 1 - v) * (k & 4 ? 1 + w : 1 - w)) / 8;
    x += weight * ((after[afterAt + 3 * k] as number) - (before[3 * k] as number));
    y += weight * ((after[afterAt + 3 * k + 1] as number) - (before[3 * k + 1] as number));
    z += weight * ((after[afterAt + 3 * k + 2] as number) - (before[3 * k + 2] as number));
  }
  points[at] = (points[at] as number) + x;
  points[at + 1] = (points[at + 1] as number) + y;
  points[at + 2] = (points[at + 2] as number) + z;
}

/**
 * Inverts the trilinear map by Newton's method into `local`. The first step, from the centre, is the affine guess: there
 * the derivatives are the mean axes. Without convergence the guess stands, and the centre where even that is singular.
 */
function locate(points: Float64Array, at: number, cage: Float64Array): void {
  local.fill(0);
  evaluate(points, at, cage);
  if (!solve()) return;
  for (let i = 0; i < 3; ++i) local[i] = system[12 + i] as number;
  const u = local[0] as number;
  const v = local[1] as number;
  const w = local[2] as number;
  for (let step = 0; step < newtonSteps; ++step) {
    evaluate(points, at, cage);
    if (!solve()) break;
    for (let i = 0; i < 3; ++i) local[i] = (local[i] as number) + (system[12 + i] as number);
    if (
      Math.abs(system[12] as number) <= converged &&
      Math.abs(system[13] as number) <= converged &&
      Math.abs(system[14] as number) <= converged
    ) {
      return;
    }
  }
  local[0] = u;
  local[1] = v;
  local[2] = w;
}

/** Residual and derivatives of the trilinear map at `local`, into `system`. */
function evaluate(points: Float64Array, at: number, cage: Float64Array): void {
  system.fill(0);
  for (let k = 0; k < 8; ++k) {
    const su = k & 1 ? 1 : -1;
    const sv = k & 2 ? 1 : -1;
    const sw = k & 4 ? 1 : -1;
    const fu = 1 + su * (local[0] as number);
    const fv = 1 + sv * (local[1] as number);
    const fw = 1 + sw * (local[2] as number);
    for (let i = 0; i < 3; ++i) {
      const corner = (cage[3 * k + i] as number) / 8;
      system[i] = (system[i] as number) - fu * fv * fw * corner;
      system[3 + i] = (system[3 + i] as number) + su * fv * fw * corner;
      system[6 + i] = (system[6 + i] as number) + fu * sv * fw * corner;
      system[9 + i] = (system[9 + i] as number) + fu * fv * sw * corner;
    }
  }
  for (let i = 0; i < 3; ++i) system[i] = (system[i] as number) + (points[at + i] as number);
}

/** Solves for the step by Cramer's rule; false when the system is singular. */
function solve(): boolean {
  const determinant = triple(3, 6, 9);
  if (!(Math.abs(determinant) > singular)) return false;
  system[12] = triple(0, 6, 9) / determinant;
  system[13] = triple(3, 0, 9) / determinant;
  system[14] = triple(3, 6, 0) / determinant;
  return true;
}

/** a · (b × c) of three vectors in `system`. */
function triple(a: number, b: number, c: number): number {
  const s = system;
  const bx = s[b] as number;
  const by = s[b + 1] as number;
  const bz = s[b + 2] as number;
  const cx = s[c] as number;
  const cy = s[c + 1] as number;
  const cz = s[c + 2] as number;
  return (
    (s[a] as number) * (by * cz - bz * cy) +
    (s[a + 1] as number) * (bz * cx - bx * cz) +
    (s[a + 2] as number) * (bx * cy - by * cx)
  );
}

/**
 * Writes the unit direction from the - face centre to the + face centre of a cage, corners[at … at + 23], to out[to …];
 * zero, and false, when the two coincide.
 */
export function writeAxis(corners: Float64Array, at: number, axis: number, out: Float64Array, to: number): boolean {
  let x = 0;
  let y = 0;
  let z = 0;
  for (let k = 0; k < 8; ++k) {
    const sign = (k >> axis) & 1 ? 0.25 : -0.25;
    x += sign * (corners[at + 3 * k] as number);
    y += sign * (corners[at + 3 * k + 1] as number);
    z += sign * (corners[at + 3 * k + 2] as number);
  }
  const length = Math.sqrt(x * x + y * y + z * z);
  const scale = length < shortestAxis ? 0 : 1 / length;
  out[to] = x * scale;
  out[to + 1] = y * scale;
  out[to + 2] = z * scale;
  return scale !== 0;
}

const shortestAxis = 1e-12;
