import type { Dictionary } from '../web/src/texts/texts';

interface Form {
  readonly hasForms: boolean;
  readonly one?: string;
}
export function saidIn(file: string, code: string): { readonly keys: Map<string, Form>; readonly faults: string[] };
export function dictionaryFaults(language: string, words: Dictionary, keys: ReadonlyMap<string, Form>): string[];
