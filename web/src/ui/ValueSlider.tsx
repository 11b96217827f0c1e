// A layer's slider, and its value as the length, angle or count that it changes: drag, type, double-click to reset,
// arrows (with Shift ten steps, with Alt a tenth), Page keys, Home and End.

import { useComputed, useSignal } from '@preact/signals';
import { useId } from 'preact/hooks';
import { models } from '../session/core';
import type { LayerEntry } from '../session/document';
import { nameOf } from '../session/document';
import { putAt } from '../session/extend';
import { titleOf } from '../session/layers';
import { formatMeasure, larger, type Measure, measureOf, parseMeasure } from '../session/measure';
import type { ModelCore } from '../session/model_core';
import { interrupt } from '../session/play';
import { readLayer, solveLayer } from '../session/reading';
import { compiled, document, settle, setValue, slide, sliderValue, step } from '../session/session';
import { snapped } from '../session/snapping';
import { m, number, t } from '../texts/texts';
import { Closed, stopWords } from './StackVerdict';
import { reasonOfEnd } from './slider_end';
import { cleanShares, Ends } from './TrackEnds';
import { trackShares } from './track';
import { inWords } from './why';

const steps = 200;

export function ValueSlider({ entry }: { entry: LayerEntry }) {
  const { parameter } = entry.layer;
  const { min, max } = parameter;
  const unit = (max - min) / steps || 1e-3;
  const reading = useComputed(() => readingOf(entry));
  const { text, measure, rest, now } = reading.value;
  const value = sliderValue(entry);
  const end = reasonOfEnd(entry, value);
  const stopped = entry.enabled ? stopWords(entry) : null;

  /** The next whole length where lengths snap, else one step of the slider. */
  const stepBy = (sign: number) => {
    const now = sliderValue(entry);
    const whole = snapped(entry, now, sign);
    setValue(entry.key, whole === now ? now + sign * unit : whole, true);
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const sign = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    if (sign === undefined || !(event.shiftKey || event.altKey)) return;
    event.preventDefault();
    setValue(entry.key, sliderValue(entry) + sign * unit * (event.shiftKey ? 10 : 0.1), true);
  };
  const share = (x: number) => (x - min) / (max - min || 1);
  return (
    <div class="value">
      <div
        class="track"
        style={{
          ...cleanShares(entry),
          ...trackShares(share, 0, value),
        }}
      >
        <Closed entry={entry} share={share} />
        <span class="zero" />
        <input
          type="range"
          min={min}
          max={max}
          step="any"
          value={value}
          disabled={!entry.enabled}
          aria-label={t`${titleOf(entry.layer)}: amount`}
          aria-valuetext={text}
          title={t`Double-click resets`}
          onPointerDown={interrupt}
          onInput={(event) => slide(entry.key, snapped(entry, event.currentTarget.valueAsNumber))}
          onChange={() => settle(entry.key)}
          onDblClick={() => setValue(entry.key, 0)}
          onKeyDown={(event) => {
            interrupt();
            if (!event.shiftKey && !event.altKey && event.key.startsWith('Arrow')) {
              // step="any" gives the arrows a step of 1 in some browsers
              event.preventDefault();
              const sign = event.key === 'ArrowRight' || event.key === 'ArrowUp' ? 1 : -1;
              stepBy(sign);
            } else onKeyDown(event);
          }}
        />
      </div>
      {measure && <Ends entry={entry} measure={measure} />}
      {measure && (
        <p class="measure">
          <span class="quiet">{measureName(measure)}</span>
          {value !== 0 && (
            <span class="from">
              {formatMeasure(measure.what, rest, larger(rest, now), document.value.unit)}{' '}
              <span aria-hidden="true">→</span>
            </span>
          )}
          <TypedValue entry={entry} measure={measure} now={now} rest={rest} />
        </p>
      )}
      {end !== null && <p class="quiet">{t`Ends here: further on, ${inWords(document.value, end)}.`}</p>}
      {stopped !== null && <p class="quiet stopped">{stopped}</p>}
    </div>
  );
}

const measureNames = {
  width: m`width`,
  height: m`height`,
  depth: m`depth`,
  count: m`count`,
  spacing: m`spacing`,
  distance: m`moved`,
  angle: m`turned`,
} as const;
export const measureName = ({ part, what }: Measure) => {
  const verb = t(measureNames[what]);
  return part === null ? verb : `${nameOf(document.value, part)} ${verb}`;
};

interface Reading {
  readonly text: string;
  readonly measure: Measure | null;
  readonly rest: number;
  readonly now: number;
}

const measures = new WeakMap<LayerEntry['layer'], Measure | null>();

function readingOf(drawn: LayerEntry): Reading {
  step.value; // reads the evaluator below, which is no signal
  const entry = document.value.layers.find(({ key }) => key === drawn.key) ?? drawn;
  const value = sliderValue(entry);
  const plain = { text: number(value, 2, 2), measure: null, rest: 0, now: 0 };
  const state = compiled.value;
  const shape = document.value.model?.shape;
  if (state.kind !== 'ready' || shape === undefined || !entry.enabled) return plain;
  const { layer } = entry;
  if (!measures.has(layer)) {
    const seed = layer.statements.find(({ why }) => why?.kind === 'seed') ?? layer.statements[0];
    measures.set(layer, measureOf(shape, seed));
  }
  const measure = measures.get(layer) ?? null;
  if (measure === null) return plain;
  const [rest = 0, now = 0] = readLayer(entry, measure, [0, value]);
  const { unit } = document.value;
  const before = formatMeasure(measure.what, rest, larger(rest, now), unit);
  const after = formatMeasure(measure.what, now, larger(rest, now), unit);
  return { text: t`${measureName(measure)} ${before} to ${after}`, measure, rest, now };
}

interface TypedValueProps {
  readonly entry: LayerEntry;
  readonly measure: Measure;
  readonly now: number;
  readonly rest: number;
}

function TypedValue({ entry, measure, now, rest }: TypedValueProps) {
  const typed = useSignal<string | null>(null);
  const wrong = useSignal(false);
  const ended = useSignal(false);
  const note = useId();
  const like = larger(rest, now);
  const { unit } = document.value;
  const commit = () => {
    if (typed.value === null) return;
    const wanted = parseMeasure(measure.what, typed.value, like, unit);
    wrong.value = wanted === null;
    if (wanted === null) return;
    typed.value = null;
    if (models.peek() === null) setValue(entry.key, solveLayer(entry, measure, wanted));
    else void putAt(models.peek() as ModelCore, entry, measure, wanted).then((reached) => (ended.value = !reached));
  };
  const said = wrong.value
    ? measure.what === 'count'
      ? t`Type a number.`
      : t`Type a number, such as ${formatMeasure(measure.what, now, like, unit)}.`
    : ended.value
      ? t`The slider goes no further.`
      : null;
  return (
    <>
      <input
        class="typed"
        type="text"
        inputMode="decimal"
        disabled={!entry.enabled}
        aria-label={t`${measureName(measure)}, type a value`}
        aria-invalid={wrong.value}
        aria-describedby={said === null ? undefined : note}
        value={typed.value ?? formatMeasure(measure.what, now, like, unit)}
        onFocus={(event) => event.currentTarget.select()}
        onInput={(event) => {
          typed.value = event.currentTarget.value;
          ended.value = false;
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
      {said !== null && (
        <span id={note} class="quiet typed-note" role="status">
          {said}
        </span>
      )}
    </>
  );
}
