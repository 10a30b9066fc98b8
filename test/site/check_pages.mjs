#!/usr/bin/env node
// SPDX-License-Identifier: BSD-3-Clause
// The pages of a site in Chromium, at the widths of a phone and of a desktop, light and dark: no error on the
// console, no horizontal scroll or text that is cut off, and with axe-core (npm install axe-core) no serious finding.
// usage: check_pages.mjs SITE [--browser PROGRAM] [--axe axe.min.js] [--pictures DIR] [PAGE...]
//   --pictures DIR  a PNG of each PAGE in each view
//   PAGE            relative to SITE (default: every page but those of Doxygen, below api/)
// Exit code 1: findings, one a line; 2: wrong arguments, or no browser.
import {spawn} from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

// Width and height [px], and the theme.
const VIEWS = [[390, 844, 'light'], [1280, 900, 'light'], [1280, 900, 'dark']];
const RULES = {runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa'], resultTypes: ['violations']};

function stop(message) {
  console.error(`check_pages.mjs: error: ${message}`);
  process.exit(2);
}

function parse(words) {
  const given = {browser: 'chromium', axe: '', pictures: '', rest: []};
  while (words.length) {
    const word = words.shift();
    if (!word.startsWith('--')) given.rest.push(word);
    else if (word.slice(2) in given && words.length) given[word.slice(2)] = words.shift();
    else stop(`unknown option ${word}`);
  }
  if (!given.rest.length) stop('SITE is missing');
  return given;
}

function pagesOf(site) {
  return fs.readdirSync(site, {recursive: true}).map(String)
    .filter((name) => name.endsWith('.html') && !/^(api|_static)\//.test(name)).sort();
}

// Chromium without a window, which takes commands from a pipe. As root it has no sandbox.
class Browser {
  constructor(program) {
    this.profile = fs.mkdtempSync(path.join(os.tmpdir(), 'check_pages-'));
    this.child = spawn(program, ['--headless=new', '--no-sandbox', '--no-first-run', '--disable-extensions',
      '--disable-background-networking', '--disable-dev-shm-usage', '--disable-gpu', '--remote-debugging-pipe',
      `--user-data-dir=${this.profile}`, 'about:blank'],
    {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
    this.child.on('error', (error) => stop(`${program}: ${error.message}`));
    this.child.on('exit', () => { if (!this.closed) stop(`${program} ended`); });
    this.next = 0;
    this.waiting = new Map();
    this.hear = () => {};
    let text = '';
    this.child.stdio[4].setEncoding('utf8').on('data', (part) => {
      const messages = (text + part).split('\0');
      text = messages.pop();
      messages.forEach((message) => this.take(JSON.parse(message)));
    });
  }

  take(message) {
    if (!message.id) return this.hear(message.method, message.params);
    const [resolve, reject] = this.waiting.get(message.id);
    this.waiting.delete(message.id);
    return message.error ? reject(new Error(message.error.message)) : resolve(message.result);
  }

  send(method, params = {}) {
    const id = ++this.next;
    this.child.stdio[3].write(JSON.stringify({id, method, params, sessionId: this.session}) + '\0');
    return new Promise((resolve, reject) => this.waiting.set(id, [resolve, reject]));
  }

  async open() {
    const {targetId} = await this.send('Target.createTarget', {url: 'about:blank'});
    this.session = (await this.send('Target.attachToTarget', {targetId, flatten: true})).sessionId;
    for (const domain of ['Page', 'Runtime', 'Log']) await this.send(`${domain}.enable`);
  }

  async visit(url, [width, height, value]) {
    await this.send('Emulation.setEmulatedMedia', {features: [{name: 'prefers-color-scheme', value}]});
    await this.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: 1, mobile: width < 600});
    const errors = [];
    await new Promise((resolve, reject) => {
      this.hear = (method, params) => {
        if (method === 'Page.loadEventFired') resolve();
        if (method === 'Runtime.exceptionThrown') errors.push(params.exceptionDetails.text);
        if (method === 'Log.entryAdded' && params.entry.level === 'error') errors.push(`${params.entry.text} ${params.entry.url ?? ''}`);
        if (method === 'Runtime.consoleAPICalled' && params.type === 'error') errors.push(params.args.map((a) => a.value).join(' '));
      };
      this.send('Page.navigate', {url}).catch(reject);
    });
    return errors;
  }

  async value(expression) {
    const answer = await this.send('Runtime.evaluate', {expression, awaitPromise: true, returnByValue: true});
    if (answer.exceptionDetails) throw new Error(answer.exceptionDetails.exception?.description ?? answer.exceptionDetails.text);
    return answer.result.value;
  }

  async draw(file) {
    const {data} = await this.send('Page.captureScreenshot', {format: 'png'});
    fs.writeFileSync(file, Buffer.from(data, 'base64'));
  }

  close() {
    this.closed = true;
    this.child.kill();
    this.child.on('exit', () => fs.rmSync(this.profile, {recursive: true, force: true, maxRetries: 5}));
  }
}

// A page that scrolls sideways, and blocks of text that are cut off: they reach beyond their box or
// the window, and no box around them, smaller than the page (.content of furo), scrolls.
const WIDER = `(() => {
  const width = document.documentElement.clientWidth;
  const scrolls = (e) => e && !e.matches('.content, body') && (['auto', 'scroll'].includes(getComputedStyle(e).overflowX)
    || getComputedStyle(e).position === 'fixed' || scrolls(e.parentElement));
  const isCut = (e) => e.scrollWidth > e.clientWidth + 1 || e.getBoundingClientRect().right > width + 1;
  const cut = [...document.querySelectorAll('h1, h2, h3, h4, p, li, dt, dd, table, pre, figure, img')]
    .filter((e) => e.clientWidth && !scrolls(e) && isCut(e));
  const wide = document.documentElement.scrollWidth;
  return (wide > width ? ['the page, ' + wide + ' px'] : []).concat(cut.slice(0, 3).map((e) => e.tagName + ' '
    + e.textContent.trim().slice(0, 60))).join('; ');
})()`;

async function findings(browser, url, view, axe) {
  const found = (await browser.visit(url, view)).map((error) => `console: ${error}`);
  const wider = await browser.value(WIDER);
  if (wider) found.push(`too wide: ${wider}`);
  if (!axe) return found;
  await browser.value(`${axe}; 0`);
  const violations = await browser.value(`axe.run(document, ${JSON.stringify(RULES)}).then((r) => r.violations
    .filter((v) => ['serious', 'critical'].includes(v.impact))
    .map((v) => v.id + ' (' + v.nodes.length + '): ' + v.nodes[0].html.slice(0, 160) + ' ' + (v.nodes[0].any[0]?.message ?? '')))`);
  return found.concat(violations.map((violation) => `axe: ${violation}`));
}

async function main() {
  const given = parse(process.argv.slice(2));
  const [site, ...named] = given.rest;
  const pages = named.length ? named : pagesOf(site);
  if (!pages.length) stop(`${site}: no page`);
  const axe = given.axe ? fs.readFileSync(given.axe, 'utf8') : '';
  if (!axe) console.log('without axe-core (--axe): accessibility is not checked');
  const browser = new Browser(given.browser);
  await browser.open();
  let count = 0;
  for (const page of pages) {
    for (const view of VIEWS) {
      const url = pathToFileURL(path.resolve(site, page)).href;
      for (const finding of await findings(browser, url, view, axe)) {
        console.log(`${page} at ${view[0]} px, ${view[2]}: ${finding}`);
        ++count;
      }
      if (given.pictures) await browser.draw(path.join(given.pictures, `${page.replaceAll('/', '_')}_${view[0]}_${view[2]}.png`));
    }
  }
  browser.close();
  console.log(`${pages.length} pages, ${count} findings`);
  process.exitCode = count ? 1 : 0;
}

main().catch((error) => stop(error.stack));
