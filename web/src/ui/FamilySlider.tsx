// A slider of a family: drags and types like any other, and stops where parts would run into each other, saying which.

import { useSignal } from '@preact/signals';
import { useId } from 'preact/hooks';
import type { FamilyState } from '../session/family_found';
import { lengthAt, type Stops, stopsOf, valueAt } from '../session/family_state';
import { formatMeasure, larger, parseMeasure } from '../session/measure';
import { interrupt } from '../session/play';
import { family as actions, entryOf, settle, setValue, slide, step } from '../session/session';
import { t } from '../texts/texts';
import { trackShares } from './track';

const steps = 200;

interface FamilySliderProps {
  readonly family: FamilyState;
  /** Its number in the family. */
  readonly index: number;
  /** Whether a part of the program is hidden, by id. */
  readonly isAbsent: (id: string) => boolean;
}

export function FamilySlider({ family, index, isAbsent }: FamilySliderProps) {
  step.value; // where it stands is no signal
  const note = useId();
  const said = useSignal<string | null>(null);
  const key = family.keys[index] ?? 0;
  const slider = family.found.family.sliders[index];
  const entry = entryOf(key);
  if (slider === undefined || entry === undefined) return null;
  const { metres } = family.found;
  const setting = actions.settingNow(family);
  const now = setting[index] ?? slider.value;
  const { parameter } = entry.layer;
  const low = lengthAt(family, index, parameter.min);
  const high = lengthAt(family, index, parameter.max);
  const like = larger(low, high) * metres;
  const show = (length: number) => formatMeasure('width', length * metres, like);
  const share = (length: number) => (length - low) / (high - low || 1);

  /** As near to what is wanted as the stops let it; says what is in the way. */
  const held = (wanted: number): number => {
    const stops: Stops = stopsOf(family, setting, index, isAbsent);
    const least = Math.max(low, stops.low);
    const most = Math.min(high, stops.high);
    const text = wanted < stops.low ? stops.lowText : wanted > stops.high ? stops.highText : null;
    said.value = text === null ? null : t`No further: ${text}.`;
    return valueAt(family, index, Math.min(most, Math.max(least, wanted)));
  };
  const move = (length: number, inRun = false) => setValue(key, held(length), inRun);
  const unit = (high - low) / steps;
  const word = slider.name.toLowerCase().startsWith(`${slider.section.toLowerCase()} `)
    ? slider.name.slice(slider.section.length + 1)
    : slider.name;

  return (
    <li class="family-slider">
      <span class="name" aria-hidden="true">
        {word}
      </span>
      <div
        class="track"
        style={{
          ...trackShares(share, slider.value, now),
          '--hull-low': share(slider.min),
          '--hull-span': share(slider.max) - share(slider.min),
        }}
      >
        <span class="hull" />
        <span class="zero" />
        <input
          type="range"
          min={low}
          max={high}
          step="any"
          value={now}
          aria-label={slider.name}
          aria-valuetext={show(now)}
          aria-describedby={said.value === null ? undefined : note}
          title={t`Double-click resets`}
          onPointerDown={interrupt}
          onInput={(event) => {
            const input = event.currentTarget;
            const value = held(input.valueAsNumber);
            slide(key, value);
            input.valueAsNumber = lengthAt(family, index, value);
          }}
          onChange={() => settle(key)}
          onBlur={() => (said.value = null)}
          onDblClick={() => move(slider.value)}
          onKeyDown={(event) => {
            const sign = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
            if (sign === undefined) return;
            event.preventDefault();
            move(now + sign * unit * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1), true);
          }}
        />
      </div>
      <TypedLength
        label={t`${slider.name}, type a value`}
        text={show(now)}
        read={(typed) => parseMeasure('width', typed, like)}
        take={(length) => move(length / metres)}
      />
      {said.value !== null && (
        <p id={note} class="quiet stop" role="status">
          {said.value}
        </p>
      )}
    </li>
  );
}

interface TypedLengthProps {
  readonly label: string;
  readonly text: string;
  /** In metres; null: no length. */
  readonly read: (typed: string) => number | null;
  readonly take: (metres: number) => void;
}

function TypedLength({ label, text, read, take }: TypedLengthProps) {
  const typed = useSignal<string | null>(null);
  const wrong = useSignal(false);
  const commit = () => {
    if (typed.value === null) return;
    const length = read(typed.value);
    wrong.value = length === null;
    if (length === null) return;
    typed.value = null;
    take(length);
  };
  return (
    <input
      class="typed"
      type="text"
      inputMode="decimal"
      aria-label={label}
      aria-invalid={wrong.value}
      title={wrong.value ? t`Type a number, such as ${text}` : undefined}
      value={typed.value ?? text}
      onFocus={(event) => event.currentTarget.select()}
      onInput={(event) => (typed.value = event.currentTarget.value)}
      onBlur={commit}
      onKeyDown={(event) => {
        if (event.key === 'Enter') commit();
        if (event.key !== 'Escape') return;
        typed.value = null;
        wrong.value = false;
      }}
    />
  );
}
