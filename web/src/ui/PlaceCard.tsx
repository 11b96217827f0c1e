// How the model stands and how large it is: offered where the file seems to say it otherwise, and to be changed.

import { type Direction, turnedRound, turnedTo, turnedUp } from '../carve/placing';
import { whyUncarvable } from '../session/carving';
import { models } from '../session/core';
import { formatLengths, formatMeasure } from '../session/measure';
import {
  decline,
  declined,
  extentOf,
  fileUnits,
  fronts,
  place,
  placingOf,
  seemsDrawnIn,
  seemsFront,
  seemsUp,
} from '../session/placing';
import { document, task } from '../session/session';
import { m, type Sentence, t } from '../texts/texts';
import { Icon } from './Icon';
import { sideName } from './words';

const lying: Readonly<Record<Exclude<Direction, '+y'>, Sentence>> = {
  '+x': m`It seems to lie on its right side.`,
  '-x': m`It seems to lie on its left side.`,
  '-y': m`It seems to stand on its head.`,
  '+z': m`It seems to lie on its back.`,
  '-z': m`It seems to lie on its front.`,
};

const facing = {
  '+x': 'left',
  '-x': 'right',
  '+y': 'top',
  '-y': 'bottom',
  '+z': 'front',
  '-z': 'back',
} as const;

/** In the middle of the page, where the model is: the offer. */
export function PlaceOffer() {
  const { model, unit } = document.value;
  const core = models.value;
  if (model === null || core === null || task.value !== null || declined.value.has(model.files)) return null;
  if (whyUncarvable(document.value) !== null) return null;
  const now = placingOf(model.files);
  const up = seemsUp(model.shape);
  const metres = seemsDrawnIn(model.shape, now);
  const front = fronts.value.get(model.files) ?? seemsFront(model.shape);
  if (up === null && metres === null && front === '+z') return null;
  const [, height] = extentOf(model.shape);
  const longest = Math.max(...extentOf(model.shape));
  const length = (value: number) => formatMeasure('height', value, value, unit);
  return (
    <section class="panel note tour-offer" aria-label={t`How it stands`}>
      {up !== null ? (
        <>
          <span>{up !== '+y' && t(lying[up])}</span>
          <button type="button" class="button" onClick={() => void place(core, turnedUp(now, up))}>
            {t`Stand it up`}
          </button>
        </>
      ) : (
        metres !== null && (
          <>
            <span>
              {longest > 2 * height
                ? t`This model is ${length(height)} high and ${length(longest)} long.`
                : t`This model is ${length(height)} high.`}
            </span>
            <button type="button" class="button" onClick={() => void place(core, { ...now, metres })}>
              {t`Make it ${length(height * metres)} high`}
            </button>
          </>
        )
      )}
      {up === null && metres === null && (
        <>
          <span>{t`Its front seems to be what is its ${sideName(facing[front])} here.`}</span>
          <button type="button" class="button" onClick={() => void place(core, turnedTo(now, front))}>
            {t`Turn it round`}
          </button>
        </>
      )}
      <button
        type="button"
        class="button icon-only"
        aria-label={t`Leave it as it is`}
        onClick={() => decline(model.files)}
      >
        <Icon name="close" />
      </button>
    </section>
  );
}

/** Below the list of parts: how it stands, to be changed. */
export function PlaceCard() {
  const { model, unit } = document.value;
  const core = models.value;
  if (model === null || core === null) return null;
  const now = placingOf(model.files);
  const why = whyUncarvable(document.value);
  const isOff = why !== null || task.value !== null;
  const { lengths, unit: shown } = formatLengths(extentOf(model.shape), unit);
  const units = fileUnits.some(({ metres }) => metres === now.metres)
    ? fileUnits
    : [...fileUnits, { metres: now.metres, label: m`{0} metres` }];
  return (
    <details class="place-card">
      <summary>{t`How it stands, and how large it is`}</summary>
      <p class="quiet">
        {t`${lengths.join(' × ')} ${shown}, width, height and depth. What is shown and said follows; the file is exported as it was, unless you choose otherwise.`}
      </p>
      <div class="chips">
        {(
          [
            ['+z', t`Tip it backwards`],
            ['+x', t`Tip it to its right`],
          ] as const
        ).map(([up, label]) => (
          <button
            key={up}
            type="button"
            class="chip-button"
            disabled={isOff}
            title={why ?? t`By a quarter`}
            onClick={() => void place(core, turnedUp(now, up))}
          >
            {label}
          </button>
        ))}
        <button
          type="button"
          class="chip-button"
          disabled={isOff}
          title={why ?? t`By a quarter: what is its right becomes its front`}
          onClick={() => void place(core, turnedRound(now))}
        >
          {t`Turn it round`}
        </button>
      </div>
      <label>
        <span class="quiet">{t`A unit of the file is one of`}</span>{' '}
        <select
          value={String(now.metres)}
          disabled={isOff}
          title={why ?? undefined}
          onChange={(event) => void place(core, { ...now, metres: Number(event.currentTarget.value) })}
        >
          {units.map(({ metres, label }) => (
            <option key={metres} value={String(metres)}>
              {t(label, metres)}
            </option>
          ))}
        </select>
      </label>
    </details>
  );
}
