// SPDX-License-Identifier: Apache-2.0
//
// The page of halfstep report in a browser, opened from disk: node report_browser.mjs REPORT.html FOLDER. Playwright's
// package must be in the folder that it runs in. Screenshots of whole pages go to FOLDER. Closes with "N passed, N failed".
import { createRequire } from 'node:module';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import assert from 'node:assert/strict';

const { chromium } = createRequire(join(process.cwd(), 'package.json'))('playwright-core');
const [report, folder] = process.argv.slice(2).map((name) => resolve(name));
mkdirSync(folder, { recursive: true });

const html = readFileSync(report, 'utf8');
const embedded = JSON.parse(html.match(/<script id="data" type="application\/json">(.*?)<\/script>/s)[1]);
const { run } = embedded;

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});

/** A page of its own; what it says wrong, and what it asks the network for, is kept. */
async function open(options, file = report) {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, acceptDownloads: true, ...options });
  const page = await context.newPage();
  page.wrong = [];
  page.on('console', (message) => { if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text())) page.wrong.push(message.text()); });
  page.on('pageerror', (error) => page.wrong.push(String(error)));
  page.on('request', (request) => { if (!/^(file|data|blob):/.test(request.url())) page.wrong.push(`asks for ${request.url()}`); });
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector('#notes');
  await settle(page);
  return page;
}

const settle = (page) => page.evaluate(() => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); }));
/** Pixels of a canvas: a digest, and how many differ from the first one. */
const pixels = (page, id) => page.evaluate((name) => {
  const canvas = document.getElementById(name), copy = document.createElement('canvas');
  [copy.width, copy.height] = [canvas.width, canvas.height];
  const context = copy.getContext('2d');
  context.drawImage(canvas, 0, 0);
  const words = new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer);
  let digest = 0, drawn = 0;
  for (const word of words) {
    digest = (Math.imul(digest, 31) + word) | 0;
    drawn += word !== words[0];
  }
  return { digest, drawn, share: drawn / words.length };
}, id);
const texts = (page, selector) => page.locator(selector).evaluateAll((all) => all.map((e) => e.textContent));
const slide = (page, id, value) => page.locator(`#${id}`).evaluate((input, to) => {
  input.value = to;
  input.dispatchEvent(new Event('input', { bubbles: true }));
}, value);
const integer = (text) => Number(text.replaceAll(',', ''));

// --- Tests ----------------------------------------------------------------------------------------

const tests = [];
const test = (name, body) => tests.push({ name, body });

test('the page says what the run said', async (page) => {
  const cells = await page.locator('#table-views tbody tr').evaluateAll((rows) => rows.map((row) => [...row.children].map((c) => c.textContent)));
  assert.equal(cells.length, run.views.length);
  run.views.forEach((view, i) => {
    const engine = view.engines.rtl ?? view.engines.model;
    assert.equal(integer(cells[i][2]), engine.faces);
    assert.equal(integer(cells[i][5]), engine.cycles);
    assert.equal(integer(cells[i][7]), view.bound);
    assert.equal(cells[i][12], 'equal');
  });
  const verdicts = await texts(page, '#table-comparisons td.text span');
  assert.ok(verdicts.length >= 4 && verdicts.every((v) => v === 'equal'), verdicts.join());
});

test('every plot has drawn something, and its numbers are there', async (page) => {
  const ids = await page.locator('figure.plot canvas').evaluateAll((all) => all.map((c) => c.id));
  assert.ok(ids.length >= 7, ids.join());
  for (const id of ids) assert.ok((await pixels(page, id)).drawn > 500, id);
  await page.locator('figure:has(#plot-cycles) summary').click();
  await page.locator('figure:has(#plot-cycles) tbody tr').first().waitFor();
  const rows = await page.locator('figure:has(#plot-cycles) tbody tr').count();
  assert.equal(rows, run.views.length);
  await page.locator('figure:has(#plot-cycles) summary').click();
});

