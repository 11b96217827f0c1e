// What pictures of a CAD program's family show.
import type { ModelFiles } from '../scene/load';
import type { State } from '../solid/cut';
import type { FamilySource } from './family_found';
import { parametersAt, settingOf } from './family_state';

/** A model that the core drew of a CAD program, with the numbers and without the parts that `state` tells of. */
export interface CadPicture {
  readonly glb: Uint8Array;
  readonly state: State;
}

/** A program's family: as the program has it, then its variations. */
export function picturesOf({ main }: ModelFiles, family: FamilySource): readonly CadPicture[] {
  const variations = family.found.family.variations.map(({ absent }, i) => ({
    glb: family.pictures[i] ?? new Uint8Array(),
    state: { values: parametersAt(family, settingOf(family, i)), absent: new Set(absent) },
  }));
  return [{ glb: main, state: { values: {}, absent: new Set() } }, ...variations];
}
