// SPDX-License-Identifier: BSD-3-Clause
import {el, fixed, metres, seconds, whole} from './dom.js';
import {isDoubtful} from './run.js';
import {Table} from './table.js';

const word = (label, key, title) => ({label, title, value: (row) => row[key], text: (row) => row[key] || ''});
const count = (label, key, title) =>
  ({label, title, number: true, value: (row) => row[key], text: (row) => whole(row[key])});
const number = (label, key, digits, title) =>
  ({label, title, number: true, value: (row) => row[key], text: (row) => fixed(row[key], digits)});
const length = (label, key, title) =>
  ({label, title, number: true, value: (row) => row[key], text: (row) => metres(row[key])});

function badge(label, key, title, toneOf) {
  return {...word(label, key, title), node: (row) => el('span', {class: 'badge ' + toneOf(row)}, row[key])};
}

export function scanTable(run, selection) {
  const table = new Table({
    noun: 'scan',
    rows: run.scans,
    filters: [{label: 'All', keeps: () => true}, {label: 'Not to be trusted', keeps: isDoubtful}],
    toneOf: (scan) => isDoubtful(scan) ? 'doubtful' : null,
    onpick: (scan) => selection.choose(scan, table),
    columns: [
      word('Scan', 'file', 'its file'),
      badge('State', 'state', 'fixed: the first one; matched; anything else is not to be trusted',
        (scan) => isDoubtful(scan) ? 'bad' : 'good'),
      count('Points', 'points', 'as measured'),
      ...(run.moving?.points > 0 ? [count('Dynamic', 'moved', 'points on dynamic objects')] : []),
      count('Pairs', 'pairs', 'within the largest pair distance'),
      number('Overlap', 'overlap', 2, 'pairs / points left after reduction'),
      length('Residual', 'rms', 'rms of the pairs'),
      length('Correction', 'correction', 'from the predicted to the matched position'),
      length('1 sigma', 'sigma', 'of the position relative to the first scan, by the links of the map'),
      length('Drift', 'drift', 'from the initial pose to the final one'),
      count('Iterations', 'iterations', 'of ICP'),
      word('Start', 'start', 'where ICP started from'),
      word('Reason', 'reason', 'why its pose was rejected'),
    ],
  });
  selection.follow((scan, source) => table.pick(scan, source !== table));
  return table;
}

const toneOfLink = (link) => ({used: 'good', refused: 'bad'})[link.verdict] ?? 'warn';

export function linkTable(run, selection) {
  const table = new Table({
    noun: 'link',
    rows: run.links,
    filters: [{label: 'All', keeps: () => true}, ...['loop', 'network', 'sequence', 'given']
      .map((kind) => ({label: kind[0].toUpperCase() + kind.slice(1), keeps: (link) => link.kind === kind}))
      .filter(({keeps}) => run.links.some(keeps)),
      {label: 'Refused', keeps: (link) => link.verdict === 'refused'}],
    toneOf: (link) => link.verdict === 'refused' ? 'doubtful' : null,
    onpick: (link) => selection.choose(run.scanOfIndex.get(link.from) ?? null, table),
    columns: [
      {...count('From', 'from'), text: (link) => String(link.from)},
      {...count('To', 'to'), text: (link) => String(link.to)},
      word('Kind', 'kind', 'why these two were looked at'),
      badge('Verdict', 'verdict', 'whether it counts', toneOfLink),
      length('Distance', 'distance', 'between the scans'),
      count('Pairs', 'pairs'),
      length('Residual', 'rms', 'rms of the pairs'),
      number('Overlap', 'overlap', 2),
      number('Condition', 'condition', 3, 'how well the surfaces fix all six degrees of freedom; 0: not at all'),
      number('Weight', 'weight', 2, 'how much it counts, 0 to 1'),
      word('Reason', 'reason', 'why it is refused'),
    ],
  });
  return table;
}

export function planeTable(run) {
  return new Table({
    noun: 'plane',
    rows: run.planes,
    columns: [
      {...count('Plane', 'id'), text: (plane) => String(plane.id)},
      {...word('Label', 'label'), node: (plane) => el('span', {class: 'swatch', style:
        `--colour:rgb(${plane.colour.join(',')})`}, plane.label)},
      {...number('Area', 'area', 1, 'square metres'), text: (plane) => fixed(plane.area, 1) + ' m\u00b2'},
      count('Points', 'inliers'),
      length('Residual', 'rms', 'rms distance of its points'),
    ],
  });
}

export function objectTable(run) {
  const at = (label, k) => ({label, number: true, value: (object) => object.pose[k],
                             text: (object) => fixed(object.pose[k], 2)});
  return new Table({
    noun: 'object',
    rows: run.objects,
    columns: [word('Object', 'class'), at('x [m]', 3), at('y [m]', 7), at('z [m]', 11),
      count('Points', 'points')],
  });
}

export function optionTable(run) {
  const order = {given: 0, derived: 1, default: 2};
  return new Table({
    noun: 'option',
    rows: [...run.options].sort((a, b) => order[a.source] - order[b.source]),
    filters: [{label: 'All', keeps: () => true},
      {label: 'Given', keeps: (option) => option.source === 'given'},
      {label: 'Derived', keeps: (option) => option.source === 'derived'}],
    columns: [
      {...word('Option', 'name'), text: (option) => '--' + option.name},
      word('Value', 'value'),
      badge('Source', 'source', 'given, derived from the data, or the default',
        (option) => option.source === 'default' ? 'plain' : 'accent'),
      word('Why', 'why'),
    ],
  });
}

/** What took how long, with bars. */
export function stageList(run) {
  const most = Math.max(...run.stages.map((stage) => stage.seconds), 1e-9);
  return el('ol', {class: 'stages'}, run.stages.map((stage) => el('li', {},
    el('span', {}, stage.name), el('i', {}, el('b', {style: `width:${100 * stage.seconds / most}%`})),
    el('span', {class: 'number'}, seconds(stage.seconds)))));
}
