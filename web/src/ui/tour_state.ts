// Where the tour stands, and whether it was offered.
import { signal } from '@preact/signals';

const storageKey = 'parsel-tour';

const wasOffered = (): boolean => {
  try {
    return localStorage.getItem(storageKey) !== null;
  } catch {
    return true; // storage is closed to us: do not offer it at every visit
  }
};

/** Number of the step that is shown, or null. */
export const step = signal<number | null>(null);
/** Whether it was offered once, at this visit or before. */
export const offered = signal(wasOffered());

export function settleOffer(): void {
  offered.value = true;
  try {
    localStorage.setItem(storageKey, 'seen');
  } catch {
    // it is offered again at the next visit, then
  }
}

export function startTour(): void {
  settleOffer();
  step.value = 0;
}
