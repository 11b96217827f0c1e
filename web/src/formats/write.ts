// A GLB as a file of a format that people have: what came as OBJ or STL goes back into the program that it came from. Runs in a
// worker (worker/convert.worker.ts), and under Node.
import { type Document, Logger, Verbosity, WebIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { zipSync } from 'fflate';
import { FormatError, plainSurface } from './model';
import { readJson } from './read_gltf';
import { shownOf } from './shown';
import { writeObj } from './write_obj';
import { writeStl } from './write_stl';

/** Formats that are written, by the extension of their files. */
export type WrittenFormat = 'obj' | 'stl';

export interface Written {
  /** Of the file: the format's, or "zip" where it comes with others. */
  readonly extension: WrittenFormat | 'zip';
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** What the format has no place for, in sentences. */
  readonly remarks: readonly string[];
}

const known = new Set(ALL_EXTENSIONS.map(({ EXTENSION_NAME }) => EXTENSION_NAME));

/**
 * Every node with a mesh is an object under its name, where it stands in the scene.
 * @param glb uncompressed
 * @param name of the files, without extension
 * @param onProgress is told objects that are written, of all. Rejects with a FormatError where nothing is drawn.
 */
export async function written(
  glb: Uint8Array,
  format: WrittenFormat,
  name: string,
  onProgress: (done: number, total: number) => void = () => {},
): Promise<Written> {
  const io = new WebIO().setLogger(new Logger(Verbosity.SILENT)).registerExtensions(ALL_EXTENSIONS);
  const { json, resources } = await readJson({ main: glb, external: new Map() }, io);
  const required = (json.extensionsRequired ?? []).filter((extension) => known.has(extension));
  const document = await io.readJSON({ json: { ...json, extensionsRequired: required }, resources });
  const root = document.getRoot();
  const scene = root.getDefaultScene() ?? root.listScenes()[0];
  const nodes = [...shownOf(scene?.listChildren() ?? [])];
  if (nodes.every(({ primitives }) => primitives.every(({ triangles }) => triangles.length === 0)))
    throw new FormatError('There is no triangle to write. Show some of the parts first.');
  const onNode = (done: number) => onProgress(done, nodes.length);
  if (format === 'stl') {
    const { bytes, isMerged } = writeStl(nodes, onNode);
    const merged = isMerged ? ['So many triangles are one solid in an STL: its parts are not told apart.'] : [];
    return { extension: 'stl', bytes, remarks: [...merged, ...leftOut(document, format)] };
  }
  const files = writeObj(nodes, name, onNode);
  const remarks = leftOut(document, format);
  const [alone, ...others] = files.values();
  if (alone !== undefined && others.length === 0) return { extension: 'obj', bytes: alone, remarks };
  const epoch = new Date(1980, 0, 1); // the same model gives the same bytes
  const bytes = zipSync(Object.fromEntries(files), { level: 6, mtime: epoch }) as Uint8Array<ArrayBuffer>;
  return { extension: 'zip', bytes, remarks };
}

/** What the file has and the format has no place for, as one sentence or none. */
function leftOut(document: Document, format: WrittenFormat): string[] {
  const root = document.getRoot();
  const materials = root.listMaterials();
  const found: (readonly [string, boolean])[] = [
    ['animations', root.listAnimations().length > 0],
    ['skeletons', root.listSkins().length > 0],
    [
      'morph targets',
      root.listMeshes().some((mesh) => mesh.listPrimitives().some((one) => one.listTargets().length > 0)),
    ],
  ];
  if (format === 'stl') {
    const isPlain = (color: readonly number[]) =>
      color.every((value, i) => Math.abs(value - (plainSurface.color[i] ?? 0)) < 1e-6);
    const hasColors = root
      .listMeshes()
      .some((mesh) => mesh.listPrimitives().some((one) => one.getAttribute('COLOR_0')));
    const isPainted = materials.some((one) => one.getBaseColorTexture() !== null || !isPlain(one.getBaseColorFactor()));
    found.push(['colours and pictures', hasColors || isPainted]);
  } else {
    found.push(
      ['metal', materials.some((one) => one.getMetallicFactor() > 0 && one.getMetallicRoughnessTexture() === null)],
      ['maps of metal and roughness', materials.some((one) => one.getMetallicRoughnessTexture() !== null)],
      ['normal maps', materials.some((one) => one.getNormalTexture() !== null)],
      ['maps of shade and glow', materials.some((one) => one.getOcclusionTexture() ?? one.getEmissiveTexture())],
    );
  }
  const names = found.filter(([, has]) => has).map(([word]) => word);
  return names.length === 0
    ? []
    : [`Left out, since ${format.toUpperCase()} has no place for it: ${names.join(', ')}.`];
}
