// What a language model proposes, as cards: each proposal is read and propagated as soon as it is there, and what came of it
// waits to be kept or dropped. ParSEL §8.1 (proxydural models) and §8.2 (variations of one request).

import { batch, computed, type ReadonlySignal, signal } from '@preact/signals';
import type { Layer } from '../program/types';
import { t } from '../texts/texts';
import { type EditInput, type LayerEntry, type OpenModel, withFreshParameters, withRequest } from './document';
import { madeBy } from './layers';
import type { ModelCore, Propagation } from './model_core';
import {
  type About,
  type Asker,
  nothingSpent,
  type PaintNumbered,
  plus,
  propose,
  readProposal,
  type Spent,
} from './propose';
import type { Session } from './session';
import { type Failed, failureOf, sentence } from './tasks';

/** Why a slider is not clean. */
export type Fault =
  | { readonly kind: 'still' }
  /** Ids of relations that break although nobody asked for it. */
  | { readonly kind: 'broken'; readonly relations: readonly string[] }
  | { readonly kind: 'same'; readonly as: string };

export interface Found {
  readonly kind: 'found';
  /** One layer, at rest. */
  readonly found: Propagation;
  /** Null: it is clean. */
  readonly fault: Fault | null;
  /** What is clean in its place when parts follow that were to stay; null where nothing is wrong, or that does not help. */
  readonly looser: Propagation | null;
}

export interface Proposal {
  /** Unique in a session. */
  readonly key: number;
  readonly request: string;
  readonly state:
    | { readonly kind: 'reading' | 'stopped' }
    | { readonly kind: 'refused'; readonly text: string }
    | Found;
  /** Key of the layer that it was kept as. */
  readonly kept: number | null;
}

export interface Asked {
  readonly about: About;
  readonly model: OpenModel;
  /** Until the proposals are there. */
  readonly isAsking: boolean;
  readonly isRunning: boolean;
  readonly proposals: readonly Proposal[];
  /** What of the answer was no proposal, and why, a clause each. */
  readonly dropped: readonly { readonly request: string; readonly reason: string }[];
  readonly failure: Failed | null;
  readonly spent: Spent;
  readonly stop: () => void;
}

export interface ProposalsParts {
  readonly session: Session;
  readonly models: ReadonlySignal<ModelCore | null>;
  /** @throws AskError that says why nobody can be asked */
  askerOf(model: OpenModel): Promise<Asker>;
}

export interface Proposals {
  /** Null before anything was asked, and while another model is open. */
  readonly asked: ReadonlySignal<Asked | null>;
  /** Those that are neither dropped nor layers of the work: undoing brings back what was kept. */
  readonly open: ReadonlySignal<readonly Proposal[]>;
  start(about: About, paint: PaintNumbered): Promise<void>;
  /** What is finished stays, the others say that they were stopped. */
  stop(): void;
  /** Reads what was stopped or refused once more. */
  readAgain(key: number): Promise<void>;
  close(): void;
  drop(key: number): void;
  rename(key: number, request: string): void;
  /** @param by −1 up, 1 down */
  move(key: number, by: -1 | 1): void;
  /** Lets parts of one follow that were to stay. */
  loosen(key: number): void;
  /** Makes one a layer, its slider where it stands; answers the layer's key. */
  keep(key: number): number | null;
  /** Makes all clean ones layers, in one step of the history; answers their keys. */
  keepAll(): readonly number[];
  /** Shows what one does at a value of its slider, without making it part of the work; 0 ends that. */
  preview(key: number, value: number): void;
  /** Where its slider stands. */
  standing(key: number): number;
}

/** A range below this moves nothing. */
const leastRange = 1e-6;

