// What a CAD program does to each of its parts. A union may be cut piece by piece, (A ∪ B) − C = (A − C) ∪ (B − C), so that
// parts stay parts: they keep their names, colours and sliders.
import type { CadTree } from './cad';

interface Step {
  readonly op: 'subtract' | 'intersect';
  readonly by: readonly CadTree[];
}

/** What is done to each part that adds material, innermost first, by its id. Parts to which nothing is done are not in it. */
export function stepsOf(tree: CadTree | undefined): ReadonlyMap<string, readonly Step[]> {
  const found = new Map<string, readonly Step[]>();
  const visit = (node: CadTree, around: readonly Step[]): void => {
    if (typeof node === 'string') {
      if (around.length > 0) found.set(node, around);
      return;
    }
    const [op, ...children] = node;
    if (op === 'union') for (const child of children) visit(child, around);
    else {
      const [first, ...others] = children;
      const own: Step[] = [];
      if (op === 'difference' && others.length > 0) own.push({ op: 'subtract', by: others });
      if (op === 'intersection') for (const other of others) own.push({ op: 'intersect', by: [other] });
      if (first !== undefined) visit(first, [...own, ...around]);
    }
  };
  if (tree !== undefined) visit(tree, []);
  return found;
}
