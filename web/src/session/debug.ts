// With `?debug` in its address, the page hands its core to the console (and to the tests) as `parsel`.
import type { CoreClient } from '../worker/client';
import { core } from './core';

export interface DebugHandle {
  /** The running core. Throws while it starts. */
  client(): CoreClient;
}

export function exposeForDebugging(): void {
  if (!new URLSearchParams(location.search).has('debug')) return;
  const handle: DebugHandle = {
    client() {
      if (core.value.kind !== 'ready') throw new Error('the core is not ready');
      return core.value.client;
    },
  };
  Object.assign(globalThis, { parsel: handle });
}
