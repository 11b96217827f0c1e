// An edit reopened: what was asked for, field by field, what other parts should do; and of a count, its other reading.

import { useSignal } from '@preact/signals';
import type { Hint } from '../program/operators';
import { models } from '../session/core';
import type { EditInput, LayerEntry } from '../session/document';
import { editOf } from '../session/layer_seed';
import { otherCount, remake } from '../session/remake';
import { document, task } from '../session/session';
import { m, t } from '../texts/texts';
import { Hints } from './HandPanel';
import { SeedList } from './SeedFields';

export function ChangeCard({ entry, done }: { entry: LayerEntry; done: () => void }) {
  const edit = useSignal<EditInput>(editOf(entry.layer));
  const shape = document.value.model?.shape;
  if (shape === undefined) return null;
  const hints = {
    get value(): ReadonlyMap<string, Hint> {
      return new Map(Object.entries(edit.value.hints));
    },
    set value(next: ReadonlyMap<string, Hint>) {
      edit.value = { ...edit.value, hints: Object.fromEntries(next) };
    },
  };
  return (
    <form
      class="change-card"
      aria-label={t`Change the edit`}
      onSubmit={async (event) => {
        event.preventDefault();
        const core = models.peek();
        if (core !== null && (await remake(core, entry.key, edit.peek()))) done();
      }}
    >
      <SeedList shape={shape} seed={edit.value.seed} onChange={(seed) => (edit.value = { ...edit.value, seed })} />
      <Hints shape={shape} except="" chosen={hints} />
      <div class="row">
        <button type="submit" class="button primary" disabled={task.value !== null || models.value === null}>
          {t`Apply`}
        </button>
        <button type="button" class="button" onClick={done}>
          {t`Cancel`}
        </button>
      </div>
    </form>
  );
}

const otherWords = {
  spacing: m`Keep the spacing instead, so that the row grows`,
  room: m`Keep the room instead, so that they stand closer`,
} as const;

/** A count can keep its room or its spacing: the one that it does not, in one click. */
export function OtherCount({ entry }: { entry: LayerEntry }) {
  const shape = document.value.model?.shape;
  const other = shape === undefined ? null : otherCount(shape, entry);
  if (other === null) return null;
  return (
    <button
      type="button"
      class="line other-count"
      disabled={task.value !== null || models.value === null}
      onClick={() => {
        if (models.peek() !== null)
          void remake(models.peek() as NonNullable<typeof models.value>, entry.key, other.edit);
      }}
    >
      {t(otherWords[other.keeps])}
    </button>
  );
}