test('a camera path shows what changes from frame to frame', async (page) => {
  const cells = await page.locator('#table-path tbody tr').evaluateAll((rows) => rows.map((row) => [...row.children].map((c) => c.textContent)));
  assert.equal(cells.length, run.views.length);
  assert.deepEqual(cells[0].slice(2, 8), ['–', '–', '–', '–', '–', '–']);
  run.views.slice(1).forEach(({ path, engines }, i) => {
    const row = cells[i + 1].map((text) => Number(text.replaceAll(',', '')));
    assert.deepEqual(row.slice(1, 8), [engines.rtl.faces, path.faces_kept, path.faces_gained, path.faces_lost, path.vertices_shared, path.vertices_compared, path.vertices_moved]);
    assert.ok(path.faces_gained > 0 && path.faces_lost > 0 && path.vertices_compared > 0);
  });
  assert.match(await page.textContent('#path'), /none moved/);
});

test('a table is sorted by a click, and the other way by another', async (page) => {
  const column = () => texts(page, '#table-views tbody tr td:nth-child(6)').then((all) => all.map(integer));
  const head = page.locator('#table-views th:nth-child(6)');
  const before = await column(), sorted = [...before].sort((a, b) => a - b);
  assert.notDeepEqual(before, sorted);
  await head.locator('button').click();
  assert.deepEqual(await column(), sorted);
  assert.equal(await head.getAttribute('aria-sort'), 'ascending');
  await head.locator('button').click();
  assert.deepEqual(await column(), sorted.reverse());
  assert.equal(await head.getAttribute('aria-sort'), 'descending');
});

test('dragging turns the mesh, and the other camera stays', async (page) => {
  const canvas = page.locator('#mesh-orbit');
  await canvas.scrollIntoViewIfNeeded();
  const box = await canvas.boundingBox();
  await page.click('#mesh-reset');
  await settle(page);
  const before = await pixels(page, 'mesh-orbit'), still = await pixels(page, 'mesh-frozen');
  assert.ok(before.share > 0.02, `only ${before.drawn} pixels`);
  assert.ok(still.share > 0.02, `only ${still.drawn} pixels`);
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 160, box.y + box.height / 2 + 30, { steps: 5 });
  await page.mouse.up();
  await settle(page);
  assert.notEqual((await pixels(page, 'mesh-orbit')).digest, before.digest);
  assert.equal((await pixels(page, 'mesh-frozen')).digest, still.digest);
  await canvas.screenshot({ path: join(folder, 'turned.png') });
  await page.click('#mesh-reset');
  await settle(page);
  assert.equal((await pixels(page, 'mesh-orbit')).digest, before.digest);
});

test('the slider over steps shows the refinement', async (page) => {
  const key = String(run.views[0].view), { steps } = embedded.meshes[key];
  const seen = new Set();
  for (const { step, faces } of steps) {
    await slide(page, 'mesh-step', step);
    await settle(page);
    assert.ok((await page.textContent('#mesh-words')).includes(`${faces.toLocaleString('en')} faces`));
    seen.add((await pixels(page, 'mesh-frozen')).digest);
  }
  assert.equal(seen.size, steps.length);
  assert.equal(steps[0].faces, run.mesh.faces);
  assert.equal(steps.at(-1).faces, (run.views[0].engines.rtl ?? run.views[0].engines.model).faces);
});

test('each colouring and the edges change the picture', async (page) => {
  const seen = new Set();
  for (const paint of ['depth', 'facing', 'generation', 'end', 'plain']) {
    await page.selectOption('#mesh-paint', paint);
    await settle(page);
    seen.add((await pixels(page, 'mesh-orbit')).digest);
  }
  await page.uncheck('#mesh-wires');
  await settle(page);
  seen.add((await pixels(page, 'mesh-orbit')).digest);
  assert.equal(seen.size, 6);
  await page.check('#mesh-wires');
  await page.selectOption('#mesh-paint', 'depth');
});

