import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';

export default defineConfig({
  root: '..',
  cacheDir: 'web/node_modules/.vite',
  resolve: { alias: { 'parsel-module': fileURLToPath(new URL('../build/wasm/wasm', import.meta.url)) } },
  test: {
    include: ['tests/e2e/**/*.test.ts'],
    environment: 'node',
    fileParallelism: false,
    retry: 1, // a machine that stalls for half a minute fails a test; what is broken fails twice
    testTimeout: 120_000,
    expect: { poll: { timeout: 20_000 } }, // a busy machine draws slowly
    hookTimeout: 60_000,
  },
});
