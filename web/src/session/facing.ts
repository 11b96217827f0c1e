// Whose sides a request speaks of: the object's own, or those of whoever looks at it. The choice is part of the work.

import { computed, signal } from '@preact/signals';
import { t } from '../texts/texts';
import type { Side } from './document';
import { change, document } from './session';

/** The side of the object that faces whoever looks at it now; what shows the model keeps it. */
export const facing = signal<Side>('front');

export const speaksAsSeen = computed(() => document.value.sides === 'seen');

/** One step of the history. */
export function speakAsSeen(asSeen: boolean): void {
  if (asSeen === speaksAsSeen.peek()) return;
  change(asSeen ? t`sides from where I look` : t`its own sides`, (now) => {
    const { sides: _, ...rest } = now;
    return asSeen ? { ...rest, sides: 'seen' as const } : rest;
  });
}
