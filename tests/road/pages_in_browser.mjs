// pages_in_browser.mjs PACKAGES BROWSER FOLDER NAME ...: opens FOLDER/NAME.html, and points, drags, zooms and types
// as a reader does. Started by browser.py.
import assert from 'node:assert/strict';
import {readFileSync, statSync} from 'node:fs';
import {createRequire} from 'node:module';
import {basename, join} from 'node:path';

const [packages, executablePath, folder, ...names] = process.argv.slice(2);
const {chromium} = createRequire(join(packages, 'node_modules', 'x.cjs'))('playwright-core');
const kMostBytes = 3e6;

const browser = await chromium.launch({executablePath, args: ['--no-sandbox']});
const page = await browser.newPage();
const complaints = [];
page.on('console', message => complaints.push(message.text()));
page.on('pageerror', error => complaints.push(error.stack));
page.on('request', request => {
  if (!/^(data|blob|file):/.test(request.url())) complaints.push(`asks for ${request.url()}`);
});

async function open(name) {
  const path = join(folder, `${name}.html`);
  assert.ok(statSync(path).size < kMostBytes, `${name} is too large`);
  await page.setViewportSize({width: 1280, height: 900});
  await page.emulateMedia({colorScheme: 'light'});
  await page.goto(`file://${path}`);
}

// A picture of what an element shows.
const seen = locator => locator.evaluate(e => e.toDataURL ? e.toDataURL() : e.innerHTML);

// Titles of the plots that draw to the very border of their canvas, where a number would be cut.
const plotsCutOff = () => [...document.querySelectorAll('[data-widget="plot"]')].filter(plot => {
  const canvas = plot.querySelector('canvas');
  const {width, height} = canvas;
  const border = [[0, 0, 1, height], [width - 1, 0, 1, height], [0, 0, width, 1], [0, height - 1, width, 1]];
  const copy = new OffscreenCanvas(width, height).getContext('2d', {willReadFrequently: true});
  copy.drawImage(canvas, 0, 0);
  return border.some(part => copy.getImageData(...part).data.some(v => v > 0));
}).map(plot => plot.querySelector('.plot-title').textContent);

async function lookAtAll(name) {
  assert.equal(await page.locator('h1').count(), 1, name);
  assert.equal(await page.locator('html').getAttribute('lang'), 'en');
  assert.equal(await page.locator('img:not([alt]), img[alt=""]').count(), 0, `${name}: a picture without words`);
  assert.equal(await page.locator('[tabindex="0"]:not([aria-label]):not(.scroll)').count(), 0, name);
  assert.equal(await page.locator('button:not([aria-label])').filter({hasText: /^.?$/}).count(), 0, name);
  for (const width of [1600, 1280, 400]) {
    await page.setViewportSize({width, height: 900});
    for (const colorScheme of ['light', 'dark']) {
      await page.emulateMedia({colorScheme});
      // Pictures follow the width in the browser's own time. Whatever has no scroll bar of its own stays within
      // the page.
      const beyond = asList => {
        const cut = [...document.querySelectorAll('figure, canvas, svg, select, h1, h2, p, td')]
          .filter(e => !e.closest('pre.scroll, figure .scroll, details:not([open])') && e.getBoundingClientRect().right > innerWidth + 1)
          .map(e => e.outerHTML.slice(0, 80))
          .concat(document.documentElement.scrollWidth > innerWidth ? ['the page'] : []);
        return asList ? cut : cut.length === 0;
      };
      await page.waitForFunction(beyond, false, {timeout: 10000}).catch(() => {});
      const cut = await page.evaluate(beyond, true);
      assert.deepEqual(cut, [], `${name} at ${width} px, ${colorScheme}`);
      assert.deepEqual(await page.evaluate(plotsCutOff), [], `${name} at ${width} px, ${colorScheme}`);
    }
  }
  await page.setViewportSize({width: 1280, height: 900});
  await page.emulateMedia({colorScheme: 'light'});
}

