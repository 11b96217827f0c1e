// `parsel prompt` and `parsel reply` for what is asked about CAD programs and about models without names, with the recorded
// replies: from a prompt to the few sliders of a family.
import { spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { withoutNames } from '../../web/tools/nameless.mjs';
import { readRecordings } from '../../web/tools/prompts.mjs';

const tool = fileURLToPath(new URL('../../build/native-debug/core/parsel', import.meta.url));
let folder: string;

function call(...given: string[]) {
  const { status, stdout, stderr } = spawnSync(tool, given, { cwd: folder, encoding: 'utf8', maxBuffer: 1 << 28 });
  return { code: status, output: stdout, text: stderr };
}
function run(...given: string[]): string {
  const { code, output, text } = call(...given);
  if (code !== 0) throw new Error(`${given.join(' ')}: ${text}`);
  return output;
}

/** Writes the recorded replies to a prompt; their names. */
function replies(prompt: string, name: string): string[] {
  const hash = createHash('sha256').update(prompt).digest('hex');
  return (readRecordings().get(hash)?.replies ?? []).map(({ vote, text }) => {
    writeFileSync(join(folder, `${name}.${vote}.txt`), text);
    return `${name}.${vote}.txt`;
  });
}

beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'parsel-kinds-'));
  run('gallery', '.');
});
afterAll(() => rmSync(folder, { recursive: true }));

describe('parsel prompt and reply', () => {
  it('name the kinds of a program, and give the numbers of one as variations for parsel family', () => {
    const named = replies(run('prompt', 'table.scad', '--task', 'kinds'), 'kinds');
    expect(named).toHaveLength(5);
    const { kinds } = JSON.parse(run('reply', 'table.scad', '--task', 'kinds', ...named));
    expect(kinds[0]).toMatchObject({ votes: 5 });
    const all = { format: 'parsel/variations', version: 1, variations: [] as unknown[] };
    for (const { name } of kinds.slice(0, 3)) {
      const given = replies(run('prompt', 'table.scad', '--task', 'variation', '--kind', name), 'numbers');
      const file = join(folder, 'one.json');
      run('reply', 'table.scad', '--task', 'variation', '--kind', name, ...given, '-o', 'one.json');
      const [variation] = JSON.parse(readFileSync(file, 'utf8')).variations;
      expect(variation).toMatchObject({ name, source: 'model', votes: 5 });
      all.variations.push(variation);
    }
    writeFileSync(join(folder, 'all.json'), JSON.stringify(all));
    const family = JSON.parse(run('family', 'table.scad', '--variations', 'all.json'));
    expect(family.variations).toHaveLength(3);
    expect(family.counts.sliders).toBeLessThan(12);
  });

  it('name the parts of a model without names', () => {
    writeFileSync(join(folder, 'bare.glb'), withoutNames(new Uint8Array(readFileSync(join(folder, 'desk.glb')))));
    const prompt = run('prompt', 'bare.glb', '--task', 'part_names');
    expect(prompt).not.toContain('bare');
    const given = replies(prompt, 'names');
    const { names } = JSON.parse(run('reply', 'bare.glb', '--task', 'part_names', ...given));
    expect(names).toMatchObject({ category: 'desk', front: '+z', of: 3 });
    expect(names.parts.map(({ label }: { label: string }) => label)).toContain('drawer');
  });

  it('count without what cannot be read, and say so', () => {
    writeFileSync(join(folder, 'bad.txt'), 'I would rather not.');
    const [good = ''] = replies(run('prompt', 'table.scad', '--task', 'kinds'), 'kinds');
    const { code, text, output } = call('reply', 'table.scad', '--task', 'kinds', 'bad.txt', good);
    expect(code).toBe(0);
    expect(text).toContain('bad.txt');
    expect(JSON.parse(output).refused).toHaveLength(1);
  });

  it.each([
    [['prompt', 'table.scad', '--task', 'variation'], 1, 'kind'],
    [['prompt', 'table.scad', '--task', 'kinds', '--kind', 'desk'], 1, 'leave the kind out'],
    [['prompt', 'table.scad', '--task', 'kinds', '--count', '99'], 1, 'count'],
    [['prompt', 'table.scad', '--task', 'kinds', '--count', 'many'], 2, 'whole number'],
    [['prompt', 'desk.glb', '--task', 'part_names', '--kind', 'desk'], 2, '--kind'],
    [['prompt', 'desk.glb', '--task', 'part_names', '--request', 'name it'], 1, 'leave the request out'],
    [['reply', 'table.scad', '--task', 'variation', 'bad.txt'], 2, '--kind'],
    [['reply', 'table.scad', '--task', 'variation', '--kind', 'desk', 'bad.txt'], 1, 'bad.txt'],
    [['reply', 'table.scad', '--task', 'kinds', '--kind', 'desk', 'bad.txt'], 2, '--kind'],
    [['prompt', 'desk.glb', '--task', 'paint', '--request', 'x'], 1, 'variation (of a CAD program)'],
  ])('refuse %j', (given, code, words) => {
    const answer = call(...given);
    expect([given, answer.code]).toEqual([given, code]);
    expect(answer.text).toContain(words);
  });
});
