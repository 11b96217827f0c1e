// What can be done with the parts that are selected.
import type { Shape } from '../program/types';
import { nameOf } from '../session/document';
import { document, isolate, select, selectAll, selected, setHidden } from '../session/session';
import { alike, realParts } from '../session/several';
import { listWords } from './words';

/** @param onEdit begins an edit by hand of all of them */
export function SelectionBar({ shape, onEdit }: { shape: Shape; onEdit: () => void }) {
  const ids = selected.value;
  const [first] = ids;
  if (first === undefined) return null;
  const real = realParts(shape, ids);
  const like = alike(shape, first);
  const { hidden } = document.value;
  const isAlone = shape.parts.every(({ id, virtual }) => virtual || real.includes(id) !== hidden.has(id));
  return (
    <section class="selection" aria-label="Selection">
      {ids.length > 1 && (
        <h3>
          {real.length} parts selected
          <span class="quiet">{listWords(ids.map((id) => nameOf(document.value, id)))}</span>
        </h3>
      )}
      <div class="chips">
        {like.length > real.length && (
          <button
            type="button"
            class="chip-button"
            title="Those of its label, its mirror images, and those in a row with it"
            onClick={() => selectAll([first, ...like.filter((id) => id !== first)])}
          >
            All {like.length} like this
          </button>
        )}
        <button type="button" class="chip-button" aria-pressed={isAlone} title="I" onClick={() => isolate(ids)}>
          {isAlone ? 'Show all' : real.length > 1 ? 'Show only these' : 'Show only this'}
        </button>
        {ids.length > 1 && (
          <>
            <button
              type="button"
              class="chip-button"
              title="H"
              onClick={() => {
                setHidden(real, true);
                select(null);
              }}
            >
              Hide them
            </button>
            <button type="button" class="chip-button" onClick={onEdit}>
              Edit together
            </button>
          </>
        )}
      </div>
    </section>
  );
}
