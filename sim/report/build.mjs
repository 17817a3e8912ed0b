// SPDX-License-Identifier: Apache-2.0
//
// Bundles the page and its libraries into one file: node build.mjs SOURCES TEMPLATE. Run in a folder where
// package.json's packages are installed.
import { build } from 'esbuild';
import { readFileSync, renameSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';

const [sources, target] = process.argv.slice(2);
const modules = resolve('node_modules');
const bundle = async (name, loader) => {
  const result = await build({
    entryPoints: [join(sources, name)], bundle: true, minify: true, write: false, format: 'iife', target: 'es2022',
    legalComments: 'none', nodePaths: [modules], charset: 'ascii', loader,
  });
  return result.outputFiles[0].text;
};

/** Inside an element of its own, code must not end it. */
const code = (text) => text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
const licences = ['chart.js/LICENSE.md', 'fflate/LICENSE', 'three/LICENSE']
  .map((name) => `${name.split('/')[0]}\n\n${readFileSync(join(modules, name), 'utf8').replaceAll('--', '- -')}`)
  .join('\n\n');
const parts = { STYLE: await bundle('style.css'), SCRIPT: code(await bundle('main.js')), LICENCES: licences };
const page = readFileSync(join(sources, 'index.html'), 'utf8').replace(/@(STYLE|SCRIPT|LICENCES)@/g, (_, name) => parts[name]);
writeFileSync(`${target}.part`, page);
renameSync(`${target}.part`, target);
