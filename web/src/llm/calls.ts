// The calls that answer one question or request: how many there were, what they cost, and why some failed.
import type { Prompt } from '../worker/protocol';
import { AskError } from './ask_error';
import type { Source } from './source';

export class Calls {
  /** That were answered, and their tokens as far as the provider counts them. */
  count = 0;
  readonly tokens = { input: 0, output: 0 };
  readonly failures: AskError[] = [];

  constructor(private readonly source: Source) {}

  /** The text of a reply; why there is none, which is kept as well; null when the signal ended it. */
  async reply(
    prompt: Prompt,
    vote: number,
    schema: object | null,
    signal: AbortSignal,
  ): Promise<string | AskError | null> {
    try {
      signal.throwIfAborted();
      const { text, tokens } = await this.source.reply(prompt, vote, schema, signal);
      this.count++;
      this.tokens.input += tokens?.input ?? 0;
      this.tokens.output += tokens?.output ?? 0;
      return text;
    } catch (error) {
      if (signal.aborted) return null;
      if (!(error instanceof AskError)) throw error;
      this.failures.push(error);
      return error;
    }
  }
}
