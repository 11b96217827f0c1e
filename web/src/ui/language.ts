// In which language the page speaks: the one that was chosen here, else the first of the browser's that there is.

import { say } from '../session/session';
import { type Dictionary, type Language, language, languages, speak, t } from '../texts/texts';

const storageKey = 'parsel-language';

/** Dictionaries are fetched when they are needed. */
const dictionaries: Readonly<Record<Language, () => Promise<Dictionary>>> = {
  en: async () => ({}),
  de: async () => (await import('../texts/de.json')).default,
};

const known = (id: string | null | undefined): id is Language => typeof id === 'string' && Object.hasOwn(languages, id);

function preferred(): Language {
  try {
    const stored = localStorage.getItem(storageKey);
    if (known(stored)) return stored;
  } catch {
    // storage is closed to us
  }
  return navigator.languages.map((tag) => tag.split('-')[0]).find(known) ?? 'en';
}

async function load(next: Language): Promise<void> {
  speak(next, await dictionaries[next]());
  document.documentElement.lang = next;
}

/** Before anything is shown. A dictionary that cannot be fetched leaves the page in English, which is said. */
export async function speakPreferred(): Promise<void> {
  const next = preferred();
  await load(next).catch(() => say(unfetched(next), 'error'));
}

/** From now on, and for the next visits. What was said before stays in the language that it was said in. */
export async function changeLanguage(next: Language): Promise<void> {
  try {
    await load(next);
  } catch {
    say(unfetched(next), 'error');
    return;
  }
  try {
    localStorage.setItem(storageKey, next);
  } catch {
    // it lasts as long as the page, then
  }
}

const unfetched = (next: Language): string =>
  t`The words for ${languages[next]} could not be fetched: is the network there? Choose the language again then.`;

/** Those that the page does not speak now, by their own names. */
export const otherLanguages = (): [Language, string][] =>
  (Object.entries(languages) as [Language, string][]).filter(([id]) => id !== language.value);
