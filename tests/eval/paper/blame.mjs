// Whether the reading of a request that is not met contradicts what was written down for it, or the search made something
// else of a reading that does not.
const kinds = {
  moves: ['translate'],
  scales: ['scale', 'translate'],
  rotates: ['rotate', 'shear'],
  stays: ['keep_fixed'],
};
const kindOf = (op) => op.replace(/_[123]d$/, '');

/** A pair's word for a node, by what its predicates call it, else by the name that the model has. */
function expectedOf(expected, labels, shape) {
  const nodes = new Map(shape.parts.filter(({ virtual }) => !virtual).map((part) => [part.label, `node:${part.node}`]));
  const found = new Map();
  for (const kind of Object.keys(kinds)) {
    for (const label of expected[kind] ?? []) {
      const node = labels.get(label) ?? nodes.get(label);
      if (node) found.set(node, kind);
    }
  }
  return found;
}

/**
 * @param pair of renderSet(). @param edit that the replies came to; null for none
 * @returns "seed …", "hints …", "validity …" with what is wrong, or "search"; null where nothing but predicates was
 *   written down
 */
export function blame({ expected, labels, shape }, edit) {
  if (!expected) return null;
  if (edit === null) return 'seed not understood';
  const wanted = expectedOf(expected, labels, shape);
  const byId = new Map(shape.parts.map((part) => [part.id, part]));
  const nodeOf = (id) => (byId.has(id) ? `node:${byId.get(id).node}` : id);
  const may = new Set((expected.may ?? []).map((label) => labels.get(label) ?? label));
  const wrong = (part, op) => {
    const kind = wanted.get(nodeOf(part));
    return kind !== undefined && !may.has(nodeOf(part)) && !kinds[kind].includes(kindOf(op));
  };
  for (const { part, op, feature = [0, 0, 0] } of edit.seed) {
    // Moving one face of a part is a way to stretch or to turn it.
    const isFace = feature.some((side) => side !== 0);
    if (part && !(isFace && wanted.get(nodeOf(part)) !== 'stays') && wrong(part, op)) return `seed: ${op} of ${part}`;
  }
  for (const [part, hint] of Object.entries(edit.hints ?? {}))
    if (wrong(part, hint)) return `hints: ${hint} for ${part}`;
  const breaks = (expected.breaks ?? []).join(' ');
  const relations = new Map(shape.relations.map((relation) => [relation.id, relation]));
  for (const id of edit.disabled ?? []) {
    const stays = relations.get(id)?.parts.every((part) => wanted.get(nodeOf(part)) === 'stays');
    if (stays && breaks === '') return `validity: ${id} is given up`;
  }
  return 'search';
}
