import { fileURLToPath } from 'node:url';
import preact from '@preact/preset-vite';
import { defineConfig, type Plugin } from 'vite';
import { VitePWA } from 'vite-plugin-pwa';
import { contentSecurityPolicy, modelHosts } from './csp.ts';
import { licencePlugin } from './licences.ts';

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

/** Everything is kept at the first visit, gallery and all, so that the page works without a network. See ui/update.ts. */
const offline = VitePWA({
  includeManifestIcons: false, // they are among the files below
  injectRegister: null, // update.ts does it: an inline script would violate the policy
  manifest: {
    name: 'ParSEL',
    short_name: 'ParSEL',
    description: 'Say how to change a 3D model, and get sliders for how much.',
    start_url: './',
    scope: './',
    display: 'standalone',
    background_color: '#f3f3f0',
    theme_color: '#f3f3f0',
    icons: [
      { src: './icon.svg', sizes: 'any', type: 'image/svg+xml' },
      { src: './icon-512.png', sizes: '512x512', type: 'image/png', purpose: 'any' },
      { src: './icon-512.png', sizes: '512x512', type: 'image/png', purpose: 'maskable' },
    ],
  },
  workbox: {
    globPatterns: ['**/*.{html,js,css,wasm,svg,png,json,glb,scad,txt}'],
    maximumFileSizeToCacheInBytes: 16 * 2 ** 20,
    ignoreURLParametersMatching: [/./], // ?embed and ?debug are the same page
    navigateFallback: null, // one page, and other addresses are none of it
    cleanupOutdatedCaches: true,
  },
});

export default defineConfig({
  define: { __MODEL_HOSTS__: JSON.stringify(modelHosts.join(' ')) },
  base: './', // the built page works from any sub-path
  plugins: [securityPolicy(), preact({ devToolsEnabled: false, prefreshEnabled: false }), licencePlugin(), offline],
  resolve: {
    // CMake builds the module into the top-level build folder.
    alias: { 'parsel-module': fileURLToPath(new URL('../build/wasm/wasm', import.meta.url)) },
  },
  worker: { format: 'es' },
  server: { fs: { allow: ['..'] }, host: '127.0.0.1' },
  preview: { host: '127.0.0.1' },
  build: {
    target: 'es2022',
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 1500,
    // What the page shares with its late pieces in one file: a dozen small ones were 10 kB more, compressed.
    rolldownOptions: {
      output: { codeSplitting: { groups: [{ name: 'shared', test: /web\/src\//, minShareCount: 2 }] } },
    },
  },
});
