// Anthropic's protocol: POST {base}/messages, and the header that lets a page call it.

import * as v from 'valibot';
import { t } from '../texts/texts';
import { type Adapter, cutOff, outputBudget, unreadable } from './adapter';
import { AskError } from './ask_error';
import { plainReply, structuredPrompt, structuredSchema } from './structure';

const count = v.fallback(v.number(), 0);
const replySchema = v.object({
  stop_reason: v.nullish(v.string()),
  content: v.array(v.looseObject({ type: v.string(), text: v.optional(v.string()) })),
});
const usageSchema = v.object({ usage: v.object({ input_tokens: count, output_tokens: count }) });

const headersOf = (key: string): Record<string, string> => ({
  'x-api-key': key,
  'anthropic-version': '2023-06-01',
  'anthropic-dangerous-direct-browser-access': 'true',
});

const contentOf = (text: string, picture: string | undefined) =>
  picture === undefined
    ? text
    : [
        { type: 'image', source: { type: 'base64', media_type: 'image/png', data: picture } },
        { type: 'text', text },
      ];

export const anthropic: Adapter = {
  request: ({ base, model, key }, { prompt, schema, picture }) => ({
    url: `${base}/messages`,
    headers: { 'Content-Type': 'application/json', ...headersOf(key) },
    body: {
      model,
      max_tokens: outputBudget,
      messages: [{ role: 'user', content: contentOf(schema === null ? prompt : structuredPrompt(prompt), picture) }],
      ...(schema === null
        ? {}
        : { output_config: { format: { type: 'json_schema', schema: structuredSchema(schema) } } }),
    },
  }),
  read(json, host) {
    const read = v.safeParse(replySchema, json);
    if (!read.success) throw unreadable(host);
    const { stop_reason, content } = read.output;
    if (stop_reason === 'max_tokens' || stop_reason === 'model_context_window_exceeded') throw cutOff(host);
    if (stop_reason === 'refusal')
      throw new AskError('unreadable', host, t`refuses to answer`, t`Say it in other words`);
    const text = content.map((block) => (block.type === 'text' ? (block.text ?? '') : '')).join('');
    if (text === '') throw unreadable(host);
    return plainReply(text);
  },
  tokens(json) {
    const { success, output } = v.safeParse(usageSchema, json);
    return success ? { input: output.usage.input_tokens, output: output.usage.output_tokens } : null;
  },
  models: ({ base, key }) => ({ url: `${base}/models?limit=1000`, headers: headersOf(key) }),
};
