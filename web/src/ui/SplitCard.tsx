// What is said of a model in one piece: the offer to tell its parts apart, and, when that is done, how fine.

import { useSignal } from '@preact/signals';
import { models } from '../session/core';
import { document, task } from '../session/session';
import { declineSplit, offersSplit, splitDefaults, splitModel, splitNow } from '../session/splitting';
import { t } from '../texts/texts';
import { Icon } from './Icon';

/** In the middle of the page, where the model is: the offer. */
export function SplitOffer() {
  if (!offersSplit.value || task.value) return null;
  const { by, fine } = splitDefaults;
  return (
    <section class="panel note tour-offer" aria-label={t`Parts`}>
      <span>{t`This model has hardly any parts to edit.`}</span>
      <button
        type="button"
        class="button"
        disabled={models.value === null}
        onClick={() => models.value && void splitModel(models.value, by, fine)}
      >
        {t`Split it into parts`}
      </button>
      <button type="button" class="button icon-only" aria-label={t`Leave it in one piece`} onClick={declineSplit}>
        <Icon name="close" />
      </button>
    </section>
  );
}

/** Beside the list of parts: how fine the model was split. */
export function SplitCard() {
  const now = splitNow.value;
  const dragged = useSignal<number | null>(null);
  const isEdited = document.value.layers.length > 0;
  if (now === null) {
    const { by, fine } = splitDefaults;
    return (
      <button
        type="button"
        class="button wide quiet"
        disabled={models.value === null || task.value !== null || isEdited}
        title={
          isEdited
            ? t`Take the edits back first: they belong to the parts as they are`
            : t`What does not hang together becomes parts of its own`
        }
        onClick={() => models.value && void splitModel(models.value, by, fine)}
      >
        {t`Split parts that fall apart`}
      </button>
    );
  }
  return (
    <section class="split-card" aria-label={t`Splitting`}>
      <label for="split-fine">
        {t`Split into ${now.parts} parts`} <span class="quiet">{t`how fine`}</span>
      </label>
      <input
        id="split-fine"
        type="range"
        min={0}
        max={1}
        step={0.05}
        value={dragged.value ?? now.fine}
        disabled={models.value === null || task.value !== null || isEdited || now.isCarved}
        title={
          now.isCarved
            ? t`Undo what was changed by hand to split the model anew`
            : isEdited
              ? t`Take the edits back to split the model anew`
              : t`Left: small pieces go to what they sit on`
        }
        aria-valuetext={fineWords(dragged.value ?? now.fine)}
        onInput={(event) => {
          dragged.value = event.currentTarget.valueAsNumber;
        }}
        onChange={(event) => {
          const fine = event.currentTarget.valueAsNumber;
          if (models.value === null) return;
          void splitModel(models.value, now.by, fine).finally(() => {
            dragged.value = null;
          });
        }}
      />
    </section>
  );
}

const fineWords = (fine: number): string =>
  fine >= 1 ? t`every piece is a part` : fine <= 0 ? t`large parts only` : t`${Math.round(fine * 100)} % fine`;
