// Which part is under the pointer, and where in its hexahedron: the model is drawn once more into a single pixel whose
// colour is the cage's row and the local coordinates of the point. So picking sees exactly what is drawn, deformed and
// with all its instances, at the price of one small draw.
//
// Rejected: a tree over triangles on the processor (three-mesh-bvh 0.9.17). On shelf_ivar_0678, 257,240 triangles, a cast
// takes no time worth measuring, but building takes 150 ms at opening, and every pick after a step of a slider would
// first deform all vertices there (18 ms) and refit the trees (17 ms); best of seven under Node.js 20.
// Where the processor draws (SwiftShader, two busy cores) the draw below takes 145 ms on that model; nothing waits for it:
// the pixel is read when it is there.
import * as three from 'three';
import type { Vec3 } from '../program/types';
import { cageFunctions } from './cage_material';
import type { ModelView } from './model_view';

export interface Hit {
  readonly part: number;
  /** In the part's hexahedron, −1 … 1. */
  readonly local: Vec3;
}

const vertexShader = /* glsl */ `
${cageFunctions}
varying vec3 vLocal;
flat varying float vRow;
void main() {
  vLocal = position;
  vRow = cageRow;
  gl_Position = projectionMatrix * viewMatrix * vec4(cagePosition(position), 1.0);
}
`;

const fragmentShader = /* glsl */ `
varying vec3 vLocal;
flat varying float vRow;
void main() {
  gl_FragColor = vec4(vRow + 1.0, vLocal);
}
`;

export class Picker {
  readonly #target = new three.WebGLRenderTarget(1, 1, { type: three.FloatType });
  readonly #camera = new three.PerspectiveCamera();
  readonly #material = new three.ShaderMaterial({
    vertexShader,
    fragmentShader,
    uniforms: { cageTexture: { value: null } },
    side: three.DoubleSide,
    blending: three.NoBlending,
    toneMapped: false,
  });

  constructor(private readonly renderer: three.WebGLRenderer) {}

  /** Has the shader compiled, and resolves when that is done. */
  async warmUp(view: ModelView): Promise<void> {
    const like = view.root.children.find((child) => child instanceof three.Mesh);
    if (like === undefined) return;
    this.renderer.setRenderTarget(this.#target); // shaders differ by what they draw into
    const ready = this.renderer.compileAsync(
      new three.Mesh((like as three.Mesh).geometry, this.#material),
      this.#camera,
    );
    this.renderer.setRenderTarget(null);
    await ready;
  }

  /** @param x,y in CSS pixels from the canvas' upper left corner. */
  async pick(camera: three.PerspectiveCamera, view: ModelView, x: number, y: number): Promise<Hit | null> {
    const { renderer } = this;
    const { clientWidth: width, clientHeight: height } = renderer.domElement;
    const shift = camera.view?.enabled ? camera.view : null;
    this.#camera.copy(camera, false);
    this.#camera.setViewOffset(width, height, (shift?.offsetX ?? 0) + x, (shift?.offsetY ?? 0) + y, 1, 1);
    this.#camera.updateMatrixWorld();

    this.#material.uniforms.cageTexture = view.cage.uniform;
    view.root.overrideMaterial = this.#material;
    renderer.setRenderTarget(this.#target); // its clear colour is the renderer's: transparent black, so row 0
    renderer.render(view.root, this.#camera);
    const pixel = new Float32Array(4);
    const reading = renderer.readRenderTargetPixelsAsync(this.#target, 0, 0, 1, 1, pixel);
    renderer.setRenderTarget(null);
    view.root.overrideMaterial = null;
    await reading;

    const [row = 0, u = 0, v = 0, w = 0] = pixel;
    if (row < 1) return null;
    const part = view.partOfRow(Math.round(row) - 1);
    return part < 0 ? null : { part, local: [u, v, w] };
  }

  dispose(): void {
    this.#target.dispose();
    this.#material.dispose();
  }
}