export function createProposals({ session, models, askerOf }: ProposalsParts): Proposals {
  const { document, draft } = session;
  const state = signal<Asked | null>(null);
  const shown = signal<{ readonly key: number; readonly entry: LayerEntry } | null>(null);
  let nextKey = 1;

  const asked = computed(() => (state.value?.model === document.value.model ? state.value : null));
  const open = computed(() => {
    const layers = new Set(document.value.layers.map(({ key }) => key));
    return (asked.value?.proposals ?? []).filter(({ kept }) => kept === null || !layers.has(kept));
  });

  /** Changes the run that `stop` belongs to; nothing when another has taken its place. */
  function change(stop: () => void, next: (now: Asked) => Partial<Asked>): void {
    const now = state.peek();
    if (now?.stop === stop) state.value = { ...now, ...next(now) };
  }
  const changeOne = (stop: () => void, key: number, next: Partial<Proposal>) =>
    change(stop, ({ proposals }) => ({
      proposals: proposals.map((one) => (one.key === key ? { ...one, ...next } : one)),
    }));

  async function find(core: ModelCore, model: OpenModel, key: number, request: string, asker: Asker, run: Run) {
    const { signal, stop } = run;
    try {
      const { edit, why, calls, tokens } = await readProposal(core, model, request, asker.reader, signal);
      change(stop, ({ spent }) => ({ spent: plus(spent, { calls, tokens }) }));
      if (edit === null) return changeOne(stop, key, { state: { kind: 'refused', text: sentence(new Error(why)) } });
      const found = await core.propagate(model, edit, { signal });
      const others = state.peek()?.proposals ?? [];
      const fault = faultOf(found, others);
      const looser = fault?.kind === 'broken' ? await findLooser(core, model, edit, signal) : null;
      changeOne(stop, key, { state: { kind: 'found', found, fault, looser } });
    } catch (error) {
      if (signal.aborted) return;
      changeOne(stop, key, { state: { kind: 'refused', text: sentence(error) } });
    }
  }

  async function start(about: About, paint: PaintNumbered): Promise<void> {
    const core = models.peek();
    const { model } = document.peek();
    if (core === null || model === null) return;
    state.peek()?.stop();
    unshow();
    const run = newRun();
    const { signal, stop } = run;
    state.value = {
      about,
      model,
      isAsking: true,
      isRunning: true,
      proposals: [],
      dropped: [],
      failure: null,
      spent: nothingSpent,
      stop,
    };
    try {
      const asker = await askerOf(model);
      const { requests, dropped, calls, tokens } = await propose(core, model, about, asker, paint, signal);
      signal.throwIfAborted();
      const proposals = requests.map(
        ({ request }): Proposal => ({ key: nextKey++, request, state: { kind: 'reading' }, kept: null }),
      );
      change(stop, ({ spent }) => ({ isAsking: false, proposals, dropped, spent: plus(spent, { calls, tokens }) }));
      await Promise.all(proposals.map(({ key, request }) => find(core, model, key, request, asker, run)));
    } catch (error) {
      if (!signal.aborted) fail(stop, error);
    }
    end(stop);
  }

  function fail(stop: () => void, error: unknown): void {
    change(stop, () => ({ failure: failureOf(error) }));
  }

  function end(stop: () => void): void {
    change(stop, ({ proposals }) => ({
      isAsking: false,
      isRunning: false,
      proposals: proposals.map((one) => (one.state.kind === 'reading' ? { ...one, state: { kind: 'stopped' } } : one)),
    }));
  }

  function unshow(): void {
    const showing = shown.peek();
    if (showing !== null && draft.peek()?.key === showing.entry.key) draft.value = null;
    shown.value = null;
  }

  const changeAll = (next: (proposals: readonly Proposal[]) => readonly Proposal[]) => {
    const now = state.peek();
    if (now !== null) state.value = { ...now, proposals: next(now.proposals) };
  };
  const foundOf = (key: number): { one: Proposal; found: Propagation } | null => {
    const one = open.peek().find((other) => other.key === key);
    return one?.state.kind === 'found' ? { one, found: one.state.found } : null;
  };

  /** Layers from one on are worked out on what those before them leave, in the step that added them. */
  function compose(key: number): void {
    const core = models.peek();
    if (core === null) return;
    session.useCore(core);
    void session.restack(key);
  }

  function standing(key: number): number {
    const showing = shown.value;
    if (showing?.key !== key || draft.value?.key !== showing.entry.key) return 0;
    session.step.value; // what the slider's place is read from is no signal
    return session.sliderValue(showing.entry);
  }

  return {
    asked,
    open,
    start,
    stop() {
      const now = state.peek();
      now?.stop();
      if (now !== null) end(now.stop);
    },
    async readAgain(key) {
      const core = models.peek();
      const now = asked.peek();
      const one = now?.proposals.find((other) => other.key === key);
      if (core === null || now === null || one === undefined || now.isRunning) return;
      const run = newRun();
      state.value = { ...now, isRunning: true, failure: null, stop: run.stop };
      changeOne(run.stop, key, { state: { kind: 'reading' } });
      try {
        await find(core, now.model, key, one.request, await askerOf(now.model), run);
      } catch (error) {
        if (!run.signal.aborted) fail(run.stop, error);
      }
      end(run.stop);
    },
    close() {
      state.peek()?.stop();
      unshow();
      state.value = null;
    },
    drop(key) {
      if (shown.peek()?.key === key) unshow();
      changeAll((proposals) => proposals.filter((one) => one.key !== key));
    },
    rename(key, request) {
      if (request.trim() === '') return;
      changeAll((proposals) => proposals.map((one) => (one.key === key ? { ...one, request: request.trim() } : one)));
    },
    move(key, by) {
      const seen = open.peek();
      const other = seen[seen.findIndex((one) => one.key === key) + by];
      const own = seen.find((one) => one.key === key);
      if (own === undefined || other === undefined) return;
      changeAll((proposals) => proposals.map((one) => (one === own ? other : one === other ? own : one)));
    },
    loosen(key) {
      const one = open.peek().find((other) => other.key === key);
      if (one?.state.kind !== 'found' || one.state.looser === null) return;
      const state: Found = { kind: 'found', found: one.state.looser, fault: null, looser: null };
      if (shown.peek()?.key === key) unshow();
      changeAll((proposals) => proposals.map((other) => (other === one ? { ...one, state } : other)));
    },
    keep(key) {
      const kept = foundOf(key);
      if (kept === null) return null;
      const { one, found } = kept;
      const program = at(withRequest(found.program, one.request), standing(key));
      return batch(() => {
        unshow();
        const layer = session.addProgram(program, one.request, madeBy(found))?.[0] ?? null;
        if (layer === null) return null;
        changeAll((all) => all.map((other) => (other.key === key ? { ...other, kept: layer } : other)));
        compose(layer);
        return layer;
      });
    },
    keepAll() {
      const clean = open
        .peek()
        .flatMap((one) => (isClean(one) ? [foundOf(one.key)] : []))
        .filter((one) => one !== null);
      const [first] = clean;
      if (first === undefined) return [];
      const layers: Layer[] = [];
      for (const { one, found } of clean) {
        const taken = new Set(layers.map(({ parameter }) => parameter.name));
        layers.push(...withFreshParameters(withRequest(found.program, one.request).layers, taken));
      }
      return batch(() => {
        unshow();
        const label = clean.length === 1 ? first.one.request : t`keep ${clean.length} suggested sliders`;
        const keys = session.addProgram({ ...first.found.program, layers }, label) ?? [];
        const keptAs = new Map(clean.map(({ one }, i) => [one.key, keys[i] ?? null]));
        changeAll((all) =>
          all.map((one) => (keptAs.has(one.key) ? { ...one, kept: keptAs.get(one.key) ?? null } : one)),
        );
        if (keys[0] !== undefined) compose(keys[0]);
        return keys;
      });
    },
    preview(key, value) {
      const found = foundOf(key)?.found;
      if (found === undefined) return;
      if (value === 0) return shown.peek()?.key === key ? unshow() : undefined;
      batch(() => {
        const showing = shown.peek();
        if (showing?.key === key && draft.peek()?.key === showing.entry.key)
          return session.slide(showing.entry.key, value);
        const [entry] = session.entriesOf(found) ?? [];
        if (entry === undefined) return;
        draft.value = { ...entry, value };
        shown.value = { key, entry: draft.value };
      });
    },
    standing,
  };
}

