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

/** Sides are the object's own: its left is +X. */
export type StandardView = 'front' | 'left' | 'back' | 'right' | 'top' | 'home';

/** Azimuth and polar angle in radians; the asset's front faces +Z. */
const viewAngles: Record<StandardView, [azimuth: number, polar: number]> = {
  front: [0, Math.PI / 2],
  left: [Math.PI / 2, Math.PI / 2],
  back: [Math.PI, Math.PI / 2],
  right: [-Math.PI / 2, Math.PI / 2],
  top: [0, 0],
  home: [0.55, 1.2],
};

/** Where the camera is, as it goes into a link: azimuth, polar angle, distance, target. */
export type CameraPose = readonly [number, number, number, number, number, number];

/** How fast the camera follows, seconds: what a person asks for, and what it does by itself. */
const quick = 0.18;
const gentle = 0.4;
/** CSS pixels that stay for the model, however much is covered. */
const leastFree = 80;

export class CameraRig {
  readonly camera = new three.PerspectiveCamera(30, 1, 0.02, 60);
  readonly #controls: CameraControls;
  #insets: Insets = { left: 0, right: 0, top: 0, bottom: 0 };
  /** How far the middle of the picture stands off that of the canvas, CSS pixels. */
  readonly #shift = { x: 0, y: 0 };
  #width = 1;
  #height = 1;
  /** Drawn since something was put there at once. */
  #frames = 0;
  /** Where the camera was put to see the whole; null when it shall stay where it is. */
  #framed: { readonly target: three.Vector3; readonly distance: number } | null = null;

  constructor(
    canvas: HTMLCanvasElement,
    private readonly reducedMotion: boolean,
  ) {
    const controls = new CameraControls(this.camera, canvas);
    controls.smoothTime = reducedMotion ? 0 : quick;
    controls.draggingSmoothTime = reducedMotion ? 0 : 0.06;
    controls.dollyToCursor = true;
    controls.minDistance = 0.3;
    controls.maxDistance = 30;
    controls.maxPolarAngle = Math.PI * 0.98;
    controls.addEventListener('control', () => {
      controls.smoothTime = reducedMotion ? 0 : quick;
    });
    this.#controls = controls;
    void controls.rotateTo(...viewAngles.home, false);
  }

  /** Moves along; answers whether the camera is still moving. */
  update(seconds: number): boolean {
    const shifts = this.#ease(seconds);
    this.#frames++;
    return this.#controls.update(seconds) || shifts;
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
    this.camera.aspect = this.#width / this.#height;
    if (this.#isNew) Object.assign(this.#shift, this.#wantedShift());
    this.#applyShift();
  }

  /**
   * Brings a sphere into the free part of the canvas.
   * @param whole it is the whole model, which is kept in sight from then on (keepFramed)
   */
  fit(sphere: three.Sphere, animate: boolean, whole: boolean): void {
    if (!animate) this.#frames = 0;
    const [x, y] = this.#slopes();
    const distance = (1.04 * sphere.radius) / Math.sin(Math.atan(Math.min(x, y)));
    this.#moveTo(sphere.center, distance, animate && !this.#isNew, quick);
    if (!whole) this.#framed = null;
  }

  /** Whether the camera sees the whole from where it was put, or was only turned since: nobody has moved or zoomed it. */
  get isFramed(): boolean {
    if (this.#framed === null) return false;
    const { target, distance } = this.#framed;
    const { radius } = this.#controls.getSpherical(new three.Spherical(), true);
    const off = this.#controls.getTarget(new three.Vector3(), true).distanceTo(target);
    return off < 1e-3 * distance && Math.abs(radius - distance) < 1e-3 * distance;
  }

  /**
   * Gently follows a model that grows, unless a person has moved or zoomed the camera since the last fit.
   * @param atFit what was framed then, which stays in sight, so that a slider that goes back brings the camera back
   */
  keepFramed(atFit: three.Box3, now: three.Box3): void {
    if (!this.isFramed) return;
    const box = boxScratch.copy(atFit).union(now);
    const centre = box.getCenter(new three.Vector3());
    const [slopeX, slopeY] = this.#slopes();
    const { radius } = atFit.getBoundingSphere(new three.Sphere());
    let distance = (1.04 * radius) / Math.sin(Math.atan(Math.min(slopeX, slopeY))); // as in fit()
    const spherical = this.#controls.getSpherical(new three.Spherical(), true);
    const back = new three.Vector3().setFromSpherical(spherical).normalize();
    const right = new three.Vector3(Math.cos(spherical.theta), 0, -Math.sin(spherical.theta));
    const up = new three.Vector3().crossVectors(back, right);
    for (let k = 0; k < 8; k++) {
      const corner = new three.Vector3(
        k & 1 ? box.max.x : box.min.x,
        k & 2 ? box.max.y : box.min.y,
        k & 4 ? box.max.z : box.min.z,
      ).sub(centre);
      const aside = Math.max(Math.abs(corner.dot(right)) / slopeX, Math.abs(corner.dot(up)) / slopeY);
      distance = Math.max(distance, 1.04 * aside + corner.dot(back));
    }
    const { target, distance: last } = this.#framed ?? { target: centre, distance };
    // As good as exactly: what comes back to where it was is drawn as it was.
    const isThere = target.distanceTo(centre) < 1e-9 && Math.abs(last - distance) < 1e-9;
    if (!isThere) this.#moveTo(centre, distance, true, gentle);
  }

  #moveTo(centre: three.Vector3, distance: number, animate: boolean, smoothTime: number): void {
    this.#controls.smoothTime = this.reducedMotion ? 0 : smoothTime;
    void this.#controls.moveTo(centre.x, centre.y, centre.z, animate);
    void this.#controls.dollyTo(distance, animate);
    this.#framed = {
      target: centre.clone(),
      distance: this.#controls.getSpherical(new three.Spherical(), true).radius,
    };
  }

