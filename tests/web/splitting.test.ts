// Parts told apart by the module as the page asks for it, and what saved work remembers of that.
import { beforeEach, describe, expect, it } from 'vitest';
import type { Shape } from '../../web/src/program/types';
import type { ModelFiles } from '../../web/src/scene/load';
import { emptyDocument, noLabels } from '../../web/src/session/document';
import { notice, replaceDocument } from '../../web/src/session/session';
import { splitAs } from '../../web/src/session/split_files';
import { findWays, isSplitSo, offersSplit, waysNow } from '../../web/src/session/splitting';
import { readSaved, save } from '../../web/src/share/saved';
import type { MethodResult } from '../../web/src/worker/protocol';
import { tableInOnePiece } from '../e2e/one_mesh';
import { twoBoxes } from './box_shapes';
import { fakeCore } from './fake_core';
import { call, loadModule } from './module';

const shape: Shape = { ...twoBoxes, sha256: 'a'.repeat(64) };
const whole: ModelFiles = { name: 'table', main: new Uint8Array([1]), external: new Map() };
const split: ModelFiles = { ...whole, main: new Uint8Array([2]), split: { from: whole, by: 'auto', fine: 0.4 } };

describe('splitting', () => {
  it('gives a GLB that opens with the parts, the same one every time', async () => {
    const core = await loadModule();
    call(core, 'open', { name: 'table', external: [] }, [tableInOnePiece]);
    const once = call<{ parts: number; joined: number }>(core, 'split', { by: 'auto', fine: 0.5 });
    const again = call(core, 'split', { by: 'auto', fine: 0.5 });
    expect(once.result).toMatchObject({ parts: 5, joined: 1 });
    const glb = once.buffers[0] as Uint8Array;
    expect(glb).toEqual(again.buffers[0]);
    const opened = call<{ shape: Shape }>(core, 'open', { name: 'table', external: [] }, [glb]);
    expect(opened.result.shape.parts.filter(({ virtual }) => !virtual)).toHaveLength(5);
  });

  it('tells what each way gives, which is what splitting so gives', async () => {
    const core = await loadModule();
    call(core, 'open', { name: 'table', external: [] }, [tableInOnePiece]);
    for (const fine of [0.5, 1]) {
      const { before, ways } = call<MethodResult<'split_ways'>>(core, 'split_ways', { fine }).result;
      expect(before).toBe(1);
      expect(ways.map(({ by }) => by)).toEqual(['components', 'materials', 'regions']);
      for (const { by, parts } of ways)
        expect(call(core, 'split', { by, fine }).result).toMatchObject({ before, parts });
    }
  });

  it('is remembered by saved work, and done again for it unless the file is split already', async () => {
    const model = { files: split, source: { kind: 'file' } as const, shape, labels: noLabels };
    const read = readSaved(JSON.parse(JSON.stringify(save({ ...emptyDocument, model }))));
    if (!read.ok) throw new Error(read.text);
    expect(read.saved.split).toEqual({ by: 'auto', fine: 0.4 });
    const asked: unknown[] = [];
    const core = {
      ...fakeCore(),
      split: async (_: ModelFiles, how: unknown) => {
        asked.push(how);
        return { files: split, before: 1, parts: 5, remarks: [] };
      },
    };
    const options = { signal: new AbortController().signal, onProgress: () => {} };
    expect(await splitAs(read.saved.split, whole, core, options)).toBe(split);
    expect(await splitAs(read.saved.split, split, core, options)).toBe(split);
    expect(await splitAs(undefined, whole, core, options)).toBe(whole);
    expect(asked).toEqual([{ by: 'auto', fine: 0.4 }]);
  });

  it('that saved work says wrongly is left out, and said', () => {
    const model = { files: split, source: { kind: 'file' } as const, shape, labels: noLabels };
    const damaged = { ...save({ ...emptyDocument, model }), split: { by: 'magic', fine: 7 } };
    const read = readSaved(damaged);
    expect(read.ok && read.saved.split).toBe(undefined);
    expect(read.ok && read.lost).toContain('how the parts were told apart');
  });
});

describe('ways to split', () => {
  const open = (files: ModelFiles) => {
    const model = { files, source: { kind: 'file' } as const, shape, labels: noLabels };
    replaceDocument({ ...emptyDocument, model }, 'open');
  };
  const answering = (counts: readonly [components: number, materials: number, regions: number], before = 1) => {
    const asked: { files: ModelFiles; fine: number }[] = [];
    const core = {
      ...fakeCore(),
      splitWays: async (files: ModelFiles, fine: number) => {
        asked.push({ files, fine });
        const way = (by: 'components' | 'materials' | 'regions', parts: number) => ({
          by,
          parts,
          too_many: parts > 2000,
        });
        const [components, materials, regions] = counts;
        return {
          before,
          ways: [way('components', components), way('materials', materials), way('regions', regions)],
        };
      },
    };
    return { core, asked };
  };
  const found = () => waysNow.value?.found.map(({ by, parts }) => `${by} ${parts}`);
  beforeEach(() => open({ ...whole }));

  it('are those that tell something apart, each once', async () => {
    expect(waysNow.value).toBe(null);
    await findWays(answering([5, 2, 9]).core);
    expect(found()).toEqual(['components 5', 'materials 2', 'regions 9']);
    await findWays(answering([5, 1, 5]).core);
    expect(found()).toEqual(['components 5']);
    await findWays(answering([1, 4, 4]).core); // as many as by material, and others
    expect(found()).toEqual(['materials 4', 'regions 4']);
    await findWays(answering([2001, 1, 2001]).core);
    expect(waysNow.value?.found).toEqual([{ by: 'components', parts: 2001, isTooMany: true }]);
  });

  it('where there are none, a sentence says so and splitting is not offered again', async () => {
    expect(offersSplit.value).toBe(true);
    await findWays(answering([1, 1, 1]).core);
    expect(found()).toEqual([]);
    expect(notice.value?.text).toMatch(/^There is nothing to tell apart/);
    expect(offersSplit.value).toBe(false);
  });

  it('are those of the file before it was split, as long as it is split as fine, and of no other model', async () => {
    const from = { ...whole };
    open({ ...split, split: { from, by: 'auto', fine: 0.4 } });
    const { core, asked } = answering([5, 1, 9]);
    await findWays(core);
    expect(asked).toEqual([{ files: from, fine: 0.4 }]);
    expect(found()).toEqual(['components 5', 'regions 9']);
    open({ ...split, split: { from, by: 'regions', fine: 0.4 } });
    expect(found()).toEqual(['components 5', 'regions 9']);
    open({ ...split, split: { from, by: 'regions', fine: 1 } });
    expect(waysNow.value).toBe(null);
    open(from);
    expect(found()).toEqual(['components 5', 'regions 9']);
    open({ ...whole });
    expect(waysNow.value).toBe(null);
  });

  it('one is done when the model was split by it, or by it as the best', () => {
    const way = (by: 'components' | 'materials' | 'regions', parts: number) => ({ by, parts, isTooMany: false });
    expect(isSplitSo(null, way('components', 5))).toBe(false);
    expect(isSplitSo({ by: 'auto', parts: 5 }, way('components', 5))).toBe(true);
    expect(isSplitSo({ by: 'auto', parts: 5 }, way('materials', 5))).toBe(false);
    expect(isSplitSo({ by: 'auto', parts: 5 }, way('regions', 9))).toBe(false);
    expect(isSplitSo({ by: 'materials', parts: 5 }, way('components', 5))).toBe(false);
    expect(isSplitSo({ by: 'materials', parts: 5 }, way('materials', 5))).toBe(true);
  });
});
