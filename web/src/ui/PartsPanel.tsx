// The outliner: the parts, what can be done with those that are selected, and what holds the selected one.

import { useSignal } from '@preact/signals';
import { isGroup, type ShapePart } from '../program/types';
import { models } from '../session/core';
import { nameOf, partKey } from '../session/document';
import { oncePerShape } from '../session/once_per_shape';
import { relabel } from '../session/open';
import { document, pointedAt, select, selectAll, selected, selection, showAll } from '../session/session';
import { t } from '../texts/texts';
import { Found } from './Found';
import { NamesCard } from './NamesCard';
import { CorrectionList, PairCard } from './PairCard';
import { PartsList } from './PartsList';
import { PlaceCard } from './PlaceCard';
import { SelectionBar } from './SelectionBar';
import { SplitCard } from './SplitCard';
import { whyPart } from './why';
import { relationWords } from './words';

/** @param onEdit begins an edit by hand of what is selected */
export function PartsPanel({ onEdit }: { onEdit: () => void }) {
  const { model, hidden } = document.value;
  if (model === null) return <p class="quiet empty">{t`The parts of the model are listed here.`}</p>;
  return (
    <>
      <Found shape={model.shape} />
      <PartsList parts={model.shape.parts} />
      {hidden.size > 0 && (
        <button type="button" class="button wide" onClick={showAll}>
          {hidden.size === 1 ? t`Show the hidden one` : t`Show all ${hidden.size} hidden`}
        </button>
      )}
      <SplitCard />
      <PlaceCard />
      <NamesCard />
      <SelectionBar shape={model.shape} onEdit={onEdit}>
        <PairCard shape={model.shape} />
      </SelectionBar>
      {selected.value.length < 2 && <SelectedPart />}
      <CorrectionList />
    </>
  );
}

function SelectedPart() {
  const id = selection.value?.part;
  const part = document.value.model?.shape.parts.find((other) => other.id === id);
  if (part === undefined) return null;
  return (
    <>
      <Label key={part.id} part={part} />
      <Relations id={part.id} />
      <Why id={part.id} />
    </>
  );
}

const labelsOf = oncePerShape(({ parts }) => [
  ...new Set(parts.filter(({ virtual }) => !virtual).map(({ label }) => label)),
]);
/** Nobody reads a longer list, and a model may have a thousand labels. */
const mostOffered = 50;

/** What the part is, in the words of the file or of a person: parts of one label are compared for symmetry. */
function Label({ part }: { part: ShapePart }) {
  const { model } = document.value;
  const typed = useSignal<string | null>(null);
  const isFocused = useSignal(false);
  if (model === null) return null;
  const members = part.virtual ? model.shape.parts.filter(({ id }) => part.members.includes(id)) : [part];
  const [first] = members;
  if (first === undefined) return null;
  const keys = members.map(partKey);
  const isChanged = keys.some((key) => model.labels.has(key));
  const give = async (label: string | null) => {
    typed.value = null;
    if (models.value === null || label === '' || (label === first.label && !isChanged)) return;
    if (!(await relabel(models.value, keys, label))) return;
    const again = document.peek().model?.shape.parts.find((other) => partKey(other) === partKey(first));
    if (again) select(again.id);
  };
  const wanted = typed.value?.toLowerCase() ?? '';
  const offered = isFocused.value ? labelsOf(model.shape).filter((label) => label.toLowerCase().includes(wanted)) : [];
  return (
    <form
      class="label"
      onSubmit={(event) => {
        event.preventDefault();
        void give((typed.value ?? first.label).trim());
      }}
    >
      <label for="part-label" title={t`Parts with one label may mirror each other or stand in a row`}>
        {t`Label`}
      </label>
      <input
        id="part-label"
        type="text"
        list="part-labels"
        maxLength={64}
        autocomplete="off"
        value={typed.value ?? first.label}
        aria-describedby="part-label-help"
        onFocus={() => (isFocused.value = true)}
        onBlur={() => (isFocused.value = false)}
        onInput={(event) => {
          typed.value = event.currentTarget.value;
        }}
        onKeyDown={(event) => {
          if (event.key === 'Escape') typed.value = null;
        }}
      />
      <datalist id="part-labels">
        {offered.slice(0, mostOffered).map((label) => (
          <option key={label} value={label} />
        ))}
      </datalist>
      {typed.value !== null && typed.value.trim() !== first.label ? (
        <button type="submit" class="button" disabled={!models.value || typed.value.trim() === ''}>
          {t`Set`}
        </button>
      ) : (
        isChanged && (
          <button type="button" class="button" title={t`The label of the file`} onClick={() => void give(null)}>
            {t`Reset`}
          </button>
        )
      )}
      {typed.value !== null && (
        <p id="part-label-help" class="quiet">
          {t`Parts with one label may mirror each other or stand in a row.`}
        </p>
      )}
    </form>
  );
}

/** Why it moves, or does not, layer by layer. */
function Why({ id }: { id: string }) {
  const layers = whyPart(document.value, id);
  if (layers.length === 0) return null;
  return (
    <section class="relations" aria-label={t`Why it moves`}>
      <h3>{t`Why it moves, or stays`}</h3>
      <ul class="whys">
        {layers.map(({ layer, text, search }, i) => (
          <li key={i}>
            <p class="why-layer">{layer}</p>
            {text.map((line) => (
              <p class="quiet" key={line}>
                {line}
              </p>
            ))}
            {search && (
              <details>
                <summary>{t`How it was found`}</summary>
                <p class="quiet">{search}</p>
              </details>
            )}
          </li>
        ))}
      </ul>
    </section>
  );
}

/**
 * What holds the selected part: pointing at a relation shows its points or its plane, a click selects both its parts, so that
 * it can be changed.
 */
function Relations({ id }: { id: string }) {
  const { model } = document.value;
  if (model === null) return null;
  const relations = model.shape.relations.filter(
    (relation) => relation.parts.includes(id) || (isGroup(relation) && relation.parent === id),
  );
  return (
    <section class="relations" aria-label={t`Relations of the selected part`}>
      <h3>{t`What holds ${nameOf(document.value, id)}`}</h3>
      {relations.length === 0 && (
        <p class="quiet">{t`Nothing: it stands alone. Select another part as well (Shift+click) to join the two.`}</p>
      )}
      <ul>
        {relations.map((relation) => {
          const show = () => {
            pointedAt.value = { parts: relation.parts, relations: [relation.id] };
          };
          const hide = () => {
            pointedAt.value = null;
          };
          const other = relation.parts.find((part) => part !== id);
          const isPair = !isGroup(relation) && other !== undefined;
          return (
            <li key={relation.id}>
              <button
                type="button"
                class="line"
                title={isPair ? t`Selects both, to change what holds them` : undefined}
                onClick={isPair ? () => selectAll([id, other]) : undefined}
                onPointerEnter={show}
                onPointerLeave={hide}
                onFocus={show}
                onBlur={hide}
              >
                {relationWords(document.value, relation, id)}
              </button>
            </li>
          );
        })}
      </ul>
    </section>
  );
}
