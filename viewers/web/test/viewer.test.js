// The page in a headless Chromium, on a solution that the program bakes and serves.
//   TRANSILLUM the program, SCENE what it bakes, CHROMIUM the browser, WORK a folder for files
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { after, before, test } from 'node:test';
import validator from 'gltf-validator';
import { differenceFrom, drop, launch, said, visit } from './browser.js';

const { TRANSILLUM, SCENE, WORK } = process.env;
const work = (name) => path.join(WORK, name);
const run = (...words) => execFileSync(TRANSILLUM, words, { cwd: WORK, stdio: ['ignore', 'pipe', 'inherit'] });
const stops = 1.5;

let browser, server, url;

before(async () => {
  fs.rmSync(WORK, { recursive: true, force: true });
  fs.mkdirSync(WORK, { recursive: true });
  run('-q', 'bake', SCENE, '-o', 'box.vtm', '--leaves', '2000', '--iterations', '64', '--refine', '1');
  run('-q', 'export', 'box.vtm', '-o', 'box.glb', '-o', 'box.ply', '-o', 'flat.vtp',
    '--no-auto-exposure', '--exposure', String(stops));
  run('-q', 'export', 'box.vtm', '-o', 'lightmap.glb', '--lightmap', 'lightmap.exr');
  // As the page shows it: a radiance a patch, and no shadow rays.
  for (const [name, more] of [['flat', ['--flat']], ['smooth', []]])
    run('-q', 'render', 'box.vtm', '-o', `${name}.png`, '--camera', 'front', '--size', '500x500', '--direct',
      'stored', '--no-auto-exposure', '--exposure', String(stops), ...more);
  server = spawn(TRANSILLUM, ['-q', 'serve', 'box.vtm', '--port', '0'], { cwd: WORK });
  url = await new Promise((ok) => server.stdout.once('data', (line) => ok(String(line).trim())));
  browser = await launch();
});

after(async () => {
  await browser?.close();
  server?.kill('SIGINT');
});

const expose = (page) => page.evaluate((s) => {
  const shown = window.transillum.page;
  for (const array of shown.mesh.arrays) shown.stops.set(array.name, s);
  shown.colour();
}, stops);

test('shows a served solution as the program renders it', async () => {
  const page = await visit(browser, url);
  assert.equal(await said(page), '');
  const { arrays, cameras } = await page.evaluate('({ ...transillum, page: null, open: null })');
  assert.deepEqual(cameras, ['front', 'corner']);
  for (const name of ['Radiance', 'DirectRadiance', 'FiniteElementRadiance', 'StandardError', 'Level'])
    assert.ok(arrays.includes(name), name);
  await expose(page);
  const difference = await differenceFrom(page, fs.readFileSync(work('flat.png')));
  assert.ok(difference < 0.02, `mean difference ${difference}`);
  // The other way round is something else: the comparison sees what is shown.
  await page.select('#camera', '1');
  assert.ok((await differenceFrom(page, fs.readFileSync(work('flat.png')))) > 0.05);
  await page.close();
});

test('shows other values by a labelled map', async () => {
  const page = await visit(browser, url);
  assert.ok(await page.$eval('#bar', (bar) => bar.hidden));
  const number = await page.evaluate('transillum.arrays.indexOf("StandardError")');
  await page.select('#array', String(number));
  assert.match(await page.$eval('#unit', (unit) => unit.textContent), /W sr/);
  const ticks = await page.$eval('#ticks', (t) => [...t.children].map((c) => parseFloat(c.textContent.replace(/[≤≥]/, ''))));
  assert.ok(ticks[0] >= 0 && ticks[1] > ticks[0] && ticks[2] > ticks[1], String(ticks));
  assert.ok(await page.$eval('#exposure-row', (row) => row.hidden));
  await page.close();
});

test('walks by keys', async () => {
  const page = await visit(browser, url);
  const eye = () => page.evaluate('[...transillum.page.view.camera.getPosition()]');
  const before = await eye();
  await page.keyboard.press('w', { delay: 100 });
  assert.deepEqual(await eye(), before, 'not in orbit');
  await page.click('#walk');
  await page.keyboard.press('w', { delay: 300 });
  const after = await eye();
  assert.ok(after[2] > before[2] + 1, `${before} to ${after}: forward is along z`);
  await page.close();
});

