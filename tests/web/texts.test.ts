// Sentences in the language of the page, and the check that holds code and dictionaries against each other.
import { afterEach, describe, expect, it } from 'vitest';
import { formatMeasure, parseMeasure } from '../../web/src/session/measure';
import german from '../../web/src/texts/de.json';
import { listed, m, number, plural, price, speak, t } from '../../web/src/texts/texts';
import { dictionaryFaults, saidIn } from '../check_texts.mjs';

afterEach(() => speak('en', {}));

describe('a sentence', () => {
  it('is its own key, with places for values', () => {
    expect(t`Fold ${'Parts'}`).toBe('Fold Parts');
    speak('de', { 'Fold {0}': '{0} einklappen', '{0} of {1}': '{1}: {0}' });
    expect(t`Fold ${'Teile'}`).toBe('Teile einklappen');
    expect(t`${1} of ${2}`).toBe('2: 1');
    expect(t`Unfold ${'Teile'}`).toBe('Unfold Teile');
  });
  it('takes values as they are, braces and all', () => {
    expect(t`Fold ${'{0} {n} $&'}`).toBe('Fold {0} {n} $&');
  });
  it('has its meaning behind an @, which is not said', () => {
    const top = m`top@edge`;
    expect(t(top)).toBe('top');
    speak('de', { 'top@edge': 'oben' });
    expect(t(top)).toBe('oben');
    expect(t`${'somebody@example'} left`).toBe('somebody@example left');
  });
  it('has the plural form of its language', () => {
    const parts = (n: number) => plural(n, '{n} part', '{n} parts');
    expect([0, 1, 2].map(parts)).toEqual(['0 parts', '1 part', '2 parts']);
    speak('de', { '{n} parts': { one: '{n} Teil', other: '{n} Teile' } });
    expect([0, 1, 1200].map(parts)).toEqual(['0 Teile', '1 Teil', '1.200 Teile']);
  });
});

it('numbers are written, and lengths read, as the language does', () => {
  expect([number(1234.5), price(0.0123), price(2), formatMeasure('width', 0.545)]).toEqual([
    '1,234.5',
    '0.0123',
    '2.00',
    '54.5 cm',
  ]);
  expect(formatMeasure('distance', -1e-9, 1)).toBe('0 cm');
  expect(formatMeasure('distance', -0.5, 1)).toBe('−50 cm');
  speak('de', german);
  expect([number(1234.5), price(0.0123), price(2), formatMeasure('width', 0.545)]).toEqual([
    '1.234,5',
    '0,0123',
    '2,00',
    '54,5 cm',
  ]);
  expect(parseMeasure('width', formatMeasure('width', 0.545), 0.5)).toBeCloseTo(0.545);
  expect(listed(['a', 'b', 'c'])).toBe('a, b und c');
});

describe('the check', () => {
  const faults = (code: string) => saidIn('ui/Part.tsx', code).faults;
  it.each([
    ['a text of an element', 'const a = () => <p>Hello there</p>;'],
    ['an attribute', 'const a = () => <p title="Hello">1</p>;'],
    ['a choice', "const a = () => <p>{b ? 'Hello' : ''}</p>;"],
    ['a message', "const a = () => say('Not now');"],
    ['a sentence anywhere', "const a = ['nobody marked this sentence'];"],
    ['t in a constant', 'const a = t`Hello`;'],
    ['m with values', 'const a = m`Hello $' + '{name}`;'],
  ])('finds %s', (_, code) => {
    expect(faults(code)).toHaveLength(1);
  });
  it('leaves alone what nobody reads', () => {
    expect(faults('const a = () => <p class="one two three four" title={t`Hello`}>{t`Hello`} mm</p>;')).toEqual([]);
  });
  it.each([
    ['is missing', {}],
    ['is said nowhere', { 'Fold {0}': '{0} zu', Bye: 'Tschüs' }],
    ['its translation', { 'Fold {0}': 'zu' }],
    ['translated by nothing', { 'Fold {0}': ' ' }],
  ])('says what %s', (what, words) => {
    const { keys } = saidIn('ui/Part.tsx', 'const a = () => t`Fold $' + '{b}`;');
    expect(dictionaryFaults('de', words, keys).join('\n')).toContain(what);
  });
  it.each([
    ['needs its plural forms', '{n} Teile'],
    ['lacks its form “one”', { other: '{n} Teile' }],
    ['“few”', { one: '{n} Teil', few: '{n} Teile', other: '{n} Teile' }],
    ['has no {0}', { one: '{0} Teil', other: '{n} Teile' }],
  ])('says of plural forms what %s', (what, said) => {
    const { keys } = saidIn('ui/Part.tsx', "const a = (n) => plural(n, '{n} part', '{n} parts');");
    expect(dictionaryFaults('de', { '{n} parts': said }, keys).join('\n')).toContain(what);
  });
});
