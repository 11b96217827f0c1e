// A suggested slider: what it does in three pictures, the slider itself, which moves the model without being part of the
// work yet, and what is wrong with it where it is not clean.

import { useSignal } from '@preact/signals';
import { useRef } from 'preact/hooks';
import type { Layer, Shape } from '../program/types';
import { nameOf, type OpenModel } from '../session/document';
import { type Fault, givingWay } from '../session/faults';
import { formatMeasure, larger, measureOf, readAt } from '../session/measure';
import { playOnce } from '../session/play';
import type { Proposal } from '../session/proposals';
import { document } from '../session/session';
import { suggestions } from '../session/suggestions';
import { m, number, plural, t } from '../texts/texts';
import { Icon } from './Icon';
import { Menu } from './Menu';
import { evaluatorOf, strip, strips } from './pictures';
import { trackShares } from './track';
import { measureName } from './ValueSlider';
import { listWords, relationWords } from './words';

interface CardProps {
  readonly model: OpenModel;
  readonly proposal: Proposal;
  readonly first: boolean;
  readonly last: boolean;
  readonly isRunning: boolean;
}

export function SuggestCard({ model, proposal, first, last, isRunning }: CardProps) {
  const { key, request, state } = proposal;
  const renaming = useSignal(false);
  const layer = state.kind === 'found' ? state.found.program.layers[0] : undefined;
  const moves = state.kind === 'found' && state.fault?.kind !== 'still';
  return (
    <li class="card proposal" aria-label={request}>
      <header>
        {renaming.value ? <Rename proposal={proposal} done={() => (renaming.value = false)} /> : <h4>{request}</h4>}
        <Menu
          label={t`More about the suggestion ${request}`}
          class="button icon-only"
          items={[
            { label: t`Rename`, act: () => (renaming.value = true) },
            { label: t`Move up`, disabled: first, act: () => suggestions.move(key, -1) },
            { label: t`Move down`, disabled: last, act: () => suggestions.move(key, 1) },
            { label: t`Drop`, act: () => suggestions.drop(key) },
          ]}
        >
          <Icon name="more" />
        </Menu>
      </header>
      {state.kind === 'reading' && <p class="quiet">{t`Being read…`}</p>}
      {state.kind === 'stopped' && <p class="quiet">{t`Not read: it was stopped.`}</p>}
      {state.kind === 'refused' && <Warning text={t`No slider came of it. ${state.text}`} />}
      {layer !== undefined && moves && <Moves model={model} proposal={proposal} layer={layer} />}
      {state.kind === 'found' && state.fault === null && layer !== undefined && (
        <GivingWay shape={model.shape} layer={layer} />
      )}
      {state.kind === 'found' && state.fault !== null && <Warning text={faultWords(model, state.fault)} />}
      {state.kind !== 'reading' && (
        <div class="row wrap">
          {moves && (
            <button
              type="button"
              class="button outlined"
              onClick={() => {
                const kept = suggestions.keep(key);
                if (kept !== null) playOnce(kept);
              }}
            >
              <Icon name="check" /> {state.fault === null ? t`Keep` : t`Keep anyway`}
            </button>
          )}
          {state.kind === 'found' && state.looser !== null && (
            <button
              type="button"
              class="button outlined"
              title={t`Parts that were to stay may follow, so that nothing comes apart`}
              onClick={() => suggestions.loosen(key)}
            >
              {t`Let parts follow`}
            </button>
          )}
          {(state.kind === 'stopped' || state.kind === 'refused') && (
            <button
              type="button"
              class="button outlined"
              disabled={isRunning}
              onClick={() => void suggestions.readAgain(key)}
            >
              {t`Read it`}
            </button>
          )}
          <button type="button" class="button" onClick={() => suggestions.drop(key)}>
            {t`Drop`}
          </button>
        </div>
      )}
    </li>
  );
}

function Rename({ proposal, done }: { proposal: Proposal; done: () => void }) {
  const cancelled = useRef(false);
  return (
    <input
      class="rename"
      value={proposal.request}
      maxLength={400}
      aria-label={t`Name of the slider`}
      ref={(element) => element?.focus()}
      onBlur={(event) => {
        done();
        if (!cancelled.current) suggestions.rename(proposal.key, event.currentTarget.value);
      }}
      onKeyDown={(event) => {
        cancelled.current = event.key === 'Escape';
        if (event.key === 'Enter' || event.key === 'Escape') event.currentTarget.blur();
      }}
    />
  );
}

