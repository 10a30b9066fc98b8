// SPDX-License-Identifier: BSD-3-Clause
// What the view shows, each as a three.js object in the frame of the view.
import {
  BoxGeometry, BufferAttribute, BufferGeometry, Color, DoubleSide, EdgesGeometry, GridHelper, Group,
  LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshBasicMaterial, Points, PointsMaterial, SRGBColorSpace,
} from 'three';
import {Line2} from 'three/examples/jsm/lines/Line2.js';
import {LineGeometry} from 'three/examples/jsm/lines/LineGeometry.js';
import {LineMaterial} from 'three/examples/jsm/lines/LineMaterial.js';
import {ticksOf} from './dom.js';
import {isPlace} from './geometry.js';
import {isDoubtful} from './run.js';

export const kColours = {
  trajectory: '#ffffff', initial: '#ff9d2e', used: '#3fd0c9', odometry: '#ffc24b', refused: '#ff5c5c',
  doubtful: '#ff4d4d', picked: '#ff3d8b', moving: '#ff2a2a', object: '#ffd84a', grid: '#39434d',
};

/** Discs instead of squares; of points in metres, never smaller than some pixels. */
function asDiscs(material, least) {
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader.replace('#include <logdepthbuf_vertex>',
      `gl_PointSize = clamp(gl_PointSize, ${least.toFixed(1)}, 24.0);\n#include <logdepthbuf_vertex>`);
    shader.fragmentShader = shader.fragmentShader.replace('#include <clipping_planes_fragment>',
      'if (length(gl_PointCoord - 0.5) > 0.5) discard;\n#include <clipping_planes_fragment>');
  };
  return material;
}

function mapPoints(map, space, material) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(map.positions, 3));
  const points = new Points(geometry, material);
  points.scale.setScalar(map.step);
  points.position.fromArray(space.local(map.origin));
  points.frustumCulled = false;
  return points;
}

/** The map; its colours are set by colourMap(). */
export function mapLayer(run, space, size) {
  const material = asDiscs(new PointsMaterial({size, vertexColors: true}), 1.6);
  const points = mapPoints(run.map, space, material);
  const colours = new Uint8Array(run.map.positions.length);
  points.geometry.setAttribute('color', new BufferAttribute(colours, 3, true));
  return points;
}

/** Dynamic points. */
export function movingLayer(run, space, size) {
  const moving = {...run.map, positions: run.map.moving};
  return mapPoints(moving, space, asDiscs(new PointsMaterial({size, color: kColours.moving}), 2.4));
}

/** The points of one scan, drawn over the map. */
export function scanPoints(run, space, size) {
  const points = mapPoints(run.map, space, asDiscs(new PointsMaterial({size, color: kColours.picked}), 2.4));
  points.geometry.setIndex([]);
  return points;
}

export function placesOfScan(run, scan) {
  const place = run.scans.indexOf(scan);
  const indices = [];
  if (run.map.scans) run.map.scans.forEach((s, i) => { if (s === place) indices.push(i); });
  return indices;
}

/** Shares in [0, 1] of the colour range, per point. */
function sharesOf(run, space, mode) {
  const {positions, scans, intensities, origin, step} = run.map;
  const span = Math.max(space.top - space.bottom, 1e-6);
  return {
    height: (i) => (origin[2] + step * positions[3 * i + 2] - space.bottom) / span,
    scan: (i) => scans[i] / Math.max(1, run.scans.length - 1),
    intensity: (i) => intensities[i] / 255,
  }[mode];
}

/** Colours the map by "height", "scan" or "intensity". */
export function colourMap(layer, run, space, mode) {
  const share = sharesOf(run, space, mode);
  const ramp = mode === 'scan' ? run.ramps.order : run.ramps.height;
  const linear = new Float32Array(ramp.length).map((_, k) => new Color(`rgb(${ramp[k]},0,0)`).r);
  const {array} = layer.geometry.getAttribute('color');
  for (let i = 0; 3 * i < array.length; ++i) {
    // The lowest colours are lost on the dark ground.
    const lifted = mode === 'scan' ? share(i) : 0.12 + 0.88 * Math.min(1, Math.max(0, share(i)));
    const k = 3 * Math.round(Math.min(1, Math.max(0, lifted)) * (ramp.length / 3 - 1));
    for (let c = 0; c < 3; ++c) array[3 * i + c] = 255 * linear[k + c];
  }
  layer.geometry.getAttribute('color').needsUpdate = true;
}

