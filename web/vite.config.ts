import { fileURLToPath } from 'node:url';
import preact from '@preact/preset-vite';
import { defineConfig, type Plugin } from 'vite';
import { contentSecurityPolicy } from './csp';

/** The policy as a <meta> in the page, so that it holds on any static host, and as a header where we are the server. */
function securityPolicy(): Plugin {
  let development = false;
  const setHeader = (
    _request: unknown,
    response: { setHeader(name: string, value: string): void },
    next: () => void,
  ) => {
    response.setHeader('Content-Security-Policy', contentSecurityPolicy(development));
    next();
  };
  return {
    name: 'content-security-policy',
    configResolved(config) {
      development = config.command === 'serve' && !config.isProduction;
    },
    configureServer: (server) => void server.middlewares.use(setHeader),
    configurePreviewServer: (server) => void server.middlewares.use(setHeader),
    transformIndexHtml: () => [
      {
        tag: 'meta',
        attrs: { 'http-equiv': 'Content-Security-Policy', content: contentSecurityPolicy(development) },
        injectTo: 'head-prepend',
      },
    ],
  };
}

export default defineConfig({
  base: './', // the built page works from any sub-path
  plugins: [securityPolicy(), preact({ devToolsEnabled: false, prefreshEnabled: false })],
  resolve: {
    // CMake builds the module into the top-level build folder.
    alias: { 'parsel-module': fileURLToPath(new URL('../build/wasm/wasm', import.meta.url)) },
  },
  worker: { format: 'es' },
  server: { fs: { allow: ['..'] }, host: '127.0.0.1' },
  preview: { host: '127.0.0.1' },
  build: { target: 'es2022', assetsInlineLimit: 0, modulePreload: { polyfill: false }, chunkSizeWarningLimit: 1500 },
});
