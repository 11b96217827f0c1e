// The edit that a layer came of, as far as the layer itself tells.
import type { Layer, Statement } from '../program/types';
import type { EditInput } from './document';

/** What was asked for: the statements that are why the others are there; of a layer written by hand, the first. */
export const seedsOf = ({ statements }: Layer): readonly Statement[] => {
  const seeds = statements.filter(({ why }) => why?.kind === 'seed');
  return seeds.length > 0 ? seeds : statements.slice(0, 1);
};

/**
 * The edit that propagation would make the layer of once more: its seeds in x, and the relations that were not to count.
 * Hints are not in a layer: of them, only parts that were to stay where they are come back.
 */
export function editOf(layer: Layer): EditInput {
  const { name } = layer.parameter;
  const inX = (amount: string) => amount.replace(/[a-z][a-z0-9_]*/g, (word) => (word === name ? 'x' : word));
  const seed = seedsOf(layer).map(({ why: _, ...statement }) =>
    'amount' in statement ? { ...statement, amount: inX(statement.amount) } : statement,
  ) as Statement[];
  const fixed = layer.statements.flatMap(({ op, ...rest }) =>
    op === 'keep_fixed' && 'part' in rest && rest.why === undefined ? [rest.part] : [],
  );
  return {
    seed,
    disabled: layer.relations.filter(({ status }) => status === 'disabled').map(({ id }) => id),
    hints: Object.fromEntries(fixed.map((part) => [part, 'keep_fixed' as const])),
  };
}
