// A report in a browser, against what its own data say should be there.
//   node page_test.mjs NODE_MODULES PAGE.html [FOLDER for screenshots]
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { inflateSync } from 'node:zlib';

const [modules, file, folder] = process.argv.slice(2);
const { chromium } = createRequire(join(resolve(modules), 'x'))('playwright-core');
const executablePath = [process.env.CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome']
  .find((path) => path && existsSync(path));
assert(executablePath, 'no chromium found: install it, or name it in CHROMIUM');
if (folder) mkdirSync(folder, { recursive: true });

const url = pathToFileURL(resolve(file)).href;
const packed = /<script[^>]*id="slipcheck-data"[^>]*>([^<]*)</.exec(readFileSync(file, 'utf8'));
assert(packed, `${file} has no data`);
const data = JSON.parse(inflateSync(Buffer.from(packed[1], 'base64')));
assert.equal(data.schema, 'slipcheck-page/2');
const moving = data.scenes.findIndex((scene) =>
  scene.motion?.runs.some((run) => run.run < 0) && scene.motion.runs.some((run) => run.run >= 0));

const browser = await chromium.launch({ executablePath,
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });

const checks = { loads, charts, filters, sorts, themes, replays, keyboard, without_script, narrow };
try {
  for (const [name, check] of Object.entries(checks)) {
    const begin = performance.now();
    await check();
    console.log(`ok   ${name} (${((performance.now() - begin) / 1000).toFixed(1)} s)`);
  }
} finally {
  await browser.close();
}

/** The page in a window of its own; nothing may go wrong on it, and nothing be asked of a network. */
async function visit(use, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, reducedMotion: 'reduce', ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(60000);
  const wrong = [];
  page.on('pageerror', (error) => wrong.push(`error: ${error.message}`));
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver Message/.test(message.text())) {
      wrong.push(`console: ${message.text()}`);
    }
  });
  page.on('request', (request) => {
    if (request.url() !== url && !/^(data|blob):/.test(request.url())) wrong.push(`request: ${request.url()}`);
  });
  const begin = performance.now();
  await page.goto(url);
  if (options.javaScriptEnabled !== false) await page.waitForSelector('html[data-ready]', { state: 'attached' });
  await use(page, begin);
  assert.deepEqual(wrong, []);
  await context.close();
}

async function loads() {
  await visit(async (page, begin) => {
    const figure = page.locator('figure.chart').first();
    await figure.scrollIntoViewIfNeeded();
    await page.waitForSelector('figure.chart[data-drawn]');
    const seconds = (performance.now() - begin) / 1000;
    console.log(`     first chart after ${seconds.toFixed(2)} s`);
    assert(seconds < 20, `the first chart took ${seconds} s`);
  });
}

