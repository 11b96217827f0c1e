// The right panel: the edits, and beside them the family of a CAD program or of kept variations.

import type { Signal } from '@preact/signals';
import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { document } from '../session/session';
import { t } from '../texts/texts';
import { EditsPanel } from './EditsPanel';
import { lazily } from './lazily';
import type { FeatureKind } from './words';

const FamilyPanel = lazily(async () => (await import('./FamilyPanel')).FamilyPanel);

export function RightPanel({ pickKind }: { readonly pickKind: Signal<FeatureKind | null> }) {
  const tab = useSignal<'family' | 'edits'>('family');
  const { family, model, layers } = document.value;
  const edits = layers.length - (family?.keys.length ?? 0);
  useEffect(() => {
    tab.value = 'family';
  }, [model?.files, tab]);
  useEffect(() => {
    if (edits > 0) tab.value = 'edits'; // a new edit, whose slider is wanted next
  }, [edits, tab]);
  const hasFamily = family !== undefined;
  const seen = useRef(model?.files);
  useEffect(() => {
    if (hasFamily && seen.current === model?.files) tab.value = 'family'; // a variation was kept
    seen.current = model?.files;
  }, [hasFamily, model?.files, tab]);
  if (family === undefined) return <EditsPanel pickKind={pickKind} />;
  return (
    <>
      <div class="tabs family-tabs">
        {(['family', 'edits'] as const).map((name) => (
          <button
            key={name}
            type="button"
            aria-pressed={tab.value === name}
            onClick={() => {
              tab.value = name;
            }}
          >
            {name === 'family' ? t`Family` : t`Edits`}
          </button>
        ))}
      </div>
      {tab.value === 'family' ? <FamilyPanel /> : <EditsPanel pickKind={pickKind} />}
    </>
  );
}
