// Whether meshes are those that a program was made on.
import * as three from 'three';
import type { CagePart, CageShape } from '../../../src/program/types';
import type { ModelView } from '../../../src/scene/model_view';
import { ParselError } from '../error';

/** A mesh may stick out of its hexahedron by this, and fills it at least so far along one axis; local coordinates. */
const mostOutside = 0.05;
const leastExtent = 0.5;

/** Why a program was not made on this model, or null: the mesh of every part must be there, and fill its hexahedron. */
export function misfitOf(view: ModelView, shape: CageShape): ParselError | null {
  const fix = 'use the program with the model that it was made on';
  const refusal = (part: CagePart, i: number, cause: string) =>
    new ParselError({ stage: 'runtime/attach', place: `/shape/parts/${i}`, cause: `“${part.id}”: ${cause}`, fix });
  for (const [i, part] of shape.parts.entries()) {
    if (part.virtual) continue;
    const geometry = view.meshOf(i)?.geometry;
    if (geometry === undefined) return refusal(part, i, `the model has no mesh at node ${part.node}`);
    const local = new three.Box3().setFromBufferAttribute(geometry.getAttribute('position') as three.BufferAttribute);
    const { min, max } = local;
    const outside = Math.max(...max.toArray(), ...min.toArray().map((x) => -x)) - 1;
    const extent = Math.max(...max.sub(min).toArray()) / 2;
    if (!(outside <= mostOutside && extent >= leastExtent)) {
      return refusal(part, i, `the mesh at node ${part.node} does not lie in its hexahedron`);
    }
  }
  return null;
}
