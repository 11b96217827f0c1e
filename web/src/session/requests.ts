// The page's own requests: who is asked, and what without a key is asked of recordings. What has none is read without a
// language model (request.ts).

import { AskError } from '../llm/ask_error';
import { browserCache } from '../llm/cache';
import { findRecorded, loadRecordings } from '../llm/recordings';
import { currentTarget, isDemo, votesFor } from '../llm/settings';
import { liveSource, recordedSource } from '../llm/source';
import type { Statement } from '../program/types';
import { t } from '../texts/texts';
import { models } from './core';
import { divide } from './divide';
import { isAsFound, type OpenModel, partNames } from './document';
import { facing, speaksAsSeen } from './facing';
import { type Said, saidFrom } from './looking';
import { playOnce } from './play';
import { createRequests, type Question } from './request';
import { session } from './session';
import { aimAt } from './target';

const seen = () => (speaksAsSeen.peek() ? facing.peek() : null);

const galleryOf = ({ source }: OpenModel): string | null => (source.kind === 'gallery' ? source.id : null);

/** @throws AskError that says why nobody can be asked */
async function questionOf(
  model: OpenModel,
  { typed, own, told }: Said,
  parts: readonly string[],
  afresh: boolean,
): Promise<Question> {
  if (!isDemo.peek()) {
    const source = liveSource(currentTarget(), { votes: votesFor('request'), cache: browserCache, afresh });
    return { request: told, title: typed, mentioned: parts, source };
  }
  if (!isAsFound(model))
    throw new AskError(
      'no_recording',
      '',
      t`The recorded answers are about the parts as the file has them, and some have other labels or joints now`,
      t`Reset those, or enter a key in the settings to ask anything`,
    );
  const gallery = galleryOf(model);
  const recordings = gallery === null ? null : await loadRecordings(gallery);
  const known = findRecorded(recordings, own, parts);
  if (recordings === null || recordings.requests.length === 0)
    throw new AskError(
      'no_recording',
      '',
      t`Without a key only recorded requests work, and there are none for this model`,
      t`Enter a key in the settings to ask anything, or edit by hand`,
    );
  if (known === undefined)
    throw new AskError(
      'no_recording',
      '',
      t`This request has no recorded answer`,
      t`Try one of the recorded ones below, or enter a key in the settings to ask anything`,
    );
  return { ...known, title: own === typed ? known.request : typed, source: recordedSource(recordings) };
}

/** The questions to the letter that what is typed would ask, whoever is asked; none while nothing is, or no model is open. */
export async function questionTexts(): Promise<readonly string[]> {
  const core = models.peek();
  const { model } = session.document.peek();
  const text = requestText.peek().trim();
  if (core === null || model === null || text === '') return [];
  const { told } = saidFrom(text, seen(), partNames(session.document.peek()));
  return (await core.prompts(model, told, mentioned.peek())).prompts.map((prompt) => prompt.text);
}

export const {
  applyRequest,
  askAgain,
  cancelRequest,
  chooseReading,
  correctEdit,
  dismiss,
  estimateRequest,
  forgetOtherModels,
  mention,
  mentioned,
  readFrom,
  request,
  requestLayer,
  requestText,
  sendRequest,
  unmention,
} = createRequests({
  session,
  models,
  questionOf,
  seen,
  votes: () => (isDemo.peek() ? null : votesFor('request')),
  play: playOnce,
  aim: (key, target) => void aimAt(models.peek(), key, target),
});

/** Gives each change of what was understood a slider of its own. @param title of the layer of a change */
export async function divideRequest(title: (statement: Statement) => string): Promise<void> {
  const core = models.peek();
  const state = request.peek();
  if (core === null || state.kind !== 'understood') return;
  if ((await divide(session, core, state, title)) && request.peek() === state) dismiss();
}
