// One undo and redo over everything: states are immutable values that share what they have in common, so that a step
// back is the value before, whatever the step was.
import { type ReadonlySignal, signal } from '@preact/signals';

interface Step<T> {
  /** What was done, for people: "widen the chair". */
  readonly label: string;
  readonly state: T;
  /** Steps with the same key that follow each other are one step; undefined: never. */
  readonly mergeKey: string | undefined;
}

const maxSteps = 500;

export class History<T> {
  readonly #present;
  readonly #past = signal<readonly Step<T>[]>([]);
  readonly #future = signal<readonly Step<T>[]>([]);
  #mergeKey: string | undefined;

  constructor(initial: T) {
    this.#present = signal(initial);
  }

  get present(): ReadonlySignal<T> {
    return this.#present;
  }
  /** What undo would take back, or null. */
  get undoLabel(): string | null {
    return this.#past.value.at(-1)?.label ?? null;
  }
  get redoLabel(): string | null {
    return this.#future.value.at(-1)?.label ?? null;
  }

  /** @param mergeKey makes one step of a run of steps, such as the arrow keys on one slider */
  push(label: string, state: T, mergeKey?: string): void {
    const merges = mergeKey !== undefined && mergeKey === this.#mergeKey && this.#past.value.length > 0;
    if (!merges) {
      const step = { label, state: this.#present.peek(), mergeKey };
      this.#past.value = [...this.#past.value.slice(1 - maxSteps), step];
    }
    this.#future.value = [];
    this.#mergeKey = mergeKey;
    this.#present.value = state;
  }

  /** Starts over with nothing to undo. */
  reset(state: T): void {
    this.#past.value = [];
    this.#future.value = [];
    this.#mergeKey = undefined;
    this.#present.value = state;
  }

  undo(): void {
    this.#step(this.#past, this.#future);
  }
  redo(): void {
    this.#step(this.#future, this.#past);
  }

  #step(from: { value: readonly Step<T>[] }, to: { value: readonly Step<T>[] }): void {
    const step = from.value.at(-1);
    if (step === undefined) return;
    from.value = from.value.slice(0, -1);
    to.value = [...to.value, { ...step, state: this.#present.peek() }];
    this.#mergeKey = undefined;
    this.#present.value = step.state;
  }
}
