// A request in words: asked of a language model, read, and propagated into a layer. What was understood stays at hand, so
// that each line of it can be corrected; the layer is then made anew in the step that made it, and later steps stay.

import { batch, computed, effect, type ReadonlySignal, type Signal, signal, untracked } from '@preact/signals';
import { AskError } from '../llm/ask_error';
import { type Answer, ask, type Estimate, estimate, type TaskProgress } from '../llm/session';
import type { Source } from '../llm/source';
import type { Layer } from '../program/types';
import { listed, plural, t } from '../texts/texts';
import type { Inference, PlainInference, Target } from '../worker/protocol';
import { type EditInput, type OpenModel, partNames, type Side } from './document';
import type { Mark } from './history';
import { madeBy } from './layers';
import { type Said, saidFrom } from './looking';
import type { ModelCore } from './model_core';
import type { Session } from './session';
import { type Failed, failureOf } from './tasks';

/** The layer that came of a request, and the step that made it. */
interface Made {
  readonly key: number;
  readonly mark: Mark;
}

/** A request with what was understood of it. */
export interface Understood {
  readonly kind: 'understood';
  readonly model: OpenModel;
  readonly request: string;
  /** The text that was sent, as it was typed. */
  readonly typed: string;
  readonly mentioned: readonly string[];
  /** Whose sides it speaks of. */
  readonly said: Said;
  readonly answer: Answer;
  /** How sure it is and what it comes to, where no language model was asked. */
  readonly plain: PlainInference['plain'] | null;
  /** How far the slider shall go, as it was said; null when that was not said, or is no longer about this edit. */
  readonly target: Target | null;
  /** As corrected by hand; null when there is no reading to begin with. */
  readonly edit: EditInput | null;
  /** Which of the readings the edit's seed is. */
  readonly reading: number;
  /** What came of it; null before. */
  readonly made: Made | null;
}

export type RequestState =
  | { readonly kind: 'idle' }
  | { readonly kind: 'asking'; readonly tasks: readonly TaskProgress[]; readonly cancel: () => void }
  | ({ readonly kind: 'failed' } & Failed)
  | Understood;

export interface Question {
  /** As it is asked. */
  readonly request: string;
  /** As it is shown. */
  readonly title: string;
  readonly mentioned: readonly string[];
  readonly source: Source;
}

export interface RequestParts {
  readonly session: Session;
  readonly models: ReadonlySignal<ModelCore | null>;
  /** Whom to ask what. Rejects with an AskError that says why nobody can be asked. `afresh`: not what was kept. */
  questionOf(model: OpenModel, said: Said, mentioned: readonly string[], afresh: boolean): Promise<Question>;
  /** The side of the object that faces whoever types; null: the object's own sides are meant. */
  seen(): Side | null;
  /** How often each prompt is asked; null where nothing is paid for. */
  votes(): number | null;
  /** Shows what a layer does. */
  play(key: number): void;
  /** Puts a layer's slider where it was said to go. */
  aim(key: number, target: Target): void;
}

export interface Requests {
  /** What is typed, and the ids of the parts that were pointed at. Emptied only when a layer came of it. */
  readonly requestText: Signal<string>;
  readonly mentioned: Signal<readonly string[]>;
  readonly request: ReadonlySignal<RequestState>;
  /** The layer of the present request, while it is in the document: undo takes it out. */
  readonly requestLayer: ReadonlySignal<Layer | null>;
  mention(id: string): void;
  unmention(id: string): void;
  dismiss(): void;
  cancelRequest(): void;
  /** What was said of another model is of no use for this one. What is typed stays. Answers how to stop. */
  forgetOtherModels(): () => void;
  /**
   * Reads what is typed: plainly, where that is sure or nobody else can be asked, else by a language model or its
   * recorded answers.
   */
  sendRequest(): Promise<void>;
  /**
   * Asks a language model about the same once more, answers that were kept included. What comes of it takes the place of
   * what came before.
   */
  askAgain(before: Understood): Promise<void>;
  /** Reads it once more with other sides: those of whoever looks at that side of the object, or its own. In its place, too. */
  readFrom(before: Understood, side: Side | null): Promise<void>;
  /** Calls and tokens that sending would take; null where nothing is paid for. */
  estimateRequest(): Promise<Estimate | null>;
  /** Takes another reading of the request. */
  chooseReading(reading: number): void;
  /** Changes the seed, hints or the relations that may break. */
  correctEdit(change: Partial<EditInput>): void;
  /** Propagates what was understood, in place of the layer that came of it before. */
  applyRequest(): Promise<void>;
}

