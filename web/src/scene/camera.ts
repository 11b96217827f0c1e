// The camera: orbit, pan and zoom by camera-controls, framing into the part of the canvas that no panel covers.
import CameraControls from 'camera-controls';
import * as three from 'three';

CameraControls.install({ THREE: three });

/** CSS pixels of the canvas that panels cover, from each side. */
export interface Insets {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

export type StandardView = 'front' | 'right' | 'top' | 'home';

/** Azimuth and polar angle in radians; the asset's front faces +Z. */
const viewAngles: Record<StandardView, [azimuth: number, polar: number]> = {
  front: [0, Math.PI / 2],
  right: [Math.PI / 2, Math.PI / 2],
  top: [0, 0],
  home: [0.55, 1.2],
};

/** Where the camera is, as it goes into a link: azimuth, polar angle, distance, target. */
export type CameraPose = readonly [number, number, number, number, number, number];

export class CameraRig {
  readonly camera = new three.PerspectiveCamera(30, 1, 0.02, 60);
  readonly #controls: CameraControls;
  #insets: Insets = { left: 0, right: 0, top: 0, bottom: 0 };
  #width = 1;
  #height = 1;

  constructor(canvas: HTMLCanvasElement, reducedMotion: boolean) {
    const controls = new CameraControls(this.camera, canvas);
    controls.smoothTime = reducedMotion ? 0 : 0.18;
    controls.draggingSmoothTime = reducedMotion ? 0 : 0.06;
    controls.dollyToCursor = true;
    controls.minDistance = 0.3;
    controls.maxDistance = 30;
    controls.maxPolarAngle = Math.PI * 0.98;
    this.#controls = controls;
    void controls.rotateTo(...viewAngles.home, false);
  }

  /** Moves along; answers whether the camera is still moving. */
  update(seconds: number): boolean {
    return this.#controls.update(seconds);
  }

  /** Called whenever something makes the camera move, so that frames are drawn. */
  onChange(listener: () => void): void {
    for (const event of ['control', 'controlstart', 'transitionstart', 'update'] as const) {
      this.#controls.addEventListener(event, listener);
    }
  }

  /** While something else is dragged, the camera stays. */
  set enabled(enabled: boolean) {
    this.#controls.enabled = enabled;
  }

  resize(width: number, height: number, insets: Insets): void {
    this.#width = Math.max(1, width);
    this.#height = Math.max(1, height);
    this.#insets = insets;
    const { left, right, top, bottom } = insets;
    this.camera.aspect = this.#width / this.#height;
    this.camera.setViewOffset(
      this.#width,
      this.#height,
      (right - left) / 2,
      (bottom - top) / 2,
      this.#width,
      this.#height,
    );
    this.camera.updateProjectionMatrix();
  }

  /** Brings a sphere into the free part of the canvas. */
  fit(sphere: three.Sphere, animate: boolean): void {
    const { left, right, top, bottom } = this.#insets;
    const freeHeight = Math.max(80, this.#height - top - bottom);
    const freeWidth = Math.max(80, this.#width - left - right);
    const halfAngle = three.MathUtils.degToRad(this.camera.fov / 2);
    const smaller = Math.min(freeHeight, freeWidth) / this.#height; // of the canvas' height, which `fov` spans
    const distance = (1.04 * sphere.radius) / Math.sin(Math.atan(Math.tan(halfAngle) * smaller));
    const { x, y, z } = sphere.center;
    void this.#controls.moveTo(x, y, z, animate);
    void this.#controls.dollyTo(distance, animate);
  }

  look(view: StandardView, animate: boolean): void {
    const [azimuth, polar] = viewAngles[view];
    const turns = Math.round((this.#controls.azimuthAngle - azimuth) / (2 * Math.PI)); // the short way round
    void this.#controls.rotateTo(azimuth + turns * 2 * Math.PI, polar, animate);
  }

  /** By keyboard: radians about the model, or a factor of the distance. */
  turn(azimuth: number, polar: number): void {
    void this.#controls.rotate(azimuth, polar, true);
  }
  zoom(factor: number): void {
    void this.#controls.dollyTo(this.#controls.distance * factor, true);
  }

  get pose(): CameraPose {
    const { x, y, z } = this.#controls.getTarget(new three.Vector3());
    const round = (value: number) => Math.round(value * 1e3) / 1e3;
    const { azimuthAngle, polarAngle, distance } = this.#controls;
    return [azimuthAngle, polarAngle, distance, x, y, z].map(round) as unknown as CameraPose;
  }
  set pose([azimuth, polar, distance, x, y, z]: CameraPose) {
    void this.#controls.moveTo(x, y, z, false);
    void this.#controls.rotateTo(azimuth, polar, false);
    void this.#controls.dollyTo(distance, false);
  }

  dispose(): void {
    this.#controls.dispose();
  }
}
