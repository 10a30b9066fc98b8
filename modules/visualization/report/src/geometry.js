// SPDX-License-Identifier: BSD-3-Clause
// Where the run is in space, in the frame of the view: metres from the middle of the map.

/** Shares of a list of numbers, e.g. quantiles(z, [0.02, 0.98]). */
export function quantiles(values, shares) {
  const sorted = Float64Array.from(values).sort();
  return shares.map((share) => sorted[Math.round(share * (sorted.length - 1))] ?? 0);
}

export const isPlace = (place) => Array.isArray(place) && place.every(Number.isFinite);

/** Some coordinates of all points, for ranges. */
function samples(map, axis) {
  const count = map.positions.length / 3;
  const stride = Math.max(1, Math.floor(count / 20000));
  const values = [];
  for (let i = 0; i < count; i += stride)
    values.push(map.origin[axis] + map.step * map.positions[3 * i + axis]);
  return values;
}

/** The part of space to look at: without the few points that lie far away, with all poses. */
function boundsOf(run) {
  const low = [], high = [];
  for (const axis of [0, 1, 2]) {
    const [from, to] = quantiles(samples(run.map, axis), axis === 2 ? [0.02, 0.9] : [0.04, 0.96]);
    const places = run.scans.map((scan) => scan.position).filter(isPlace).map((p) => p[axis]);
    if (run.map.positions.length > 0) places.push(from, to);
    low.push(places.length > 0 ? places.reduce((a, b) => Math.min(a, b)) : 0);
    high.push(places.length > 0 ? places.reduce((a, b) => Math.max(a, b)) : 0);
  }
  return {low, high};
}

/** The angle of the longest extent of the path and the map from above. */
function longAxisOf(run, centre) {
  const xs = samples(run.map, 0), ys = samples(run.map, 1);
  let xx = 0, xy = 0, yy = 0;
  for (let i = 0; i < xs.length; ++i) {
    const x = xs[i] - centre[0], y = ys[i] - centre[1];
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  return 0.5 * Math.atan2(2 * xy, xx - yy);
}

/** {centre, radius, low, high: what to look at; bottom, top: heights that colours span;
 * highest: the highest point; axis: see longAxisOf(); local: places of the world in the view} */
export function spaceOf(run) {
  const {low, high} = boundsOf(run);
  const {ceiling = Infinity} = run.map; // what is above it is hidden at first
  high[2] = Math.max(low[2], Math.min(high[2], ceiling));
  const centre = low.map((value, axis) => (value + high[axis]) / 2);
  const radius = Math.max(0.5, Math.hypot(...low.map((value, axis) => high[axis] - value)) / 2);
  const [bottom, highest] = run.map.positions.length > 0
    ? quantiles(samples(run.map, 2), [0.02, 0.93]) : [low[2], high[2]];
  return {
    centre, radius, low, high, bottom,
    top: Math.max(bottom, Math.min(highest, ceiling)),
    highest: samples(run.map, 2).reduce((a, b) => Math.max(a, b), high[2]),
    axis: longAxisOf(run, centre),
    local: (place) => place.map((value, axis) => value - centre[axis]),
  };
}
