// How long the page's main thread is blocked while a person works on a model of 1,000 parts: of everything that they do, the
// longest task and how many are over 50 ms. Processor time of the thread, from the browser's trace, so that a busy machine
// disturbs it less; `longest_wall_ms` is what the longest one took by the clock. What is done several times gives the
// median. Needs web/dist.
//
//   npm --prefix web run bench:page -- ../tests/bench/blocking.bench.ts
//
// Prints CSV `benchmark,case,metric,value`; nothing is asserted.
import type { CDPSession, Page } from 'playwright-core';
import { it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { openModel, useSite } from '../e2e/harness';
import { wall } from '../e2e/wall';

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
  await page.waitForFunction(() => parsel.stage()?.isStill(), undefined, { timeout: 120_000 });
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

it('1,000 parts', async () => {
  const { page } = await openModel(site.browser, site.url, wall(25, 40), {
    name: 'wall.glb',
    viewport: { width: 1000, height: 820 },
  });
  await page.waitForFunction(() => parsel.stage()?.isStill(), undefined, { timeout: 120_000 });
  const session = await page.context().newCDPSession(page);
  const measure = async (
    name: string,
    act: (time: number) => Promise<unknown>,
    times = 1,
    before: (time: number) => Promise<unknown> = async () => {},
  ) => {
    const runs: { own: number; wall: number; over: number }[] = [];
    for (let time = 0; time < times; time++) {
      await before(time);
      const tasks = await tasksOf(page, session, () => act(time));
      const longest = tasks.reduce((a, b) => (b.own > a.own ? b : a), { own: 0, wall: 0 });
      runs.push({ ...longest, over: tasks.filter(({ own }) => own > 50).length });
    }
    print(name, 'longest_ms', median(runs.map(({ own }) => own)));
    print(name, 'longest_wall_ms', median(runs.map(({ wall }) => wall)));
    print(name, 'over_50_ms', median(runs.map(({ over }) => over)));
  };
  const row = (i: number) => page.locator('.part .name').nth(i);
  const { x, y } = await page.evaluate(() => parsel.stage()?.projectMean([0, 0, 0]) ?? { x: 0, y: 0 });
  await measure('select in the list', () => row(2).dispatchEvent('click'));
  await measure('select another', (time) => row(4 + time).dispatchEvent('click'), 9);
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
});
