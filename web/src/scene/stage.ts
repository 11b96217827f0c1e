// The scene around the model: light, ground, camera, overlays; drawn when something has changed, and only then.
import * as three from 'three';
import { RoomEnvironment } from 'three/examples/jsm/environments/RoomEnvironment.js';
import type { CageShape, Vec3 } from '../program/types';
import { CameraRig, type Insets } from './camera';
import { distanceAlong } from './drag';
import { explode, type State } from './explode';
import type { LoadedModel } from './meshes';
import { ModelView, noTint } from './model_view';
import { Overlays, type Sheet } from './overlays';
import { type Hit, Picker } from './picking';
import { boundsOfAll, type Picture, type Projection, pictureCamera, shoot } from './pictures';

/** A model on the stage. */
export interface Actor {
  readonly view: ModelView;
  readonly overlays: Overlays;
}

export class Stage {
  readonly rig: CameraRig;
  readonly #renderer: three.WebGLRenderer;
  readonly #scene = new three.Scene();
  readonly #sun = new three.DirectionalLight(0xffffff, 1.9);
  readonly #ground: three.Mesh;
  readonly #picker: Picker;
  readonly #observer: ResizeObserver;
  readonly #clock = new three.Timer();
  #insets: Insets = { left: 0, right: 0, top: 0, bottom: 0 };
  #frame = 0;
  #hasMetal = false;
  #room: three.Texture | null = null;
  /** A model was shown, and only its own shaders are compiled. */
  #isCold = false;
  #actor: Actor | null = null;
  #state: State | null = null;
  /** As drawn: other than #state in the exploded view. */
  #drawn: State | null = null;
  #apart = 0;
  /** Bounds of the whole when it was brought into view. */
  readonly #fitted = new three.Box3();
  #accent = '#2361cf';
  #quiet = '#5a5f66';
  /** Reports the loss of the graphics context, and that it is back. */
  onContext: (lost: boolean) => void = () => {};
  /** Called after every frame: what is laid over the canvas. */
  readonly drawn = new Set<() => void>();

