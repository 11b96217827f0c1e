// One question about all relations of a kind, where the page asks one about each: the prompts of relation_validity_*, put
// together. What it costs and whether it is as right: cost.mjs.
import { createHash } from 'node:crypto';

/** `text` with `old` replaced wherever it stands, which must be somewhere. */
function swap(text, old, by) {
  if (!text.includes(old)) throw new Error(`The prompt does not say '${old}': this file must follow.`);
  return text.replaceAll(old, by);
}

const questions = {
  relation_validity_reflection: ['You decide this for *one* pair: shall it be kept?', 'pair'],
  relation_validity_group: ['You decide this for *one* group: shall it be kept?', 'group'],
};

function together(task, prompts) {
  const [question, noun] = questions[task];
  const relations = prompts.map(({ text }) => /^The relation in question is (.*)$/m.exec(text)[1]);
  let text = swap(prompts[0].text, question, `You decide this for each ${noun} of a list: which are to be given up?`);
  text = swap(
    text,
    '`{"keep": true}` or `{"keep": false}`.',
    `\`{"give_up": [id, …]}\` with the ids, in quotes, of those to be given up. Usually that is none of them: \`{"give_up": []}\`.`,
  );
  // An example's answer is about the relation that it names.
  text = text.replace(/^Relation (\w+):([\s\S]*?)\{"keep": (true|false)\}/gm, (_, id, between, keep) => {
    return `Relation ${id}:${between}{"give_up": [${keep === 'true' ? '' : `"${id}"`}]}`;
  });
  text = swap(
    text,
    `The relation in question is ${relations[0]}`,
    `The relations in question are\n${relations.map((relation) => `- ${relation}`).join('\n')}`,
  );
  return swap(
    text,
    'This question is about this one relation only. Others are asked about separately.',
    'Look at each relation in question by itself: that one is given up says nothing of the others.',
  );
}

/** @param prompts of the page. @returns [{task, relation: null, relations: [ids], text, hash}], one a kind that is there */
export function batchedPrompts(prompts) {
  return Object.keys(questions).flatMap((task) => {
    const own = prompts.filter((prompt) => prompt.task === task);
    if (own.length === 0) return [];
    const text = together(task, own);
    const hash = createHash('sha256').update(text).digest('hex');
    return [{ task, relation: null, relations: own.map(({ relation }) => relation), text, hash }];
  });
}

/**
 * The answer to such a question as answers to the page's questions.
 * @returns Map of relation → reply; null when it cannot be read
 */
export function separated({ relations }, reply) {
  const block = /```json\s*([\s\S]*?)```\s*$/.exec(reply)?.[1];
  try {
    const gone = JSON.parse(block).give_up;
    if (!Array.isArray(gone) || gone.some((id) => !relations.includes(id))) return null;
    return new Map(relations.map((id) => [id, `\`\`\`json\n{"keep": ${!gone.includes(id)}}\n\`\`\``]));
  } catch {
    return null;
  }
}