  /** Where the middle of the free part of the canvas is, from that of the canvas. */
  #wantedShift(): { x: number; y: number } {
    const { left, right, top, bottom } = this.#insets;
    return { x: (left - right) / 2, y: (top - Math.min(bottom, this.#height - top - leastFree)) / 2 };
  }

  /** What comes onto the stage stands still: panels that come with it are known once the first frame is drawn. */
  get #isNew(): boolean {
    return this.#frames < 2;
  }

  /** Panels come and go at once; what is seen between them moves there. Answers whether it is still moving. */
  #ease(seconds: number): boolean {
    const shift = this.#shift;
    const wanted = this.#wantedShift();
    if (shift.x === wanted.x && shift.y === wanted.y) return false;
    const rest = this.reducedMotion || this.#isNew ? 0 : Math.exp((-2 * seconds) / quick);
    for (const axis of ['x', 'y'] as const) {
      const off = (shift[axis] - wanted[axis]) * rest;
      shift[axis] = wanted[axis] + (Math.abs(off) < 0.25 ? 0 : off);
    }
    this.#applyShift();
    return shift.x !== wanted.x || shift.y !== wanted.y;
  }

  #applyShift(): void {
    const { x, y } = this.#shift;
    this.camera.setViewOffset(this.#width, this.#height, -x, -y, this.#width, this.#height);
    this.camera.updateProjectionMatrix();
  }

  /** Tangents of the angles between the line of sight and the sides of the free part of the canvas, across and up. */
  #slopes(): [x: number, y: number] {
    const { left, right, top, bottom } = this.#insets;
    const half = Math.tan(three.MathUtils.degToRad(this.camera.fov / 2)) / this.#height; // `fov` spans the height
    return [
      half * Math.max(leastFree, this.#width - left - right),
      half * Math.max(leastFree, this.#height - top - bottom),
    ];
  }

  look(view: StandardView, animate: boolean): void {
    this.#controls.smoothTime = this.reducedMotion ? 0 : quick;
    const [azimuth, polar] = viewAngles[view];
    const turns = Math.round((this.#controls.azimuthAngle - azimuth) / (2 * Math.PI)); // the short way round
    void this.#controls.rotateTo(azimuth + turns * 2 * Math.PI, polar, animate);
  }

  /** By keyboard: radians about the model, or a factor of the distance. */
  turn(azimuth: number, polar: number): void {
    this.#controls.smoothTime = this.reducedMotion ? 0 : quick;
    void this.#controls.rotate(azimuth, polar, true);
  }
  zoom(factor: number): void {
    void this.#controls.dollyTo(this.#controls.distance * factor, true);
  }

  /** Radians about the vertical from in front of the model, and down from above it. */
  get angles(): { readonly azimuth: number; readonly polar: number } {
    return { azimuth: this.#controls.azimuthAngle, polar: this.#controls.polarAngle };
  }

  get pose(): CameraPose {
    const { x, y, z } = this.#controls.getTarget(new three.Vector3());
    const round = (value: number) => Math.round(value * 1e3) / 1e3;
    const { azimuthAngle, polarAngle, distance } = this.#controls;
    return [azimuthAngle, polarAngle, distance, x, y, z].map(round) as unknown as CameraPose;
  }
  set pose([azimuth, polar, distance, x, y, z]: CameraPose) {
    this.#framed = null;
    void this.#controls.moveTo(x, y, z, false);
    void this.#controls.rotateTo(azimuth, polar, false);
    void this.#controls.dollyTo(distance, false);
  }

  dispose(): void {
    this.#controls.dispose();
  }
}

const boxScratch = new three.Box3();
