// A small picture of a model as it is in its file.
import * as three from 'three';
import type { LoadedModel } from './load';

export class ThumbnailPainter {
  readonly #renderer: three.WebGLRenderer;
  readonly #scene = new three.Scene();
  readonly #camera: three.PerspectiveCamera;

  /** @param width,height in pixels */
  constructor(width: number, height: number) {
    this.#renderer = new three.WebGLRenderer({ antialias: true, alpha: true });
    this.#renderer.setSize(width, height, false);
    this.#renderer.toneMapping = three.NeutralToneMapping;
    this.#camera = new three.PerspectiveCamera(25, width / height, 0.05, 100);
    const sun = new three.DirectionalLight(0xffffff, 2.6);
    sun.position.set(1.6, 3.4, 2.2);
    this.#scene.add(sun, new three.HemisphereLight(0xffffff, 0x9a9a94, 2));
  }

  async paint({ meshes }: LoadedModel): Promise<Blob> {
    const group = new three.Group();
    for (const { mesh } of meshes) {
      const copy = new three.Mesh(mesh.geometry, mesh.material);
      copy.matrixAutoUpdate = false;
      copy.matrix.copy(mesh.matrixWorld);
      group.add(copy);
    }
    this.#scene.add(group);
    group.updateMatrixWorld(true);
    const { center, radius } = new three.Box3().setFromObject(group).getBoundingSphere(new three.Sphere());
    const distance = radius / Math.sin(three.MathUtils.degToRad(this.#camera.fov / 2));
    this.#camera.position.setFromSphericalCoords(distance, 1.2, 0.55).add(center);
    this.#camera.near = distance / 50;
    this.#camera.far = distance * 3;
    this.#camera.updateProjectionMatrix();
    this.#camera.lookAt(center);
    this.#renderer.render(this.#scene, this.#camera);
    this.#scene.remove(group);
    return new Promise((resolve, reject) =>
      this.#renderer.domElement.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('no picture')))),
    );
  }

  dispose(): void {
    this.#renderer.dispose();
    this.#renderer.forceContextLoss(); // browsers keep few contexts: give this one back now
  }
}
