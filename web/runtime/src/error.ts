// Everything that this package refuses is refused with this.
import { errorMessage, type ProgramError, type Result } from '../../src/program/types';

/** Says where in the input, why, and what to do about it; `message` has all of it in a line. */
export class ParselError extends Error implements ProgramError {
  override readonly name = 'ParselError';
  /** What refused: "program/check". */
  readonly stage: string;
  /** Where in the input: a JSON pointer, "byte 4", or empty for the whole of it. */
  readonly place: string;
  override readonly cause: string;
  readonly fix: string;

  constructor(error: ProgramError) {
    super(errorMessage(error));
    this.stage = error.stage;
    this.place = error.place;
    this.cause = error.cause;
    this.fix = error.fix;
  }
}

/** The value of a result, or the error thrown. */
export function unwrap<T>(result: Result<T>): T {
  if (result.ok) return result.value;
  throw new ParselError(result.error);
}
