// What can be done with the parts that are selected.
import type { ComponentChildren } from 'preact';
import type { Shape } from '../program/types';
import { carveModel, keysOf, whyUncarvable } from '../session/carving';
import { models } from '../session/core';
import { beginCut, cutting } from '../session/cutting';
import { nameOf } from '../session/document';
import { document, isolate, select, selectAll, selected, setHidden, task } from '../session/session';
import { alike, realParts } from '../session/several';
import { t } from '../texts/texts';
import { listWords } from './words';

/**
 * @param onEdit begins an edit by hand of all of them
 * @param children what they are to each other
 */
export function SelectionBar({
  shape,
  onEdit,
  children,
}: {
  shape: Shape;
  onEdit: () => void;
  children?: ComponentChildren;
}) {
  const ids = selected.value;
  const [first] = ids;
  if (first === undefined) return null;
  const real = realParts(shape, ids);
  const like = alike(shape, first);
  const firstNames = ids.slice(0, 4).map((id) => nameOf(document.value, id));
  const { hidden } = document.value;
  const isReal = new Set(real);
  const isAlone = shape.parts.every(({ id, virtual }) => virtual || isReal.has(id) !== hidden.has(id));
  return (
    <section class="selection" aria-label={t`Selection`}>
      {ids.length > 1 && (
        <h3>
          {t`${real.length} parts selected`}
          <span class="quiet">{listWords(firstNames, 3, ids.length)}</span>
        </h3>
      )}
      {children}
      <div class="chips">
        {like.length > real.length && (
          <button
            type="button"
            class="chip-button"
            title={t`Those of its label, its mirror images, and those in a row with it`}
            onClick={() => selectAll([first, ...like.filter((id) => id !== first)])}
          >
            {t`All ${like.length} like this`}
          </button>
        )}
        <button type="button" class="chip-button" aria-pressed={isAlone} title="I" onClick={() => isolate(ids)}>
          {isAlone ? t`Show all` : real.length > 1 ? t`Show only these` : t`Show only this`}
        </button>
        {real.length > 0 && <ByHand shape={shape} ids={ids} real={real} />}
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
              {t`Hide them`}
            </button>
            <button type="button" class="chip-button" onClick={onEdit}>
              {t`Edit together`}
            </button>
          </>
        )}
      </div>
    </section>
  );
}

/** What can be made of the parts themselves: one of several, several of one. */
function ByHand({ shape, ids, real }: { shape: Shape; ids: readonly string[]; real: readonly string[] }) {
  const why = whyUncarvable(document.value);
  const isOff = why !== null || models.value === null || task.value !== null || cutting.value !== null;
  const carve = (step: Parameters<typeof carveModel>[1]) => {
    if (models.value !== null) void carveModel(models.value, step);
  };
  return (
    <>
      {real.length > 1 ? (
        <button
          type="button"
          class="chip-button"
          disabled={isOff}
          title={why ?? t`Makes one part of them, if they are of one material`}
          onClick={() => carve({ kind: 'join', parts: keysOf(shape, ids) })}
        >
          {t`Join to one part`}
        </button>
      ) : (
        <button
          type="button"
          class="chip-button"
          disabled={isOff}
          title={why ?? t`Pieces of it that do not hang together become parts of their own`}
          onClick={() => carve({ kind: 'divide', part: keysOf(shape, real)[0] ?? '' })}
        >
          {t`Split into pieces`}
        </button>
      )}
      <button
        type="button"
        class="chip-button"
        disabled={isOff}
        title={why ?? t`Cuts by a plane that you place`}
        onClick={() => beginCut(shape)}
      >
        {t`Cut…`}
      </button>
    </>
  );
}
