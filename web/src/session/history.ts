// One undo and redo over everything: states are immutable values that share what they have in common, so that a step
// back is the value before, whatever the step was.
import { type ReadonlySignal, signal } from '@preact/signals';

/** Names the step that made a state, as long as that step is not undone. */
export type Mark = number & { readonly __mark: never };

interface Step<T> {
  /** What was done, for people: "widen the chair". */
  readonly label: string;
  /** What was there before it; of a step that was undone, what it led to. */
  readonly state: T;
  /** Of the step that made that state. */
  readonly mark: Mark;
}

const maxSteps = 500;

export class History<T> {
  readonly #present;
  readonly #past = signal<readonly Step<T>[]>([]);
  readonly #future = signal<readonly Step<T>[]>([]);
  #mergeKey: string | undefined;
  #mark = 0 as Mark;
  #marks = 0;

  constructor(initial: T) {
    this.#present = signal(initial);
  }

  get present(): ReadonlySignal<T> {
    return this.#present;
  }
  /** Of the step that made the present state. */
  get mark(): Mark {
    return this.#mark;
  }
  /** What undo would take back, or null. */
  get undoLabel(): string | null {
    return this.#past.value.at(-1)?.label ?? null;
  }
  get redoLabel(): string | null {
    return this.#future.value.at(-1)?.label ?? null;
  }

  /** @param mergeKey makes one step of a run of steps with the same, such as the arrow keys on one slider */
  push(label: string, state: T, mergeKey?: string): void {
    const merges = mergeKey !== undefined && mergeKey === this.#mergeKey && this.#past.value.length > 0;
    if (!merges) {
      this.#past.value = [...this.#past.value.slice(1 - maxSteps), { label, ...this.#now() }];
      this.#mark = this.#nextMark();
    }
    this.#future.value = [];
    this.#mergeKey = mergeKey;
    this.#present.value = state;
  }

  /**
   * Makes a step anew, in its place: every state since then is changed, those of later steps and of undone ones as well,
   * and no step is added. False, and nothing done, when the step is undone or gone.
   * @param change what the step made → what it makes now; called for each of these states
   */
  amend(mark: Mark, change: (state: T) => T): boolean {
    const past = this.#past.value;
    const from = mark === this.#mark ? past.length : past.findIndex((step) => step.mark === mark);
    if (from < 0) return false;
    const amended = (step: Step<T>): Step<T> => ({ ...step, state: change(step.state) });
    this.#past.value = [...past.slice(0, from), ...past.slice(from).map(amended)];
    this.#future.value = this.#future.value.map(amended);
    this.#mergeKey = undefined;
    this.#present.value = change(this.#present.peek());
    return true;
  }

  /** Starts over with nothing to undo. */
  reset(state: T): void {
    this.#past.value = [];
    this.#future.value = [];
    this.#mergeKey = undefined;
    this.#mark = this.#nextMark();
    this.#present.value = state;
  }

  undo(): void {
    this.#step(this.#past, this.#future);
  }
  redo(): void {
    this.#step(this.#future, this.#past);
  }

  #nextMark(): Mark {
    return ++this.#marks as Mark;
  }

  #now(): { state: T; mark: Mark } {
    return { state: this.#present.peek(), mark: this.#mark };
  }

  #step(from: { value: readonly Step<T>[] }, to: { value: readonly Step<T>[] }): void {
    const step = from.value.at(-1);
    if (step === undefined) return;
    from.value = from.value.slice(0, -1);
    to.value = [...to.value, { label: step.label, ...this.#now() }];
    this.#mergeKey = undefined;
    this.#mark = step.mark;
    this.#present.value = step.state;
  }
}
