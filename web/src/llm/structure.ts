// Structured output that still thinks first: the reply is one object of the thoughts and then the answer, which is turned
// back into what a reply without it looks like, thoughts and one fenced block.

import { parseJson } from '../program/json';

const instruction =
  '\n\nGive the whole reply as one JSON object {"thinking": …, "answer": …}: your thoughts as a text, and then the object' +
  ' that would stand in the fenced block.';

export const structuredPrompt = (prompt: string): string => prompt + instruction;

/** The schema of such an object. Definitions move to its root, where references look for them. */
export function structuredSchema(schema: object): object {
  // All providers know anyOf; the alternatives exclude each other, so that it says the same.
  const portable = JSON.parse(JSON.stringify(schema).replaceAll('"oneOf"', '"anyOf"')) as Record<string, unknown>;
  const { $schema, $defs, ...answer } = portable;
  return {
    type: 'object',
    properties: { thinking: { type: 'string' }, answer },
    required: ['thinking', 'answer'],
    additionalProperties: false,
    ...($defs === undefined ? {} : { $defs }),
  };
}

/** A reply as it came, or the one that a structured reply stands for. */
export function plainReply(text: string): string {
  if (!text.trimStart().startsWith('{')) return text;
  const reply = parseJson(text);
  if (!reply.ok) return text; // the core says what is wrong with it
  const { thinking, answer } = reply.value as { thinking?: unknown; answer?: unknown };
  if (answer === undefined) return text;
  // A fence in the thoughts would be taken for the answer.
  const thoughts = typeof thinking === 'string' ? thinking.replaceAll('```', "'''") : '';
  return `${thoughts}\n\n\`\`\`json\n${JSON.stringify(answer)}\n\`\`\`\n`;
}
