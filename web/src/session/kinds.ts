// Kinds of a CAD program's thing, suggested by a language model: it is asked which there are, then for the numbers of the
// most common ones, which come in as cards to be kept as variations or dropped (ReparamCAD §3.2, by words instead of a
// diffusion model's pictures).

import { batch, computed, type ReadonlySignal, signal } from '@preact/signals';
import type { Source } from '../llm/source';
import { askVotes } from '../llm/votes';
import { t } from '../texts/texts';
import { type CadPicture, picturesOf } from './cad_pictures';
import type { OpenModel } from './document';
import type { NamedVariation, Variations } from './family_found';
import type { ModelCore } from './model_core';
import { nothingSpent, type Spent } from './propose';
import type { Session } from './session';
import { type Failed, failureOf, sentence } from './tasks';

/** How many of the kinds are drawn without being asked for. */
const drawnAtOnce = 6;

export interface Drawn {
  readonly kind: 'drawn';
  /** One entry of parsel/variations. */
  readonly variation: NamedVariation;
  readonly picture: CadPicture;
  /** Of the constraints of the program between parts that it has: how many most answers keep. */
  readonly agreed: number;
  readonly constraints: number;
  /** Answers that were counted, and those that could not be read. */
  readonly votes: number;
  readonly refused: number;
}

export interface KindCard {
  readonly name: string;
  /** About its proportions. */
  readonly words: string;
  /** Answers that named it. */
  readonly votes: number;
  readonly state:
    | { readonly kind: 'named' | 'stopped' }
    | { readonly kind: 'asking'; readonly done: number; readonly of: number }
    | { readonly kind: 'refused'; readonly text: string }
    | Drawn;
}

export interface AskedKinds {
  readonly model: OpenModel;
  /** Until the kinds are there. */
  readonly isAsking: boolean;
  readonly isRunning: boolean;
  /** Answers to the question which kinds there are. */
  readonly answers: number;
  readonly cards: readonly KindCard[];
  readonly failure: Failed | null;
  readonly spent: Spent;
  readonly stop: () => void;
}

export interface KindsParts {
  readonly session: Session;
  readonly models: ReadonlySignal<ModelCore | null>;
  /** Whom to ask. @throws AskError that says why nobody can be asked */
  sourceOf(model: OpenModel): Promise<Source>;
}

export interface KindsActions {
  /** Null before anything was asked, and while another model is open. */
  readonly asked: ReadonlySignal<AskedKinds | null>;
  start(): Promise<void>;
  /** Asks for the numbers of one kind, which may be one of a person's own words. */
  draw(name: string): Promise<void>;
  /** What is there stays. */
  stop(): void;
  close(): void;
  drop(name: string): void;
  /** Makes variations of these, or of all that are drawn, in one step. A variation of the same name gives way. */
  keep(names?: readonly string[]): Promise<void>;
}