test('what faces the viewpoint is what the other camera sees', async (page) => {
  await page.selectOption('#mesh-paint', 'facing');
  await page.uncheck('#mesh-wires');
  await settle(page);
  const of = (id) => page.evaluate((name) => {
    const canvas = document.getElementById(name), copy = document.createElement('canvas');
    [copy.width, copy.height] = [canvas.width, canvas.height];
    copy.getContext('2d').drawImage(canvas, 0, 0);
    const data = copy.getContext('2d').getImageData(0, 0, copy.width, copy.height).data;
    let front = 0, back = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] < 255) continue;
      const ratio = data[i + 2] / Math.max(data[i], 1);
      front += ratio > 1.9 && ratio < 2.4;
      back += ratio > 1.25 && ratio < 1.5;
    }
    return { front, back };
  }, id);
  const frozen = await of('mesh-frozen');
  assert.ok(frozen.front > 5000 && frozen.back < frozen.front / 100, JSON.stringify(frozen));
  const canvas = page.locator('#mesh-orbit'), box = await canvas.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 300, box.y + box.height / 2, { steps: 5 });
  await page.mouse.up();
  await settle(page);
  const turned = await of('mesh-orbit');
  assert.ok(turned.back > 1000, JSON.stringify(turned));
  await page.click('#mesh-reset');
  await page.check('#mesh-wires');
  await page.selectOption('#mesh-paint', 'depth');
});

test('one slider of viewpoints moves all, pictures and meshes', async (page) => {
  const picture = () => page.getAttribute('#pictures img[data-name=refined]', 'src');
  const before = await picture(), mesh = await pixels(page, 'mesh-frozen');
  await slide(page, 'view-pictures', 3);
  await settle(page);
  assert.notEqual(await picture(), before);
  assert.notEqual((await pixels(page, 'mesh-frozen')).digest, mesh.digest);
  assert.equal(await page.inputValue('#view-mesh'), '3');
  assert.equal(await page.inputValue('#view-generations'), '3');
  const size = await page.locator('#pictures img[data-name=refined]').evaluate((img) => img.naturalWidth);
  assert.equal(size, run.settings.size[0]);
  await slide(page, 'view-mesh', 0);
  await settle(page);
  assert.equal(await picture(), before);
});

test('play runs through the steps', async (page) => {
  await page.click('#mesh-play');
  await page.waitForFunction(() => document.getElementById('mesh-step').value === '2', null, { timeout: 8000 });
  await page.click('#mesh-play');
  assert.equal(await page.textContent('#mesh-play'), 'play');
  await slide(page, 'mesh-step', 99);
});

test('CSV and JSON hold the figures', async (page) => {
  const save = async (name) => {
    const [file] = await Promise.all([page.waitForEvent('download'), page.locator('#table-views').getByRole('button', { name, exact: true }).click()]);
    return readFileSync(await file.path(), 'utf8');
  };
  const json = JSON.parse(await save('JSON')), csv = (await save('CSV')).trim().split('\r\n');
  assert.equal(json.length, run.views.length);
  assert.equal(csv.length, run.views.length + 1);
  assert.deepEqual(json.map((row) => row.bound), run.views.map((view) => view.bound));
  assert.equal(csv[0].split(',')[5], 'cycles');
  assert.equal(Number(csv[1].split(',')[5]), json[0].cycles);
});

test('the Pareto front is that of the exploration', async (page) => {
  const rows = await page.locator('#table-design-0 tbody tr').evaluateAll((all) => all.map((row) => [...row.children].map((c) => c.textContent)));
  const architectures = new Set(embedded.explore[0].points.map((p) => JSON.stringify(p.set)));
  assert.equal(rows.length, architectures.size);
  assert.ok(rows.some((row) => row.at(-1) === 'yes') && rows.some((row) => row.at(-1) === ''));
  await page.selectOption('#pareto-by-0', 'lanes');
  await settle(page);
});

