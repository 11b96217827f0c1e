// The page's Content-Security-Policy: one text for the built page, the dev and preview servers, and the tests.
import { allowedOrigins } from './src/llm/providers.ts';

/** @param development Vite's hot reload talks to its server over a web socket. */
export function contentSecurityPolicy(development: boolean): string {
  const sockets = development ? ['ws://localhost:*', 'ws://127.0.0.1:*'] : [];
  return [
    "default-src 'self'",
    "script-src 'self' 'wasm-unsafe-eval'",
    "worker-src 'self' blob:",
    `connect-src ${["'self'", 'blob:', 'data:', ...allowedOrigins, ...sockets].join(' ')}`,
    "img-src 'self' blob: data:",
    "object-src 'none'",
    "base-uri 'none'",
    "form-action 'none'",
  ].join('; ');
}
