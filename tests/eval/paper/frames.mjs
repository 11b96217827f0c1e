// The model of a measured request under one of its variants, at settings of the slider.
import { readFileSync } from 'node:fs';
import { loadCore } from '../../../web/tools/core.mjs';
import { missing, renderSet } from '../judged_set.mjs';
import { readNodes } from '../predicates.mjs';

/** What the search looks at; how far a slider goes beyond differs from edit to edit. */
export const searched = 0.35;

/**
 * @param file what judged_requests.mjs --json wrote
 * Ends the program with a sentence when the models are not there.
 * @returns {set, summary, pairs: [{row, rest, at(variant, slider)}]}; at() gives readNodes(), of the model at rest where the
 *   variant came to no program
 */
export async function openResults(file) {
  const { set, summary, rows } = JSON.parse(readFileSync(file, 'utf8'));
  if (missing(set)) {
    process.stdout.write(`${missing(set)}\n`);
    process.exit(0);
  }
  const core = await loadCore();
  const models = new Map(renderSet(core, set).map(({ index, file: glb }) => [index, glb]));
  let open = null;
  const pairs = [];
  for (const row of rows) {
    const glb = models.get(row.index);
    const rest = await readNodes(glb);
    const at = async (variant, slider) => {
      const { program } = row[variant] ?? {};
      if (!program || slider === 0) return rest;
      if (open !== row.model) core('open', { name: row.model, external: [] }, [glb]);
      open = row.model;
      const values = program.layers.map((_, i) => (i === 0 ? slider : 0));
      return readNodes(core('apply', { program, values }).buffers[0]);
    };
    pairs.push({ row, rest, at });
  }
  return { set, summary, pairs };
}
