// SPDX-License-Identifier: BSD-3-Clause
// The page tests itself when opened as report.html#selftest: what a reader would see and do,
// done and looked at. The outcome is text in the page, for a browser without a window, or a
// message to the page whose frame it is in.
import {el} from './dom.js';

function pixelsOf({view}) {
  view.render(); // what was drawn lasts until the end of this task
  const gl = view.renderer.getContext();
  const {drawingBufferWidth: width, drawingBufferHeight: height} = gl;
  const pixels = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return new Uint32Array(pixels.buffer);
}

function differing(a, b) {
  let count = 0;
  for (let i = 0; i < a.length; ++i) count += a[i] !== b[i];
  return count;
}

function checkCanvas(map, check) {
  const pixels = pixelsOf(map);
  const ground = pixels[0];
  const drawn = pixels.reduce((count, pixel) => count + (pixel !== ground), 0);
  check('canvas is not empty', drawn > 0.002 * pixels.length, `${drawn} of ${pixels.length} pixels`);
  check('canvas has colours', new Set(pixels).size > 8, new Set(pixels).size);
}

function checkLayers(map, check) {
  const before = pixelsOf(map);
  for (const button of map.tools.querySelectorAll('[data-layer]')) {
    const pressed = button.getAttribute('aria-pressed');
    button.click();
    const changed = differing(before, pixelsOf(map));
    check(`layer ${button.dataset.layer} can be switched`,
      changed > 0 && button.getAttribute('aria-pressed') !== pressed, `${changed} pixels changed`);
    button.click();
  }
  check('all layers come back', differing(before, pixelsOf(map)) === 0, '');
}

/** \return how many pixels are red, as nothing else on the map is */
function redPixels(map) {
  let count = 0;
  for (const pixel of pixelsOf(map)) {
    const [red, green, blue] = [pixel & 255, pixel >> 8 & 255, pixel >> 16 & 255];
    count += red > 100 && red > 3 * green && red > 3 * blue;
  }
  return count;
}

function checkMovingWords({run}, check) {
  const text = document.getElementById('moved')?.textContent ?? '';
  const {moving} = run;
  const word = !moving ? '' : moving.blind ? 'not known' : moving.points > 0 ? 'moved (' : 'Nothing moved';
  check('what moved is told', moving ? text.includes(word) : text === '', text);
}

function checkMoving({run, map}, check) {
  const button = map.tools.querySelector('[data-layer="moving"]');
  const isThere = run.map.moving.length > 0;
  check('what moved has a switch where something did', Boolean(button) === isThere, '');
  if (!button) return;
  check('what moved is shown at first', button.getAttribute('aria-pressed') === 'true', '');
  const shown = redPixels(map);
  button.click();
  const hidden = redPixels(map);
  button.click();
  check('what moved is red', shown > hidden, `${shown} red pixels, ${hidden} without`);
}

function isOrdered(values, down) {
  const order = (a, b) =>
    (typeof a === 'string' ? a.localeCompare(b, 'en', {numeric: true}) : a - b) * (down ? -1 : 1);
  const present = values.filter((v) => v !== null && v !== undefined && !Number.isNaN(v));
  return present.every((value, i) => i === 0 || order(present[i - 1], value) <= 0);
}

function checkTable(name, table, check) {
  table.columns.forEach((column, k) => {
    const head = table.heads[k].querySelector('button');
    head.focus();
    check(`${name}: "${column.label}" takes the keyboard`, document.activeElement === head, '');
    for (const down of [false, true]) {
      head.click();
      const values = table.shown.map(column.value);
      check(`${name}: sorts by "${column.label}" ${down ? 'down' : 'up'}`,
        isOrdered(values, down) && values.length === table.rows.length &&
        table.heads[k].getAttribute('aria-sort') === (down ? 'descending' : 'ascending'),
        values.slice(0, 3).join(' '));
      const first = table.body.querySelector('[data-place="0"]');
      check(`${name}: the first row is shown`, table.rows.length === 0 ||
        first.textContent.startsWith(table.columns[0].text(table.shown[0])), '');
    }
  });
  const rows = table.body.querySelectorAll('tr').length;
  check(`${name}: only what is in sight is drawn`, rows <= 80, `${rows} rows of ${table.rows.length}`);
}

/** Whether no value of the program shows through. */
function isInWords(element) {
  return !/\[object \w+\]|\bundefined\b|\bNaN\b|\bnull\b/.test(element.textContent);
}

function checkPick({run, map, selection}, check) {
  const scan = run.scans[run.scans.length - 1];
  const before = pixelsOf(map);
  selection.choose(scan, 'test');
  check('a chosen scan is shown', !map.card.hidden && map.card.textContent.includes(scan.file), scan.file);
  if (run.map.scans?.includes(run.scans.indexOf(scan)))
    check('a chosen scan is marked in the map', differing(before, pixelsOf(map)) > 0, '');
  check('a chosen scan is told in words', isInWords(map.card), map.card.textContent);
  selection.choose(scan, 'test');
  check('a scan chosen again is not', map.card.hidden, '');
}

function checkLayout(check) {
  const {scrollWidth, clientWidth} = document.documentElement;
  check('nothing is wider than the window', scrollWidth <= clientWidth, `${scrollWidth} in ${clientWidth}`);
  const broken = [...document.images].filter((image) => image.complete && image.naturalWidth === 0);
  check('everything is in words', isInWords(document.getElementById('report')), '');
  check('all pictures are there', broken.length === 0, broken.map((image) => image.alt).join());
}

export function selfTest(page) {
  const checks = [];
  const check = (name, passed, detail) => checks.push({name, passed, detail: String(detail)});
  try {
    checkLayout(check);
    checkMovingWords(page, check);
    check('WebGL works', Boolean(page.map.view), '');
    if (page.map.view) {
      checkCanvas(page.map, check);
      checkLayers(page.map, check);
      checkMoving(page, check);
      if (page.run.scans.length > 0) checkPick(page, check);
    }
    for (const [name, table] of Object.entries(page.tables)) checkTable(name, table, check);
  } catch (error) {
    check('the test itself', false, error.stack);
  }
  check('no errors on the page', window.pageErrors.length === 0, window.pageErrors.join(' | '));
  const outcome = {passed: checks.every(({passed}) => passed), width: innerWidth, checks};
  if (parent === window) document.body.append(el('pre', {id: 'selftest'}, JSON.stringify(outcome)));
  else parent.postMessage(JSON.stringify(outcome), '*');
}
