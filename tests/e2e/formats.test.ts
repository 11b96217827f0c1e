// Files of other formats in the built page: dropped with what belongs to them, edited as a GLB is, and opened again.
import { readFile } from 'node:fs/promises';
import { unzipSync, zipSync } from 'fflate';
import type { Page } from 'playwright-core';
import { beforeEach, describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { download, drop, openPage, pick, saved, useSite, withoutGallery } from './harness';

declare const parsel: DebugHandle;

const site = useSite();

let page: Page;
let complaints: string[];

/** A picture of one red pixel. */
const redPng = Buffer.from(
  'iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8DwHwAFBQIAX8jx0gAAAABJRU5ErkJggg==',
  'base64',
);

/** A box as an object of an OBJ, with a picture on its faces. */
function box(name: string, first: number, [x, y, z]: readonly number[], [w, h, d]: readonly number[]): string {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => {
    const at = [i & 1, (i >> 1) & 1, i >> 2] as const;
    return `v ${(x ?? 0) + at[0] * (w ?? 1)} ${(y ?? 0) + at[1] * (h ?? 1)} ${(z ?? 0) + at[2] * (d ?? 1)}`;
  });
  const faces = ['1 3 4 2', '5 6 8 7', '1 2 6 5', '3 7 8 4', '1 5 7 3', '2 4 8 6'].map(
    (face) =>
      `f ${face
        .split(' ')
        .map((corner) => `${first + Number(corner) - 1}/1`)
        .join(' ')}`,
  );
  return [`o ${name}`, 'usemtl wood', ...corners, ...faces].join('\n');
}

const table = {
  'table.obj': Buffer.from(
    `mtllib table.mtl\nvt 0.5 0.5\n${box('top', 1, [-0.5, 0.7, -0.5], [1, 0.1, 1])}\n${box('leg', 9, [-0.05, 0, -0.05], [0.1, 0.7, 0.1])}\n`,
  ),
  'table.mtl': Buffer.from('newmtl wood\nKd 1 1 1\nmap_Kd textures/wood.png\n'),
  'wood.png': redPng,
};

const facet = (corners: readonly string[]) =>
  `facet normal 0 0 1\nouter loop\n${corners.map((corner) => `vertex ${corner}`).join('\n')}\nendloop\nendfacet`;
const pyramid = (name: string, x: number) => {
  const [a, b, c, d] = [`${x} 0 0`, `${x + 50} 0 0`, `${x} 50 0`, `${x} 0 50`] as const;
  const faces = [
    [a, c, b],
    [a, b, d],
    [b, c, d],
    [a, d, c],
  ] as const;
  return `solid ${name}\n${faces.map(facet).join('\n')}\nendsolid ${name}\n`;
};
const pyramids = Buffer.from(pyramid('near', 0) + pyramid('far', 200));

const file = (name: string, buffer: Buffer) => ({ name, mimeType: 'application/octet-stream', buffer });
const labels = () => page.evaluate(() => parsel.document().model?.shape.parts.map(({ label }) => label) ?? []);
const hash = () => page.evaluate(() => parsel.document().model?.shape.sha256);
const shown = async () => {
  await page.locator('.part').first().waitFor();
  await page.waitForFunction(() => parsel.stage()?.isShown());
};
const ready = () => page.waitForFunction(() => 'parsel' in globalThis && parsel.isReady());

