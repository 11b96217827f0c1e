// Layers on layers: what a new one does is worked out on what the layers before it leave, with their parameters as symbols
// (core/propagate/compose.h). Where these are 0 it is what it was alone: a layer that is off or gone is one at 0.
import type { Layer, Statement } from '../program/types';
import { type Document, type LayerEntry, type OpenModel, programOf, withFreshParameters } from './document';
import { activeLayers } from './evaluation';
import type { History } from './history';
import type { ModelCore, Propagation } from './model_core';

export interface Stack {
  /** The core that composes; without one, layers stay as they are. */
  useCore(core: ModelCore): void;
  /**
   * What was found for the shape at rest, as a layer behind the active ones, or in place of the one named `replacing`. As
   * it was found where the core does not compose it.
   */
  onto(model: OpenModel, found: Propagation, replacing?: number): Promise<Propagation>;
  /** Composes the active layers behind one anew, in the step that has just been made. */
  restack(key: number): Promise<void>;
}

const sameLayers = (a: readonly LayerEntry[], b: readonly LayerEntry[]) =>
  a.length === b.length && a.every(({ layer }, i) => layer === b[i]?.layer);

export function createStack(history: History<Document>): Stack {
  const document = history.present;
  let core: ModelCore | null = null;

  async function onto(model: OpenModel, found: Propagation, replacing?: number): Promise<Propagation> {
    const others = document.peek().layers.filter(({ key }) => key !== replacing);
    const taken = new Set(others.map(({ layer }) => layer.parameter.name));
    const layers = withFreshParameters(found.program.layers, taken);
    const active = activeLayers(document.peek());
    const place = active.findIndex(({ key }) => key === replacing);
    const before = programOf(model.shape, place < 0 ? active : active.slice(0, place)).layers;
    const named = { ...found, program: { ...found.program, layers } };
    if (core === null || before.length === 0) return named;
    try {
      const composed = await core.compose(model, { ...found.program, layers: [...before, ...layers] }, before.length);
      return { ...found, program: { ...found.program, layers: composed.layers.slice(before.length) } };
    } catch {
      return named;
    }
  }

  async function restack(key: number): Promise<void> {
    const { model } = document.peek();
    const { mark } = history;
    const active = activeLayers(document.peek());
    const first = active.findIndex((entry) => entry.key === key);
    if (core === null || model === null || first < 0 || active.length < 2) return;
    let composed: readonly Layer[];
    try {
      composed = (await core.compose(model, programOf(model.shape, active), Math.max(1, first))).layers;
    } catch {
      return;
    }
    const statements = new Map<Layer, readonly Statement[]>();
    active.forEach(({ layer }, i) => {
      const made = composed[i]?.statements ?? layer.statements;
      if (JSON.stringify(made) !== JSON.stringify(layer.statements)) statements.set(layer, made);
    });
    if (statements.size === 0) return;
    history.amend(mark, (state) => {
      if (state.model !== model || !sameLayers(activeLayers(state), active)) return state;
      const layers = state.layers.map((entry) => {
        const made = statements.get(entry.layer);
        return made === undefined ? entry : { ...entry, layer: { ...entry.layer, statements: made } };
      });
      return { ...state, layers };
    });
  }

  return {
    useCore(found) {
      core = found;
    },
    onto,
    restack,
  };
}