// The numbers before the units: "d 3.2 mm, r 0.0012 1/mm²" -> [3.2, 0.0012].
const numbersIn = text => [...text.matchAll(/(?<![\w^/])−?\d[\d.]*(?: × 10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?/g)].map(([t]) => {
  const [mantissa, power] = t.replace('−', '-').split(' × 10');
  const exponent = [...(power ?? '⁰')].map(c => c === '⁻' ? '-' : '⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(c)).join('');
  return Number(`${mantissa}e${exponent}`);
});
const isNear = (a, b) => Math.abs(a - b) <= 2e-3 * Math.abs(b);

async function plots() {
  // r(d), as recovered from the image, is what result.json holds.
  const knots = JSON.parse(readFileSync(join(folder, 'result.json'))).results[0].reflectance.knots
    .filter(k => k.determined);
  const plot = page.locator('[data-widget="plot"]').first();
  await plot.scrollIntoViewIfNeeded();
  const readout = plot.locator('output');
  const data = JSON.parse(await plot.locator('script').textContent());
  const series = data.series.findIndex(s => s.name === 'image alone');
  await plot.locator('.plot').focus();
  for (let i = 0; i < series; ++i) await page.keyboard.press('ArrowDown');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowLeft');
  const byKeys = numbersIn(await readout.textContent());
  assert.ok(knots.some(k => isNear(byKeys[0], k.distance_mm) && isNear(byKeys[1], k.r_per_mm2)),
            `${await readout.textContent()} is in no knot`);
  // By the pointer: the middle of the plot's area is near some point of the curve or its line.
  const over = plot.locator('.u-over');
  const box = await over.boundingBox();
  const texts = new Set();
  for (let i = 1; i < 12; ++i) {
    await page.mouse.move(box.x + box.width * i / 12, box.y + box.height * (0.1 + 0.8 * i / 12));
    texts.add(await readout.textContent());
  }
  assert.ok(texts.size > 3, `hovering says ${[...texts]}`);
  const read = [...texts].filter(t => t.startsWith('image alone')).map(numbersIn);
  for (const [d, r] of read) assert.ok(knots.some(k => isNear(d, k.distance_mm) && isNear(r, k.r_per_mm2)), `${d} ${r}`);
  // Dragging zooms, 0 shows all again; the dark draws it anew.
  const canvas = plot.locator('canvas');
  const whole = await seen(canvas);
  await page.mouse.move(box.x + 60, box.y + 20);
  await page.mouse.down();
  await page.mouse.move(box.x + 200, box.y + 100, {steps: 4});
  await page.mouse.up();
  assert.notEqual(await seen(canvas), whole, 'dragging does not zoom');
  await page.mouse.move(0, 0);
  await plot.locator('.plot').focus();
  await page.keyboard.press('0');
  await page.keyboard.press('Escape');
  const light = await seen(canvas);
  await page.keyboard.press('+');
  assert.notEqual(await seen(canvas), light, 'plus does not zoom');
  await page.keyboard.press('0');
  assert.equal(await seen(canvas), light, '0 does not show all again');
  await page.emulateMedia({colorScheme: 'dark'});
  // Drawn anew in the browser's own time, as the table below is filled.
  await page.waitForFunction(([e, before]) => e.toDataURL() !== before, [await canvas.elementHandle(), light]);
  await page.emulateMedia({colorScheme: 'light'});
  await plot.locator('summary').click();
  await plot.locator('tbody tr').first().waitFor();
  assert.equal(await plot.locator('tbody tr').count(), data.series.reduce((n, s) => n + s.x.length, 0));
}

// A map of LED positions: cells with values, as wide as high.
async function ledMap() {
  const plot = page.locator('[data-widget="plot"]').first();
  await plot.scrollIntoViewIfNeeded();
  const data = JSON.parse(await plot.locator('script').textContent());
  const cells = data.series.find(s => s.style === 'cells');
  const box = await plot.locator('.u-over').boundingBox();
  await page.mouse.move(box.x + box.width * 0.42, box.y + box.height * 0.44);
  const [x, y, value] = numbersIn(await plot.locator('output').textContent());
  const i = cells.x.findIndex((v, k) => isNear(v, x) && isNear(cells.y[k], y));
  assert.ok(i >= 0 && isNear(value, cells.value[i]), await plot.locator('output').textContent());
  assert.ok(x < 0 && y > 0, 'left of the middle and above it');
}

async function maps() {
  const widget = page.locator('[data-widget="maps"]').first();
  await widget.scrollIntoViewIfNeeded();
  const data = JSON.parse(await widget.locator('script').textContent());
  const small = widget.locator('.overview button');
  await page.waitForFunction(n => document.querySelectorAll('.overview button').length >= n, data.shots.length);
  const panels = widget.locator('.panels');
  const difference = widget.locator('.panel canvas').nth(2);
  const readout = widget.locator('output');
  const zoom = async () => Number(await panels.getAttribute('data-zoom'));
  assert.equal(await zoom(), 1);
  // The model is the observation without the difference.
  const box = await difference.boundingBox();
  await page.mouse.move(box.x + box.width * 0.4, box.y + box.height * 0.3);
  const text = await readout.textContent();
  assert.match(text, /patch \d+, observed/);
  const [, , , observed, model, change] = numbersIn(text.replace('+', ''));
  assert.ok(Math.abs(observed - model - change) < 0.02, text);
  const whole = await seen(difference);
  await page.mouse.wheel(0, -400);
  await page.waitForFunction(() => Number(document.querySelector('.panels').dataset.zoom) > 2);
  const zoomed = await seen(difference);
  assert.notEqual(zoomed, whole);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.6, box.y + box.height * 0.5, {steps: 3});
  await page.mouse.up();
  assert.notEqual(await seen(difference), zoomed, 'dragging does not move the map');
  await panels.focus();
  await page.keyboard.press('0');
  assert.equal(await zoom(), 1);
  const before = await readout.textContent();
  await page.keyboard.press('ArrowRight');
  assert.notEqual(await readout.textContent(), before);
  await page.keyboard.press('+');
  assert.ok(await zoom() > 1.5);
  await widget.getByLabel('zoom out').click();
  await widget.getByLabel('show all').click();
  // Another channel and another shot show another map.
  const first = await seen(difference);
  await widget.getByLabel('channel').selectOption('G');
  await page.waitForFunction(() => document.querySelector('.overview [aria-pressed="true"]')?.ariaLabel.includes(' G'));
  assert.notEqual(await seen(difference), first);
  await small.last().click();
  const last = data.shots.at(-1);
  await page.waitForFunction(n => document.querySelector('[data-widget="maps"] select').value === n, last.file);
}

// Two fingers take hold of a map, part, come together again, and one of them moves on.
async function fingers() {
  const widget = page.locator('[data-widget="maps"]').first();
  const difference = widget.locator('.panel canvas').nth(2);
  await difference.scrollIntoViewIfNeeded();
  await widget.getByLabel('show all').click();
  const zoom = async () => Number(await widget.locator('.panels').getAttribute('data-zoom'));
  const box = await difference.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const readInTheMiddle = async () => {
    await page.mouse.move(x + 1, y + 1);
    return (await widget.locator('output').textContent()).match(/^x (\d+) y (\d+) px/).slice(1).map(Number);
  };
  const session = await page.context().newCDPSession(page);
  const touch = (type, ...at) => session.send('Input.dispatchTouchEvent', {
    type, touchPoints: at.map(([dx, dy], id) => ({x: x + dx, y: y + dy, id})),
  });
  const middle = await readInTheMiddle();
  await touch('touchStart', [-20, 0], [20, 0]);
  for (const apart of [25, 30, 40, 50, 60]) await touch('touchMove', [-apart, 0], [apart, 0]);
  await page.waitForFunction(() => Number(document.querySelector('.panels').dataset.zoom) > 2.9);
  assert.ok(isNear(await zoom(), 3), `two fingers zoom by ${await zoom()}`);
  await touch('touchEnd');
  for (const [i, v] of (await readInTheMiddle()).entries()) {
    assert.ok(Math.abs(v - middle[i]) <= 3, `what is between the fingers has moved from ${middle} to ${v}`);
  }
  // The whole grip moves the map, and so does one finger.
  for (const start of [[[-20, 0], [20, 0]], [[0, 0]]]) {
    const before = await seen(difference);
    await touch('touchStart', ...start);
    await touch('touchMove', ...start.map(([dx, dy]) => [dx + 12, dy + 12]));
    await touch('touchEnd');
    assert.notEqual(await seen(difference), before);
    assert.ok(isNear(await zoom(), 3));
  }
  await touch('touchStart', [-60, 0], [60, 0]);
  for (const apart of [40, 20, 10]) await touch('touchMove', [-apart, 0], [apart, 0]);
  await touch('touchEnd');
  assert.equal(await zoom(), 1);
}

async function rig() {
  const widget = page.locator('[data-widget="rig"]').first();
  await widget.scrollIntoViewIfNeeded();
  const view = widget.locator('.rig');
  const angles = async () => [await view.getAttribute('data-azimuth'), await view.getAttribute('data-elevation')].map(Number);
  assert.ok(await view.locator('path').count() > 100, 'the object is not drawn');
  assert.ok(await view.locator('svg').getByText('led1', {exact: true}).count() === 1);
  const before = await seen(view.locator('svg'));
  const [azimuth, elevation] = await angles();
  const box = await view.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2 + 20, {steps: 3});
  await page.mouse.up();
  assert.deepEqual(await angles(), [azimuth - 30, elevation + 10]);
  assert.notEqual(await seen(view.locator('svg')), before);
  await view.focus();
  await page.keyboard.press('ArrowRight');
  assert.deepEqual(await angles(), [azimuth - 25, elevation + 10]);
  await page.keyboard.press('0');
  assert.deepEqual(await angles(), [azimuth, elevation]);
  assert.equal(await page.locator('summary', {hasText: /^positions$/}).count(), 1);
}

// Every plot of a calibration reads out its own points and lists them all.
async function everyPlot() {
  const plots = page.locator('[data-widget="plot"]');
  assert.ok(await plots.count() > 0, 'no plot');
  for (const plot of await plots.all()) {
    await plot.scrollIntoViewIfNeeded();
    const {series} = JSON.parse(await plot.locator('script').textContent());
    await plot.locator('.plot').focus();
    await page.keyboard.press('ArrowRight');
    const text = await plot.locator('output').textContent();
    const shows = v => numbersIn(text).some(n => isNear(n, v));
    assert.ok(series.some(s => s.x.some((v, i) => shows(v) && shows(s.y[i]))), `${text} is in no series`);
    await plot.locator('summary').click();
    await plot.locator('tbody tr').first().waitFor();
    assert.equal(await plot.locator('tbody tr').count(), series.reduce((n, s) => n + s.x.length, 0));
  }
}

const looks = {result: [plots, maps, fingers, rig], check: [rig], plan: [rig, ledMap], compare: [], watch: []};
for (const name of names) {
  await open(name);
  for (const part of looks[basename(name)] ?? [everyPlot]) await part();
  await lookAtAll(name);
  assert.deepEqual(complaints, [], name);
}
await browser.close();
