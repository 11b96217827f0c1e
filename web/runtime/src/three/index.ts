// The entry `parsel-runtime/three`: a scene that GLTFLoader has read follows sliders where it stands.
//
// The same code as the page's (src/scene): corners go to a small texture, and the vertex shader does the rest. Each mesh of
// a part gets an empty geometry, and a twin draws it under the scene's root, so that the objects of the scene keep their
// names, places and children.
import * as three from 'three';
import type { GLTF } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { slidersInJson } from '../../../src/program/embedded';
import type { CageShape } from '../../../src/program/types';
import { collect, type LoadedMesh, type LoadedModel } from '../../../src/scene/meshes';
import { ModelView } from '../../../src/scene/model_view';
import { isLoaded } from '../embed';
import { ParselError, unwrap } from '../error';
import { compile, type Evaluate, type LoadedProgram, loadProgram, ofSliders } from '../program';
import { type SliderParameter, SliderValues } from '../values';
import { misfitOf } from './fit';
import { solidify } from './solid';

export { ParselError } from '../error';
export type { LoadedProgram } from '../program';
export type { SliderParameter } from '../values';

/** What attachSliders() needs of what GLTFLoader gives. */
export type LoadedGltf = Pick<GLTF, 'scene' | 'parser'>;

export interface AttachedSliders {
  readonly parameters: readonly SliderParameter[];
  /** Where the sliders stand, by name. */
  readonly values: Readonly<Record<string, number>>;
  /** What draws a mesh of the file now, by that mesh; its material is the mesh's own. */
  readonly drawn: ReadonlyMap<three.Mesh, three.Mesh>;
  /** Moves a slider; beyond its range it stops at the end. The next render shows it. Throws a ParselError. */
  set(name: string, value: number): void;
  /** Puts every slider where it stood in the program. */
  reset(): void;
  /** The scene as it was loaded. Materials and textures stay with the scene, whose they are. */
  dispose(): void;
}

/**
 * Lets a scene of GLTFLoader follow a program, in place. For WebGLRenderer. Skinned and instanced meshes, lines and points
 * stay as they are.
 * @param program `parsel/sliders` or `parsel/program` v1, what loadProgram() made of it, or left out: the one that the file
 * holds
 * @param shape `parsel/shape` v1, for a program that comes without
 * @throws ParselError when there is no program, it is damaged, or it was made on another model; the scene is untouched then
 */
export function attachSliders(gltf: LoadedGltf, program?: unknown, shape?: unknown): AttachedSliders {
  const loaded = programOf(gltf, program);
  const evaluate = compile(loaded, shape ?? loaded.shape);
  const model = collectParts(gltf, evaluate.shape);
  const view = new ModelView(evaluate.shape, model.loaded);
  const fault = misfitOf(view, evaluate.shape);
  if (fault !== null) {
    view.dispose();
    model.restore();
    throw fault;
  }
  return new Attached(gltf.scene, loaded, evaluate, view, model);
}

function programOf({ parser }: LoadedGltf, program: unknown): LoadedProgram {
  if (program !== undefined && program !== null) return isLoaded(program) ? program : loadProgram(program);
  const read = unwrap(slidersInJson(parser.json as { extras?: unknown }));
  if (read !== null) return ofSliders(read);
  throw new ParselError({
    stage: 'runtime/attach',
    place: '/extras/parsel',
    cause: 'the file holds no program',
    fix: 'give one as the second argument, or export “Model with sliders”',
  });
}

interface PartMeshes {
  /** As ModelView takes them: placed in the frame of the scene's root. */
  readonly loaded: LoadedModel;
  /** The mesh of the file behind each of them. */
  readonly originals: readonly three.Mesh[];
  /** Takes back what following the cage did to materials. */
  restore(): void;
}

