// Joints and mirror images put right by hand.
import { beforeEach, describe, expect, it } from 'vitest';
import type { Shape, ShapeRelation } from '../../web/src/program/types';
import { correct, pairOf, uncorrect } from '../../web/src/session/corrections';
import { type Corrections, type Document, emptyDocument } from '../../web/src/session/document';
import { session } from '../../web/src/session/session';
import { readSaved, save } from '../../web/src/share/saved';
import { twoBoxes } from './box_shapes';
import { fakeCore, moving, openModel } from './fake_core';

const joint = twoBoxes.relations.find(({ kind }) => kind !== 'reflection') as ShapeRelation;
const apart: Shape = { ...twoBoxes, relations: twoBoxes.relations.filter((relation) => relation !== joint) };
const keys = ['node:0/0', 'node:1/0'] as const;

/** Two boxes with a joint, which the core leaves out when it is told so. */
function started(layers: Document['layers'] = []) {
  const core = fakeCore();
  const told: (Corrections | undefined)[] = [];
  core.open = async (_files, _options, _labels, corrections) => {
    told.push(corrections);
    return corrections?.some(({ kind }) => kind === 'apart') ? apart : twoBoxes;
  };
  session.replaceDocument({ ...emptyDocument, model: openModel('boxes'), layers }, 'open');
  return { core, told };
}

beforeEach(() => session.replaceDocument(emptyDocument, 'close'));

describe('a pair', () => {
  it('is what two selected parts are to each other', () => {
    const pair = pairOf(twoBoxes, ['left', 'right']);
    expect(pair).toMatchObject({ ids: ['left', 'right'], keys, said: null });
    expect(pair?.joint?.id).toBe(joint.id);
    expect(pairOf(apart, ['right', 'left'])?.joint).toBeNull();
  });

  it('is none of one part, of three, and of a row and what is in it', () => {
    expect(pairOf(twoBoxes, ['left'])).toBeNull();
    const [left] = twoBoxes.parts;
    if (left === undefined) throw new Error('two boxes');
    const third = { ...left, id: 'third', node: 5 };
    expect(pairOf({ ...twoBoxes, parts: [...twoBoxes.parts, third] }, ['left', 'right', 'third'])).toBeNull();
    const row = { ...left, id: 'row', node: -1, primitive: -1, virtual: true, members: ['left', 'right'] };
    const more: Shape = { ...twoBoxes, parts: [...twoBoxes.parts, row, third] };
    expect(pairOf(more, ['row', 'left'])).toBeNull();
    expect(pairOf(more, ['row', 'third'])?.keys[1]).toBe('node:5/0');
  });
});

describe('a correction', () => {
  it('abstracts the shape anew, is one step, and is taken back by undo and by hand', async () => {
    const { core, told } = started();
    expect(await correct(core, { kind: 'apart', parts: keys })).toBe(true);
    expect(told).toEqual([[{ kind: 'apart', parts: keys }]]);
    const { model } = session.document.peek();
    expect(model?.shape).toBe(apart);
    expect(session.notice.peek()?.text).toBe('1 joint removed.');
    session.undo();
    expect(session.document.peek().model?.shape.relations).toContain(joint);
    expect(session.document.peek().model?.corrections).toBeUndefined();
    session.redo();
    const [made] = session.document.peek().model?.corrections ?? [];
    expect(await uncorrect(core, made ?? null)).toBe(true);
    expect(session.document.peek().model?.corrections).toBeUndefined();
    expect(session.document.peek().model?.shape).toBe(twoBoxes);
  });

  it('takes the place of what was said of the same joint, not of the mirror image', async () => {
    const { core, told } = started();
    await correct(core, { kind: 'apart', parts: keys });
    await correct(core, { kind: 'unmirrored', parts: keys });
    await correct(core, { kind: 'loose', parts: [keys[1], keys[0]] });
    expect(told.at(-1)?.map(({ kind }) => kind)).toEqual(['unmirrored', 'loose']);
  });

  it('has the edits worked out again, over their range, where their sliders stand', async () => {
    const [layer] = moving('left').layers;
    if (layer === undefined) throw new Error('a layer');
    const found = {
      ...layer,
      request: 'move it',
      parameter: { name: 'x1', min: -0.2, max: 0.2, value: 0.1 },
      statements: layer.statements.map((one) => ({
        ...one,
        amount: 'x1',
        why: { kind: 'seed' as const, relations: [] },
      })),
    };
    const byHand = { ...layer, request: 'own', parameter: { ...layer.parameter, name: 'x2' } };
    const { core } = started([
      { key: 1, layer: found as typeof layer, enabled: true, value: 0.1, group: 'wide' },
      { key: 2, layer: byHand, enabled: false, value: 0 },
    ]);
    core.answer = async () => moving('right');
    expect(await correct(core, { kind: 'apart', parts: keys })).toBe(true);
    const [first, second] = session.document.peek().layers;
    expect(core.asked).toEqual(['left']);
    expect(first).toMatchObject({ key: 1, value: 0.1, group: 'wide', enabled: true });
    expect(first?.layer).toMatchObject({ request: 'move it', parameter: { name: 'x1', min: -0.2, max: 0.2 } });
    expect(first?.layer.statements[0]).toMatchObject({ part: 'right', amount: 'x1' });
    expect(second?.layer.statements).toEqual(byHand.statements);
    expect(session.notice.peek()?.text).toContain('1 edit worked out again. 1 edit written by hand as before.');
  });

  it('that the core cannot make changes nothing, and says why', async () => {
    const { core } = started();
    core.open = async () => ({ ...twoBoxes, warnings: [{ place: 'left and right', text: 'they differ too much' }] });
    const before = session.document.peek();
    expect(await correct(core, { kind: 'mirrored', parts: keys })).toBe(false);
    expect(session.document.peek()).toBe(before);
    expect(session.notice.peek()).toEqual({
      kind: 'error',
      text: 'That cannot be. left and right: they differ too much.',
    });
  });
});

describe('saved work', () => {
  const corrections: Corrections = [{ kind: 'apart', parts: keys }];
  const saved = () =>
    save({ ...emptyDocument, model: { ...openModel('boxes', { ...twoBoxes, sha256: '0'.repeat(64) }), corrections } });

  it('keeps corrections', () => {
    const read = readSaved(JSON.parse(JSON.stringify(saved())));
    expect(read.ok && read.saved.corrections).toEqual(corrections);
  });

  it.each([
    { kind: 'glued', parts: keys },
    { kind: 'apart', parts: [keys[0], keys[0]] },
    { kind: 'apart', parts: [keys[0], 'left'] },
    { kind: 'apart', parts: [keys[0]] },
  ])('leaves out a damaged one and says so: %j', (wrong) => {
    const json = JSON.parse(JSON.stringify(saved()));
    json.corrections = [wrong, ...corrections];
    const read = readSaved(json);
    expect(read.ok && read.lost).toEqual(['joints and mirror images put right by hand']);
    expect(read.ok && read.saved.corrections).toEqual(corrections);
  });
});