export function createKinds({ session, models, sourceOf }: KindsParts): KindsActions {
  const { document } = session;
  const state = signal<AskedKinds | null>(null);
  const asked = computed(() => (state.value?.model === document.value.model ? state.value : null));

  const newRun = () => {
    const controller = new AbortController();
    return { signal: controller.signal, stop: () => controller.abort() };
  };
  type Run = ReturnType<typeof newRun>;

  /** Changes the run that `stop` belongs to; nothing when another has taken its place. */
  function change(stop: () => void, next: (now: AskedKinds) => Partial<AskedKinds>): void {
    const now = state.peek();
    if (now?.stop === stop) state.value = { ...now, ...next(now) };
  }
  const setCard = (stop: () => void, name: string, next: KindCard['state']) =>
    change(stop, ({ cards }) => ({
      cards: cards.map((card) => (card.name === name ? { ...card, state: next } : card)),
    }));

  function end(stop: () => void): void {
    change(stop, ({ cards }) => ({
      isAsking: false,
      isRunning: false,
      cards: cards.map((card) => (card.state.kind === 'asking' ? { ...card, state: { kind: 'stopped' } } : card)),
    }));
  }

  /** The replies to one prompt, counted by the core; those that it cannot read are asked anew the next time. */
  async function ask(
    core: ModelCore,
    about: { readonly cad: unknown; readonly task: 'kinds' | 'variation'; readonly kind: string },
    source: Source,
    { signal, stop }: Run,
    onVote: (done: number, of: number) => void,
  ) {
    const { prompt: rendered, schema } = await core.cadPrompt({ ...about, count: 0 });
    const prompt = { ...rendered, relation: null };
    const { texts, calls, tokens } = await askVotes(prompt, schema, source, signal, onVote);
    change(stop, ({ spent }) => ({
      spent: {
        calls: spent.calls + calls,
        tokens: { input: spent.tokens.input + tokens.input, output: spent.tokens.output + tokens.output },
      },
    }));
    const read = await core.readCadReplies({ ...about, texts: texts.map(({ text }) => text) });
    for (const { vote } of read.refused) {
      const own = texts[vote];
      if (own !== undefined) await source.discard(prompt, own.vote);
    }
    signal.throwIfAborted();
    return { ...read, votes: texts.length - read.refused.length };
  }

  async function drawOne(core: ModelCore, model: OpenModel, name: string, source: Source, run: Run): Promise<void> {
    const base = model.files.cad;
    if (base === undefined) return;
    const cad = base.program;
    const show = (done: number, of: number) => {
      if (!run.signal.aborted) setCard(run.stop, name, { kind: 'asking', done, of });
    };
    show(0, 1);
    try {
      const read = await ask(core, { cad, task: 'variation', kind: name }, source, run, show);
      const [variation] = (read.variation?.variations ?? []) as unknown as readonly NamedVariation[];
      if (read.variation === undefined || variation === undefined) throw new Error(t`The answers hold no numbers`);
      const alone = { cad, variations: read.variation as unknown as Variations, choices: {} };
      const { found, pictures } = await core.findFamily(alone, { signal: run.signal });
      const { variations } = alone;
      const family = { base, asked: { cad, variations }, found, pictures, variations, choices: {} };
      const [, picture] = picturesOf(model.files, family);
      if (picture === undefined) throw new Error(t`The answers hold no numbers`);
      setCard(run.stop, name, {
        kind: 'drawn',
        variation,
        picture,
        agreed: read.agreed ?? 0,
        constraints: read.constraints ?? 0,
        votes: read.votes,
        refused: read.refused.length,
      });
    } catch (error) {
      if (!run.signal.aborted) setCard(run.stop, name, { kind: 'refused', text: sentence(error) });
    }
  }

  async function start(): Promise<void> {
    const core = models.peek();
    const { model } = document.peek();
    if (core === null || model?.files.cad === undefined) return;
    state.peek()?.stop();
    const run = newRun();
    const { stop, signal } = run;
    const empty = { isAsking: true, isRunning: true, answers: 0, cards: [], failure: null, spent: nothingSpent };
    state.value = { ...empty, model, stop };
    try {
      const source = await sourceOf(model);
      const about = { cad: model.files.cad.program, task: 'kinds', kind: '' } as const;
      const read = await ask(core, about, source, run, () => {});
      const named = read.kinds ?? [];
      const cards = named.map(({ name, words, votes }): KindCard => ({ name, words, votes, state: { kind: 'named' } }));
      change(stop, () => ({ isAsking: false, answers: read.votes, cards }));
      const first = cards.slice(0, drawnAtOnce);
      await Promise.all(first.map(({ name }) => drawOne(core, model, name, source, run)));
    } catch (error) {
      if (!signal.aborted) change(stop, () => ({ failure: failureOf(error) }));
    }
    end(stop);
  }

  async function draw(name: string): Promise<void> {
    const core = models.peek();
    const { model } = document.peek();
    if (core === null || model?.files.cad === undefined || name.trim() === '') return;
    const now = asked.peek();
    if (now?.isRunning) return;
    state.peek()?.stop(); // of another model
    const run = newRun();
    const cards = now?.cards ?? [];
    const isNew = !cards.some((card) => card.name === name);
    const own: KindCard = { name, words: '', votes: 0, state: { kind: 'named' } };
    state.value = {
      ...(now ?? { model, answers: 0, spent: nothingSpent }),
      isAsking: false,
      isRunning: true,
      failure: null,
      cards: isNew ? [own, ...cards] : cards,
      stop: run.stop,
    };
    try {
      await drawOne(core, model, name, await sourceOf(model), run);
    } catch (error) {
      if (!run.signal.aborted) change(run.stop, () => ({ failure: failureOf(error) }));
    }
    end(run.stop);
  }

  const without = (names: readonly string[]) => {
    const now = state.peek();
    if (now !== null) state.value = { ...now, cards: now.cards.filter(({ name }) => !names.includes(name)) };
  };

  return {
    asked,
    start,
    draw,
    stop() {
      const now = state.peek();
      now?.stop();
      if (now !== null) end(now.stop);
    },
    close() {
      state.peek()?.stop();
      state.value = null;
    },
    drop: (name) => without([name]),
    async keep(names) {
      const core = models.peek();
      const now = asked.peek();
      if (core === null || now === null) return;
      const kept = now.cards.flatMap(({ name, state }) =>
        state.kind === 'drawn' && (names === undefined || names.includes(name)) ? [state.variation] : [],
      );
      if (kept.length === 0) return;
      if (!(await session.family.addVariations(core, kept))) return;
      batch(() => without(kept.map(({ name }) => name)));
    },
  };
}
