// The page in German: chosen by the browser or in the page, in all that is read and read out, in light and on a phone.
import type { BrowserContextOptions, Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { serious } from './axe';
import { stool } from './fixture';
import { openModel, openPage, outputFolder, useSite, withoutGallery } from './harness';

declare const parsel: DebugHandle;

const site = useSite();
const german = { locale: 'de-DE' } satisfies BrowserContextOptions;
const phone = { ...german, viewport: { width: 390, height: 844 }, hasTouch: true } satisfies BrowserContextOptions;

const field = (page: Page) => page.getByLabel('Was sich ändern soll');
const shot = (page: Page, name: string) => page.screenshot({ path: `${outputFolder}/german-${name}.png` });

/** Words that do not fit into what holds them, or reach out of their panel: what German, which is longer, would cut off. */
const cutOff = (page: Page) =>
  page.evaluate(() =>
    [...document.querySelectorAll<HTMLElement>('button, h2, h3, summary, label > span, legend')]
      .filter((element) => {
        const { right, width } = element.getBoundingClientRect();
        if (width === 0 || element.closest('.tries') !== null) return false; // the requests to try scroll sideways
        const panel = element.closest('.panel')?.getBoundingClientRect().right ?? innerWidth;
        // What ends in an ellipsis has its whole text in a title.
        const overflows = element.scrollWidth > element.clientWidth + 1 && element.title === '';
        return right > Math.min(panel, innerWidth) + 1 || (overflows && getComputedStyle(element).display !== 'inline');
      })
      .map((element) => element.textContent?.trim().slice(0, 60)),
  );

describe('German', () => {
  it.each([
    ['light', german],
    ['phone', phone],
  ])('%s: the first screen, a slider, the settings', async (name, options) => {
    const first = await openPage(site.browser, site.url, options, withoutGallery);
    await first.page.getByRole('heading', { name: /^Modell öffnen, sagen, was sich ändern soll/ }).waitFor();
    expect(await first.page.evaluate(() => document.documentElement.lang)).toBe('de');
    expect(await serious(first.page)).toEqual([]);
    expect(await cutOff(first.page)).toEqual([]);
    await shot(first.page, `first-${name}`);
    expect(first.complaints).toEqual([]);
    await first.page.context().close();

    const { page, complaints } = await openPage(site.browser, `${site.url}?debug`, options);
    await page.waitForFunction(() => parsel.stage()?.isShown());
    await page.locator('.try, .suggestions button').first().waitFor();
    await shot(page, `open-${name}`);
    await page.locator('.try').first().click();
    await page.getByText('Verstanden:').waitFor();
    const slider = page.getByRole('slider', { name: /: Betrag$/ }).last();
    await slider.waitFor();
    await slider.fill('0.1');
    expect(await page.locator('.card').first().textContent()).toMatch(/erhält (alle )?\d+.*an jeder Stelle/);
    expect(await serious(page)).toEqual([]);
    expect(await cutOff(page)).toEqual([]);
    await shot(page, `slider-${name}`);

    await page.getByRole('button', { name: /^Sprachmodell:/ }).click();
    const dialog = page.getByRole('dialog', { name: 'Sprachmodell' });
    await dialog.getByLabel('Anbieter').selectOption('openai');
    await dialog.getByLabel('Sprache dieser Seite').waitFor();
    expect(await serious(page)).toEqual([]);
    expect(await cutOff(page)).toEqual([]);
    await shot(page, `settings-${name}`);
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('writes numbers as German does, and reads them', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool);
    await page.getByRole('button', { name: 'View and help' }).click();
    await page.getByRole('menuitem', { name: 'Deutsch' }).click();
    await page.locator('.dimensions select').selectOption('m');
    const width = page.getByLabel('Breite, Länge eingeben');
    await expect.poll(() => width.inputValue()).toBe('0,5');
    await field(page).fill('make the seat 3 cm wider');
    await field(page).press('Enter');
    await page.getByText('Ohne Sprachmodell gelesen').waitFor();
    await expect.poll(() => width.inputValue()).toBe('0,53');
    await width.fill('0,6');
    await width.press('Enter');
    await expect.poll(() => width.inputValue()).toBe('0,6');
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('is chosen in the page, at once and for the next visit', async () => {
    const { page, complaints } = await openPage(site.browser, site.url, { locale: 'fr-FR' }, withoutGallery);
    await page.getByRole('button', { name: 'View and help' }).click();
    await page.getByRole('menuitem', { name: 'Deutsch' }).click();
    await page.getByRole('button', { name: 'Ansicht und Hilfe' }).waitFor();
    expect(await page.evaluate(() => document.documentElement.lang)).toBe('de');
    await page.reload();
    await page.getByRole('button', { name: 'Ansicht und Hilfe' }).click();
    await page.getByRole('menuitem', { name: 'English' }).click();
    await page.getByRole('button', { name: 'View and help' }).waitFor();
    expect(await page.evaluate(() => document.documentElement.lang)).toBe('en');
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('stays away where its words cannot be fetched: the page is in English, and says why', async () => {
    const { page } = await openPage(site.browser, site.url, german, async (context) => {
      await withoutGallery(context);
      await context.route('**/assets/de-*.js', (route) => route.abort());
    });
    await page.getByText(/The words for Deutsch could not be fetched/).waitFor();
    await page.getByRole('button', { name: 'View and help' }).waitFor();
    expect(await page.evaluate(() => document.documentElement.lang)).toBe('en');
    await page.context().close();
  });
});
