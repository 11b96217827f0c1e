// The work in the model's own file: the real core, the page's session, a model of the gallery.
import { beforeAll, beforeEach, describe, expect, it, vi } from 'vitest';
import { embedSliders, slidersIn } from '../../web/src/program/embedded';
import type { Sliders } from '../../web/src/program/sliders';
import type { Program, Shape } from '../../web/src/program/types';
import type { ModelFiles } from '../../web/src/scene/load';
import { emptyDocument, noLabels, type OpenModel } from '../../web/src/session/document';
import { editedName } from '../../web/src/session/download_names';
import type { ModelCore } from '../../web/src/session/model_core';
import { oneFile, takeSliders } from '../../web/src/session/one_file';
import { openFiles, openSaved, takeLoaded } from '../../web/src/session/open';
import {
  addProgram,
  document,
  notice,
  removeLayer,
  renamePart,
  replaceDocument,
  setEnabled,
  setHidden,
  setValue,
} from '../../web/src/session/session';
import { save } from '../../web/src/share/saved';
import { fakeCore } from './fake_core';
import { call, type LoadedModule, loadModule } from './module';

let wasm: LoadedModule;
let core: ModelCore;
let chair: Uint8Array;
let edit: unknown;

const view = [0.5, 1.2, 3, 0, 0, 0] as const;

function open(files: ModelFiles, labels: ReadonlyMap<string, string> = noLabels): Shape {
  const parameters = {
    name: files.name,
    external: [...files.external.keys()],
    ...(labels.size > 0 ? { labels: Object.fromEntries(labels) } : {}),
  };
  return call<{ shape: Shape }>(wasm, 'open', parameters, [files.main, ...files.external.values()]).result.shape;
}

beforeAll(async () => {
  wasm = await loadModule();
  const gallery = call<{ models: { id: string; requests: { edit: unknown }[] }[] }>(wasm, 'gallery', {});
  const index = gallery.result.models.findIndex(({ id }) => id === 'chair');
  chair = gallery.buffers[index] as Uint8Array;
  edit = gallery.result.models[index]?.requests.find((request) => request.edit !== null)?.edit;
  core = {
    ...fakeCore(),
    open: async (files, _, labels) => open(files, labels),
    async apply(model, program) {
      open(model.files, model.labels);
      const parameters = { program, values: program.layers.map(({ parameter }) => parameter.value) };
      const { buffers } = call(wasm, 'apply', parameters);
      return { glb: buffers[0] as Uint8Array, warnings: [] };
    },
  };
});

const filesOf = (glb: Uint8Array, name = 'chair') => new Map([[`${name}.glb`, glb]]);
/** Where a layer's slider stands is `value`; what the layer itself says of it is from when it was made or written. */
const sliderState = () =>
  document.peek().layers.map(({ layer: { parameter, ...layer }, value, enabled }) => {
    const { value: _, ...range } = parameter;
    return { ...layer, range, value, enabled };
  });

/** The chair with an edit that is on, half way, and one that is off. */
async function work(): Promise<OpenModel> {
  expect(await openFiles(core, filesOf(chair))).toBe(true);
  const model = document.peek().model as OpenModel;
  const { program } = call<{ program: Program }>(wasm, 'propagate', { edit }).result;
  const [first = 0] = addProgram(program, 'edit') ?? [];
  const [second = 0] = addProgram(program, 'edit again') ?? [];
  setValue(first, (program.layers[0]?.parameter.max ?? 0) / 2);
  setEnabled(second, false);
  const [, part] = model.shape.parts;
  renamePart(part?.id ?? '', 'Rückenlehne');
  setHidden([part?.id ?? ''], true);
  return model;
}

async function written(): Promise<Uint8Array> {
  return oneFile(core, document.peek(), view);
}

// three.js reads buffers beside a .gltf with it, and Node has none.
vi.stubGlobal('ProgressEvent', class extends Event {});

