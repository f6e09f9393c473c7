// A report in a browser, against what its own data say should be there.
//   node page_test.mjs NODE_MODULES PAGE.html [FOLDER for screenshots]
// SLOWER=20 in the environment: as on a machine that is 20 times as slow. What follows an action a frame
// or an event later is asked for by `eventually`, never by a wait.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { inflateSync } from 'node:zlib';
import { kRunFields } from '../../core/report/html/page/src/filter.js';
import { scene_verdict, summarize, told_counts, verdict_name } from '../../core/report/html/page/src/summary.js';

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
assert.equal(data.schema, 'slipcheck-page/3');
const moving = data.scenes.findIndex((scene) =>
  scene.motion?.runs.some((run) => run.run < 0) && scene.motion.runs.some((run) => run.run >= 0));

const browser = await chromium.launch({ executablePath,
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });

const checks = { loads, same_words, folds, charts, filters, addresses, sorts, themes, replays, keyboard, accessible, on_paper, without_script, narrow };
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
  if (process.env.SLOWER && options.javaScriptEnabled !== false) {
    const session = await context.newCDPSession(page);
    await session.send('Emulation.setCPUThrottlingRate', { rate: Number(process.env.SLOWER) });
  }
  const begin = performance.now();
  await page.goto(url);
  if (options.javaScriptEnabled !== false) await page.waitForSelector('html[data-ready]', { state: 'attached' });
  await use(page, begin);
  assert.deepEqual(wrong, []);
  await context.close();
}

/** What `check` gives once it throws no more; its last complaint if that takes longer than any page should. */
async function eventually(check) {
  const end = performance.now() + 60000;
  for (;;) {
    try {
      return await check();
    } catch (error) {
      if (performance.now() > end) throw error;
      await new Promise((go_on) => setTimeout(go_on, 50));
    }
  }
}

/** Every scene is open and has been filled. */
async function open_all(page) {
  await page.locator('.fold button').first().click();
  await eventually(async () => assert.equal(await page.locator('section.scene .run').count(), data.scenes.reduce((sum, { runs }) => sum + runs.length, 0)));
}

/** A scene is open and has been filled. */
async function open_scene(page, k, open = (summary) => summary.click()) {
  const section = page.locator(`section.scene[data-scene="${k}"]`);
  await open(section.locator('> details > summary'));
  await eventually(async () => assert.equal(await section.locator('.run').count(), data.scenes[k].runs.length));
  return section;
}

/** A figure whose chart is there: what is filled above it pushes it out of sight, where charts are let go. */
async function drawn(figure) {
  await eventually(async () => {
    await figure.scrollIntoViewIfNeeded();
    assert(await figure.locator('svg path').count() > 5, `"${await figure.locator('[role=img]').getAttribute('aria-label')}" has no paths`);
  });
  return figure;
}

function address(page) {
  return page.evaluate(() => window.location.hash);
}

function texts(locator) {
  return locator.evaluateAll((all) => all.map((one) => one.textContent.replaceAll(/\s+/g, ' ').trim()));
}

async function loads() {
  await visit(async (page, begin) => {
    const ready = performance.now() - begin;
    const paint = await page.evaluate(() => new Promise((tell) => {
      new PerformanceObserver((list) => tell(list.getEntries()[0].startTime)).observe({ type: 'paint', buffered: true });
      setTimeout(() => tell(null), 2000);
    }));
    console.log(`     first paint after ${paint?.toFixed(0)} ms, ready after ${ready.toFixed(0)} ms`);
    await open_all(page);
    await drawn(page.locator('figure.chart').first());
    console.log(`     first chart after ${((performance.now() - begin) / 1000).toFixed(1)} s`);
  });
}

