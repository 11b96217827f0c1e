// The service worker: it keeps the whole page, so that it works without a network, and brings newer versions. A newer one
// waits until somebody asks for it; then only the page that asked reloads.

import { signal } from '@preact/signals';
import { autosave } from '../session/autosave';
import { say } from '../session/session';
import { t } from '../texts/texts';

const checkEvery = 60 * 60 * 1000; // milliseconds, besides the check that browsers make at every visit

/** Whether a newer version waits. */
export const updateReady = signal(false);

let registration: ServiceWorkerRegistration | undefined;

/** Call once the page is at rest: what is kept is downloaded in the background. */
export async function keepForOffline(): Promise<void> {
  if (import.meta.env.DEV || !('serviceWorker' in navigator)) return;
  try {
    registration = await navigator.serviceWorker.register('./sw.js', { scope: './' });
    follow(registration);
  } catch {
    // Private windows and pages without https refuse: the page works on, with a network.
  }
}

function follow(found: ServiceWorkerRegistration): void {
  const look = () => {
    if (found.waiting !== null && found.active !== null) updateReady.value = true;
  };
  look();
  found.addEventListener('updatefound', () => found.installing?.addEventListener('statechange', look));
  setInterval(() => void found.update().catch(() => {}), checkEvery);
}

/** Reloads into the newer version, with the work as it is. */
export async function update(): Promise<void> {
  if (!(await autosave.saveNow())) {
    say(t`This browser keeps no work over a reload. Save the session (Export), then reload the page.`, 'error');
    return;
  }
  const waiting = registration?.waiting;
  if (!waiting) return location.reload(); // another page has let it in
  waiting.addEventListener('statechange', () => {
    if (waiting.state === 'activated') location.reload();
  });
  waiting.postMessage({ type: 'SKIP_WAITING' });
}
