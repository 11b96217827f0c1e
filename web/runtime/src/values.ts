// Where sliders stand.
import { ParselError } from './error';

/** One slider. */
export interface SliderParameter {
  readonly name: string;
  /** What was asked for: "widen the chair". May be empty. */
  readonly request: string;
  readonly min: number;
  readonly max: number;
  /** Where the slider stands when the program is loaded; at 0 the edit does nothing. */
  readonly value: number;
}

const refusal = (place: string, cause: string, fix: string) =>
  new ParselError({ stage: 'runtime/values', place, cause, fix });

/** A value for a slider, cut to its range. Throws a ParselError for what is no finite number. */
export function valueFor({ name, min, max }: SliderParameter, value: unknown): number {
  if (typeof value === 'number' && Number.isFinite(value)) return Math.min(max, Math.max(min, value));
  throw refusal(`/${name}`, `${String(value)} is no finite number`, `give one from ${min} to ${max}`);
}

/** The index of a slider. Throws a ParselError when there is none of that name. */
export function indexOf(name: string, parameters: readonly SliderParameter[]): number {
  const found = parameters.findIndex((parameter) => parameter.name === name);
  if (found >= 0) return found;
  const known = parameters.slice(0, 8).map((parameter) => parameter.name);
  const fix = known.length === 0 ? 'leave it: the program has no slider' : `name one of ${known.join(', ')}`;
  throw refusal(`/${name}`, 'there is no slider of this name', fix);
}

/** The sliders of a program, as they are moved. */
export class SliderValues {
  /** In the order of the parameters. */
  readonly list: number[];

  constructor(private readonly parameters: readonly SliderParameter[]) {
    this.list = parameters.map(({ value }) => value);
  }

  get byName(): Readonly<Record<string, number>> {
    return Object.fromEntries(this.parameters.map(({ name }, i) => [name, this.list[i] ?? 0]));
  }

  /** Answers whether the slider has moved. Throws a ParselError, and changes nothing. */
  set(name: string, value: number): boolean {
    const i = indexOf(name, this.parameters);
    const before = this.list[i];
    this.list[i] = valueFor(this.parameters[i] as SliderParameter, value);
    return this.list[i] !== before;
  }

  reset(): void {
    for (const [i, { value }] of this.parameters.entries()) this.list[i] = value;
  }
}