/** A line through the places; gaps where a pose is not finite. */
function path(places, colour, width, dashed) {
  const group = new Group();
  let part = [];
  const close = () => {
    if (part.length > 1) {
      const geometry = new LineGeometry().setPositions(part.flat());
      const length = part.length;
      const material = new LineMaterial({color: colour, linewidth: width, dashed,
        dashSize: 0.25, gapSize: 0.2});
      const line = new Line2(geometry, material);
      if (dashed) line.computeLineDistances();
      line.userData.corners = length;
      group.add(line);
    }
    part = [];
  };
  for (const place of places) place ? part.push(place) : close();
  close();
  return group;
}

function marks(places, color, size) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(places.flat()), 3));
  return new Points(geometry, asDiscs(new PointsMaterial({size, color, sizeAttenuation: false}), 2));
}

const placesOf = (run, space, which) =>
  run.scans.map((scan) => isPlace(scan[which]) ? space.local(scan[which]) : null);

export function trajectoryLayer(run, space, pixelRatio) {
  const group = path(placesOf(run, space, 'position'), kColours.trajectory, 2.5, false);
  const scans = run.scans.filter((scan) => isPlace(scan.position));
  const small = scans.length > 400 ? 4 : 6; // [CSS px]
  for (const [chosen, colour, size] of [[scans, kColours.trajectory, small],
                                        [scans.filter(isDoubtful), kColours.doubtful, 11]])
    if (chosen.length > 0)
      group.add(marks(chosen.map((scan) => space.local(scan.position)), colour, size * pixelRatio));
  return group;
}

export function initialLayer(run, space) {
  return path(placesOf(run, space, 'initial'), kColours.initial, 1.8, false);
}

export function linksLayer(run, space) {
  const places = [], colours = [];
  for (const link of run.links) {
    const ends = [link.from, link.to].map((index) => run.scanOfIndex.get(index)?.position);
    if (!ends.every(isPlace)) continue;
    const colour = new Color(kColours[link.verdict] ?? kColours.used).toArray();
    for (const end of ends) places.push(...space.local(end));
    colours.push(...colour, ...colour);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(places), 3));
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(colours), 3));
  const crowd = Math.min(1, 400 / Math.max(1, run.links.length));
  return new LineSegments(geometry, new LineBasicMaterial(
    {vertexColors: true, transparent: true, opacity: 0.2 + 0.6 * crowd, depthWrite: false}));
}

/** Convex outlines as fans. */
export function planesLayer(run, space) {
  const group = new Group();
  for (const plane of run.planes) {
    const corners = plane.hull.filter(isPlace).map(space.local);
    if (corners.length < 3) continue;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(corners.flat()), 3));
    geometry.setIndex(corners.slice(2).flatMap((_, k) => [0, k + 1, k + 2]));
    const color = new Color().setRGB(...plane.colour.map((c) => c / 255), SRGBColorSpace);
    group.add(new Mesh(geometry, new MeshBasicMaterial(
      {color, transparent: true, opacity: 0.38, side: DoubleSide, depthWrite: false})));
    const edge = new LineSegments(new EdgesGeometry(geometry), new LineBasicMaterial({color}));
    group.add(edge);
  }
  return group;
}

export function objectsLayer(run, space) {
  const group = new Group();
  for (const object of run.objects) {
    const size = object.high.map((value, axis) => Math.max(value - object.low[axis], 1e-3));
    const middle = object.high.map((value, axis) => (value + object.low[axis]) / 2);
    const box = new LineSegments(new EdgesGeometry(new BoxGeometry(...size)),
      new LineBasicMaterial({color: kColours.object}));
    const [x, y, z] = space.local([object.pose[3], object.pose[7], object.pose[11]]);
    const m = [...object.pose];
    [m[3], m[7], m[11]] = [x, y, z];
    box.applyMatrix4(new Matrix4().set(...m).multiply(new Matrix4().makeTranslation(...middle)));
    group.add(box);
  }
  return group;
}

/** A grid with round spacing below the map. \return {object, step [m]} */
export function gridLayer(space) {
  const reach = Math.max(space.high[0] - space.low[0], space.high[1] - space.low[1], 1) * 1.1;
  const {step} = ticksOf(0, reach, 8);
  const cells = Math.ceil(reach / step / 2) * 2;
  const grid = new GridHelper(cells * step, cells, kColours.grid, kColours.grid);
  grid.rotation.x = Math.PI / 2;
  const snapped = (axis) => Math.round(space.centre[axis] / step) * step - space.centre[axis];
  grid.position.set(snapped(0), snapped(1), space.bottom - space.centre[2] - 0.02 * space.radius);
  grid.material.transparent = true;
  grid.material.opacity = 0.7;
  return {object: grid, step};
}
