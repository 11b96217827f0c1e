// A request of several changes, each with a slider of its own instead of one for all: what was asked for in one breath is often
// wanted more or less of each.
import type { Statement } from '../program/types';
import { madeBy } from './layers';
import type { ModelCore } from './model_core';
import type { Understood } from './request';
import type { Session } from './session';

/** Whether what came of it moves several things by one slider. */
export const isDivisible = ({ made, edit }: Understood): boolean => made !== null && (edit?.seed.length ?? 0) > 1;

/**
 * Finds for each change of what was understood how the other parts follow, and puts the layers in place of the one that came of
 * all, in its step. What stays and what may break holds for each.
 * @param title of the layer of a change
 * @returns whether it did; if not, the work is as it was, and it was said why
 */
export async function divide(
  session: Session,
  core: ModelCore,
  { edit, made, said }: Understood,
  title: (statement: Statement) => string,
): Promise<boolean> {
  if (edit === null || made === null) return false;
  const found = [];
  for (const statement of edit.seed) {
    const one = await session.find(core, { ...edit, seed: [statement] }, title(statement), made.key);
    if (one === null) return false;
    found.push(one);
  }
  const { seen } = said;
  return session.divideLayer(made.mark, made.key, found, (one) => ({
    ...madeBy(one),
    ...(seen === null ? {} : { seen }),
  }));
}
