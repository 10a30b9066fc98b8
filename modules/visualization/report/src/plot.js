// SPDX-License-Identifier: BSD-3-Clause
import {el, svg, ticksOf} from './dom.js';

const kHeight = 220; // [px]
const kLeft = 46, kRight = 10, kTop = 10, kBottom = 34; // [px] around the plot

function spanOf(values, zero) {
  let low = Infinity, high = -Infinity;
  for (const value of values) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  if (zero) low = Math.min(low, 0);
  if (!(high > low)) high = low + (Math.abs(low) || 1);
  return {low, high: zero ? high * 1.05 : high};
}

/** Dots over two linear axes. Drawn anew in the width that it gets.
 *
 * A dot: {x, y, tone: class name, label: what it is, item: what a click chooses}. */
export class Plot {
  /** \param options {title, note, xTitle, yTitle, dots, limit: {value, label}, onpick, joined} */
  constructor(options) {
    Object.assign(this, options);
    this.dots = this.dots.filter(({x, y}) => Number.isFinite(x) && Number.isFinite(y) && y !== null);
    this.picked = null;
    this.frame = el('div', {class: 'frame'});
    this.reading = el('output', {class: 'reading'});
    this.element = el('figure', {class: 'plot'},
      el('figcaption', {}, el('strong', {}, this.title), el('span', {}, this.note ?? '')),
      this.frame, this.reading);
    new ResizeObserver(() => this.#draw()).observe(this.frame);
    this.frame.addEventListener('pointermove', (event) => this.#read(this.#nearest(event)));
    this.frame.addEventListener('pointerleave', () => this.#read(null));
    this.frame.addEventListener('click', (event) => {
      const dot = this.#nearest(event);
      if (dot && this.onpick) this.onpick(dot.item);
    });
    this.#draw();
  }

  pick(item) {
    this.picked = item;
    this.#draw();
  }

  #draw() {
    if (this.dots.length === 0) {
      this.frame.replaceChildren(el('p', {class: 'none'}, 'Nothing to plot in this run.'));
      return;
    }
    const width = Math.max(240, this.frame.clientWidth || 480);
    const x = spanOf(this.dots.map((dot) => dot.x), false);
    const y = spanOf([...this.dots.map((dot) => dot.y), ...(this.limit ? [this.limit.value] : [])], true);
    this.toX = (v) => kLeft + (v - x.low) / (x.high - x.low) * (width - kLeft - kRight);
    this.toY = (v) => kHeight - kBottom - (v - y.low) / (y.high - y.low) * (kHeight - kBottom - kTop);
    this.frame.replaceChildren(svg('svg',
      {width, height: kHeight, viewBox: `0 0 ${width} ${kHeight}`, role: 'img',
       'aria-label': `${this.title}: ${this.dots.length} values`},
      this.#axes(x, y, width), this.#limitLine(width), this.#line(), this.#marks()));
  }

  #axes(x, y, width) {
    const lines = [];
    const yTicks = ticksOf(y.low, y.high, 4), xTicks = ticksOf(x.low, x.high, width / 90);
    for (const v of yTicks.ticks) {
      const at = this.toY(v);
      lines.push(svg('line', {class: 'rule', x1: kLeft, x2: width - kRight, y1: at, y2: at}),
        svg('text', {x: kLeft - 8, y: at + 4, 'text-anchor': 'end'}, v.toFixed(yTicks.digits)));
    }
    for (const v of xTicks.ticks)
      lines.push(svg('text', {x: this.toX(v), y: kHeight - kBottom + 16, 'text-anchor': 'middle'},
        v.toFixed(xTicks.digits)));
    lines.push(svg('text', {class: 'axis', x: width - kRight, y: kHeight - 3, 'text-anchor': 'end'},
      this.xTitle));
    return lines;
  }

  #limitLine(width) {
    if (!this.limit) return [];
    const at = this.toY(this.limit.value);
    return [svg('line', {class: 'limit', x1: kLeft, x2: width - kRight, y1: at, y2: at}),
      svg('text', {class: 'limit', x: width - kRight, y: at - 5, 'text-anchor': 'end'}, this.limit.label)];
  }

  #line() {
    if (!this.joined) return [];
    const points = this.dots.map(({x, y}) => `${this.toX(x).toFixed(1)},${this.toY(y).toFixed(1)}`);
    return [svg('polyline', {class: 'joined', points: points.join(' ')})];
  }

  /** One path per tone: thousands of dots stay a handful of elements. */
  #marks() {
    const r = this.dots.length > 400 ? 1.6 : this.dots.length > 120 ? 2.2 : 3;
    const paths = new Map();
    for (const dot of this.dots) {
      const circle = `M${(this.toX(dot.x) - r).toFixed(1)} ${this.toY(dot.y).toFixed(1)}` +
        `a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0`;
      paths.set(dot.tone, (paths.get(dot.tone) ?? '') + circle);
    }
    const marks = [...paths].map(([tone, d]) => svg('path', {class: 'dots ' + tone, d}));
    for (const dot of this.dots)
      if (dot.item === this.picked && this.picked !== null)
        marks.push(svg('circle', {class: 'picked', cx: this.toX(dot.x), cy: this.toY(dot.y), r: r + 3.5}));
    this.halo = svg('circle', {class: 'halo', r: r + 2.5, visibility: 'hidden'});
    return [...marks, this.halo];
  }

  #nearest(event) {
    if (this.dots.length === 0) return null;
    const box = this.frame.getBoundingClientRect();
    const px = event.clientX - box.left, py = event.clientY - box.top;
    let nearest = null, least = 40 ** 2; // [px^2]
    for (const dot of this.dots) {
      const distance = (this.toX(dot.x) - px) ** 2 + (this.toY(dot.y) - py) ** 2;
      if (distance < least) [nearest, least] = [dot, distance];
    }
    return nearest;
  }

  #read(dot) {
    this.reading.textContent = dot ? dot.label : '';
    if (!this.halo) return;
    this.halo.setAttribute('visibility', dot ? 'visible' : 'hidden');
    if (!dot) return;
    this.halo.setAttribute('cx', this.toX(dot.x));
    this.halo.setAttribute('cy', this.toY(dot.y));
  }
}
