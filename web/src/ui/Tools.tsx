// Below the view: whole centimetres while one drags, and a ruler between two points.

import { useSignalEffect } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { nameOf } from '../session/document';
import { formatMeasure } from '../session/measure';
import { measured, ruler, setPoint, toggleRuler } from '../session/ruler';
import { document, selected } from '../session/session';
import { snap, snapping } from '../session/snapping';
import { m, t } from '../texts/texts';
import { Icon } from './Icon';
import { stage } from './view';

const along = [m`{0} across`, m`{0} up`, m`{0} deep`] as const;

export function Tools() {
  const { model, unit } = document.value;
  if (model === null) return null;
  const step = unit === 'in' ? '1 in' : '1 cm';
  return (
    <div class="tools">
      <button
        type="button"
        class="button"
        aria-pressed={snapping.value}
        aria-label={t`Snap to ${step}`}
        title={
          unit === 'in'
            ? t`What is dragged stops at whole inches (S)`
            : t`What is dragged stops at whole centimetres (S)`
        }
        onClick={() => snap(!snapping.peek())}
      >
        <Icon name="snap" />
        {step}
      </button>
      <button
        type="button"
        class="button icon-only"
        aria-pressed={ruler.value !== null}
        aria-label={t`Ruler`}
        title={t`Measure between two points (R)`}
        onClick={toggleRuler}
      >
        <Icon name="ruler" />
      </button>
    </div>
  );
}

/** What the ruler reads. Parts that are selected in the list are measured from middle to middle. */
export function RulerCard() {
  const now = measured.value;
  const last = useRef<string | null>(null);
  useSignalEffect(() => {
    const part = selected.value.at(-1) ?? null;
    if (part !== null && part !== last.current && ruler.peek() !== null) setPoint(part, [0, 0, 0]);
    last.current = part;
  });
  useSignalEffect(() => stage.value?.showRuler(measured.value?.points ?? null));
  const isGone = ruler.value !== null && ruler.value.length > 0 && now?.points.length === 0;
  useEffect(() => {
    if (isGone) ruler.value = []; // another model
  }, [isGone]);
  if (ruler.value === null || now === null) return null;
  const { unit } = document.value;
  const length = (metres: number, like = metres) => formatMeasure('distance', metres, like, unit);
  const names = ruler.value.map(({ part }) => nameOf(document.value, part));
  return (
    <section class="panel note" aria-label={t`Ruler`}>
      <p class="grow" role="status">
        {now.length === null ? (
          names.length === 0 ? (
            t`Click two points of the model, or select two parts in the list.`
          ) : (
            t`From ${names[0] ?? ''}: click the other point.`
          )
        ) : (
          <>
            <strong>{length(now.length.whole)}</strong>{' '}
            <span class="quiet">
              {names[0] === names[1] ? t`on ${names[0] ?? ''}` : t`from ${names[0] ?? ''} to ${names[1] ?? ''}`} ·{' '}
              {now.length.along
                .map((metres, i) => t(along[i] ?? along[0], length(metres, now.length?.whole)))
                .join(', ')}
            </span>
          </>
        )}
      </p>
      <button type="button" class="button icon-only" aria-label={t`Put the ruler away`} onClick={toggleRuler}>
        <Icon name="close" />
      </button>
    </section>
  );
}
