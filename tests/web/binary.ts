// The command-line tool for tests that hold the page against it: PARSEL_CLI or one of build/native-*/core/parsel.
import { execFileSync } from 'node:child_process';
import { existsSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

/** Null without one that can evaluate: such tests are skipped. */
export function findBinary(): string | null {
  const builds = fileURLToPath(new URL('../../build', import.meta.url));
  const folders = existsSync(builds) ? readdirSync(builds).filter((name) => name.startsWith('native-')) : [];
  const candidates = [process.env.PARSEL_CLI ?? '', ...folders.map((name) => join(builds, name, 'core/parsel'))];
  return candidates.find((path) => path !== '' && existsSync(path) && canEvaluate(path)) ?? null;
}

function canEvaluate(binary: string): boolean {
  try {
    return /^\s*(parsel )?evaluate\b/m.test(execFileSync(binary, ['--help'], { encoding: 'utf8' }));
  } catch {
    return false;
  }
}
