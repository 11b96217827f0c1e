// The program: its layers as cards, what can be asked of this model at once, and the way to an edit by hand.

import type { Signal } from '@preact/signals';
import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { models } from '../session/core';
import { editsOf } from '../session/family_state';
import { loadGallery, type Suggestion } from '../session/gallery';
import { playOnce } from '../session/play';
import { compiled, document, propagate, task } from '../session/session';
import { suggestions } from '../session/suggestions';
import { t } from '../texts/texts';
import { showText } from './actions';
import { CardList } from './CardList';
import { CardTools } from './CardTools';
import { HandPanel } from './HandPanel';
import { Icon } from './Icon';
import { KeepEdited } from './KeepVariation';
import { lazily } from './lazily';
import { OffersPanel } from './OffersPanel';
import { useRecorded } from './recorded';
import { StackVerdict } from './StackVerdict';
import { Together } from './Together';
import type { FeatureKind } from './words';

const SuggestPanel = lazily(async () => (await import('./SuggestPanel')).SuggestPanel);

interface EditsProps {
  /** Null while the edit by hand is closed. */
  readonly pickKind: Signal<FeatureKind | null>;
}

export function EditsPanel({ pickKind }: EditsProps) {
  const { model } = document.value;
  const layers = editsOf(document.value);
  const cards = useRef<HTMLUListElement>(null);
  const known = useRef(layers.length);
  useEffect(() => {
    // One more is a new edit, whose slider is wanted next; several are work that was opened.
    if (layers.length === known.current + 1) cards.current?.lastElementChild?.scrollIntoView({ block: 'nearest' });
    known.current = layers.length;
  }, [layers.length]);
  if (model === null) return <p class="quiet empty">{t`Edits appear here, each with a slider.`}</p>;
  const state = compiled.value;
  return (
    <>
      {layers.length === 0 && pickKind.value === null && (
        <p class="quiet empty">
          {t`No edits yet. Let sliders be suggested, say what to change, or click a part in the view and pull its handles: the others follow.`}
        </p>
      )}
      {state.kind === 'refused' && (
        <p class="broken" role="alert">
          {t`These edits do not go together: ${state.text}`}
        </p>
      )}
      <CardTools />
      <ul class="cards" ref={cards}>
        <CardList layers={layers} />
      </ul>
      <StackVerdict />
      {layers.length > 0 && <Together />}
      {layers.length > 0 && <KeepEdited />}
      {suggestions.asked.value !== null && <SuggestPanel />}
      {pickKind.value === null ? (
        <>
          <OffersPanel />
          <Suggestions />
          <div class="row hand-buttons">
            <button
              type="button"
              class="button wide"
              onClick={() => {
                pickKind.value = 'whole';
              }}
            >
              <Icon name="hand" /> {t`Edit by hand`}
            </button>
            <button type="button" class="button wide" onClick={() => showText(null)}>
              <Icon name="text" /> {t`Write as text`}
            </button>
          </div>
        </>
      ) : (
        <HandPanel
          pickKind={pickKind}
          onDone={() => {
            pickKind.value = null;
          }}
        />
      )}
    </>
  );
}

/** Known edits of a gallery model, one click each. */
function Suggestions() {
  const recorded = useRecorded();
  const found = useSignal<readonly Suggestion[]>([]);
  const { model, layers } = document.value;
  const id = model?.source.kind === 'gallery' ? model.source.id : null;
  useEffect(() => {
    let current = true;
    void loadGallery().then((gallery) => {
      if (current) found.value = gallery.find((entry) => entry.id === id)?.suggestions ?? [];
    });
    return () => {
      current = false;
    };
  }, [id, found]);
  const made = new Set(layers.map(({ layer }) => layer.request));
  const open = found.value.filter(({ request, edit }) => edit !== null && !made.has(request));
  // Where requests are recorded, the request box offers those.
  if (open.length === 0 || recorded.length > 0) return null;
  return (
    <section class="suggestions" aria-label={t`Suggestions`}>
      <h3>{t`Try`}</h3>
      {open.map(({ request, edit }) => (
        <button
          key={request}
          type="button"
          class="chip-button"
          disabled={models.value === null || task.value !== null}
          onClick={async () => {
            if (models.value === null || edit === null) return;
            const key = await propagate(models.value, edit, request);
            if (key !== null) playOnce(key);
          }}
        >
          {request}
        </button>
      ))}
    </section>
  );
}
