// Reads back what the graphics card makes of the cage: every vertex of a part becomes one pixel of a float texture. Only
// for tests and the console; the page never waits for the card.
import * as three from 'three';
import { cageFunctions } from './cage_material';
import type { ModelView } from './model_view';

const width = 512; // pixels

const vertexShader = /* glsl */ `
${cageFunctions}
uniform vec2 size;
uniform int vertices;
uniform bool wantsNormals;
flat varying vec3 vValue;
void main() {
  vValue = wantsNormals ? cageNormal(position, normal) : cagePosition(position);
  int i = gl_InstanceID * vertices + gl_VertexID;
  vec2 pixel = vec2(i % ${width}, i / ${width}) + 0.5;
  gl_Position = vec4(2.0 * pixel / size - 1.0, 0.0, 1.0);
  gl_PointSize = 1.0;
}
`;
const fragmentShader = /* glsl */ `
flat varying vec3 vValue;
void main() {
  gl_FragColor = vec4(vValue, 1.0);
}
`;

/**
 * Positions or normals of a part's vertices in the normalised frame, three numbers each, instance after instance; in the
 * order of the file's own vertices.
 */
export function readVertices(
  renderer: three.WebGLRenderer,
  view: ModelView,
  part: number,
  what: 'positions' | 'normals',
): Float32Array {
  const source = view.meshOf(part)?.geometry;
  if (source === undefined) return new Float32Array(0);
  const vertices = source.getAttribute('position').count;
  const total = vertices * source.instanceCount;
  const height = Math.ceil(total / width);
  const geometry = source.clone();
  geometry.setIndex(null);
  geometry.instanceCount = source.instanceCount;
  const material = new three.ShaderMaterial({
    vertexShader,
    fragmentShader,
    blending: three.NoBlending,
    depthTest: false,
    uniforms: {
      cageTexture: view.cage.uniform,
      size: { value: new three.Vector2(width, height) },
      vertices: { value: vertices },
      wantsNormals: { value: what === 'normals' },
    },
  });
  const points = new three.Points(geometry, material);
  points.frustumCulled = false;
  const target = new three.WebGLRenderTarget(width, height, { type: three.FloatType, depthBuffer: false });
  renderer.setRenderTarget(target);
  renderer.render(points, new three.Camera());
  const pixels = new Float32Array(width * height * 4);
  renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
  renderer.setRenderTarget(null);
  for (const resource of [geometry, material, target]) resource.dispose();
  const found = new Float32Array(total * 3);
  for (let i = 0; i < total; i++) found.set(pixels.subarray(i * 4, i * 4 + 3), i * 3);
  return found;
}
