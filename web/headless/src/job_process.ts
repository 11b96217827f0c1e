// A process of the pool: does one task after the other.
import { Worker } from 'node:worker_threads';
import { reasonOf } from './fault';
import type { Answer, Task } from './pool';
import { runTool } from './tool';

// Ctrl+C reaches the whole group; the batch says when to end.
process.on('SIGINT', () => {});
process.on('disconnect', () => process.exit());

// While a task runs nothing else is heard here, so a thread looks whether the batch is still alive.
const parent = process.ppid;
new Worker(
  `const { ppid } = process;
   setInterval(() => { if (process.ppid !== ${parent}) process.kill(process.pid, 'SIGKILL'); }, 1000);`,
  { eval: true },
).unref();

process.on('message', async ({ args, memory }: Task) => {
  let answer: Answer;
  try {
    answer = { code: await runTool(args, memory) };
  } catch (error) {
    answer = { crash: reasonOf(error) };
  }
  process.send?.(answer);
});
