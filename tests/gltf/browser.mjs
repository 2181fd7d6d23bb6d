// Opens our pages and files in Chromium and looks at the pixels.
//   node browser.mjs NPM-FOLDER SAMPLES DIFMESH CHROMIUM

import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {createServer} from 'node:http';
import {createRequire} from 'node:module';
import {dirname, join} from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';
import {inflateSync} from 'node:zlib';

const [npm, samples, difmesh, chromium] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const require = createRequire(join(npm, 'package.json'));
const esbuild = require('esbuild');
const playwright = require('playwright-core');

const kSize = {width: 640, height: 480};
const kBackground = [0xee, 0xf1, 0xf5];
const kRadius = 1.5;

let checks = 0;
let failures = 0;
function check(truth, what, words) {
  ++checks;
  if (!truth) {
    ++failures;
    console.error(`${what}: ${words}`);
  }
}

/// The rows of a PNG of 8 bits without interlacing.
function pixelsOf(png) {
  const [width, height] = [png.readUInt32BE(16), png.readUInt32BE(20)];
  const channels = png[25] === 6 ? 4 : 3;
  const parts = [];
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at)) {
    if (png.toString('latin1', at + 4, at + 8) === 'IDAT') {
      parts.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
    }
  }
  const raw = inflateSync(Buffer.concat(parts));
  const stride = width * channels;
  const out = Buffer.alloc(stride * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (stride + 1)];
    for (let x = 0; x < stride; ++x) {
      const left = x >= channels ? out[y * stride + x - channels] : 0;
      const up = y > 0 ? out[(y - 1) * stride + x] : 0;
      const corner = x >= channels && y > 0 ? out[(y - 1) * stride + x - channels] : 0;
      const guess = left + up - corner;
      const [a, b, c] = [left, up, corner].map((value) => Math.abs(guess - value));
      const paeth = a <= b && a <= c ? left : b <= c ? up : corner;
      const base = [0, left, up, (left + up) >> 1, paeth][filter];
      out[y * stride + x] = (raw[y * (stride + 1) + 1 + x] + base) & 255;
    }
  }
  return {width, height, at: (x, y) => [...out.subarray((y * width + x) * channels,
    (y * width + x) * channels + 3)]};
}

/// Pixels that are not background, between two columns.
function covered(image, from = 0, to = image.width) {
  let count = 0;
  for (let y = 0; y < image.height; ++y) {
    for (let x = from; x < to; ++x) {
      count += image.at(x, y).some((value, c) => Math.abs(value - kBackground[c]) > 6) ? 1 : 0;
    }
  }
  return count;
}

/// The area of a ball's silhouette: a circle of the angle asin(R/d) about the line of sight.
function silhouette({distance, fov}) {
  const focal = kSize.height / 2 / Math.tan(fov * Math.PI / 360);
  return Math.PI * (focal * kRadius) ** 2 / (distance ** 2 - kRadius ** 2);
}

function near(found, wanted, what) {
  check(Math.abs(found - wanted) <= 0.02 * wanted, what, `${found} pixels, not ${wanted}`);
}

const browser = await playwright.chromium.launch({executablePath: chromium, args: ['--no-sandbox',
  '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync', '--enable-unsafe-swiftshader']});

/// A page at an address, once it says that it is ready.
async function open(url, what) {
  const page = await browser.newPage({viewport: kSize});
  const said = [];
  const asked = [];
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) &&
    !message.text().includes('GPU stall due to ReadPixels') && said.push(message.text()));
  page.on('pageerror', (error) => said.push(String(error)));
  page.on('request', (request) => asked.push(request.url()));
  await page.goto(url);
  await page.waitForSelector('body[data-state]', {state: 'attached', timeout: 60000});
  check(await page.evaluate(() => document.body.dataset.state) === 'ready', what, 'not ready');
  return {page, said, asked};
}

async function picture(page) {
  return pixelsOf(await page.screenshot());
}

const eye = (page) => page.evaluate(() => ({distance: window.difmesh.camera.position.length(),
  fov: window.difmesh.camera.fov}));

function view(name, ...words) {
  const path = join(samples, `${name}.html`);
  execFileSync(difmesh, ['view', ...words, '-o', path, '--quiet']);
  return pathToFileURL(path).href;
}

