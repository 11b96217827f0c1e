// The package as a folder: what `npm run headless` leaves in web/headless/dist, and how tests run it.
import { type ChildProcess, spawn, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { JobResult } from '../../web/headless/src/store';

export const web = fileURLToPath(new URL('../../web', import.meta.url));
export const tool = join(web, 'headless/dist/parsel.js');

if (!existsSync(tool)) throw new Error('web/headless/dist is not there: npm run headless in web/ builds it');

export interface Ended {
  readonly code: number | null;
  readonly out: string;
  readonly said: string;
}

/** A folder of its own with the gallery in it, and the commands there. */
export class Bench {
  readonly folder = mkdtempSync(join(tmpdir(), 'parsel-batch-'));
  private readonly started = new Set<ChildProcess>();

  constructor() {
    const { code, said } = this.run('gallery', '.');
    if (code !== 0) throw new Error(said);
  }

  run(...args: string[]): Ended {
    const { status, stdout, stderr } = spawnSync(process.execPath, [tool, ...args], {
      cwd: this.folder,
      encoding: 'utf8',
      maxBuffer: 1 << 28,
    });
    return { code: status, out: stdout, said: stderr };
  }

  /** Starts a command; `ended` tells how it went. */
  start(...args: string[]): { child: ChildProcess; ended: Promise<Ended> } {
    const child = spawn(process.execPath, [tool, ...args], { cwd: this.folder, stdio: ['ignore', 'pipe', 'pipe'] });
    this.started.add(child);
    let out = '';
    let said = '';
    child.stdout.on('data', (text) => {
      out += text;
    });
    child.stderr.on('data', (text) => {
      said += text;
    });
    const ended = new Promise<Ended>((resolve) => {
      child.once('close', (code) => resolve({ code, out, said }));
    });
    return { child, ended };
  }

  write(name: string, content: string | Uint8Array | unknown[]): void {
    const text = Array.isArray(content) ? content.map((line) => JSON.stringify(line)).join('\n') : content;
    writeFileSync(join(this.folder, name), text);
  }

  /** The lines of DIR/results.jsonl. */
  results(output: string, file = 'results.jsonl'): JobResult[] {
    const lines = readFileSync(join(this.folder, output, file), 'utf8').split('\n');
    return lines.filter((line) => line !== '').map((line) => JSON.parse(line) as JobResult);
  }

  /** The results that stand under their names, by name. */
  written(output: string): Map<string, JobResult> {
    const folder = join(this.folder, output);
    const found = new Map<string, JobResult>();
    for (const key of existsSync(folder) ? readdirSync(folder) : []) {
      const path = join(folder, key, 'result.json');
      if (key !== '.work' && existsSync(path)) found.set(key, JSON.parse(readFileSync(path, 'utf8')) as JobResult);
    }
    return found;
  }

  end(): void {
    for (const child of this.started) if (child.exitCode === null) child.kill('SIGKILL');
    rmSync(this.folder, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
  }
}

/** The processes that a process started and that run. */
export function childrenOf(pid: number): number[] {
  const { stdout } = spawnSync('pgrep', ['-P', String(pid)], { encoding: 'utf8' });
  return stdout.split('\n').filter(Boolean).map(Number);
}

/** Waits until it is so. @throws after that many seconds, with what was waited for */
export async function until(what: string, seconds: number, isSo: () => boolean | Promise<boolean>): Promise<void> {
  const end = performance.now() + seconds * 1000;
  while (!(await isSo())) {
    if (performance.now() > end) throw new Error(`not after ${seconds} s: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}
