// Pictures of other states of the model, drawn by the stage's own renderer between two of its frames: in the same light, with
// the same materials, and without a second context, of which browsers keep few.
import * as three from 'three';
import type { CageShape } from '../program/types';
import type { State } from './explode';
import type { Tint } from './model_view';

export interface Picture {
  readonly state: State;
  /** Drawn over; its width and height are those of the picture, in pixels. */
  readonly canvas: HTMLCanvasElement;
  /** By part. */
  readonly tints?: ReadonlyMap<number, Tint>;
}

/** Where the mean of some points of the shape is in the pictures: shares of width and height, from the upper left. */
export type Projection = (points: ArrayLike<number>) => { readonly x: number; readonly y: number };

/** A state that stays as it is when the evaluator goes on to another. */
export const copyOf = ({ corners, groups }: State): State => ({
  corners: corners.slice(),
  groups: groups.map(
    (group) =>
      group && {
        relation: group.relation,
        count: group.count,
        source: group.source,
        points: group.points.slice(),
        instances: group.instances.slice(0, group.count * 24),
      },
  ),
});

/** From the front, the left and above, as the stage looks at first: what `prompts/` says of the picture. */
const polar = 1.2;
const azimuth = 0.55;
const margin = 1.02;

/** A camera that sees a sphere, for pictures of one aspect ratio. */
export function pictureCamera({ center, radius }: three.Sphere, aspect: number): three.PerspectiveCamera {
  const camera = new three.PerspectiveCamera(25, aspect, 0.05, 100);
  const half = three.MathUtils.degToRad(camera.fov / 2);
  const narrow = Math.atan(Math.tan(half) * Math.min(1, aspect));
  const distance = (margin * radius) / Math.sin(narrow);
  camera.position.setFromSphericalCoords(distance, polar, azimuth).add(center);
  camera.near = distance / 50;
  camera.far = distance * 3;
  camera.lookAt(center);
  camera.updateProjectionMatrix();
  camera.updateMatrixWorld();
  return camera;
}

/** What all states take up together. @param boundsOf answers a box that it may use again */
export function boundsOfAll(
  shape: CageShape,
  states: readonly State[],
  boundsOf: (shape: CageShape, state: State) => three.Box3,
): three.Sphere {
  const all = new three.Box3();
  for (const state of states) all.union(boundsOf(shape, state));
  return all.getBoundingSphere(new three.Sphere());
}

/** Draws the scene as it is now into a canvas. The renderer's own canvas has to be drawn anew before anybody sees it. */
export function shoot(
  renderer: three.WebGLRenderer,
  scene: three.Scene,
  camera: three.Camera,
  canvas: HTMLCanvasElement,
): void {
  const own = renderer.domElement;
  const ratio = renderer.getPixelRatio();
  // Where the window is smaller than the picture, it is drawn small and scaled.
  const scale = Math.min(1, own.width / canvas.width, own.height / canvas.height);
  const [width, height] = [canvas.width, canvas.height].map((size) => Math.max(1, Math.floor(size * scale))) as [
    number,
    number,
  ];
  const viewport = renderer.getViewport(new three.Vector4());
  renderer.setViewport(0, 0, width / ratio, height / ratio);
  renderer.setScissor(0, 0, width / ratio, height / ratio);
  renderer.setScissorTest(true);
  renderer.render(scene, camera);
  renderer.setScissorTest(false);
  renderer.setViewport(viewport);
  const context = canvas.getContext('2d');
  context?.clearRect(0, 0, canvas.width, canvas.height);
  context?.drawImage(own, 0, own.height - height, width, height, 0, 0, canvas.width, canvas.height);
}
