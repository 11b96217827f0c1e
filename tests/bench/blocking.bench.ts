// How long the page's main thread is blocked while a person works on a model of 1,000 parts, and at the first click in one of
// 257,000 triangles: of everything that they do, the longest task, how many are over 50 ms, and all of them together.
// Processor time of the thread, from the browser's trace, so that a busy machine disturbs it less; `longest_wall_ms` is what
// the longest one took by the clock. What is done several times gives the median. Needs web/dist.
//
//   npm --prefix web run bench:page -- ../tests/bench/blocking.bench.ts
//
// Prints CSV `benchmark,case,metric,value`; nothing is asserted.
import type { CDPSession, Page } from 'playwright-core';
import { it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { openModel, useSite } from '../e2e/harness';
import { wall } from '../e2e/wall';
import { ballsOf } from './large_models.mjs';

declare const parsel: DebugHandle;

const site = useSite();
const print = (name: string, metric: string, value: number) =>
  process.stdout.write(`blocking,${name},${metric},${value.toFixed(0)}\n`);

interface TraceEvent {
  readonly name: string;
  readonly ph: string;
  readonly pid: number;
  readonly tid: number;
  /** Microseconds: by the clock, and of the processor. */
  readonly dur?: number;
  readonly tdur?: number;
  readonly args?: { readonly name?: string };
}

/** However busy the machine is, what is measured is the thread's own time. */
const patience = 300_000; // milliseconds
const pause = (milliseconds: number) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** Tasks of the page's main thread until all that was done is drawn, in milliseconds. */
async function tasksOf(page: Page, session: CDPSession, act: () => Promise<unknown>) {
  const events: TraceEvent[] = [];
  const collect = ({ value }: { value: object[] }) => events.push(...(value as TraceEvent[]));
  session.on('Tracing.dataCollected', collect);
  await session.send('Tracing.start', {
    transferMode: 'ReportEvents',
    traceConfig: { includedCategories: ['toplevel'] },
  });
  await pause(100);
  await act();
  await pause(100);
  await page.waitForFunction(() => parsel.stage()?.isStill(), undefined, { timeout: patience });
  await pause(300);
  const complete = new Promise((resolve) => session.once('Tracing.tracingComplete', resolve));
  await session.send('Tracing.end');
  await complete;
  session.off('Tracing.dataCollected', collect);
  const threadOf = ({ pid, tid }: TraceEvent) => `${pid}/${tid}`;
  const main = new Set(events.filter(({ args }) => args?.name === 'CrRendererMain').map(threadOf));
  return events
    .filter((event) => event.ph === 'X' && event.name.endsWith('RunTask') && main.has(threadOf(event)))
    .map(({ tdur = 0, dur = 0 }) => ({ own: tdur / 1000, wall: dur / 1000 }));
}

const median = (values: readonly number[]) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)] ?? 0;

async function open(model: Buffer, name: string) {
  const { page } = await openModel(site.browser, site.url, model, { name, viewport: { width: 1000, height: 820 } });
  page.context().setDefaultTimeout(patience);
  await page.waitForFunction(() => parsel.stage()?.isStill(), undefined, { timeout: patience });
  const session = await page.context().newCDPSession(page);
  const measure = async (
    what: string,
    act: (time: number) => Promise<unknown>,
    times = 1,
    before: (time: number) => Promise<unknown> = async () => {},
  ) => {
    const runs: { own: number; wall: number; over: number; all: number }[] = [];
    for (let time = 0; time < times; time++) {
      await before(time);
      const tasks = await tasksOf(page, session, () => act(time));
      const longest = tasks.reduce((a, b) => (b.own > a.own ? b : a), { own: 0, wall: 0 });
      const all = tasks.reduce((sum, { own }) => sum + own, 0);
      runs.push({ ...longest, over: tasks.filter(({ own }) => own > 50).length, all });
    }
    print(what, 'longest_ms', median(runs.map(({ own }) => own)));
    print(what, 'longest_wall_ms', median(runs.map(({ wall }) => wall)));
    print(what, 'over_50_ms', median(runs.map(({ over }) => over)));
    print(what, 'all_ms', median(runs.map(({ all }) => all)));
  };
  const middle = await page.evaluate(() => parsel.stage()?.projectMean([0, 0, 0]) ?? { x: 0, y: 0 });
  return { page, measure, ...middle };
}

it('257,000 triangles', async () => {
  const { page, measure, x, y } = await open(ballsOf(1, 254), 'ball.glb');
  await measure('first click among 257k triangles', async () => {
    await page.mouse.click(x, y);
    await page.waitForFunction(() => parsel.selected().length > 0);
  });
  await page.context().close();
}, 1_800_000);

it('1,000 parts', async () => {
  const { page, measure, x, y } = await open(wall(25, 40), 'wall.glb');
  const row = (i: number) => page.locator('.part .name').nth(i);
  await measure('select in the list', () => row(2).dispatchEvent('click'));
  await measure('select another', (time) => row(4 + time).dispatchEvent('click'), 9);
  await measure(
    'Shift+click in the list',
    (time) => row(14 + time).dispatchEvent('click', { shiftKey: true }),
    3,
    (time) => row(1 + time).dispatchEvent('click'),
  );
  await measure('scroll the list', async () => {
    const list = await page.locator('.part').first().boundingBox();
    await page.mouse.move((list?.x ?? 0) + 20, (list?.y ?? 0) + 10);
    for (let i = 0; i < 8; i++) await page.mouse.wheel(0, 900);
  });
  await measure('hover over the view', async () => {
    for (let i = 0; i < 5; i++) await page.mouse.move(x + 10 * i, y);
  });
  await measure('click in the view', () => page.mouse.click(x, y));
  await measure('turn the view', async () => {
    await page.mouse.move(x, y + 60);
    await page.mouse.down();
    await page.mouse.move(x + 80, y + 60, { steps: 8 });
    await page.mouse.up();
  });
  await measure('search in the list', async () => {
    await page.getByLabel('Find a part').pressSequentially('drawer 77');
  });
  await measure('clear the search', () => page.getByLabel('Find a part').fill(''));
  await measure('select all', async () => {
    await page.mouse.click(8, 8);
    await page.keyboard.press('Control+a');
  });
  await measure('let go of all', () => page.keyboard.press('Escape'));
  await measure(
    'hide one',
    () => page.keyboard.press('h'),
    9,
    (time) => row(3 + time).dispatchEvent('click'),
  );
  await measure('show it', () => page.keyboard.press('Alt+h'));
  await measure('show one alone', async () => {
    await row(3).dispatchEvent('click');
    await page.keyboard.press('i');
  });
  await measure('undo', () => page.keyboard.press('Control+z'));
  await measure('parts apart', async () => {
    await page.keyboard.press('e');
    await page.waitForTimeout(800);
  });
  await measure('parts together', async () => {
    await page.keyboard.press('e');
    await page.waitForTimeout(800);
  });
  await measure('type a request', async () => {
    await page.getByLabel('What to change').pressSequentially('raise drawer');
  });
  await page.context().close();
}, 1_800_000);
