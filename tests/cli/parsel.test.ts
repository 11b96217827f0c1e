// The `parsel` tool as people call it: every command on a gallery model, and how it refuses.
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { validateBytes } from 'gltf-validator';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { scripts } from '../web/scripts';

const tool = process.env.PARSEL_TOOL ?? fileURLToPath(new URL('../../build/native-debug/core/parsel', import.meta.url));
let folder: string;

function run(...given: string[]): string {
  return execFileSync(tool, given, { cwd: folder, encoding: 'utf8', maxBuffer: 1 << 28, stdio: 'pipe' });
}
const runJson = (...given: string[]) => JSON.parse(run(...given));
/** What a command that does not succeed says on stderr, and its exit code. */
function refusal(...given: string[]): { code: number | null; text: string; output: string } {
  const { status, stderr, stdout } = spawnSync(tool, given, { cwd: folder, encoding: 'utf8' });
  return { code: status, text: stderr, output: stdout };
}
const write = (name: string, content: unknown) =>
  writeFileSync(join(folder, name), typeof content === 'string' ? content : JSON.stringify(content));
const readJson = (name: string) => JSON.parse(readFileSync(join(folder, name), 'utf8'));

const widen = {
  seed: [{ op: 'scale_1d', part: 'seat', origin: { part: 'seat', at: [0, 0, 0] }, direction: [1, 0, 0], amount: 'x' }],
};

beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'parsel-cli-'));
  run('gallery', '.');
  write('edit.json', widen);
  run('propagate', 'chair.glb', 'edit.json', '-o', 'program.json', '--trace', 'trace.json');
});
afterAll(() => rmSync(folder, { recursive: true }));

/** A GLB as .gltf with its binary chunk in a file beside it. */
function unpack(glb: string, gltf: string, bin: string) {
  const bytes = readFileSync(join(folder, glb));
  const length = bytes.readUInt32LE(12);
  const json = JSON.parse(bytes.subarray(20, 20 + length).toString());
  json.buffers[0].uri = bin;
  write(gltf, json);
  writeFileSync(join(folder, bin), bytes.subarray(28 + length));
}

