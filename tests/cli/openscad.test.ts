// What a family is exported as runs in OpenSCAD itself: with the parameter set of a variation it renders the volume that
// the variation's own numbers, written by hand, say. Parts of these programs touch and do not overlap.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';

const tool = fileURLToPath(new URL('../../build/native-debug/core/parsel', import.meta.url));
const programs = fileURLToPath(new URL('../../core/gallery/programs', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'parsel-openscad-'));
afterAll(() => rmSync(folder, { recursive: true }));

const version = spawnSync('openscad', ['--version'], { encoding: 'utf8' });
const hasOpenScad = version.error === undefined;
const title = `a family in OpenSCAD${hasOpenScad ? '' : ' (skipped: it is not installed; apt-get install openscad)'}`;

interface Variation {
  readonly name: string;
  readonly bounds: Readonly<Record<string, readonly (readonly [number, number])[]>>;
  readonly absent?: readonly string[];
}
const variations: readonly Variation[] = JSON.parse(
  readFileSync(join(programs, 'chair.variations.json'), 'utf8'),
).variations;

/** mm³ of boxes that do not overlap. */
const volumeOf = ({ bounds }: Variation) =>
  Object.values(bounds).reduce((sum, box) => sum + box.reduce((product, [a, b]) => product * (b - a), 1), 0);

/** Of a closed mesh as ASCII STL: the signed tetrahedra between its triangles and the origin. */
function volumeIn(stl: string): number {
  const corners = [...stl.matchAll(/vertex (\S+) (\S+) (\S+)/g)].map(([, x, y, z]) => [x, y, z].map(Number));
  let six = 0;
  for (let i = 0; i < corners.length; i += 3) {
    const [a, b, c] = corners.slice(i, i + 3) as [number[], number[], number[]];
    const [ax, ay, az] = a as [number, number, number];
    const [bx, by, bz] = b as [number, number, number];
    const [cx, cy, cz] = c as [number, number, number];
    six += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  }
  return six / 6;
}

function run(command: string, ...given: string[]): void {
  const { status, stderr } = spawnSync(command, given, { cwd: folder, encoding: 'utf8', maxBuffer: 1 << 28 });
  expect(status, `${command} ${given.join(' ')}\n${stderr}`).toBe(0);
}

describe.skipIf(!hasOpenScad)(title, () => {
  beforeAll(() => {
    const given = [join(programs, 'chair.scad'), '--variations', join(programs, 'chair.variations.json')];
    run(
      tool,
      'family',
      ...given,
      '--vocabulary',
      'extended',
      '--scad',
      'chair.scad',
      '--sets',
      'chair.json',
      '-o',
      'f.json',
    );
  });

  it.each(['dining chair', 'bar stool', 'easy chair'])('chair as a %s', (name) => {
    const variation = variations.find((one) => one.name === name) as Variation;
    run('openscad', '-o', 'out.stl', '--export-format', 'asciistl', '-p', 'chair.json', '-P', name, 'chair.scad');
    const volume = volumeIn(readFileSync(join(folder, 'out.stl'), 'utf8'));
    expect(Math.abs(volume / volumeOf(variation) - 1)).toBeLessThan(1e-3);
  });

  it('the program itself, and what OpenSCAD makes of it (.csg) read back to the same parts', () => {
    run('openscad', '-o', 'chair.csg', 'chair.scad');
    run(tool, 'cad', 'chair.csg', '-o', 'csg.json');
    run(tool, 'cad', join(programs, 'chair.scad'), '-o', 'own.json');
    const boxes = (file: string) =>
      (JSON.parse(readFileSync(join(folder, file), 'utf8')).parts as { centre: number[]; size: number[] }[])
        .map(({ centre, size }) => [...centre, ...size].map((value) => value.toFixed(6)).join(' '))
        .sort();
    expect(boxes('csg.json')).toEqual(boxes('own.json'));
  });
});
