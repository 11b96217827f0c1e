// What one command writes, every command that takes such a file takes: no output is refused by the project's own readers.
import { spawnSync } from 'node:child_process';
import { copyFileSync, existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';

const tool = fileURLToPath(new URL('../../build/native-debug/core/parsel', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'parsel-outputs-'));
afterAll(() => rmSync(folder, { recursive: true }));

interface Answer {
  readonly code: number | null;
  readonly said: string;
}
function parsel(...given: string[]): Answer {
  const { status, stderr } = spawnSync(tool, given, { cwd: folder, encoding: 'utf8', maxBuffer: 1 << 28 });
  return { code: status, said: stderr };
}
const read = (name: string) => JSON.parse(readFileSync(join(folder, name), 'utf8'));
const write = (name: string, content: string) => writeFileSync(join(folder, name), content);
/** Runs what must not be refused. */
function accepted(...given: string[]): void {
  const { code, said } = parsel(...given);
  expect(code, `parsel ${given.join(' ')}\n${said}`).toBe(0);
}

/** Feeds everything that the commands write about a model and an edit to every command that takes it. */
function feed(model: string, edit: string): void {
  accepted('inspect', model, '-o', 'shape.json');
  accepted('propagate', model, edit, '-o', 'program.json', '--trace', 'trace.json');
  accepted('convert', 'program.json', '-o', 'program.txt');
  accepted('convert', 'program.txt', '-o', 'again.json');
  expect(read('again.json')).toEqual(read('program.json'));
  accepted('propagate', 'shape.json', edit, '-o', 'same.json');
  expect(read('same.json')).toEqual(read('program.json'));
  const { name, min, max } = read('program.json').layers[0].parameter;
  for (const shape of [model, 'shape.json']) {
    accepted('check', shape, 'program.json', '--trace', 'trace.json', '-o', 'report.json');
    accepted('prompt', shape, '--request', 'widen it', '--task', 'seed_edit', '-o', 'prompt.md');
    for (const program of ['program.json', 'program.txt']) {
      accepted('check', shape, program, '-o', 'report.json');
      accepted('evaluate', shape, program, '--set', `${name}=${max}`, '-o', 'state.json');
      accepted('score', shape, '--truth', 'program.json', '--program', program, '-o', 'score.json');
      expect(read('score.json')).toMatchObject({ programmatic: 1, geometric: 0, structural: 1 });
    }
  }
  for (const [program, ...options] of [
    ['program.json', '--set', `${name}=${min / 2}`],
    ['program.txt', '--set', `${name}=${max / 2}`],
    ['program.json', '--animate', name],
    ['program.json', '--morph'],
    ['program.json', '--set', `${name}=${max}`, '--repair'],
  ] as const) {
    accepted('apply', model, program, ...options, '-o', 'edited.glb');
    accepted('inspect', 'edited.glb', '-o', 'edited.json');
  }
}

describe('outputs of the gallery', () => {
  accepted('gallery', folder);
  it.each(read('gallery.json') as { file: string; requests: { edit: unknown }[] }[])(
    '$file: every output is taken',
    ({ file, requests }) => {
      write('edit.json', JSON.stringify(requests[0]?.edit));
      feed(file, 'edit.json');
    },
    120_000, // some twenty runs of the tool with sanitizers
  );
});

describe('outputs of CAD programs', () => {
  accepted('gallery', folder);
  const programs = readdirSync(folder).filter((file) => file.endsWith('.scad'));
  it('there are five', () => expect(programs.length).toBe(5));
  it.each(programs)(
    '%s: every output is taken',
    (program) => {
      const variations = program.replace('.scad', '.variations.json');
      accepted('cad', program, '-o', 'cad.json');
      accepted('cad', 'cad.json', '-o', 'cad-again.json');
      expect(read('cad-again.json')).toEqual(read('cad.json'));
      accepted('cad', 'cad.json', '-o', 'flat.scad');
      accepted('cad', 'flat.scad', '-o', 'flat-again.scad');
      expect(readFileSync(join(folder, 'flat-again.scad'))).toEqual(readFileSync(join(folder, 'flat.scad')));
      accepted('cad', program, '-o', 'cad.glb');
      accepted('inspect', 'cad.glb', '-o', 'shape.json');
      const ids = (file: string) => read(file).parts.filter((part: { virtual?: boolean }) => !part.virtual);
      expect(ids('shape.json').length).toBe(ids('cad.json').length);
      const more = ['--program', 'sliders.json', '--scad', 'family.scad', '--sets', 'sets.json'];
      for (const from of [program, 'cad.json'])
        accepted('family', from, '--variations', variations, '-o', 'family.json', ...more);
      const { counts, sliders } = read('family.json');
      expect(counts.sliders).toBe(sliders.length);
      expect(counts.sliders).toBeLessThan(counts.parameters);
      expect(read('sliders.json').layers.length).toBe(sliders.length);
      expect(Object.keys(read('sets.json').parameterSets).length).toBe(read(variations).variations.length);
      accepted('evaluate', 'shape.json', 'sliders.json', '-o', 'state.json');
      accepted(
        'apply',
        'cad.glb',
        'sliders.json',
        '--set',
        `x1=${read('sliders.json').layers[0].parameter.max}`,
        '-o',
        'moved.glb',
      );
      accepted('convert', 'sliders.json', '-o', 'sliders.txt');
      accepted('cad', 'family.scad', '-o', 'cad-base.json');
      expect(read('cad-base.json').parts.length).toBe(read('cad.json').parts.length);
      expect(read('cad-base.json').ranges.length).toBe(sliders.length);
      accepted('family', program, '-o', 'family.json');
      accepted('family', program, '--variations', variations, '--select', 'ranking', '-o', 'family.json');
    },
    120_000,
  );

  it('refuses by name and line', () => {
    write('bad.scad', 'cube(1);\nminkowski() { cube(1); sphere(1); }\n');
    const { code, said } = parsel('cad', 'bad.scad');
    expect(code).toBe(1);
    expect(said).toContain('bad.scad, line 2, column 1: minkowski is not read');
    write('bad.json', '{"format":"parsel/variations","version":1,"variations":[{"name":"a","absent":["nobody"]}]}');
    const wrong = parsel('family', 'chair.scad', '--variations', 'bad.json');
    expect(wrong.code).toBe(1);
    expect(wrong.said).toContain('bad.json, /variations/0/absent: the model has no part "nobody"');
  });
});

const hunt = join(process.env.PARSEL_DATA ?? '', 'hunt');
const edits =
  process.env.PARSEL_DATA && existsSync(hunt) ? readdirSync(hunt).filter((file) => file.endsWith('.edit.json')) : [];

describe.skipIf(edits.length === 0)('outputs of models by others', () => {
  it.each(edits)(
    '%s: every output is taken, or the first command says what is wrong',
    (edit) => {
      const model = `${edit.split('.')[0]}.glb`;
      for (const file of [model, edit]) copyFileSync(join(hunt, file), join(folder, basename(file)));
      const first = parsel('propagate', model, edit, '-o', 'tried.json');
      if (first.code === 0) feed(model, edit);
      else expect(first.said).toMatch(/^[\w/]+: .+; .+\.$/m);
    },
    120_000,
  );
});

describe('files that a command does not write over', () => {
  beforeAll(() => {
    parsel('gallery', folder);
    write(
      'chair.edit.json',
      JSON.stringify({ seed: [{ op: 'translate', part: 'seat', direction: [0, 1, 0], amount: 'x' }] }),
    );
    accepted('propagate', 'chair.glb', 'chair.edit.json', '-o', 'program.json');
  });
  const bytes = (name: string) => readFileSync(join(folder, name));

  it('the input, whatever its name, unless it is forced', () => {
    const before = bytes('chair.glb');
    for (const output of ['chair.glb', './chair.glb', join(folder, 'chair.glb')]) {
      const { code, said } = parsel('apply', 'chair.glb', 'program.json', '--set', 'x1=0.1', '-o', output);
      expect(code).toBe(1);
      expect(said).toContain('is read by the same command');
    }
    expect(parsel('propagate', 'chair.glb', 'chair.edit.json', '-o', 'chair.edit.json').code).toBe(1);
    expect(parsel('propagate', 'chair.glb', 'chair.edit.json', '--trace', 'chair.glb').code).toBe(1);
    expect(bytes('chair.glb').equals(before)).toBe(true);
    copyFileSync(join(folder, 'chair.glb'), join(folder, 'mine.glb'));
    accepted('apply', 'mine.glb', 'program.json', '--set', 'x1=0.1', '--force', '-o', 'mine.glb');
    expect(bytes('mine.glb').equals(before)).toBe(false);
  });

  it('a file of another kind, unless it is forced; an older model is replaced', () => {
    write('notes.txt', 'do not lose this');
    const { code, said } = parsel('apply', 'chair.glb', 'program.json', '-o', 'notes.txt');
    expect(code).toBe(1);
    expect(said).toContain('no GLB');
    expect(bytes('notes.txt').toString()).toBe('do not lose this');
    accepted('apply', 'chair.glb', 'program.json', '-o', 'notes.txt', '--force');
    accepted('apply', 'chair.glb', 'program.json', '-o', 'notes.txt');
    write('empty.glb', '');
    accepted('apply', 'chair.glb', 'program.json', '-o', 'empty.glb');
  });

  it('says what a file of our own is where a model is wanted', () => {
    accepted('inspect', 'chair.glb', '-o', 'shape.json');
    for (const [file, what] of [
      ['shape.json', 'parsel/shape'],
      ['program.json', 'parsel/program'],
    ] as const) {
      const { code, said } = parsel('apply', file, 'program.json', '-o', 'never.glb');
      expect(code).toBe(1);
      expect(said).toContain(`${what}, not a model`);
    }
  });
});
