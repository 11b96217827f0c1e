// The three adapters against a server that speaks their protocols: what is sent, what is read, and what every failure says.
import { afterAll, beforeAll, describe, expect, it, vi } from 'vitest';
import type { Call, Reply, Target } from '../../web/src/llm/adapter';
import { outputBudget } from '../../web/src/llm/adapter';
import { AskError, type AskFailure } from '../../web/src/llm/ask_error';
import { complete, listModels, type SendOptions } from '../../web/src/llm/http';
import { type Protocol, providerOf } from '../../web/src/llm/providers';
import { spent } from '../../web/src/llm/spent';
import { type Behaviour, type ProviderServer, startProviders } from './provider_server';

let providers: ProviderServer;
beforeAll(async () => {
  providers = await startProviders();
});
afterAll(() => {
  providers.server.closeAllConnections();
  providers.server.close();
});

const protocols = ['openai', 'anthropic', 'gemini'] as const;
const text = 'It says wider.\n```json\n{"edits":[]}\n```\n';
const schema = { type: 'object', properties: { edits: { type: 'array' } }, required: ['edits'] };
let models = 0;

/** A model of its own each time: what is learnt of one must not matter to another test. */
function target(protocol: Protocol, change: Partial<Target> = {}): Target {
  const provider = providerOf(protocol);
  if (provider === undefined) throw new Error(protocol);
  return { provider, base: providers.base(protocol), model: `tester-${models++}`, key: 'sk-secret', ...change };
}

async function send(to: Target, call: Partial<Call> = {}, options: Partial<SendOptions> = {}): Promise<Reply> {
  const signal = new AbortController().signal;
  return complete(to, { prompt: 'widen', schema: null, ...call }, { signal, sleep: async () => {}, ...options });
}

async function failure(
  protocol: Protocol,
  behaviour: Behaviour,
  options: Partial<SendOptions> = {},
): Promise<AskError> {
  providers.behave(() => behaviour);
  const error = await send(target(protocol), {}, options).catch((reason: unknown) => reason);
  if (!(error instanceof AskError)) throw new Error(`no AskError but ${String(error)}`);
  return error;
}