/** What the script tells of everything is, to the letter, what the program wrote; a filter tells what its runs say. */
async function same_words() {
  const all = summarize(data.scenes.map((scene) => ({ scene, runs: scene.runs })));
  await visit(async (page) => {
    const first = async () => ({ finding: await page.locator('#finding').textContent(), counts: await texts(page.locator('#counts .verdict')),
      scores: await texts(page.locator('#scores > li')), worst: await texts(page.locator('#worst li')),
      cells: await texts(page.locator('.matrix tr.scene > :nth-child(-n+3)')), topics: await texts(page.locator('section.topic > h2')) });
    const written = await first();
    assert.equal(written.finding, all.finding);
    const search = page.locator('#toolbar input[type=search]');
    await search.fill('no scene has this name');
    await eventually(async () => assert.notEqual(await page.locator('#finding').textContent(), written.finding));
    await search.fill('');
    await eventually(async () => {
      const told = await first();
      if (written.counts.length) assert.deepEqual(told, written);
      assert.deepEqual(told.counts.map((text) => text.replace(/^\S+ /, '')), told_counts(all).map(([, text]) => text));
    });

    const profiles = page.locator('#toolbar select[name=profile] option');
    for (const profile of (await profiles.evaluateAll((some) => some.map(({ value }) => value))).filter(Boolean)) {
      await page.locator('#toolbar select[name=profile]').selectOption(profile);
      const shown = data.scenes.map((scene) => ({ scene, runs: scene.runs.filter((run) => run.profile === profile) })).filter(({ runs }) => runs.length);
      const expected = summarize(shown);
      await eventually(async () => assert.equal(await page.locator('#finding').textContent(), expected.finding, profile));
      assert.equal((await texts(page.locator('#worst li'))).length, expected.worst.length, `worst of ${profile}`);
      const heads = await texts(page.locator('.matrix thead th[data-method]:visible span:nth-child(2)'));
      assert(heads.length && heads.every((text) => text === profile), `columns of ${profile}: ${heads}`);
      for (const { scene, runs } of shown) {
        const label = await page.locator(`.matrix tr[data-scene="${data.scenes.indexOf(scene)}"] .verdict`).textContent();
        assert(label.endsWith(verdict_name(scene, runs)), `${scene.name} under ${profile}: ${label}`);
      }
    }
  });
}

/** Scenes are folded, by topic and the worst first; a cell or a name of the index opens them, and what they show is made then. */
async function folds() {
  await visit(async (page) => {
    assert.equal(await page.locator('section.scene > details[open]').count(), 0);
    assert.equal(await page.locator('section.scene .run').count(), 0, 'runs are there before anybody looks');
    const order = ['not-judged', 'within', 'undecided', 'deviates', 'failed'];
    for (const topic of await page.locator('section.topic').all()) {
      const verdicts = (await topic.locator('section.scene').evaluateAll((all) => all.map((one) => one.dataset.verdict))).map((one) => order.indexOf(one));
      if (file.includes('fixture')) break;  // made by hand
      assert.deepEqual(verdicts, [...verdicts].sort((a, b) => b - a));
    }
    const k = data.scenes.findIndex((scene) => scene.runs.length);
    await page.locator(`.matrix tr[data-scene="${k}"] th a`).click();
    const section = page.locator(`section.scene[data-scene="${k}"]`);
    await eventually(async () => {
      assert.equal(await section.locator('> details[open] .run').count(), data.scenes[k].runs.length);
      assert((await address(page)).includes(`scene=${data.scenes[k].name}`), await address(page));
      const top = await section.evaluate((one) => one.getBoundingClientRect().top);
      assert(top >= -1 && top < 500, `the scene is at ${top}`);
    });
    assert.equal(await page.locator('section.scene > details[open]').count(), 1);
  });
}

