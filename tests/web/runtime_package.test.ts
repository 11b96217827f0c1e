// The package as others get it: packed, installed into an empty project without a network, imported by plain Node.
import { execFileSync, spawnSync } from 'node:child_process';
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import type * as Runtime from '../../web/runtime/src/index';
import { slidersOf } from '../../web/src/program/sliders';
import type { Program, Shape } from '../../web/src/program/types';
import { twoBoxes } from './box_shapes';
import { type WrittenState, worstDifference, writeEvaluator } from './compare_states';
import { moving } from './fake_core';
import { glbOf } from './shape_glb';

const web = fileURLToPath(new URL('../../web', import.meta.url));
const project = mkdtempSync(join(tmpdir(), 'parsel-runtime-'));
const installed = join(project, 'node_modules/parsel-runtime');
let runtime: typeof Runtime;
let built = '';

/** What a command writes. */
const run = (command: string, args: readonly string[], cwd = project) =>
  execFileSync(command, args, {
    cwd,
    encoding: 'utf8',
    stdio: ['ignore', 'pipe', 'pipe'],
    env: { ...process.env, npm_config_cache: join(project, 'cache'), npm_config_update_notifier: 'false' },
  });

beforeAll(async () => {
  built = run(process.execPath, ['runtime/build.mjs'], web);
  run('npm', ['pack', '--silent', '--pack-destination', project], join(web, 'runtime'));
  const [tarball = ''] = readdirSync(project).filter((file) => file.endsWith('.tgz'));
  writeFileSync(join(project, 'package.json'), '{"name":"empty","private":true,"type":"module"}');
  run('npm', ['install', '--silent', '--offline', '--no-audit', '--no-fund', `./${tarball}`]);
  runtime = (await import(/* @vite-ignore */ pathToFileURL(join(installed, 'dist/index.js')).href)) as typeof Runtime;
}, 240_000);

afterAll(() => rmSync(project, { recursive: true, force: true }));

