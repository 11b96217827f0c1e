// Who can be asked: hosts, protocols and what each wants said differently. The page's Content-Security-Policy is made from
// this list (web/csp.ts), so that a key can go to none but these hosts.

import { m, type Sentence, t } from '../texts/texts.ts';
export type Protocol = 'openai' | 'anthropic' | 'gemini';

export interface Provider {
  readonly id: string;
  readonly title: string;
  readonly protocol: Protocol;
  /** Everything before `/chat/completions`, `/messages` or `/models/…`. */
  readonly base: string;
  /** Where keys are made; null for servers on this machine, which want none. */
  readonly keysAt: string | null;
  /** How the provider can be held to JSON: to a schema, to some JSON, or not at all. */
  readonly structure: 'schema' | 'json' | 'none';
  /** Whether any of its models looks at pictures. */
  readonly sees: boolean;
  /** Name of the output limit in the OpenAI protocol: its newer models refuse `max_tokens`, other hosts know nothing else. */
  readonly limit: 'max_completion_tokens' | 'max_tokens';
  /** What has to be set up first, in sentences. */
  readonly pitfalls: readonly Sentence[];
}

/** For people: servers on this machine say so. */
export const titleOfProvider = ({ title, keysAt }: Provider): string =>
  keysAt === null ? t`${title} on this machine` : title;

const openai = { protocol: 'openai', structure: 'schema', sees: true, limit: 'max_tokens', pitfalls: [] } as const;

/** Of a page on https and of one on this machine, towards a server on this machine. */
const localPitfalls = [
  m`Chrome asks whether this page may reach your machine: allow it. Safari refuses when the page itself comes over https.`,
  m`A small model may need several tries, and one answer after the other: begin with one vote.`,
] as const;

export const providers: readonly Provider[] = [
  {
    id: 'anthropic',
    title: 'Anthropic',
    protocol: 'anthropic',
    base: 'https://api.anthropic.com/v1',
    keysAt: 'https://console.anthropic.com/settings/keys',
    structure: 'schema',
    sees: true,
    limit: 'max_tokens',
    pitfalls: [],
  },
  {
    id: 'gemini',
    title: 'Google Gemini',
    protocol: 'gemini',
    base: 'https://generativelanguage.googleapis.com/v1beta',
    keysAt: 'https://aistudio.google.com/apikey',
    structure: 'schema',
    sees: true,
    limit: 'max_tokens',
    pitfalls: [],
  },
  {
    ...openai,
    id: 'openai',
    title: 'OpenAI',
    base: 'https://api.openai.com/v1',
    keysAt: 'https://platform.openai.com/api-keys',
    limit: 'max_completion_tokens',
  },
  {
    ...openai,
    id: 'openrouter',
    title: 'OpenRouter',
    base: 'https://openrouter.ai/api/v1',
    keysAt: 'https://openrouter.ai/settings/keys',
  },
  {
    ...openai,
    id: 'groq',
    title: 'Groq',
    base: 'https://api.groq.com/openai/v1',
    keysAt: 'https://console.groq.com/keys',
    limit: 'max_completion_tokens',
  },
  {
    ...openai,
    id: 'mistral',
    title: 'Mistral',
    base: 'https://api.mistral.ai/v1',
    keysAt: 'https://console.mistral.ai/api-keys',
  },
  {
    ...openai,
    id: 'deepseek',
    title: 'DeepSeek',
    base: 'https://api.deepseek.com',
    keysAt: 'https://platform.deepseek.com/api_keys',
    structure: 'json',
    sees: false,
  },
  {
    ...openai,
    id: 'ollama',
    title: 'Ollama',
    base: 'http://localhost:11434/v1',
    keysAt: null,
    pitfalls: [
      m`Ollama answers 403 to pages that it does not know: start it with OLLAMA_ORIGINS set to the address of this page.`,
      m`Its context is short by default and cuts prompts without a word: set OLLAMA_CONTEXT_LENGTH to 16384 or more.`,
      ...localPitfalls,
    ],
  },
  {
    ...openai,
    id: 'lmstudio',
    title: 'LM Studio',
    base: 'http://localhost:1234/v1',
    keysAt: null,
    pitfalls: [
      m`In LM Studio’s Developer tab, start the server and switch “Enable CORS” on.`,
      m`Load the model with a context of 16384 tokens or more.`,
      ...localPitfalls,
    ],
  },
];

export const providerOf = (id: string): Provider | undefined => providers.find((provider) => provider.id === id);

/** Origins that the policy allows, the present machine's with any port. */
export const allowedOrigins: readonly string[] = [
  ...new Set(providers.filter(({ keysAt }) => keysAt !== null).map(({ base }) => new URL(base).origin)),
  'http://localhost:*',
  'http://127.0.0.1:*',
];

/** Whether a model on the present machine answers there. */
export function isLocal(address: string): boolean {
  if (!URL.canParse(address)) return false;
  const { protocol, hostname } = new URL(address);
  return protocol === 'http:' && ['localhost', '127.0.0.1'].includes(hostname);
}

/** Whether the page may send to this address. */
export function isAllowed(address: string): boolean {
  if (!URL.canParse(address)) return false;
  const url = new URL(address);
  if (url.username !== '' || url.password !== '') return false;
  return isLocal(address) || allowedOrigins.includes(url.origin);
}