async function charts() {
  let expected = (data.engines?.length ? 1 : 0) + data.precision.filter(({ charts: all }) => all.length).length + (data.stability?.maps.length ?? 0) + (data.stability?.limits.length ?? 0);
  for (const scene of data.scenes) {
    expected += scene.charts.length + (scene.motion?.runs.length ? 1 : 0);
  }
  assert(expected > 0, 'nothing to draw');
  await visit(async (page) => {
    await open_all(page);
    const figures = page.locator('.plots figure.chart');
    await page.waitForFunction((count) => document.querySelectorAll('.plots figure.chart').length >= count, expected);
    assert.equal(await figures.count(), expected);
    for (let k = 0; k < expected; ++k) {
      const figure = await drawn(figures.nth(k));
      const title = await figure.locator('[role=img]').getAttribute('aria-label');
      const text = await figure.locator('svg').innerHTML();
      assert(!/NaN|undefined|\[object/.test(text), `"${title}" draws ${/.{0,60}(NaN|undefined|\[object)/.exec(text)?.[0]}`);
    }
    if (folder) await page.screenshot({ path: join(folder, 'light-wide.png'), fullPage: true });
    // A run's points are as many as it has phases: tooltips and eyes go by them.
    const has_phases = ({ panels: [{ y }] }) => y.runs;
    const k = data.scenes.findIndex((scene) => scene.charts.some(has_phases));
    if (k < 0) return;
    const { charts: all } = data.scenes[k];
    const phases = all.find(has_phases);
    const points = phases.panels[0].curves.flatMap(({ notes }) => notes ?? []).length;
    const figure = page.locator(`.plots[data-scene="${k}"] figure.chart`).nth(all.indexOf(phases));
    await drawn(figure);
    // At most five runs, and no naive one, until more are asked for.
    const rows = phases.panels[0].y.names, runs = phases.panels[0].y.runs.map((r) => data.scenes[k].runs[r]);
    const named = async () => (await texts(figure.locator('svg text'))).filter((text) => rows.some((row) => row.startsWith(text.replace(/…$/, '')) && text.length > 8));
    const others = runs.filter((run) => !run.naive).length || runs.length;
    await eventually(async () => assert.equal((await named()).length, Math.min(5, others)));
    if (Math.min(5, others) < rows.length) {
      assert((await named()).every((text) => !text.includes('naive') || others === runs.length), 'a naive run is shown');
      await figure.locator('button.show-lines').click();
      await eventually(async () => assert.equal((await named()).length, rows.length));
    }
    const paths = () => figure.locator('svg path').count();
    await eventually(async () => assert(await paths() >= points && await paths() < points + 80, `${await paths()} paths for ${points} points`));
    const all_paths = await paths();
    // A point says its run, its phase and its value; a name in the legend takes its points away.
    const legend = figure.locator('svg text', { hasText: /^(outside|within the tolerance)$/ }).first();
    await legend.click();
    await eventually(async () => assert(await paths() < all_paths, 'the legend hides nothing'));
    await legend.click();
  });
}

async function filters() {
  const total = data.scenes.length;
  await visit(async (page) => {
    const toolbar = page.locator('#toolbar');
    const shows = (what, passes) => eventually(async () => {
      const expected = data.scenes.map((scene, k) => (passes(scene) ? k : -1)).filter((k) => k >= 0);
      const shown = await page.locator('section.scene[data-scene]').evaluateAll((all) =>
        all.filter((one) => one.getClientRects().length).map((one) => Number(one.dataset.scene)));
      assert.deepEqual(shown.sort((a, b) => a - b), expected, what);
      const listed = await page.locator('.matrix .scene[data-scene]').evaluateAll((all) => all.filter((one) => one.getClientRects().length).length);
      assert.equal(listed, expected.length, `${what}, in the list`);
      assert.equal((await toolbar.locator('[aria-live]').innerText()).trim(), `${expected.length} of ${total} scene${total === 1 ? '' : 's'}`);
    });
    assert.equal(await page.locator('fieldset.filter').count(), 0, 'the filter of the page without a script is still there');
    await shows('at first', () => true);

    const word = data.scenes[0].name.slice(0, 5).toUpperCase();
    await toolbar.locator('input[type=search]').fill(word);
    await shows(`name ${word}`, (scene) => scene.name.toUpperCase().includes(word));
    await toolbar.locator('input[type=search]').fill('no scene has this name');
    await shows('no name', () => false);
    await toolbar.locator('button.show-all').click();
    await shows('after a reset', () => true);

    for (const box of await toolbar.locator('input[type=checkbox]').all()) {
      const verdict = await box.inputValue();
      await box.uncheck();
      await shows(`without ${verdict}`, (scene) => scene_verdict(scene, scene.runs) !== verdict);
      await box.check();
    }
    await open_all(page);
    for (const select of await toolbar.locator('select').all()) {
      const field = await select.getAttribute('name');
      const value = await select.locator('option').nth(1).getAttribute('value');
      const is_run_field = kRunFields.some(([name]) => name === field);
      await select.selectOption(value);
      await shows(`${field} ${value}`, (scene) => (is_run_field ? scene.runs.some((run) => String(run[field]) === value) : scene[field] === value));
      if (is_run_field) {
        await eventually(async () => {
          const wrong = await page.locator('section.scene:not(.filtered) .run').evaluateAll((all, [name, wanted]) =>
            all.filter((one) => one.getClientRects().length && one.dataset[name] !== undefined && one.dataset[name].split('@')[0] !== wanted).length, [field, value]);
          assert.equal(wrong, 0, `runs that are not of ${field} ${value} are shown`);
        });
      }
      await select.selectOption('');
    }
    await shows('at last', () => true);
  });
}

async function addresses() {
  const scene = data.scenes.find(({ runs }) => runs.length);
  const [run] = scene.runs;
  await visit(async (page) => {
    await page.goto(`${url}#scene=${scene.name}&profile=${run.profile}`);
    await page.reload();
    await page.waitForSelector('html[data-ready]', { state: 'attached' });
    assert(await page.locator(`section.scene[data-scene="${data.scenes.indexOf(scene)}"] > details`).evaluate((one) => one.open), 'the scene is not open');
    const select = page.locator('#toolbar select[name=profile]');
    if (await select.count()) assert.equal(await select.inputValue(), run.profile);
    await page.locator('#toolbar button.show-all').click();
    await eventually(async () => assert(!(await address(page)).includes('profile='), await address(page)));
    await page.locator('#toolbar input[type=search]').fill('roll');
    await eventually(async () => assert((await address(page)).includes('name=roll'), await address(page)));
    // An anchor of the page without the script's words leads to its scene, too.
    await page.goto(`${url}#${scene.id}`);
    await page.reload();
    await page.waitForSelector('html[data-ready]', { state: 'attached' });
    assert(await page.locator(`section.scene[data-scene="${data.scenes.indexOf(scene)}"] > details`).evaluate((one) => one.open));
  });
}

async function sorts() {
  await visit(async (page) => {
    // Within each topic by the worst error of a method: numbers first, the least first.
    const head = page.locator('.matrix thead th[data-method]').first();
    const column = async () => page.locator('.matrix tbody').evaluateAll((all) => all.map((body) => [...body.rows].filter((row) => row.cells.length > 3)
      .map((row) => (row.cells[3].dataset.value === undefined ? Infinity : Number(row.cells[3].dataset.value)))));
    await head.locator('button').click();
    assert.equal(await head.getAttribute('aria-sort'), 'ascending');
    const rising = await column();
    for (const values of rising) assert.deepEqual(values, [...values].sort((a, b) => a - b));
    await head.locator('button').click();
    assert.equal(await head.getAttribute('aria-sort'), 'descending');
    for (const values of await column()) {
      const known = values.filter(Number.isFinite);
      assert.deepEqual(values.slice(0, known.length), [...known].sort((a, b) => b - a));
    }
    // Topics stay above their scenes.
    assert(await page.locator('.matrix tbody').evaluateAll((all) => all.every((body) => body.rows[0].className === 'topic')));

    await open_all(page);
    const numbers = page.locator('section.scene table:has(tbody tr:nth-child(2) td:nth-child(2)[data-value]):has(button.sort):visible').first();
    await numbers.locator('thead th').nth(1).locator('button').click();
    const values = await numbers.locator('tbody tr').evaluateAll((all) => all.map((row) => Number(row.cells[1].dataset.value ?? Infinity)));
    assert.deepEqual(values, [...values].sort((a, b) => a - b));
  });
}

async function themes() {
  await visit(async (page) => {
    const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    await open_all(page);
    // One figure of its own: charts elsewhere are drawn and let go meanwhile.
    const figure = page.locator('figure.chart').first();
    const inks_once = (is_done) => eventually(async () => {
      await figure.scrollIntoViewIfNeeded();
      const inks = await figure.locator('svg text').evaluateAll((all) => [...new Set(all.map((text) => text.getAttribute('fill')))].sort());
      assert(inks.length > 0 && is_done(inks), `the first chart has the colours ${inks}`);
      return inks;
    });
    const light = [await background(), await inks_once(() => true)];
    const button = page.locator('#toolbar button.theme');
    const after_click = async (is_done) => {
      await button.click();
      const inks = await inks_once(is_done);  // of the next frames
      return [await background(), inks];
    };
    const dark = await after_click((found) => found.every((ink) => !light[1].includes(ink)));
    assert.notEqual(dark[0], light[0]);
    assert.deepEqual(await after_click((found) => found.join() === light[1].join()), light);
  });
  await visit(async (page) => {
    assert.match(await page.locator('#toolbar button.theme').innerText(), /Light/);
    if (folder) await page.screenshot({ path: join(folder, 'dark-first.png') });
    await open_all(page);
    await drawn(page.locator('figure.chart').first());
    if (folder) await page.screenshot({ path: join(folder, 'dark-wide.png') });
  }, { colorScheme: 'dark' });
}

async function replays() {
  if (moving < 0) return console.log('     no scene has a motion');
  return visit(async (page) => {
    await open_scene(page, moving);
    const plots = page.locator(`.plots[data-scene="${moving}"]`);
    const open = plots.locator('.replay-open');
    await open.click();
    const canvas = plots.locator('canvas.replay-canvas').first();
    const text = plots.locator('.replay-text');
    const look = async () => (await canvas.screenshot()).toString('base64');
    const colours_of = (screenshot) => page.evaluate(async (png) => {
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
    }, screenshot);
    const begin = await eventually(async () => {
      const seen = await look(), colours = await colours_of(seen);
      assert(colours > 100, `the replay shows ${colours} colours`);
      return seen;
    });
    if (folder) await plots.locator('.replay').screenshot({ path: join(folder, 'replay.png') });

    const first = await text.innerText();
    await plots.locator('.replay-time').fill('1000');
    await eventually(async () => assert.notEqual(await look(), begin, 'the slider moves nothing'));
    await eventually(async () => assert.notEqual(await text.innerText(), first, 'the slider changes no text'));

    const middle = await look();
    await canvas.focus();
    await page.keyboard.press('ArrowLeft');
    await eventually(async () => assert.notEqual(await look(), middle, 'an arrow key turns nothing'));

    const phases = plots.locator('.replay-phase option');
    if (await phases.count() > 1) {
      const before = await text.innerText();
      await plots.locator('.replay-phase').selectOption(await phases.nth(1).getAttribute('value'));
      await eventually(async () => assert.notEqual(await text.innerText(), before, 'another phase changes no text'));
    }
    const beside = plots.locator('.replay-beside');
    if (await beside.count()) {
      await beside.selectOption(await beside.locator('option').nth(2).getAttribute('value'));
      const second = plots.locator('canvas.replay-canvas').nth(1);
      await eventually(async () => assert((await second.boundingBox())?.width > 200, 'the engine beside is not shown'));
      const before = (await second.screenshot()).toString('base64');
      await canvas.focus();
      await page.keyboard.press('ArrowRight');
      await eventually(async () => assert.notEqual((await second.screenshot()).toString('base64'), before, 'both views do not turn together'));
      if (folder) await plots.locator('.replay').screenshot({ path: join(folder, 'replay-beside.png') });
      await beside.selectOption('');
      await eventually(async () => assert.equal(await plots.locator('canvas.replay-canvas').count(), 1));
    }
    await plots.locator('.replay-play').click();
    await eventually(async () => assert(Number(await plots.locator('.replay-time').inputValue()) > 1000, 'it does not play'));
    await plots.locator('.replay-play').click();

    await open.click();
    await eventually(async () => assert.equal(await plots.locator('canvas.replay-canvas').count(), 0, 'the replay stays'));
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
    await page.keyboard.press('Tab');
    assert.equal(await page.evaluate(() => document.activeElement.className), 'skip', 'the first stop skips to the scenes');
    assert(await reaches('#toolbar input[type=search]'), 'the tab key does not reach the filter');
    // The index is one stop: arrows go through its heads and names.
    assert(await reaches('.matrix thead button'), 'the tab key does not reach the index');
    await page.keyboard.press('ArrowRight');
    assert.equal(await page.evaluate(() => document.activeElement.closest('th')?.cellIndex), 1);
    await page.keyboard.press('ArrowDown');
    assert(await page.evaluate(() => document.activeElement.matches('.matrix tbody a')), 'an arrow does not reach the names');
    await page.keyboard.press('Tab');
    assert(await page.evaluate(() => !document.activeElement.closest('.matrix')), 'the index takes more than one stop');
    if (moving < 0) return;
    // From the scene on, lest hundreds of links lie between.
    const section = await open_scene(page, moving, (summary) => summary.press('Enter'));
    assert(await reaches('.replay-open'), 'the tab key does not reach the replay');
    await page.keyboard.press('Enter');
    await section.locator('canvas.replay-canvas').first().waitFor();
    assert(await reaches('canvas.replay-canvas'), 'the tab key does not reach the balls');
    assert(await reaches('.replay-time'), 'the tab key does not reach the time');
  });
}

/** No rule of axe-core is broken, in light and dark, folded and open. */
async function accessible() {
  const axe = readFileSync(join(resolve(modules), 'axe-core/axe.min.js'), 'utf8');
  for (const colorScheme of ['light', 'dark']) {
    await visit(async (page) => {
      await page.evaluate(axe);  // by the protocol, which the page's policy does not hold
      const violations = async () => (await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ['violations'] }))).violations
        .map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map(({ html, failureSummary }) => `${html.slice(0, 160)} ${failureSummary}`).join(' | ')} (${nodes.length})`);
      assert.deepEqual(await violations(), [], `${colorScheme}, folded`);
      const section = await open_scene(page, Math.max(moving, 0));
      for (const run of await section.locator('.run > details > summary').all()) await run.click();
      assert.deepEqual(await violations(), [], `${colorScheme}, a scene open`);
    }, { colorScheme, bypassCSP: true });
  }
}

/** Paper has what it comes to and the scenes that are open, not hundreds of pages. */
async function on_paper() {
  await visit(async (page) => {
    await page.emulateMedia({ media: 'print' });
    assert(await page.locator('#finding').isVisible());
    assert(!await page.locator('#toolbar').isVisible());
    assert.equal(await page.locator('section.scene:visible').count(), 0, 'folded scenes are printed');
    await page.emulateMedia({ media: 'screen' });
    await open_scene(page, Number(await page.locator('section.scene').first().getAttribute('data-scene')));
    await page.emulateMedia({ media: 'print' });
    assert.equal(await page.locator('section.scene:visible').count(), 1);
    const sheets = (await page.pdf({ format: 'A4' })).toString('latin1').match(/\/Type\s*\/Page\b/g).length;
    console.log(`     ${sheets} sheets with a scene open`);
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
      if (folder) await page.screenshot({ path: join(folder, `${colorScheme}-narrow-first.png`) });
      await open_all(page);
      const figures = page.locator('.plots figure.chart');
      for (let k = 0; k < Math.min(8, await figures.count()); ++k) {
        await drawn(figures.nth(k));
      }
      if (moving >= 0) await page.locator('.replay-open').first().click();
      const beyond = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
      assert(beyond <= 0, `the page is ${beyond} px too wide`);
      if (folder) await page.screenshot({ path: join(folder, `${colorScheme}-narrow.png`), fullPage: true });
    }, { viewport: { width: 390, height: 844 }, colorScheme });
  }
}