describe('parsel', () => {
  it('lists its commands and tells its version', () => {
    const help = run('--help');
    for (const command of [
      'inspect',
      'propagate',
      'apply',
      'check',
      'score',
      'convert',
      'evaluate',
      'cad',
      'family',
      'gallery',
    ])
      expect(help).toContain(`parsel ${command}`);
    expect(run('--version')).toMatch(/\d+\.\d+\.\d+/);
  });

  it('gallery writes the models and their list', () => {
    const list = readJson('gallery.json') as { file: string; bytes: number }[];
    const files = readdirSync(folder);
    for (const { file, bytes } of list) {
      expect(files).toContain(file);
      expect(readFileSync(join(folder, file)).length).toBe(bytes);
    }
  });

  it('inspect finds the same shape in a GLB and in a .gltf with its file', () => {
    unpack('chair.glb', 'chair two.gltf', 'chair two.bin');
    const { parts, relations } = runJson('inspect', 'chair.glb');
    const unpacked = runJson('inspect', 'chair two.gltf');
    expect(parts.length).toBeGreaterThan(5);
    expect({ parts: unpacked.parts, relations: unpacked.relations }).toEqual({ parts, relations });
    expect(run('inspect', 'chair.glb', '--words')).toContain('seat');
  });

  it('inspect does not leave the folder of the model for its buffers', () => {
    unpack('chair.glb', 'escape.gltf', 'chair.bin');
    const json = readJson('escape.gltf');
    json.buffers[0].uri = '../../../../etc/passwd';
    write('escape.gltf', json);
    const { code, text } = refusal('inspect', 'escape.gltf');
    expect(code).toBe(1);
    expect(text).toContain('passwd');
    expect(text).not.toContain('root');
  });

  it('propagate works from a model and from the shape that inspect wrote, to the same program', () => {
    run('inspect', 'chair.glb', '-o', 'shape.json');
    expect(runJson('propagate', 'shape.json', 'edit.json')).toEqual(readJson('program.json'));
    expect(readJson('program.json').layers[0].statements.length).toBeGreaterThan(3);
  });

  it('inspect and propagate heed corrections, and refuse those of no part and for a shape that is written', () => {
    const { parts } = runJson('inspect', 'chair.glb');
    const key = (wanted: string) => `node:${parts.find(({ id }: { id: string }) => id === wanted).node}/0`;
    const legs = parts.filter(({ id }: { id: string }) => id.startsWith('leg_'));
    const declare = (other: string) =>
      write('own.json', {
        format: 'parsel/corrections',
        version: 1,
        corrections: [{ kind: 'apart', parts: [key('seat'), other] }],
      });
    declare(key(legs[0].id));
    const { relations } = runJson('inspect', 'chair.glb', '--corrections', 'own.json');
    const joints = relations.filter(
      ({ kind, parts: pair }: { kind: string; parts: string[] }) =>
        kind !== 'reflection' && pair.includes('seat') && pair.some((id) => id.startsWith('leg_')),
    );
    expect(joints).toEqual([]);
    run('inspect', 'chair.glb', '--corrections', 'own.json', '-o', 'corrected.json');
    const corrected = runJson('propagate', 'chair.glb', 'edit.json', '--corrections', 'own.json');
    expect(corrected).toEqual(runJson('propagate', 'corrected.json', 'edit.json'));
    expect(corrected).not.toEqual(readJson('program.json'));
    const written = refusal('propagate', 'corrected.json', 'edit.json', '--corrections', 'own.json');
    expect(written).toMatchObject({ code: 1, text: expect.stringContaining('cannot be corrected any more') });
    declare('node:999/0');
    expect(refusal('inspect', 'chair.glb', '--corrections', 'own.json').text).toContain('node:999/0');
  });

  it('check accepts the program with its trace, and not another amount', () => {
    expect(runJson('check', 'chair.glb', 'program.json', '--trace', 'trace.json').findings).toEqual([]);
    const spoilt = readJson('program.json');
    spoilt.layers[0].statements.at(-1).amount += ' + x1';
    write('spoilt.json', spoilt);
    const { code, text } = refusal('check', 'chair.glb', 'spoilt.json');
    expect(code).toBe(1);
    expect(text).toContain('check:');
  });

  it('convert goes to text and back without loss', () => {
    run('convert', 'program.json', '-o', 'program.txt');
    run('convert', 'program.txt', '-o', 'again.json');
    expect(readJson('again.json')).toEqual(readJson('program.json'));
    expect(readFileSync(join(folder, 'program.txt'), 'utf8')).toContain('seat');
  });

  it('apply writes what evaluate says, from either form of the program', () => {
    for (const program of ['program.json', 'program.txt']) {
      run('apply', 'chair.glb', program, '--set', 'x1=0.2', '-o', 'wide.glb');
      const state = runJson('evaluate', 'chair.glb', program, '--set', 'x1=0.2');
      const width = (corners: number[][]) => Math.max(...corners.map((c) => c[0] as number)) * 2;
      const [before, after] = ['chair.glb', 'wide.glb'].map((file) => runJson('inspect', file));
      const seat = (shape: typeof after) => shape.parts.find((p: { id: string }) => p.id === 'seat');
      expect(width(seat(after).corners) * after.frame.scale).toBeCloseTo(
        width(state.parts.seat) * before.frame.scale,
        5,
      );
      expect(width(state.parts.seat)).toBeCloseTo(1.2 * width(seat(before).corners), 6);
    }
  });

  it('apply at rest writes the file as it was, byte by byte, and can animate', () => {
    run('apply', 'chair.glb', 'program.json', '--set', 'x1=0', '-o', 'rest.glb');
    expect(readFileSync(join(folder, 'rest.glb')).equals(readFileSync(join(folder, 'chair.glb')))).toBe(true);
    run('apply', 'chair.glb', 'program.json', '--animate', 'x1', '-o', 'film.glb');
    expect(readFileSync(join(folder, 'film.glb')).toString('latin1')).toContain('"animations"');
  });

  it('apply --morph writes a named morph target for every slider and tells how exact it is', async () => {
    const out = runJson('apply', 'chair.glb', 'program.json', '--morph', '-o', 'sliders.glb');
    expect(out.sliders).toMatchObject([{ parameter: 'x1', targets: ['x1', 'x1 −'], linear: true }]);
    expect(out.sliders[0].error_m).toBeLessThan(1e-6);
    const bytes = readFileSync(join(folder, 'sliders.glb'));
    const json = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
    const named = json.meshes.filter((mesh: { extras?: unknown }) => mesh.extras);
    expect(named.length).toBeGreaterThan(0);
    for (const { extras, weights, primitives } of named) {
      expect(extras.targetNames).toEqual(['x1', 'x1 −']);
      expect(weights).toEqual([0, 0]);
      for (const { targets } of primitives) expect(targets.length).toBe(2);
    }
    const { issues } = await validateBytes(bytes, { maxIssues: 0 });
    expect(issues.messages).toEqual([]);

    // A value that is set is where the sliders begin; at an end of its range it goes one way alone.
    const { max } = readJson('program.json').layers[0].parameter;
    const set = runJson('apply', 'chair.glb', 'program.json', '--morph', '--set', `x1=${max}`, '-o', 'sliders.glb');
    expect(set.sliders[0].targets).toEqual(['x1 −']);
    expect(refusal('apply', 'chair.glb', 'program.json', '--morph', '--animate', 'x1', '-o', 'no.glb')).toMatchObject({
      code: 2,
    });
  });

  it('apply --morph refuses a program that changes counts and writes nothing', () => {
    const bookcase = readJson('gallery.json').find(({ requests }: { requests: { edit: unknown }[] }) =>
      requests.some(({ edit }) => JSON.stringify(edit).includes('change_count')),
    );
    const { edit } = bookcase.requests.find((r: { edit: unknown }) => JSON.stringify(r.edit).includes('change_count'));
    write('count_edit.json', edit);
    run('propagate', bookcase.file, 'count_edit.json', '-o', 'count.json');
    const { code, text } = refusal('apply', bookcase.file, 'count.json', '--morph', '-o', 'count.glb');
    expect(code).toBe(1);
    expect(text).toMatch(/layer 1 \(.*\): its slider x1 changes how many instances there are.*; export one value/);
    expect(readdirSync(folder)).not.toContain('count.glb');
  });

  it('read says what a plain request means, and when it is not sure what may be meant', () => {
    const read = (...given: string[]) => runJson('read', 'chair.glb', '--request', ...given);
    const wider = read('make the seat 10 cm wider');
    expect(wider.plain).toMatchObject({ sure: true, unused: [], reason: null });
    expect(wider.edit.seed).toMatchObject([{ op: 'scale_1d', part: 'seat', direction: [1, 0, 0], amount: 'x' }]);
    expect(wider.plain.readings[0].target).toMatchObject({ part: 'seat', what: 'width', by: 0.1 });
    write('read.json', wider.edit);
    expect(runJson('propagate', 'chair.glb', 'read.json').layers[0].statements.length).toBeGreaterThan(1);
    expect(read('longer', '--mention', 'leg_front_left').edit.seed).toMatchObject([{ part: 'leg_front_left' }]);
    expect(read('make it nicer')).toMatchObject({
      edit: null,
      plain: { sure: false, unused: ['nicer'], readings: [] },
    });
    expect(refusal('read', 'chair.glb', '--request', ' ')).toMatchObject({ code: 1 });
    expect(refusal('read', 'chair.glb')).toMatchObject({ code: 2 });
  });

  it('score gives a program full marks against itself and fewer against another', () => {
    const perfect = runJson('score', 'chair.glb', '--truth', 'program.json', '--program', 'program.json');
    const poor = readJson('program.json');
    poor.layers[0].statements.length = 1;
    write('poor.json', poor);
    const less = runJson('score', 'chair.glb', '--truth', 'program.json', '--program', 'poor.json');
    expect(perfect).toMatchObject({ programmatic: 1, geometric: 0, structural: 1 });
    expect(less.programmatic).toBeLessThan(1);
    expect(less.geometric).toBeGreaterThan(0);
  });

  it.each([
    [['nothing'], 2, 'nothing'],
    [['inspect'], 2, 'inspect'],
    [['inspect', 'absent.glb'], 1, 'absent.glb'],
    [['inspect', 'edit.json'], 1, 'edit.json'],
    [['propagate', 'chair.glb', 'trace.json'], 1, 'trace.json'],
    [['apply', 'chair.glb', 'program.json', '--set', 'x1=9', '-o', 'never.glb'], 1, 'range'],
    [['apply', 'chair.glb', 'program.json', '--set', 'y=0', '-o', 'never.glb'], 1, 'y=0'],
    [['apply', 'chair.glb', 'program.json', '--only', 'wing', '-o', 'never.glb'], 1, 'wing'],
    [['apply', 'desk.glb', 'program.json', '-o', 'never.glb'], 1, 'seat'],
    [['score', 'chair.glb', '--truth', 'program.json'], 2, '--program'],
    [['convert', 'chair.glb'], 1, ''],
    [['gallery', 'edit.json'], 1, 'edit.json'],
  ])('refuses %j', (given, code, words) => {
    const answer = refusal(...given);
    expect(answer.code).toBe(code);
    expect(answer.text).toContain(words);
    expect(answer.output).toBe('');
    expect(readdirSync(folder)).not.toContain('never.glb');
  });

  it.each(scripts)('takes requests in any script: $name', ({ request, parts }) => {
    const prompt = run('prompt', 'chair.glb', '--task', 'seed_edit', '--request', request);
    expect(prompt).toContain(`Request: ${JSON.stringify(request)}`);
    const { code, text } = refusal(
      'prompt',
      'chair.glb',
      '--task',
      'seed_edit',
      '--request',
      'x',
      '--mention',
      ...parts.slice(0, 1),
    );
    expect(code).toBe(1);
    expect(text).toContain(`'${parts[0]}'`);
  });

  it('refuses JSON that is nested too deeply, wherever it is read', () => {
    write('deep.json', `{"seed":${'['.repeat(200_000)}${']'.repeat(200_000)}}`);
    write('deep.gltf', `{"asset":${'['.repeat(200_000)}${']'.repeat(200_000)}}`);
    for (const given of [
      ['inspect', 'deep.gltf'],
      ['propagate', 'deep.json', 'edit.json'],
      ['propagate', 'chair.glb', 'deep.json'],
      ['check', 'chair.glb', 'deep.json'],
      ['check', 'chair.glb', 'program.json', '--trace', 'deep.json'],
      ['apply', 'chair.glb', 'deep.json', '-o', 'never.glb'],
      ['evaluate', 'chair.glb', 'deep.json'],
      ['convert', 'deep.json'],
      ['score', 'chair.glb', '--truth', 'program.json', '--program', 'deep.json'],
    ]) {
      const { code, text } = refusal(...given);
      expect([given, code]).toEqual([given, 1]);
      expect(text).toContain('nested deeper than 64 levels');
    }
  });
});
