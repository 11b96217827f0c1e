// Names and requests in many scripts: cut between characters, kept whole through links.
import { describe, expect, it } from 'vitest';
import { quoted } from '../../web/src/llm/ask_error';
import { cut, cutBytes, shortened } from '../../web/src/program/cut';
import { programText } from '../../web/src/program/text';
import { parseProgramText } from '../../web/src/program/text_parse';
import type { Program } from '../../web/src/program/types';
import { fragmentOf, readFragment } from '../../web/src/share/link';
import type { Saved } from '../../web/src/share/saved';
import { scripts } from './scripts';

const bytes = (text: string) => new TextEncoder().encode(text).length;
const graphemes = (text: string) => [...new Intl.Segmenter('en').segment(text)].map(({ segment }) => segment);

const program = (request: string, part: string): Program => ({
  format: 'parsel/program',
  version: 1,
  shape: { name: part, sha256: '00' },
  layers: [
    {
      request,
      parameter: { name: 'x1', min: -0.35, max: 0.35, value: 0.1 },
      statements: [{ op: 'translate', part, feature: [0, 0, 0], amount: 'x1', direction: [1, 0, 0] }],
      relations: [],
    },
  ],
});

describe.each(scripts)('$name', ({ request, parts }) => {
  it('is cut between characters at every length', () => {
    for (const text of [request, ...parts]) {
      const whole = graphemes(text);
      const beginnings = whole.map((_, i) => whole.slice(0, i).join('')).concat(text);
      for (let limit = 0; limit <= text.length; ++limit) {
        expect(beginnings).toContain(cut(text, limit));
        expect(cut(text, limit).length).toBeLessThanOrEqual(limit);
      }
      for (let limit = 0; limit <= bytes(text); ++limit) {
        expect(beginnings).toContain(cutBytes(text, limit));
        expect(bytes(cutBytes(text, limit))).toBeLessThanOrEqual(limit);
      }
      expect([cut(text, text.length), cutBytes(text, bytes(text)), shortened(text, 99)]).toEqual([text, text, text]);
    }
  });

  it('comes back from a link as it was', async () => {
    const part = parts[0] as string;
    const saved: Saved = {
      format: 'parsel/session',
      version: 1,
      model: { name: part, sha256: '0'.repeat(64) },
      program: program(request, part) as Saved['program'],
      off: [],
      hidden: [],
      names: parts.map((name, i) => [`part_${i}`, name]),
      labels: parts.map((name, i) => [`node:${i}/0`, name]),
    };
    expect(await readFragment(await fragmentOf(saved))).toEqual({ ok: true, saved, lost: [] });
  });

  it('comes back from the text form as it was', () => {
    for (const part of parts) {
      const read = parseProgramText(programText(program(request, part)));
      expect(read).toMatchObject({
        ok: true,
        value: { shape: { name: part }, layers: [{ request, statements: [{ part }] }] },
      });
    }
  });
});

it('what a provider says is cut between characters', () => {
  expect(quoted(`${'a'.repeat(199)}👩🏽‍🔧`)).toBe(` (“${'a'.repeat(199)}…”)`);
});

it('a long name is cut to what a session can hold', () => {
  expect(bytes(cutBytes('椅'.repeat(80), 200))).toBe(198);
});
