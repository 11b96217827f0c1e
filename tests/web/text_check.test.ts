// Refusals of typed text say where in the text they are, whether reading or checking refused.
import { describe, expect, it } from 'vitest';
import { checkProgramText } from '../../web/src/program/text_check';
import { oneBox } from './box_shapes';

const lines = [
  'parsel program 1',
  'shape "box" ""',
  '# a comment',
  'layer "first": x1 = 0 in [-1, 1]',
  '  translate("box", amount=x1, direction=(1, 0, 0))',
  '',
  'layer "second": x2 = 0 in [-1, 1]',
  '  translate("box", amount=x2, direction=(0, 1, 0))',
  '  scale_3d("box", amount=x2/2, origin=point("box", 0, 0, 0)) because seed',
];
const text = lines.join('\n');

/** The text with one line changed, and what is refused of it. */
function refused(line: number, from: string, to: string) {
  expect(lines[line - 1]).toContain(from);
  const changed = lines.map((content, i) => (i === line - 1 ? content.replace(from, to) : content)).join('\n');
  const result = checkProgramText(changed, oneBox);
  if (result.ok) throw new Error('it was accepted');
  const error = result.error;
  if (!('line' in error)) throw new Error('it has no place');
  return { line: error.line, rest: changed.split('\n')[error.line - 1]?.slice(error.column - 1) ?? '', error };
}

describe('a program as text', () => {
  it('is accepted when it is sound', () => {
    const result = checkProgramText(text, oneBox);
    expect(result.ok && result.value.program.layers.length).toBe(2);
  });

  it.each([
    ['a word that is no operator', 8, 'translate', 'transalte', 'transalte'],
    ['a field that nobody knows', 5, 'direction', 'way', 'way='],
    ['an unknown part', 8, '"box"', '"seat"', '"seat"'],
    ['an unknown part in a reference', 9, 'point("box"', 'point("seat"', 'origin='],
    ['an unknown parameter', 9, 'x2/2', 'x9/2', 'x9/2'],
    ['a formula that is none', 9, 'x2/2', '2*', ', origin'],
    ['an amount that is infinite somewhere', 9, 'x2/2', '1/x2', ''],
    ['a direction without direction', 5, '(1, 0, 0)', '(0, 0, 0)', 'direction='],
    ['an operator without its field', 8, ', direction=(0, 1, 0)', '', 'translate'],
    ['a range the wrong way round', 7, '[-1, 1]', '[1, -1]', 'layer'],
  ])('%s is refused in its line', (_, line, from, to, rest) => {
    const found = refused(line, from, to);
    expect(found.line).toBe(line);
    expect(found.rest.startsWith(rest), `"${found.rest}" (${found.error.cause})`).toBe(true);
    expect(found.error.fix).not.toBe('');
  });

  it('that is empty or something else is refused at its start', () => {
    for (const other of ['{"format":"parsel/program"}', 'hello']) {
      const result = checkProgramText(other, oneBox);
      expect(!result.ok && result.error.place).toBe('line 1, column 1');
    }
  });
});
