// SPDX-License-Identifier: BSD-3-Clause
// Makes report_page.html: the page with its style, its program and three.js, all inline.
// The library fills in the data of a run. Run by `npm ci && npm run build`.
import {createHash} from 'node:crypto';
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
// The page loads nothing, sends nothing and runs its own programs alone: a browser knows them by
// their hashes, so that no text of a run can become one.
function policyOf(page) {
  const hashes = [...page.matchAll(/<script>([^]*?)<\/script>/g)].map(
      ([, text]) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`);
  return ["default-src 'none'", `script-src ${hashes.join(' ')}`, "style-src 'unsafe-inline'",
    'img-src data: blob:', "base-uri 'none'", "form-action 'none'"].join('; ');
}

let page = readFileSync(here + 'src/page.html', 'utf8')
  .replace('/* style */', () => style)
  .replace('/* program */', () => program);
page = page.replace('{{policy}}', policyOf(page));
writeFileSync(target, page);
console.log(`${target}: ${(page.length / 1e3).toFixed(0)} kB`);