describe.each(protocols)('%s', (protocol) => {
  it('counts what it spends, of an answer that is cut off as well', async () => {
    const to = target(protocol);
    const own = () => spent.value.find(({ model }) => model === to.model);
    providers.behave(() => ({ kind: 'reply', text }));
    await send(to);
    providers.behave(() => ({ kind: 'cut_off' }));
    await expect(send(to)).rejects.toThrow('cut the reply off');
    providers.behave(() => ({ kind: 'status', status: 401, body: {} }));
    await expect(send(to)).rejects.toThrow('does not accept the key');
    expect(own()).toEqual({
      provider: protocol,
      model: to.model,
      answers: 2,
      uncounted: 0,
      input: 2000,
      output: 400,
    });
  });

  it('sends the prompt with the key and reads the reply and its tokens', async () => {
    providers.behave(() => ({ kind: 'reply', text }));
    const to = target(protocol);
    expect(await send(to)).toEqual({ text, tokens: { input: 1000, output: 200 } });
    const [call] = providers.calls;
    expect(call?.prompt).toBe('widen');
    expect(call?.model).toBe(to.model);
    expect(JSON.stringify(call?.headers)).toContain('sk-secret');
    expect(JSON.stringify(call?.body)).not.toContain('sk-secret');
    expect(JSON.stringify(call?.body)).not.toContain('temperature');
    expect(JSON.stringify(call?.body)).toContain(String(outputBudget));
  });

  it('holds the reply to the schema, thoughts first, and gives it back as a reply without it', async () => {
    providers.behave(() => ({ kind: 'reply', text }));
    const { text: read } = await send(target(protocol), { schema });
    expect(JSON.stringify(providers.calls[0]?.body)).toContain('"thinking"');
    expect(read).toBe('It says wider.\n\n```json\n{"edits":[]}\n```\n');
  });

  it('keeps what a schema refers to where the references look for it', async () => {
    providers.behave(() => ({ kind: 'reply', text }));
    const edit = { type: 'object' };
    await send(target(protocol), { schema: { oneOf: [{ $ref: '#/$defs/edit' }], $defs: { edit } } });
    const body = JSON.stringify(providers.calls[0]?.body);
    expect(body).toContain('"answer":{"anyOf":[{"$ref":"#/$defs/edit"}]}');
    expect(body).toContain('"additionalProperties":false,"$defs":{"edit":{"type":"object"}}');
  });

  it('goes on without the schema when the model refuses it, and remembers that', async () => {
    providers.behave(({ prompt }) =>
      prompt === 'widen'
        ? { kind: 'reply', text }
        : { kind: 'status', status: 400, body: { error: { message: 'response format is not supported' } } },
    );
    const to = target(protocol);
    expect((await send(to, { schema })).text).toBe(text);
    expect(providers.calls).toHaveLength(2);
    await send(to, { schema });
    expect(providers.calls).toHaveLength(3);
  });

  it('lists models', async () => {
    expect(await listModels(target(protocol), { signal: new AbortController().signal })).toEqual(['tester']);
  });

  const refused = (status: number, message: string, code = ''): Behaviour => ({
    kind: 'status',
    status,
    body: { error: { message, code, type: code } },
  });
  it.each<[string, Behaviour, AskFailure, RegExp]>([
    ['a wrong key', refused(401, 'Incorrect API key provided'), 'wrong_key', /does not accept the key.*Check the key/],
    ['a key that Gemini calls invalid', refused(400, 'API key not valid.'), 'wrong_key', /does not accept the key/],
    ['no credit', refused(402, 'Insufficient credits'), 'no_credit', /no credit left.*Top it up/],
    ['a quota that is used up', refused(429, 'quota', 'insufficient_quota'), 'no_credit', /no credit left/],
    ['a low balance', refused(400, 'Your credit balance is too low'), 'no_credit', /no credit left/],
    ['an unknown model', refused(404, 'The model `x` does not exist'), 'model_unknown', /Check the model’s name/],
    ['an unknown model as a bad request', refused(400, 'x is not a valid model ID'), 'model_unknown', /model’s name/],
    ['a page that it does not know', refused(403, 'forbidden'), 'forbidden', /OLLAMA_ORIGINS/],
    ['a prompt that is too long', refused(413, 'too long'), 'request', /refuses the request \(413\).*too long/],
    ['a fault of its own', refused(503, 'overloaded'), 'server', /fault of its own \(503\)/],
    ['a reply that was cut off', { kind: 'cut_off' }, 'cut_off', /cut the reply off/],
    ['a page of HTML', { kind: 'raw', body: '<html>Sign in</html>' }, 'unreadable', /Check that the base URL/],
    ['JSON of another form', { kind: 'raw', body: '{"__proto__":{"choices":1}}' }, 'unreadable', /cannot read/],
    ['an endless reply', { kind: 'endless' }, 'unreadable', /cannot read/],
    ['a connection that is dropped', { kind: 'drop' }, 'blocked', /wrong key that way.*Check the key first/],
  ])('says what to do about %s', async (_, behaviour, kind, sentence) => {
    const error = await failure(protocol, behaviour);
    expect(error.kind).toBe(kind);
    expect(error.message).toMatch(sentence);
    expect(error.message).not.toContain('sk-secret');
    expect(error.value).toMatchObject({ stage: 'llm', place: expect.stringMatching(/^127\.0\.0\.1:/) });
  });

  const key = 'sk-proj-A1b2C3d4E5f6G7h8';
  const escaped = [...key].map((c) => `\\u${c.charCodeAt(0).toString(16).padStart(4, '0')}`).join('');
  it.each([
    ['whole', key],
    ['cut', `${key.slice(0, 17)}...`],
    ['in upper case', key.toUpperCase()],
    ['just before what is quoted ends', `${'y '.repeat(78)}${key}`],
  ])('never shows a key that a refusal echoes %s', async (_, echo) => {
    providers.behave(() => refused(401, `Incorrect API key provided: ${echo} and more`));
    const error = await send(target(protocol, { key })).catch((reason: unknown) => reason as AskError);
    expect(error).toBeInstanceOf(AskError);
    expect(String((error as AskError).message).toLowerCase()).not.toContain(key.slice(0, 12).toLowerCase());
    expect((error as AskError).message).toContain('[key]');
  });

  it('never shows a key that stands in escapes, in a page, or in what a model says', async () => {
    const raw: Behaviour = { kind: 'raw', body: `{"error":{"message":"bad ${escaped}"}}` };
    providers.behave(() => raw);
    const said = await send(target(protocol, { key })).catch((reason: unknown) => String(reason));
    expect(said).toMatch(/bad \[key\]/);
    providers.behave(() => ({ kind: 'reply', text: `Your key is ${key}.` }));
    expect((await send(target(protocol, { key }))).text).toBe('Your key is [key].');
  });

  it('cuts what a hostile provider says, and takes its control characters out', async () => {
    const error = await failure(
      protocol,
      refused(418, `\u001b[31m\u202e<img src=x onerror=alert(1)>${'x'.repeat(9999)}`),
    );
    expect(error.message.length).toBeLessThan(600);
    // biome-ignore lint/suspicious/noControlCharactersInRegex: they must not be there
    expect(error.message).not.toMatch(/[\u001b\u202e]/);
  });
});