// The whole page for people to look at, in parts: Chromium's surface ends at 8192 pixels, and what is below it shows the top again.
async function shoot(page, name) {
  const part = 4000;
  const { width, height } = await page.evaluate(() => ({ width: innerWidth, height: document.documentElement.scrollHeight }));
  for (let top = 0; top < height; top += part)
    await page.screenshot({ path: join(folder, `${name}-${top / part}.png`), fullPage: true, clip: { x: 0, y: top, width, height: Math.min(part, height - top) } });
}

test('it reads well in each width and theme: nothing scrolls sideways', async () => {
  for (const width of [1440, 800, 390])
    for (const colorScheme of ['light', 'dark']) {
      const page = await open({ viewport: { width, height: 900 }, colorScheme, isMobile: width < 500, hasTouch: width < 500 });
      const { scroll, client } = await page.evaluate(() => ({ scroll: document.documentElement.scrollWidth, client: document.documentElement.clientWidth }));
      assert.ok(scroll <= client && client <= width, `${scroll} pixels at ${width}`);
      const wide = await page.evaluate(() => [...document.querySelectorAll('#page *')].filter((e) => e.getBoundingClientRect().right > innerWidth + 1).map((e) => e.tagName + e.className).slice(0, 5));
      assert.deepEqual(wide, [], `at ${width}`);
      await shoot(page, `${width}-${colorScheme}`);
      assert.deepEqual(page.wrong, []);
      await page.context().close();
    }
});

test('it prints', async () => {
  const page = await open({ colorScheme: 'dark' });
  const pdf = await page.pdf({ path: join(folder, 'report.pdf'), format: 'A4', printBackground: true });
  assert.ok(pdf.length > 100000);
  assert.deepEqual(page.wrong, []);
  await page.context().close();
});

/** The page with other data. */
async function openData(name, data) {
  const file = join(folder, name), text = JSON.stringify(data).replaceAll('<', '\\u003c');
  const at = html.indexOf('<script id="data"'), begin = html.indexOf('>', at) + 1, end = html.indexOf('</script>', begin);
  writeFileSync(file, html.slice(0, begin) + text + html.slice(end));
  return open({}, file);
}

test('names are text, whatever they hold', async () => {
  const evil = '<img src=x onerror="console.error(1)"><script>console.error(2)</script>';
  const changed = structuredClone({ ...embedded, meshes: {}, pictures: {}, notes: [evil] });
  changed.run.mesh.source = changed.run.settings.engines[0] = changed.run.machine.processor = evil;
  for (const view of changed.run.views) for (const c of view.comparisons) c.what = evil;
  for (const exploration of changed.explore) exploration.mesh = evil;
  const page = await openData('evil.html', changed);
  assert.ok((await texts(page, '#ran dd')).includes(evil));
  assert.ok((await page.textContent('#notes')).includes(evil));
  assert.equal(await page.locator('#page script, #page img').count(), 0);
  assert.deepEqual(page.wrong, []);
  await page.context().close();
});

test('data that lack nearly everything make a page all the same', async () => {
  const empty = { run: { views: [] }, written: '', with: [], explore: [{ points: [] }], pictures: {}, meshes: {}, timelines: [], notes: [] };
  const odd = { ...empty, run: { views: [{ view: 3, engines: {}, generations: 7, comparisons: null }, { view: 1, engines: { rtl: { cycles: 'x' } }, path: 5 }] }, explore: [{ points: [{}] }] };
  for (const data of [empty, odd]) {
    const page = await openData('empty.html', data);
    assert.ok(await page.locator('section').count() >= 6);
    assert.deepEqual(page.wrong, []);
    await page.context().close();
  }
});

// --- Running them -----------------------------------------------------------------------------------

let failed = 0;
const page = await open({});
for (const { name, body } of tests) {
  const start = Date.now();
  try {
    await body(page);
    assert.deepEqual(page.wrong.splice(0), [], 'logged');
    console.log(`passed  ${name} (${((Date.now() - start) / 1000).toFixed(1)} s)`);
  } catch (error) {
    failed++;
    console.log(`FAILED  ${name}\n${error.stack}`);
  }
}
await browser.close();
console.log(`${tests.length - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
