// Adds up the closing lines of doctest and vitest in the given logs: "N passed, N failed".
import { readFileSync } from 'node:fs';

const total = { passed: 0, failed: 0, skipped: 0 };
for (const path of process.argv.slice(2)) {
  // biome-ignore lint/suspicious/noControlCharactersInRegex: terminal colours
  const text = readFileSync(path, 'utf8').replace(/\u001b\[[0-9;]*m/g, '');
  const closing = text.match(/(test cases:|^ *Tests ) .*$/gm)?.at(-1) ?? '';
  for (const kind of Object.keys(total)) total[kind] += Number(closing.match(new RegExp(`(\\d+) ${kind}`))?.[1] ?? 0);
}
process.stdout.write(`\n${total.passed} passed, ${total.failed} failed, ${total.skipped} skipped\n`);
if (total.passed === 0) process.exit(1);
