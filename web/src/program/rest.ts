// Layers whose amounts name the parameters of other layers (core/propagate/compose.h), without these: a layer that is off
// or gone is one whose parameter is 0.
import { functionNames } from './parse';
import type { Layer } from './types';

/** A name in an amount; the e of 1e-3 is none. */
const name = /(?<![a-z0-9_.])[a-z][a-z0-9_]*/g;
const words: ReadonlySet<string> = new Set([...functionNames, 'pi']);

/** The layer with 0 for every parameter that is not `known`; the same layer when there is none. */
export function atRest(layer: Layer, known: ReadonlySet<string>): Layer {
  let changed = false;
  const statements = layer.statements.map((statement) => {
    if (!('amount' in statement)) return statement;
    const amount = statement.amount.replace(name, (word) => (words.has(word) || known.has(word) ? word : '0'));
    if (amount === statement.amount) return statement;
    changed = true;
    return { ...statement, amount };
  });
  return changed ? { ...layer, statements } : layer;
}

/** The layers by themselves: 0 for every parameter that none of them has. */
export function byThemselves(layers: readonly Layer[]): readonly Layer[] {
  const known = new Set(layers.map(({ parameter }) => parameter.name));
  return layers.map((layer) => atRest(layer, known));
}
