// SPDX-License-Identifier: BSD-3-Clause
import {el, fixed, metres} from './dom.js';
import {Plot} from './plot.js';
import {isDoubtful} from './run.js';

function limitOf(run, name, label) {
  const value = Number(run.options.find((option) => option.name === name)?.value);
  return Number.isFinite(value) && value > 0 ? {value, label} : undefined;
}

function ofScans(run, value, unit, digits) {
  return run.scans.map((scan) => ({
    x: scan.index, y: value(scan), item: scan, tone: isDoubtful(scan) ? 'bad' : 'good',
    label: `${scan.file}: ${fixed(value(scan), digits)}${unit}`}));
}

const inCentimetres = (value) => value === null ? null : 100 * value; // null: not known

function plotsOf(run, onpick) {
  const scans = {xTitle: 'scan', onpick, joined: true};
  return [
    new Plot({...scans, title: 'Overlap', note: 'share of each scan that meets those before it',
      dots: ofScans(run, (scan) => scan.overlap, '', 2), limit: limitOf(run, 'min-overlap', 'least that counts')}),
    new Plot({...scans, title: 'Residual', note: 'rms of the pairs of each scan, cm',
      dots: ofScans(run, (scan) => inCentimetres(scan.rms), ' cm', 1)}),
    new Plot({...scans, title: 'Correction', note: 'from where the odometry put each scan to its match, cm',
      dots: ofScans(run, (scan) => inCentimetres(scan.correction), ' cm', 1)}),
    new Plot({...scans, title: 'Error of the position', note: 'one standard deviation relative to the first scan, ' +
      'by the links of the map, cm', dots: ofScans(run, (scan) => inCentimetres(scan.sigma), ' cm', 2)}),
    new Plot({...scans, title: 'Drift of the initial poses', note: 'from each initial pose to the final one, m',
      dots: ofScans(run, (scan) => scan.drift, ' m', 2)}),
    new Plot({title: 'Residual of links', note: 'rms of the pairs of each link, cm', xTitle: 'between the scans [m]',
      onpick: (link) => onpick(run.scanOfIndex.get(link.from)),
      dots: run.links.map((link) => ({x: link.distance, y: inCentimetres(link.rms), item: link, tone: link.verdict,
        label: `${link.from} \u2013 ${link.to}, ${link.kind}, ${link.verdict}: ${metres(link.rms)}`}))}),
  ].filter((plot) => plot.dots.length > 0);
}

/** Charts of the scans and links; a click chooses the scan. */
export function plotSection(run, selection) {
  const plots = plotsOf(run, (scan) => selection.choose(scan, 'plot'));
  if (plots.length === 0) return null;
  selection.follow((scan) => plots.forEach((plot) => plot.pick(scan)));
  return el('section', {id: 'plots'}, el('h2', {}, 'Errors and residuals'),
    el('div', {class: 'plots'}, plots.map((plot) => plot.element)));
}
