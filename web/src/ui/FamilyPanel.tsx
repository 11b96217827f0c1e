// The family of a CAD program: its variations as pictures, the few sliders that they leave, mixtures, parts that not all
// have, and what they have in common.

import { useSignal } from '@preact/signals';
import { useEffect, useMemo } from 'preact/hooks';
import { models } from '../session/core';
import type { OpenModel } from '../session/document';
import type { FamilyState } from '../session/family_found';
import { settingOf, shapeIds } from '../session/family_state';
import { interrupt } from '../session/play';
import { family as actions, document, setHidden, step, task } from '../session/session';
import { plural, t } from '../texts/texts';
import { FamilyKinds, SuggestKinds } from './FamilyKinds';
import { FamilyShared } from './FamilyShared';
import { FamilySlider } from './FamilySlider';
import { exportScad, exportSets } from './family_export';
import { drawFamily, familyPictures } from './family_pictures';
import { Icon } from './Icon';
import { capital } from './words';

export function FamilyPanel() {
  const { model, family, hidden } = document.value;
  const cad = model?.files.cad;
  const ids = useMemo(() => (model && cad ? shapeIds(cad, model.shape) : new Map<string, string>()), [model, cad]);
  if (model === null || family === undefined || cad === undefined) return null;
  const isAbsent = (id: string) => hidden.has(ids.get(id) ?? '');
  const { sliders, counts, warnings } = family.found.family;
  const sections = [...new Set(sliders.map(({ section }) => section))];
  return (
    <div class="family">
      <Strip family={family} model={model} />
      <FamilyKinds family={family} />
      <Optional family={family} ids={ids} />
      <section aria-label={t`Sliders`}>
        <h3>
          {plural(counts.sliders, '{n} slider', '{n} sliders')}{' '}
          <span class="quiet">{t`for ${Object.keys(family.found.values).length} numbers of the program`}</span>
        </h3>
        {sections.map((section) => (
          <div key={section} class="family-section">
            <h4>{section}</h4>
            <ul>
              {sliders.map((slider, index) =>
                slider.section === section ? (
                  <FamilySlider key={family.keys[index]} family={family} index={index} isAbsent={isAbsent} />
                ) : null,
              )}
            </ul>
          </div>
        ))}
      </section>
      <Mix family={family} />
      <FamilyShared family={family} cad={cad} ids={ids} />
      {warnings.length > 0 && (
        <ul class="quiet">
          {warnings.map((text) => (
            <li key={text}>{capital(text)}.</li>
          ))}
        </ul>
      )}
      <div class="row hand-buttons">
        <button type="button" class="button wide" onClick={() => void exportScad()}>
          <Icon name="export" /> OpenSCAD
        </button>
        {family.found.family.variations.length > 0 && (
          <button type="button" class="button wide" onClick={() => void exportSets()}>
            <Icon name="export" /> {t`Parameter sets`}
          </button>
        )}
      </div>
    </div>
  );
}

/** The program itself, then its variations; a click shows one. */
function Strip({ family, model }: { family: FamilyState; model: OpenModel }) {
  step.value;
  const { variations } = family.found.family;
  const { pictures } = family;
  const { files } = model;
  useEffect(() => drawFamily(files, family), [files, pictures]);
  const entries = [
    { name: t`as drawn`, setting: family.found.family.sliders.map(({ value }) => value) },
    ...variations.map(({ name }, i) => ({ name, setting: settingOf(family, i) })),
  ];
  return (
    <section aria-label={t`Variations`}>
      <ul class="variations">
        {entries.map(({ name, setting }, i) => (
          <li key={name}>
            <button
              type="button"
              aria-pressed={actions.isAt(family, setting)}
              onClick={() => {
                interrupt();
                actions.showVariation(i === 0 ? null : i - 1);
              }}
            >
              <span class="thumbnail">{familyPictures.value[i] && <img src={familyPictures.value[i]} alt="" />}</span>
              <span>{name}</span>
            </button>
            {i > 0 && (
              <button
                type="button"
                class="button icon-only remove"
                aria-label={t`Remove ${name}`}
                title={t`Remove this variation`}
                onClick={() => models.value && void actions.removeVariation(models.value, i - 1)}
              >
                <Icon name="close" />
              </button>
            )}
          </li>
        ))}
      </ul>
      <SuggestKinds />
      <Keep family={family} />
    </section>
  );
}

/** What stands on the stage, as one more variation. */
function Keep({ family }: { family: FamilyState }) {
  const name = useSignal('');
  const typed = name.value.trim();
  const taken = family.found.family.variations.some((variation) => variation.name === typed);
  return (
    <form
      class="row keep"
      onSubmit={async (event) => {
        event.preventDefault();
        if (models.value === null || typed === '' || taken) return;
        if (await actions.keepVariation(models.value, typed)) name.value = '';
      }}
    >
      <input
        class="grow"
        type="text"
        maxLength={60}
        placeholder={t`Name of what you see`}
        aria-label={t`Name of the variation`}
        value={name.value}
        onInput={(event) => (name.value = event.currentTarget.value)}
      />
      <button type="submit" class="button" disabled={typed === '' || taken || task.value !== null}>
        {taken ? t`Name is taken` : t`Keep as variation`}
      </button>
    </form>
  );
}

/** Parts that not all variations have. */
function Optional({ family, ids }: { family: FamilyState; ids: ReadonlyMap<string, string> }) {
  const { hidden, model } = document.value;
  const { optional } = family.found.family;
  const parts = model?.files.cad?.parts ?? [];
  if (optional.length === 0) return null;
  return (
    <fieldset class="optional">
      <legend>{t`Not all have`}</legend>
      {optional.map((group) => {
        const those = group.parts.flatMap((id) => ids.get(id) ?? []);
        const names = group.parts.map((id) => parts.find((part) => part.id === id)?.name ?? id);
        return (
          <label key={group.parts.join(' ')} class="check" title={t`Not in: ${group.absent_from.join(', ')}`}>
            <input
              type="checkbox"
              checked={!those.some((id) => hidden.has(id))}
              onChange={(event) => setHidden(those, !event.currentTarget.checked)}
            />
            <span>{names.join(', ')}</span>
          </label>
        );
      })}
    </fieldset>
  );
}

/** How much of each variation there is. */
function Mix({ family }: { family: FamilyState }) {
  const { variations } = family.found.family;
  if (variations.length === 0) return null;
  const weights = actions.mixing.value ?? family.weights;
  return (
    <section aria-label={t`Mix`}>
      <h3>{t`Mix`}</h3>
      <ul class="family-section">
        {variations.map(({ name }, i) => {
          const weight = weights[i] ?? 0;
          const percent = `${Math.round(100 * weight)} %`;
          return (
            <li key={name} class="family-slider">
              <span class="name" aria-hidden="true">
                {name}
              </span>
              <div class="track" style={{ '--zero': 0, '--low': 0, '--span': weight }}>
                <input
                  type="range"
                  min={0}
                  max={1}
                  step={0.01}
                  value={weight}
                  aria-label={t`Mix in ${name}`}
                  aria-valuetext={percent}
                  onPointerDown={interrupt}
                  onInput={(event) => actions.mix(i, event.currentTarget.valueAsNumber, false)}
                  onChange={(event) => actions.mix(i, event.currentTarget.valueAsNumber, true)}
                  onDblClick={() => actions.mix(i, 0, true)}
                />
              </div>
              <span class="quiet percent">{percent}</span>
            </li>
          );
        })}
      </ul>
    </section>
  );
}
