// Below the view: whole centimetres while one drags, and a ruler between two points.
import { useSignalEffect } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { nameOf } from '../session/document';
import { formatMeasure } from '../session/measure';
import { measured, ruler, setPoint, toggleRuler } from '../session/ruler';
import { document, selected } from '../session/session';
import { snap, snapping } from '../session/snapping';
import { Icon } from './Icon';
import { stage } from './view';

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
        aria-label={`Snap to ${step}`}
        title={`What is dragged stops at whole ${unit === 'in' ? 'inches' : 'centimetres'} (S)`}
        onClick={() => snap(!snapping.peek())}
      >
        <Icon name="snap" />
        {step}
      </button>
      <button
        type="button"
        class="button icon-only"
        aria-pressed={ruler.value !== null}
        aria-label="Ruler"
        title="Measure between two points (R)"
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
    <section class="panel note" aria-label="Ruler">
      <p class="grow" role="status">
        {now.length === null ? (
          names.length === 0 ? (
            'Click two points of the model, or select two parts in the list.'
          ) : (
            `From ${names[0]}: click the other point.`
          )
        ) : (
          <>
            <strong>{length(now.length.whole)}</strong>{' '}
            <span class="quiet">
              {names[0] === names[1] ? `on ${names[0]}` : `from ${names[0]} to ${names[1]}`} ·{' '}
              {now.length.along
                .map((metres, i) => `${length(metres, now.length?.whole)} ${['across', 'up', 'deep'][i]}`)
                .join(', ')}
            </span>
          </>
        )}
      </p>
      <button type="button" class="button icon-only" aria-label="Put the ruler away" onClick={toggleRuler}>
        <Icon name="close" />
      </button>
    </section>
  );
}
