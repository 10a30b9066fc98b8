// SPDX-License-Identifier: BSD-3-Clause
import {counted, el, whole} from './dom.js';

const kRowHeight = 34; // [px] as in style.css
const kMargin = 12; // rows drawn beyond what is seen

const kWords = new Intl.Collator('en', {numeric: true}); // scan2 before scan10

const isMissing = (value) => value === null || value === undefined || Number.isNaN(value);

/** What is missing stands last, whichever way round. */
function compare(a, b, down) {
  if (isMissing(a) || isMissing(b)) return isMissing(a) - isMissing(b);
  const order = typeof a === 'string' ? kWords.compare(a, b) : a - b;
  return down ? -order : order;
}

/** A table that sorts by its column heads and can be narrowed to some rows. Only the rows in
 * sight are in the document, so that thousands cost nothing.
 *
 * A column: {label, title, value: row => to sort by, text: row => shown, number: bool,
 * node: row => element instead of text}. */
export class Table {
  /** \param options {noun, columns, rows, filters: [{label, keeps}], onpick, toneOf} */
  constructor(options) {
    Object.assign(this, options);
    this.columns = this.columns.filter((column) => // one that says nothing only takes room
      this.rows.length === 0 || this.rows.some((row) => column.text(row) !== ''));
    this.shown = this.rows;
    this.sorted = {column: null, down: false};
    this.picked = null;
    this.filter = this.filters?.[0] ?? {keeps: () => true};
    this.words = '';
    this.#build();
    this.#arrange();
  }

  #build() {
    this.heads = this.columns.map((column, k) =>
      el('th', {scope: 'col', class: column.number ? 'number' : null, title: column.title,
                style: `min-width:calc(${this.#widthOf(column)}ch + 1.8rem)`},
        el('button', {type: 'button', onclick: () => this.sort(k)}, column.label)));
    this.body = el('tbody');
    this.scroller = el('div', {class: 'scroller', tabindex: 0, role: 'region',
                               'aria-label': 'table of ' + this.noun + 's'},
      el('table', {}, el('thead', {}, el('tr', {}, this.heads)), this.body));
    this.scroller.addEventListener('scroll', () => this.#draw(), {passive: true});
    new ResizeObserver(() => this.#draw()).observe(this.scroller);
    this.count = el('span', {class: 'count', 'aria-live': 'polite'});
    this.element = el('div', {class: 'table'}, this.#tools(), this.scroller);
  }

  /** The longest text of a column in letters, so that columns stay as they are while rows
   * come and go. */
  #widthOf(column) {
    const longest = this.rows.reduce((most, row) => Math.max(most, String(column.text(row)).length), 0);
    return Math.min(longest, 40);
  }

  #tools() {
    this.chips = (this.filters ?? []).map((filter) =>
      el('button', {type: 'button', class: 'chip', 'aria-pressed': String(filter === this.filter),
                    onclick: () => this.narrow(filter)},
        filter.label, el('small', {}, whole(this.rows.filter(filter.keeps).length))));
    const search = el('input', {type: 'search', placeholder: 'Find', 'aria-label':
      'find ' + this.noun + 's', oninput: (event) => this.find(event.target.value)});
    return el('div', {class: 'tools'}, this.chips, search, this.count);
  }

  /** Sorts by a column; by the same one again: the other way round. */
  sort(column) {
    const again = this.sorted.column === column;
    this.sorted = {column, down: again && !this.sorted.down};
    this.#arrange();
  }

  narrow(filter) {
    this.filter = filter;
    this.chips.forEach((chip, k) =>
      chip.setAttribute('aria-pressed', String(this.filters[k] === filter)));
    this.#arrange();
  }

  find(words) {
    this.words = words.trim().toLowerCase();
    this.#arrange();
  }

  /** Marks a row and, if asked, brings it into sight. */
  pick(row, scroll) {
    this.picked = row;
    const place = row ? this.shown.indexOf(row) : -1;
    if (scroll && place >= 0) {
      const top = place * kRowHeight;
      const {scrollTop, clientHeight} = this.scroller;
      if (top < scrollTop || top > scrollTop + clientHeight - 3 * kRowHeight)
        this.scroller.scrollTop = Math.max(0, top - clientHeight / 2);
    }
    this.#draw();
  }

  #holdsWords(row) {
    return this.columns.some((column) => String(column.text(row)).toLowerCase().includes(this.words));
  }

  #arrange() {
    this.shown = this.rows.filter((row) =>
      this.filter.keeps(row) && (this.words === '' || this.#holdsWords(row)));
    const {column, down} = this.sorted;
    if (column !== null) {
      const {value} = this.columns[column];
      this.shown.sort((a, b) => compare(value(a), value(b), down));
    }
    this.heads.forEach((head, k) => {
      if (k === column) head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
      else head.removeAttribute('aria-sort');
    });
    this.count.textContent = this.shown.length === this.rows.length
      ? counted(this.rows.length, this.noun)
      : `${whole(this.shown.length)} of ${counted(this.rows.length, this.noun)}`;
    this.scroller.scrollTop = 0;
    this.#draw();
  }

  #row(row, place) {
    const cells = this.columns.map((column, k) =>
      el(k === 0 ? 'th' : 'td', {scope: k === 0 ? 'row' : null, class: column.number ? 'number' : null},
        column.node ? column.node(row) : column.text(row)));
    return el('tr', {'data-place': place, class: this.toneOf?.(row) ?? null,
                     'aria-selected': row === this.picked ? 'true' : null,
                     onclick: this.onpick ? () => this.onpick(row) : null}, cells);
  }

  #space(rows) {
    return el('tr', {class: 'space', 'aria-hidden': 'true'},
      el('td', {colspan: this.columns.length, style: `height:${rows * kRowHeight}px`}));
  }

  #draw() {
    const height = this.scroller.clientHeight || 480;
    const first = Math.max(0, Math.floor(this.scroller.scrollTop / kRowHeight) - kMargin);
    const last = Math.min(this.shown.length,
      Math.ceil((this.scroller.scrollTop + height) / kRowHeight) + kMargin);
    const rows = this.shown.slice(first, last).map((row, k) => this.#row(row, first + k));
    this.body.replaceChildren(
      ...(first > 0 ? [this.#space(first)] : []), ...rows,
      ...(last < this.shown.length ? [this.#space(this.shown.length - last)] : []));
  }
}