async function onePage() {
  const what = 'view of one surface';
  const {page, said, asked} = await open(view('one', join(samples, 'plain.glb')), what);
  await page.addStyleTag({content: '#panel, .name { display: none }'});
  const plain = await picture(page);
  near(covered(plain), silhouette(await eye(page)), what);
  // Colours by height: dark blue below, yellow above.
  await page.evaluate(() => {
    document.getElementById('scalars').value = 'z';
    document.getElementById('scalars').dispatchEvent(new Event('change'));
  });
  // The camera looks from (0.5, 0.35, 0.8) with y up, and z of the mesh towards it.
  const colored = await picture(page);
  const yellow = (image) => {
    let count = 0;
    for (let y = 0; y < image.height; ++y) {
      for (let x = 0; x < image.width; ++x) {
        const [r, g, b] = image.at(x, y);
        count += r > b + 60 && g > b + 60 ? 1 : 0;
      }
    }
    return count;
  };
  check(yellow(plain) === 0 && yellow(colored) > 1000, what, 'colors do not show');
  check(await page.evaluate(() => document.getElementById('low').value) === '-1.5', what, 'legend');
  near(covered(colored), silhouette(await eye(page)), what);
  const far = await eye(page);
  await page.mouse.move(320, 240);
  await page.mouse.wheel(0, -300);
  await page.waitForTimeout(100);
  const close = await eye(page);
  check(close.distance < 0.95 * far.distance, what,
    `the wheel leaves the eye at ${close.distance}`);
  // Dragging turns a ball into itself.
  await page.mouse.down();
  await page.mouse.move(420, 200, {steps: 4});
  await page.mouse.up();
  const turned = await page.evaluate(() => window.difmesh.camera.position.x);
  check(turned < 0.4 * close.distance, what, `dragging leaves the eye at x = ${turned}`);
  near(covered(await picture(page)), silhouette(close), `${what}, closer`);
  check(said.length === 0, what, said.join('; '));
  check(asked.length === 1, what, `fetches ${asked.slice(1)}`);
  await page.close();
}

async function wires() {
  const what = 'wireframe of a triangle';
  const {page, said} = await open(view('wires', join(samples, 'triangle.glb')), what);
  await page.addStyleTag({content: '#panel { display: none }'});
  const filled = covered(await picture(page));
  await page.evaluate(() => document.getElementById('wireframe').click());
  const drawn = covered(await picture(page));
  check(filled > 5000 && drawn > 200 && drawn < 0.2 * filled, what,
    `${drawn} pixels of ${filled}`);
  check(said.length === 0, what, said.join('; '));
  await page.close();
}

async function twoSurfaces() {
  const what = 'view of two surfaces';
  const {page, said, asked} = await open(view('two', join(samples, 'plain.glb'),
    join(samples, 'draco.glb'), '--color-by', 'angle'), what);
  await page.addStyleTag({content: '#panel, .name { display: none }'});
  const both = await picture(page);
  const wanted = silhouette(await eye(page));
  near(covered(both, 0, 320), wanted, `${what}, left`);
  near(covered(both, 320, 640), wanted, `${what}, right`);
  await page.evaluate(() => document.querySelector('[name=shown][value="1"]').click());
  near(covered(await picture(page)), wanted, `${what}, the second`);
  check(said.length === 0, what, said.join('; '));
  check(asked.length === 1, what, `fetches ${asked.slice(1)}`);
  await page.close();
}

/// Our files in a page that is not ours.
async function plainPages() {
  const bundle = await esbuild.build({entryPoints: [join(here, 'plain_page.js')],
    nodePaths: [join(npm, 'node_modules')], bundle: true, write: false, format: 'iife'});
  const html = '<!DOCTYPE html><link rel="icon" href="data:,"><style>body { margin: 0 }</style>' +
    '<body><script src="/page.js"></script>';
  const draco = join(npm, 'node_modules/three/examples/jsm/libs/draco/gltf');
  const server = createServer((request, response) => {
    const path = new URL(request.url, 'http://localhost').pathname;
    try {
      const [, folder, name] = path.split('/');
      const body = path === '/' ? html : path === '/page.js' ? bundle.outputFiles[0].text :
        readFileSync(join(folder === 'draco' ? draco : samples, name));
      const type = path === '/' ? 'text/html' : path.endsWith('.js') ? 'text/javascript' :
        path.endsWith('.wasm') ? 'application/wasm' : 'application/octet-stream';
      response.writeHead(200, {'content-type': type}).end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  for (const file of ['plain.glb', 'plain.gltf', 'colors.glb', 'split.glb', 'z_up.glb', 'far.glb',
    'draco.glb', 'draco_11.gltf', 'draco_sequential.glb', 'draco_split.glb', 'draco_far.glb',
    'draco_colors.glb']) {
    const url = `http://127.0.0.1:${server.address().port}/?file=/samples/${file}`;
    const {page, said} = await open(url, file);
    const size = await page.evaluate(() => window.difmesh.size);
    // Far away or in millimetres, the ball is as large as its box says.
    const scale = 2 * kRadius / size[1];
    const {distance, fov} = await eye(page);
    near(covered(await picture(page)), silhouette({distance: distance * scale, fov}), file);
    check(said.length === 0, file, said.join('; '));
    await page.close();
  }
  server.close();
}

try {
  await onePage();
  await wires();
  await twoSurfaces();
  await plainPages();
} finally {
  await browser.close();
}
console.log(`${checks} checks, ${failures} failed`);
process.exit(failures > 0 ? 1 : 0);
