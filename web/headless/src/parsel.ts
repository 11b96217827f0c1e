#!/usr/bin/env node
// The command `parsel`: those of the core, and two of its own for many models.
import { batch } from './batch';
import { Misuse, Refusal, reasonOf } from './fault';
import { type Command, parseOptions } from './options';
import { runTool } from './tool';
import { worker } from './worker';

const own: readonly Command[] = [batch, worker];
const usageOf = ({ name, usage, summary }: Command) => `  parsel ${name} ${usage}\n      ${summary}\n`;

async function run(args: readonly string[]): Promise<number> {
  const [name, ...rest] = args;
  const command = own.find((one) => one.name === name);
  if (command === undefined) {
    const code = await runTool(args);
    if (name === '--help' || name === '-h') process.stdout.write(`\nFor many models:\n${own.map(usageOf).join('')}`);
    return code;
  }
  if (rest.includes('--help')) {
    process.stdout.write(`Usage: parsel ${command.name} ${command.usage}\n  ${command.summary}\n`);
    return 0;
  }
  return command.run(parseOptions(command, rest));
}

try {
  process.exitCode = await run(process.argv.slice(2));
} catch (error) {
  if (error instanceof Misuse) {
    process.stderr.write(`parsel: ${error.message} (parsel --help lists the commands)\n`);
    process.exitCode = 2;
  } else if (error instanceof Refusal) {
    process.stderr.write(`${error.message}\n`);
    process.exitCode = 1;
  } else {
    process.stderr.write(`cli: internal error: ${reasonOf(error)}; please report it.\n`);
    process.exitCode = 1;
  }
}
