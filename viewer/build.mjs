// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// Builds dist/viewer.html, the page without its data, from src/. With --check it only tells whether
// the file that is there is the one that would be built.

import { createHash } from 'node:crypto';
import { readFile, readdir, writeFile, mkdir } from 'node:fs/promises';
import { build } from 'esbuild';

const target = new URL('dist/viewer.html', import.meta.url);
const read = (path) => readFile(new URL(path, import.meta.url), 'utf8');

async function bundle(path) {
  const { outputFiles } = await build({
    entryPoints: [new URL(path, import.meta.url).pathname],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: 'es2022',
    charset: 'ascii',
    legalComments: 'none',
  });
  return outputFiles[0].text.trim();
}

/** The licence of the library inside, as a comment that stays with it. */
async function licence() {
  const text = await read('node_modules/three/LICENSE');
  return `/*! This page contains three.js.\n\n${text.trim()}\n*/\n`;
}

/** Only the script and the style of the page itself are obeyed, and nothing is ever loaded. */
function policy(script, style) {
  const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
  const rules = `default-src 'none'; script-src ${hash(script)}; style-src ${hash(style)}; base-uri 'none'; form-action 'none'`;
  return `<meta http-equiv="Content-Security-Policy" content="${rules}">`;
}

/** What the page is built from, as one hash: tests/page/check_bundle.py takes it without node. */
async function sources() {
  const names = (await readdir(new URL('src/', import.meta.url))).sort().map((name) => `src/${name}`);
  const hash = createHash('sha256');
  for (const name of ['build.mjs', 'package-lock.json', ...names]) {
    const bytes = await readFile(new URL(name, import.meta.url));
    hash.update(`${name} ${bytes.length}\n`).update(bytes);
  }
  return hash.digest('hex');
}

function check(html) {
  for (const marker of ['<!--crease:title-->', '<!--crease:data-->'])
    if (html.split(marker).length !== 2) throw new Error(`${marker} must stand in the page exactly once`);
}

function checkScript(script) {
  if (/<\/script|<!--/i.test(script)) throw new Error('the script would end or hide inside its element');
}

async function page() {
  const script = `${await licence()}${await bundle('src/main.js')}\n`;
  const style = `${await bundle('src/style.css')}\n`;
  checkScript(script);
  const parts = { source: await sources(), policy: policy(script, style), style, script };
  const html = (await read('src/page.html')).replace(/@(source|policy|style|script)@/g, (_, name) => parts[name]);
  check(html);
  return html;
}

const html = await page();
if (!process.argv.includes('--check')) {
  await mkdir(new URL('.', target), { recursive: true });
  await writeFile(target, html);
} else if ((await readFile(target, 'utf8').catch(() => '')) !== html) {
  console.error('viewer/dist/viewer.html is not built from viewer/src: run `npm run build` in viewer/ and commit it');
  process.exitCode = 1;
}
