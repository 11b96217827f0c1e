// Other readings of a layer's request, side by side: one slider drives them all, the parts that do something else than in
// the layer as it is are tinted, and choosing one puts it in the layer's place.

import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import type { Layer, Shape, Statement } from '../program/types';
import type { State } from '../scene/explode';
import type { Tint } from '../scene/model_view';
import { copyOf, type Picture } from '../scene/pictures';
import type { LayerEntry, OpenModel } from '../session/document';
import { titleOf } from '../session/layers';
import { playOnce, prefersReducedMotion } from '../session/play';
import { isClean, type Proposal } from '../session/proposals';
import { document, exchangeLayer } from '../session/session';
import { otherReadings } from '../session/suggestions';
import { t } from '../texts/texts';
import { AskFailure } from './AskFailure';
import { dialog } from './actions';
import { Dialog } from './Dialog';
import { Icon } from './Icon';
import { evaluatorOf, paint } from './pictures';
import { readingsOf } from './readings';
import { faultWords } from './SuggestCard';
import { theme } from './theme';

/** Share of the way to the ends: −1 … 1. */
const at = ({ min, max }: Layer['parameter'], share: number) => (share < 0 ? -share * min : share * max);

export function ReadingsDialog() {
  const asked = otherReadings.asked.value;
  const entry = document.value.layers.find(({ key }) => key === readingsOf.value);
  const { model } = document.value;
  const share = useSignal(1);
  const isPlaying = useSignal(!prefersReducedMotion());
  usePlaying(isPlaying, share);
  const close = () => {
    otherReadings.close();
    dialog.value = null;
  };
  if (entry === undefined || model === null) return null;
  const title = titleOf(entry.layer);
  const proposals = asked?.proposals ?? [];
  return (
    <Dialog title={t`Other readings of “${title}”`} class="readings" onClose={close}>
      <div class="row progress" role="status">
        {asked?.isRunning && (
          <>
            <span class="spinner" aria-hidden="true" />
            <p class="grow quiet">
              {asked.isAsking ? t`Asking what else it may mean` : t`Working out what the other parts do`}
            </p>
            <button type="button" class="button" onClick={otherReadings.stop}>
              {t`Cancel`}
            </button>
          </>
        )}
      </div>
      {asked?.failure && <AskFailure {...asked.failure} />}
      <ReadingList model={model} entry={entry} proposals={proposals} share={share.value} close={close} />
      <div class="row">
        <button
          type="button"
          class="button icon-only"
          aria-label={isPlaying.value ? t`Stop` : t`Animate all`}
          title={isPlaying.value ? t`Stop` : t`Animate all`}
          onClick={() => {
            isPlaying.value = !isPlaying.value;
          }}
        >
          <Icon name={isPlaying.value ? 'pause' : 'play'} />
        </button>
        <input
          class="grow"
          type="range"
          min={-1}
          max={1}
          step={0.01}
          value={share.value}
          aria-label={t`How far, in all readings`}
          onInput={(event) => {
            isPlaying.value = false;
            share.value = event.currentTarget.valueAsNumber;
          }}
        />
      </div>
    </Dialog>
  );
}

const period = 2400; // milliseconds there and back

function usePlaying(isPlaying: { value: boolean }, share: { value: number }): void {
  const playing = isPlaying.value;
  useEffect(() => {
    if (!playing) return;
    const begin = performance.now();
    const next = (now: number) => {
      share.value = Math.cos((2 * Math.PI * (now - begin)) / period);
      frame = requestAnimationFrame(next);
    };
    let frame = requestAnimationFrame(next);
    return () => cancelAnimationFrame(frame);
  }, [playing, share]);
}

interface ListProps {
  readonly model: OpenModel;
  readonly entry: LayerEntry;
  readonly proposals: readonly Proposal[];
  readonly share: number;
  readonly close: () => void;
}

const size = 360; // pixels

