// The meshes of a file that GLTFLoader has read, keyed as the core keys parts: by node and primitive. GLTFLoader renames
// nodes, so names cannot serve.
import * as three from 'three';
import type { GLTF } from 'three/examples/jsm/loaders/GLTFLoader.js';

export interface LoadedMesh {
  readonly mesh: three.Mesh;
  readonly node: number;
  readonly primitive: number;
}

export interface LoadedModel {
  readonly meshes: readonly LoadedMesh[];
  /** Lines and points: no parts, drawn as they are. */
  readonly rest: readonly three.Object3D[];
  dispose(): void;
}

export function collect(gltf: GLTF): LoadedModel {
  const meshes: LoadedMesh[] = [];
  const rest: three.Object3D[] = [];
  gltf.scene.updateMatrixWorld(true);
  gltf.scene.traverse((object) => {
    if (object instanceof three.Mesh) meshes.push({ mesh: object, ...keyOf(gltf, object) });
    else if (object instanceof three.Line || object instanceof three.Points) rest.push(object);
  });
  return {
    meshes,
    rest,
    dispose() {
      for (const { mesh } of meshes) disposeMesh(mesh);
      for (const object of rest) disposeMesh(object as three.Line);
    },
  };
}

/** The primitive stands on the mesh itself, the node on it or, when the node has several primitives, above it. */
function keyOf({ parser }: GLTF, mesh: three.Mesh): { node: number; primitive: number } {
  const primitive = parser.associations.get(mesh)?.primitives ?? 0;
  for (let object: three.Object3D | null = mesh; object !== null; object = object.parent) {
    const node = parser.associations.get(object)?.nodes;
    if (node !== undefined) return { node, primitive };
  }
  return { node: -1, primitive };
}

function disposeMesh(mesh: { geometry: three.BufferGeometry; material: three.Material | three.Material[] }): void {
  mesh.geometry.dispose();
  for (const material of [mesh.material].flat()) {
    for (const value of Object.values(material)) if (value instanceof three.Texture) value.dispose();
    material.dispose();
  }
}
