import type { Prompt } from '../../web/src/worker/protocol';

export const variants: readonly string[];
export function variantPrompts(
  variant: string,
  prompts: readonly Prompt[],
): readonly Pick<Prompt, 'task' | 'relation' | 'text' | 'hash'>[];
export function withPicture(
  core: (method: string, parameters: object) => { readonly result: unknown },
  request: string,
  prompts: readonly Prompt[],
): readonly (Prompt & { readonly numbered: readonly string[] })[];
export function readReplies(variant: string): {
  readonly model: string | null;
  readonly date: string | null;
  readonly replies: Readonly<Record<string, string>>;
};
