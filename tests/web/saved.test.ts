// Saved work that is damaged loses its bad elements, not everything.
import { describe, expect, it } from 'vitest';
import { lostWords, readSaved, type Saved } from '../../web/src/share/saved';

const layer = (request: string) => ({
  request,
  parameter: { name: 'x1', min: -1, max: 1, value: 0 },
  statements: [{ op: 'keep_fixed' as const, part: 'seat' }],
  relations: [],
});
const shape = { name: 'chair', sha256: 'a'.repeat(64) };
const whole: Saved = {
  format: 'parsel/session',
  version: 1,
  model: { ...shape, gallery: 'chair' },
  program: { format: 'parsel/program', version: 1, shape, layers: ['one', 'two', 'three'].map(layer) },
  off: [1, 2],
  hidden: ['seat', 'back'],
  names: [['seat', 'the seat']],
  labels: [['node:0/0', 'board']],
  view: [0, 1, 2, 3, 4, 5],
};

function read(change: (session: never) => void) {
  const session = structuredClone(whole);
  change(session as never);
  const found = readSaved(session);
  if (!found.ok) throw new Error(found.text);
  return found;
}

describe('a saved session', () => {
  it('that is whole loses nothing', () => {
    expect(readSaved(whole)).toEqual({ ok: true, saved: whole, lost: [] });
  });

  it('with a damaged edit keeps the others, and those that were off stay off', () => {
    const { saved, lost } = read((session: { program: { layers: { statements: unknown }[] } }) => {
      (session.program.layers[1] as { statements: unknown }).statements = 'gone';
    });
    expect(saved.program.layers.map(({ request }) => request)).toEqual(['one', 'three']);
    expect(saved.off).toEqual([1]);
    expect(lost).toEqual(['edit 2 (“two”)']);
  });

  it.each<[string, object, Partial<Saved>, string]>([
    ['a hidden part', { hidden: ['seat', 7] }, { hidden: ['seat'] }, 'what is hidden'],
    ['a list that is none', { hidden: { seat: 1 } }, { hidden: [] }, 'what is hidden'],
    ['a name', { names: [['seat', 'the seat'], ['back']] }, { names: [['seat', 'the seat']] }, 'names'],
    [
      'a label',
      {
        labels: [
          ['node:0/0', 'board'],
          ['x', 'y'],
        ],
      },
      { labels: [['node:0/0', 'board']] },
      'labels',
    ],
    ['which are off', { off: [1, 'all'] }, { off: [1] }, 'which edits are off'],
    ['all edits', { program: { layers: null } }, { off: [] }, 'the edits'],
  ])('with damage to %s keeps the rest', (_, damage, kept, said) => {
    const found = readSaved({ ...whole, ...damage });
    expect(found).toMatchObject({ ok: true, saved: { model: whole.model, ...kept }, lost: [said] });
  });

  it('keeps whose sides were meant, of the work and of each edit', () => {
    const sided = { ...whole, sides: 'seen', seen: [[1, 'left']] };
    expect(readSaved(sided)).toMatchObject({ ok: true, saved: { sides: 'seen', seen: [[1, 'left']] }, lost: [] });
    expect(readSaved({ ...whole, seen: [[1, 'below']] })).toMatchObject({
      ok: true,
      lost: [expect.stringMatching(/whose sides/)],
    });
    const first = { ...sided, program: { ...whole.program, layers: [{}, ...whole.program.layers.slice(1)] } };
    expect(readSaved(first)).toMatchObject({ ok: true, saved: { seen: [[0, 'left']] } });
  });

  it('with a damaged view is seen from where the page looks', () => {
    const { saved, lost } = read((session: { view: unknown }) => {
      session.view = [0, 1, 'far'];
    });
    expect(saved).not.toHaveProperty('view');
    expect(lost).toEqual(['the view']);
  });

  it('with keys from elsewhere loses them without a word', () => {
    const found = readSaved({ ...whole, __extra: 1 });
    expect(found).toEqual({ ok: true, saved: whole, lost: [] });
  });

  it('that does not say which model it is about is refused', () => {
    expect(readSaved({ ...whole, model: { name: 'chair' } })).toMatchObject({ ok: false });
  });

  it('says what is missing, a few things at most', () => {
    expect(lostWords({ saved: whole, lost: [] })).toBe('');
    expect(lostWords({ saved: whole, lost: ['names'] })).toBe('Part of this work was damaged and is left out: names.');
    expect(lostWords({ saved: whole, lost: ['a', 'b', 'c', 'd', 'e'] })).toMatch(/: a, b, c and 2 more\.$/);
  });
});
