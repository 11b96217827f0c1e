// One GLB for model and sliders.
import { checkProgram } from '../../src/program/check';
import { embedSliders, slidersIn, withoutSliders } from '../../src/program/embedded';
import { checkShape } from '../../src/program/shape_check';
import { slidersOf } from '../../src/program/sliders';
import { unwrap } from './error';
import { type LoadedProgram, loadProgram, ofSliders } from './program';

/**
 * The file with a program and the shape that it is evaluated on as `extras.parsel` of its root, in place of one that it may
 * have; nothing else of it changes. Throws a ParselError when this is no GLB or the program does not fit the shape.
 * @param program `parsel/program` v1, or what loadProgram() made of it
 * @param shape `parsel/shape` v1 of this very file; what evaluation does not need of it is left out
 */
export function embedProgram(glb: Uint8Array, program: unknown, shape: unknown): Uint8Array {
  const { program: own, hidden } = isLoaded(program) ? program : loadProgram(program);
  const cages = unwrap(checkShape(shape));
  unwrap(checkProgram(own, cages));
  return unwrap(embedSliders(glb, slidersOf(own, cages, { hidden })));
}

/** The program in a GLB, or null when it holds none. Throws a ParselError for what is no GLB or holds a damaged one. */
export function readEmbedded(glb: Uint8Array): LoadedProgram | null {
  const read = unwrap(slidersIn(glb));
  return read === null ? null : ofSliders(read);
}

/** The file without its program, byte for byte as it was before embedProgram(). */
export function removeEmbedded(glb: Uint8Array): Uint8Array {
  return unwrap(withoutSliders(glb));
}

export function isLoaded(value: unknown): value is LoadedProgram {
  return typeof value === 'object' && value !== null && 'parameters' in value && 'program' in value;
}
