// What the page says, in the language of whoever reads it. A sentence stands in the code in English and is its own key in
// the dictionary of another language, where `{0}`, `{1}` … stand for what the code puts in: t`Fold ${title}` is
// "Fold {0}". Behind an @ stands what a short one means, where another language has several words for it: "top@edge".
// tests/check_texts.mjs holds code and dictionaries against each other.
import { batch, computed, signal } from '@preact/signals';

/** By their own names. English needs no dictionary. */
export const languages = { en: 'English', de: 'Deutsch' } as const;
export type Language = keyof typeof languages;

/** A translation, or one for each plural category of its language ("one", "other") with `{n}` for the number. */
export type Translation = string | { readonly other: string; readonly [category: string]: string };
export type Dictionary = Readonly<Record<string, Translation>>;

declare const marked: unique symbol;
/** A sentence that is marked with `m` where the language is not yet known, and said with `t` later. */
export interface Sentence {
  readonly [marked]: true;
}

const current = signal<Language>('en');
const dictionary = signal<Dictionary>({});
const plurals = computed(() => new Intl.PluralRules(current.value));

/** The language that is spoken; reading it, as calling `t`, subscribes to it. */
export const language = computed(() => current.value);

/** @param words of that language; those that it lacks are said in English */
export function speak(next: Language, words: Dictionary): void {
  batch(() => {
    current.value = next;
    dictionary.value = words;
  });
}

/** Marks a sentence without values for `t`: constants of a module are made before the language is known. */
export const m = (parts: TemplateStringsArray): Sentence => parts[0] as unknown as Sentence;

/** A sentence in the language of the page. Numbers among the values are written as that language does. */
export function t(sentence: TemplateStringsArray | Sentence, ...values: readonly (string | number)[]): string {
  const key = Array.isArray(sentence)
    ? sentence.reduce((text, part, i) => `${text}{${i - 1}}${part}`)
    : (sentence as unknown as string);
  return filled(dictionary.value[key] as string | undefined, key, values);
}

/**
 * A sentence with a count, in the plural form that it needs.
 * @param n stands for `{n}` in the sentence
 * @param one in English for one
 * @param many in English for any other number; the key in the dictionary
 * @param values for `{0}`, `{1}` …
 */
export function plural(n: number, one: string, many: string, ...values: readonly (string | number)[]): string {
  const form = plurals.value.select(n);
  const said = dictionary.value[many];
  const translated = typeof said === 'object' ? (said[form] ?? said.other) : said;
  return filled(translated, form === 'one' ? one : many, values, n);
}

function filled(translated: string | undefined, english: string, values: readonly (string | number)[], n = 0): string {
  const text = translated ?? english.replace(/@\w+$/, '');
  return text.replace(/\{(\d+|n)\}/g, (whole, at) => {
    const value = at === 'n' ? n : values[Number(at)];
    return value === undefined ? whole : typeof value === 'number' ? number(value) : value;
  });
}

const formats = new Map<string, Intl.NumberFormat>();

/** A number as the language writes it: with as many decimals as given, or those that it has, up to three. */
export function number(value: number, least = 0, most = Math.max(least, 3), useGrouping = true): string {
  const name = [current.value, least, most, useGrouping].join();
  let format = formats.get(name);
  if (format === undefined) {
    const digits = { minimumFractionDigits: least, maximumFractionDigits: most };
    format = new Intl.NumberFormat(current.value, { ...digits, useGrouping });
    formats.set(name, format);
  }
  return format.format(value);
}

/** What a request cost, in whatever currency the prices are. */
export const price = (cost: number): string => (cost < 0.1 ? number(cost, 4) : number(cost, 2, 2));

/** "a, b and c". */
export const listed = (names: readonly string[]): string =>
  names.length < 2 ? (names[0] ?? '') : t`${names.slice(0, -1).join(', ')} and ${names.at(-1) ?? ''}`;
