// The page's Content-Security-Policy: one text for the built page, the dev and preview servers, and the tests.
import { allowedOrigins } from './src/llm/providers.ts';
import { defaultHosts, hostsOf } from './src/session/model_hosts.ts';

/** Hosts that models may be fetched from: those that whoever builds the page names. */
export const modelHosts = hostsOf(process.env['PARSEL_MODEL_HOSTS'] ?? defaultHosts);

/** @param development Vite's hot reload talks to its server over a web socket. */
export function contentSecurityPolicy(development: boolean): string {
  const sockets = development ? ['ws://localhost:*', 'ws://127.0.0.1:*'] : [];
  const models = modelHosts.map((host) => `https://${host}`);
  return [
    "default-src 'self'",
    "script-src 'self' 'wasm-unsafe-eval'",
    "worker-src 'self' blob:",
    `connect-src ${["'self'", 'blob:', 'data:', ...allowedOrigins, ...models, ...sockets].join(' ')}`,
    "img-src 'self' blob: data:",
    "object-src 'none'",
    "base-uri 'none'",
    "form-action 'none'",
  ].join('; ');
}
