import { defineConfig } from 'vitest/config';

export default defineConfig({
  root: '..',
  cacheDir: 'web/node_modules/.vite',
  test: {
    include: ['tests/e2e/**/*.test.ts'],
    environment: 'node',
    fileParallelism: false,
    testTimeout: 60_000,
    hookTimeout: 60_000,
  },
});
