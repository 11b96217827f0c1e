// What the edits keep together, in one line for the model; and where a slider stops for the others' sake.

import { models } from '../session/core';
import type { LayerEntry } from '../session/document';
import { document, pointedAt, sliderValue, stops, useCore } from '../session/session';
import { watchVerdict } from '../session/verdict';
import { plural, t } from '../texts/texts';
import { Icon } from './Icon';
import { capital, relationWords } from './words';

const verdict = watchVerdict({ document, stops }, models);
models.subscribe((core) => {
  if (core !== null) useCore(core);
});

export function StackVerdict() {
  const found = verdict.value;
  const { model } = document.value;
  if (found === null || model === null) return null;
  const { of, lost, settings, failed, failure } = found;
  const sound = lost.length === 0 && failed === 0;
  const relations = plural(of, '{n} relation', '{n} relations');
  return (
    <section class="status together" aria-label={t`All edits together`}>
      <p class={sound ? 'held' : 'broken'}>
        <Icon name={sound ? 'check' : 'warning'} />
        <span>
          {lost.length === 0
            ? t`Together the edits keep ${relations} wherever the sliders stand`
            : t`Together the edits break ${lost.length} of ${relations} at some settings; the sliders stop there`}
          <span class="quiet"> · {t`${settings} settings sampled`}</span>
        </span>
      </p>
      {failed > 0 && <p class="quiet">{t`At ${failed} of them: ${failure}.`}</p>}
      {lost.length > 0 && (
        <ul>
          {lost.map((id) => {
            const relation = model.shape.relations.find((other) => other.id === id);
            if (relation === undefined) return null;
            const show = () => {
              pointedAt.value = { parts: relation.parts, relations: [id] };
            };
            const hide = () => {
              pointedAt.value = null;
            };
            return (
              <li key={id}>
                <button
                  type="button"
                  class="line broken"
                  onPointerEnter={show}
                  onPointerLeave={hide}
                  onFocus={show}
                  onBlur={hide}
                >
                  {relationWords(document.value, relation)}
                </button>
              </li>
            );
          })}
        </ul>
      )}
    </section>
  );
}

/** The ends of a slider's way that the other sliders close, as shares of it from either side. */
export function Closed({ entry, share }: { entry: LayerEntry; share: (x: number) => number }) {
  const stop = stops.value.get(entry.key);
  if (stop === undefined) return null;
  return (
    <>
      {stop.minReason !== '' && <span class="closed low" style={{ '--to': share(stop.min) }} />}
      {stop.maxReason !== '' && <span class="closed high" style={{ '--to': 1 - share(stop.max) }} />}
    </>
  );
}

/** Why a slider that stands at a stop goes no further; null elsewhere. */
export function stopWords(entry: LayerEntry): string | null {
  const stop = stops.value.get(entry.key);
  if (stop === undefined) return null;
  const value = sliderValue(entry);
  const near = (entry.layer.parameter.max - entry.layer.parameter.min) / 1000;
  const reason = value >= stop.max - near ? stop.maxReason : value <= stop.min + near ? stop.minReason : '';
  return reason === '' ? null : t`Stops here, where the other sliders stand. ${capital(reason)}.`;
}
