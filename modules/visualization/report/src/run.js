// SPDX-License-Identifier: BSD-3-Clause
// The run that the library wrote into the page (modules/visualization/src/report/report_json.cpp).

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** Little-endian numbers, as all machines with WebGL have them. */
function shortsOf(base64) {
  return new Uint16Array(bytesOf(base64).buffer);
}

function decodedMap(map) {
  return {
    ...map,
    positions: shortsOf(map.positions), // x y z of each point, in steps from the origin
    moving: shortsOf(map.moving ?? ''), // the same of dynamic points, which are not in the map
    scans: map.scans === undefined ? null : shortsOf(map.scans), // place in run.scans
    intensities: map.intensities === undefined ? null : bytesOf(map.intensities),
  };
}

/** Scans that a stranger should not rely on. */
export const isDoubtful = (scan) => !['fixed', 'matched', ''].includes(scan.state); // '': not known

/** Of a scan that was never matched there is nothing to tell. */
function withoutMatch(scan) {
  const none = {pairs: null, rms: null, overlap: null, correction: null, iterations: null};
  return scan.state === 'fixed' || scan.state === 'pending' ? {...scan, ...none} : scan;
}

export function readRun() {
  const run = JSON.parse(document.getElementById('run').textContent);
  run.map = decodedMap(run.map);
  run.ramps = {height: bytesOf(run.ramps.height), order: bytesOf(run.ramps.order)};
  run.scans = run.scans.map(withoutMatch);
  run.scans.forEach((scan, place) => { scan.moved = run.moving?.of_scans[place] ?? null; });
  run.doubtful = run.scans.filter(isDoubtful);
  run.refused = run.links.filter((link) => link.verdict === 'refused');
  run.scanOfIndex = new Map(run.scans.map((scan) => [scan.index, scan]));
  return run;
}
