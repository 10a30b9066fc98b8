// SPDX-License-Identifier: BSD-3-Clause
// Elements and numbers as text. Text of a run only ever becomes text nodes, never markup.

const kSvg = 'http://www.w3.org/2000/svg';

function filled(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return element;
}

/** An element with attributes (on...: listeners) and children (elements or text). */
export function el(tag, attributes = {}, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

export function svg(tag, attributes = {}, ...children) {
  return filled(document.createElementNS(kSvg, tag), attributes, children);
}

const kNone = '\u2013';
const kMinus = '\u2212';

/** A number with so many digits behind the point; a dash for null. */
export function fixed(value, digits) {
  if (value === null || value === undefined || !Number.isFinite(value)) return kNone;
  return value.toFixed(digits).replace('-', kMinus);
}

/** A whole number with thin spaces between thousands. */
export function whole(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return kNone;
  return String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, '\u202f');
}

/** A length in the unit that suits it. */
export function metres(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return kNone;
  const size = Math.abs(value);
  if (size >= 1) return fixed(value, 2) + ' m';
  return size >= 0.01 ? fixed(value * 100, 1) + ' cm' : fixed(value * 1000, 1) + ' mm';
}

export function seconds(value) {
  if (value < 90) return fixed(value, value < 10 ? 1 : 0) + ' s';
  if (value < 5400) return fixed(value / 60, 0) + ' min';
  return fixed(value / 3600, 1) + ' h';
}

/** "1 scan", "3 scans". */
export function counted(count, noun) {
  return whole(count) + ' ' + noun + (count === 1 ? '' : 's');
}

/** Round values that cut a range into about so many parts. */
export function ticksOf(low, high, parts) {
  const rough = (high - low) / parts;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough * 0.999);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i) ticks.push(i * step);
  return {ticks, step, digits: Math.max(0, -Math.floor(Math.log10(step) + 1e-9))};
}
