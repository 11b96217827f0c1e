// The outliner: groups with their instances, parts, their visibility and names, and the relations of the selected part.
import { useSignal } from '@preact/signals';
import { isGroup, type ShapePart } from '../program/types';
import { nameOf } from '../session/document';
import { document, hovered, pointedAt, renamePart, select, selection, setHidden, showAll } from '../session/session';
import { Icon } from './Icon';
import { relationWords } from './words';

export function PartsPanel() {
  const { model, hidden } = document.value;
  if (model === null) return <p class="quiet empty">The parts of the model are listed here.</p>;
  const { parts } = model.shape;
  const inGroup = new Set(parts.flatMap(({ members }) => members));
  const byId = new Map(parts.map((part) => [part.id, part]));
  return (
    <>
      <ul class="parts">
        {parts
          .filter(({ id }) => !inGroup.has(id))
          .map((part) =>
            part.virtual ? (
              <Group key={part.id} part={part} members={part.members.flatMap((id) => byId.get(id) ?? [])} />
            ) : (
              <PartRow key={part.id} part={part} />
            ),
          )}
      </ul>
      {hidden.size > 0 && (
        <button type="button" class="button wide" onClick={showAll}>
          Show all {hidden.size} hidden
        </button>
      )}
      <Relations />
    </>
  );
}

function Group({ part, members }: { part: ShapePart; members: readonly ShapePart[] }) {
  const open = useSignal(false);
  const holdsSelection = members.some(({ id }) => id === selection.value?.part);
  const isOpen = open.value || holdsSelection;
  return (
    <>
      <PartRow part={part} count={members.length}>
        <button
          type="button"
          class="twist"
          aria-expanded={isOpen}
          aria-label={`${nameOf(document.value, part.id)}: ${isOpen ? 'fold' : 'unfold'}`}
          onClick={() => {
            open.value = !isOpen;
          }}
        >
          <Icon name={isOpen ? 'down' : 'right'} />
        </button>
      </PartRow>
      {isOpen && members.map((member) => <PartRow key={member.id} part={member} inner />)}
    </>
  );
}

interface RowProps {
  readonly part: ShapePart;
  readonly inner?: boolean;
  readonly count?: number;
  readonly children?: preact.ComponentChildren;
}

function PartRow({ part, inner = false, count, children }: RowProps) {
  const { hidden } = document.value;
  const renaming = useSignal(false);
  const name = nameOf(document.value, part.id);
  const ids = part.virtual ? part.members : [part.id];
  const isHidden = ids.every((id) => hidden.has(id));
  const selected = selection.value?.part === part.id;
  return (
    <li class={`part ${selected ? 'selected' : ''} ${inner ? 'inner' : ''} ${isHidden ? 'hidden' : ''}`}>
      {children ?? <span class="twist" />}
      {renaming.value ? (
        <input
          class="rename"
          value={name}
          maxLength={80}
          aria-label={`New name of ${name}`}
          ref={(element) => element?.focus()}
          onBlur={(event) => {
            renaming.value = false;
            renamePart(part.id, event.currentTarget.value.trim());
          }}
          onKeyDown={(event) => {
            if (event.key === 'Escape') event.currentTarget.value = name;
            if (event.key === 'Enter' || event.key === 'Escape') event.currentTarget.blur();
          }}
        />
      ) : (
        <button
          type="button"
          class="name"
          aria-pressed={selected}
          title={`${name} (double-click or F2 renames)`}
          onClick={() => select(selected ? null : part.id)}
          onDblClick={() => {
            renaming.value = true;
          }}
          onKeyDown={(event) => {
            if (event.key === 'F2') renaming.value = true;
          }}
          onPointerEnter={() => {
            hovered.value = part.id;
          }}
          onPointerLeave={() => {
            hovered.value = null;
          }}
        >
          {name}
          {count !== undefined && <span class="quiet"> {count}</span>}
        </button>
      )}
      <button
        type="button"
        class="eye"
        aria-label={`${isHidden ? 'Show' : 'Hide'} ${name}`}
        title={isHidden ? 'Show' : 'Hide (H)'}
        onClick={() => setHidden(ids, !isHidden)}
      >
        <Icon name={isHidden ? 'eyeOff' : 'eye'} />
      </button>
    </li>
  );
}

/** What holds the selected part: pointing at a relation shows its points or its plane. */
function Relations() {
  const { model } = document.value;
  const id = selection.value?.part;
  if (model === null || id === undefined) return null;
  const relations = model.shape.relations.filter(
    (relation) => relation.parts.includes(id) || (isGroup(relation) && relation.parent === id),
  );
  return (
    <section class="relations" aria-label="Relations of the selected part">
      <h3>What holds {nameOf(document.value, id)}</h3>
      {relations.length === 0 && <p class="quiet">Nothing: it stands alone.</p>}
      <ul>
        {relations.map((relation) => {
          const show = () => {
            pointedAt.value = { parts: relation.parts, relations: [relation.id] };
          };
          const hide = () => {
            pointedAt.value = null;
          };
          return (
            <li key={relation.id}>
              <button
                type="button"
                class="line"
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
