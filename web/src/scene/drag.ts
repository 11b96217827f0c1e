// From the pointer to a distance along an axis in the scene.
import * as three from 'three';

/** An axis that points at the eye more closely than this (cosine) has no direction on the screen. */
const steepest = 0.985;

/**
 * The point of the axis that is nearest to the ray through the pointer, as its distance from `from`.
 * @param at pointer in normalised device coordinates
 * @param axis of length 1
 */
export function distanceAlong(
  camera: three.PerspectiveCamera,
  at: three.Vector2,
  from: three.Vector3,
  axis: three.Vector3,
): number {
  const ray = new three.Raycaster();
  ray.setFromCamera(at, camera);
  const { origin, direction } = ray.ray;
  const between = origin.clone().sub(from);
  const cosine = three.MathUtils.clamp(direction.dot(axis), -steepest, steepest);
  return (between.dot(axis) - cosine * between.dot(direction)) / (1 - cosine * cosine);
}

/** Of the global axes, the one along which something at a point moves most nearly as the pointer did, in pixels. */
export function axisOfDrag(
  project: (points: readonly number[]) => { readonly x: number; readonly y: number },
  from: readonly [number, number, number],
  moved: { readonly x: number; readonly y: number },
): 0 | 1 | 2 {
  const start = project(from);
  const likeness = [0, 1, 2].map((axis) => {
    const end = project(from.map((value, i) => value + (i === axis ? 0.05 : 0)));
    const [x, y] = [end.x - start.x, end.y - start.y];
    // Divided by a little more than its length, so that an axis that points at the eye does not win by chance.
    return Math.abs(x * moved.x + y * moved.y) / (Math.hypot(x, y) + 2);
  });
  return likeness.indexOf(Math.max(...likeness)) as 0 | 1 | 2;
}