function Warning({ text }: { text: string }) {
  return (
    <p class="broken unclean">
      <Icon name="warning" />
      <span>{text}</span>
    </p>
  );
}

export function faultWords({ shape }: OpenModel, fault: Fault): string {
  switch (fault.kind) {
    case 'still':
      return t`Nothing can move: at any other position a part would collapse.`;
    case 'same':
      return t`It does the same as “${fault.as}”`;
    case 'broken': {
      const of = (wanted: boolean) =>
        fault.seen
          .filter(({ apart }) => apart === wanted)
          .map(({ parts: [a, b] }) => t`${nameOf(document.value, a)} and ${nameOf(document.value, b)}`);
      const [apart, together] = [of(true), of(false)];
      return [
        fault.relations.length > 0 && t`Not kept on the way: ${listWords(relationsInWords(shape, fault.relations))}.`,
        apart.length > 0 && t`On the way these come apart: ${listWords(apart)}.`,
        together.length > 0 && t`On the way these run into each other: ${listWords(together)}.`,
      ]
        .filter(Boolean)
        .join(' ');
    }
  }
}

const relationsInWords = ({ relations }: Shape, ids: readonly string[]) =>
  ids.flatMap((id) => {
    const relation = relations.find((one) => one.id === id);
    return relation === undefined ? [] : [relationWords(document.value, relation)];
  });

/** The joints that a slider lets slide, to be unfolded. */
function GivingWay({ shape, layer }: { shape: Shape; layer: Layer }) {
  const words = relationsInWords(shape, givingWay(shape, layer));
  if (words.length === 0) return null;
  return (
    <details class="quiet">
      <summary>
        {plural(words.length, 'A joint gives way', '{n} joints give way')}: {t`the parts slide along each other`}
      </summary>
      <ul>
        {words.map((text) => (
          <li key={text}>{text}</li>
        ))}
      </ul>
    </details>
  );
}

const ends = [m`least@end`, m`as it is`, m`most@end`] as const;
const steps = 200;

/** The pictures, each a click to that value, and the slider. */
function Moves({ model, proposal, layer }: { model: OpenModel; proposal: Proposal; layer: Layer }) {
  const { key, request } = proposal;
  const { min, max } = layer.parameter;
  const value = suggestions.standing(key);
  const text = readingOf(model, layer, value);
  const urls = strips.value.get(layer);
  const unit = (max - min) / steps;
  const share = (x: number) => (x - min) / (max - min);
  const go = (to: number) => suggestions.preview(key, Math.min(max, Math.max(min, to)));
  return (
    <>
      <div class="strip">
        {strip(layer.parameter).map((to, i) => (
          <button
            key={i}
            type="button"
            aria-label={`${request}: ${t(ends[i] ?? ends[1])}`}
            aria-pressed={value === to}
            onClick={() => go(to)}
          >
            {urls?.[i] !== undefined && <img src={urls[i]} alt="" />}
          </button>
        ))}
      </div>
      <div class="track" style={trackShares(share, 0, value)}>
        <span class="zero" />
        <input
          type="range"
          min={min}
          max={max}
          step="any"
          value={value}
          aria-label={t`${request}: amount`}
          aria-valuetext={text}
          title={t`Double-click resets`}
          onInput={(event) => go(event.currentTarget.valueAsNumber)}
          onDblClick={() => go(0)}
          onKeyDown={(event) => {
            const sign = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
            if (sign === undefined) return;
            event.preventDefault(); // step="any" gives the arrows a step of 1 in some browsers
            go(value + sign * unit * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1));
          }}
        />
      </div>
      <p class="measure quiet">{text}</p>
    </>
  );
}

/** "seat width 46 cm → 54 cm". */
function readingOf({ shape }: OpenModel, layer: Layer, value: number): string {
  const seed = layer.statements.find(({ why }) => why?.kind === 'seed') ?? layer.statements[0];
  const measure = measureOf(shape, seed);
  const evaluator = evaluatorOf(shape, layer);
  if (measure === null || evaluator === null) return number(value, 2, 2);
  const [rest = 0, now = 0] = readAt(shape, measure, evaluator, [0], 0, [0, value]);
  const show = (reading: number) => formatMeasure(measure.what, reading, larger(rest, now));
  return `${measureName(measure)} ${value === 0 ? show(rest) : `${show(rest)} → ${show(now)}`}`;
}
