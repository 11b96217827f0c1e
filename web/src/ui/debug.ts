// With `?debug` in its address, the page hands its core and its state to the console (and to the tests) as `parsel`.
import type { Evaluator } from '../program/compile';
import type { Stage } from '../scene/stage';
import { autosave } from '../session/autosave';
import { core } from '../session/core';
import type { Document } from '../session/document';
import { addProgram, document, select, selectAll, selected, slide } from '../session/session';
import type { CoreClient } from '../worker/client';
import { currentEvaluator, stage } from './view';

export interface DebugHandle {
  /** The running core. Throws while it starts. */
  client(): CoreClient;
  /** Whether the core has started. */
  isReady(): boolean;
  document(): Document;
  stage(): Stage | null;
  /** What evaluates the program of the layers that are on; null when there is none. */
  evaluator(): Evaluator | null;
  /** Corners of all parts as the sliders stand, part × 24. */
  corners(): number[];
  addProgram: typeof addProgram;
  select: typeof select;
  selectAll: typeof selectAll;
  /** Ids of the selected parts. */
  selected(): readonly string[];
  slide: typeof slide;
  /** Writes the work to the store now; whether it is kept. */
  flushed(): Promise<boolean>;
}

export function exposeForDebugging(): void {
  if (!new URLSearchParams(location.search).has('debug')) return;
  const handle: DebugHandle = {
    client() {
      if (core.value.kind !== 'ready') throw new Error('the core is not ready');
      return core.value.client;
    },
    isReady: () => core.value.kind === 'ready',
    document: () => document.value,
    stage: () => stage.value,
    evaluator: currentEvaluator,
    corners: () => [...(currentEvaluator()?.corners ?? [])],
    addProgram,
    select,
    selectAll,
    selected: () => selected.value,
    slide,
    flushed: autosave.saveNow,
  };
  Object.assign(globalThis, { parsel: handle });
}
