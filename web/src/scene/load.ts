// Reads a glTF file into meshes that are keyed as the core keys parts: by node and primitive. GLTFLoader renames nodes,
// so names cannot serve.
import * as three from 'three';
import { type GLTF, GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

/** A model as it was opened: one file, and what it refers to. */
export interface ModelFiles {
  readonly name: string;
  readonly main: Uint8Array;
  /** Buffers and images of a .gltf by their path relative to it. */
  readonly external: ReadonlyMap<string, Uint8Array>;
  /** When the file came compressed: with what, and which extensions decompression lost. */
  readonly decompressed?: { readonly compression: string; readonly lost: readonly string[] };
  /** When the file was of another format: of which ("STL"), and what of it was left out or missing, in sentences. */
  readonly converted?: { readonly format: string; readonly remarks: readonly string[] };
}

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

/** Rejects with an Error whose message is one sentence for people. */
export async function loadModel(files: ModelFiles): Promise<LoadedModel> {
  const urls = new Map<string, string>();
  for (const [path, bytes] of files.external) urls.set(path, URL.createObjectURL(new Blob([bytes as BlobPart])));
  const manager = new three.LoadingManager();
  manager.setURLModifier((url) => urls.get(decodeURI(url)) ?? (/^(blob|data):/.test(url) ? url : 'data:,'));
  try {
    const bytes = files.main;
    const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) as ArrayBuffer;
    const gltf = await new GLTFLoader(manager).parseAsync(buffer, '');
    disarm(gltf.scene);
    return collect(gltf);
  } finally {
    for (const url of urls.values()) URL.revokeObjectURL(url);
  }
}

/** Sets of texture coordinates that three has attributes for: uv, uv1, uv2, uv3. */
const textureChannels = 4;

/**
 * Takes away what three would write into the source of shaders: names of materials, which may hold line breaks and
 * comments, and channels of textures, which may be anything. Nothing here is found by name.
 */
function disarm(scene: three.Object3D): void {
  scene.traverse((object) => {
    object.name = '';
    if (!('material' in object)) return;
    const { geometry, material } = object as three.Mesh;
    geometry.name = '';
    for (const one of [material].flat()) {
      one.name = '';
      for (const value of Object.values(one)) {
        if (!(value instanceof three.Texture)) continue;
        value.name = '';
        const { channel } = value;
        if (!Number.isInteger(channel) || channel < 0 || channel >= textureChannels) value.channel = 0;
      }
    }
  });
}

function collect(gltf: GLTF): LoadedModel {
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