interface Run {
  readonly signal: AbortSignal;
  readonly stop: () => void;
}
function newRun(): Run {
  const controller = new AbortController();
  return { signal: controller.signal, stop: () => controller.abort() };
}

export const isClean = ({ state }: Proposal): boolean => state.kind === 'found' && state.fault === null;

/** What comes of an edit without the hints that parts stay; null when that is not clean either, or there are none. */
async function findLooser(
  core: ModelCore,
  model: OpenModel,
  edit: EditInput,
  signal: AbortSignal,
): Promise<Propagation | null> {
  const hints = Object.fromEntries(Object.entries(edit.hints).filter(([, hint]) => hint !== 'keep_fixed'));
  if (Object.keys(hints).length === Object.keys(edit.hints).length) return null;
  const found = await core.propagate(model, { ...edit, hints }, { signal });
  return faultOf(found, []) === null ? found : null;
}

/** What is wrong with a slider. */
function faultOf({ program }: Propagation, others: readonly Proposal[]): Fault | null {
  const [layer] = program.layers;
  if (layer === undefined || layer.parameter.max - layer.parameter.min < leastRange) return { kind: 'still' };
  const relations = layer.relations.filter(({ status }) => status === 'broken').map(({ id }) => id);
  if (relations.length > 0) return { kind: 'broken', relations };
  const doing = (found: Propagation) =>
    JSON.stringify(found.program.layers[0]?.statements.map(({ why: _, ...rest }) => rest));
  const own = doing({ program });
  const same = others.find(({ state }) => state.kind === 'found' && doing(state.found) === own);
  return same === undefined ? null : { kind: 'same', as: same.request };
}

/** A program of one layer with its slider at a value. */
function at(program: Propagation['program'], value: number): Propagation['program'] {
  return {
    ...program,
    layers: program.layers.map((layer) => ({ ...layer, parameter: { ...layer.parameter, value } })),
  };
}
