// The gate for JSON from outside, and that nothing goes around it.
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { jsonLimits, parseJson } from '../../web/src/program/json';
import { readFragment } from '../../web/src/share/link';
import { readSavedText } from '../../web/src/share/saved';

const nested = (levels: number) => '['.repeat(levels) + ']'.repeat(levels);

describe('JSON from outside', () => {
  it.each(['null', '"[[[["', '"\\\\"', '"\\"[[["', '{"a":[1,{"b":"]"}]}', nested(64), `[${'[],'.repeat(99)}[]]`])(
    'passes as it is: %j',
    (text) => {
      expect(parseJson(text)).toEqual({ ok: true, value: JSON.parse(text) });
    },
  );

  it.each([
    ['one level too deep', nested(65), /character 65: nested deeper than 64/],
    ['200,000 levels deep', nested(200_000), /nested deeper/],
    ['objects 200,000 levels deep', '{"a":'.repeat(200_000), /nested deeper/],
    ['deep behind a text with quotes', `["\\"]",${nested(100)}]`, /nested deeper/],
    ['cut', '{"a":', /breaks off/],
    ['cut in a text', '"a\\', /breaks off/],
    ['nothing', '', /breaks off/],
  ])('is refused: %s', (_, text, sentence) => {
    const read = parseJson(text);
    expect(read.ok ? '' : `${read.error.place}: ${read.error.cause}`).toMatch(sentence);
  });

  it('is refused by its length before it is looked at', () => {
    const read = parseJson(' '.repeat(jsonLimits.length + 1));
    expect(read.ok ? '' : read.error.cause).toBe('it is longer than 16 MB');
  });

  it('of a session or a link is refused in a sentence', async () => {
    const deep = `{"format":"parsel/session","version":1,"model":${nested(200_000)}}`;
    expect(readSavedText(deep)).toMatchObject({ ok: false, text: expect.stringContaining('nested deeper') });
    expect(readSavedText(new Uint8Array(4 * jsonLimits.length + 1))).toMatchObject({
      ok: false,
      text: expect.stringContaining('too large'),
    });
    const long = await readFragment(`#v1.${'A'.repeat(100 * 2 ** 20)}`);
    expect(long).toMatchObject({ ok: false, text: expect.stringContaining('too long') });
  });

  it('has no other way in', () => {
    const src = fileURLToPath(new URL('../../web/src', import.meta.url));
    // Of these, JSON.parse reads what the page has written itself, or what has passed the gate before.
    const own = [
      'program/embedded.ts', // one key, of a text that has passed
      'program/json.ts',
      'program/text_parse.ts', // one token, a text
      'llm/settings.ts',
      'llm/structure.ts', // copies a schema
      'session/tab_name.ts',
      'worker/client.ts', // the core's replies
      'worker/decompress.ts', // session/files.ts has read it before, here and below
      'formats/read_gltf.ts',
    ];
    const runtime = '../runtime/src';
    const pathsIn = (folder: string) => readdirSync(join(src, folder), { recursive: true, encoding: 'utf8' });
    const parsing = [...pathsIn(''), ...pathsIn(runtime).map((path) => join(runtime, path))]
      .filter((path) => /\.tsx?$/.test(path))
      .filter((path) => /JSON\.parse\(|\.json\(\)/.test(readFileSync(join(src, path), 'utf8')));
    const fetched = ['llm/recordings.ts', 'session/gallery.ts']; // the page's own files, beside it
    expect(parsing.filter((path) => ![...own, ...fetched].includes(path))).toEqual([]);
  });
});
