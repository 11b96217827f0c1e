// The page's one core: started with the page, and what the page knows about it.
import { signal } from '@preact/signals';
import wasmUrl from 'parsel-module/parsel.wasm?url';
import { type CoreClient, startCore } from '../worker/client';

export type CoreState =
  | { kind: 'starting' }
  | { kind: 'ready'; version: string; client: CoreClient }
  | { kind: 'failed'; text: string };

export const core = signal<CoreState>({ kind: 'starting' });

/** Starts the core, or says in a sentence why it does not run. */
export async function start(): Promise<void> {
  core.value = { kind: 'starting' };
  try {
    const client = await startCore(wasmUrl);
    const { result } = await client.call('version', {});
    core.value = { kind: 'ready', version: result.version, client };
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    core.value = { kind: 'failed', text: `The core could not be loaded (${reason}). Reload the page to try again.` };
  }
}
