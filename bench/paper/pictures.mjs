// Draws the pictures of a run: meshes by `difmesh view` in Chromium, side by side on sheets with
// captions.
//   node pictures.mjs NPM-FOLDER DIFMESH CHROMIUM FOLDER
// reads FOLDER/pictures/sheets.json, writes FOLDER/*.jpg.

import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

const [npm, difmesh, chromium, folder] = process.argv.slice(2);
const require = createRequire(resolve(npm, 'package.json'));
const playwright = require('playwright-core');
const sheets = JSON.parse(readFileSync(join(folder, 'pictures/sheets.json'), 'utf8'));

const browser = await playwright.chromium.launch({executablePath: chromium, args: ['--no-sandbox',
  '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync', '--enable-unsafe-swiftshader']});

/// A surface by itself, as PNG.
async function picture({file, color, range}, {size, zoom, from, raking}) {
  const page = join(folder, 'pictures', `${file}.html`);
  const colors = color ? ['--color-by', color, '--color-map', 'cool_warm', '--color-range',
    `${-range},${range}`] : [];
  execFileSync(difmesh, ['view', join(folder, 'pictures', file), '-o', page, '--quiet',
    ...colors]);
  const tab = await browser.newPage({viewport: {width: size, height: size}, deviceScaleFactor: 2});
  await tab.goto(pathToFileURL(resolve(page)).href);
  await tab.waitForSelector('body[data-state]', {state: 'attached', timeout: 60000});
  if (await tab.evaluate(() => document.body.dataset.state) !== 'ready') {
    throw new Error(`${file}: the page is not ready`);
  }
  await tab.addStyleTag({content: '#panel, .name { display: none }'});
  await tab.evaluate(({zoom, from, raking}) => {
    const {camera, controls, scene} = window.difmesh;
    if (raking) {  // what stands out by less than a cell shows in light from the side
      scene.traverse((node) => {
        if (node.isHemisphereLight) {
          node.intensity = 0.3;
        } else if (node.isDirectionalLight) {
          node.position.set(-1.2, 0.9, 0.1);
          node.intensity = 4;
        }
      });
    }
    const distance = camera.position.length() / zoom;
    camera.position.set(...from).setLength(distance);
    controls.update();
    window.difmesh.draw();
  }, {zoom, from, raking});
  const image = await tab.screenshot();
  await tab.close();
  return image.toString('base64');
}

/// All surfaces of a sheet in rows.
async function sheet({name, panels, columns, view}) {
  const figures = [];
  for (const panel of panels) {
    const image = await picture(panel, view);
    figures.push(`<figure><img src="data:image/png;base64,${image}" width="${view.size}"
      height="${view.size}"><figcaption>${panel.caption}</figcaption></figure>`);
  }
  const tab = await browser.newPage({viewport: {width: columns * view.size, height: 100}});
  await tab.setContent(`<!DOCTYPE html><meta charset="utf-8"><style>
    body { margin: 0; background: #eef1f5; font: 14px sans-serif; color: #222 }
    main { display: grid; grid-template-columns: repeat(${columns}, ${view.size}px) }
    figure { margin: 0; text-align: center } figcaption { padding: 2px 0 8px }
    </style><main>${figures.join('')}</main>`);
  await tab.screenshot({path: join(folder, `${name}.jpg`), type: 'jpeg', quality: 80,
    fullPage: true});
  await tab.close();
}

try {
  for (const one of sheets) {
    await sheet(one);
  }
} finally {
  await browser.close();
}
