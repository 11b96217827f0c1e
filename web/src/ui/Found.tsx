// What was found in the model that was just opened, in one line, with a way to what is loose. Goes with the first edit.
import { signal } from '@preact/signals';
import type { Shape } from '../program/types';
import { inventoryOf, inventoryWords } from '../session/inventory';
import { document, selectAll, task } from '../session/session';
import { Icon } from './Icon';
import { focusView } from './view';

const dismissed = signal<Shape | null>(null);

export function Found() {
  const { model, layers } = document.value;
  const shape = model?.shape;
  if (shape === undefined || layers.length > 0 || task.value || dismissed.value === shape) return null;
  const found = inventoryOf(shape);
  const { loose } = found;
  return (
    <p class="panel note found">
      <span>
        Found: {inventoryWords(found)}.
        {found.parts === 1 && ' Parts that are meshes of their own can move against each other; this is one.'}
      </span>
      {loose.length > 0 && (
        <button
          type="button"
          class="button"
          title="Shows which: they touch nothing, so that they stay behind when other parts move"
          onClick={() => {
            selectAll(loose);
            focusView();
          }}
        >
          {loose.length === 1 ? '1 part hangs loose' : `${loose.length} parts hang loose`}
        </button>
      )}
      <button type="button" class="button icon-only" aria-label="Dismiss" onClick={() => (dismissed.value = shape)}>
        <Icon name="close" />
      </button>
    </p>
  );
}
