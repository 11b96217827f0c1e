// Gemini's own protocol: POST {base}/models/{model}:generateContent.

import * as v from 'valibot';
import { t } from '../texts/texts';
import { type Adapter, cutOff, outputBudget, unreadable } from './adapter';
import { AskError, quoted } from './ask_error';
import { plainReply, structuredPrompt, structuredSchema } from './structure';

const count = v.fallback(v.number(), 0);
const replySchema = v.object({
  candidates: v.optional(
    v.array(
      v.object({
        finishReason: v.optional(v.string()),
        content: v.optional(
          v.object({
            parts: v.optional(
              v.array(v.looseObject({ text: v.optional(v.string()), thought: v.optional(v.boolean()) })),
            ),
          }),
        ),
      }),
    ),
  ),
  promptFeedback: v.optional(v.object({ blockReason: v.optional(v.string()) })),
});
const usageSchema = v.object({
  usageMetadata: v.object({ promptTokenCount: count, candidatesTokenCount: count, thoughtsTokenCount: count }),
});

export const gemini: Adapter = {
  request: ({ base, model, key }, { prompt, schema, picture }) => ({
    url: `${base}/models/${encodeURIComponent(model.replace(/^models\//, ''))}:generateContent`,
    headers: { 'Content-Type': 'application/json', 'x-goog-api-key': key },
    body: {
      contents: [
        {
          role: 'user',
          parts: [
            { text: schema === null ? prompt : structuredPrompt(prompt) },
            ...(picture === undefined ? [] : [{ inlineData: { mimeType: 'image/png', data: picture } }]),
          ],
        },
      ],
      generationConfig: {
        maxOutputTokens: outputBudget,
        ...(schema === null
          ? {}
          : { responseMimeType: 'application/json', responseJsonSchema: structuredSchema(schema) }),
      },
    },
  }),
  read(json, host) {
    const read = v.safeParse(replySchema, json);
    if (!read.success) throw unreadable(host);
    const { candidates, promptFeedback } = read.output;
    const candidate = candidates?.[0];
    if (candidate?.finishReason === 'MAX_TOKENS') throw cutOff(host);
    const text = (candidate?.content?.parts ?? []).map((part) => (part.thought ? '' : (part.text ?? ''))).join('');
    if (text === '') {
      const reason = promptFeedback?.blockReason ?? candidate?.finishReason;
      if (reason === undefined || reason === 'STOP') throw unreadable(host);
      throw new AskError('unreadable', host, `${t`refuses to answer`}${quoted(reason)}`, t`Say it in other words`);
    }
    return plainReply(text);
  },
  tokens(json) {
    const { success, output } = v.safeParse(usageSchema, json);
    if (!success) return null;
    const { promptTokenCount, candidatesTokenCount, thoughtsTokenCount } = output.usageMetadata;
    return { input: promptTokenCount, output: candidatesTokenCount + thoughtsTokenCount };
  },
  models: ({ base, key }) => ({ url: `${base}/models?pageSize=1000`, headers: { 'x-goog-api-key': key } }),
};
