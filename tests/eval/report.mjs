// From what parsel_eval wrote to a report: report.json, report.html and pictures, drawn by the page itself.
//   node tests/eval/report.mjs RESULTS MODELS [--pictures N] [--sheets FOLDER] [--parsel TOOL]
// RESULTS: the folder of results.jsonl; the report goes there. MODELS: the folder of the GLBs. Pictures (at rest and at
// both ends of the range, parts in colours of their own) are taken of the N worst edits and of N/4 spread evenly over
// the rest (default 80). --sheets: also contact sheets of ten edits each, as PNG. --parsel: the
// command-line tool, which then writes both ends of the 20 worst edits as GLBs.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { causeOf, explain, severity } from './causes.mjs';
import { escaped, pageOf, table } from './html.mjs';

const root = fileURLToPath(new URL('../..', import.meta.url));
const [folder, models, ...options] = process.argv.slice(2);
if (models === undefined) {
  throw new Error('usage: node report.mjs RESULTS MODELS [--pictures N] [--sheets FOLDER] [--parsel TOOL]');
}
const option = (name, otherwise) => {
  const at = options.indexOf(name);
  return at < 0 ? otherwise : options[at + 1];
};
const pictureCount = Number(option('--pictures', 80));
const sheetFolder = option('--sheets', null);
const tool = option('--parsel', null);

const lines = readFileSync(join(folder, 'results.jsonl'), 'utf8').trim().split('\n');
const records = lines.map((line) => JSON.parse(line));
const shapes = records.filter(({ kind }) => kind === 'model');
const edits = records
  .filter(({ kind }) => kind === 'edit')
  .map((edit) => ({ ...edit, severity: severity(edit), cause: causeOf(edit) }))
  .sort((a, b) => b.severity - a.severity);

// ------------------------------------------------------------------------------------------------------------ numbers

const sum = (list, value) => list.reduce((total, item) => total + value(item), 0);
const quantile = (values, q) => {
  const sorted = values.toSorted((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(q * sorted.length))] ?? 0;
};
const groupBy = (list, key) => {
  const groups = new Map();
  for (const item of list) groups.set(key(item), [...(groups.get(key(item)) ?? []), item]);
  return groups;
};
const collectionOf = ({ model }) =>
  model.includes('_') && shapes.length > 40 ? model.split('_')[0] : basename(models);
const seedOf = ({ edit }) => edit.replace(/_2$/, '');

function totals(list) {
  const done = list.filter(({ held }) => held !== undefined);
  const relations = sum(done, (edit) => edit.relations);
  const times = done.map(({ ms }) => ms.propagate);
  return {
    edits: list.length,
    failures: list.filter(({ failure }) => failure).length,
    clean: list.filter(({ cause }) => cause === 'clean').length,
    relations,
    held: sum(done, (edit) => edit.held),
    certified: sum(done, (edit) => edit.certified),
    edits_with_breaks: done.filter(({ broken }) => broken > 0).length,
    breaking_edits: sum(done, ({ why }) => why.breaking ?? 0),
    keep_fixed: sum(done, ({ why }) => why.keep_fixed ?? 0),
    propagate_ms: { median: quantile(times, 0.5), p95: quantile(times, 0.95), worst: Math.max(0, ...times) },
  };
}

const byCause = [...groupBy(edits, ({ cause }) => cause)].sort((a, b) => b[1].length - a[1].length);
const report = {
  models: shapes.length,
  models_failed: shapes.filter(({ failure }) => failure).map(({ model, failure }) => ({ model, ...failure })),
  parts: sum(shapes, ({ parts }) => parts ?? 0),
  relations: sum(shapes, ({ relations }) => relations ?? 0),
  abstraction_ms: stageTimes(shapes, 'abstraction'),
  stages_ms: Object.fromEntries(['propagate', 'check', 'measure', 'apply'].map((s) => [s, stageTimes(edits, s)])),
  peak_mb: Math.max(0, ...records.map(({ peak_mb }) => peak_mb ?? 0)),
  all: totals(edits),
  collections: Object.fromEntries([...groupBy(edits, collectionOf)].map(([name, list]) => [name, totals(list)])),
  seeds: Object.fromEntries([...groupBy(edits, seedOf)].map(([name, list]) => [name, totals(list)])),
  causes: byCause.map(([cause, list]) => ({
    cause,
    edits: list.length,
    models: new Set(list.map(({ model }) => model)).size,
    worst: list.slice(0, 8).map(({ model, edit }) => `${model}/${edit}`),
  })),
};

function stageTimes(list, stage) {
  const times = list.map(({ ms }) => ms?.[stage]).filter((time) => time !== undefined);
  return { median: quantile(times, 0.5), p95: quantile(times, 0.95), worst: Math.max(0, ...times) };
}

// ----------------------------------------------------------------------------------------------------------- pictures

