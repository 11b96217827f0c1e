// Reads a glTF file into meshes that are keyed as the core keys parts (meshes.ts).
import * as three from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import type { CarveStep } from '../carve/steps';
import { collect, type LoadedModel } from './meshes';

export type { LoadedModel } from './meshes';

/** How parts are told apart: see SplitMethod in core/split/split.h. */
export type SplitBy = 'auto' | 'components' | 'materials' | 'regions';

/** A model as it was opened: one file, and what it refers to. */
export interface ModelFiles {
  readonly name: string;
  readonly main: Uint8Array;
  /** Buffers and images of a .gltf by their path relative to it. */
  readonly external: ReadonlyMap<string, Uint8Array>;
  /** When the file came compressed: with what, and which extensions decompression lost. */
  readonly decompressed?: { readonly compression: string; readonly lost: readonly string[] };
  /** When its parts were told apart here: what it was, and how that was done. */
  readonly split?: { readonly from: ModelFiles; readonly by: SplitBy; readonly fine: number };
  /** When parts were joined, split or cut by hand: what it was, and the steps in order. */
  readonly carved?: { readonly from: ModelFiles; readonly steps: readonly CarveStep[] };
  /** When the file was of another format: of which ("STL"), and what of it was left out or missing, in sentences. */
  readonly converted?: { readonly format: string; readonly remarks: readonly string[] };
  /** When the file is what a CAD program makes: the program, as plain data. */
  readonly cad?: CadSource;
}

/** A CAD program that a model was made by, as the core read it. */
export interface CadSource {
  /** `parsel/cad` v1. */
  readonly program: unknown;
  /** `parsel/variations` v1 that came with it; null: none. */
  readonly variations: unknown;
  readonly parts: readonly CadPart[];
  /** What was not read as it was meant, in sentences. */
  readonly remarks: readonly string[];
  /** It stands for the hexahedra of a file that no program made: ids are partKey(). */
  readonly of?: 'hexahedra';
}

export interface CadPart {
  readonly id: string;
  readonly name: string;
  /** Shared by parts that belong together: "leg". */
  readonly stem: string;
  /** Whether it adds material; of these part i is node i of the file. */
  readonly role: 'add' | 'cut' | 'meet';
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
