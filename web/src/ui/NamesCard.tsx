// Names that a language model suggests for the parts, as a list to correct: each line shows its part while it is pointed
// at. What is accepted labels all parts in one step.

import { models } from '../session/core';
import { names } from '../session/name_suggestions';
import type { Naming } from '../session/naming';
import { task } from '../session/session';
import { t } from '../texts/texts';
import { AskFailure } from './AskFailure';
import { Icon } from './Icon';
import { lazily } from './lazily';
import { paintNumbered } from './pictures';

const SuggestedNames = lazily(async () => (await import('./SuggestedNames')).SuggestedNames);

export function NamesCard() {
  const naming = names.naming.value;
  if (naming === null)
    return (
      <button
        type="button"
        class="button wide quiet"
        disabled={models.value === null || task.value !== null}
        title={t`A language model says what this is and what its parts are called, from their sizes and places alone`}
        onClick={() => void names.start(paintNumbered)}
      >
        {t`Suggest names for the parts`}
      </button>
    );
  return (
    <section class="names-card" aria-label={t`Suggested names`}>
      <header class="row">
        <h3 class="grow">{naming.category === '' ? t`Suggested names` : t`Looks like: ${naming.category}`}</h3>
        <button
          type="button"
          class="button icon-only"
          aria-label={t`Drop the names`}
          title={t`Drop`}
          onClick={names.close}
        >
          <Icon name="close" />
        </button>
      </header>
      {naming.progress !== null && <Waiting naming={naming} />}
      {naming.failure && <AskFailure {...naming.failure} />}
      {naming.rows.length > 0 && <SuggestedNames />}
    </section>
  );
}

function Waiting({ naming }: { naming: Naming }) {
  const { done, of } = naming.progress ?? { done: 0, of: 1 };
  return (
    <div class="row progress" role="status">
      <span class="spinner" aria-hidden="true" />
      <p class="grow quiet">
        {of > 1 ? t`Asking what the parts are, ${done} of ${of} answers` : t`Asking what the parts are`}
      </p>
      <button type="button" class="button outlined" onClick={names.close}>
        {t`Cancel`}
      </button>
    </div>
  );
}
