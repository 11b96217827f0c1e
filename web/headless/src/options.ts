// Arguments of the commands that are written here, by the rules and in the words of core/cli/parsel.cpp.
import { Misuse } from './fault';

export interface Command {
  readonly name: string;
  /** What follows the name. */
  readonly usage: string;
  readonly summary: string;
  /** Options that take a value. */
  readonly values: readonly string[];
  readonly flags: readonly string[];
  /** @returns the exit code */
  run(options: Options): Promise<number>;
}

export interface Options {
  readonly positional: readonly string[];
  readonly values: ReadonlyMap<string, string>;
  readonly flags: ReadonlySet<string>;
}

/** @throws Misuse */
export function parseOptions(command: Command, args: readonly string[]): Options {
  const positional: string[] = [];
  const values = new Map<string, string>();
  const flags = new Set<string>();
  for (let i = 0; i < args.length; ++i) {
    const argument = args[i] as string;
    if (argument.length < 2 || !argument.startsWith('-')) positional.push(argument);
    else if (command.flags.includes(argument)) flags.add(argument);
    else if (!command.values.includes(argument)) throw new Misuse(`${command.name} has no option ${argument}`);
    else if (i + 1 === args.length) throw new Misuse(`${argument} needs a value`);
    else values.set(argument, args[++i] as string);
  }
  return { positional, values, flags };
}

/** The whole number that an option gives. @throws Misuse when it is none between `least` and `most` */
export function wholeOf(options: Options, name: string, otherwise: number, least: number, most: number): number {
  const text = options.values.get(name);
  if (text === undefined) return otherwise;
  const value = /^\d+$/.test(text) ? Number(text) : Number.NaN;
  if (!(value >= least && value <= most)) throw new Misuse(`${name} takes a whole number from ${least} to ${most}`);
  return value;
}
