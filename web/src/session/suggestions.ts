// Whom the page asks for proposals: a language model with the key of the settings, or the recordings of a gallery model.

import { AskError } from '../llm/ask_error';
import { browserCache } from '../llm/cache';
import { loadRecordings } from '../llm/recordings';
import { currentTarget, isDemo, votesFor } from '../llm/settings';
import { liveSource, recordedSource } from '../llm/source';
import { t } from '../texts/texts';
import { models } from './core';
import { isAsFound, type OpenModel } from './document';
import { createProposals } from './proposals';
import type { Asker } from './propose';
import { session } from './session';

/** Of each question about a proposal: there are a dozen proposals' worth of questions at once. */
const mostVotes = 3;

/** Models that refused a picture, by base and name. */
const blind = new Set<string>();

/**
 * @param votes how often a task that is asked on its own is asked
 * @throws AskError that says why nobody can be asked
 */
export async function askerOf(model: OpenModel, votes = 1): Promise<Asker> {
  if (isDemo.peek()) return recordedAsker(model);
  const target = currentTarget();
  const name = `${target.base} ${target.model}`;
  const options = { cache: browserCache };
  return {
    reader: liveSource(target, { ...options, votes: Math.min(votesFor('request'), mostVotes) }),
    proposer(_, picture) {
      if (picture === null) return liveSource(target, { ...options, votes });
      const drawn = target.provider.sees && !blind.has(name) ? picture() : null;
      return drawn === null ? null : liveSource(target, { ...options, votes, picture: drawn });
    },
    isBlind: () => blind.add(name),
  };
}

async function recordedAsker(model: OpenModel): Promise<Asker> {
  const { source } = model;
  const recordings = source.kind === 'gallery' && isAsFound(model) ? await loadRecordings(source.id) : null;
  if (recordings === null)
    throw new AskError(
      'no_recording',
      '',
      t`Without a key there are recorded suggestions for gallery models only`,
      t`Enter a key in the settings to ask about your own model`,
    );
  const recorded = recordedSource(recordings);
  return {
    reader: recorded,
    proposer(prompt, picture) {
      if (Object.hasOwn(recordings.replies, prompt.hash)) return recorded;
      if (picture !== null) return null;
      throw new AskError(
        'no_recording',
        '',
        prompt.task === 'request_variations'
          ? t`Without a key there are recorded readings of a few requests only, and this one is none of them`
          : t`There are no recorded suggestions for this model`,
        t`Enter a key in the settings to ask a language model`,
      );
    },
    isBlind: () => {},
  };
}

const parts = { session, models, askerOf: (model: OpenModel) => askerOf(model) };
/** Sliders for the model. */
export const suggestions = createProposals(parts);
/** Other readings of one layer's request. */
export const otherReadings = createProposals(parts);
