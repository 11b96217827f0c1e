export interface BatchedPrompt {
  readonly task: string;
  readonly relation: null;
  readonly relations: readonly string[];
  readonly text: string;
  readonly hash: string;
}
export function batchedPrompts(
  prompts: readonly { readonly task: string; readonly relation: string | null; readonly text: string }[],
): BatchedPrompt[];
export function separated(prompt: Pick<BatchedPrompt, 'relations'>, reply: string): Map<string, string> | null;
