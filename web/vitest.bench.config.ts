import { defineConfig } from 'vitest/config';
import browserTests from './vitest.e2e.config';

export default defineConfig({
  ...browserTests,
  test: { ...browserTests.test, include: ['tests/bench/**/*.bench.ts'], testTimeout: 600_000 },
});
