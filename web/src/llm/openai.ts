// The OpenAI protocol, which most others speak as well: POST {base}/chat/completions with a bearer key.

import * as v from 'valibot';
import { t } from '../texts/texts';
import { type Adapter, cutOff, outputBudget, unreadable } from './adapter';
import { AskError, quoted } from './ask_error';
import { plainReply, structuredPrompt, structuredSchema } from './structure';

const count = v.fallback(v.number(), 0);
const replySchema = v.object({
  choices: v.tupleWithRest(
    [
      v.object({
        finish_reason: v.nullish(v.string()),
        message: v.object({ content: v.nullish(v.string()), refusal: v.nullish(v.string()) }),
      }),
    ],
    v.unknown(),
  ),
});
const usageSchema = v.object({ usage: v.object({ prompt_tokens: count, completion_tokens: count }) });

const headersOf = (key: string): Record<string, string> => (key === '' ? {} : { Authorization: `Bearer ${key}` });

/** A message: a text alone, as every server knows it, or with a picture. */
const contentOf = (text: string, picture: string | undefined) =>
  picture === undefined
    ? text
    : [
        { type: 'text', text },
        { type: 'image_url', image_url: { url: `data:image/png;base64,${picture}` } },
      ];

export const openai: Adapter = {
  request({ base, model, key, provider }, { prompt, schema, picture }) {
    const structure = schema === null ? 'none' : provider.structure;
    const format =
      structure === 'schema'
        ? { type: 'json_schema', json_schema: { name: 'reply', schema: structuredSchema(schema as object) } }
        : { type: 'json_object' };
    return {
      url: `${base}/chat/completions`,
      headers: { 'Content-Type': 'application/json', ...headersOf(key) },
      body: {
        model,
        messages: [
          { role: 'user', content: contentOf(structure === 'none' ? prompt : structuredPrompt(prompt), picture) },
        ],
        [provider.limit]: outputBudget,
        ...(structure === 'none' ? {} : { response_format: format }),
        // OpenRouter can answer equal requests from a cache, which would make all votes one: no two requests are equal.
        ...(provider.id === 'openrouter' ? { seed: Math.floor(Math.random() * 2 ** 31) } : {}),
      },
    };
  },
  read(json, host) {
    const read = v.safeParse(replySchema, json);
    if (!read.success) throw unreadable(host);
    const [{ finish_reason, message }] = read.output.choices;
    if (finish_reason === 'length') throw cutOff(host);
    if (message.refusal)
      throw new AskError(
        'unreadable',
        host,
        `${t`refuses to answer`}${quoted(message.refusal)}`,
        t`Say it in other words`,
      );
    if (!message.content) throw unreadable(host);
    return plainReply(message.content);
  },
  tokens(json) {
    const { success, output } = v.safeParse(usageSchema, json);
    return success ? { input: output.usage.prompt_tokens, output: output.usage.completion_tokens } : null;
  },
  models: ({ base, key }) => ({ url: `${base}/models`, headers: headersOf(key) }),
};