describe('a model with sliders', { timeout: 60_000 }, () => {
  beforeEach(() => replaceDocument(emptyDocument, 'start'));

  it('opens as it was', async () => {
    const { shape } = await work();
    const before = { layers: sliderState(), hidden: document.peek().hidden, names: document.peek().names };
    const glb = await written();
    replaceDocument(emptyDocument, 'away');
    expect(await openFiles(core, filesOf(glb, 'chair-sliders'))).toBe(true);
    expect(notice.peek()).toBe(null);
    expect({ layers: sliderState(), hidden: document.peek().hidden, names: document.peek().names }).toEqual(before);
    // The model is the one that it was, so that work kept elsewhere opens on it as well.
    expect(document.peek().model?.shape.sha256).toBe(shape.sha256);
    expect(document.peek().model?.files.main).toEqual(chair);
    (await takeLoaded(document.peek().model?.files as ModelFiles)).dispose();
  });

  it('keeps labels that were given in place of its own', async () => {
    const model = await work();
    const [part] = model.shape.parts.filter(({ virtual }) => !virtual);
    const labels = new Map([[`node:${part?.node}/${part?.primitive}`, 'throne']]);
    const shape = open(model.files, labels);
    replaceDocument({ ...emptyDocument, model: { ...model, shape, labels } }, 'label');
    const { program } = call<{ program: Program }>(wasm, 'propagate', {
      edit: {
        format: 'parsel/edit',
        version: 1,
        seed: [{ op: 'translate', part: 'throne', direction: [0, 1, 0], amount: 'x' }],
      },
    }).result;
    addProgram(program, 'lift the throne');
    const layers = sliderState();
    expect(await openFiles(core, filesOf(await written()))).toBe(true);
    expect(sliderState()).toEqual(layers);
    expect(document.peek().model?.labels).toEqual(labels);
  });

  it('is told its edits that are off, and those that do not fit, as such', async () => {
    await work();
    const [entry] = document.peek().layers;
    const statements = [{ op: 'keep_fixed' as const, part: 'nobody' }];
    const stray = {
      key: 99,
      enabled: true,
      value: 0,
      layer: { request: 'stray', parameter: { name: 'z', min: 0, max: 1, value: 0 }, statements, relations: [] },
    };
    replaceDocument({ ...document.peek(), layers: [...document.peek().layers, stray] }, 'stray');
    const read = slidersIn(await written());
    if (!read.ok || read.value === null) throw new Error('nothing was written');
    expect(read.value.sliders.off).toEqual([1, 2]);
    expect(read.value.checked.program.layers.map(({ request }) => request)).toEqual([entry?.layer.request]);
  });

  it('is made of a model of several files as well', async () => {
    const length = new DataView(chair.buffer, chair.byteOffset).getUint32(12, true);
    const json = JSON.parse(new TextDecoder().decode(chair.subarray(20, 20 + length))) as { buffers: object[] };
    const text = JSON.stringify({ ...json, buffers: [{ ...json.buffers[0], uri: 'chair.bin' }] });
    const set = new Map([
      ['chair.gltf', new TextEncoder().encode(text)],
      ['chair.bin', chair.subarray(28 + length)],
    ]);
    expect(await openFiles(core, set)).toBe(true);
    const { program } = call<{ program: Program }>(wasm, 'propagate', { edit }).result;
    addProgram(program, 'edit');
    const layers = sliderState();
    expect(await openFiles(core, filesOf(await written()))).toBe(true);
    expect(notice.peek()).toBe(null);
    expect(sliderState()).toEqual(layers);
  });

  it('whose sliders are another model’s opens without them, and says so', async () => {
    await work();
    const read = slidersIn(await written());
    if (!read.ok || read.value === null) throw new Error('nothing was written');
    const { sliders } = read.value;
    const spoilt = (change: Partial<Sliders>) => {
      const result = embedSliders(chair, { ...sliders, ...change });
      if (!result.ok) throw new Error(result.error.cause);
      return result.value;
    };
    const [part, ...others] = sliders.shape.parts;
    if (part === undefined) throw new Error('the chair has no part');
    const raised = { ...part, corners: part.corners.map(([x, y, z]) => [x, y + 0.1, z] as const) };
    const wrong: [Uint8Array, RegExp][] = [
      [
        spoilt({ shape: { ...sliders.shape, parts: [raised, ...others] } }),
        /sliders in this file are left out.*another place or size in the model; use the sliders with/,
      ],
      [spoilt({ version: 2 as 1 }), /left out.*\/extras\/parsel\/version: version 2 is unknown; use version 1/],
      [
        spoilt({ program: { ...sliders.program, layers: 'none' } as unknown as Program }),
        /left out.*\/extras\/parsel\/program\/layers/,
      ],
    ];
    for (const [glb, message] of wrong) {
      replaceDocument(emptyDocument, 'away');
      expect(await openFiles(core, filesOf(glb))).toBe(true);
      expect(document.peek().layers).toEqual([]);
      expect(document.peek().model?.shape.parts.length).toBe(sliders.shape.parts.length);
      expect(notice.peek()).toMatchObject({ kind: 'error', text: expect.stringMatching(message) });
      expect(document.peek().model?.files.main).toEqual(chair); // what is exported next has none of it
    }
  });

  it('is the model of work that was made on it before', async () => {
    await work();
    const glb = await written();
    removeLayer(document.peek().layers[1]?.key ?? 0);
    const saved = save(document.peek());
    expect(await openSaved(core, { saved, lost: [] }, filesOf(glb))).toBe(true);
    expect(document.peek().layers).toHaveLength(1); // the work's, not the file's
  });

  it('has a name of its own, and a new one each time', () => {
    expect(
      ['chair', 'chair-sliders', 'chair-sliders-2', 'chair-edited'].map((name) => editedName(name, 'sliders')),
    ).toEqual(['chair-sliders', 'chair-sliders-2', 'chair-sliders-3', 'chair-edited-sliders']);
  });

  it('is not mistaken for one by a file without sliders', () => {
    const files = { name: 'chair', main: chair, external: new Map() };
    expect(takeSliders(files)).toEqual({ files, found: null, refused: null });
    const other = { ...files, main: new Uint8Array([1, 2, 3]) };
    expect(takeSliders(other)).toEqual({ files: other, found: null, refused: null });
  });
});
