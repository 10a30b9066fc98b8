// SPDX-License-Identifier: BSD-3-Clause
// Builds the page from the data of a run.
import {counted, el, fixed} from './dom.js';
import {MapPanel} from './map_panel.js';
import {plotSection} from './plots.js';
import {readRun} from './run.js';
import {Selection} from './selection.js';
import {selfTest} from './selftest.js';
import {linkTable, objectTable, optionTable, planeTable, scanTable, stageList} from './tables.js';
import {verdictSection} from './verdict.js';

function tableSection(id, title, note, table) {
  return table.rows.length === 0 ? null
    : el('section', {id}, el('h2', {}, title), note ? el('p', {class: 'hint'}, note) : null, table.element);
}

function pictureSection(run) {
  if (run.pictures.length === 0) return null;
  return el('section', {id: 'pictures'}, el('h2', {}, 'Pictures'),
    el('div', {class: 'pictures'}, run.pictures.map(({name, title, source}) => el('figure', {},
      el('a', {href: source, download: name}, el('img', {src: source, alt: title, loading: 'lazy'})),
      el('figcaption', {}, title, el('span', {}, name))))));
}

function agreementList(run) {
  return run.graph_stages.map((stage) => el('li', {class: stage.reverted ? 'reverted' : null},
    el('strong', {}, stage.name),
    ` agreement of the scans ${fixed(stage.agreement_before, 3)} to ${fixed(stage.agreement_after, 3)}` +
      (stage.rounds > 0 ? `, ${counted(stage.rounds, 'round')}` : '') +
      (stage.reverted ? `; reverted: ${stage.reason}` : '')));
}

function howSection(run) {
  const options = optionTable(run);
  return el('section', {id: 'how'}, el('h2', {}, 'How it was made'),
    el('p', {class: 'hint'}, run.pose_source ? `Initial poses: ${run.pose_source}.` : ''),
    el('div', {class: 'columns'},
      el('div', {}, el('h3', {}, 'Time'), stageList(run)),
      run.graph_stages.length > 0
        ? el('div', {}, el('h3', {}, 'What each stage did'), el('ul', {class: 'agreement'}, agreementList(run)))
        : null),
    run.options.length > 0 ? [el('h3', {}, 'Options'), options.element] : null);
}

function navigation(sections) {
  return el('nav', {'aria-label': 'sections'}, sections.map((section) =>
    el('a', {href: '#' + section.id}, section.dataset.short ?? section.querySelector('h2').textContent)));
}

function build() {
  const run = readRun();
  const selection = new Selection();
  document.title = `${run.title} \u2013 report`;
  const choose = (scan) => {
    selection.choose(scan, 'verdict');
    map.element.scrollIntoView();
  };
  const map = new MapPanel(run, selection);
  const tables = {scans: scanTable(run, selection), links: linkTable(run, selection)};
  const verdict = verdictSection(run, choose);
  verdict.dataset.short = 'Verdict';
  const sections = [
    verdict,
    map.element,
    plotSection(run, selection),
    tableSection('scans', 'Scans', 'Click a row to see the scan in the map.', tables.scans),
    tableSection('links', 'Links', null, tables.links),
    tableSection('planes', 'Planes', null, planeTable(run)),
    tableSection('objects', 'Objects', null, objectTable(run)),
    pictureSection(run),
    howSection(run),
  ].filter(Boolean);
  document.getElementById('report').append(
    el('header', {}, el('p', {}, 'PCL6D \u00b7 report of a run'), el('h1', {}, run.title)),
    navigation(sections),
    el('main', {}, sections),
    el('footer', {}, (run.generator ? `Made by ${run.generator} ${run.version}. ` : '') +
      'The map is drawn by three.js (MIT licence).'));
  map.start();
  return {run, map, tables, selection};
}

const page = build();
if (location.hash === '#selftest') selfTest(page);
