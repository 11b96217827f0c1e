// What all sliders do together: somewhere at random, or nine siblings to choose from.

import { models } from '../session/core';
import { compiled, task } from '../session/session';
import { surprise } from '../session/siblings';
import { t } from '../texts/texts';
import { dialog } from './actions';
import { Icon } from './Icon';

export function Together() {
  const state = compiled.value;
  const isIdle = models.value !== null && task.value === null && state.kind === 'ready' && state.keys.length > 0;
  return (
    <div class="row hand-buttons">
      <button
        type="button"
        class="button wide"
        title={t`Puts all sliders somewhere in their ranges`}
        disabled={!isIdle}
        onClick={() => void surprise()}
      >
        <Icon name="dice" /> {t`Surprise me`}
      </button>
      <button
        type="button"
        class="button wide"
        title={t`Nine ways to put the sliders, to choose from`}
        disabled={!isIdle}
        aria-haspopup="dialog"
        onClick={() => (dialog.value = 'explore')}
      >
        <Icon name="grid" /> {t`Explore`}
      </button>
    </div>
  );
}
