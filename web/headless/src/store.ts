// The folder of a batch. A result is a folder of its own with result.json and the files that it speaks of. It is made
// aside and given its name when it is whole: that renaming is the one moment at which a job is done. Only one can win it,
// however many processes on however many machines have done the same job, so that no result is written twice; and what
// dies before leaves nothing under a result's name.
//
//   DIR/<key>/result.json …     results
//   DIR/.work/<host>.<pid>.…    what is being made
//   DIR/results.jsonl           all results, a line each: added to while a batch runs, in the manifest's order at its end
import { randomUUID } from 'node:crypto';
import {
  closeSync,
  existsSync,
  mkdirSync,
  openSync,
  readdirSync,
  readFileSync,
  renameSync,
  rmSync,
  writeFileSync,
  writeSync,
} from 'node:fs';
import { hostname } from 'node:os';
import { join } from 'node:path';
import { codeOf, type Fault, Refusal, reasonOf } from './fault';
import type { Entry } from './manifest';

/** A line of results.jsonl: what the core says of the job, and how it came about. */
export interface JobResult {
  readonly format: 'parsel/result';
  readonly version: 1;
  readonly id: string;
  readonly line: number;
  readonly error?: Fault;
  /** Of the job's text; another one asks for another result. */
  readonly digest: string;
  readonly attempts: number;
  readonly seconds: number;
  readonly [more: string]: unknown;
}

type Named = Pick<Entry, 'key' | 'digest'>;

export class Store {
  private made = 0;
  /** Containers may share both name and process ids. */
  private readonly own = randomUUID().slice(0, 8);
  private readonly host = hostname().replace(/[^\w-]/g, '_');

  /** Makes the folder. @throws Refusal */
  constructor(readonly folder: string) {
    try {
      mkdirSync(join(folder, '.work'), { recursive: true });
    } catch (error) {
      throw this.unwritable(folder, error);
    }
  }

  /** What dead processes of this machine left behind. */
  sweep(): void {
    for (const name of readdirSync(join(this.folder, '.work'))) {
      const [host, pid] = name.split('.');
      if (host === this.host && !isAlive(Number(pid))) {
        rmSync(join(this.folder, '.work', name), { recursive: true, force: true });
      }
    }
  }

  /** A path to make something at that is to get its name later. */
  aside(): string {
    return join(this.folder, '.work', `${this.host}.${process.pid}.${this.own}-${++this.made}`);
  }

  /** The keys that something stands under; of many jobs, a quick look. */
  names(): Set<string> {
    return new Set(readdirSync(this.folder));
  }

  /** Whether something has the name of the result. */
  isTaken({ key }: Pick<Entry, 'key'>): boolean {
    return existsSync(join(this.folder, key));
  }

  /** The result of this very job, or null. @throws Refusal when something else has its name */
  resultOf(entry: Named): JobResult | null {
    const result = this.read(entry.key);
    if (result === 'foreign') throw this.foreign(entry.key);
    return result !== null && result.digest === entry.digest ? result : null;
  }

  /**
   * Gives a folder its name, with the result in it. An older result of another job is replaced.
   * @param from made by aside(); moved, or removed
   * @returns false when the job has a result already, which stays
   */
  commit(entry: Named, from: string, result: JobResult): boolean {
    const to = join(this.folder, entry.key);
    try {
      mkdirSync(from, { recursive: true });
      writeFileSync(join(from, 'result.json'), `${JSON.stringify(result)}\n`);
      for (;;) {
        try {
          renameSync(from, to);
          return true;
        } catch (error) {
          if (!['ENOTEMPTY', 'EEXIST', 'EPERM', 'ENOTDIR'].includes(codeOf(error) ?? '') || !existsSync(to))
            throw error;
        }
        if (this.resultOf(entry) !== null) return false;
        const old = this.aside();
        renameSync(to, old);
        rmSync(old, { recursive: true, force: true });
      }
    } catch (error) {
      throw error instanceof Refusal ? error : this.unwritable(to, error);
    } finally {
      rmSync(from, { recursive: true, force: true });
    }
  }

  /** Writes the results that are there, in this order. @returns how many there are, and how many are errors */
  collect(entries: readonly Entry[], file: string): { done: number; refused: number } {
    const aside = this.aside();
    let done = 0;
    let refused = 0;
    try {
      const out = openSync(aside, 'w');
      for (const entry of entries) {
        const result = this.resultOf(entry);
        if (result === null) continue;
        ++done;
        if (result.error !== undefined) ++refused;
        writeSync(out, `${JSON.stringify(result)}\n`);
      }
      closeSync(out);
      renameSync(aside, join(this.folder, file));
    } catch (error) {
      throw error instanceof Refusal ? error : this.unwritable(join(this.folder, file), error);
    }
    return { done, refused };
  }

  private read(key: string): JobResult | 'foreign' | null {
    const folder = join(this.folder, key);
    // Twice, for another process may give it its name between the two looks.
    for (let look = 0; look < 2; ++look) {
      try {
        const result = JSON.parse(readFileSync(join(folder, 'result.json'), 'utf8')) as JobResult;
        return result.format === 'parsel/result' ? result : 'foreign';
      } catch {
        if (!existsSync(folder)) return null;
      }
    }
    return 'foreign';
  }

  private foreign(key: string): Refusal {
    return new Refusal({
      stage: 'batch',
      place: join(this.folder, key),
      cause: 'it is there and is no result of a batch',
      fix: 'name another folder with -o',
    });
  }

  private unwritable(path: string, error: unknown): Refusal {
    return new Refusal({
      stage: 'batch',
      place: path,
      cause: `it cannot be written (${reasonOf(error)})`,
      fix: 'check that the folder can be written to and has space',
    });
  }
}

function isAlive(pid: number): boolean {
  try {
    process.kill(pid, 0);
    return true;
  } catch (error) {
    return codeOf(error) === 'EPERM';
  }
}