function ReadingList({ model, entry, proposals, share, close }: ListProps) {
  const { shape } = model;
  const canvases = useRef(new Map<number, HTMLCanvasElement>());
  const seen = proposals.flatMap(({ key, state }) => {
    const layer = state.kind === 'found' ? state.found.program.layers[0] : undefined;
    return layer === undefined ? [] : [{ key, layer }];
  });
  const all = [{ key: 0, layer: entry.layer }, ...seen];
  useEffect(() => {
    const stateAt = (layer: Layer, where: number): State | null => {
      const evaluator = evaluatorOf(shape, layer);
      evaluator?.evaluate([at(layer.parameter, where)]);
      return evaluator && copyOf(evaluator);
    };
    // At most once a frame, however often something changes.
    const frame = requestAnimationFrame(() => {
      const ends = all
        .flatMap(({ layer }) => [stateAt(layer, -1), stateAt(layer, 1)])
        .filter((state) => state !== null);
      const pictures = all.flatMap(({ key, layer }): Picture[] => {
        const canvas = canvases.current.get(key);
        const state = stateAt(layer, share);
        return canvas && state ? [{ state, canvas, tints: differing(shape, entry.layer, layer) }] : [];
      });
      paint(model, pictures, ends);
    });
    return () => cancelAnimationFrame(frame);
  });
  const canvas = (key: number) => (
    <canvas
      width={size}
      height={size}
      ref={(element) => {
        if (element === null) canvases.current.delete(key);
        else canvases.current.set(key, element);
      }}
    />
  );
  return (
    <ul class="other-readings">
      <li class="card" aria-label={t`As it is now`}>
        {canvas(0)}
        <p>{t`As it is now`}</p>
      </li>
      {proposals.map((proposal) => (
        <li class="card" key={proposal.key} aria-label={proposal.request}>
          {proposal.state.kind === 'found' ? canvas(proposal.key) : <div class="blank" />}
          <p>{proposal.request}</p>
          <Said model={model} proposal={proposal} />
          {proposal.state.kind === 'found' && proposal.state.fault?.kind !== 'still' && (
            <button
              type="button"
              class={isClean(proposal) ? 'button primary' : 'button outlined'}
              onClick={() => {
                if (proposal.state.kind !== 'found') return;
                if (!exchangeLayer(entry.key, proposal.state.found, proposal.request)) return;
                close();
                playOnce(entry.key);
              }}
            >
              {t`Take this`}
            </button>
          )}
        </li>
      ))}
    </ul>
  );
}

function Said({ model, proposal: { state } }: { model: OpenModel; proposal: Proposal }) {
  if (state.kind === 'reading') return <p class="quiet">{t`Being read…`}</p>;
  if (state.kind === 'stopped') return <p class="quiet">{t`Not read: it was stopped.`}</p>;
  if (state.kind === 'refused') return <p class="broken">{state.text}</p>;
  const fault = state.kind === 'found' ? state.fault : null;
  return fault && <p class="broken">{faultWords(model, fault)}</p>;
}

const tinted = new WeakMap<
  Layer,
  { readonly base: Layer; readonly accent: string; readonly tints: Map<number, Tint> }
>();

/** The parts that do something else in one layer than in another, in the accent colour. */
function differing(shape: Shape, base: Layer, layer: Layer): ReadonlyMap<number, Tint> {
  const { accent, accentRgb } = theme.peek();
  const known = tinted.get(layer);
  if (known?.base === base && known.accent === accent) return known.tints;
  const [doing, done] = [doingOf(shape, layer), doingOf(shape, base)];
  const tints = new Map(
    shape.parts.flatMap(({ id }, i) =>
      doing.get(id) === done.get(id) ? [] : [[i, [...accentRgb, 0.4] as const] as const],
    ),
  );
  tinted.set(layer, { base, accent, tints });
  return tints;
}

/** What happens to each part, as text; instances of a group do what the group does. */
function doingOf(shape: Shape, { statements, parameter }: Layer): ReadonlyMap<string, string> {
  const doing = new Map<string, string>();
  const add = (id: string, { why: _, ...rest }: Statement) => {
    const text = JSON.stringify(rest).replaceAll(parameter.name, 'x');
    doing.set(id, (doing.get(id) ?? '') + text);
  };
  for (const statement of statements) {
    if (statement.op === 'keep_fixed') continue;
    if ('part' in statement) {
      const part = shape.parts.find(({ id }) => id === statement.part);
      for (const id of [statement.part, ...(part?.members ?? [])]) add(id, statement);
      continue;
    }
    const group = shape.relations.find(({ id }) => id === statement.relation);
    for (const id of group?.parts ?? []) add(id, statement);
  }
  return doing;
}
