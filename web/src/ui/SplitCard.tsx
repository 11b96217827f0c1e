// What is said of a model in one piece: the offer to tell its parts apart, and, when that is done, how fine.

import { useSignal } from '@preact/signals';
import type { SplitBy } from '../scene/load';
import { models } from '../session/core';
import { document, task } from '../session/session';
import {
  declineSplit,
  findWays,
  isSplitSo,
  offersSplit,
  splitDefaults,
  splitModel,
  splitNow,
  type Ways,
  waysNow,
} from '../session/splitting';
import { m, plural, type Sentence, t } from '../texts/texts';
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

/** Beside the list of parts: the ways to split the model, and how fine it was split. */
export function SplitCard() {
  const now = splitNow.value;
  const ways = waysNow.value;
  const isEdited = document.value.layers.length > 0;
  const isOff = models.value === null || task.value !== null || isEdited || now?.isCarved === true;
  const why = now?.isCarved
    ? t`Undo what was changed by hand to split the model anew`
    : isEdited
      ? t`Take the edits back first: they belong to the parts as they are`
      : null;
  return (
    <section class={now || ways ? 'split-card' : ''} aria-label={t`Splitting`}>
      {now && <Fine now={now} isOff={isOff} why={why} />}
      {ways === null ? (
        <button
          type="button"
          class="button wide quiet"
          disabled={isOff}
          title={why ?? t`Looks for what comes apart: by what hangs together, by material, along creases`}
          onClick={() => models.value && void findWays(models.value)}
        >
          {now ? t`Split it another way` : t`Split into parts`}
        </button>
      ) : (
        <WayChoice ways={ways} now={now} isOff={isOff} why={why} />
      )}
    </section>
  );
}

type SplitNow = NonNullable<typeof splitNow.value>;

interface ChoiceProps {
  readonly isOff: boolean;
  /** Why it cannot be split now. */
  readonly why: string | null;
}

const wayWords: Readonly<Record<SplitBy, Sentence>> = {
  auto: m`As seems best`,
  components: m`By what hangs together`,
  materials: m`By material`,
  regions: m`Along creases`,
};

/** Each way with what it gives; a click splits so. */
function WayChoice({ ways, now, isOff, why }: ChoiceProps & { ways: Ways; now: SplitNow | null }) {
  if (ways.found.length === 0) return <p class="quiet">{t`Nothing comes apart by itself.`}</p>;
  return (
    <ul class="ways" aria-label={t`Ways to split it`}>
      {now === null && ways.found.some(({ isTooMany }) => isTooMany) && (
        <li>
          <button
            type="button"
            class="button wide"
            disabled={isOff}
            title={why ?? t`Small pieces go to what they sit on, until there are few enough`}
            onClick={() => models.value && void splitModel(models.value, 'auto', ways.fine)}
          >
            {t(wayWords.auto)}
          </button>
        </li>
      )}
      {ways.found.map((way) => {
        const { by, parts, isTooMany } = way;
        const isDone = isSplitSo(now, way);
        return (
          <li key={by}>
            <button
              type="button"
              class="button wide"
              aria-pressed={isDone}
              disabled={isOff || isTooMany}
              title={why ?? (isTooMany ? t`More parts than a model may have: split it coarser` : undefined)}
              onClick={() => models.value && !isDone && void splitModel(models.value, by, ways.fine)}
            >
              <span>{t(wayWords[by])}</span>
              <span class="quiet way-count">{plural(parts, '{n} part', '{n} parts')}</span>
            </button>
          </li>
        );
      })}
    </ul>
  );
}

function Fine({ now, isOff, why }: ChoiceProps & { now: SplitNow }) {
  const dragged = useSignal<number | null>(null);
  return (
    <>
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
        disabled={isOff}
        title={why ?? t`Left: small pieces go to what they sit on`}
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
    </>
  );
}

const fineWords = (fine: number): string =>
  fine >= 1 ? t`every piece is a part` : fine <= 0 ? t`large parts only` : t`${Math.round(fine * 100)} % fine`;
