// SPDX-License-Identifier: BSD-3-Clause
// What a reader should know first, in plain words.
import {counted, el, fixed, seconds, whole} from './dom.js';

function headline(run) {
  if (!run.verdict.complete) return ['bad', 'This run was interrupted. Its map is not finished.'];
  if (run.verdict.trusted) return ['good', 'This map can be trusted.'];
  const floating = run.floating.length;
  if (run.doubtful.length > 0)
    return ['bad', `Do not trust ${run.doubtful.length === run.scans.length - 1 ? 'this map' :
      counted(run.doubtful.length, 'scan') + ' of this map'}.`];
  return ['bad', floating > 0 ? 'This map is in pieces that nothing joins.' : 'This map is not to be trusted.'];
}

function meaning(run) {
  if (!run.verdict.complete)
    return 'Scans that were reached have poses; the others are as the odometry put them.';
  if (run.verdict.trusted)
    return 'Every scan was matched with enough overlap and small residuals, and is joined to the first one. ' +
      'A scan matched to a wrong place that looks alike would not be noticed: have a look at the map.';
  return 'The scans named below stand where the odometry put them, or nothing joins them to the ' +
    'others. The rest of the map may still be good.';
}

function fact(value, label) {
  return el('div', {}, el('dd', {}, value), el('dt', {}, label));
}

function facts(run) {
  const time = run.stages.reduce((sum, stage) => sum + stage.seconds, 0);
  const memory = run.stages.reduce((most, stage) => Math.max(most, stage.peak_memory_mb), 0);
  const points = run.scans.reduce((sum, scan) => sum + scan.points, 0);
  return el('dl', {class: 'facts'},
    fact(whole(run.scans.length), 'scans'),
    fact(points >= 1e6 ? fixed(points / 1e6, 1) + ' M' : whole(points), 'points measured'),
    fact(whole(run.map.total), 'points in the map'),
    fact(fixed(run.length, 1) + ' m', 'travelled'),
    fact(whole(run.links.length - run.refused.length), 'links used'),
    fact(seconds(time), memory > 0 ? `with ${whole(memory)} MB` : 'of work'));
}

function scanNote(scan, choose) {
  const words = {predicted: 'not matched: it stands where the odometry put it',
                 unconverged: 'matching did not come to rest',
                 pending: 'not reached'}[scan.state] ?? scan.state;
  return el('li', {class: 'bad'},
    el('button', {type: 'button', class: 'link', onclick: () => choose(scan)}, scan.file),
    ` \u2013 ${words}${scan.reason ? ' (' + scan.reason + ')' : ''}`);
}

function refusedNotes(run) {
  const reasons = new Map();
  for (const link of run.refused) reasons.set(link.reason, (reasons.get(link.reason) ?? 0) + 1);
  const sorted = [...reasons].sort((a, b) => b[1] - a[1]).slice(0, 5);
  return sorted.map(([reason, count]) =>
    el('li', {}, `${counted(count, 'link')} refused: ${reason || 'no reason given'}`));
}

function stageNotes(run) {
  return run.graph_stages.filter((stage) => stage.undone).map((stage) =>
    el('li', {}, `${stage.name} was not taken: ${stage.reason}`));
}

const kShownScans = 12;

/** All that is not as it should be. */
function notes(run, choose) {
  const doubtful = run.doubtful.slice(0, kShownScans).map((scan) => scanNote(scan, choose));
  if (run.doubtful.length > kShownScans)
    doubtful.push(el('li', {class: 'bad'}, `and ${counted(run.doubtful.length - kShownScans, 'scan')} ` +
      'more: see the table of scans'));
  return [
    ...doubtful,
    ...run.floating.map((file) => el('li', {class: 'bad'}, `${file} \u2013 no link joins it to the first scan`)),
    ...run.warnings.map((text) => el('li', {class: 'warn'}, text)),
    ...run.missing.map((text) => el('li', {class: 'warn'}, text)),
    ...refusedNotes(run),
    ...stageNotes(run),
  ];
}

/** The top of the page. */
export function verdictSection(run, choose) {
  const [tone, words] = headline(run);
  const list = notes(run, choose);
  const numbers = run.verdict.text.split('\n').filter((line) => line.startsWith('least overlap'));
  return el('section', {id: 'verdict', class: 'verdict ' + tone},
    el('h2', {}, words),
    el('p', {}, meaning(run)),
    list.length > 0 ? el('ul', {class: 'notes'}, list) : null,
    numbers.length > 0 ? el('p', {class: 'numbers'}, 'Weakest matches: ' + numbers[0] + '.') : null,
    facts(run));
}