test('opens what is dropped: a solution with its pieces, and each export', async () => {
  const page = await visit(browser, url);
  const file = (name) => [path.basename(name), fs.readFileSync(work(name))];
  await drop(page, [file('box.vtm'), file('box/radiance.vtp'), file('box/surface.vtp')]);
  assert.equal(await said(page), '');
  const look = await page.evaluate('transillum.page.mesh.cameras[0]');
  for (const name of ['flat.vtp', 'box.glb', 'box.ply']) {
    await drop(page, [file(name)]);
    assert.equal(await said(page), '', name);
    await expose(page);
    await page.evaluate((camera) => window.transillum.page.view.look(camera), look);
    const difference = await differenceFrom(page, fs.readFileSync(work('smooth.png')));
    assert.ok(difference < 0.02, `${name}: mean difference ${difference}`);
  }
  await page.close();
});

test('names what is wrong with a file', async () => {
  const page = await visit(browser, url);
  const index = fs.readFileSync(work('box.vtm'), 'utf8');
  const radiance = ['radiance.vtp', fs.readFileSync(work('box/radiance.vtp'))];
  const wrong = (head) => fs.readFileSync(work('box/radiance.vtp'), 'latin1').replace(head[0], head[1]);
  const cases = [
    [[['other.vtm', index.replace(/ transillum_format="\d+"/, '')]], /other\.vtm: was not written by transillum/],
    [[['text.vtm', 'hello']], /text\.vtm: is no VTK multi-block file/],
    [[['box.vtm', index]], /box\/radiance\.vtp: is missing/],
    [[['box.vtm', index], radiance], /box\/surface\.vtp: is missing/],
    [[['cut.vtp', radiance[1].subarray(0, 5000)]], /cut\.vtp: cannot be read/],
    [[['cells.vtp', Buffer.from(wrong([/(Name="Radiance" NumberOfComponents=)"3"/, '$1"1"']), 'latin1')]],
      /cells\.vtp: array 'Radiance' holds .* accepted: \d+, one a cell/],
    [[['cut.glb', fs.readFileSync(work('box.glb')).subarray(0, 5000)]], /cut\.glb: is no whole binary glTF/],
    [[['other.glb', Buffer.from(fs.readFileSync(work('box.glb'), 'latin1').replace('"transillum"', '"something_"'), 'latin1')]],
      /other\.glb: is of another program/],
    [[['lightmap.glb', fs.readFileSync(work('lightmap.glb'))]], /lightmap\.glb: holds no COLOR_0, as with a lightmap/],
    [[['cut.ply', fs.readFileSync(work('box.ply')).subarray(0, 5000)]], /cut\.ply: is no whole PLY/],
    [[['picture.png', 'x']], /picture\.png: cannot be opened; accepted: .*\.vtp/],
  ];
  for (const [files, expected] of cases) {
    await drop(page, files);
    assert.match(await said(page), expected);
    assert.ok(await page.$eval('#panel', (panel) => panel.hidden));
  }
  await page.close();
});

test('says so where there is no WebGL', async () => {
  const blind = await launch({ without: true });
  const page = await visit(blind, url);
  assert.match(await said(page), /no WebGL 2/);
  await blind.close();
});

test('serves nothing but the page and the solution, to this machine', async () => {
  const status = async (at) => (await fetch(new URL(at, url))).status;
  fs.writeFileSync(work('secret.txt'), 'secret');
  fs.symlinkSync(work('secret.txt'), work('box/link.txt'));
  assert.equal(await status('solution/box/radiance.vtp'), 200);
  for (const at of ['solution/secret.txt', 'solution/box/..%2f..%2fsecret.txt', 'solution/box/link.txt',
    'solution/box/', 'share/', '%2e%2e/secret.txt'])
    assert.equal(await status(at), 404, at);
  // A page of another site, by a name that it lets stand for this machine. (fetch sets Host itself.)
  const foreign = await new Promise((ok) => {
    http.get(url, { headers: { Host: 'elsewhere.example' } }, (answer) => ok(answer.statusCode));
  });
  assert.equal(foreign, 403);
  assert.ok(url.startsWith('http://127.0.0.1:'));
});

test('export writes glTF that the Khronos validator passes', async () => {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(work('box.glb'))));
  assert.deepEqual(report.issues.messages, []);
  assert.equal(report.issues.numErrors + report.issues.numWarnings, 0);
  assert.ok(report.info.totalTriangleCount > 2000);
});

test('export with a lightmap writes glTF that the Khronos validator passes', async () => {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(work('lightmap.glb'))));
  // The first set of UVs is for what textures the program adds.
  assert.deepEqual([...new Set(report.issues.messages.map((m) => m.code))], ['UNUSED_OBJECT']);
  assert.equal(report.issues.numErrors + report.issues.numWarnings, 0);
  assert.ok(report.info.totalTriangleCount < 100);
  assert.equal(report.info.resources.at(-1).image.format, 'rgb');
});