describe('a file of another format', () => {
  beforeEach(async () => {
    await page?.context().close();
    ({ page, complaints } = await openPage(site.browser, `${site.url}?debug`, {}, withoutGallery));
    await ready();
  });

  it('OBJ: dropped with its materials and picture, exported as GLB with the picture as it was', async () => {
    await drop(page, table);
    await shown();
    expect(await labels()).toEqual(['top', 'leg']);
    expect(await page.evaluate(() => parsel.document().model?.files.name)).toBe('table');
    await expect
      .poll(() => page.locator('.status-line').getByRole('status').textContent())
      .toBe('The file was made a GLB; it can be exported as one, or as OBJ again.');
    const written = await readFile(await download(page, 'Edited model'));
    expect(written.subarray(0, 4).toString()).toBe('glTF');
    expect(written.includes(redPng)).toBe(true);

    const path = await download(page, 'Edited as OBJ');
    expect(path).toMatch(/table-edited\.zip$/);
    const again = unzipSync(await readFile(path));
    expect(Object.keys(again)).toEqual(['table-edited.obj', 'table-edited.mtl', 'table-edited_1.png']);
    expect(Buffer.from(again['table-edited_1.png'] ?? []).equals(redPng)).toBe(true);
    await pick(page, [file('table-edited.zip', await readFile(path))]);
    await page.waitForFunction(() => parsel.document().model?.files.name === 'table-edited');
    expect(await labels()).toEqual(['top', 'leg']);
    expect(complaints).toEqual([]);
  });

  it('OBJ without its picture: opens, and says what is missing', async () => {
    await drop(page, { 'table.obj': table['table.obj'], 'table.mtl': table['table.mtl'] });
    await shown();
    await expect
      .poll(() => page.locator('.status-line').getByRole('status').textContent())
      .toMatch(/Not among the files: textures\/wood\.png; drop them together with the model\./);
    expect(complaints).toEqual([]);
  });

  it('STL: a part a solid, the same model when it is opened again, kept over a reload', async () => {
    await drop(page, { 'two.stl': pyramids });
    await shown();
    expect(await labels()).toEqual(['near', 'far']);
    expect(await page.locator('.part').count()).toBe(2);
    const first = await hash();
    const again = await readFile(await download(page, 'Edited as STL'));
    expect(again.toString().match(/^solid .*$/gm)).toEqual(['solid near', 'solid far']);
    const cornersIn = (text: string) => [...text.matchAll(/vertex (.*)/g)].map(([, corner]) => corner);
    expect(cornersIn(again.toString())).toEqual(cornersIn(pyramids.toString()));
    const work = await readFile(await download(page, 'Session'));
    await saved(page);
    await page.reload();
    await ready();
    await shown();
    expect(await hash()).toBe(first);
    expect(complaints).toEqual([]);

    await page.context().close(); // another browser, which has nothing but the file and the work on it
    ({ page, complaints } = await openPage(site.browser, `${site.url}?debug`, {}, withoutGallery));
    await ready();
    await drop(page, { 'two.parsel.json': work, 'two.stl': pyramids });
    await shown();
    expect(await hash()).toBe(first);
    await pick(page, [file('two.parsel.json', work), file('two.stl', Buffer.from(pyramid('near', 0)))]);
    await expect
      .poll(() => page.getByRole('alert').textContent())
      .toMatch(/is not the file that this work was made on/);
    expect(complaints).toEqual([]);
  });

  it('3MF, which is a zip, and PLY by the picker', async () => {
    const corners = [
      [0, 0, 0],
      [50, 0, 0],
      [0, 50, 0],
      [0, 0, 50],
    ].map(([x, y, z]) => `<vertex x="${x}" y="${y}" z="${z}"/>`);
    const faces = [
      [0, 2, 1],
      [0, 1, 3],
      [1, 2, 3],
      [0, 3, 2],
    ];
    const mesh = `<mesh><vertices>${corners.join('')}</vertices><triangles>${faces
      .map(([a, b, c]) => `<triangle v1="${a}" v2="${b}" v3="${c}"/>`)
      .join('')}</triangles></mesh>`;
    const model = `<model unit="millimeter"><resources><object id="1" name="foot">${mesh}</object></resources><build><item objectid="1"/><item objectid="1" transform="1 0 0 0 1 0 0 0 1 200 0 0"/></build></model>`;
    await pick(page, [file('feet.3mf', Buffer.from(zipSync({ '3D/3dmodel.model': Buffer.from(model) })))]);
    await shown();
    expect(await labels()).toEqual(expect.arrayContaining(['foot', 'foot']));
    const ply = `ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n0 0 1 9 9 9\n${faces.map((face) => `3 ${face.join(' ')}`).join('\n')}\n`;
    await pick(page, [file('scan.ply', Buffer.from(ply))]);
    await expect.poll(labels).toEqual(['scan']);
    await page.waitForFunction(() => parsel.stage()?.isShown());
    expect(complaints).toEqual([]);
  });

  it('is refused in a sentence when it cannot be opened, with the work at hand untouched', async () => {
    await drop(page, { 'two.stl': pyramids });
    await shown();
    const cloud =
      'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n';
    await pick(page, [file('scan.ply', Buffer.from(cloud))]);
    await expect
      .poll(() => page.getByRole('alert').textContent())
      .toMatch(/scan\.ply is a point cloud: it has no faces/);
    expect(await labels()).toEqual(['near', 'far']);
    expect(complaints).toEqual([]);
  });

  it('can be cancelled while it is read', async () => {
    await page.route('**/convert.worker*.js', () => {}); // never answers
    await drop(page, { 'two.stl': pyramids });
    await expect
      .poll(() => page.locator('.status-line').getByRole('status').textContent())
      .toMatch(/Reading the model · reading STL/);
    await page.getByRole('button', { name: 'Cancel' }).click();
    await expect.poll(() => page.locator('.status-line').getByRole('status').textContent()).toBe('');
    expect(await labels()).toEqual([]);
    expect(complaints).toEqual([]);
  });
});
