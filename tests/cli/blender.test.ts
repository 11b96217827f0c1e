// Sliders in another tool: Debian's Blender opens what `parsel apply --morph` writes of every gallery model; with the shape
// key of a slider at 1 the vertices are where `parsel apply` has them at the slider's end.
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';

const tool = fileURLToPath(new URL('../../build/native-debug/core/parsel', import.meta.url));
const hasBlender = spawnSync('blender', ['--version']).status === 0;
if (!hasBlender) process.stdout.write('blender is not installed: its test is skipped.\n');

const script = `
import bpy, json, numpy

# Debian 12's importer (Blender 3.4.1) uses a name that Debian 12's numpy has dropped.
if numpy.__version__.startswith('1.'):
    numpy.bool = bool

def vertices(path, key):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    keys = 0
    for o in bpy.data.objects:
        blocks = o.data.shape_keys.key_blocks if o.type == 'MESH' and o.data.shape_keys else {}
        if key in blocks:
            blocks[key].value = 1
            keys += 1
    graph = bpy.context.evaluated_depsgraph_get()
    out = {}
    for o in bpy.data.objects:
        if o.type == 'MESH':
            seen = o.evaluated_get(graph)
            out[o.name] = [seen.matrix_world @ v.co for v in seen.data.vertices]
    return keys, out

def farthest(one, other):
    assert one.keys() == other.keys(), (one.keys(), other.keys())
    return max((a - b).length for o in one for a, b in zip(one[o], other[o], strict=True))

told = []
for case in json.load(open('cases.json')):
    keys, morphed = vertices(case['morph'], case['key'])
    _, edited = vertices(case['end'], '')
    _, rest = vertices(case['morph'], '')
    told.append({'model': case['model'], 'keys': keys, 'off': farthest(morphed, edited), 'moved': farthest(rest, edited)})
json.dump(told, open('told.json', 'w'))
`;

interface Case {
  model: string;
  key: string;
  morph: string;
  end: string;
}

describe.skipIf(!hasBlender)('Blender', () => {
  let folder: string;
  const run = (...args: string[]) => execFileSync(tool, args, { cwd: folder, encoding: 'utf8', stdio: 'pipe' });
  const read = (name: string) => JSON.parse(readFileSync(join(folder, name), 'utf8'));
  const write = (name: string, content: unknown) => writeFileSync(join(folder, name), JSON.stringify(content));
  beforeAll(() => {
    folder = mkdtempSync(join(tmpdir(), 'parsel-blender-'));
    run('gallery', '.');
  });
  afterAll(() => rmSync(folder, { recursive: true }));

  it('has the vertices of apply with the shape key of a slider at 1', { timeout: 300_000 }, () => {
    const cases: Case[] = [];
    for (const { file, requests } of read('gallery.json') as { file: string; requests: { edit: unknown }[] }[]) {
      // What changes counts has no morph target, and is refused elsewhere.
      const request = requests.find(({ edit }) => !JSON.stringify(edit).includes('change_count'));
      if (request === undefined) continue;
      const model = file.replace('.glb', '');
      const [morph, end] = [`${model}_morph.glb`, `${model}_end.glb`];
      write('edit.json', request.edit);
      run('propagate', file, 'edit.json', '-o', 'program.json', '--request', `Change the ${model}.`);
      const { name, max } = read('program.json').layers[0].parameter;
      const { sliders } = JSON.parse(run('apply', file, 'program.json', '--set', `${name}=0`, '--morph', '-o', morph));
      run('apply', file, 'program.json', '--set', `${name}=${max}`, '-o', end);
      cases.push({ model, key: sliders[0].targets[0], morph, end });
    }
    expect(cases.length).toBeGreaterThan(15);
    write('cases.json', cases);
    writeFileSync(join(folder, 'compare.py'), script);
    const { status, stdout, stderr } = spawnSync(
      'blender',
      ['--background', '--factory-startup', '--python-exit-code', '1', '--python', 'compare.py'],
      // Blender goes by the variable rather than by the folder that it is started in.
      { cwd: folder, env: { ...process.env, PWD: folder }, encoding: 'utf8' },
    );
    expect(status, `${stdout}${stderr}`).toBe(0);
    const told = read('told.json') as { model: string; keys: number; off: number; moved: number }[];
    expect(told.map(({ model }) => model)).toEqual(cases.map(({ model }) => model));
    for (const { model, keys, off, moved } of told) {
      expect(keys, model).toBeGreaterThan(0);
      expect(moved, model).toBeGreaterThan(0.01);
      expect(off, model).toBeLessThan(1e-4);
    }
  });
});
