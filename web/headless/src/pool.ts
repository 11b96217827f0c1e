// Processes that do jobs. One that crashes, runs out of memory or takes too long costs one job an attempt, and nothing
// else: it is ended and another takes its place.
import { type ChildProcess, fork } from 'node:child_process';
import { fileURLToPath } from 'node:url';

export interface Task {
  /** Arguments of the command line. */
  readonly args: readonly string[];
  /** MiB. */
  readonly memory: number;
  readonly seconds: number;
}

/** What a process says of a task. */
export type Answer = { readonly code: number } | { readonly crash: string };
export type Outcome = Answer | 'late' | 'closed';

/** After so many tasks a process has another take its place, whatever may have gathered in it. */
const tasksAProcess = 500;
const script = fileURLToPath(new URL('./job_process.js', import.meta.url));

export class Pool {
  private readonly idle: Member[] = [];
  private readonly all = new Set<Member>();
  private closed = false;

  /** Does the task in a process that does nothing else meanwhile. */
  async run(task: Task): Promise<Outcome> {
    if (this.closed) return 'closed';
    const member = this.idle.pop() ?? this.start();
    const outcome = await member.run(task);
    if (member.isFit) this.idle.push(member);
    else member.end();
    return this.closed && outcome !== 'late' && 'crash' in (outcome as object) ? 'closed' : outcome;
  }

  /** Process ids, for whoever wants to watch them. */
  get pids(): number[] {
    return [...this.all].map((member) => member.pid);
  }

  /** Ends all processes at once; tasks that run end as 'closed'. */
  close(): void {
    this.closed = true;
    for (const member of this.all) member.end();
  }

  private start(): Member {
    const member = new Member(() => this.all.delete(member));
    this.all.add(member);
    return member;
  }
}

class Member {
  private readonly child: ChildProcess;
  private left = tasksAProcess;
  private isGone = false;

  constructor(leave: () => void) {
    // The core's own words go nowhere: they are in the result. An interruption of the batch is the batch's business.
    this.child = fork(script, { stdio: ['ignore', 'ignore', 'ignore', 'ipc'] });
    this.child.on('error', () => {});
    this.child.once('exit', () => {
      this.isGone = true;
      leave();
    });
  }

  get pid(): number {
    return this.child.pid ?? 0;
  }

  get isFit(): boolean {
    return !this.isGone && this.left > 0;
  }

  end(): void {
    this.left = 0;
    this.child.kill('SIGKILL');
  }

  run(task: Task): Promise<Outcome> {
    --this.left;
    const { child } = this;
    return new Promise((resolve) => {
      const finish = (outcome: Outcome) => {
        clearTimeout(timer);
        child.off('message', finish);
        child.off('exit', onExit);
        if (outcome === 'late') this.end();
        resolve(outcome);
      };
      const onExit = (code: number | null, signal: string | null) =>
        finish({
          crash: signal === null ? `its process ended with code ${code}` : `its process was ended by ${signal}`,
        });
      const timer = setTimeout(() => finish('late'), task.seconds * 1000);
      child.on('message', finish);
      child.once('exit', onExit);
      if (this.isGone) onExit(child.exitCode, child.signalCode);
      else child.send(task, (error) => error && child.kill('SIGKILL'));
    });
  }
}
