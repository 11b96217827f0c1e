// Whom the page asks about kinds of a CAD program's thing: a language model with the key of the settings, or the
// recordings of the gallery's programs.

import { AskError } from '../llm/ask_error';
import { browserCache } from '../llm/cache';
import { loadRecordings } from '../llm/recordings';
import { currentTarget, isDemo, votesFor } from '../llm/settings';
import { liveSource, recordedSource, type Source } from '../llm/source';
import { t } from '../texts/texts';
import { models } from './core';
import type { OpenModel } from './document';
import { createKinds } from './kinds';
import { session } from './session';

/** @throws AskError that says why nobody can be asked */
async function sourceOf({ source }: OpenModel): Promise<Source> {
  if (!isDemo.peek()) return liveSource(currentTarget(), { cache: browserCache, votes: votesFor('kinds') });
  const recordings = source.kind === 'gallery' ? await loadRecordings(source.id) : null;
  if (recordings === null)
    throw new AskError(
      'no_recording',
      '',
      t`Without a key there are recorded kinds for the programs of the gallery only`,
      t`Enter a key in the settings to ask about your own program`,
    );
  return recordedSource(recordings, {
    cause: t`Nothing is recorded for this kind`,
    fix: t`Enter a key in the settings to ask a language model`,
  });
}

export const kinds = createKinds({ session, models, sourceOf });
