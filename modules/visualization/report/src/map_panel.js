// SPDX-License-Identifier: BSD-3-Clause
// The map with its switches.
import {counted, el, fixed, metres, whole} from './dom.js';
import {kColours} from './layers.js';
import {isDoubtful} from './run.js';
import {View} from './view.js';

const kLayers = [
  ['map', 'Map', (run) => run.map.positions.length > 0],
  ['moving', 'Dynamic points', (run) => run.map.moving.length > 0],
  ['trajectory', 'Trajectory', (run) => run.scans.length > 0],
  ['initial', 'Initial poses', (run) => run.scans.length > 1],
  ['links', 'Links', (run) => run.links.length > 0],
  ['planes', 'Planes', (run) => run.planes.length > 0],
  ['objects', 'Objects', (run) => run.objects.length > 0],
  ['grid', 'Grid', () => true],
];
const kHiddenAtFirst = ['initial', 'links', 'planes'];

function chip(label, pressed, onclick) {
  return el('button', {type: 'button', class: 'chip', 'aria-pressed': String(pressed), onclick}, label);
}

function slider(label, attributes, oninput) {
  const input = el('input', {type: 'range', ...attributes, oninput: () => oninput(Number(input.value))});
  return el('label', {class: 'slider'}, el('span', {}, label), input);
}

export class MapPanel {
  constructor(run, selection) {
    this.run = run;
    this.selection = selection;
    this.canvas = el('canvas', {tabindex: 0, 'aria-label':
      'The map in three dimensions. Drag to turn, right drag or arrow keys to move, scroll to zoom.'});
    this.card = el('div', {class: 'card', hidden: true});
    this.legend = el('div', {class: 'legend'});
    this.stage = el('div', {class: 'stage'}, this.canvas, this.legend, this.card);
    this.tools = el('div', {class: 'tools'});
    this.element = el('section', {id: 'map'}, el('h2', {}, 'Map'), this.stage, this.tools, this.#note());
  }

  #note() {
    const {map} = this.run;
    const thinned = [[map.positions, map.total, 'map.pcd'], [map.moving, map.moving_total, 'moving.pcd']]
      .filter(([positions, total]) => positions.length / 3 < total)
      .map(([positions, total, file]) => `Thinned to ${whole(positions.length / 3)} of ${whole(total)} points ` +
        `for this page; ${file} has them all.`).join(' ');
    return el('p', {class: 'hint'}, 'Drag to turn, right drag (two fingers) to move. Click the map, then ' +
      `scroll to zoom. Click a pose to see its scan. ${thinned}`);
  }

  /** To be called once the panel is in the document, where it has a size. */
  start() {
    try {
      this.view = new View(this.run, this.canvas);
    } catch (error) {
      this.stage.replaceChildren(el('p', {class: 'none'},
        'This browser shows no WebGL, which the map needs. The pictures below do without.'));
      return;
    }
    for (const name of kHiddenAtFirst) this.view.show(name, false);
    this.tools.append(this.#layers(), this.#colours(), this.#sliders(), this.#views());
    this.#describe('height');
    if (this.run.map.positions.length === 0) this.stage.append(
      el('p', {class: 'none'}, 'This run has no map; its poses are shown.'));
    this.selection.follow((scan) => this.#pick(scan));
    this.canvas.addEventListener('click', (event) => this.#click(event));
    this.#cut();
    this.view.render();
  }

  #layers() {
    const chips = kLayers.filter(([, , isThere]) => isThere(this.run)).map(([name, label]) => {
      const button = chip(label, this.view.layers[name].visible, () => {
        const visible = button.getAttribute('aria-pressed') !== 'true';
        button.setAttribute('aria-pressed', String(visible));
        this.view.show(name, visible);
      });
      button.dataset.layer = name;
      if (name === 'moving') { // the one whose colour tells what it is
        button.classList.add('swatch');
        button.style.setProperty('--colour', kColours.moving);
      }
      return button;
    });
    return el('div', {class: 'group', role: 'group', 'aria-label': 'what is shown'}, chips);
  }

  #colours() {
    const {map} = this.run;
    if (map.positions.length === 0) return null;
    const modes = ['height', ...(map.scans ? ['scan'] : []), ...(map.intensities ? ['intensity'] : [])];
    const select = el('select', {'aria-label': 'colour of the map', onchange: () => {
      this.view.colourBy(select.value);
      this.#describe(select.value);
    }}, modes.map((mode) => el('option', {value: mode}, 'by ' + mode)));
    return el('label', {class: 'slider'}, el('span', {}, 'Colour'), select);
  }

  #sliders() {
    const {bottom, highest} = this.view.space;
    if (this.run.map.positions.length === 0 || !(highest > bottom)) return null;
    const most = highest + 0.01 * (highest - bottom);
    this.cut = slider('Hide above', {min: bottom, max: most, step: (most - bottom) / 200, value: most},
      (height) => this.#hideAbove(height >= most ? null : height));
    this.cutText = el('output', {});
    this.cut.append(this.cutText);
    return el('div', {class: 'group'}, this.cut,
      slider('Point size', {min: 0.3, max: 3, step: 0.1, value: 1}, (size) => this.view.setPointSize(size)));
  }

  #hideAbove(height) {
    this.view.hideAbove(height);
    this.cutText.textContent = height === null ? 'nothing' : fixed(height, 1) + ' m';
  }

