// SPDX-License-Identifier: BSD-3-Clause
// Makes report_page.html: the page with its style, its program and three.js, all inline.
// The library fills in the data of a run. Run by `npm ci && npm run build`.
import {readFileSync, writeFileSync} from 'node:fs';
import {fileURLToPath} from 'node:url';
import {build} from 'esbuild';

const here = fileURLToPath(new URL('.', import.meta.url));
const target = process.argv[2] ?? here + 'report_page.html';

async function bundled(entry) {
  const result = await build({
    entryPoints: [here + entry],
    absWorkingDir: here,
    bundle: true,
    minify: true,
    format: 'iife',
    target: 'es2020',
    charset: 'ascii',
    legalComments: 'inline',
    write: false,
  });
  const text = result.outputFiles[0].text.trim();
  if (/<\/(script|style)/i.test(text)) throw new Error(entry + ' would end its element');
  return text;
}

const [style, program] = await Promise.all([bundled('src/style.css'), bundled('src/main.js')]);
const page = readFileSync(here + 'src/page.html', 'utf8')
  .replace('/* style */', () => style)
  .replace('/* program */', () => program);
writeFileSync(target, page);
console.log(`${target}: ${(page.length / 1e3).toFixed(0)} kB`);
