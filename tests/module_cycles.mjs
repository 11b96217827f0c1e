// Cycles in a graph of modules: what check_includes.mjs and check_imports.mjs have in common.

/**
 * @param graph module → the modules that it needs (a Map of Sets), all of them keys
 * @returns a list of modules for each knot: a shortest way from the first of them back to it, in the order of need
 */
export function cyclesIn(graph) {
  return knotsOf(graph)
    .filter((knot) => knot.length > 1 || graph.get(knot[0]).has(knot[0]))
    .map((knot) => shortestCycle(graph, [...knot].sort()[0], new Set(knot)));
}

/** "a → b → a" */
export const inWords = (cycle) => [...cycle, cycle[0]].join(' → ');

/** Strongly connected components (Tarjan 1972), without recursion. */
function knotsOf(graph) {
  const index = new Map();
  const low = new Map();
  const open = [];
  const isOpen = new Set();
  const knots = [];
  for (const root of graph.keys()) {
    if (index.has(root)) continue;
    const path = [];
    const enter = (node) => {
      index.set(node, index.size);
      low.set(node, index.get(node));
      open.push(node);
      isOpen.add(node);
      path.push({ node, rest: [...graph.get(node)] });
    };
    enter(root);
    while (path.length > 0) {
      const { node, rest } = path.at(-1);
      const next = rest.pop();
      if (next !== undefined) {
        if (!index.has(next)) enter(next);
        else if (isOpen.has(next)) low.set(node, Math.min(low.get(node), index.get(next)));
        continue;
      }
      path.pop();
      const above = path.at(-1)?.node;
      if (above !== undefined) low.set(above, Math.min(low.get(above), low.get(node)));
      if (low.get(node) !== index.get(node)) continue;
      const knot = open.splice(open.indexOf(node));
      for (const member of knot) isOpen.delete(member);
      knots.push(knot);
    }
  }
  return knots;
}

function shortestCycle(graph, from, within) {
  const cameFrom = new Map();
  for (let reached = [from]; ; ) {
    const next = [];
    for (const node of reached) {
      for (const needed of graph.get(node)) {
        if (needed === from) {
          const cycle = [node];
          while (cycle[0] !== from) cycle.unshift(cameFrom.get(cycle[0]));
          return cycle;
        }
        if (!within.has(needed) || cameFrom.has(needed)) continue;
        cameFrom.set(needed, node);
        next.push(needed);
      }
    }
    reached = next;
  }
}
