// The three.js scene: a plank that leans on the ground, drawn whenever something changed.
import * as three from 'three';

export interface Stage {
  /** Turns the plank about its foot; radians from the ground. */
  setAngle(radians: number): void;
  dispose(): void;
}

/** @param canvas fills its parent; the stage follows its size and the system's light or dark. */
export function createStage(canvas: HTMLCanvasElement): Stage {
  const renderer = new three.WebGLRenderer({ canvas, antialias: true, alpha: true });
  renderer.shadowMap.enabled = true;
  const scene = new three.Scene();
  const camera = new three.PerspectiveCamera(35, 1, 0.1, 50);
  camera.position.set(1.9, 1.35, 3.2);
  camera.lookAt(0, 0.45, 0);

  const sun = new three.DirectionalLight(0xffffff, 2.4);
  sun.position.set(2, 4, 3);
  sun.castShadow = true;
  sun.shadow.mapSize.set(1024, 1024);
  sun.shadow.radius = 6;
  scene.add(sun, new three.HemisphereLight(0xffffff, 0x888880, 1.6));

  const ground = new three.Mesh(new three.PlaneGeometry(12, 12), new three.ShadowMaterial({ opacity: 0.22 }));
  ground.rotation.x = -Math.PI / 2;
  ground.receiveShadow = true;
  const plank = new three.Mesh(
    new three.BoxGeometry(1, 0.05, 0.28).translate(0.5, 0.025, 0),
    new three.MeshStandardMaterial({ color: 0xc8945c, roughness: 0.7 }),
  );
  plank.castShadow = true;
  plank.position.x = -0.5;
  scene.add(ground, plank);

  let frame = 0;
  const draw = () => {
    frame = 0;
    renderer.render(scene, camera);
  };
  const invalidate = () => {
    if (frame === 0) frame = requestAnimationFrame(draw);
  };
  const resize = () => {
    const { clientWidth: width, clientHeight: height } = canvas;
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(width, height, false);
    camera.aspect = width / Math.max(1, height);
    camera.updateProjectionMatrix();
    invalidate();
  };
  const observer = new ResizeObserver(resize);
  observer.observe(canvas);
  resize();

  return {
    setAngle(radians) {
      plank.rotation.z = radians;
      invalidate();
    },
    dispose() {
      observer.disconnect();
      cancelAnimationFrame(frame);
      renderer.dispose();
    },
  };
}