export function createRequests({ session, models, questionOf, seen, votes, play, aim }: RequestParts): Requests {
  const { document } = session;
  const requestText = signal('');
  const mentioned = signal<readonly string[]>([]);
  const request = signal<RequestState>({ kind: 'idle' });
  const requestLayer = computed<Layer | null>(() => {
    const state = request.value;
    if (state.kind !== 'understood' || state.made === null) return null;
    const { key } = state.made;
    return document.value.layers.find((entry) => entry.key === key)?.layer ?? null;
  });
  /** Counts applications: a later one goes on from where an earlier one is. */
  let attempt = 0;

  const saying = (text: string, from = seen()): Said => saidFrom(text, from, partNames(document.peek()));

  function dismiss(): void {
    if (request.peek().kind !== 'asking') request.value = { kind: 'idle' };
  }

  function fail(error: unknown): void {
    request.value = { kind: 'failed', ...failureOf(error) };
  }

  /** @param anew a language model is asked, what it answered before included */
  async function send(before: Understood | null, anew = false): Promise<void> {
    const core = models.peek();
    const { model } = document.peek();
    if (requestText.peek().trim() === '' || request.peek().kind === 'asking') return;
    if (core === null || model === null)
      return fail(
        new Error(model === null ? t`Open a model first` : t`The core is still starting; try again in a moment`),
      );

    const controller = new AbortController();
    const { signal } = controller;
    const typed = requestText.peek();
    const parts = mentioned.peek();
    const cancel = () => controller.abort();
    request.value = { kind: 'asking', tasks: [], cancel };
    try {
      const known = parts.filter((id) => model.shape.parts.some((part) => part.id === id));
      const said = before?.said ?? saying(typed.trim());
      const readPlainly = () => core.readPlainly(model, said.own, known);
      const whole = (inference: Inference, plain: PlainInference['plain'] | null): Promise<void> =>
        understand(
          {
            kind: 'understood',
            model,
            request: typed.trim(),
            typed,
            mentioned: parts,
            said,
            answer: { inference, tokens: { input: 0, output: 0 }, calls: 0, kept: 0, failures: [] },
            plain,
            ...readingOf(inference, plain, 0),
            reading: 0,
            made: before?.made ?? null,
          },
          signal,
        );
      // What costs nothing and is sure comes first.
      if (!anew && votes() !== null) {
        const read = await readPlainly();
        if (read.plain.sure) return await whole(read, read.plain);
      }
      let question: Question;
      try {
        question = await questionOf(model, said, known, anew);
      } catch (error) {
        if (anew || !(error instanceof AskError) || error.kind !== 'no_recording') throw error;
        const read = await readPlainly();
        if (read.plain.readings.length === 0) throw notUnderstood(read.plain);
        return await whole(read, read.plain);
      }
      const prompts = await core.prompts(model, question.request, question.mentioned);
      const answer = await ask(
        prompts,
        question.source,
        (replies) => core.readReplies(model, question.request, replies),
        {
          signal,
          onProgress(tasks) {
            if (!signal.aborted) request.value = { kind: 'asking', tasks, cancel };
          },
        },
      );
      await understand(
        {
          kind: 'understood',
          model,
          request: question.title,
          typed,
          mentioned: parts,
          said,
          answer,
          plain: null,
          ...readingOf(answer.inference, null, 0),
          reading: 0,
          made: before?.made ?? null,
        },
        signal,
      );
    } catch (error) {
      if (signal.aborted) request.value = { kind: 'idle' };
      else fail(error);
    }
  }

  async function resend(before: Understood, anew: boolean): Promise<void> {
    requestText.value = before.typed;
    mentioned.value = before.mentioned;
    await send(before, anew);
  }

  async function understand(state: Understood, signal: AbortSignal): Promise<void> {
    signal.throwIfAborted();
    if (document.peek().model !== state.model)
      throw new Error(t`Another model was opened meanwhile; send the request again`);
    request.value = state;
    if (state.edit !== null && state.answer.inference.seed.outcome === 'decided') await applyRequest();
  }

  function correct(state: Understood): void {
    const isApplied = requestLayer.peek() !== null;
    request.value = state;
    if (isApplied) void applyRequest();
  }

  async function applyRequest(): Promise<void> {
    const core = models.peek();
    const state = request.peek();
    if (core === null || state.kind !== 'understood' || state.edit === null) return;
    const own = ++attempt;
    const { made } = state;
    const found = await session.find(core, state.edit, state.request, made?.key);
    if (found === null || own !== attempt) return;
    const { seen: side } = state.said;
    const from = { ...madeBy(found), ...(side === null ? {} : { seen: side }) };
    const isThere = made !== null && document.peek().layers.some(({ key }) => key === made.key);
    if (made !== null && isThere) {
      if (session.amendLayer(made.mark, made.key, found, from)) finish(state, made);
      return;
    }
    const key = session.addProgram(found.program, state.request, from)?.[0];
    if (key !== undefined) finish(state, { key, mark: session.mark() });
  }

  function finish(state: Understood, made: Made): void {
    const now = request.peek();
    batch(() => {
      if (now.kind === 'understood' && now.answer === state.answer) request.value = { ...now, made };
      if (requestText.peek() === state.typed) {
        requestText.value = '';
        mentioned.value = [];
      }
    });
    if (state.target === null) play(made.key);
    else aim(made.key, state.target);
  }

  return {
    requestText,
    mentioned,
    request,
    requestLayer,
    mention(id) {
      if (!mentioned.peek().includes(id)) mentioned.value = [...mentioned.peek(), id];
    },
    unmention(id) {
      mentioned.value = mentioned.peek().filter((other) => other !== id);
    },
    dismiss,
    cancelRequest() {
      const state = request.peek();
      if (state.kind === 'asking') state.cancel();
    },
    forgetOtherModels() {
      let files = document.peek().model?.files;
      return effect(() => {
        const { model } = document.value;
        if (model?.files === files) return;
        files = model?.files;
        untracked(() => {
          dismiss();
          mentioned.value = mentioned.peek().filter((id) => model?.shape.parts.some((part) => part.id === id));
        });
      });
    },
    sendRequest: () => send(null),
    askAgain: (before) => resend(before, true),
    readFrom: (before, side) => resend({ ...before, said: saying(before.typed.trim(), side) }, false),
    async estimateRequest() {
      const core = models.peek();
      const { model } = document.peek();
      const text = requestText.peek().trim();
      const count = votes();
      if (count === null || core === null || model === null || text === '') return null;
      // What will be read without a language model costs nothing.
      const said = saying(text);
      if ((await core.readPlainly(model, said.own, mentioned.peek())).plain.sure) return null;
      const { prompts } = await core.prompts(model, said.told, mentioned.peek());
      return estimate(prompts, count);
    },
    chooseReading(reading) {
      const state = request.peek();
      if (state.kind !== 'understood') return;
      const { edit, target } = readingOf(state.answer.inference, state.plain, reading);
      if (edit === null) return;
      // A reading of a language model is one of the seed alone.
      const whole = state.plain === null && state.edit !== null ? { ...state.edit, seed: edit.seed } : edit;
      correct({ ...state, reading, edit: whole, target });
    },
    correctEdit(change) {
      const state = request.peek();
      if (state.kind !== 'understood' || state.edit === null) return;
      const target = change.seed === undefined ? state.target : null;
      correct({ ...state, edit: { ...state.edit, ...change }, target });
    },
    applyRequest,
  };
}

