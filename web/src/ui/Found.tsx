// What was found in the model, in one line, with a way to what is loose.

import { useMemo } from 'preact/hooks';
import type { Shape } from '../program/types';
import { inventoryOf, inventoryWords } from '../session/inventory';
import { selectAll } from '../session/session';
import { plural, t } from '../texts/texts';
import { focusView } from './view';

export function Found({ shape }: { shape: Shape }) {
  const found = useMemo(() => inventoryOf(shape), [shape]);
  const { loose } = found;
  return (
    <div class="found">
      <p class="quiet">
        {found.parts === 1
          ? t`${inventoryWords(found)}. Only parts that are meshes of their own can move against each other.`
          : inventoryWords(found)}
      </p>
      {loose.length > 0 && (
        <button
          type="button"
          class="chip-button"
          title={t`They touch nothing, so that they stay behind when other parts move. A click selects them.`}
          onClick={() => {
            selectAll(loose);
            focusView();
          }}
        >
          {plural(loose.length, '{n} part hangs loose', '{n} parts hang loose')}
        </button>
      )}
    </div>
  );
}
