// What can be done with all cards at once: the model as it was while a button is held, every slider back, presets, folding.

import { useSignal } from '@preact/signals';
import { applyPreset, removePreset, resetAll, savePreset } from '../session/page_cards';
import { document, restIsShown, showRest, sliderValue, step } from '../session/session';
import { t } from '../texts/texts';
import { foldAll, folded } from './folds';
import { Icon } from './Icon';
import { Menu, type MenuItem } from './Menu';

export function CardTools() {
  const naming = useSignal(false);
  step.value; // sliders that are being dragged
  const { layers, presets = [] } = document.value;
  if (layers.length === 0) return null;
  const atRest = layers.every((entry) => sliderValue(entry) === 0);
  const allFolded = layers.every(({ key }) => folded.value.has(key));
  const items: MenuItem[] = [
    ...presets.map(({ name }) => ({ label: name, act: () => applyPreset(name) })),
    { label: t`Keep these positions…`, act: () => (naming.value = true) },
    ...presets.map(({ name }) => ({ label: t`Forget “${name}”`, act: () => removePreset(name) })),
  ];
  return (
    <div class="card-tools">
      <CompareButton disabled={atRest} />
      <button type="button" class="button" disabled={atRest} onClick={resetAll}>
        {t`Reset all`}
      </button>
      <Menu label={t`Presets`} items={items}>
        {t`Presets`}
        {presets.length > 0 && ` · ${presets.length}`}
      </Menu>
      <button
        type="button"
        class="button icon-only"
        aria-label={allFolded ? t`Unfold all edits` : t`Fold all edits`}
        title={allFolded ? t`Unfold all` : t`Fold all`}
        onClick={() => foldAll(allFolded ? [] : layers.map(({ key }) => key))}
      >
        <Icon name={allFolded ? 'right' : 'down'} />
      </button>
      {naming.value && <PresetName done={() => (naming.value = false)} />}
    </div>
  );
}

/** Shows the model as it was for as long as it is held, by pointer or by key. */
function CompareButton({ disabled }: { disabled: boolean }) {
  const show = () => showRest(true);
  const hide = () => showRest(false);
  return (
    <button
      type="button"
      class="button"
      aria-pressed={restIsShown.value}
      disabled={disabled}
      title={t`Hold to see the model as it was`}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        show();
      }}
      onPointerUp={hide}
      onPointerCancel={hide}
      onKeyDown={(event) => {
        if (event.key !== ' ' && event.key !== 'Enter') return;
        event.preventDefault();
        show();
      }}
      onKeyUp={hide}
      onBlur={hide}
      onContextMenu={(event) => event.preventDefault()}
    >
      {t`Compare`}
    </button>
  );
}

function PresetName({ done }: { done: () => void }) {
  return (
    <input
      class="preset-name"
      type="text"
      maxLength={80}
      placeholder={t`Name, such as “low and wide”`}
      aria-label={t`Name of the preset`}
      ref={(element) => element?.focus()}
      onBlur={done}
      onKeyDown={(event) => {
        if (event.key === 'Enter') savePreset(event.currentTarget.value);
        if (event.key === 'Enter' || event.key === 'Escape') {
          event.stopPropagation();
          event.currentTarget.blur();
        }
      }}
    />
  );
}