/** The meshes of the file that are parts of a shape. */
function collectParts({ scene, parser }: LoadedGltf, shape: CageShape): PartMeshes {
  const all = collect({ scene, parser } as GLTF);
  const toRoot = scene.matrixWorld.clone().invert();
  const parts = new Set(shape.parts.map(({ node, primitive }) => `${node}/${primitive}`));
  const isPart = ({ mesh, node, primitive }: LoadedMesh) =>
    parts.has(`${node}/${primitive}`) && !(mesh instanceof three.SkinnedMesh || mesh instanceof three.InstancedMesh);
  const own = all.meshes.filter(isPart);
  const strangers = [...all.meshes.filter((one) => !isPart(one)).map(({ mesh }) => mesh), ...all.rest];
  const shared = new Set(strangers.flatMap((object) => (object as three.Mesh).material));
  const copies = new Map<three.Material, three.Material>();
  const before: (() => void)[] = [];
  /** The material itself; a copy where something else is drawn with it that has no cage. */
  const takeOver = (material: three.Material): three.Material => {
    const known = copies.get(material);
    if (known !== undefined) return known;
    const taken = shared.has(material) ? material.clone() : material;
    copies.set(material, taken);
    const { onBeforeCompile, customProgramCacheKey } = material;
    before.push(() => {
      if (taken !== material) return taken.dispose();
      Object.assign(material, { onBeforeCompile, customProgramCacheKey });
      material.needsUpdate = true;
    });
    taken.needsUpdate = true; // it may have been drawn before
    return taken;
  };
  const meshes = own.map(({ mesh, node, primitive }): LoadedMesh => {
    const { material } = mesh;
    const placed = new three.Mesh(mesh.geometry, Array.isArray(material) ? material.map(takeOver) : takeOver(material));
    placed.matrixWorld.multiplyMatrices(toRoot, mesh.matrixWorld);
    return { mesh: placed, node, primitive };
  });
  return {
    loaded: { meshes, rest: [], dispose() {} }, // it is the scene's
    originals: own.map(({ mesh }) => mesh),
    restore() {
      for (const undo of before) undo();
    },
  };
}

class Attached implements AttachedSliders {
  readonly drawn: ReadonlyMap<three.Mesh, three.Mesh>;
  readonly #root = new three.Group();
  readonly #values: SliderValues;
  readonly #undo: (() => void)[] = [];

  constructor(
    scene: three.Object3D,
    private readonly program: LoadedProgram,
    private readonly evaluate: Evaluate,
    private readonly view: ModelView,
    model: PartMeshes,
  ) {
    const { shape } = evaluate;
    const { centre, scale } = shape.frame;
    this.#values = new SliderValues(program.parameters);
    this.#root.matrix.makeScale(scale, scale, scale).setPosition(...centre);
    this.#root.matrixAutoUpdate = false;
    this.#root.add(view.root);
    const originals = new Map(model.loaded.meshes.map(({ node, primitive }, i) => [`${node}/${primitive}`, i]));
    const drawn = new Map<three.Mesh, three.Mesh>();
    for (const [i, part] of shape.parts.entries()) {
      const twin = view.meshOf(i);
      const original = model.originals[originals.get(`${part.node}/${part.primitive}`) ?? -1];
      if (twin === null || original === undefined) continue;
      drawn.set(original, twin);
      this.#undo.push(replace(original, twin));
      solidify(twin, original, view.cage);
    }
    for (const [i, part] of shape.parts.entries()) if (program.hidden.includes(part.id)) view.setHidden(i, true);
    this.drawn = drawn;
    scene.add(this.#root);
    this.#undo.push(
      () => model.restore(),
      () => this.#root.removeFromParent(),
    );
    this.#show();
  }

  get parameters(): readonly SliderParameter[] {
    return this.program.parameters;
  }

  get values(): Readonly<Record<string, number>> {
    return this.#values.byName;
  }

  set(name: string, value: number): void {
    if (this.#values.set(name, value)) this.#show();
  }

  reset(): void {
    this.#values.reset();
    this.#show();
  }

  dispose(): void {
    for (const undo of this.#undo.splice(0)) undo();
    this.view.dispose();
  }

  #show(): void {
    const corners = this.evaluate(this.#values.list);
    this.view.update({ corners, groups: this.evaluate.groups });
    for (const twin of this.drawn.values()) twin.geometry.boundingBox = twin.geometry.boundingSphere = null;
  }
}

const nothing = new three.BufferGeometry();

/** A twin takes over what a mesh of the file draws; answers how to take that back. */
function replace(original: three.Mesh, twin: three.Mesh): () => void {
  const { geometry } = original;
  const { name, userData, castShadow, receiveShadow, renderOrder, visible } = original;
  Object.assign(twin, { name, userData, castShadow, receiveShadow, renderOrder, visible });
  twin.layers.mask = original.layers.mask;
  original.geometry = nothing;
  return () => {
    original.geometry = geometry;
  };
}