describe('the package', { timeout: 120_000 }, () => {
  it('has a core of less than 25 kB', () => {
    expect(Number(/core: ([\d.]+) kB gzip/.exec(built)?.[1])).toBeLessThan(25);
  });

  it('brings its README, its licence and the notices of what is built in, and no sources', () => {
    const files = readdirSync(installed);
    expect(files.sort()).toEqual(['LICENSE', 'NOTICES.txt', 'README.md', 'dist', 'package.json']);
    const notices = readFileSync(join(installed, 'NOTICES.txt'), 'utf8');
    for (const name of ['valibot', 'three', 'camera-controls'])
      expect(notices).toMatch(new RegExp(`^${name} [\\d.]+ \\(MIT\\)`, 'm'));
    expect(readFileSync(join(installed, 'LICENSE'), 'utf8')).toContain('GNU GENERAL PUBLIC LICENSE');
  });

  it('is imported by its name where three.js is not installed', () => {
    expect(existsSync(join(project, 'node_modules/three'))).toBe(false);
    writeFileSync(
      join(project, 'core.js'),
      `import * as all from 'parsel-runtime'; console.log(Object.keys(all).sort().join());`,
    );
    expect(run(process.execPath, ['core.js']).trim()).toBe(
      'ParselError,compile,embedProgram,loadProgram,readEmbedded,removeEmbedded',
    );
  });

  it('makes no function of text', () => {
    for (const file of readdirSync(join(installed, 'dist')).filter((name) => name.endsWith('.js'))) {
      expect(readFileSync(join(installed, 'dist', file), 'utf8'), file).not.toMatch(
        /\beval\(|new Function\b|\bFunction\(/,
      );
    }
  });

  it('moves a scene with the three.js of the project', () => {
    symlinkSync(join(web, 'node_modules/three'), join(project, 'node_modules/three'));
    writeFileSync(join(project, 'model.glb'), runtime.embedProgram(glbOf(twoBoxes), moving('left'), twoBoxes));
    writeFileSync(
      join(project, 'scene.js'),
      `import { readFileSync } from 'node:fs';
       import { Box3 } from 'three';
       import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
       import { attachSliders } from 'parsel-runtime/three';
       const gltf = await new GLTFLoader().parseAsync(Uint8Array.from(readFileSync('model.glb')).buffer, '');
       const sliders = attachSliders(gltf);
       sliders.set('x', 0.2);
       console.log(new Box3().setFromObject(gltf.scene).max.y.toFixed(4));`,
    );
    expect(run(process.execPath, ['scene.js']).trim()).toBe('0.4500');
  });

  it('is imported by servers that have no elements', () => {
    writeFileSync(join(project, 'server.js'), `import 'parsel-runtime/viewer.standalone'; console.log('rendered');`);
    expect(run(process.execPath, ['server.js']).trim()).toBe('rendered');
  });

  it('has types that strict projects of Node accept', () => {
    mkdirSync(join(project, 'node_modules/@types'), { recursive: true });
    for (const name of ['three', 'webxr']) {
      const target = join(web, 'node_modules/@types', name);
      if (existsSync(target)) symlinkSync(target, join(project, 'node_modules/@types', name));
    }
    writeFileSync(
      join(project, 'use.ts'),
      `import { compile, loadProgram, ParselError, type Evaluate } from 'parsel-runtime';
       import { attachSliders, type AttachedSliders } from 'parsel-runtime/three';
       import 'parsel-runtime/viewer';
       import type { GLTF } from 'three/addons/loaders/GLTFLoader.js';
       const evaluate: Evaluate = compile(loadProgram('{}'));
       const corners: Float64Array = evaluate({ x: 1 });
       export const sliders = (gltf: GLTF): AttachedSliders => attachSliders(gltf);
       document.querySelector('parsel-viewer')?.set('x', corners[0] ?? 0);
       // @ts-expect-error a slider's value is a number
       evaluate({ x: 'far' });
       export const place = (error: unknown) => (error instanceof ParselError ? error.place : '');`,
    );
    const compilerOptions = { strict: true, noEmit: true, module: 'nodenext', target: 'es2022', types: [] };
    writeFileSync(
      join(project, 'tsconfig.json'),
      JSON.stringify({
        compilerOptions: { ...compilerOptions, lib: ['es2023', 'dom', 'dom.iterable'] },
        files: ['use.ts'],
      }),
    );
    const tsc = join(web, 'node_modules/typescript/bin/tsc');
    const { stdout } = spawnSync(process.execPath, [tsc], { cwd: project, encoding: 'utf8' });
    expect(stdout).toBe('');
  });
});

interface Vectors {
  shapes: Record<string, Shape>;
  cases: { name: string; shape: string; program: Program; samples: (WrittenState & { values: number[] })[] }[];
}
const vectors = JSON.parse(readFileSync(new URL('../golden/program_vectors.json', import.meta.url), 'utf8')) as Vectors;

describe('the packed core', () => {
  it.each(vectors.cases.map((item) => [item.name, item] as const))(
    'agrees to 1e-9 with the evaluator of the core: %s',
    (_, item) => {
      const shape = vectors.shapes[item.shape] as Shape;
      const bare = runtime.loadProgram(item.program);
      const travelled = runtime.readEmbedded(runtime.embedProgram(glbOf(shape), item.program, shape));
      if (travelled === null) throw new Error('nothing was embedded');
      for (const evaluate of [runtime.compile(bare, shape), runtime.compile(travelled)]) {
        for (const { values, parts, groups } of item.samples) {
          const clamped = values.every(
            (x, i) => x >= (bare.parameters[i]?.min ?? 0) && x <= (bare.parameters[i]?.max ?? 0),
          );
          expect(clamped).toBe(true);
          const corners = evaluate(values);
          const state = { ...evaluate, corners, evaluate: () => {}, parameters: [] };
          const { worst, place } = worstDifference(writeEvaluator(state, shape), { parts, groups });
          expect(worst, place).toBeLessThanOrEqual(1e-9);
        }
      }
    },
  );
});

describe('a program', () => {
  const record = slidersOf(moving('left'), twoBoxes);

  it('is evaluated by name, by order, and where it stood', () => {
    const evaluate = runtime.compile(runtime.loadProgram(JSON.stringify(record)));
    expect(evaluate()[1]).toBe(-0.25);
    expect(evaluate({ x: 0.1 })[1]).toBeCloseTo(-0.15, 12);
    expect(evaluate([9])[1]).toBeCloseTo(0.1, 12); // no farther than the slider goes
    expect(evaluate({})[1]).toBe(-0.25);
    expect(evaluate.movingParts).toEqual([0]);
  });

  it.each<[string, unknown, RegExp]>([
    ['text that is no JSON', '{"format":', /this is no JSON/],
    [
      'another format',
      { format: 'parsel/shape' },
      /\/format: not a ParSEL program; give a file of format "parsel\/program"/,
    ],
    [
      'a newer program',
      { ...moving('left'), version: 2 },
      /\/version: version 2 is unknown; use version 1, or a newer ParSEL/,
    ],
    ['newer sliders', { ...record, version: 2 }, /\/version: version 2 is unknown/],
    ['a session', { format: 'parsel/session', version: 1 }, /a session holds no hexahedra .*export/],
    ['nothing', undefined, /program\/check/],
  ])('is refused when it is %s', (_, json, message) => {
    expect(() => runtime.loadProgram(json)).toThrow(message);
  });

  it('is refused by name with what it is given', () => {
    const loaded = runtime.loadProgram(moving('left'));
    expect(() => runtime.compile(loaded)).toThrow(/comes without the shape/);
    expect(() => runtime.compile(loaded, { format: 'parsel/shape' })).toThrow(/program\/shape/);
    expect(() => runtime.compile(runtime.loadProgram(moving('nobody')), twoBoxes)).toThrow(
      /the part "nobody" is unknown/,
    );
    const evaluate = runtime.compile(loaded, twoBoxes);
    expect(() => evaluate({ y: 1 })).toThrow(/\/y: there is no slider of this name; name one of x\./);
    expect(() => evaluate([0, 0])).toThrow(/2 values for 1 sliders/);
    expect(() => evaluate({ x: Number.NaN })).toThrow(/\/x: NaN is no finite number/);
    expect(() => runtime.embedProgram(new Uint8Array(4), moving('left'), twoBoxes)).toThrow(/byte 0: this is no GLB/);
    expect(() => runtime.embedProgram(glbOf(twoBoxes), moving('nobody'), twoBoxes)).toThrow(runtime.ParselError);
  });

  it('goes into a file and out of it, which is the same as before', () => {
    const glb = glbOf(twoBoxes);
    const written = runtime.embedProgram(glb, moving('left'), twoBoxes);
    expect(runtime.readEmbedded(written)?.parameters.map(({ name }) => name)).toEqual(['x']);
    expect(runtime.removeEmbedded(written)).toEqual(glb);
    expect(runtime.readEmbedded(glb)).toBe(null);
  });
});