/** TypeScript of the browser tests, as it is there: the server and the browser that they use. */
async function loadHarness() {
  const { runnerImport } = await import(pathToFileURL(createRequire(join(root, 'web/package.json')).resolve('vite')));
  const harness = join(root, 'tests/e2e/harness.ts');
  return (await runnerImport(harness, { root: join(root, 'web'), configFile: false, logLevel: 'error' })).module;
}

/** Milliseconds that any step in the browser may take: software rendering on a busy machine is slow. */
const patience = 120_000;

/** Draws edits on the page; answers nothing, edits get `pictures`: names of files, at rest, at the minimum, the maximum. */
async function draw(list) {
  const { serve, launch, openPage, withoutGallery, pick } = await loadHarness();
  const { url, server } = await serve();
  const browser = await launch();
  mkdirSync(join(folder, 'pictures'), { recursive: true });
  try {
    const view = { viewport: { width: 1000, height: 760 }, deviceScaleFactor: 0.5, reducedMotion: 'reduce' };
    let page = null;
    let open = null;
    const byModel = list.toSorted((a, b) => a.model.localeCompare(b.model)); // opening one takes longest
    for (const [i, edit] of byModel.entries()) {
      process.stderr.write(`\rpicture ${i + 1} of ${list.length}\x1b[K`);
      try {
        page ??= (await openPage(browser, `${url}?debug`, view, withoutGallery)).page;
        page.setDefaultTimeout(patience);
        if (open !== edit.model) {
          const buffer = readFileSync(join(models, `${edit.model}.glb`));
          open = null;
          await pick(page, [{ name: `${edit.model}.glb`, mimeType: 'model/gltf-binary', buffer }]);
          await page.waitForFunction((name) => parsel.document().model?.shape.name === name, edit.model);
          await page.waitForFunction(() => parsel.stage()?.isShown() && parsel.stage().isStill());
          await colourParts(page);
          open = edit.model;
        }
        const program = JSON.parse(readFileSync(join(folder, 'programs', edit.model, `${edit.edit}.json`), 'utf8'));
        const images = await page.evaluate(takePictures, program);
        edit.pictures = images.map((image, k) => {
          const name = `pictures/${edit.model}_${edit.edit}_${['rest', 'min', 'max'][k]}.png`;
          writeFileSync(join(folder, name), Buffer.from(image.split(',')[1], 'base64'));
          return name;
        });
        await page.keyboard.press('Control+z');
        await page.waitForFunction(() => parsel.document().layers.length === 0);
      } catch (error) {
        edit.no_picture = error.message.split('\n')[0];
        await page?.context().close();
        page = open = null;
      }
    }
    process.stderr.write('\n');
    if (sheetFolder !== null) await writeSheets(browser, list);
  } finally {
    await browser.close();
    server.close();
  }
}

/** Parts in colours of their own: many models have none. The page keeps it until it is closed. */
async function colourParts(page) {
  await page.getByRole('button', { name: 'View and help' }).click();
  const item = page.getByRole('menuitem', { name: 'Colour the parts' });
  if ((await item.count()) > 0) await item.click();
  else await page.keyboard.press('Escape');
}

/** In the page: the model at rest, at the minimum, at the maximum, from one place. */
async function takePictures(program) {
  const stage = parsel.stage();
  const keys = parsel.addProgram(program, 'evaluation');
  if (keys === null || parsel.evaluator() === null) throw new Error('the page refuses the program');
  stage.setInsets({ left: 0, right: 0, top: 0, bottom: 0 });
  stage.fit(null, false);
  const [azimuth, polar, distance, ...target] = stage.rig.pose;
  stage.rig.pose = [azimuth, polar, distance * 1.45, ...target]; // room for what grows
  do await new Promise(requestAnimationFrame);
  while (!stage.isStill());
  const { min, max } = program.layers[0].parameter;
  const images = [];
  for (const value of [0, min, max]) {
    parsel.slide(keys[0], value);
    const blob = await stage.screenshot();
    images.push(
      await new Promise((resolve) => {
        const reader = new FileReader();
        reader.onload = () => resolve(reader.result);
        reader.readAsDataURL(blob);
      }),
    );
  }
  return images;
}

// --------------------------------------------------------------------------------------------------------------- page

const number = (value, digits = 0) => value.toLocaleString('en', { maximumFractionDigits: digits });
const percent = (part, whole) => (whole === 0 ? '–' : `${((100 * part) / whole).toFixed(1)} %`);
const totalsTable = (first, entries) =>
  table(
    [
      first,
      'edits',
      'clean',
      'failures',
      'relations held',
      'certified',
      'with breaks',
      'kept fixed',
      'median ms',
      '95 %',
      'worst',
    ],
    Object.entries(entries).map(([name, t]) => [
      name,
      t.edits,
      percent(t.clean, t.edits),
      t.failures,
      percent(t.held, t.relations),
      percent(t.certified, t.relations),
      t.edits_with_breaks,
      t.keep_fixed,
      number(t.propagate_ms.median, 1),
      number(t.propagate_ms.p95, 1),
      number(t.propagate_ms.worst, 1),
    ]),
  );

