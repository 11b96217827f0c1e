// The cards in the order of their layers, those of a group under its name.

import type { LayerEntry } from '../session/document';
import { t } from '../texts/texts';
import { foldedGroups, toggleGroup } from './folds';
import { Icon } from './Icon';
import { LayerCard } from './LayerCard';

export function CardList({ layers }: { layers: readonly LayerEntry[] }) {
  const card = (entry: LayerEntry) => (
    <LayerCard key={entry.key} entry={entry} first={entry === layers[0]} last={entry === layers.at(-1)} />
  );
  const seen = new Set<string>();
  return (
    <>
      {layers.map((entry) => {
        const { group } = entry;
        if (group === undefined) return card(entry);
        if (seen.has(group)) return null;
        seen.add(group);
        const isFolded = foldedGroups.value.has(group);
        const members = layers.filter((other) => other.group === group);
        return (
          <li key={`group ${group}`} class="card-group" aria-label={t`Group ${group}`}>
            <button type="button" class="line" aria-expanded={!isFolded} onClick={() => toggleGroup(group)}>
              <Icon name={isFolded ? 'right' : 'down'} />
              <span>{group}</span> <span class="quiet">{members.length}</span>
            </button>
            {!isFolded && <ul class="cards">{members.map(card)}</ul>}
          </li>
        );
      })}
    </>
  );
}