/** The edit of one of the readings, and how far it was said to go. The core has checked it against the shape. */
function readingOf(
  { seed, edit }: Inference,
  plain: PlainInference['plain'] | null,
  reading: number,
): Pick<Understood, 'edit' | 'target'> {
  const whole = (read: object | null | undefined): EditInput | null =>
    read ? { seed: [], disabled: [], hints: {}, ...read } : null;
  if (plain !== null) {
    const read = plain.readings[reading];
    return { edit: whole(read?.edit), target: read?.target ?? null };
  }
  const statements = seed.readings[reading]?.statements;
  const others = whole(edit);
  if (reading === 0) return { edit: others, target: null };
  const chosen = statements as unknown as EditInput['seed'] | undefined;
  return { edit: chosen ? { disabled: [], hints: {}, ...others, seed: chosen } : null, target: null };
}

/** What was not understood of a request that no language model read, as sentences. */
function unsureWords({ reason, unused }: PlainInference['plain']): string {
  const words = unused.slice(0, 5).map((word) => `“${word}”`);
  const missed =
    words.length === 0 ? null : plural(words.length, '{0} is not understood', '{0} are not understood', listed(words));
  return [reason, missed].filter((text) => text !== null).join('; ') || t`it is not clear`;
}

const notUnderstood = (plain: PlainInference['plain']) =>
  new AskError(
    'no_recording',
    '',
    t`Without a language model this was not understood: ${unsureWords(plain)}`,
    t`Say it in other words, or enter a key in the settings to ask a language model`,
  );

/** Why there is no clear reading, as a sentence; null when there is. */
export function whyUndecided(
  { seed, refused }: Inference,
  plain: PlainInference['plain'] | null = null,
): string | null {
  if (plain !== null) return plain.sure ? null : t`Not sure: ${unsureWords(plain)}. Did you mean one of these?`;
  switch (seed.outcome) {
    case 'decided':
      return null;
    case 'split':
      return t`The ${seed.of} answers understand it in different ways. Which one did you mean?`;
    case 'unclear':
      return seed.reason === null ? t`The request is unclear.` : t`The request is unclear: “${seed.reason}”`;
    case 'none': {
      const first = refused.find(({ task }) => task === 'seed_edit')?.error;
      return first === undefined
        ? t`No answer could be used. Ask again, or say it in other words.`
        : t`No answer could be used. The first: ${first.cause}. Ask again, or say it in other words.`;
    }
  }
}
