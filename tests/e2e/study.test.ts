// The page of a preference study (tests/eval/study): both animations are shown, a person answers by button and by key, on
// a phone too, goes back, comes again later, and saves answers that score.mjs reads.
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import type { Browser, BrowserContextOptions } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { png } from '../eval/draw.mjs';
import { score } from '../eval/study/score.mjs';
import { launch } from './harness';

const frames = 3;
const side = 40;
let folder: string;
let browser: Browser;

/** An animation of plain frames, each of another grey. */
const film = (start: number) =>
  png(
    Uint8Array.from(
      { length: frames * side * side * 3 },
      (_, i) => start + 30 * Math.floor((i % (frames * side * 3)) / (side * 3)),
    ),
    frames * side,
    side,
  );

beforeAll(async () => {
  browser = await launch();
  folder = mkdtempSync(join(tmpdir(), 'parsel-study-'));
  mkdirSync(join(folder, 'frames'));
  for (const [part, name] of [
    ['page.html', 'index.html'],
    ['page.js', 'page.js'],
  ] as const)
    copyFileSync(fileURLToPath(new URL(`../eval/study/${part}`, import.meta.url)), join(folder, name));
  for (const [i, name] of ['one', 'other'].entries())
    writeFileSync(join(folder, 'frames', `${name}.png`), film(40 + 90 * i));
  const sides = [
    ['one', 'other'],
    ['other', 'one'],
    ['one', 'other'],
  ];
  const questions = sides.map(([left, right], i) => ({
    id: `q${i + 1}`,
    request: `Make it wider, please, for the ${i + 1}. time`,
    left: `frames/${left}.png`,
    right: `frames/${right}.png`,
  }));
  const data = JSON.stringify({ study: 'test', frames, questions });
  writeFileSync(join(folder, 'questions.js'), `globalThis.parselStudy = ${data};\n`);
});
afterAll(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

async function open(options: BrowserContextOptions = {}) {
  const page = await (await browser.newContext({ reducedMotion: 'reduce', ...options })).newPage();
  const errors: string[] = [];
  page.on('pageerror', (error) => errors.push(error.message));
  await page.goto(pathToFileURL(join(folder, 'index.html')).href);
  return { page, errors };
}

test('a person answers, goes back, and saves what score.mjs reads', async () => {
  const { page, errors } = await open();
  expect(await page.locator('#request').textContent()).toBe('1 of 3: “Make it wider, please, for the 1. time”');
  // Nothing moves by itself where less motion is wished; the slider shows the other frames of both sides.
  const position = () => page.locator('#left').evaluate((film) => getComputedStyle(film).backgroundPositionX);
  expect(await position()).toBe('0%');
  await page.getByLabel('How far the edit goes').fill('2');
  expect(await position()).toBe('100%');

  await page.getByRole('button', { name: 'Left' }).click();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Backspace');
  expect(await page.locator('#request').textContent()).toMatch(/^2 of 3/);
  expect(await page.getByRole('button', { name: 'Right' }).getAttribute('aria-pressed')).toBe('true');
  await page.keyboard.press('ArrowRight');
  await page.reload();
  expect(await page.locator('#request').textContent()).toMatch(/^3 of 3/);
  await page.keyboard.press('ArrowDown');

  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save the answers' }).click();
  const saved = JSON.parse(readFileSync(await (await download).path(), 'utf8'));
  expect(saved).toEqual({
    format: 'parsel/study',
    version: 1,
    study: 'test',
    by: 'a person',
    answers: { q1: 'left', q2: 'right', q3: 'same' },
  });
  const key = [
    { id: 'q1', index: 0, left: 'a' as const },
    { id: 'q2', index: 0, left: 'b' as const },
    { id: 'q3', index: 1, left: 'a' as const },
  ];
  expect(score({ key, alike: [] }, saved.answers)).toMatchObject({ a: 1, b: 0, ties: 1, agreement: 1 });
  expect(errors).toEqual([]);
});

test('it plays by itself, and both sides fit on a phone in the dark', async () => {
  const { page, errors } = await open({
    reducedMotion: 'no-preference',
    viewport: { width: 360, height: 700 },
    colorScheme: 'dark',
  });
  const seen = await page.locator('#right').evaluate(async (film, count) => {
    const places = new Set<string>();
    while (places.size < count) {
      await new Promise(requestAnimationFrame);
      places.add(getComputedStyle(film).backgroundPositionX);
    }
    return [...places];
  }, frames);
  expect(new Set(seen)).toEqual(new Set(['0%', '50%', '100%']));
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(360);
  for (const name of ['Left', 'No difference', 'Right']) {
    const box = await page.getByRole('button', { name }).boundingBox();
    expect(box?.height).toBeGreaterThanOrEqual(44);
    expect((box?.y ?? 0) + (box?.height ?? 0)).toBeLessThanOrEqual(700);
  }
  await page.getByRole('button', { name: 'Stop' }).click();
  expect(await page.getByRole('button', { name: 'Play' }).getAttribute('aria-pressed')).toBe('false');
  expect(errors).toEqual([]);
});