async function charts() {
  let expected = (data.engines?.length ? 1 : 0) + data.precision.filter(({ charts: all }) => all.length).length + (data.stability?.maps.length ?? 0) + (data.stability?.limits.length ?? 0);
  for (const scene of data.scenes) {
    expected += scene.charts.length + (scene.motion?.runs.length ? 1 : 0);
  }
  assert(expected > 0, 'nothing to draw');
  await visit(async (page) => {
    const figures = page.locator('.plots figure.chart');
    assert.equal(await figures.count(), expected);
    for (let k = 0; k < expected; ++k) {
      const figure = figures.nth(k);
      await figure.scrollIntoViewIfNeeded();
      const title = await figure.locator('[role=img]').getAttribute('aria-label');
      await figure.locator('svg').waitFor();
      const marks = await figure.locator('svg path').count();
      assert(marks > 5, `"${title}" has ${marks} paths`);
      const text = await figure.locator('svg').innerHTML();
      assert(!/NaN|undefined|\[object/.test(text), `"${title}" draws ${/.{0,60}(NaN|undefined|\[object)/.exec(text)?.[0]}`);
    }
    if (folder) await page.screenshot({ path: join(folder, 'light-wide.png'), fullPage: true });
    // A run's points are as many as it has phases: tooltips and eyes go by them.
    const has_phases = ({ panels: [{ y }] }) => y.runs;
    const k = data.scenes.findIndex((scene) => scene.charts.some(has_phases));
    if (k < 0) return;
    const { charts: all, motion } = data.scenes[k];
    const phases = all.find(has_phases);
    const points = phases.panels[0].curves.flatMap(({ notes }) => notes ?? []).length;
    const nth = all.indexOf(phases) + (motion?.runs.length ? 1 : 0);
    const figure = page.locator(`.plots[data-scene="${k}"] figure.chart`).nth(nth);
    await figure.scrollIntoViewIfNeeded();
    await figure.locator('svg').waitFor();
    const drawn = await figure.locator('svg path').count();
    assert(drawn >= points && drawn < points + 80, `${drawn} paths for ${points} points`);
    // A point says its run, its phase and its value; a name in the legend takes its points away.
    const legend = figure.locator('svg text', { hasText: /^(outside|within the tolerance)$/ }).first();
    await legend.click();
    await page.waitForTimeout(400);
    assert(await figure.locator('svg path').count() < drawn, 'the legend hides nothing');
    await legend.click();
  });
}

async function filters() {
  const total = data.scenes.length;
  await visit(async (page) => {
    const toolbar = page.locator('#toolbar');
    const shows = async (what, passes) => {
      const expected = data.scenes.map((scene, k) => (passes(scene) ? k : -1)).filter((k) => k >= 0);
      const shown = await page.locator('section.scene[data-scene]').evaluateAll((all) =>
        all.filter((one) => one.getClientRects().length).map((one) => Number(one.dataset.scene)));
      assert.deepEqual(shown, expected, what);
      const listed = await page.locator('nav .scene[data-scene]').evaluateAll((all) => all.filter((one) => one.getClientRects().length).length);
      assert.equal(listed, expected.length, `${what}, in the list`);
      assert.equal((await toolbar.locator('[aria-live]').innerText()).trim(), `${expected.length} of ${total} scene${total === 1 ? '' : 's'}`);
    };
    assert.equal(await page.locator('fieldset.filter').count(), 0, 'the filter of the page without a script is still there');
    await shows('at first', () => true);

    const word = data.scenes[0].name.slice(0, 5).toUpperCase();
    await toolbar.locator('input[type=search]').fill(word);
    await shows(`name ${word}`, (scene) => scene.name.toUpperCase().includes(word));
    await toolbar.locator('input[type=search]').fill('no scene has this name');
    await shows('no name', () => false);
    await toolbar.locator('button.show-all').click();
    await shows('after a reset', () => true);

    const boxes = await toolbar.locator('input[type=checkbox]').all();
    for (const box of boxes) {
      const verdict = await box.inputValue();
      await box.uncheck();
      await shows(`without ${verdict}`, (scene) => scene.runs.some((run) => run.verdict !== verdict));
      const hidden = await page.locator(`.run[data-verdict="${verdict}"]`).evaluateAll((all) => all.every((one) => !one.getClientRects().length));
      assert(hidden, `runs ${verdict} are shown`);
      await box.check();
    }
    for (const select of await toolbar.locator('select').all()) {
      const field = (await select.evaluate((one) => one.parentElement.firstChild.textContent)).trim().toLowerCase();
      const value = await select.locator('option').nth(1).getAttribute('value');
      await select.selectOption(value);
      await shows(`${field} ${value}`, (scene) => scene.runs.some((run) => String(run[field]) === value));
      await select.selectOption('');
    }
    await shows('at last', () => true);
  });
}

async function sorts() {
  await visit(async (page) => {
    const table = page.locator('table:has(tbody tr:nth-child(2)):has(button.sort):visible').first();
    assert(await table.count(), 'no table can be sorted');
    const rows = () => table.locator('tbody tr').evaluateAll((all) => all.map((row) => row.cells[0].textContent.trim()));
    const before = await rows();
    const head = table.locator('thead th').first();
    const compare = new Intl.Collator('en', { numeric: true }).compare;
    await head.locator('button').click();
    assert.equal(await head.getAttribute('aria-sort'), 'ascending');
    const rising = await rows();
    assert.deepEqual(rising, [...before].sort(compare));
    await head.locator('button').click();
    assert.equal(await head.getAttribute('aria-sort'), 'descending');
    assert.deepEqual(await rows(), [...rising].reverse());

    const numbers = page.locator('table:has(tbody tr:nth-child(2) td:nth-child(2)[data-value]):has(button.sort):visible').first();
    await numbers.locator('thead th').nth(1).locator('button').click();
    const values = await numbers.locator('tbody tr').evaluateAll((all) => all.map((row) => Number(row.cells[1].dataset.value ?? Infinity)));
    assert.deepEqual(values, [...values].sort((a, b) => a - b));
  });
}

async function themes() {
  await visit(async (page) => {
    const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    await page.locator('figure.chart').first().scrollIntoViewIfNeeded();
    await page.waitForSelector('figure.chart[data-drawn]');
    const ink = () => page.locator('figure.chart[data-drawn] svg text').first().getAttribute('fill');
    const light = [await background(), await ink()];
    const button = page.locator('#toolbar button.theme');
    await button.click();
    const dark = [await background(), await ink()];
    assert.notEqual(dark[0], light[0]);
    assert.notEqual(dark[1], light[1]);
    await button.click();
    assert.deepEqual([await background(), await ink()], light);
  });
  await visit(async (page) => {
    assert.match(await page.locator('#toolbar button.theme').innerText(), /Light/);
    await page.locator('figure.chart').first().scrollIntoViewIfNeeded();
    await page.waitForSelector('figure.chart[data-drawn]');
    if (folder) await page.screenshot({ path: join(folder, 'dark-wide.png') });
  }, { colorScheme: 'dark' });
}

async function replays() {
  if (moving < 0) return console.log('     no scene has a motion');
  return visit(async (page) => {
    const plots = page.locator(`.plots[data-scene="${moving}"]`);
    const open = plots.locator('.replay-open');
    await open.click();
    const canvas = plots.locator('canvas.replay-canvas');
    const text = plots.locator('.replay-text');
    const look = async () => (await canvas.screenshot()).toString('base64');
    const begin = await look();
    const colours = await page.evaluate(async (png) => {
      const image = new Image();
      image.src = `data:image/png;base64,${png}`;
      await image.decode();
      const copy = document.createElement('canvas');
      copy.width = image.width;
      copy.height = image.height;
      const pen = copy.getContext('2d');
      pen.drawImage(image, 0, 0);
      const { data: pixels } = pen.getImageData(0, 0, copy.width, copy.height);
      return new Set(new Uint32Array(pixels.buffer)).size;
    }, begin);
    assert(colours > 100, `the replay shows ${colours} colours`);
    if (folder) await plots.locator('.replay').screenshot({ path: join(folder, 'replay.png') });

    const first = await text.innerText();
    await plots.locator('.replay-time').fill('1000');
    assert.notEqual(await look(), begin, 'the slider moves nothing');
    assert.notEqual(await text.innerText(), first, 'the slider changes no text');

    const middle = await look();
    await canvas.focus();
    await page.keyboard.press('ArrowLeft');
    assert.notEqual(await look(), middle, 'an arrow key turns nothing');

    const phases = plots.locator('.replay-phase option');
    if (await phases.count() > 1) {
      const before = await text.innerText();
      await plots.locator('.replay-phase').selectOption(await phases.nth(1).getAttribute('value'));
      assert.notEqual(await text.innerText(), before, 'another phase changes no text');
    }
    await plots.locator('.replay-play').click();
    await page.waitForTimeout(400);
    await plots.locator('.replay-play').click();
    assert(Number(await plots.locator('.replay-time').inputValue()) > 1000, 'it does not play');

    await open.click();
    assert.equal(await canvas.count(), 0, 'the replay stays');
  });
}

async function keyboard() {
  await visit(async (page) => {
    const reaches = async (selector) => {
      for (let k = 0; k < 600; ++k) {
        await page.keyboard.press('Tab');
        if (await page.evaluate((wanted) => document.activeElement?.matches(wanted), selector)) return true;
      }
      return false;
    };
    assert(await reaches('#toolbar input[type=search]'), 'the tab key does not reach the filter');
    if (moving < 0) return;
    // From the scene on, lest hundreds of links lie between.
    await page.evaluate((k) => {
      const scene = document.querySelector(`section.scene[data-scene="${k}"]`);
      scene.tabIndex = -1;
      scene.focus();
    }, moving);
    assert(await reaches('.replay-open'), 'the tab key does not reach the replay');
    await page.keyboard.press('Enter');
    assert(await reaches('canvas.replay-canvas'), 'the tab key does not reach the balls');
    assert(await reaches('.replay-time'), 'the tab key does not reach the time');
  });
}

async function without_script() {
  await visit(async (page) => {
    assert(await page.locator('table td:visible').count() > 0, 'no table is shown');
    assert.equal(await page.locator('button').count(), 0, 'buttons that nobody listens to');
    const visible = () => page.locator('section.scene[data-scene]:visible').count();
    const all = await page.locator('section.scene[data-scene]').count();
    assert.equal(await visible(), all);
    for (const verdict of ['within', 'deviates', 'undecided', 'failed']) {
      const expected = await page.locator(`section.scene[data-verdict="${verdict}"]`).count();
      await page.locator(`fieldset.filter #show-${verdict}`).check();
      assert.equal(await visible(), expected, `scenes ${verdict}`);
    }
  }, { javaScriptEnabled: false });
}

async function narrow() {
  for (const colorScheme of ['light', 'dark']) {
    await visit(async (page) => {
      const figures = page.locator('.plots figure.chart');
      for (let k = 0; k < Math.min(8, await figures.count()); ++k) {
        await figures.nth(k).scrollIntoViewIfNeeded();
        await figures.nth(k).locator('svg').waitFor();
      }
      if (moving >= 0) await page.locator('.replay-open').first().click();
      const beyond = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
      assert(beyond <= 0, `the page is ${beyond} px too wide`);
      if (folder) await page.screenshot({ path: join(folder, `${colorScheme}-narrow.png`), fullPage: true });
    }, { viewport: { width: 420, height: 900 }, colorScheme });
  }
}
