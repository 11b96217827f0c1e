// Parts told apart by the module as the page asks for it, and what saved work remembers of that.
import { describe, expect, it } from 'vitest';
import type { Shape } from '../../web/src/program/types';
import type { ModelFiles } from '../../web/src/scene/load';
import { emptyDocument, noLabels } from '../../web/src/session/document';
import { splitAs } from '../../web/src/session/split_files';
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
