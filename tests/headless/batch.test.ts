// parsel batch: many models, some of them bad, with processes killed and the batch interrupted.
import { existsSync, mkdirSync, readdirSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { Bench, childrenOf, until } from './parsel';

let bench: Bench;
beforeAll(() => {
  bench = new Bench();
}, 120_000);
afterAll(() => bench.end());

const tiny = (count: number) => Array.from({ length: count }, (_, i) => ({ id: `chair ${i}`, model: 'chair.glb' }));
const widen = { request: 'make the seat 10 cm wider' };

describe('a manifest', () => {
  it('has a line a job in results.jsonl, in its order, and a folder for each with its files', () => {
    const edit = {
      seed: [
        { op: 'scale_1d', part: 'seat', origin: { part: 'seat', at: [0, 0, 0] }, direction: [1, 0, 0], amount: 'x' },
      ],
    };
    bench.write('edit.json', JSON.stringify(edit));
    bench.write('all.jsonl', [
      { model: 'desk.glb', shape: true },
      { id: 'wide', model: 'chair.glb', edits: [widen], apply: [{}, { set: { x1: 0 } }, { morph: true }] },
      {
        id: 'two layers',
        model: 'chair.glb',
        edits: [{ edit: 'edit.json', request: 'widen' }, { request: 'raise the back' }],
      },
      { id: 'family', model: 'chair.glb', edits: [{ edit }], siblings: { count: 3, seed: 7 } },
      { id: 'relabelled', model: 'chair.glb', labels: { 'node:0': 'throne' }, shape: true },
    ]);
    const { code, out, said } = bench.run('batch', 'all.jsonl', '-o', 'all', '--workers', '2');
    expect(said).toBe('');
    expect(code).toBe(0);
    expect(JSON.parse(out)).toMatchObject({ jobs: 5, done: 5, refused: 0 });
    const results = bench.results('all');
    expect(results.map(({ id }) => id)).toEqual(['line_000001', 'wide', 'two layers', 'family', 'relabelled']);
    const read = (path: string) => readFileSync(join(bench.folder, path));
    const [desk, wide, two, family] = results;
    expect(desk).toMatchObject({ line: 1, model: 'desk.glb', files: ['shape.json'], attempts: 1 });
    expect(wide).toMatchObject({
      files: ['program.json', 'edited_1.glb', 'edited_2.glb', 'edited_3.glb'],
      check: { accepted: true, findings: [] },
      layers: [{ request: widen.request, parameter: 'x1', broken: 0 }],
      morphs: [{ sliders: [{ parameter: 'x1' }] }],
    });
    // What was said sets the slider; at 0 the file is as it was.
    expect(JSON.parse(read('all/wide/program.json').toString()).layers[0].parameter.value).toBeGreaterThan(0);
    expect(read('all/wide/edited_1.glb').equals(read('chair.glb'))).toBe(false);
    expect(read('all/wide/edited_2.glb').equals(read('chair.glb'))).toBe(true);
    expect(two).toMatchObject({ layers: [{ parameter: 'x1', request: 'widen' }, { parameter: 'x2' }] });
    expect(family).toMatchObject({ siblings: { count: 3 } });
    expect(readdirSync(join(bench.folder, 'all/family')).sort()).toEqual([
      'program.json',
      'result.json',
      'sibling_1.glb',
      'sibling_2.glb',
      'sibling_3.glb',
      'siblings.jsonl',
    ]);
    expect(read('all/relabelled/shape.json').toString()).toContain('throne');
    for (const { id } of results) expect(existsSync(join(bench.folder, 'all', id, 'result.json'))).toBe(true);
    expect(readdirSync(join(bench.folder, 'all/.work'))).toEqual([]);
  });

  it('goes on past what is bad, and says of each line what is wrong with it', () => {
    const chair = readFileSync(join(bench.folder, 'chair.glb'));
    bench.write('cut.glb', chair.subarray(0, chair.length / 2));
    bench.write(
      'noise.glb',
      Uint8Array.from({ length: 5000 }, (_, i) => (i * 7919) % 256),
    );
    const lying = Buffer.from(chair);
    lying.writeUInt32LE(0xfffffff0, 12); // the length of its first chunk
    bench.write('lying.glb', lying);
    bench.write('deep.gltf', `{"asset":{"version":"2.0"},"extras":${'['.repeat(100_000)}${']'.repeat(100_000)}}`);
    const lines = [
      '{"model": "absent.glb"}',
      '{"model": "chair.glb"',
      '[1, 2]',
      '{"model": "cut.glb"}',
      '{"model": "noise.glb"}',
      '{"model": "lying.glb"}',
      '{"model": "deep.gltf"}',
      '{"model": "edit.json"}',
      '{"model": "chair.glb", "colour": "red"}',
      '{"model": "chair.glb", "edits": [{"request": "make it nicer"}]}',
      '{"model": "chair.glb", "edits": [{"request": "widen the seat"}], "apply": [{"set": {"x1": 99}}]}',
      '{"model": "chair.glb", "id": "../../escape"}',
      '{"model": "chair.glb", "id": "twice"}',
      '{"model": "chair.glb", "id": "Twice"}',
      '',
      '{"model": "chair.glb", "id": "last"}',
    ];
    bench.write('bad.jsonl', lines.join('\r\n'));
    const { code, out } = bench.run('batch', 'bad.jsonl', '-o', 'bad');
    expect(code).toBe(1);
    expect(JSON.parse(out)).toMatchObject({ jobs: 15, done: 15, refused: 13 });
    const said = bench.results('bad').map(({ line, error }) => [line, error?.place ?? '', error?.cause ?? '']);
    const of = (line: number) => said.find(([other]) => other === line) ?? [];
    expect(of(1)[1]).toMatch(/absent\.glb$/);
    expect(of(2)).toEqual([2, 'line 2', expect.stringMatching(/^this is no JSON \(/)]);
    expect(of(3)[2]).toBe('this is no JSON object');
    for (const line of [4, 5, 6, 7, 8]) expect(of(line)[2], String(line)).not.toMatch(/^$|crash|internal/);
    expect(of(9)).toEqual([9, '/colour', 'is not known here']);
    expect(of(10)[2]).toMatch(/^it is not read without doubt: /);
    expect(of(11)).toEqual([11, '/apply/0/set/x1', "the value is outside the parameter's range"]);
    expect(of(12)[1]).toBe('line 12, /id');
    expect(of(13)[2]).toBe('');
    expect(of(14)[2]).toBe('line 13 has the same');
    expect(of(16)).toEqual([16, '', '']);
    // Of what was refused there is the result alone.
    expect(readdirSync(join(bench.folder, 'bad/line_000011'))).toEqual(['result.json']);
    expect(existsSync(join(bench.folder, '../escape'))).toBe(false);
  });

  it.each<[string, string[], number, RegExp]>([
    ['without -o', ['all.jsonl'], 2, /batch needs -o/],
    ['that is not there', ['none.jsonl', '-o', 'never'], 1, /none\.jsonl: the manifest cannot be read/],
    ['twice', ['all.jsonl', '-o', 'all'], 1, /holds results of this manifest already; add --resume/],
    ['with half a slice', ['all.jsonl', '-o', 'never', '--slice', '4/4'], 2, /--slice takes INDEX\/COUNT/],
    ['with no worker', ['all.jsonl', '-o', 'never', '--workers', '0'], 2, /--workers takes a whole number from 1/],
    ['with another option', ['all.jsonl', '-o', 'never', '--fast'], 2, /batch has no option --fast/],
    ['into a file', ['all.jsonl', '-o', 'chair.glb'], 1, /chair\.glb: it cannot be written/],
  ])('%s is refused', (_, args, code, words) => {
    const answer = bench.run('batch', ...args);
    expect(answer).toMatchObject({ code, out: '' });
    expect(answer.said).toMatch(words);
    expect(existsSync(join(bench.folder, 'never'))).toBe(false);
  });

  it('leaves alone what is in the folder and is no result', () => {
    mkdirSync(join(bench.folder, 'mine/last'), { recursive: true });
    bench.write('mine/last/notes.txt', 'do not lose this');
    bench.write('last.jsonl', [{ id: 'last', model: 'chair.glb' }]);
    const { code, said } = bench.run('batch', 'last.jsonl', '-o', 'mine', '--resume');
    expect(code).toBe(1);
    expect(said).toMatch(/mine\/last: it is there and is no result of a batch/);
    expect(readFileSync(join(bench.folder, 'mine/last/notes.txt'), 'utf8')).toBe('do not lose this');
  });

  it('is shared by slices, and collected afterwards', () => {
    bench.write('seven.jsonl', tiny(7));
    for (const slice of ['0/3', '1/3', '2/3']) {
      expect(bench.run('batch', 'seven.jsonl', '-o', 'sliced', '--slice', slice).code).toBe(0);
    }
    const lines = [0, 1, 2].map((i) => bench.results('sliced', `results-${i}-of-3.jsonl`).map(({ line }) => line));
    expect(lines).toEqual([
      [1, 4, 7],
      [2, 5],
      [3, 6],
    ]);
    const { out } = bench.run('batch', 'seven.jsonl', '-o', 'sliced', '--resume');
    expect(JSON.parse(out)).toMatchObject({ jobs: 7, done: 7 });
    expect(bench.results('sliced').map(({ line }) => line)).toEqual([1, 2, 3, 4, 5, 6, 7]);
  });

  it('does a job again when its line has changed, and only that', () => {
    bench.write('changing.jsonl', tiny(3));
    bench.run('batch', 'changing.jsonl', '-o', 'changing');
    const before = bench.results('changing');
    const times = () => tiny(3).map(({ id }) => statSync(join(bench.folder, 'changing', id, 'result.json')).mtimeMs);
    const first = times();
    bench.write('changing.jsonl', [...tiny(2), { id: 'chair 2', model: 'desk.glb' }]);
    expect(bench.run('batch', 'changing.jsonl', '-o', 'changing', '--resume').code).toBe(0);
    expect(bench.results('changing').map(({ model }) => model)).toEqual(['chair.glb', 'chair.glb', 'desk.glb']);
    expect(bench.results('changing').slice(0, 2)).toEqual(before.slice(0, 2));
    expect(times().map((time, i) => time === first[i])).toEqual([true, true, false]);
  });
});

describe('limits', () => {
  const long = {
    id: 'long',
    model: 'chair.glb',
    edits: [widen, { request: 'raise the back' }],
    siblings: { count: 9999 },
  };

  it('a job that takes too long is a line, and the next one is done', () => {
    bench.write('long.jsonl', [long, { id: 'next', model: 'desk.glb' }]);
    const { code } = bench.run('batch', 'long.jsonl', '-o', 'late', '--seconds', '10', '--workers', '1');
    expect(code).toBe(1);
    const [late, next] = bench.results('late');
    expect(late?.error).toMatchObject({ cause: 'it took longer than 10 s and was ended' });
    expect(late?.attempts).toBe(1);
    expect(next).toMatchObject({ id: 'next', model: 'desk.glb' });
    expect(next?.error).toBeUndefined();
    expect(readdirSync(join(bench.folder, 'late/long'))).toEqual(['result.json']);
  });

  it('a model that needs more memory than there is, is a line', () => {
    // Its buffer alone is more than the memory that the process may have.
    const bytes = 80 * 2 ** 20;
    bench.write('large.bin', Buffer.alloc(bytes));
    const buffers = [{ uri: 'large.bin', byteLength: bytes }];
    bench.write('large.gltf', JSON.stringify({ asset: { version: '2.0' }, buffers }));
    bench.write('large.jsonl', [{ model: 'large.gltf' }, { id: 'next', model: 'desk.glb' }]);
    bench.run('batch', 'large.jsonl', '-o', 'large', '--memory', '64');
    const [large, next] = bench.results('large');
    expect(large?.error?.cause).toMatch(/memory/);
    expect(next?.error).toBeUndefined();
  });

  it('a process that is killed costs an attempt; one that is killed again and again a line', async () => {
    bench.write('killed.jsonl', [long, { id: 'next', model: 'desk.glb' }]);
    const { child, ended } = bench.start('batch', 'killed.jsonl', '-o', 'killed', '--workers', '1', '--attempts', '2');
    const seen = new Set<number>();
    for (let times = 0; times < 2; ++times) {
      let pid = 0;
      await until('a process that does the job', 20, () => {
        pid = childrenOf(child.pid as number).find((one) => !seen.has(one)) ?? 0;
        return pid !== 0;
      });
      seen.add(pid);
      process.kill(pid, 'SIGKILL');
    }
    expect((await ended).code).toBe(1);
    const [first, next] = bench.results('killed');
    expect(first).toMatchObject({ attempts: 2, error: { cause: 'it crashed: its process was ended by SIGKILL' } });
    expect(next?.error).toBeUndefined();
  });
});

describe('an end before the end', () => {
  it.each<['SIGINT' | 'SIGKILL', number | null]>([
    ['SIGINT', 130],
    ['SIGKILL', null],
  ])('%s loses nothing that is done, and --resume does the rest', async (signal, code) => {
    const [name, count] = [`end-${signal}`, 60];
    bench.write(`${name}.jsonl`, tiny(count));
    const { child, ended } = bench.start('batch', `${name}.jsonl`, '-o', name, '--workers', '2');
    await until('some results', 30, () => bench.written(name).size >= 10);
    const workers = childrenOf(child.pid as number);
    child.kill(signal);
    expect((await ended).code).toBe(code);
    await until('no process is left', 5, () => workers.every((pid) => !existsSync(`/proc/${pid}`)));
    const written = bench.written(name);
    expect(written.size).toBeLessThan(count);
    expect(bench.results(name).length).toBeGreaterThanOrEqual(10);
    if (signal === 'SIGINT') {
      expect(bench.results(name).map(({ id }) => id)).toEqual(
        tiny(count)
          .map(({ id }) => id)
          .slice(0, written.size),
      );
      expect(readdirSync(join(bench.folder, name, '.work'))).toEqual([]);
    }
    const again = bench.run('batch', `${name}.jsonl`, '-o', name, '--resume');
    expect(again.code).toBe(0);
    expect(bench.results(name).map(({ id }) => id)).toEqual(tiny(count).map(({ id }) => id));
    const after = bench.written(name);
    for (const [id, result] of written) expect(after.get(id)).toEqual(result);
    expect(readdirSync(join(bench.folder, name, '.work'))).toEqual([]);
  });
});
