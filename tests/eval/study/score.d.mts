export interface Key {
  readonly key: readonly { readonly id: string; readonly index: number; readonly left: 'a' | 'b' }[];
  readonly alike: readonly number[];
}
export interface Preference {
  readonly comparisons: number;
  readonly a: number;
  readonly b: number;
  readonly ties: number;
  readonly agreement: number;
  readonly answers: number;
  readonly left: number;
}
export function score(key: Key, answers: Readonly<Record<string, string>>): Preference;
