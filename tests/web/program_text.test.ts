// The text form: lossless, editable by hand, and refused by line and column.
import { readFileSync } from 'node:fs';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { checkProgram } from '../../web/src/program/check';
import { programText, statementText } from '../../web/src/program/text';
import { parseProgramText } from '../../web/src/program/text_parse';
import type { Program, Shape } from '../../web/src/program/types';
import { randomProgram, randomShape } from './random_program';

function parse(text: string): unknown {
  const parsed = parseProgramText(text);
  if (!parsed.ok) throw new Error(`${parsed.error.place}: ${parsed.error.cause}`);
  return parsed.value;
}
/** A program as checkProgram() completes it. */
function checked(json: unknown, shape: Shape): Program {
  const result = checkProgram(json, shape);
  if (!result.ok) throw new Error(`${result.error.place}: ${result.error.cause}`);
  return result.value.program;
}

const header = 'parsel program 1\nshape "chair" ""\n';
const layer = 'layer "widen": x1 = 0 in [-0.35, 0.35]\n';

describe('the text form', () => {
  it('of random programs reads back as the same program', () => {
    fc.assert(
      fc.property(fc.integer(), (seed) => {
        const shape = randomShape(seed);
        const program = randomProgram(shape, seed);
        expect(checked(parse(programText(program)), shape)).toEqual(checked(program, shape));
      }),
    );
  });

  it('of the recorded programs reads back as the same program', () => {
    const url = new URL('../golden/program_vectors.json', import.meta.url);
    const { shapes, cases } = JSON.parse(readFileSync(url, 'utf8')) as {
      shapes: Record<string, Shape>;
      cases: { shape: string; program: Program }[];
    };
    for (const { shape: name, program } of cases) {
      const shape = shapes[name] as Shape;
      const complete = checked(program, shape);
      expect(checked(parse(programText(complete)), shape)).toEqual(complete);
    }
  });

  it('quotes names from strangers', () => {
    const name = 'a "b" \\ \n\t\b\u0000\u007f # ) 椅子 <img onerror=x>';
    const text = programText({ format: 'parsel/program', version: 1, shape: { name, sha256: '' }, layers: [] });
    expect(text.trimEnd().split('\n')).toHaveLength(2);
    expect(parse(text)).toMatchObject({ shape: { name } });
  });

  it('prints a statement as people write it', () => {
    expect(
      statementText({
        op: 'scale_1d',
        part: 'seat',
        feature: [0, 1, 0],
        origin: { part: 'seat', at: [0, -1, 0] },
        direction: [1, 0, 0],
        amount: ' x1\n* 2 ',
        why: { kind: 'attachment', relations: ['a1', 'a2'] },
      }),
    ).toBe(
      'scale_1d("seat", amount=x1 * 2, origin=point("seat", 0, -1, 0), direction=(1, 0, 0), feature=(0, 1, 0))' +
        ' because attachment "a1", "a2"',
    );
    expect(
      statementText({ op: 'keep_fixed', part: 'back', why: { kind: 'seed', relations: [] } }, { why: false }),
    ).toBe('keep_fixed("back")');
  });

  it('keeps how finely a report was sampled', () => {
    const parsed = parse(`${header}${layer}relation "a1": held, worst 0.01, sampled at 263\n`) as Program;
    expect(parsed.layers[0]?.relations[0]).toEqual({
      id: 'a1',
      status: 'held',
      worst: 0.01,
      proof: 'sampled',
      samples: 263,
    });
    expect(programText(parsed)).toContain('relation "a1": held, worst 0.01, sampled at 263');
  });

  it('leaves blanks, comments and the order of fields free', () => {
    const tidy = `${header}${layer}rotate("a", amount=max(x1, 0), origin=(0, 1, 2), axis=axis("b", 1)) because seed\n`;
    const wild =
      '# mine\r\n\r\nparsel  program 1 # one\nshape "chair"""\n\tlayer "widen":x1=0in[-0.35,0.35]\n' +
      ' rotate ( "a" , axis = axis ( "b" , 1 ) ,origin=( 0,1 , 2e0 ), amount = max(x1, 0) )because seed#x\n';
    expect(parse(wild)).toEqual(parse(tidy));
  });

  it.each([
    ['', 'line 1, column 1'],
    ['hello', 'line 1, column 1'],
    ['parsel program 2\n', 'line 1, column 16'],
    ['parsel program 1\nshape chair ""', 'line 2, column 7'],
    [`${header}keep_fixed("a")`, 'line 3, column 1'],
    [`${header}layer "w": x1 = zero in [0, 1]`, 'line 3, column 17'],
    [`${header}${layer}explode("a")`, 'line 4, column 1'],
    [`${header}${layer}scale_3d("a", amount=x1, amount=x1)`, 'line 4, column 26'],
    [`${header}${layer}scale_3d("a", __proto__=1)`, 'line 4, column 15'],
    [`${header}${layer}scale_3d("a", origin=axis("a", 1))`, 'line 4, column 22'],
    [`${header}${layer}scale_3d("a\\x")`, 'line 4, column 10'],
    [`${header}${layer}scale_3d("a`, 'line 4, column 10'],
    [`${header}${layer}keep_fixed("a") because seed "r1",`, 'line 4, column 35'],
    [`${header}${layer}keep_fixed("a") indeed`, 'line 4, column 17'],
    [`${header}${layer}relation "a1": held, worst x, sampled`, 'line 4, column 28'],
  ])('refuses %j', (text, place) => {
    const parsed = parseProgramText(text);
    expect(parsed.ok ? 'accepted' : parsed.error.place).toBe(place);
  });

  it('refuses a million statements and a long line at once', () => {
    const start = performance.now();
    expect(parseProgramText(`${header}${layer}${'keep_fixed("a")\n'.repeat(400_000)}`).ok).toBe(false);
    expect(parseProgramText(`${header}${layer}scale_3d("a", amount=${'('.repeat(4e6)}`).ok).toBe(false);
    expect(parseProgramText(`${header}${layer}scale_3d("${'\\"'.repeat(2e6)}`).ok).toBe(false);
    expect(parseProgramText('x'.repeat(9e6)).ok).toBe(false);
    expect(performance.now() - start).toBeLessThan(2000);
  });
});
