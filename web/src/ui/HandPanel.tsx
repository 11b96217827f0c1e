// An edit by hand: a part or one of its faces, edges and corners, an operator, what the others should do, and which
// relations may give way. Propagation finds the rest and leaves a layer with a slider.

import { type Signal, useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { type Hint, hints, isGroupOperator } from '../program/operators';
import type { Shape } from '../program/types';
import { models } from '../session/core';
import { type EditInput, nameOf, wholePart } from '../session/document';
import { playOnce } from '../session/play';
import { document, propagate, select, selected, selection, task } from '../session/session';
import { standIns } from '../session/several';
import { t } from '../texts/texts';
import { Icon } from './Icon';
import { SeedFields } from './SeedFields';
import { firstChoice, isWhole, seedOf, withPart } from './seed_choice';
import {
  type FeatureKind,
  featureKind,
  featureWords,
  hintWords,
  listWords,
  operatorWords,
  relationWords,
} from './words';

/** Which kind of feature a click in the view selects while this panel is open; null when it is closed. */
export function HandPanel({ pickKind, onDone }: { pickKind: Signal<FeatureKind | null>; onDone: () => void }) {
  const form = useRef<HTMLFormElement>(null);
  useEffect(() => form.current?.scrollIntoView({ block: 'nearest' }), []);
  const chosen = useSignal(firstChoice);
  const chosenHints = useSignal<ReadonlyMap<string, Hint>>(new Map());
  const disabled = useSignal<ReadonlySet<string>>(new Set());
  const aboutOne = useSignal(false);
  const { model } = document.value;
  if (model === null) return null;
  const { shape } = model;
  // The parts are what is selected, in the view or in the list.
  const standing = standIns(
    shape,
    selected.value.filter((id) => shape.parts.some((part) => part.id === id)),
  );
  const [first = ''] = standing;
  const choice = {
    ...withPart(shape, chosen.value, first),
    feature: selection.value?.feature ?? wholePart,
  };
  const parts = isGroupOperator(choice.op) ? [first] : standing;
  const hasOrigin = 'origin' in seedOf(shape, choice);
  const seeds = parts.map((part) =>
    seedOf(shape, hasOrigin && aboutOne.value ? { ...choice, part } : withPart(shape, choice, part)),
  );
  const ready = isWhole(shape, choice) && models.value !== null && !task.value;

  const apply = async () => {
    if (models.value === null || !ready) return;
    const edit: EditInput = {
      seed: seeds,
      disabled: [...disabled.value],
      hints: Object.fromEntries(chosenHints.value),
    };
    const isOfWhole = featureKind(choice.feature) === 'whole' || isGroupOperator(choice.op);
    const names = listWords(parts.map((id) => nameOf(document.peek(), id)));
    const what = isOfWhole ? names : t`${featureWords(choice.feature)} of ${names}`;
    const key = await propagate(models.value, edit, `${t(operatorWords[choice.op].label)} ${what}`);
    if (key === null) return;
    onDone();
    playOnce(key);
  };

  return (
    <form
      ref={form}
      class="hand"
      aria-label={t`Edit by hand`}
      onSubmit={(event) => {
        event.preventDefault();
        void apply();
      }}
    >
      <SeedFields
        shape={shape}
        choice={choice}
        nothing={t`click one in the view…`}
        onChange={(next) => {
          chosen.value = next;
          pickKind.value = featureKind(next.feature);
          if (next.part !== choice.part) select(next.part || null);
          else if (next.part !== '' && next.feature !== choice.feature) select(next.part, next.feature);
        }}
      />
      {standing.length > 1 && (
        <div class="together">
          <p class="quiet">
            {isGroupOperator(choice.op)
              ? t`Only this one: rows have their number and spacing each for itself.`
              : t`The same for ${listWords(parts.slice(1).map((id) => nameOf(document.value, id)))}.`}
          </p>
          {hasOrigin && (
            <label class="check">
              <input
                type="checkbox"
                checked={aboutOne.value}
                onChange={(event) => {
                  aboutOne.value = event.currentTarget.checked;
                }}
              />
              <span>{t`all from the one point, not each from its own`}</span>
            </label>
          )}
        </div>
      )}
      <Hints shape={shape} except={choice.part} chosen={chosenHints} />
      {choice.part !== '' && <Disabled shape={shape} part={choice.part} disabled={disabled} />}
      <div class="row">
        <button type="submit" class="button primary" disabled={!ready}>
          {t`Apply`}
        </button>
        <button type="button" class="button" onClick={onDone}>
          {t`Cancel`}
        </button>
      </div>
    </form>
  );
}

export function Hints({
  shape,
  except,
  chosen,
}: {
  shape: Shape;
  except: string;
  chosen: { value: ReadonlyMap<string, Hint> };
}) {
  const free = shape.parts.filter(({ id }) => id !== except && !chosen.value.has(id));
  const set = (id: string, hint: Hint | null) => {
    const next = new Map(chosen.value);
    if (hint === null) next.delete(id);
    else next.set(id, hint);
    chosen.value = next;
  };
  return (
    <details>
      <summary>
        {t`What other parts should do`}
        {chosen.value.size > 0 && ` · ${chosen.value.size}`}
      </summary>
      {[...chosen.value].map(([id, hint]) => (
        <div class="row" key={id}>
          <span class="grow">{nameOf(document.value, id)}</span>
          <select
            aria-label={t`What ${nameOf(document.value, id)} should do`}
            value={hint}
            onChange={(event) => set(id, event.currentTarget.value as Hint)}
          >
            {hints.map((kind) => (
              <option key={kind} value={kind}>
                {t(hintWords[kind])}
              </option>
            ))}
          </select>
          <button
            type="button"
            class="button icon-only"
            aria-label={t`Forget ${nameOf(document.value, id)}`}
            onClick={() => set(id, null)}
          >
            <Icon name="close" />
          </button>
        </div>
      ))}
      <select
        aria-label={t`Add a part`}
        value=""
        onChange={(event) => {
          if (event.currentTarget.value) set(event.currentTarget.value, 'keep_fixed');
        }}
      >
        <option value="">{t`add a part…`}</option>
        {free.map(({ id }) => (
          <option key={id} value={id}>
            {nameOf(document.value, id)}
          </option>
        ))}
      </select>
    </details>
  );
}

function Disabled({ shape, part, disabled }: { shape: Shape; part: string; disabled: Signal<ReadonlySet<string>> }) {
  const kinds = [
    ['kind:reflection', t`all mirror symmetries`],
    ['kind:translation', t`all even rows`],
    ['kind:rotation', t`all rings`],
    ['kind:ground', t`all that stands on the floor`],
  ] as const;
  const own = shape.relations.filter(({ parts }) => parts.includes(part));
  const items = [
    ...kinds.filter(([kind]) => shape.relations.some((relation) => `kind:${relation.kind}` === kind)),
    ...own.map((relation) => [relation.id, relationWords(document.value, relation, part)] as const),
  ];
  return (
    <details>
      <summary>
        {t`What may come apart`}
        {disabled.value.size > 0 && ` · ${disabled.value.size}`}
      </summary>
      {items.map(([id, words]) => (
        <label class="check" key={id}>
          <input
            type="checkbox"
            checked={disabled.value.has(id)}
            onChange={(event) => {
              const next = new Set(disabled.value);
              if (event.currentTarget.checked) next.add(id);
              else next.delete(id);
              disabled.value = next;
            }}
          />
          <span>{words}</span>
        </label>
      ))}
    </details>
  );
}
