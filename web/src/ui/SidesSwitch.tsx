// Whose left and right a request means: the object's own, or those of whoever looks at it.

import { facing, speakAsSeen, speaksAsSeen } from '../session/facing';
import { saysSide } from '../session/looking';
import type { Understood } from '../session/request';
import { readFrom, requestText } from '../session/requests';
import { document, task } from '../session/session';
import { t } from '../texts/texts';
import { sideName } from './words';

/** A switch; it counts for the requests that are sent from then on. */
export function SidesSwitch() {
  return (
    <button
      type="button"
      class="whose"
      aria-pressed={speaksAsSeen.value}
      title={t`What “left”, “right”, “front” and “back” of a request mean: the object's own sides, or yours as you look at it`}
      onClick={() => speakAsSeen(!speaksAsSeen.peek())}
    >
      {t`From where I look`}
    </button>
  );
}

/** Under the field, while a side is being typed: whose it will be. */
export function SidesLine() {
  if (!saysSide(requestText.value)) return null;
  return (
    <p class="sides-line">
      <span class="quiet">
        {speaksAsSeen.value
          ? t`Sides are yours, as you look at its ${sideName(facing.value)}`
          : t`Left, right, front and back are the object’s own`}
      </span>
      <SidesSwitch />
    </p>
  );
}

/** In the card of what was understood: whose sides it was read with, and the other reading. */
export function SidesRead({ state }: { state: Understood }) {
  const { typed, own, seen } = state.said;
  if (!saysSide(typed)) return null;
  const isSent = requestText.value === '' || requestText.value === state.typed;
  return (
    <p class="plainly">
      <span class="quiet grow">
        {seen === null
          ? t`Sides: the object’s own`
          : own === typed
            ? t`Sides: yours, as you look at its ${sideName(seen)}`
            : t`Sides: yours, as you look at its ${sideName(seen)}; read as “${own}”`}
      </span>
      <button
        type="button"
        class="button"
        disabled={!isSent || task.value !== null || document.value.model !== state.model}
        onClick={() => void readFrom(state, seen === null ? facing.peek() : null)}
      >
        {seen === null ? t`Read it from where I look` : t`Read it with its own sides`}
      </button>
    </p>
  );
}
