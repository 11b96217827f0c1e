// A request in words: asked of a language model, read, and propagated into a layer. What was understood stays at hand, so
// that each line of it can be corrected; the layer is then made anew in place of the one before.
import { batch, computed, effect, signal, untracked } from '@preact/signals';
import { AskError } from '../llm/ask_error';
import { browserCache } from '../llm/cache';
import { findRecorded, loadRecordings } from '../llm/recordings';
import { type Answer, ask, type Estimate, estimate, type TaskProgress } from '../llm/session';
import { currentTarget, isDemo, settings } from '../llm/settings';
import { liveSource, recordedSource, type Source } from '../llm/source';
import type { Layer } from '../program/types';
import type { Inference } from '../worker/protocol';
import { models } from './core';
import type { EditInput, OpenModel } from './document';
import { playOnce } from './play';
import { document, propagate, redo, removeLayer, sentence, undo, undoLabel } from './session';

/** What is typed, and the ids of the parts that were pointed at. Emptied only when a layer came of it. */
export const requestText = signal('');
export const mentioned = signal<readonly string[]>([]);

export function mention(id: string): void {
  if (!mentioned.peek().includes(id)) mentioned.value = [...mentioned.peek(), id];
}
export function unmention(id: string): void {
  mentioned.value = mentioned.peek().filter((other) => other !== id);
}

/** A request with what was understood of it. */
export interface Understood {
  readonly kind: 'understood';
  readonly model: OpenModel;
  readonly request: string;
  /** The text that was sent, as it was typed. */
  readonly typed: string;
  readonly mentioned: readonly string[];
  readonly answer: Answer;
  /** As corrected by hand; null when there is no reading to begin with. */
  readonly edit: EditInput | null;
  /** Which of the readings the edit's seed is. */
  readonly reading: number;
  /** Of the layer that came of it; null before. */
  readonly key: number | null;
}

export type RequestState =
  | { readonly kind: 'idle' }
  | { readonly kind: 'asking'; readonly tasks: readonly TaskProgress[]; readonly cancel: () => void }
  | { readonly kind: 'failed'; readonly text: string; readonly isSetting: boolean }
  | Understood;

export const request = signal<RequestState>({ kind: 'idle' });

/** The layer of the present request, while it is in the document: undo takes it out. */
export const requestLayer = computed<Layer | null>(() => {
  const state = request.value;
  if (state.kind !== 'understood' || state.key === null) return null;
  return document.value.layers.find(({ key }) => key === state.key)?.layer ?? null;
});

export function dismiss(): void {
  if (request.peek().kind !== 'asking') request.value = { kind: 'idle' };
}

/** What was said of another model is of no use for this one. What is typed stays. */
export function forgetOtherModels(): () => void {
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
}

export function cancelRequest(): void {
  const state = request.peek();
  if (state.kind === 'asking') state.cancel();
}

/** Failures that the settings can cure. */
const settingFailures = ['settings', 'no_key', 'wrong_key', 'no_credit', 'model_unknown', 'blocked', 'no_recording'];

function fail(error: unknown): void {
  const isSetting = error instanceof AskError && settingFailures.includes(error.kind);
  request.value = { kind: 'failed', text: sentence(error), isSetting };
}

const galleryOf = ({ source }: OpenModel): string | null => (source.kind === 'gallery' ? source.id : null);

interface Question {
  readonly request: string;
  readonly mentioned: readonly string[];
  readonly source: Source;
}

/** @throws AskError that says why nobody can be asked */
async function questionOf(model: OpenModel, afresh: boolean): Promise<Question> {
  const text = requestText.peek().trim();
  const parts = mentioned.peek().filter((id) => model.shape.parts.some((part) => part.id === id));
  if (!isDemo.peek()) {
    const source = liveSource(currentTarget(), { votes: settings.peek().votes, cache: browserCache, afresh });
    return { request: text, mentioned: parts, source };
  }
  if (model.labels.size > 0)
    throw new AskError(
      'no_recording',
      '',
      'The recorded answers are about the parts as the file names them, and some have other labels now',
      'Reset those labels, or enter a key in the settings to ask anything',
    );
  const gallery = galleryOf(model);
  const recordings = gallery === null ? null : await loadRecordings(gallery);
  const known = findRecorded(recordings, text, parts);
  if (recordings === null || recordings.requests.length === 0)
    throw new AskError(
      'no_recording',
      '',
      'Without a key only recorded requests work, and there are none for this model',
      'Enter a key in the settings to ask anything, or edit by hand',
    );
  if (known === undefined)
    throw new AskError(
      'no_recording',
      '',
      'This request has no recorded answer',
      'Try one of the recorded ones below, or enter a key in the settings to ask anything',
    );
  return { ...known, source: recordedSource(recordings) };
}

