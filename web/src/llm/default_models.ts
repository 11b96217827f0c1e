// Which model each provider is asked for until the person names another: of middle size and price, and, where the provider
// has one, one that looks at pictures. Names as the providers' own pages and client libraries write them; they age.

/** When the names below were looked up. */
export const lookedUp = '2026-11-28';

const byProvider: Readonly<Record<string, string>> = {
  anthropic: 'claude-sonnet-5-5',
  gemini: 'gemini-3.5-flash',
  openai: 'gpt-5.4-mini',
  openrouter: 'openai/gpt-5-mini',
  groq: 'openai/gpt-oss-120b',
  mistral: 'mistral-medium-latest',
  deepseek: 'deepseek-flash',
  // On one's own machine: what has been fetched there. This one fits into 16 GB.
  ollama: 'gpt-oss:20b',
  lmstudio: 'openai/gpt-oss-20b',
};

/** @param provider its id in providers.ts; empty for one that is not there */
export const defaultModel = (provider: string): string => byProvider[provider] ?? '';
