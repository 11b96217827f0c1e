// A server on loopback that speaks the three protocols as the providers do, CORS included, and does what a test tells it:
// replies, and every way of not replying.
import { createServer, type IncomingMessage, type Server, type ServerResponse } from 'node:http';
import type { AddressInfo } from 'node:net';
import type { Protocol } from '../../web/src/llm/providers';

export interface ReceivedCall {
  readonly protocol: Protocol;
  readonly model: string;
  readonly prompt: string;
  readonly headers: IncomingMessage['headers'];
  readonly body: Record<string, unknown>;
}

export type Behaviour =
  /** `text` is what a model says: thoughts and a fenced block. */
  | { kind: 'reply'; text: string; after?: number }
  | { kind: 'cut_off' }
  /** @param cors false: without the headers that let a page read it */
  | { kind: 'status'; status: number; body: unknown; headers?: Record<string, string>; cors?: boolean }
  /** A 200 with a body as it stands. */
  | { kind: 'raw'; body: string }
  | { kind: 'drop' }
  | { kind: 'endless' };

export interface ProviderServer {
  readonly server: Server;
  readonly calls: ReceivedCall[];
  /** Base URL of a protocol, as in the settings. */
  base(protocol: Protocol): string;
  behave(behaviour: (call: ReceivedCall) => Behaviour): void;
}

/** What each provider's preflight allows; a header more and the browser sends nothing. */
const allowedHeaders: Record<Protocol, string> = {
  openai: 'content-type, authorization',
  anthropic: 'content-type, x-api-key, anthropic-version, anthropic-dangerous-direct-browser-access',
  gemini: 'content-type, x-goog-api-key',
};

export async function startProviders(): Promise<ProviderServer> {
  const calls: ReceivedCall[] = [];
  let behave = (_: ReceivedCall): Behaviour => ({ kind: 'reply', text: 'ok' });
  const server = createServer(async (request, response) => {
    const path = new URL(request.url ?? '/', 'http://localhost').pathname;
    const protocol = path.split('/')[1] as Protocol;
    const cors = {
      'Access-Control-Allow-Origin': '*',
      'Access-Control-Allow-Headers': allowedHeaders[protocol],
      'Access-Control-Expose-Headers': 'retry-after',
    };
    if (request.method === 'OPTIONS') return response.writeHead(204, cors).end();
    // Anthropic shows itself to pages only when they say that they know what they do.
    const shown = protocol !== 'anthropic' || request.headers['anthropic-dangerous-direct-browser-access'] === 'true';
    const headers = { 'Content-Type': 'application/json', ...(shown ? cors : {}) };
    if (request.method === 'GET') return response.writeHead(200, headers).end(JSON.stringify(modelList(protocol)));
    const body = JSON.parse(await textOf(request)) as Record<string, unknown>;
    const call = { protocol, headers: request.headers, body, ...promptOf(protocol, path, body) };
    calls.push(call);
    const behaviour = behave(call);
    switch (behaviour.kind) {
      case 'reply': {
        await new Promise((resolve) => setTimeout(resolve, behaviour.after ?? 0));
        const text = isStructured(protocol, body) ? structured(behaviour.text) : behaviour.text;
        return response.writeHead(200, headers).end(JSON.stringify(envelope(protocol, text, false)));
      }
      case 'cut_off':
        return response.writeHead(200, headers).end(JSON.stringify(envelope(protocol, 'I think that', true)));
      case 'status':
        return response
          .writeHead(behaviour.status, { ...(behaviour.cors === false ? {} : headers), ...behaviour.headers })
          .end(JSON.stringify(behaviour.body));
      case 'raw':
        return response.writeHead(200, headers).end(behaviour.body);
      case 'drop':
        return response.destroy();
      case 'endless':
        return pour(response.writeHead(200, headers));
    }
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  const origin = `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
  return {
    server,
    calls,
    base: (protocol) => `${origin}/${protocol}/v1`,
    behave(next) {
      behave = next;
      calls.length = 0;
    },
  };
}

async function textOf(request: IncomingMessage): Promise<string> {
  const chunks: Buffer[] = [];
  for await (const chunk of request) chunks.push(chunk as Buffer);
  return Buffer.concat(chunks).toString();
}

function pour(response: ServerResponse): void {
  const more = () => {
    while (!response.destroyed && response.write('x'.repeat(1 << 16)));
  };
  response.on('drain', more);
  more();
}

interface Message {
  content: string | { type: string; text?: string }[];
}

/** The text of a message, which a picture may stand beside. */
const textIn = (content: Message['content'] | undefined) =>
  typeof content === 'string' ? content : (content?.find(({ type }) => type === 'text')?.text ?? '');

function promptOf(protocol: Protocol, path: string, body: Record<string, unknown>): { model: string; prompt: string } {
  if (protocol === 'gemini') {
    const contents = body.contents as { parts: { text: string }[] }[];
    const model = /\/models\/(.+):generateContent$/.exec(path)?.[1] ?? '';
    return { model: decodeURIComponent(model), prompt: contents[0]?.parts[0]?.text ?? '' };
  }
  const expected = protocol === 'openai' ? '/chat/completions' : '/messages';
  if (!path.endsWith(expected)) throw new Error(`${protocol} was asked at ${path}`);
  return { model: String(body.model), prompt: textIn((body.messages as Message[])[0]?.content) };
}

function isStructured(protocol: Protocol, body: Record<string, unknown>): boolean {
  if (protocol === 'openai') return 'response_format' in body;
  if (protocol === 'anthropic') return 'output_config' in body;
  return 'responseJsonSchema' in (body.generationConfig as object);
}

/** What a model that is held to the schema gives instead of its free reply. */
function structured(text: string): string {
  const [, thinking = '', answer = '{}'] = /^(.*?)```json(.*?)```/s.exec(text) ?? [];
  return JSON.stringify({ thinking: thinking.trim(), answer: JSON.parse(answer) });
}

function envelope(protocol: Protocol, text: string, cut: boolean): unknown {
  switch (protocol) {
    case 'openai':
      return {
        choices: [{ finish_reason: cut ? 'length' : 'stop', message: { role: 'assistant', content: text } }],
        usage: { prompt_tokens: 1000, completion_tokens: 200 },
      };
    case 'anthropic':
      return {
        stop_reason: cut ? 'max_tokens' : 'end_turn',
        content: [
          { type: 'thinking', thinking: 'hm' },
          { type: 'text', text },
        ],
        usage: { input_tokens: 1000, output_tokens: 200 },
      };
    case 'gemini':
      return {
        candidates: [
          {
            finishReason: cut ? 'MAX_TOKENS' : 'STOP',
            content: { parts: [{ text: 'hm', thought: true }, { text }] },
          },
        ],
        usageMetadata: { promptTokenCount: 1000, candidatesTokenCount: 150, thoughtsTokenCount: 50 },
      };
  }
}

function modelList(protocol: Protocol): unknown {
  return protocol === 'gemini' ? { models: [{ name: 'models/tester' }] } : { data: [{ id: 'tester' }] };
}
