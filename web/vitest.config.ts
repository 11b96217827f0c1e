import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';

export default defineConfig({
  root: '..',
  cacheDir: 'web/node_modules/.vite',
  resolve: { alias: { 'parsel-module': fileURLToPath(new URL('../build/wasm/wasm', import.meta.url)) } },
  test: {
    include: ['tests/web/**/*.test.ts', 'tests/cli/**/*.test.ts', 'tests/headless/**/*.test.ts'],
    environment: 'node',
    testTimeout: 180_000,
  },
});
