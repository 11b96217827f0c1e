// Keeps what stands on the stage as a variation, under a name.

import { useSignal } from '@preact/signals';
import { models } from '../session/core';
import { activeLayers } from '../session/evaluation';
import { family as actions, document, sliderValue, step, task } from '../session/session';
import { t } from '../texts/texts';
import { Icon } from './Icon';

/** The name, and the button that keeps. @param onDone when it is kept, or given up */
export function KeepVariation({ onDone, isOpened = false }: { onDone?: () => void; isOpened?: boolean }) {
  const name = useSignal('');
  const typed = name.value.trim();
  const taken = document.value.family?.found.family.variations.some((variation) => variation.name === typed) ?? false;
  return (
    <form
      class="keep-variation"
      onSubmit={async (event) => {
        event.preventDefault();
        if (models.value === null || typed === '' || taken) return;
        if (!(await actions.keepVariation(models.value, typed))) return;
        name.value = '';
        onDone?.();
      }}
    >
      <input
        type="text"
        maxLength={60}
        placeholder={t`Name of what you see`}
        aria-label={t`Name of the variation`}
        value={name.value}
        ref={(element) => {
          if (isOpened && name.peek() === '') element?.focus();
        }}
        onInput={(event) => (name.value = event.currentTarget.value)}
        onKeyDown={(event) => {
          if (event.key === 'Escape') onDone?.();
        }}
      />
      <button type="submit" class="button outlined" disabled={typed === '' || taken || task.value !== null}>
        {taken ? t`Name is taken` : t`Keep as variation`}
      </button>
    </form>
  );
}

/** Beside the edits: what their sliders have made of the model, as a variation of it. */
export function KeepEdited() {
  const isOpen = useSignal(false);
  step.value; // sliders that are being dragged
  const { family } = document.value;
  const isMoved = activeLayers(document.value).some(
    (entry) => !family?.keys.includes(entry.key) && sliderValue(entry) !== 0,
  );
  if (isOpen.value) return <KeepVariation isOpened onDone={() => (isOpen.value = false)} />;
  return (
    <button
      type="button"
      class="button wide"
      disabled={!isMoved || models.value === null || task.value !== null}
      title={
        isMoved
          ? t`What you see becomes one of the model’s variations, which have sliders of their own`
          : t`Move a slider first`
      }
      onClick={() => (isOpen.value = true)}
    >
      <Icon name="grid" /> {t`Keep as variation`}
    </button>
  );
}