describe('waiting', () => {
  it('tries again after the pause that a 429 asks for', async () => {
    let left = 2;
    providers.behave(() =>
      left-- > 0 ? { kind: 'status', status: 429, body: {}, headers: { 'Retry-After': '7' } } : { kind: 'reply', text },
    );
    const sleep = vi.fn(async () => {});
    await send(target('openai'), {}, { sleep });
    expect(sleep.mock.calls.map(([wait]: unknown[]) => wait)).toEqual([7000, 7000]);
  });

  it('pauses longer each time after faults, and gives up after four attempts', async () => {
    const sleep = vi.fn(async (_: number) => {});
    const error = await failure('anthropic', { kind: 'status', status: 529, body: {} }, { sleep });
    expect(error.kind).toBe('server');
    expect(providers.calls).toHaveLength(4);
    const waits = sleep.mock.calls.map(([wait]) => wait);
    for (const [i, wait] of waits.entries()) {
      expect(wait).toBeGreaterThanOrEqual(750 * 2 ** i);
      expect(wait).toBeLessThanOrEqual(1250 * 2 ** i);
    }
    expect(waits).toHaveLength(3);
  });

  it('does not wait for an hour', async () => {
    const behaviour = { kind: 'status', status: 429, body: {}, headers: { 'Retry-After': '3600' } } as const;
    const error = await failure('gemini', behaviour);
    expect(error.kind).toBe('rate');
    expect(providers.calls).toHaveLength(1);
  });

  it('does not try a wrong key twice', async () => {
    await failure('openai', { kind: 'status', status: 401, body: {} });
    expect(providers.calls).toHaveLength(1);
  });

  it('ends at its time limit', async () => {
    const error = await failure('openai', { kind: 'reply', text, after: 2000 }, { timeout: 50 });
    expect(error.message).toMatch(/gave no answer within 0.05 seconds/);
  });

  it('ends at once when it is cancelled, also during a pause', async () => {
    providers.behave(() => ({ kind: 'status', status: 500, body: {} }));
    const controller = new AbortController();
    const sending = complete(target('openai'), { prompt: 'x', schema: null }, { signal: controller.signal });
    await vi.waitFor(() => expect(providers.calls).toHaveLength(1));
    controller.abort();
    await expect(sending).rejects.toThrow('aborted');
    expect(providers.calls).toHaveLength(1);
  });
});

describe('what single providers want', () => {
  const bodyTo = async (id: string, call: Partial<Call> = {}) => {
    providers.behave(() => ({ kind: 'reply', text }));
    await send(target('openai', { provider: providerOf(id) ?? target('openai').provider }), call);
    return providers.calls[0]?.body ?? {};
  };

  it('no two requests to OpenRouter are equal, so that its cache cannot answer', async () => {
    const first = await bodyTo('openrouter');
    expect(await bodyTo('openrouter')).not.toEqual(first);
  });

  it('OpenAI gets its own name of the output limit, the others the old one', async () => {
    expect(await bodyTo('openai')).toHaveProperty('max_completion_tokens', outputBudget);
    expect(await bodyTo('mistral')).toHaveProperty('max_tokens', outputBudget);
    expect(await bodyTo('mistral')).not.toHaveProperty('max_completion_tokens');
  });

  it('DeepSeek gets JSON mode without a schema', async () => {
    expect(await bodyTo('deepseek', { schema })).toHaveProperty('response_format', { type: 'json_object' });
  });

  it('a failure that OpenRouter reports under a 200 is one', async () => {
    const body = JSON.stringify({ error: { code: 402, message: 'Insufficient credits' } });
    expect((await failure('openai', { kind: 'raw', body })).kind).toBe('no_credit');
  });

  it('a redirection is not followed: the key stays with the host that it was entered for', async () => {
    const headers = { Location: `${providers.base('anthropic')}/messages` };
    const error = await failure('openai', { kind: 'status', status: 307, body: {}, headers });
    expect(error.kind).toBe('blocked');
    expect(providers.calls).toHaveLength(1);
  });
});
