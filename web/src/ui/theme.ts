// Light or dark: the system's, unless chosen here. The stage takes its colours from the style sheet.
import { computed, effect, signal } from '@preact/signals';

export type Choice = 'system' | 'light' | 'dark';
const storageKey = 'parsel-theme';

const stored = (): Choice => {
  try {
    const value = localStorage.getItem(storageKey);
    return value === 'light' || value === 'dark' ? value : 'system';
  } catch {
    return 'system'; // storage is closed to us
  }
};

const query = matchMedia('(prefers-color-scheme: dark)');
const systemDark = signal(query.matches);
query.addEventListener('change', () => {
  systemDark.value = query.matches;
});
export const choice = signal<Choice>(stored());
export const isDark = computed(() => (choice.value === 'system' ? systemDark.value : choice.value === 'dark'));

effect(() => {
  // An attribute that style/base.css answers, not a style: only there does the build see what light-dark() depends on.
  if (choice.value === 'system') delete document.documentElement.dataset['theme'];
  else document.documentElement.dataset['theme'] = choice.value;
  try {
    localStorage.setItem(storageKey, choice.value);
  } catch {
    // it lasts as long as the page, then
  }
});

export function toggleTheme(): void {
  choice.value = isDark.value ? 'light' : 'dark';
}

/** The same as in style/base.css, whose light-dark() the canvas cannot read. */
const palette = {
  light: { accent: '#2361cf', quiet: '#5a5f66', ground: '#f3f3f0' },
  dark: { accent: '#7fabff', quiet: '#a4a9b0', ground: '#17181a' },
} as const;

export const theme = computed(() => {
  const { accent, quiet, ground } = palette[isDark.value ? 'dark' : 'light'];
  return { accent, quiet, dark: isDark.value, accentRgb: rgb(accent), groundRgb: rgb(ground) };
});

function rgb(hex: string): [number, number, number] {
  return [1, 3, 5].map((at) => Number.parseInt(hex.slice(at, at + 2), 16) / 255) as [number, number, number];
}
