// The tree that a reader hands over as a GLB. By glTF-Transform, not three's GLTFExporter: that one draws every picture
// anew, so that each browser would write other bytes (and another hash) for the same file, and it wants a page around it.
import {
  Document,
  type Mesh,
  type Material as Painted,
  type Texture as Picture,
  type TypedArray,
  WebIO,
} from '@gltf-transform/core';
import { FormatError, type Model, type Node, type Primitive, type Surface, type Texture } from './model';

/** A quarter turn about x: z up becomes y up. */
const upright = [-Math.SQRT1_2, 0, 0, Math.SQRT1_2] as const;

/**
 * The same model gives the same bytes.
 * @param name of the scene and of the node that turns and scales to metres with y up, where one is needed
 */
export async function toGlb(model: Model, name: string): Promise<Uint8Array<ArrayBuffer>> {
  const document = new Document();
  document.getRoot().getAsset().generator = 'ParSEL'; // not the library with its version: it would be in the hash
  const buffer = document.createBuffer();
  const scene = document.createScene(name);
  document.getRoot().setDefaultScene(scene);

  const pictures = new Map<Texture, Picture>();
  const pictureOf = (texture: Texture) => {
    const known =
      pictures.get(texture) ??
      document.createTexture().setImage(new Uint8Array(texture.bytes)).setMimeType(texture.type);
    pictures.set(texture, known);
    return known;
  };
  const surfaces = new Map<Surface, Painted>();
  const paintedOf = (surface: Surface) => {
    const known = surfaces.get(surface);
    if (known !== undefined) return known;
    const made = document
      .createMaterial(surface.name)
      .setBaseColorFactor([...surface.color])
      .setEmissiveFactor([...surface.emissive])
      .setMetallicFactor(0)
      .setRoughnessFactor(surface.roughness)
      .setDoubleSided(true); // these formats leave it open which way triangles face
    if (surface.color[3] < 1) made.setAlphaMode('BLEND');
    if (surface.texture !== null) made.setBaseColorTexture(pictureOf(surface.texture));
    surfaces.set(surface, made);
    return made;
  };
  const meshes = new Map<readonly Primitive[], Mesh>();
  const meshOf = (primitives: readonly Primitive[]) => {
    const known = meshes.get(primitives);
    if (known !== undefined) return known;
    const mesh = document.createMesh();
    for (const { positions, indices, normals, uvs, colors, surface } of primitives) {
      const attribute = (array: Float32Array | Uint32Array, type: 'VEC2' | 'VEC3' | 'SCALAR') =>
        document
          .createAccessor()
          .setBuffer(buffer)
          .setType(type)
          .setArray(array as TypedArray);
      const made = document
        .createPrimitive()
        .setMaterial(paintedOf(surface))
        .setAttribute('POSITION', attribute(positions, 'VEC3'));
      if (indices !== null) made.setIndices(attribute(indices, 'SCALAR'));
      if (normals !== null) made.setAttribute('NORMAL', attribute(normals, 'VEC3'));
      if (uvs !== null) made.setAttribute('TEXCOORD_0', attribute(uvs, 'VEC2'));
      if (colors !== null) made.setAttribute('COLOR_0', attribute(colors, 'VEC3'));
      mesh.addPrimitive(made);
    }
    meshes.set(primitives, mesh);
    return mesh;
  };
  const nodeOf = (node: Node) => {
    const made = document.createNode(node.name);
    if (node.matrix !== null) made.setMatrix([...node.matrix] as Parameters<typeof made.setMatrix>[0]);
    if (node.mesh.length > 0) made.setMesh(meshOf(node.mesh));
    for (const child of node.children) made.addChild(nodeOf(child));
    return made;
  };
  const nodes = model.nodes.map(nodeOf);
  if (model.unit === 1 && !model.isZUp) for (const node of nodes) scene.addChild(node);
  else {
    const frame = document.createNode(name).setScale([model.unit, model.unit, model.unit]);
    if (model.isZUp) frame.setRotation([...upright]);
    for (const node of nodes) frame.addChild(node);
    scene.addChild(frame);
  }
  return (await new WebIO().writeBinary(document)) as Uint8Array<ArrayBuffer>;
}

/** @param limit bytes of corners. Throws a FormatError when there is more, no triangle, or a corner that is nowhere. */
export function refuseUnfit({ nodes }: Model, place: string, limit: number): void {
  const seen = new Set<readonly Primitive[]>();
  let bytes = 0;
  let triangles = 0;
  const visit = ({ mesh, children }: Node) => {
    if (!seen.has(mesh))
      for (const { positions, indices, normals, uvs, colors } of mesh) {
        for (const array of [positions, indices, normals, uvs, colors]) bytes += array?.byteLength ?? 0;
        triangles += (indices ?? positions).length;
        if (positions.every(Number.isFinite)) continue;
        throw new FormatError(`${place} is damaged: it has corners that are not at finite numbers. Export it again.`);
      }
    seen.add(mesh);
    for (const child of children) visit(child);
  };
  for (const node of nodes) visit(node);
  if (triangles === 0) throw new FormatError(`${place} holds no triangles. Export it again, with something selected.`);
  if (bytes > limit) {
    throw new FormatError(`${place} is too large as a GLB. Open a smaller model, or export it with fewer triangles.`);
  }
}
