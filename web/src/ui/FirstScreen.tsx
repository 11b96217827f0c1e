// What stands on an empty stage: how to begin.

import { awaited, offered } from '../session/open';
import { document, task } from '../session/session';
import { t } from '../texts/texts';
import { dialog } from './actions';
import { GoodModel } from './DropZone';
import { Icon } from './Icon';

export function FirstScreen() {
  if (document.value.model !== null || task.value || awaited.value !== null || offered.value !== null) return null;
  return (
    <section class="first panel" aria-label={t`Begin`}>
      <h2>{t`Open a model, say what to change, get sliders`}</h2>
      <p>{t`Drop a file anywhere on this page.`}</p>
      <button type="button" class="button primary" onClick={() => (dialog.value = 'open')}>
        <Icon name="open" /> {t`Open a model…`}
      </button>
      <GoodModel />
    </section>
  );
}
