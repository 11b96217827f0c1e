// The two sides of the boundary must not drift: every method that the module has is typed in protocol.ts and the other
// way round, and what the module really answers fits the types.
import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import * as v from 'valibot';
import { beforeAll, describe, expect, it } from 'vitest';
import { errorSchema, type Method, methodSchemas, methodsOf } from '../../web/src/worker/protocol';
import { type LoadedModule, loadCadModule, loadModule } from './module';

let core: LoadedModule;
beforeAll(async () => {
  core = await loadModule();
});

function invoke(method: string, parameters: unknown, buffers: Uint8Array[] = []) {
  const reply = core.invoke(method, JSON.stringify(parameters), buffers, null);
  return { message: JSON.parse(reply.json) as unknown, buffers: reply.buffers };
}

describe('the boundary between the page and the core', () => {
  it('has the same methods on both sides, in the same modules', async () => {
    expect([...core.methods()].sort()).toEqual(Object.keys(methodsOf.core).sort());
    expect([...(await loadCadModule()).methods()].sort()).toEqual(Object.keys(methodsOf.cad).sort());
    expect(Object.keys(methodSchemas)).toHaveLength(core.methods().length + Object.keys(methodsOf.cad).length);
  });

  const examples: Partial<Record<Method, unknown>> = {
    version: {},
    warm_up: {},
    solve: { equation: '2*y - x', unknown: 'y' },
    gallery: {},
    memory: {},
  };
  it.each(Object.entries(examples))('%s answers what its type says', (method, parameters) => {
    v.parse(methodSchemas[method as Method].parameters, parameters);
    const { message } = invoke(method, parameters);
    const { result } = v.parse(v.strictObject({ result: v.unknown() }), message);
    v.parse(methodSchemas[method as Method].result, result);
  });

  it('reads a plain request as its type says', () => {
    const { message, buffers } = invoke('gallery', {});
    const { models } = v.parse(v.object({ result: methodSchemas.gallery.result }), message).result;
    const chair = models.findIndex(({ id }) => id === 'chair');
    invoke('open', { name: 'chair', external: [] }, buffers.slice(chair, chair + 1));
    for (const request of ['make the legs 10 cm longer', 'make it 10 wider', 'make it nicer']) {
      const read = invoke('read_plainly', { request, mentioned: [] }).message;
      const { result } = v.parse(v.strictObject({ result: methodSchemas.read_plainly.result }), read);
      expect([request, result.plain.sure]).toEqual([request, request.startsWith('make the legs')]);
    }
  });

  it('opens a gallery model, propagates its edits and applies the programs', () => {
    const { message, buffers } = invoke('gallery', {});
    const { models } = (message as { result: { models: { id: string; requests: { edit: unknown }[] }[] } }).result;
    expect(models.length).toBe(buffers.length);
    const index = models.findIndex((model) => model.id === 'chair');
    const file = buffers[index] as Uint8Array;
    const opened = invoke('open', { name: 'chair', external: [] }, [file]).message as { result: unknown };
    v.parse(methodSchemas.open.result, opened.result);

    const propagated = invoke('propagate', { edit: models[index]?.requests[0]?.edit }).message as { result: unknown };
    const { program } = v.parse(methodSchemas.propagate.result, propagated.result);
    const atRest = invoke('apply', { program, values: [0] });
    v.parse(methodSchemas.apply.result, (atRest.message as { result: unknown }).result);
    expect(Buffer.from(atRest.buffers[0] as Uint8Array).equals(Buffer.from(file))).toBe(true);
    const morphed = invoke('apply', { program, values: [0], morph: true });
    const { sliders } = v.parse(methodSchemas.apply.result, (morphed.message as { result: unknown }).result);
    expect(sliders?.[0]?.targets.length).toBeGreaterThan(0);
    const repaired = invoke('apply', { program, values: [0.1], repair: true });
    const { gaps } = v.parse(methodSchemas.apply.result, (repaired.message as { result: unknown }).result);
    expect(gaps).toEqual({ gaps: 0, closed: [], left: [] }); // what is propagated stays together
    const edited = invoke('apply', { program, values: [0.1] });
    expect(Buffer.from(edited.buffers[0] as Uint8Array).equals(Buffer.from(file))).toBe(false);
  });

  it('offers sliders, cleanly propagated, and stretches their ranges', () => {
    const { message, buffers } = invoke('gallery', {});
    const { models } = (message as { result: { models: { id: string }[] } }).result;
    const table = models.findIndex(({ id }) => id === 'dining_table');
    invoke('open', { name: 'dining_table', external: [] }, buffers.slice(table, table + 1));
    const resultOf = (reply: unknown) => (reply as { result: unknown }).result;
    const { offers } = v.parse(methodSchemas.offers.result, resultOf(invoke('offers', {}).message));
    const width = offers.find(({ title }) => title === 'Width');
    const found = invoke('propagate_clean', { edit: width?.edit }).message;
    const { program } = v.parse(methodSchemas.propagate_clean.result, resultOf(found));
    const rangeOf = (one: unknown) =>
      (one as { layers: { parameter: { max: number } }[] }).layers[0]?.parameter.max ?? 0;
    const extended = invoke('extend', { program, layer: 0, to: 2 }).message;
    expect(rangeOf(v.parse(methodSchemas.extend.result, resultOf(extended)).program)).toBeGreaterThan(rangeOf(program));
  });

  it('composes layers onto each other and judges them', () => {
    const { message, buffers } = invoke('gallery', {});
    const { models } = (message as { result: { models: { id: string; requests: { edit: unknown }[] }[] } }).result;
    const index = models.findIndex((model) => model.id === 'bookcase');
    invoke('open', { name: 'bookcase', external: [] }, [buffers[index] as Uint8Array]);
    const [first, second] = [0, 0].map((number, i) => {
      const { message } = invoke('propagate', { edit: models[index]?.requests[number]?.edit });
      const text = JSON.stringify((message as { result: { program: unknown } }).result.program);
      return JSON.parse(text.replaceAll('x1', `x${i + 1}`)) as { layers: unknown[] };
    });
    const program = { ...first, layers: [...(first?.layers ?? []), ...(second?.layers ?? [])] };
    const { result } = invoke('compose', { program, first: 1 }).message as { result: unknown };
    const composed = v.parse(methodSchemas.compose.result, result).program;
    const verdictOf = (of: unknown) =>
      v.parse(methodSchemas.judge.result, (invoke('judge', { program: of }).message as { result: unknown }).result);
    expect(verdictOf(composed).lost.length).toBeLessThan(verdictOf(program).lost.length);
    expect(verdictOf(composed).stops.length).toBe(2);
  });

  it('makes prompts of a request and reads the replies', () => {
    const { buffers } = invoke('gallery', {});
    invoke('open', { name: 'chair', external: [] }, [buffers[0] as Uint8Array]);
    const asked = invoke('prompts', { request: 'let the seat be shallower', mentioned: ['seat'] });
    const { prompts, tasks } = v.parse(methodSchemas.prompts.result, (asked.message as { result: unknown }).result);
    expect(Object.keys(tasks).sort()).toEqual([...new Set(prompts.map(({ task }) => task))].sort());
    const fenced = (block: unknown) => `Well.\n\`\`\`json\n${JSON.stringify(block)}\n\`\`\``;
    const seed = { op: 'scale_1d', part: 'seat', direction: [0, 0, 1], amount: '-x' };
    const replies = prompts.map(({ task, relation }) => ({
      task,
      relation,
      texts: [
        fenced(task === 'seed_edit' ? { edits: [seed] } : task === 'type_hints' ? { hints: {} } : { keep: true }),
        '?',
      ],
    }));
    const read = invoke('read_replies', { request: 'let the seat be shallower', replies });
    const inference = v.parse(methodSchemas.read_replies.result, (read.message as { result: unknown }).result);
    expect(inference.seed).toMatchObject({ outcome: 'decided', of: 1, reason: null });
    expect(inference.refused).toHaveLength(prompts.length);
    expect(inference.relations.every(({ keep }) => keep)).toBe(true);
    expect(invoke('propagate', { edit: inference.edit }).message).toHaveProperty('result.program');
  });

  it('opens a model under labels that are given, and refuses those of no part', () => {
    const { message, buffers } = invoke('gallery', {});
    const { models } = (message as { result: { models: { id: string }[] } }).result;
    const file = buffers[models.findIndex(({ id }) => id === 'chair')] as Uint8Array;
    const open = (labels?: Record<string, string>) =>
      invoke('open', { name: 'chair', external: [], ...(labels ? { labels } : {}) }, [file]).message as {
        result?: { shape: { parts: { id: string; node: number }[] } };
        error?: { place: string };
      };
    const seat = open().result?.shape.parts.find(({ id }) => id === 'seat');
    const relabelled = open({ [`node:${seat?.node}/0`]: 'lid' }).result?.shape.parts;
    expect(relabelled?.find(({ node }) => node === seat?.node)?.id).toBe('lid');
    expect(open({ 'node:999': 'lid' }).error?.place).toBe('node:999');
  });

  it('opens a model with a joint declared away, and refuses what is no correction', () => {
    const { message, buffers } = invoke('gallery', {});
    const { models } = (message as { result: { models: { id: string }[] } }).result;
    const file = buffers[models.findIndex(({ id }) => id === 'chair')] as Uint8Array;
    type Opened = {
      result?: { shape: { parts: { id: string; node: number }[]; relations: { kind: string; parts: string[] }[] } };
      error?: { place: string };
    };
    const open = (corrections: readonly unknown[]) =>
      invoke('open', { name: 'chair', external: [], corrections }, [file]).message as Opened;
    const joint = ({ result }: Opened) =>
      result?.shape.relations.find(
        ({ kind, parts }) => kind !== 'reflection' && parts.includes('seat') && parts.includes('leg_front_left'),
      );
    const found = open([]);
    expect(joint(found)).toBeDefined();
    const keys = ['seat', 'leg_front_left'].map(
      (wanted) => `node:${found.result?.shape.parts.find(({ id }) => id === wanted)?.node}/0`,
    );
    expect(joint(open([{ kind: 'apart', parts: keys }]))).toBeUndefined();
    expect(open([{ kind: 'glued', parts: keys }]).error?.place).toBe('/0/kind');
    expect(open([{ kind: 'apart', parts: ['node:999/0', keys[0]] }]).error?.place).toBe('node:999/0');
  });

  it('answers with the version of the project', async () => {
    const cmake = await readFile(fileURLToPath(new URL('../../CMakeLists.txt', import.meta.url)), 'utf8');
    expect(invoke('version', {}).message).toEqual({ result: { version: cmake.match(/VERSION (\d+\.\d+\.\d+)/)?.[1] } });
  });

  it('solves with GiNaC', () => {
    expect(invoke('solve', { equation: '2*y - x', unknown: 'y' }).message).toEqual({
      result: { solutions: ['0.5*x'] },
    });
  });

  it.each([
    ['an unknown method', 'no_such_method', {}],
    ['parameters that are no object', 'version', 3],
    ['an exception inside the core', 'fail', { kind: 'exception' }],
    ['an equation that is none', 'solve', { equation: '2*(y', unknown: 'y' }],
    ['an unknown that is no name', 'solve', { equation: '2*y', unknown: '2' }],
    ['an edit of no kind', 'propagate', { edit: 7 }],
    ['an edit of no kind, cleanly', 'propagate_clean', { edit: 7 }],
    ['a program of no kind', 'apply', { program: {}, values: [] }],
    ['a repair of no kind', 'apply', { program: {}, values: [], repair: 1 }],
    ['a program of no kind, stretched', 'extend', { program: {}, layer: 0, to: 1 }],
    ['a model that is none', 'open', { name: 'x', external: [] }],
    ['a request that is empty', 'prompts', { request: ' ', mentioned: [] }],
    ['replies of no kind', 'read_replies', { request: 'x', replies: 7 }],
    ['a missing parameter', 'solve', { equation: '2*y' }],
    ['a parameter of another type', 'solve', { equation: 7, unknown: 'y' }],
  ])('answers %s with an error value', (_, method, parameters) => {
    const { error } = v.parse(v.strictObject({ error: errorSchema }), invoke(method, parameters).message);
    expect(error.cause).not.toBe('');
    expect(error.fix).not.toBe('');
  });

  it('still works after an exception', () => {
    invoke('fail', { kind: 'exception' });
    expect(invoke('version', {}).message).toHaveProperty('result.version');
  });
});
