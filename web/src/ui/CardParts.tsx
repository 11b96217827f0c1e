// Small parts of an edit's card: folding it, naming its group.

import { useRef } from 'preact/hooks';
import type { LayerEntry } from '../session/document';
import { setGroup } from '../session/page_cards';
import { document } from '../session/session';
import { t } from '../texts/texts';
import { folded, toggleFold } from './folds';
import { Icon } from './Icon';

export function FoldButton({ id, title }: { id: number; title: string }) {
  const isFolded = folded.value.has(id);
  return (
    <button
      type="button"
      class="button icon-only fold"
      aria-label={isFolded ? t`Unfold ${title}` : t`Fold ${title}`}
      aria-expanded={!isFolded}
      onClick={() => toggleFold(id)}
    >
      <Icon name={isFolded ? 'right' : 'down'} />
    </button>
  );
}

export function GroupField({ entry, done }: { entry: LayerEntry; done: () => void }) {
  const cancelled = useRef(false);
  const known = new Set(document.value.layers.flatMap(({ group }) => group ?? []));
  return (
    <>
      <input
        class="group-name"
        type="text"
        list="card-groups"
        value={entry.group ?? ''}
        maxLength={80}
        placeholder={t`Name of the group; empty for none`}
        aria-label={t`Group of the edit`}
        ref={(element) => element?.focus()}
        onBlur={(event) => {
          done();
          if (!cancelled.current) setGroup(entry.key, event.currentTarget.value);
        }}
        onKeyDown={(event) => {
          cancelled.current = event.key === 'Escape';
          if (event.key === 'Enter' || event.key === 'Escape') event.currentTarget.blur();
        }}
      />
      <datalist id="card-groups">
        {[...known].map((name) => (
          <option key={name} value={name} />
        ))}
      </datalist>
    </>
  );
}
