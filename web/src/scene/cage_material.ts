// Patches three's own materials, so that their vertices follow the cage: all maps, lights, shadows and transparency of
// the model stay as they are.
import * as three from 'three';

/** Vertex functions over `position` = local coordinates and `normal`, `tangent` in the local frame at rest. */
export const cageFunctions = /* glsl */ `
attribute float cageRow;
uniform highp sampler2D cageTexture;

vec3 cageCorner(int k) {
  return texelFetch(cageTexture, ivec2(k, int(cageRow + 0.5)), 0).xyz;
}

// Twice the Jacobian of the trilinear map in the columns; answers the point.
vec3 cageMap(vec3 local, out mat3 jacobian) {
  vec3 t = 0.5 * (local + 1.0);
  vec3 h0 = cageCorner(0), h1 = cageCorner(1), h2 = cageCorner(2), h3 = cageCorner(3);
  vec3 h4 = cageCorner(4), h5 = cageCorner(5), h6 = cageCorner(6), h7 = cageCorner(7);
  vec3 low0 = mix(h0, h1, t.x), low1 = mix(h2, h3, t.x), high0 = mix(h4, h5, t.x), high1 = mix(h6, h7, t.x);
  vec3 low = mix(low0, low1, t.y), high = mix(high0, high1, t.y);
  jacobian[0] = mix(mix(h1 - h0, h3 - h2, t.y), mix(h5 - h4, h7 - h6, t.y), t.z);
  jacobian[1] = mix(low1 - low0, high1 - high0, t.z);
  jacobian[2] = high - low;
  return mix(low, high, t.z);
}

vec3 cagePosition(vec3 local) {
  mat3 jacobian;
  return cageMap(local, jacobian);
}

// By the inverse transpose, here as the cofactors and the determinant's sign: exact for boxes of no thickness as well.
vec3 cageNormal(vec3 local, vec3 direction) {
  mat3 j;
  cageMap(local, j);
  vec3 c0 = cross(j[1], j[2]), c1 = cross(j[2], j[0]), c2 = cross(j[0], j[1]);
  vec3 n = c0 * direction.x + c1 * direction.y + c2 * direction.z;
  return normalize(dot(j[0], c0) < 0.0 ? -n : n);
}

vec3 cageTangent(vec3 local, vec3 direction) {
  mat3 j;
  cageMap(local, j);
  return normalize(j * direction);
}
`;

const beginNormal = /* glsl */ `
vec3 objectNormal = cageNormal(position, normal);
#ifdef USE_TANGENT
  vec3 objectTangent = cageTangent(position, tangent.xyz);
#endif
`;

const begin = /* glsl */ `
vec3 transformed = cagePosition(position);
#ifdef USE_ALPHAHASH
  vPosition = position;
#endif
`;

const passTint = /* glsl */ `
vCageTint = texelFetch(cageTexture, ivec2(8, int(cageRow + 0.5)), 0);
`;

/** Display colours, so behind tone mapping. */
const mixTint = /* glsl */ `
gl_FragColor.rgb = mix(gl_FragColor.rgb, vCageTint.rgb, vCageTint.a);
`;

export type CageUniform = { value: three.Texture };

/** Patches in place. The material must not be used for a mesh without cage afterwards. */
export function followCage(material: three.Material, uniform: CageUniform, tinted: boolean): void {
  material.onBeforeCompile = (shader) => {
    shader.uniforms.cageTexture = uniform;
    const varying = tinted ? 'varying vec4 vCageTint;\n' : '';
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>\n${cageFunctions}${varying}`)
      .replace('#include <beginnormal_vertex>', beginNormal)
      .replace('#include <begin_vertex>', tinted ? begin + passTint : begin);
    if (!tinted) return;
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>\n${varying}`)
      .replace('#include <colorspace_fragment>', `#include <colorspace_fragment>\n${mixTint}`);
  };
  // The functions above are equal for all materials, but not for both values of `tinted`.
  material.customProgramCacheKey = () => `cage ${tinted}`;
}

/** What all meshes cast into shadow maps; three copies alpha map, alpha test and sides over at every draw. */
export function depthMaterial(uniform: CageUniform): three.MeshDepthMaterial {
  const depth = new three.MeshDepthMaterial();
  followCage(depth, uniform, false);
  return depth;
}
