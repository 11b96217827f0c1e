// Width, height and depth of the selected part, or of everything, as the sliders move; a length that is typed moves the
// fitting slider, or makes it. The unit of all lengths is chosen here.

import { useSignal } from '@preact/signals';
import { models } from '../session/core';
import { type LengthUnit, lengthUnits, nameOf } from '../session/document';
import { formatLengths, parseMeasure, type Size, sizeOf } from '../session/measure';
import { setUnit } from '../session/page_cards';
import { compiled, document, selection, step, task } from '../session/session';
import { setLength } from '../session/sizes';
import { t } from '../texts/texts';
import { lengthWords } from './words';

export function Dimensions() {
  step.value; // reads the evaluator below, which is no signal
  const state = compiled.value;
  const { model, unit } = document.value;
  if (state.kind !== 'ready' || model === null) return null;
  const id = selection.value?.part;
  const index = model.shape.parts.findIndex((other) => other.id === id);
  const part = id !== undefined && index >= 0 ? id : null;
  const size = sizeOf(model.shape, state.evaluator, part === null ? null : index);
  const { lengths, unit: shown } = formatLengths(size, unit);
  const name = part === null ? '' : nameOf(document.value, part);
  return (
    <fieldset class="dimensions" aria-label={part === null ? t`Size of the model` : t`Size of ${name}`}>
      {part !== null && <span class="quiet">{name} </span>}
      {lengthWords.map((what, axis) => (
        <span key={`${part} ${axis}`}>
          {axis > 0 && <span aria-hidden="true"> × </span>}
          <Length
            part={part}
            axis={axis as 0 | 1 | 2}
            size={size}
            text={lengths[axis] ?? ''}
            label={`${name} ${t(what)}`.trim()}
          />
        </span>
      ))}
      <select
        aria-label={t`Unit of lengths`}
        title={t`Unit of lengths`}
        value={unit ?? ''}
        onChange={(event) => setUnit((event.currentTarget.value || null) as LengthUnit | null)}
      >
        <option value="">{unit === undefined ? shown : t`auto`}</option>
        {lengthUnits.map((one) => (
          <option key={one} value={one}>
            {one}
          </option>
        ))}
      </select>
    </fieldset>
  );
}

interface LengthProps {
  readonly part: string | null;
  readonly axis: 0 | 1 | 2;
  readonly size: Size;
  readonly text: string;
  readonly label: string;
}

function Length({ part, axis, size, text, label }: LengthProps) {
  const typed = useSignal<string | null>(null);
  const wrong = useSignal(false);
  const commit = () => {
    const core = models.peek();
    if (typed.value === null || core === null) return;
    const wanted = parseMeasure('width', typed.value, Math.max(...size), document.peek().unit);
    wrong.value = wanted === null || wanted <= 0;
    if (wanted === null || wanted <= 0) return;
    const changed = typed.value.trim() !== text;
    typed.value = null;
    if (changed) void setLength(core, part, axis, wanted);
  };
  const shown = typed.value ?? text;
  return (
    <input
      class="length"
      type="text"
      inputMode="decimal"
      size={Math.max(2, shown.length)}
      value={shown}
      disabled={task.value !== null}
      aria-label={t`${label}, type a length`}
      aria-invalid={wrong.value}
      title={t`${label}: type a length`}
      onFocus={(event) => event.currentTarget.select()}
      onInput={(event) => {
        typed.value = event.currentTarget.value;
      }}
      onBlur={commit}
      onKeyDown={(event) => {
        if (event.key === 'Enter') commit();
        if (event.key === 'Escape') {
          typed.value = null;
          wrong.value = false;
        }
      }}
    />
  );
}
