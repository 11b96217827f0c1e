import { describe, expect, it } from 'vitest';
import { redactorOf } from '../../web/src/llm/redact';

const key = 'sk-ant-api03-AbCdEfGhIjKl';

describe('a key in a text', () => {
  it.each([
    ['nothing of it', 'no key here', 'no key here'],
    ['nothing at all', '', ''],
    ['the whole', `a ${key} b`, 'a [key] b'],
    ['it twice, side by side', `${key}${key}`, '[key][key]'],
    ['it twice, apart', `${key} ${key}`, '[key] [key]'],
    ['its beginning', `a ${key.slice(0, 14)}… b`, 'a [key]… b'],
    ['its end', `a …${key.slice(-13)}`, 'a …[key]'],
    ['letters that grow in lower case', `İİ ${key.toUpperCase()} İ`, 'İİ [key] İ'],
    ['fewer letters than tell anything', `a ${key.slice(0, 6)}`, `a ${key.slice(0, 6)}`],
  ])('is taken out: %s', (_, text, clean) => {
    expect(redactorOf(key)(text)).toBe(clean);
  });

  it('is known in the coding of an address', () => {
    expect(redactorOf('a+b/c=d+e/f=g')('?key=a%2Bb%2Fc%3Dd%2Be%2Ff%3Dg!')).toBe('?key=[key]!');
  });

  it('may be a word that guards nothing', () => {
    expect(redactorOf('ollama')('ollama is there')).toBe('ollama is there');
    expect(redactorOf('')('x')).toBe('x');
  });
});
