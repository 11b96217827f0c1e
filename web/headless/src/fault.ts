// What goes wrong, as the core says it: one line of stage, place, cause and fix.

export interface Fault {
  /** Who refused: "batch/manifest". */
  readonly stage: string;
  /** Where: a path, a line; empty for the whole. */
  readonly place: string;
  /** A clause without a full stop. */
  readonly cause: string;
  /** What to do about it, a clause without a full stop. */
  readonly fix: string;
}

/** Ends a command with exit code 1 and its line on stderr. */
export class Refusal extends Error {
  constructor(readonly fault: Fault) {
    const { stage, place, cause, fix } = fault;
    super(`${stage}: ${place === '' ? '' : `${place}: `}${cause}; ${fix}.`);
  }
}

/** Wrong usage: exit code 2. */
export class Misuse extends Error {}

export const isFault = (value: unknown): value is Fault =>
  typeof value === 'object' && value !== null && typeof (value as Fault).cause === 'string';

export const reasonOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));

/** The code of an error of the system ("ENOENT"), else nothing. */
export const codeOf = (error: unknown): string | undefined => (error as NodeJS.ErrnoException | null)?.code;
