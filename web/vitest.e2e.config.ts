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
    // Nothing fails for being slow: these tell what hangs from what a busy machine is late with. One test in some hundreds
    // still reads the page between two of its frames; what fails twice is a fault.
    retry: 1,
    testTimeout: 600_000,
    expect: { poll: { timeout: 120_000 } },
    hookTimeout: 240_000,
  },
});
