// `parsel job`: that it does what the single commands do, in one go, and nothing by halves.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';

const tool = fileURLToPath(new URL('../../build/native-debug/core/parsel', import.meta.url));
let folder: string;

function parsel(...args: string[]) {
  const { status, stdout, stderr } = spawnSync(tool, args, { cwd: folder, encoding: 'utf8', maxBuffer: 1 << 28 });
  return { code: status, out: stdout, said: stderr };
}
function accepted(...args: string[]): string {
  const { code, out, said } = parsel(...args);
  expect(code, `parsel ${args.join(' ')}: ${said}`).toBe(0);
  return out;
}
const read = (name: string) => readFileSync(join(folder, name));
const json = (name: string) => JSON.parse(read(name).toString());
const write = (name: string, content: unknown) => writeFileSync(join(folder, name), JSON.stringify(content));

beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'parsel-job-'));
  accepted('gallery', '.');
  const origin = { part: 'seat', at: [0, 0, 0] };
  write('edit.json', { seed: [{ op: 'scale_1d', part: 'seat', origin, direction: [1, 0, 0], amount: 'x' }] });
});
afterAll(() => rmSync(folder, { recursive: true }));

describe('parsel job', () => {
  it('writes what inspect, propagate, check, apply and sample write', () => {
    const model = 'chair.glb';
    write('job.json', {
      id: 'all',
      model,
      shape: true,
      edits: [{ edit: 'edit.json', request: 'widen' }, { request: 'raise the back' }],
      apply: [{ set: { x1: 0.2 } }, { animate: 'x2' }, { set: { x2: 0 }, morph: true }, { only: ['seat'] }],
      siblings: { count: 2, seed: 5 },
    });
    const line = JSON.parse(accepted('job', 'job.json', '-o', 'done'));
    expect(line).toEqual(json('done/result.json'));
    accepted('inspect', model, '-o', 'shape.json');
    accepted('propagate', model, 'edit.json', '--request', 'widen', '-o', 'one.json');
    write('raise.json', JSON.parse(accepted('read', model, '--request', 'raise the back')).edit);
    accepted('propagate', model, 'raise.json', '--request', 'raise the back', '--onto', 'one.json', '-o', 'both.json');
    expect(json('done/shape.json')).toEqual(json('shape.json'));
    // Layers that were written and read in between differ by roundings of their bounds.
    const plain = (program: string) =>
      json(program).layers.map(({ relations, ...layer }: { relations: { id: string; status: string }[] }) => ({
        ...layer,
        relations: relations.map(({ id, status }) => `${id} ${status}`),
      }));
    expect(plain('done/program.json')).toEqual(plain('both.json'));
    expect(line.check).toEqual({ ...JSON.parse(accepted('check', model, 'done/program.json')), accepted: true });
    for (const [i, options] of [
      ['--set', 'x1=0.2'],
      ['--animate', 'x2'],
      ['--set', 'x2=0', '--morph'],
      ['--only', 'seat'],
    ].entries()) {
      const said = accepted('apply', model, 'done/program.json', ...options, '-o', 'edited.glb');
      expect(read(`done/edited_${i + 1}.glb`).equals(read('edited.glb')), options.join(' ')).toBe(true);
      if (options.includes('--morph')) expect(line.morphs).toEqual([JSON.parse(said)]);
    }
    const { count, rejected, reasons } = JSON.parse(
      accepted('sample', model, 'done/program.json', '--count', '2', '--seed', '5', '-o', 'siblings'),
    );
    expect(line.siblings).toEqual({ count, rejected, reasons });
    for (const file of readdirSync(join(folder, 'siblings'))) {
      expect(read(`done/${file}`).equals(read(`siblings/${file}`)), file).toBe(true);
    }
    expect(readdirSync(join(folder, 'done')).sort()).toEqual([...line.files, 'result.json'].sort());
  });

  it('takes programs as they are, from a file or in the job, and sets the slider to a size that is said', () => {
    accepted('propagate', 'chair.glb', 'edit.json', '-o', 'one.json');
    write('as_file.json', { model: 'chair.glb', edits: [{ program: 'one.json' }] });
    write('as_it_is.json', { model: 'chair.glb', edits: [{ program: json('one.json') }] });
    for (const job of ['as_file.json', 'as_it_is.json']) {
      accepted('job', job, '-o', 'taken');
      expect(json('taken/program.json')).toEqual(json('one.json'));
    }
    write('size.json', { model: 'chair.glb', edits: [{ request: 'make the seat 10 cm wider' }], apply: [{}] });
    const { layers } = JSON.parse(accepted('job', 'size.json', '-o', 'sized'));
    const { x } = JSON.parse(accepted('read', 'chair.glb', '--request', 'make the seat 10 cm wider')).plain.readings[0]
      .target;
    expect(layers[0].value).toBeCloseTo(x, 12);
    accepted('inspect', 'sized/edited_1.glb', '-o', 'wide.json');
    const width = (shape: string) => {
      const seat = json(shape).parts.find(({ id }: { id: string }) => id === 'seat');
      const xs = seat.corners.map(([at]: number[]) => at);
      return (Math.max(...xs) - Math.min(...xs)) * json(shape).frame.scale;
    };
    expect(width('wide.json') - width('shape.json')).toBeCloseTo(0.1, 5);
  });

  it('stretches the slider to a size that was said beyond its end', () => {
    write('twice.json', { model: 'chair.glb', edits: [{ request: 'make the legs 80 % longer' }] });
    const { layers } = JSON.parse(accepted('job', 'twice.json', '-o', 'longer'));
    expect(layers[0].value).toBeCloseTo(0.8, 6);
    const [{ parameter }] = json('longer/program.json').layers;
    expect(parameter.max).toBeGreaterThanOrEqual(0.8);
  });

  it('finds paths from another folder', () => {
    write('elsewhere.json', { model: 'chair.glb' });
    expect(accepted('job', join(folder, 'elsewhere.json'), '--from', folder, '-o', 'from')).toContain('"chair"');
    expect(parsel('job', 'elsewhere.json', '--from', '/', '-o', 'from').said).toContain('/chair.glb');
  });

  it.each<[string, unknown, string]>([
    ['no model', {}, '/model is missing'],
    ['no such file', { model: 'absent.glb' }, 'absent.glb'],
    ['another key', { model: 'chair.glb', edit: [] }, '/edit is not known here; use model, id'],
    ['a key of an edit', { model: 'chair.glb', edits: [{ request: 'widen', sure: true }] }, '/edits/0/sure'],
    ['two edits in one', { model: 'chair.glb', edits: [{ edit: {}, program: {} }] }, '/edits/0 is not one edit'],
    ['a bad edit', { model: 'chair.glb', edits: [{ edit: { seed: [] } }] }, '/edits/0, /seed'],
    ['no edit', { model: 'chair.glb', apply: [{}] }, '/edits is missing'],
    ['no doubt left out', { model: 'chair.glb', edits: [{ request: 'make it nicer' }] }, 'not read without doubt'],
    ['a part too many', { model: 'chair.glb', edits: [{ request: 'widen' }], apply: [{ only: ['wing'] }] }, 'wing'],
    ['no siblings', { model: 'chair.glb', edits: [{ request: 'widen' }], siblings: { count: 0 } }, '/siblings/count'],
    ['a label of nothing', { model: 'chair.glb', labels: { 'node:999': 'leg' } }, 'node:999'],
    ['a later version', { model: 'chair.glb', version: 2 }, '/version'],
  ])('%s is refused by name, and nothing of it is left', (_, job, words) => {
    write('refused.json', job);
    const { code, said } = parsel('job', 'refused.json', '-o', 'refused');
    expect(code).toBe(1);
    expect(said.replaceAll(': ', ' ')).toContain(words.replaceAll(': ', ' '));
    const left = readdirSync(folder).includes('refused') ? readdirSync(join(folder, 'refused')) : [];
    expect(left.filter((file) => file !== 'result.json')).toEqual([]);
    if (left.length > 0) expect(json('refused/result.json').error.cause.length).toBeGreaterThan(0);
    rmSync(join(folder, 'refused'), { recursive: true, force: true });
  });
});
