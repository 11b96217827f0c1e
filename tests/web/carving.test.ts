// Parts changed by hand: what of the work goes along, what saved work remembers of it, and when it is refused.
import { afterEach, describe, expect, it, vi } from 'vitest';
import type { CarveStep } from '../../web/src/carve/steps';
import type { Shape } from '../../web/src/program/types';
import type { ModelFiles } from '../../web/src/scene/load';

vi.mock('../../web/src/scene/load', () => ({ loadModel: async () => ({ meshes: [], rest: [] }) }));
const { carvedAs, withStep } = await import('../../web/src/session/carve');
const { carveModel, keysOf, planeInFile, whyUncarvable } = await import('../../web/src/session/carving');
const { emptyDocument, noLabels } = await import('../../web/src/session/document');
const { beginCut, cutDirections, cutPlane, cutStep, cutting, endCut, moveCut, turnCut } = await import(
  '../../web/src/session/cutting'
);
const { session } = await import('../../web/src/session/session');
const { readSaved, save } = await import('../../web/src/share/saved');
const { twoBoxes } = await import('./box_shapes');
const { fakeCore, moving, openModel } = await import('./fake_core');

const { document, notice, replaceDocument, selectAll, undo } = session;
const [left, right] = twoBoxes.parts as [Shape['parts'][number], Shape['parts'][number]];
const step: CarveStep = { kind: 'divide', part: `node:${left.node}/0` };

/** The left box is gone, the right one another primitive, and there are two new parts. */
const after: Shape = {
  ...twoBoxes,
  parts: [
    { ...right, id: 'right again', primitive: 1 },
    { ...left, id: 'piece 1', node: 7 },
    { ...left, id: 'piece 2', node: 8 },
  ],
  relations: [],
};
const result = {
  moved: [[`node:${right.node}/0`, `node:${right.node}/1`]] as const,
  made: ['node:7/0', 'node:8/0'],
  lost: [],
  open: [],
};
const carve = async (files: ModelFiles, now: CarveStep) => ({
  files: withStep(files, new Uint8Array([2]), now),
  ...result,
});

function ready() {
  replaceDocument({ ...emptyDocument, model: openModel('boxes') }, 'open boxes');
  const core = fakeCore();
  const opened = vi.fn();
  core.open = async (files, _, labels) => {
    opened(files, labels);
    return after;
  };
  return { core, opened };
}
afterEach(() => {
  endCut();
  while (session.undoLabel.peek() !== null) undo();
});

describe('a part that is changed by hand', () => {
  it('is named where its cut stays open', async () => {
    const { core } = ready();
    const cut: CarveStep = { kind: 'cut', parts: [`node:${left.node}/0`], plane: [1, 0, 0, 0] };
    await carveModel(core, cut, async (files, now) => ({ ...(await carve(files, now)), open: ['curtain'] }));
    expect(notice.peek()?.text).toBe('The cut through curtain stays open: only closed solids are closed again.');
  });

  it('leaves what was said of the others, under their new keys, in one step', async () => {
    const { core, opened } = ready();
    session.renamePart(right.id, 'the right one');
    session.setHidden([left.id, right.id], true);
    expect(await carveModel(core, step, carve)).toBe(true);
    expect([...document.value.names]).toEqual([['right again', 'the right one']]);
    expect([...document.value.hidden]).toEqual(['right again']);
    expect(session.selected.value).toEqual(['piece 1', 'piece 2']);
    expect(opened).toHaveBeenCalledTimes(1);
    expect(session.undoLabel.value).toBe('split part');
    undo();
    expect([...document.value.hidden].sort()).toEqual([left.id, right.id].sort());
  });

  it('takes the labels along', async () => {
    const { core, opened } = ready();
    const model = { ...openModel('boxes'), labels: new Map([[`node:${right.node}/0`, 'lid']]) };
    replaceDocument({ ...emptyDocument, model }, 'open');
    await carveModel(core, step, carve);
    expect(opened.mock.calls[0]?.[1]).toEqual(new Map([[`node:${right.node}/1`, 'lid']]));
  });

  it('waits until edits are taken back, and says so', async () => {
    const { core } = ready();
    session.addProgram(moving('left'), 'lift');
    expect(whyUncarvable(document.value)).toMatch(/Take the edits back/);
    expect(await carveModel(core, step, carve)).toBe(false);
    expect(notice.value).toMatchObject({ kind: 'error', text: expect.stringMatching(/Take the edits back/) });
    expect(whyUncarvable(emptyDocument)).toMatch(/Open a model/);
  });

  it('that cannot be changed stays, with the reason', async () => {
    const { core } = ready();
    const before = document.value;
    const refuse = () => Promise.reject(new Error('It hangs together. Cut it instead.'));
    expect(await carveModel(core, step, refuse)).toBe(false);
    expect(document.value).toBe(before);
    expect(notice.value?.text).toMatch(/hangs together/);
  });
});

