// The page's one core: started with the page, and what the page knows about it.

import { computed, signal } from '@preact/signals';
import { t } from '../texts/texts';
import type { CoreClient } from '../worker/client';
import { startCore, withModules } from '../worker/modules';
import { type ModelCore, modelCore } from './model_core';

export type CoreState =
  | { kind: 'starting' }
  | { kind: 'ready'; version: string; client: CoreClient }
  | { kind: 'failed'; text: string };

export const core = signal<CoreState>({ kind: 'starting' });

const client = computed(() => (core.value.kind === 'ready' ? core.value.client : null));

/** What the session asks; null until the core is ready. */
export const models = computed<ModelCore | null>(() =>
  client.value === null ? null : modelCore(withModules(client.value)),
);

/** Starts the core, or says in a sentence why it does not run. */
export async function start(): Promise<void> {
  core.value = { kind: 'starting' };
  try {
    const started = await startCore();
    const { result } = await started.call('version', {});
    core.value = { kind: 'ready', version: result.version, client: started };
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    core.value = { kind: 'failed', text: t`The core could not be loaded (${reason}). Reload the page to try again.` };
  }
}
