// A walk through the page in a few steps: offered at the first visit, started again from the help menu, left at any time.
// Its steps come when it is taken.

import { document } from '../session/session';
import { t } from '../texts/texts';
import { Icon } from './Icon';
import { lazily } from './lazily';
import { offered, settleOffer, startTour, step } from './tour_state';

/**
 * At the first visit, once there is a model: a line that asks, and never asks again. Whoever has added an edit to the one
 * that the visit begins with has found the way, and wants to see the model.
 */
export function TourOffer() {
  const { model, layers } = document.value;
  if (offered.value || step.value !== null || model === null || layers.length > 1) return null;
  return (
    <section class="panel note tour-offer tour-first" aria-label={t`Tour`}>
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
