// That the limit of lines catches what it is there for.
import { describe, expect, it } from 'vitest';
import { lengthFaults } from '../check_lengths.mjs';

const lines = (count: number) => 'x;\n'.repeat(count);

describe('a file', () => {
  it.each([
    ['of 400 lines', lines(400)],
    ['that says why at its top', `// The table of words, in one file because its rows are compared.\n${lines(400)}`],
    [
      'that says why over two lines',
      `// The table of words. In one file\n// because its rows are compared.\n${lines(400)}`,
    ],
    [
      'that says why in a block',
      `/**\n * The table, in one\n * file because its rows are compared.\n */\n${lines(400)}`,
    ],
  ])('%s passes', (_, text) => {
    expect(lengthFaults('core/edit/new.cpp', text)).toEqual([]);
  });

  it.each([
    ['of 401 lines', lines(401)],
    ['that gives no reason at its top', `// The table of words.\n${lines(400)}`],
    ['that says why further down', `// The table.\n${lines(200)}// In one file because.\n${lines(200)}`],
  ])('%s fails with its length', (_, text) => {
    const found = text.split('\n').length - 1;
    expect(lengthFaults('core/edit/new.cpp', text)).toEqual([
      expect.stringMatching(`^core/edit/new.cpp: ${found} lines, more than 400`),
    ]);
  });

  it('that was exempt passes until it is short enough', () => {
    expect(lengthFaults('a.cpp', lines(401), ['a.cpp'])).toEqual([]);
    expect(lengthFaults('a.cpp', lines(400), ['a.cpp'])).toEqual([expect.stringMatching('take it off')]);
  });
});