  /** A ceiling would hide the rooms below it. */
  #cut() {
    if (!this.cut) return;
    const {ceiling} = this.run.map;
    if (ceiling !== undefined) this.cut.querySelector('input').value = ceiling;
    this.#hideAbove(ceiling ?? null);
  }

  #views() {
    return el('div', {class: 'group', role: 'group', 'aria-label': 'where from'},
      ...[['oblique', 'Oblique'], ['top', 'From above']].map(([from, label]) =>
        el('button', {type: 'button', onclick: () => this.view.look(from)}, label)),
      document.fullscreenEnabled
        ? el('button', {type: 'button', onclick: () => this.stage.requestFullscreen()}, 'Whole screen') : null);
  }

  #describe(mode) {
    const {bottom, top} = this.view.space;
    const [from, to] = {height: [fixed(bottom, 1) + ' m', fixed(top, 1) + ' m'], scan: ['first scan', 'last scan'],
                        intensity: ['low', 'high']}[mode];
    const ramp = mode === 'scan' ? this.run.ramps.order : this.run.ramps.height;
    const stops = [];
    for (let share = mode === 'scan' ? 0 : 0.12; share <= 1.001; share += 0.08) {
      const k = 3 * Math.round(Math.min(1, share) * (ramp.length / 3 - 1));
      stops.push(`rgb(${ramp[k]},${ramp[k + 1]},${ramp[k + 2]})`);
    }
    const bar = el('i', {style: `background:linear-gradient(90deg,${stops.join(',')})`});
    this.legend.replaceChildren(
      ...(this.run.map.positions.length > 0 ? [el('span', {}, from), bar, el('span', {}, to)] : []),
      el('span', {class: 'grid'}, `grid ${this.view.gridStep < 1 ? metres(this.view.gridStep) : this.view.gridStep + ' m'}`));
  }

  #click(event) {
    const scan = this.view.scanAt(event.offsetX, event.offsetY);
    if (scan) this.selection.choose(scan, this);
  }

  #pick(scan) {
    this.view.pick(scan);
    this.card.hidden = !scan;
    if (!scan) return;
    const links = this.run.links.filter(({from, to}) => from === scan.index || to === scan.index);
    const rows = [['State', scan.state], ['Overlap', fixed(scan.overlap, 2)], ['Residual', metres(scan.rms)],
      ['Correction', metres(scan.correction)], ['Links', counted(links.length, 'link')],
      ...(scan.moved ? [['Dynamic', counted(scan.moved, 'point')]] : [])];
    this.card.replaceChildren(
      el('button', {type: 'button', class: 'close', 'aria-label': 'close', onclick: () =>
        this.selection.choose(scan, this)}, '\u00d7'),
      el('strong', {class: isDoubtful(scan) ? 'bad' : null}, scan.file),
      el('dl', {}, rows.map(([name, value]) => [el('dt', {}, name), el('dd', {}, value)])),
      ...(scan.reason ? [el('p', {}, scan.reason)] : []));
  }
}
