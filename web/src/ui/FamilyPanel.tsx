// The family of a CAD program, or of kept variations: its variations as pictures, the few sliders that they leave, mixtures, parts that not all
// have, and what they have in common.

import { useEffect, useMemo } from 'preact/hooks';
import { models } from '../session/core';
import type { OpenModel } from '../session/document';
import type { FamilyState } from '../session/family_found';
import { absentIds, areThere, shapeIds } from '../session/family_state';
import { interrupt } from '../session/play';
import { family as actions, document, step } from '../session/session';
import { plural, t } from '../texts/texts';
import { FamilyKinds, SuggestKinds } from './FamilyKinds';
import { FamilyShared } from './FamilyShared';
import { FamilySlider } from './FamilySlider';
import { exportScad, exportSets } from './family_export';
import { drawFamily, familyPictures } from './family_pictures';
import { Icon } from './Icon';
import { KeepVariation } from './KeepVariation';
import { capital } from './words';

export function FamilyPanel() {
  const { model, family, hidden } = document.value;
  const base = family?.base;
  const ids = useMemo(() => (model && base ? shapeIds(base, model.shape) : new Map<string, string>()), [model, base]);
  if (model === null || family === undefined) return null;
  const left = absentIds(document.value);
  const isAbsent = (id: string) => left.has(id) || hidden.has(ids.get(id) ?? '');
  const { sliders, counts, warnings } = family.found.family;
  const isOfProgram = family.base.of === undefined;
  const sections = [...new Set(sliders.map(({ section }) => section))];
  return (
    <div class="family">
      <Strip family={family} model={model} />
      <FamilyKinds family={family} />
      <Optional family={family} />
      <section aria-label={t`Sliders`}>
        <h3>
          {plural(counts.sliders, '{n} slider', '{n} sliders')}{' '}
          <span class="quiet">
            {isOfProgram
              ? t`for ${Object.keys(family.found.values).length} numbers of the program`
              : t`for ${Object.keys(family.found.values).length} numbers of the parts`}
          </span>
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
      <FamilyShared family={family} cad={family.base} ids={ids} />
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
    { name: t`as drawn`, variation: null },
    ...variations.map(({ name }, i) => ({ name, variation: i })),
  ];
  return (
    <section aria-label={t`Variations`}>
      <ul class="variations">
        {entries.map(({ name, variation }, i) => (
          <li key={name}>
            <button
              type="button"
              aria-pressed={actions.isShown(variation)}
              onClick={() => {
                interrupt();
                actions.showVariation(variation);
              }}
            >
              <span class="thumbnail">{familyPictures.value[i] && <img src={familyPictures.value[i]} alt="" />}</span>
              <span>{name}</span>
            </button>
            {variation !== null && (
              <button
                type="button"
                class="button icon-only remove"
                aria-label={t`Remove ${name}`}
                title={t`Remove this variation`}
                onClick={() => models.value && void actions.removeVariation(models.value, variation)}
              >
                <Icon name="close" />
              </button>
            )}
          </li>
        ))}
      </ul>
      {family.base.of === undefined && <SuggestKinds />}
      <KeepVariation />
    </section>
  );
}

/** Parts that not all variations have. */
function Optional({ family }: { family: FamilyState }) {
  const { optional } = family.found.family;
  const { parts } = family.base;
  if (optional.length === 0) return null;
  return (
    <fieldset class="optional">
      <legend>{t`Not all have`}</legend>
      {optional.map((group) => {
        const names = group.parts.map((id) => parts.find((part) => part.id === id)?.name ?? id);
        return (
          <label key={group.parts.join(' ')} class="check" title={t`Not in: ${group.absent_from.join(', ')}`}>
            <input
              type="checkbox"
              checked={areThere(document.value, group.parts)}
              onChange={(event) => actions.setThere(group.parts, event.currentTarget.checked)}
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
