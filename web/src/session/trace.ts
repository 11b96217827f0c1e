// `parsel/trace` v1 as far as the page shows it: what made each part move, and what was tried. See core/propagate/trace.h.
export interface TracedRelation {
  readonly relation: string;
  /** Largest deviation of a coordinate, normalised frame. */
  readonly by: number;
}

export interface TraceStep {
  readonly part: string;
  readonly kind: 'seed' | 'symmetry' | 'attachment' | 'neighbour' | 'breaking' | 'group' | 'keep_fixed' | 'left_alone';
  /** Indices into the layer's statements. */
  readonly statements: readonly number[];
  readonly pulled_by: readonly TracedRelation[];
  readonly result: readonly TracedRelation[];
  readonly left_broken: readonly string[];
  readonly candidates?: { readonly own: number; readonly neighbour: number; readonly pairs: number };
  readonly survivors?: number;
  readonly runners_up?: readonly { readonly statement: string; readonly error: number; readonly energy: number }[];
  /** A clause of the core's own, with ids. */
  readonly why: string;
}

export interface Trace {
  readonly steps: readonly TraceStep[];
  /** Why the slider goes no further, clauses with ids; "limit" where that is far enough. Older traces do not say. */
  readonly ends?: { readonly min: string; readonly max: string };
  /** Sentences with ids. */
  readonly notes: readonly string[];
  readonly stop: string;
}
