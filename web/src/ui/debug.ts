// With `?debug` in its address, the page hands its core and its state to the console (and to the tests) as `parsel`.
import type { Stage } from '../scene/stage';
import { core, models, substitute } from '../session/core';
import type { Document } from '../session/document';
import type { ModelCore } from '../session/model_core';
import { addProgram, compiled, document, slide } from '../session/session';
import type { CoreClient } from '../worker/client';
import { stage } from './view';

export interface DebugHandle {
  /** The running core. Throws while it starts. */
  client(): CoreClient;
  /** Whether the core has started. */
  isReady(): boolean;
  /** Puts these in place of what the core does. Throws while it starts. */
  substitute(replaced: Partial<ModelCore>): void;
  document(): Document;
  stage(): Stage | null;
  /** Corners of all parts as the sliders stand, part × 24. */
  corners(): number[];
  addProgram: typeof addProgram;
  slide: typeof slide;
}

export function exposeForDebugging(): void {
  if (!new URLSearchParams(location.search).has('debug')) return;
  const handle: DebugHandle = {
    client() {
      if (core.value.kind !== 'ready') throw new Error('the core is not ready');
      return core.value.client;
    },
    isReady: () => core.value.kind === 'ready',
    substitute(replaced) {
      if (models.value === null) throw new Error('the core is not ready');
      substitute.value = { ...models.value, ...replaced };
    },
    document: () => document.value,
    stage: () => stage.value,
    corners: () => (compiled.value.kind === 'ready' ? [...compiled.value.evaluator.corners] : []),
    addProgram,
    slide,
  };
  Object.assign(globalThis, { parsel: handle });
}
