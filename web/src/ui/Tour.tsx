// A walk through the page in a few steps: offered at the first visit, started again from the help menu, left at any time.
// Its steps come when it is taken.

import { signal } from '@preact/signals';
import { document } from '../session/session';
import { t } from '../texts/texts';
import { Icon } from './Icon';
import { lazily } from './lazily';

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
const offered = signal(wasOffered());

function settleOffer(): void {
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

/**
 * At the first visit, once there is a model: a line that asks, and never asks again. Whoever has added an edit to the one
 * that the visit begins with has found the way, and wants to see the model.
 */
export function TourOffer() {
  const { model, layers } = document.value;
  if (offered.value || step.value !== null || model === null || layers.length > 1) return null;
  return (
    <section class="panel note tour-offer" aria-label={t`Tour`}>
      <span>{t`New here?`}</span>
      <button type="button" class="button" onClick={startTour}>
        {t`Show me around`}
      </button>
      <button type="button" class="button icon-only" aria-label={t`No tour`} onClick={settleOffer}>
        <Icon name="close" />
      </button>
    </section>
  );
}

const TourSteps = lazily(async () => (await import('./TourSteps')).TourSteps);

export const Tour = () => (step.value === null ? null : <TourSteps />);