  /** @param canvas fills its parent; the stage follows its size. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    reducedMotion: boolean,
  ) {
    const renderer = new three.WebGLRenderer({ canvas, antialias: true, alpha: true });
    renderer.setClearColor(0, 0);
    renderer.toneMapping = three.NeutralToneMapping;
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = three.PCFShadowMap;
    this.#renderer = renderer;
    this.#picker = new Picker(renderer);
    this.rig = new CameraRig(canvas, reducedMotion);
    this.rig.onChange(() => this.invalidate());

    const sun = this.#sun;
    sun.position.set(1.6, 3.4, 2.2);
    sun.castShadow = true;
    sun.shadow.mapSize.set(1024, 1024);
    sun.shadow.radius = 5;
    sun.shadow.bias = -0.0004;
    sun.shadow.normalBias = 0.01;
    this.#ground = new three.Mesh(new three.CircleGeometry(8, 48), new three.ShadowMaterial({ opacity: 0.2 }));
    this.#ground.rotation.x = -Math.PI / 2;
    this.#ground.receiveShadow = true;
    const fill = new three.DirectionalLight(0xffffff, 0.5);
    fill.position.set(-2.5, 1.2, 1.5);
    this.#scene.add(sun, sun.target, fill, new three.HemisphereLight(0xffffff, 0xa8a49c, 1.7), this.#ground);

    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault(); // else it never comes back
      this.onContext(true);
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.#room = null; // it was lost as well
      this.#reflect();
      this.onContext(false);
      this.invalidate();
    });
    this.#observer = new ResizeObserver(() => this.#resize());
    this.#observer.observe(canvas);
    this.#resize();
  }

  /** Puts a model on the stage in place of the last one, which is disposed of. */
  show(loaded: LoadedModel, shape: CageShape): Actor {
    this.clear();
    const actor = { view: new ModelView(shape, loaded), overlays: new Overlays(shape) };
    actor.overlays.setColours({ accent: this.#accent, quiet: this.#quiet });
    this.#scene.add(actor.view.root, actor.view.extras, actor.overlays.root);
    this.#actor = actor;
    this.#isCold = true;
    const materials = loaded.meshes.flatMap(({ mesh }) => mesh.material);
    const isMetal = (material: three.Material) => (material as three.MeshStandardMaterial).metalness > 0.1;
    this.#hasMetal = materials.some(isMetal);
    this.#reflect();
    return actor;
  }

  clear(): void {
    if (this.#actor === null) return;
    const { view, overlays } = this.#actor;
    this.#scene.remove(view.root, view.extras, overlays.root);
    view.dispose();
    overlays.dispose();
    this.#actor = null;
    this.#state = this.#drawn = null;
    this.invalidate();
  }

  /** Whether a model has been drawn. */
  isShown(): boolean {
    return this.#actor !== null && this.#renderer.info.render.frame > 0;
  }

  /** Whether all that has changed has been drawn. */
  isStill(): boolean {
    return this.#frame === 0;
  }

  /** One step of a slider: corners are uploaded, nothing else. */
  update(state: State): void {
    if (this.#actor === null) return;
    const { view, overlays } = this.#actor;
    this.#state = state;
    const drawn = this.#apart === 0 ? state : explode(view.shape, state, this.#apart);
    this.#drawn = drawn;
    view.update(drawn);
    overlays.update(drawn.corners);
    const bounds = shapeBounds(view.shape, drawn);
    this.#ground.position.y = bounds.min.y;
    // In steps, so that the shadow's grain stays while a slider moves a little.
    const reach = 2 ** (Math.ceil(2 * Math.log2(bounds.getBoundingSphere(sphere).radius * 1.2)) / 2);
    const { camera } = this.#sun.shadow;
    if (reach !== camera.right) {
      Object.assign(camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1, far: 12 });
      camera.updateProjectionMatrix();
    }
    this.invalidate();
  }

  /** How far the parts stand apart, 0 … 1: see explode(). */
  setApart(amount: number): void {
    this.#apart = amount;
    if (this.#state) this.update(this.#state);
  }

  /** Corners of all parts as they are drawn, part × 24; empty before anything is. */
  get corners(): Float64Array {
    return this.#drawn?.corners ?? nothing;
  }

  /** Brings the model, or one part, into view. */
  fit(part: number | null, animate = true): void {
    if (this.#actor === null || this.#drawn === null) return;
    const { shape } = this.#actor.view;
    const box = part === null ? shapeBounds(shape, this.#drawn) : partBounds(this.#drawn.corners, part);
    const bounds = box.getBoundingSphere(new three.Sphere());
    if (part !== null) bounds.radius = Math.max(bounds.radius * 2, 0.2);
    if (part === null) this.#fitted.copy(box);
    this.rig.fit(bounds, animate, part === null);
  }

  /** Keeps the whole in view while it changes, unless a person has moved the camera. */
  keepInView(): void {
    if (this.#actor !== null && this.#drawn !== null)
      this.rig.keepFramed(this.#fitted, shapeBounds(this.#actor.view.shape, this.#drawn));
  }

  /** @param x,y CSS pixels in the window */
  async pick(x: number, y: number): Promise<Hit | null> {
    const actor = this.#actor;
    if (actor === null || this.#renderer.getContext().isContextLost()) return null;
    const { left, top } = this.canvas.getBoundingClientRect();
    const hit = await this.#picker.pick(this.rig.camera, actor.view, x - left, y - top);
    return this.#actor === actor ? hit : null;
  }

  /** Where the mean of some points of the shape is on screen, CSS pixels in the window. */
  projectMean(points: ArrayLike<number>): { x: number; y: number } {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const { x, y } = meanOf(points).project(this.rig.camera);
    return { x: left + ((x + 1) / 2) * width, y: top + ((1 - y) / 2) * height };
  }

  /** How far along an axis through a point of the shape the pointer is, in the normalised frame. */
  distanceAlong(from: Vec3, axis: Vec3, x: number, y: number): number {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const at = new three.Vector2((2 * (x - left)) / width - 1, 1 - (2 * (y - top)) / height);
    return distanceAlong(this.rig.camera, at, new three.Vector3(...from), new three.Vector3(...axis));
  }

  /** Whether the camera sees the front of a plane through a point. */
  isFacing(point: Vec3, normal: Vec3): boolean {
    return (
      corner
        .set(...point)
        .sub(this.rig.camera.position)
        .dot(new three.Vector3(...normal)) < 0
    );
  }

  /** Shows the line along which something is pulled. */
  guide(line: { readonly from: Vec3; readonly axis: Vec3 } | null): void {
    this.#actor?.overlays.guide(line);
    this.invalidate();
  }

  /** Shows a ruler between points of the normalised frame; null takes it away. */
  showRuler(points: readonly Vec3[] | null): void {
    this.#actor?.overlays.ruler(points ?? []);
    this.invalidate();
  }

  /** Shows a plane that something is to be cut by. */
  showSheet(plane: Sheet | null): void {
    this.#actor?.overlays.sheet(plane);
    this.invalidate();
  }

  setInsets(insets: Insets): void {
    this.#insets = insets;
    this.#resize();
  }

  setTheme({ accent, quiet, dark }: { accent: string; quiet: string; dark: boolean }): void {
    this.#accent = accent;
    this.#quiet = quiet;
    this.#actor?.overlays.setColours({ accent, quiet });
    (this.#ground.material as three.ShadowMaterial).opacity = dark ? 0.5 : 0.22;
    this.invalidate();
  }

  /** The picture without overlays, on a transparent ground. */
  async screenshot(): Promise<Blob> {
    const overlays = this.#actor?.overlays.root;
    if (overlays) overlays.visible = false;
    this.#renderer.render(this.#scene, this.rig.camera);
    if (overlays) overlays.visible = true;
    this.invalidate();
    return new Promise((resolve, reject) =>
      this.canvas.toBlob(
        (blob) => (blob ? resolve(blob) : reject(new Error('the browser made no picture'))),
        'image/png',
      ),
    );
  }

  /**
   * Draws other states of the model, all seen alike, and then the present one again. Null while there is nothing to draw.
   * @param framing states that fit into the pictures together
   */
  paint(
    pictures: readonly Picture[],
    framing: readonly State[] = pictures.map(({ state }) => state),
  ): Projection | null {
    const [actor, state, apart, [first]] = [this.#actor, this.#state, this.#apart, pictures];
    if (actor === null || state === null || first === undefined || this.#renderer.getContext().isContextLost())
      return null;
    const { view, overlays } = actor;
    const { width, height } = first.canvas;
    const camera = pictureCamera(boundsOfAll(view.shape, framing, shapeBounds), width / height);
    const tints = view.shape.parts.map((_, part) => view.tintOf(part));
    overlays.root.visible = false;
    this.#apart = 0;
    for (const picture of pictures) {
      this.update(picture.state);
      for (const part of tints.keys()) view.setTint(part, picture.tints?.get(part) ?? noTint);
      shoot(this.#renderer, this.#scene, camera, picture.canvas);
    }
    for (const [part, tint] of tints.entries()) view.setTint(part, tint);
    overlays.root.visible = true;
    this.#apart = apart;
    this.update(state);
    this.#renderer.render(this.#scene, this.rig.camera);
    return (points) => {
      const { x, y } = meanOf(points).project(camera);
      return { x: (x + 1) / 2, y: (1 - y) / 2 };
    };
  }

  /** For tests: which vertices of a part are corners of which triangle. */
  trianglesOf(part: number): number[] {
    const index = this.#actor?.view.meshOf(part)?.geometry.index;
    return index ? [...index.array] : [];
  }

  /** For tests: what the graphics card makes of a part. See readback.ts. */
  async readVertices(part: number, what: 'positions' | 'normals'): Promise<Float32Array> {
    const { readVertices } = await import('./readback');
    return this.#actor === null ? new Float32Array(0) : readVertices(this.#renderer, this.#actor.view, part, what);
  }

  /** Draws at the next frame. */
  invalidate(): void {
    if (this.#frame === 0) this.#frame = requestAnimationFrame(this.#draw);
  }

  dispose(): void {
    this.#observer.disconnect();
    cancelAnimationFrame(this.#frame);
    this.clear();
    this.#picker.dispose();
    this.rig.dispose();
    this.#renderer.dispose();
  }

  readonly #draw = (time: number) => {
    this.#frame = 0;
    this.#clock.update(time);
    const moving = this.rig.update(Math.min(this.#clock.getDelta(), 0.1));
    this.#renderer.render(this.#scene, this.rig.camera);
    for (const listener of this.drawn) listener();
    if (moving) this.invalidate();
    if (this.#isCold) void this.#warmUp();
  };

  /** What is drawn later, over the model or to pick, has its shaders compiled before anybody waits for them. */
  async #warmUp(): Promise<void> {
    this.#isCold = false;
    const actor = this.#actor;
    if (actor === null) return;
    void this.#renderer.compileAsync(this.#scene, this.rig.camera);
    await this.#picker.warmUp(actor.view);
    // What a shader is asked on its first use takes a while as well.
    const idle = globalThis.requestIdleCallback ?? ((act: () => void) => setTimeout(act, 200));
    idle(() => void (this.#actor === actor && this.pick(0, 0)));
  }

  /** A room for metals to mirror. Filtering it takes a software renderer seconds, so only models with metal get it, whatever was shown before. */
  #reflect(): void {
    if (this.#hasMetal && this.#room === null) {
      const generator = new three.PMREMGenerator(this.#renderer);
      this.#room = generator.fromScene(new RoomEnvironment(), 0.04, 0.1, 100, { size: 64 }).texture;
      generator.dispose();
    }
    this.#scene.environment = this.#hasMetal ? this.#room : null;
    this.#scene.environmentIntensity = 0.35;
  }

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#renderer.setSize(width, height, false);
    this.rig.resize(width, height, this.#insets);
    this.invalidate();
  }
}

const sphere = new three.Sphere();
const corner = new three.Vector3();
const shapeBox = new three.Box3();
const nothing = new Float64Array(0);

function meanOf(points: ArrayLike<number>): three.Vector3 {
  const mean = new three.Vector3();
  const count = points.length / 3;
  for (let i = 0; i < count; i++) mean.add(corner.fromArray(points, 3 * i));
  return mean.divideScalar(count);
}

/** Of all real parts and all instances. The box is reused by the next call. */
export function shapeBounds(shape: CageShape, { corners, groups }: State): three.Box3 {
  shapeBox.makeEmpty();
  for (let part = 0; part < shape.parts.length; part++) {
    if (!shape.parts[part]?.virtual) expand(shapeBox, corners, part);
  }
  for (const group of groups) {
    for (let i = 0; i < (group?.count ?? 0); i++) expand(shapeBox, group?.instances ?? [], i);
  }
  return shapeBox;
}

export function partBounds(corners: ArrayLike<number>, part: number): three.Box3 {
  return expand(new three.Box3(), corners, part);
}

function expand(box: three.Box3, corners: ArrayLike<number>, part: number): three.Box3 {
  for (let at = part * 24; at < part * 24 + 24; at += 3) {
    box.expandByPoint(corner.set(corners[at] as number, corners[at + 1] as number, corners[at + 2] as number));
  }
  return box;
}