describe('saved work', () => {
  const files = (steps: readonly CarveStep[]): ModelFiles => ({
    ...openModel('boxes').files,
    carved: { from: openModel('boxes').files, steps },
  });
  const steps: CarveStep[] = [
    step,
    { kind: 'cut', parts: ['node:7/0'], plane: [0.6, 0, 0.8, -1.5] },
    { kind: 'join', parts: ['node:8/0', 'node:9/0'] },
  ];
  const shape = { ...after, sha256: 'b'.repeat(64) };
  const model = { files: files(steps), source: { kind: 'file' } as const, shape, labels: noLabels };

  it('remembers the steps, and they are done again, in order, unless they are done', async () => {
    const read = readSaved(JSON.parse(JSON.stringify(save({ ...emptyDocument, model }))));
    if (!read.ok) throw new Error(read.text);
    expect(read.lost).toEqual([]);
    expect(read.saved.carved).toEqual(steps);
    const asked: CarveStep[] = [];
    const options = { signal: new AbortController().signal, onProgress: () => {} };
    const again = async (given: ModelFiles, now: CarveStep) => {
      asked.push(now);
      return carve(given, now);
    };
    const whole = openModel('boxes').files;
    const made = await carvedAs(read.saved.carved, whole, again, options);
    expect(asked).toEqual(steps);
    expect(made.carved).toEqual({ from: whole, steps });
    expect(await carvedAs(read.saved.carved, made, again, options)).toBe(made);
    expect(await carvedAs(undefined, whole, again, options)).toBe(whole);
    expect(asked).toHaveLength(3);
  });

  it.each<[string, unknown]>([
    ['a part that is none', [{ kind: 'divide', part: 'seat' }]],
    ['a step that is none', [{ kind: 'melt', parts: ['node:1/0'] }]],
    ['a plane that is nowhere', [{ kind: 'cut', parts: ['node:1/0'], plane: [1, 0, 0, Number.NaN] }]],
    ['one bad step of several', [...steps, { kind: 'join', parts: [] }]],
  ])('with %s leaves all of it out, and says so', (_, carved) => {
    const read = readSaved({ ...save({ ...emptyDocument, model }), carved });
    expect(read.ok && read.saved.carved).toBe(undefined);
    expect(read.ok && read.lost).toContain('what was done to the parts by hand');
  });
});

describe('the plane of a cut', () => {
  it('begins in the middle of the longest way, and moves within the parts', () => {
    ready();
    selectAll([left.id]);
    beginCut(twoBoxes);
    const plane = () => {
      const now = cutPlane.value;
      if (now === null) throw new Error('there is no plane');
      return now;
    };
    const { least, most, offset } = plane();
    expect(offset).toBeCloseTo((least + most) / 2, 12);
    moveCut(0.25);
    expect(plane().offset).toBeCloseTo(least + 0.25 * (most - least), 12);
    moveCut(7);
    expect(plane().offset).toBeLessThan(most);
    turnCut('y');
    expect(plane().direction.normal).toEqual([0, 1, 0]);
    const { origin } = plane();
    expect(origin[1]).toBeCloseTo(plane().offset, 12);
    expect(cutStep()).toMatchObject({ kind: 'cut', parts: keysOf(twoBoxes, [left.id]) });
    selectAll([]);
    expect(cutPlane.value).toBe(null);
    expect(cutting.value).not.toBe(null); // the card ends it
  });

  it('is said in the file’s own metres, of a model that stands turned as well', () => {
    const centre = [1, 2, 3] as const;
    const plain = { ...twoBoxes, frame: { centre, scale: 2 } };
    expect(planeInFile(plain, [0, 1, 0], 0.25)).toEqual([0, 1, 0, 2.5]);
    const [c, s] = [Math.cos(0.3), Math.sin(0.3)];
    const turned: Shape = {
      ...plain,
      frame: {
        centre,
        scale: 2,
        axes: [
          [c, 0, -s],
          [0, 1, 0],
          [s, 0, c],
        ],
      },
    };
    const [x, y, z, distance] = planeInFile(turned, [1, 0, 0], 0.5);
    expect([x, y, z]).toEqual([c, 0, -s]);
    // A point of the plane, put into the normalised frame: its first coordinate is the offset.
    const point = [x * distance, y * distance, z * distance];
    const first = (c * (point[0] ?? 0) - s * (point[2] ?? 0) - (c * centre[0] - s * centre[2])) / 2;
    expect(first).toBeCloseTo(0.5, 12);
  });

  it('can stand across a part’s own axes where it is turned', () => {
    expect(cutDirections(twoBoxes, [left.id]).map(({ id }) => id)).toEqual(['x', 'y', 'z']);
    const [c, s] = [Math.cos(0.4), Math.sin(0.4)];
    const tilted: Shape = {
      ...twoBoxes,
      parts: [
        {
          ...left,
          axes: [
            [1, 0, 0],
            [0, c, s],
            [0, -s, c],
          ],
        },
      ],
    };
    expect(cutDirections(tilted, [left.id]).map(({ normal }) => normal)).toEqual([
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
      [0, c, s],
      [0, -s, c],
    ]);
  });
});
