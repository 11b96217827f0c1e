// What the variations have in common, a line a class: each can be switched, and shows its faces while it is pointed at.

import { useSignal } from '@preact/signals';
import { useMemo } from 'preact/hooks';
import type { CadSource } from '../scene/load';
import { models } from '../session/core';
import type { FamilyState } from '../session/family_found';
import { type Agreement, choicesFor, type SharedClass, sharedClasses } from '../session/family_shared';
import { family as actions, pointedAt } from '../session/session';
import { listed, m, type Sentence, t } from '../texts/texts';

interface FamilySharedProps {
  readonly family: FamilyState;
  readonly cad: CadSource;
  /** Ids of the shape by ids of the program. */
  readonly ids: ReadonlyMap<string, string>;
}

const sections: readonly (readonly [Agreement, Sentence, Sentence])[] = [
  ['common', m`In common`, m`Kept by every slider. Switch off what is not meant.`],
  ['near', m`All but one`, m`True of all variations but the one that is named. Switch on what is meant all the same.`],
  ['accidental', m`By accident`, m`True of the program as it is drawn, and of few others.`],
];

export function FamilyShared({ family, cad, ids }: FamilySharedProps) {
  const { constraints } = family.found.family;
  const classes = useMemo(() => sharedClasses(constraints, cad.parts), [constraints, cad]);
  return (
    <section aria-label={t`What they have in common`}>
      {sections.map(([agreement, title, help]) => {
        const own = classes.filter((shared) => shared.agreement === agreement);
        if (own.length === 0) return null;
        return (
          <details key={agreement} class="shared">
            <summary>
              {t(title)} <span class="quiet">{own.length}</span>
            </summary>
            <p class="quiet">{t(help)}</p>
            <ul>
              {own.map((shared) => (
                <Line key={shared.key} shared={shared} ids={ids} />
              ))}
            </ul>
          </details>
        );
      })}
    </section>
  );
}

function Line({ shared, ids }: { shared: SharedClass; ids: ReadonlyMap<string, string> }) {
  const wanted = useSignal<boolean | null>(null); // until the core has answered
  const faces = shared.faces.flatMap(({ part, feature }) => {
    const id = ids.get(part);
    return id === undefined ? [] : [{ part: id, feature }];
  });
  const show = () => {
    pointedAt.value = { parts: [...new Set(faces.map(({ part }) => part))], relations: [], faces };
  };
  const hide = () => {
    pointedAt.value = null;
  };
  const broken = shared.brokenBy;
  const not = broken.length > 2 ? t`${broken.slice(0, 2).join(', ')} and ${broken.length - 2} more` : listed(broken);
  return (
    <li onPointerEnter={show} onPointerLeave={hide} onFocus={show} onBlur={hide}>
      <label class="check">
        <input
          type="checkbox"
          checked={wanted.value ?? shared.kept}
          disabled={models.value === null}
          onChange={async (event) => {
            if (models.value === null) return;
            wanted.value = event.currentTarget.checked;
            await actions.choose(models.value, choicesFor(shared, event.currentTarget.checked));
            wanted.value = null;
          }}
        />
        <span>
          {shared.text}
          {shared.of > 0 && (
            <span class="quiet">
              {' '}
              · {shared.agreement === 'common' ? t`in all ${shared.of} that have it` : t`not in the ${not}`}
            </span>
          )}
        </span>
      </label>
    </li>
  );
}
