// Makes the page of `difmesh view` one piece, and C++ that holds it.
//   node build.mjs NPM-FOLDER OUT.cpp

import {readFileSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const [npm, out] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const esbuild = createRequire(join(npm, 'package.json'))('esbuild');

const bundle = await esbuild.build({
  entryPoints: [join(here, 'view/view.js')],
  nodePaths: [join(npm, 'node_modules')],
  bundle: true,
  minify: true,
  write: false,
  format: 'iife',
  target: 'es2022',
  charset: 'ascii',
  legalComments: 'inline',
  logLevel: 'warning',
});
// A script ends at the first </script, whatever it means in JavaScript.
const script = bundle.outputFiles[0].text.replaceAll('</script', '<\\/script');
const licence = readFileSync(join(npm, 'node_modules/three/LICENSE'), 'utf8');
const page = readFileSync(join(here, 'view/page.html'), 'utf8')
  .replace('<!--SCRIPT-->', () => `/* three.js: ${licence.replaceAll('*/', '* /')} */\n${script}`);
const [before, after] = page.split('<!--SCENE-->');

/// Compilers bound the length of one literal; they join neighbours.
function literal(text) {
  const parts = text.match(/[^]{1,8000}/g).map((part) => `R"PAGE(${part})PAGE"`);
  return parts.join('\n');
}
writeFileSync(out, `// Made by web/build.mjs.
#include "view_page.hpp"
namespace difmesh::cli {
const std::string_view kPageBeforeScene =
${literal(before)};
const std::string_view kPageAfterScene =
${literal(after)};
}  // namespace difmesh::cli
`);
