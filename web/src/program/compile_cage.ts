// Points that ride in a cage: their local coordinates in a hexahedron, and where its trilinear map takes them when its
// corners move. All on flat arrays, nothing allocated.
//
// The trilinear map in powers of its coordinates, c₀ + c₁u + c₂v + c₃uv + c₄w + c₅uw + c₆vw + c₇uvw, has
// cₘ = ⅛ Σₖ Hₖ χₘ(k), χₘ(k) the product of corner k's signs along the axes in m: a Walsh–Hadamard transform of the
// corners, once a statement. Each of its points then costs about a hundred multiplications a Newton step; summing weights
// over the corners instead made whole evaluations of programs with groups three times slower (2.2 against 0.76 ms).

const newtonSteps = 32;
const converged = 1e-12;
/** Jacobian determinants up to this are singular: that of a cube with edges of two millionths. */
const singular = 1e-18;
/** A direction between face centres closer than this is none. */
const shortestAxis = 1e-12;

/** The motion of a cage, to carry points by. */
export class CageMotion {
  /** cₘ of the cage before the motion, and of its corners' displacement; m × 3. */
  private readonly cage = new Float64Array(24);
  private readonly motion = new Float64Array(24);

  /** Takes a copy of the cage corners[at … at + 23] before it moves. */
  begin(corners: Float64Array, at: number): void {
    for (let i = 0; i < 24; ++i) this.cage[i] = corners[at + i] as number;
  }

  /** The same cage after it has moved. */
  end(corners: Float64Array, at: number): void {
    for (let i = 0; i < 24; ++i) this.motion[i] = (corners[at + i] as number) - (this.cage[i] as number);
    transform(this.cage);
    transform(this.motion);
  }

  /**
   * Moves points[at … at + 2] by Σ Nₖ(u) ΔHₖ, where u are its local coordinates in the cage before the motion, by
   * Newton's method. The first step, from the centre, is the affine guess: there the derivatives are the mean axes.
   * Without convergence the guess stands, and the centre where even that is singular.
   */
  carry(points: Float64Array, at: number): void {
    const c = this.cage;
    const px = points[at] as number;
    const py = points[at + 1] as number;
    const pz = points[at + 2] as number;
    let u = 0;
    let v = 0;
    let w = 0;
    let guessU = 0;
    let guessV = 0;
    let guessW = 0;
    let done = false;
    for (let step = 0; step <= newtonSteps && !done; ++step) {
      const uv = u * v;
      const uw = u * w;
      const vw = v * w;
      // Derivatives by u, v and w.
      const ux = (c[3] as number) + (c[9] as number) * v + (c[15] as number) * w + (c[21] as number) * vw;
      const uy = (c[4] as number) + (c[10] as number) * v + (c[16] as number) * w + (c[22] as number) * vw;
      const uz = (c[5] as number) + (c[11] as number) * v + (c[17] as number) * w + (c[23] as number) * vw;
      const vx = (c[6] as number) + (c[9] as number) * u + (c[18] as number) * w + (c[21] as number) * uw;
      const vy = (c[7] as number) + (c[10] as number) * u + (c[19] as number) * w + (c[22] as number) * uw;
      const vz = (c[8] as number) + (c[11] as number) * u + (c[20] as number) * w + (c[23] as number) * uw;
      const wx = (c[12] as number) + (c[15] as number) * u + (c[18] as number) * v + (c[21] as number) * uv;
      const wy = (c[13] as number) + (c[16] as number) * u + (c[19] as number) * v + (c[22] as number) * uv;
      const wz = (c[14] as number) + (c[17] as number) * u + (c[20] as number) * v + (c[23] as number) * uv;
      // What is missing to the point: p - c₀ - c₁u - (c₂ + c₃u)v - (c₄ + c₅u + c₆v + c₇uv)w.
      const rx = px - (c[0] as number) - (c[3] as number) * u - ((c[6] as number) + (c[9] as number) * u) * v - wx * w;
      const ry = py - (c[1] as number) - (c[4] as number) * u - ((c[7] as number) + (c[10] as number) * u) * v - wy * w;
      const rz = pz - (c[2] as number) - (c[5] as number) * u - ((c[8] as number) + (c[11] as number) * u) * v - wz * w;
      // Cramer's rule, with the cross products v × w, w × u and u × v of the derivatives.
      const ax = vy * wz - vz * wy;
      const ay = vz * wx - vx * wz;
      const az = vx * wy - vy * wx;
      const determinant = ux * ax + uy * ay + uz * az;
      if (!(Math.abs(determinant) > singular)) break;
      const du = (rx * ax + ry * ay + rz * az) / determinant;
      const dv = (rx * (wy * uz - wz * uy) + ry * (wz * ux - wx * uz) + rz * (wx * uy - wy * ux)) / determinant;
      const dw = (rx * (uy * vz - uz * vy) + ry * (uz * vx - ux * vz) + rz * (ux * vy - uy * vx)) / determinant;
      u += du;
      v += dv;
      w += dw;
      if (step === 0) {
        guessU = u;
        guessV = v;
        guessW = w;
      } else {
        done = Math.abs(du) <= converged && Math.abs(dv) <= converged && Math.abs(dw) <= converged;
      }
    }
    if (!done) {
      u = guessU;
      v = guessV;
      w = guessW;
    }
    const d = this.motion;
    for (let i = 0; i < 3; ++i) {
      points[at + i] =
        (points[at + i] as number) +
        (d[i] as number) +
        (d[3 + i] as number) * u +
        ((d[6 + i] as number) + (d[9 + i] as number) * u) * v +
        ((d[12 + i] as number) + (d[15 + i] as number) * u + ((d[18 + i] as number) + (d[21 + i] as number) * u) * v) *
          w;
    }
  }
}

/** Corners to powers, in place: one butterfly an axis. */
function transform(corners: Float64Array): void {
  for (let bit = 3; bit < 24; bit *= 2) {
    for (let i = 0; i < 24; ++i) {
      if (Math.floor(i / bit) % 2 === 1) continue;
      const low = corners[i] as number;
      const high = corners[i + bit] as number;
      corners[i] = (low + high) / 2;
      corners[i + bit] = (high - low) / 2;
    }
  }
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
