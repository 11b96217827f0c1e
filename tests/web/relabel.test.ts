// Work that is carried over to a shape with other ids of the same parts.
import { describe, expect, it } from 'vitest';
import { checkProgram } from '../../web/src/program/check';
import type { Layer, Shape } from '../../web/src/program/types';
import { type Document, emptyDocument, emptyProgram, noLabels } from '../../web/src/session/document';
import { carryOver } from '../../web/src/session/relabel';
import { twoBoxes } from './box_shapes';

const files = { name: 'boxes', main: new Uint8Array(), external: new Map() };
const model = (shape: Shape) => ({ files, source: { kind: 'file' } as const, shape, labels: noLabels });

const layer: Layer = {
  request: 'move',
  parameter: { name: 'x1', min: -1, max: 1, value: 0 },
  statements: [
    {
      op: 'scale_1d',
      part: 'left',
      feature: [0, 0, 0],
      origin: { part: 'right', at: [1, 0, 0] },
      direction: { part: 'left', axis: 0 },
      amount: 'x1',
      why: { kind: 'attachment', relations: ['a1'] },
    },
  ],
  relations: [{ id: 'a1', status: 'held', worst: 0, proof: 'certified' }],
};
const document: Document = {
  ...emptyDocument,
  model: model(twoBoxes),
  layers: [{ key: 7, layer, enabled: true, value: 0.5 }],
  hidden: new Set(['left']),
  names: new Map([['right', 'my right']]),
};

/** The same parts under other ids, and the joint with them. */
const renamed = (ids: Readonly<Record<string, string>>, relation: string): Shape => ({
  ...twoBoxes,
  parts: twoBoxes.parts.map((part) => ({ ...part, id: ids[part.id] ?? part.id })),
  relations: twoBoxes.relations.map((other) => ({
    ...other,
    id: relation,
    parts: other.parts.map((id) => ids[id] ?? id),
  })),
});

describe('another label', () => {
  it('renames parts and relations everywhere, also when two ids change places', () => {
    const shape = renamed({ left: 'right', right: 'left' }, 'a5');
    const { layers, hidden, names } = carryOver(document, model(shape));
    expect(layers[0]).toMatchObject({ key: 7, enabled: true, value: 0.5 });
    expect(layers[0]?.layer.statements[0]).toMatchObject({
      part: 'right',
      origin: { part: 'left' },
      direction: { part: 'right' },
      why: { relations: ['a5'] },
    });
    expect(layers[0]?.layer.relations[0]?.id).toBe('a5');
    expect([...hidden]).toEqual(['right']);
    expect([...names]).toEqual([['left', 'my right']]);
    const all = layers.map((entry) => entry.layer);
    expect(checkProgram({ ...emptyProgram(shape), layers: all }, shape).ok).toBe(true);
  });

  it('keeps layers about what is gone, which then do not fit', () => {
    const [first] = twoBoxes.parts;
    const shape: Shape = { ...twoBoxes, parts: first ? [first] : [], relations: [] };
    const { layers } = carryOver(document, model(shape));
    expect(layers[0]?.layer.statements[0]).toMatchObject({ origin: { part: 'right' } });
    expect(layers[0]?.layer.relations).toEqual([]);
    const all = layers.map((entry) => entry.layer);
    expect(checkProgram({ ...emptyProgram(shape), layers: all }, shape).ok).toBe(false);
  });

  it('never lets an id without counterpart mean another part', () => {
    const [, second] = twoBoxes.parts;
    const shape: Shape = { ...twoBoxes, parts: second ? [{ ...second, id: 'left' }] : [], relations: [] };
    const { layers } = carryOver(document, model(shape));
    expect(layers[0]?.layer.statements[0]).toMatchObject({ part: 'left before', origin: { part: 'left' } });
  });
});
