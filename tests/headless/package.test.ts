// The package as others get it: packed, installed into an empty project without a network, called by npx.
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { web } from './parsel';

const native = fileURLToPath(new URL('../../build/native-debug/core/parsel', import.meta.url));
const project = mkdtempSync(join(tmpdir(), 'parsel-headless-'));
const installed = join(project, 'node_modules/parsel-headless');

const run = (command: string, args: readonly string[], cwd = project) =>
  execFileSync(command, args, {
    cwd,
    encoding: 'utf8',
    stdio: ['ignore', 'pipe', 'pipe'],
    env: { ...process.env, npm_config_cache: join(project, 'cache'), npm_config_update_notifier: 'false' },
  });

beforeAll(() => {
  run('npm', ['pack', '--silent', '--pack-destination', project], join(web, 'headless'));
  const [tarball = ''] = readdirSync(project).filter((file) => file.endsWith('.tgz'));
  writeFileSync(join(project, 'package.json'), '{"name":"empty","private":true}');
  run('npm', ['install', '--silent', '--offline', '--no-audit', '--no-fund', '--omit=peer', `./${tarball}`]);
}, 240_000);
afterAll(() => rmSync(project, { recursive: true, force: true }));

describe('the package', { timeout: 120_000 }, () => {
  it('brings its README, its licence, the notices of what is compiled in, and the source', () => {
    expect(readdirSync(installed).sort()).toEqual(['LICENSE', 'NOTICES.txt', 'README.md', 'dist', 'package.json']);
    expect(readFileSync(join(installed, 'NOTICES.txt'), 'utf8')).toMatch(
      /^ParSEL is free software[\s\S]*GiNaC[\s\S]*CLN/,
    );
    const source = run('tar', ['-tzf', join(installed, 'dist/source.tar.gz')]).split('\n');
    expect(source).toEqual(expect.arrayContaining(['core/cli/job.cpp', 'web/headless/src/parsel.ts']));
    expect(readdirSync(join(project, 'node_modules')).filter((name) => !name.startsWith('.'))).toEqual([
      'parsel-headless',
    ]);
  });

  it('runs the commands as npx parsel', () => {
    const help = run('npx', ['parsel', '--help']);
    for (const command of ['inspect', 'propagate', 'apply', 'check', 'sample', 'split', 'job', 'batch', 'worker'])
      expect(help).toContain(`\n  parsel ${command} `);
    run('npx', ['parsel', 'gallery', '.']);
    expect(run('npx', ['parsel', 'inspect', 'chair.glb', '--words'])).toContain('seat');
    writeFileSync(join(project, 'jobs.jsonl'), '{"id":"a","model":"chair.glb"}\n{"id":"b","model":"desk.glb"}\n');
    run('npx', ['parsel', 'batch', 'jobs.jsonl', '-o', 'out']);
    expect(readFileSync(join(project, 'out/results.jsonl'), 'utf8').split('\n').length).toBe(3);
  });

  it('says what to install for a queue', () => {
    const { status, stderr } = spawnSync('npx', ['parsel', 'worker', 'redis://127.0.0.1:1'], {
      cwd: project,
      encoding: 'utf8',
    });
    expect(status).toBe(1);
    expect(stderr).toMatch(/packages of the queue are not there .*npm install bullmq ioredis/);
  });

  it.skipIf(!existsSync(native))('has the help, the files and the refusals of the native command line', () => {
    const folder = join(project, 'native');
    const both = (...args: string[]) =>
      [native, join(installed, 'dist/parsel.js')].map((tool, i) => {
        const { status, stdout, stderr } = spawnSync(tool, args, { cwd: i === 0 ? folder : project, encoding: 'utf8' });
        return { status, stdout, stderr };
      });
    execFileSync('mkdir', [folder]);
    const [ours, theirs] = both('--help');
    expect(theirs?.stdout.startsWith(ours?.stdout ?? '?')).toBe(true);
    for (const args of [
      ['gallery', '.'],
      ['inspect', 'chair.glb'],
      ['inspect', 'absent.glb'],
      ['apply'],
      ['nothing'],
    ]) {
      const [one, other] = both(...args);
      expect(other, args.join(' ')).toEqual(one);
    }
    for (const file of readdirSync(folder)) {
      expect(readFileSync(join(folder, file)).equals(readFileSync(join(project, file))), file).toBe(true);
    }
  });
});
