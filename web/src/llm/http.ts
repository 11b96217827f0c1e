// One completion over fetch: time limit, retries with growing pauses, and every failure as an AskError.

import { parseJson } from '../program/json';
import { t } from '../texts/texts';
import { type Adapter, type Call, type Reply, type Target, unreadable } from './adapter';
import { anthropic } from './anthropic';
import { AskError, refusal } from './ask_error';
import { gemini } from './gemini';
import { openai } from './openai';
import type { Protocol } from './providers';
import { redactedJson, redactorOf } from './redact';
import { addSpending } from './spent';

const adapters: Record<Protocol, Adapter> = { openai, anthropic, gemini };

export interface SendOptions {
  readonly signal: AbortSignal;
  readonly fetch?: typeof fetch;
  /** Replaced in tests. */
  readonly sleep?: (milliseconds: number, signal: AbortSignal) => Promise<void>;
  /** Of one attempt, in milliseconds. */
  readonly timeout?: number;
}

const attempts = 4;
const firstPause = 1000; // milliseconds, doubled each time
/** A provider that wants a longer pause than this is told on the page instead. */
const longestPause = 60_000;
const maxReplyBytes = 4 << 20;

/** Schemas that a provider turned out to refuse for a model: it is asked without them from then on. */
const unstructured = new Set<string>();

/** @throws AskError; or the signal's reason */
export async function complete(target: Target, call: Call, options: SendOptions): Promise<Reply> {
  const adapter = adapters[target.provider.protocol];
  // A picture is refused in the same way as a schema.
  const name = `${target.base} ${target.model} ${call.picture !== undefined} ${JSON.stringify(call.schema)}`;
  const sleep = options.sleep ?? pause;
  for (let attempt = 1; ; attempt++) {
    const schema = unstructured.has(name) ? null : call.schema;
    try {
      const { url, headers, body } = adapter.request(target, { ...call, schema });
      const json = await exchange(url, { method: 'POST', headers, body: JSON.stringify(body) }, target, options);
      const tokens = adapter.tokens(json);
      addSpending(target, tokens);
      return { text: adapter.read(json, new URL(url).host), tokens };
    } catch (error) {
      options.signal.throwIfAborted();
      if (!(error instanceof AskError)) throw error;
      // Some say of an option that they do not know that the model does not know it.
      if (schema !== null && (error.kind === 'request' || error.kind === 'model_unknown')) {
        unstructured.add(name);
        continue;
      }
      const isPassing = error.kind === 'rate' || error.kind === 'server';
      if (!isPassing || attempt === attempts) throw error;
      const wanted = error.retryAfter ?? firstPause * 2 ** (attempt - 1) * (0.75 + Math.random() / 2);
      if (wanted > longestPause) throw error;
      await sleep(wanted, options.signal);
    }
  }
}

/** Names of the models that the provider offers to this key. @throws AskError */
export async function listModels(target: Target, options: SendOptions): Promise<string[]> {
  const { url, headers } = adapters[target.provider.protocol].models(target);
  const json = (await exchange(url, { method: 'GET', headers }, target, options)) as Record<string, unknown>;
  const list = json.data ?? json.models;
  if (!Array.isArray(list)) return [];
  return list
    .map((item: { id?: unknown; name?: unknown }) => item?.id ?? item?.name)
    .filter((name) => typeof name === 'string')
    .map((name) => name.replace(/^models\//, ''));
}

async function exchange(url: string, request: RequestInit, target: Target, options: SendOptions): Promise<unknown> {
  const { host } = new URL(url);
  // A model on this machine may have to be read from the disk first.
  const timeout = options.timeout ?? (target.provider.keysAt === null ? 600_000 : 180_000);
  const limit = AbortSignal.timeout(timeout);
  try {
    const response = await (options.fetch ?? fetch)(url, {
      ...request,
      signal: AbortSignal.any([options.signal, limit]),
      // The key must not follow a redirection to another host, nor the page's address go along with it.
      redirect: 'error',
      credentials: 'omit',
      referrerPolicy: 'no-referrer',
      cache: 'no-store',
    });
    const redact = redactorOf(target.key);
    const text = redact(await readText(response, host));
    const json = redactedJson(parsed(text), redact); // a key may have been spelt in escapes
    if (!response.ok) throw refusal(response.status, wordsOf(json) || text, host, retryAfter(response.headers));
    // OpenRouter reports failures of those behind it under a 200.
    const inner = errorOf(json);
    if (inner !== null) throw refusal(Number(inner.code) || 502, wordsOf(json), host, null);
    if (json === undefined) throw unreadable(host);
    return json;
  } catch (error) {
    options.signal.throwIfAborted();
    if (error instanceof AskError) throw error;
    if (limit.aborted)
      throw new AskError(
        'timeout',
        host,
        t`gave no answer within ${timeout / 1000} seconds`,
        t`Try again, or choose a faster model`,
      );
    throw unreachable(target, host);
  }
}

/** fetch says no more than that it failed. */
function unreachable({ provider }: Target, host: string): AskError {
  if (globalThis.navigator?.onLine === false)
    return new AskError(
      'offline',
      '',
      t`This machine is offline`,
      t`Connect it and send again: your request is still here`,
    );
  if (provider.keysAt === null)
    return new AskError(
      'blocked',
      host,
      t`cannot be reached from this page: the server is not running, or does not allow this page (CORS)`,
      provider.pitfalls[0]
        ? t`Start it. ${t(provider.pitfalls[0]).replace(/\.$/, '')}`
        : t`Start it, and allow this page`,
    );
  return new AskError(
    'blocked',
    host,
    t`could not be reached, or the browser may not read its answer (CORS): some gateways answer a wrong key that way`,
    t`Check the key first, then the base URL, the connection, and whether an extension blocks the host`,
  );
}

async function readText(response: Response, host: string): Promise<string> {
  const reader = response.body?.pipeThrough(new TextDecoderStream()).getReader();
  let text = '';
  for (;;) {
    const chunk = await reader?.read();
    if (chunk === undefined || chunk.done) return text;
    text += chunk.value;
    if (text.length > maxReplyBytes) {
      void reader?.cancel();
      throw unreadable(host);
    }
  }
}

function parsed(text: string): unknown {
  const json = parseJson(text);
  return json.ok ? json.value : undefined;
}

function errorOf(json: unknown): Record<string, unknown> | null {
  const error = (json as { error?: unknown } | undefined)?.error;
  return typeof error === 'object' && error !== null ? (error as Record<string, unknown>) : null;
}

/** The message of a refusal with its codes, in any of the forms that providers give it. */
function wordsOf(json: unknown): string {
  if (Array.isArray(json)) return wordsOf(json[0]); // Gemini
  const top = (json ?? {}) as Record<string, unknown>;
  const error = errorOf(json) ?? top;
  return [error.message, error.code, error.type, error.status, top.error, top.detail]
    .filter((part) => typeof part === 'string')
    .join(' ');
}

/** Milliseconds, or null: the header is in seconds or a date, and only there when the provider shows it to pages. */
function retryAfter(headers: Headers): number | null {
  const value = headers.get('Retry-After');
  if (value === null) return null;
  const seconds = Number(value);
  const wait = Number.isNaN(seconds) ? Date.parse(value) - Date.now() : seconds * 1000;
  return Number.isNaN(wait) ? null : Math.max(0, wait);
}

function pause(milliseconds: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(done, milliseconds);
    function done() {
      clearTimeout(timer);
      signal.removeEventListener('abort', done);
      if (signal.aborted) reject(signal.reason);
      else resolve();
    }
    signal.addEventListener('abort', done);
  });
}