/** Asks the same once more, answers that were kept included. What comes of it takes the place of what came before. */
export async function askAgain(before: Understood): Promise<void> {
  requestText.value = before.typed;
  mentioned.value = before.mentioned;
  await sendRequest(before);
}

/** Asks what is typed. */
export async function sendRequest(before: Understood | null = null): Promise<void> {
  const core = models.peek();
  const { model } = document.peek();
  if (requestText.peek().trim() === '' || request.peek().kind === 'asking') return;
  if (core === null || model === null)
    return fail(new Error(model === null ? 'Open a model first' : 'The core is still starting; try again in a moment'));

  const controller = new AbortController();
  const { signal } = controller;
  const typed = requestText.peek();
  const parts = mentioned.peek();
  const cancel = () => controller.abort();
  request.value = { kind: 'asking', tasks: [], cancel };
  try {
    const question = await questionOf(model, before !== null);
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
    signal.throwIfAborted();
    if (document.peek().model !== model) throw new Error('Another model was opened meanwhile; send the request again');
    const read = answer.inference.edit as Partial<EditInput> | null;
    const edit = read && { seed: [], disabled: [], hints: {}, ...read };
    request.value = {
      kind: 'understood',
      model,
      request: question.request,
      typed,
      mentioned: parts,
      answer,
      edit,
      reading: 0,
      key: before?.key ?? null,
    };
    if (edit !== null && answer.inference.seed.outcome === 'decided') await applyRequest();
  } catch (error) {
    if (signal.aborted) request.value = { kind: 'idle' };
    else fail(error);
  }
}

/** Calls and tokens that sending would take; null where nothing is paid for. */
export async function estimateRequest(): Promise<Estimate | null> {
  const core = models.peek();
  const { model } = document.peek();
  const text = requestText.peek().trim();
  if (isDemo.peek() || core === null || model === null || text === '') return null;
  const { prompts } = await core.prompts(model, text, mentioned.peek());
  return estimate(prompts, settings.peek().votes);
}

let attempt = 0;
/** How the layer of the present request was taken out of the document, while it is made anew. */
let withdrawn: 'undone' | 'removed' | null = null;

/** Takes another reading of the request. */
export function chooseReading(reading: number): void {
  const state = request.peek();
  if (state.kind !== 'understood') return;
  const statements = state.answer.inference.seed.readings[reading]?.statements;
  if (statements === undefined) return;
  const others = state.edit ?? { disabled: [], hints: {} };
  // The core has checked the statements against the shape.
  const seed = statements as unknown as EditInput['seed'];
  correct({ ...state, reading, edit: { ...others, seed } });
}

/** Changes the seed, hints or the relations that may break. */
export function correctEdit(change: Partial<EditInput>): void {
  const state = request.peek();
  if (state.kind === 'understood' && state.edit !== null) correct({ ...state, edit: { ...state.edit, ...change } });
}

function correct(state: Understood): void {
  const isApplied = requestLayer.peek() !== null || withdrawn !== null;
  request.value = state;
  if (isApplied) void applyRequest();
}

function withdraw(key: number | null, label: string): typeof withdrawn {
  const has = () => document.peek().layers.some((entry) => entry.key === key);
  if (!has()) return null;
  if (undoLabel.peek() === label) {
    undo(); // so that the corrected layer is still one step
    if (!has()) return 'undone';
    redo();
  }
  if (key !== null) removeLayer(key);
  return 'removed';
}

/** Propagates what was understood, in place of the layer that came of it before. */
export async function applyRequest(): Promise<void> {
  const core = models.peek();
  const state = request.peek();
  if (core === null || state.kind !== 'understood' || state.edit === null) return;
  const own = ++attempt;
  withdrawn ??= withdraw(state.key, state.request);
  const key = await propagate(core, state.edit, state.request);
  if (own !== attempt) return; // a later correction goes on from here
  const taken = withdrawn;
  withdrawn = null;
  if (key === null) {
    if (taken === 'undone') redo();
    else if (taken === 'removed') undo();
    return;
  }
  const now = request.peek();
  batch(() => {
    if (now.kind === 'understood' && now.answer === state.answer) request.value = { ...now, key };
    if (requestText.peek() === state.typed) {
      requestText.value = '';
      mentioned.value = [];
    }
  });
  playOnce(key);
}

/** Why there is no clear reading, as a sentence; null when there is. */
export function whyUndecided({ seed, refused }: Inference): string | null {
  switch (seed.outcome) {
    case 'decided':
      return null;
    case 'split':
      return `The ${seed.of} answers understand it in different ways. Which one did you mean?`;
    case 'unclear':
      return seed.reason === null ? 'The request is unclear.' : `The request is unclear: “${seed.reason}”`;
    case 'none': {
      const first = refused.find(({ task }) => task === 'seed_edit')?.error;
      const why = first === undefined ? '' : ` The first: ${first.cause}.`;
      return `No answer could be used.${why} Ask again, or say it in other words.`;
    }
  }
}
