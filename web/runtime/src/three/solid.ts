// What the processor is asked about a mesh that the graphics card deforms: its bounds, and what a ray hits. Computed when
// asked for, from the corners that the card has.
import * as three from 'three';
import { type CageTexture, trilinear } from '../../../src/scene/cage';

type Twin = three.Mesh<three.InstancedBufferGeometry>;

/**
 * Gives a mesh bounds and hits of its deformed state, which forgets them by setting `boundingBox` to null.
 * @param original what hits name as their object
 */
export function solidify(twin: Twin, original: three.Mesh, cage: CageTexture): void {
  const { geometry } = twin;
  geometry.computeBoundingBox = () => {
    geometry.boundingBox = boundsOf(geometry, cage);
  };
  geometry.computeBoundingSphere = () => {
    geometry.boundingSphere = boundsOf(geometry, cage).getBoundingSphere(new three.Sphere());
  };
  const solid = new three.Mesh(new three.BufferGeometry(), twin.material);
  let shown: three.Box3 | null = null;
  twin.raycast = (raycaster, hits) => {
    if (geometry.boundingBox === null) geometry.computeBoundingBox();
    if (shown !== geometry.boundingBox) {
      shown = geometry.boundingBox;
      deform(geometry, cage, solid.geometry);
    }
    solid.material = twin.material;
    solid.matrixWorld.copy(twin.matrixWorld);
    const own: three.Intersection[] = [];
    solid.raycast(raycaster, own);
    for (const hit of own) hits.push({ ...hit, object: original });
  };
}

const row = new Float64Array(24);
const point = new three.Vector3();

/** Of the hexahedra, in which the mesh lies. */
function boundsOf(geometry: three.InstancedBufferGeometry, cage: CageTexture): three.Box3 {
  const box = new three.Box3();
  const rows = geometry.getAttribute('cageRow');
  for (let i = 0; i < geometry.instanceCount; i++) {
    cage.readRow(rows.getX(i), row);
    for (let at = 0; at < 24; at += 3) box.expandByPoint(point.fromArray(row, at));
  }
  return box;
}

/** All instances as one mesh of triangles. */
function deform(geometry: three.InstancedBufferGeometry, cage: CageTexture, into: three.BufferGeometry): void {
  const local = geometry.getAttribute('position');
  const rows = geometry.getAttribute('cageRow');
  const { index, instanceCount } = geometry;
  const perInstance = index?.count ?? local.count;
  const positions = new Float32Array(3 * local.count * instanceCount);
  const indices = new Uint32Array(perInstance * instanceCount);
  for (let i = 0; i < instanceCount; i++) {
    cage.readRow(rows.getX(i), row);
    for (let k = 0; k < local.count; k++) {
      trilinear(row, 0, [local.getX(k), local.getY(k), local.getZ(k)], point);
      point.toArray(positions, 3 * (i * local.count + k));
    }
    for (let k = 0; k < perInstance; k++) indices[i * perInstance + k] = i * local.count + (index?.getX(k) ?? k);
  }
  into.dispose();
  into.setAttribute('position', new three.BufferAttribute(positions, 3));
  into.setIndex(new three.BufferAttribute(indices, 1));
  const uv = geometry.getAttribute('uv');
  if (uv !== undefined && instanceCount === 1) into.setAttribute('uv', uv);
  else into.deleteAttribute('uv');
  into.computeBoundingBox();
  into.computeBoundingSphere();
}
