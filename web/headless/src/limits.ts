// The limits that options give to jobs, the same for a batch and a worker.
import { cpus } from 'node:os';
import { type Options, wholeOf } from './options';
import type { Limits } from './perform';
import { mostMemory } from './tool';

export function limitsOf(options: Options): Limits {
  return {
    memory: wholeOf(options, '--memory', 2048, 64, mostMemory),
    seconds: wholeOf(options, '--seconds', 300, 1, 86_400),
    attempts: wholeOf(options, '--attempts', 2, 1, 10),
  };
}

/** How many jobs at a time: one a core. */
export const workersOf = (options: Options): number =>
  wholeOf(options, '--workers', Math.max(1, cpus().length), 1, 1024);
