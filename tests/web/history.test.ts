import { effect } from '@preact/signals';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { History } from '../../web/src/session/history';

/** A history of lists, with a step for each item. */
function historyOf(...items: string[]): History<readonly string[]> {
  const history = new History<readonly string[]>([]);
  for (const item of items) history.push(`add ${item}`, [...history.present.peek(), item]);
  return history;
}
const replace = (old: string, next: string) => (list: readonly string[]) =>
  list.map((item) => (item === old ? next : item));

describe('undo and redo', () => {
  it('go back and forth, with what each step was', () => {
    const history = historyOf('a', 'b');
    expect([history.undoLabel, history.redoLabel]).toEqual(['add b', null]);
    history.undo();
    expect(history.present.value).toEqual(['a']);
    expect([history.undoLabel, history.redoLabel]).toEqual(['add a', 'add b']);
    history.undo();
    history.undo(); // nothing is left
    expect(history.present.value).toEqual([]);
    history.redo();
    history.redo();
    history.redo();
    expect(history.present.value).toEqual(['a', 'b']);
  });

  it('forget what was undone when something else is done', () => {
    const history = historyOf('a', 'b');
    history.undo();
    history.push('add c', ['a', 'c']);
    expect(history.redoLabel).toBe(null);
    history.undo();
    expect(history.present.value).toEqual(['a']);
  });

  it('take a run of steps with one key as one, unless something comes between', () => {
    const history = new History(0);
    for (const value of [1, 2, 3]) history.push('slide', value, 'slider');
    history.push('slide', 4, 'another');
    history.undo();
    expect(history.present.value).toBe(3);
    history.push('slide', 5, 'another'); // after an undo a run begins anew
    history.undo();
    expect(history.present.value).toBe(3);
    history.undo();
    expect(history.present.value).toBe(0);
  });

  it('keep the last 500 steps', () => {
    const history = new History(0);
    for (let i = 1; i <= 600; i++) history.push('more', i);
    for (let i = 0; i < 600; i++) history.undo();
    expect(history.present.value).toBe(100);
  });
});

describe('a step that is made anew', () => {
  it('is changed in its place: later steps stay, and undo takes it back as before', () => {
    const history = historyOf('a', 'b');
    const mark = history.mark;
    history.push('add c', ['a', 'b', 'c']);
    expect(history.amend(mark, replace('b', 'B'))).toBe(true);
    expect(history.present.value).toEqual(['a', 'B', 'c']);
    expect(history.undoLabel).toBe('add c');
    history.undo();
    expect(history.present.value).toEqual(['a', 'B']);
    history.undo();
    expect(history.present.value).toEqual(['a']);
    history.redo();
    history.redo();
    expect(history.present.value).toEqual(['a', 'B', 'c']);
  });

  it('is changed in steps that are undone after it', () => {
    const history = historyOf('a');
    const mark = history.mark;
    history.push('add b', ['a', 'b']);
    history.undo();
    expect(history.amend(mark, replace('a', 'A'))).toBe(true);
    history.redo();
    expect(history.present.value).toEqual(['A', 'b']);
  });

  it('is not when it is undone, or gone', () => {
    const history = historyOf('a', 'b');
    const mark = history.mark;
    history.undo();
    expect(history.amend(mark, replace('b', 'B'))).toBe(false);
    history.redo();
    expect(history.present.value).toEqual(['a', 'b']);
    expect(history.mark).toBe(mark); // it can be again
    history.undo();
    history.push('add c', ['a', 'c']);
    expect(history.amend(mark, replace('b', 'B'))).toBe(false);
    history.reset(['x']);
    expect(history.amend(mark, replace('x', 'X'))).toBe(false);
    expect(history.present.value).toEqual(['x']);
  });

  it('is seen at once, and ends a run of steps', () => {
    const history = new History(0);
    history.push('slide', 1, 'slider');
    const seen: number[] = [];
    effect(() => void seen.push(history.present.value));
    history.amend(history.mark, (value) => value + 10);
    expect(seen).toEqual([1, 11]);
    history.push('slide', 12, 'slider');
    history.undo();
    expect(history.present.value).toBe(11);
  });

  it('leaves what came before it untouched, whatever is done', () => {
    const action = fc.constantFrom('push', 'undo', 'redo', 'amend');
    fc.assert(
      fc.property(fc.array(action, { maxLength: 40 }), (actions) => {
        const history = historyOf('first');
        history.push('add marked', ['first', 'marked']);
        const mark = history.mark;
        let count = 0;
        for (const what of actions) {
          const before = history.present.peek();
          if (what === 'push') history.push('add', [...before, `${count++}`]);
          else if (what === 'amend') {
            const has = before.some((item) => item.startsWith('marked'));
            const done = history.amend(mark, (list) =>
              list.map((item) => (item.startsWith('marked') ? `${item}!` : item)),
            );
            expect(done).toBe(has);
          } else history[what]();
        }
        while (history.undoLabel !== null) {
          expect(history.present.value.filter((item) => item.endsWith('!') && !item.startsWith('marked'))).toEqual([]);
          history.undo();
        }
        expect(history.present.value).toEqual([]);
      }),
    );
  });
});
