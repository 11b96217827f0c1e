// With `?debug` in its address, the page hands its core and its state to the console (and to the tests) as `parsel`.
import type { CoreClient } from '../worker/client';
import { core, substitute } from './core';
import type { ModelCore } from './model_core';
import { compiled, document } from './session';

export interface DebugHandle {
  /** The running core. Throws while it starts. */
  client(): CoreClient;
  /** Puts another core in its place. */
  substitute(models: ModelCore): void;
  /** Corners of all parts as the sliders stand, part × 24. */
  corners(): number[];
  /** Ids of the parts, in the order of `corners`. */
  parts(): string[];
}

export function exposeForDebugging(): void {
  if (!new URLSearchParams(location.search).has('debug')) return;
  const handle: DebugHandle = {
    client() {
      if (core.value.kind !== 'ready') throw new Error('the core is not ready');
      return core.value.client;
    },
    substitute(models) {
      substitute.value = models;
    },
    corners: () => (compiled.value.kind === 'ready' ? [...compiled.value.evaluator.corners] : []),
    parts: () => document.value.model?.shape.parts.map(({ id }) => id) ?? [],
  };
  Object.assign(globalThis, { parsel: handle });
}
