// SPDX-License-Identifier: BSD-3-Clause
// What a reader should know first, in plain words.
import {counted, el, fixed, seconds, whole} from './dom.js';

/** What verification says, in the lines of the verdict that begin so. */
const linesOf = (run, ...starts) =>
  run.verdict.text.split('\n').filter((line) => starts.some((start) => line.startsWith(start)));

/** Nothing is against the map, but rays and points do not confirm all of it. */
const isUnverified = (run) => linesOf(run, 'verified by points and rays').length === 0;

/** Without a summary there are poses and points, and no more. */
const isUnknown = (run) => run.generator === '';

function headline(run) {
  if (isUnknown(run)) return ['bad', 'How good this map is, is not known.'];
  if (!run.verdict.complete) return ['bad', 'This run was interrupted. Its map is not finished.'];
  if (run.verdict.trusted)
    return isUnverified(run) ? ['warn', 'Nothing contradicts this map, but not all of it is confirmed.'] :
      ['good', 'This map can be trusted.'];
  const floating = run.floating.length;
  if (run.doubtful.length > 0)
    return ['bad', `Do not trust ${run.doubtful.length === run.scans.length - 1 ? 'this map' :
      counted(run.doubtful.length, 'scan') + ' of this map'}.`];
  return ['bad', floating > 0 ? 'This map is in pieces that nothing joins.' : 'This map is not to be trusted.'];
}

function meaning(run) {
  if (isUnknown(run)) return 'The run left no summary.json, which would tell.';
  if (!run.verdict.complete)
    return 'Scans that were reached have poses; the others are as the odometry put them.';
  if (run.verdict.trusted)
    return run.scans.length === 1 ? 'There is one scan, and nothing to match it with.' : isUnverified(run) ?
      'Every scan was matched with enough overlap and small residuals, and is joined to the first one. ' +
      'A scan at a wrong place that looks alike may not have been noticed: have a look at the map.' :
      'Links that points and rays confirm tie every scan to the others: surfaces fit, and no scan looked through ' +
      'what another measured.';
  return 'The scans named below could not be matched well, nothing ties them to the others, or they contradict ' +
    'each other. The rest of the map may still be good.';
}

const percent = (share) => fixed(100 * share, share > 0 && share < 0.01 ? 2 : 1) + ' %';

/** Number of dynamic points, or why it is not known. */
function movingWords({moving, map}) {
  if (moving.blind)
    return `What moved is not known: rays contradict ${percent(moving.background)} of the points even where ` +
      'scans fit best. Scans and map are left as they are.';
  const unseen = `${fixed(100 * moving.unknown, 0)} % of the places were seen by no other scan: of them it is not known.`;
  if (moving.points === 0) return `Nothing moved. ${unseen}`;
  return `${counted(moving.points, 'point')} moved (${percent(moving.points / moving.measured)}), in ` +
    `${counted(moving.of_scans.filter((points) => points > 0).length, 'scan')}: ${map.moving.length > 0 ? 'red in the map below, and ' : ''}` +
    `${moving.removed ? 'left out of scans and map' : 'labelled in scans/, but not part of the map'}. ${unseen}`;
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

/** Reasons that differ by their numbers alone count as one. */
function refusedNotes(run) {
  const reasons = new Map();
  for (const {reason} of run.refused) {
    const kind = reason.replace(/\d+(\.\d+)?/g, '0');
    reasons.set(kind, {reason, count: (reasons.get(kind)?.count ?? 0) + 1});
  }
  const sorted = [...reasons.values()].sort((a, b) => b.count - a.count).slice(0, 5);
  return sorted.map(({reason, count}) => el('li', {},
    `${counted(count, 'link')} refused${count > 1 ? ', such as' : ''}: ${reason || 'no reason given'}`));
}

function stageNotes(run) {
  return run.graph_stages.filter((stage) => stage.reverted).map((stage) =>
    el('li', {}, `${stage.name} reverted: ${stage.reason}`));
}

const kMostNotes = 10; // of one kind

function atMost(items, noteOf) {
  const notes = items.slice(0, kMostNotes).map(noteOf);
  const more = items.length - notes.length;
  if (more > 0) notes.push(el('li', {class: notes[0].className}, `and ${whole(more)} more`));
  return notes;
}

/** What matching says of scans is told scan by scan. */
const kOfScans = /could not be matched|did not converge|no link joins/;

/** Doubts of verification, without the word that begins the line. */
function doubtNotes(run) {
  const toneOf = {'NOT TO BE TRUSTED': 'bad', unverified: 'warn', note: 'plain'};
  return linesOf(run, 'NOT TO BE TRUSTED: ', 'unverified: ', 'note: ').filter((line) => !kOfScans.test(line)).map((line) => {
    const [word] = line.split(': ', 1);
    return el('li', {class: toneOf[word]}, line.slice(word.length + 2));
  });
}

/** All that is not as it should be. */
function notes(run, choose) {
  return [
    ...doubtNotes(run),
    ...atMost(run.doubtful, (scan) => scanNote(scan, choose)),
    ...atMost(run.floating, (file) => el('li', {class: 'bad'}, `${file} \u2013 no link joins it to the first scan`)),
    ...atMost(run.warnings, (text) => el('li', {class: 'warn'}, text)),
    ...atMost(run.missing, (text) => el('li', {class: 'warn'}, text)),
    ...refusedNotes(run),
    ...stageNotes(run),
  ];
}

/** The top of the page. */
export function verdictSection(run, choose) {
  const [tone, words] = headline(run);
  const list = notes(run, choose);
  const numbers = linesOf(run, 'least overlap');
  const exactness = linesOf(run, 'positions relative', 'the surest link', 'no link of ');
  return el('section', {id: 'verdict', class: 'verdict ' + tone},
    el('h2', {}, words),
    el('p', {}, meaning(run)),
    exactness.map((line) => el('p', {}, line[0].toUpperCase() + line.slice(1) + '.')),
    run.moving ? el('p', {id: 'moved'}, movingWords(run)) : null,
    list.length > 0 ? el('ul', {class: 'notes'}, list) : null,
    numbers.length > 0 ? el('p', {class: 'numbers'}, 'Weakest matches: ' + numbers[0] + '.') : null,
    facts(run));
}