const figure = (edit, source = (name) => encodeURI(name)) => `<figure>
<figcaption><b>${escaped(edit.model)}</b> ${escaped(edit.edit)} · ${escaped(edit.cause)}<br>${escaped(explain(edit))}</figcaption>
${
  edit.pictures
    ? edit.pictures
        .map((name, i) => `<img loading="lazy" alt="${['at rest', 'minimum', 'maximum'][i]}" src="${source(name)}">`)
        .join('')
    : `<p>no picture: ${escaped(edit.no_picture ?? 'there is no program')}</p>`
}</figure>`;

async function writeSheets(browser, list) {
  mkdirSync(sheetFolder, { recursive: true });
  const page = await browser.newPage({ viewport: { width: 1500, height: 900 } });
  page.setDefaultTimeout(patience);
  const inline = (name) => `data:image/png;base64,${readFileSync(join(folder, name)).toString('base64')}`;
  for (let i = 0; i < list.length; i += 10) {
    const cells = list.slice(i, i + 10).map((edit) => figure(edit, inline));
    const grid = `<style>main{display:grid;grid-template-columns:1fr 1fr;gap:6px}figure{margin:0}figcaption{font-size:11px}body{margin:6px;max-width:none}h1{display:none}</style>`;
    await page.setContent(pageOf('sheet', `${grid}<main>${cells.join('')}</main>`));
    const name = `sheet_${String(i / 10 + 1).padStart(2, '0')}.png`;
    await page.screenshot({ path: join(sheetFolder, name), fullPage: true });
  }
  await page.close();
}

const rest = edits.slice(pictureCount);
const spread = rest.filter((_, i) => i % Math.max(1, Math.floor((4 * rest.length) / pictureCount)) === 0);
const pictured = [...edits.slice(0, pictureCount), ...spread];
if (pictureCount > 0) await draw(pictured);

if (tool !== null) {
  mkdirSync(join(folder, 'glb'), { recursive: true });
  for (const { model, edit, range } of edits.slice(0, 20)) {
    const program = join(folder, 'programs', model, `${edit}.json`);
    if (!existsSync(program)) continue; // it failed before there was one
    const { name } = JSON.parse(readFileSync(program, 'utf8')).layers[0].parameter;
    for (const [i, end] of ['min', 'max'].entries()) {
      const out = join(folder, 'glb', `${model}_${edit}_${end}.glb`);
      const set = `${name}=${range[i]}`;
      execFileSync(tool, ['apply', join(models, `${model}.glb`), program, '--set', set, '-o', out], {
        stdio: 'ignore',
      });
    }
  }
}

const { all } = report;
const summary = `<p>${number(report.models)} models (${number(report.models_failed.length)} not read), ${number(report.parts)} parts,
${number(report.relations)} relations; ${number(all.edits)} edits: ${percent(all.clean, all.edits)} clean, ${number(all.failures)} failures;
${percent(all.held, all.relations)} of ${number(all.relations)} relations that touch what moves are held, ${percent(all.certified, all.relations)} certified.
Propagation takes ${number(all.propagate_ms.median, 1)} ms (median; worst ${number(all.propagate_ms.worst, 0)} ms), abstraction ${number(report.abstraction_ms.median, 1)} ms (worst ${number(report.abstraction_ms.worst, 0)} ms), processor time. Largest process: ${number(report.peak_mb)} MB.</p>`;
writeFileSync(
  join(folder, 'report.html'),
  pageOf(
    `Evaluation: ${basename(models)}`,
    `${summary}
<h2>Causes</h2><div class="wide">${table(
      ['cause', 'edits', 'models', 'the worst'],
      report.causes.map((c) => [c.cause, c.edits, c.models, c.worst.slice(0, 4).join(', ')]),
    )}</div>
<h2>By collection</h2><div class="wide">${totalsTable('collection', report.collections)}</div>
<h2>By seed edit</h2><div class="wide">${totalsTable('seed', report.seeds)}</div>
${
  report.models_failed.length > 0
    ? `<h2>Models not read</h2>${table(
        ['model', 'stage', 'cause'],
        report.models_failed.map((m) => [m.model, m.stage, m.cause]),
      )}`
    : ''
}
<h2>The worst first</h2><p>At rest, at the minimum, at the maximum. Lengths are parts of the model's half diagonal.</p>
${edits
  .slice(0, pictureCount)
  .map((edit) => figure(edit))
  .join('')}
<h2>A sample of the others</h2>${spread.map((edit) => figure(edit)).join('')}`,
  ),
);
writeFileSync(join(folder, 'report.json'), `${JSON.stringify({ ...report, edits }, null, 1)}\n`);
process.stdout.write(
  `${join(folder, 'report.html')}: ${all.edits} edits, ${all.clean} clean, ${all.failures} failures\n`,
);
