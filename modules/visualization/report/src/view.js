// SPDX-License-Identifier: BSD-3-Clause
import {Color, PerspectiveCamera, Plane, Scene, Vector3, WebGLRenderer} from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';
import {isPlace, spaceOf} from './geometry.js';
import {
  colourMap, gridLayer, initialLayer, linksLayer, mapLayer, movingLayer, objectsLayer, placesOfScan, planesLayer,
  scanPoints, trajectoryLayer,
} from './layers.js';
import {EyeDomeLighting} from './shading.js';

const kFieldOfView = 45; // [deg] vertical
const kGround = '#14181d';

/** The map to be walked around in. Drawn only when something changed. */
export class View {
  /** Throws where the browser has no WebGL. */
  constructor(run, canvas) {
    this.run = run;
    this.canvas = canvas;
    this.space = spaceOf(run);
    this.renderer = new WebGLRenderer({canvas, antialias: false, powerPreference: 'high-performance'});
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio || 1));
    this.renderer.localClippingEnabled = true;
    this.lighting = new EyeDomeLighting();
    this.scene = new Scene();
    this.scene.background = new Color(kGround);
    this.camera = new PerspectiveCamera(kFieldOfView, 1, this.space.radius / 200, this.space.radius * 60);
    this.camera.up.set(0, 0, 1);
    this.from = 'oblique';
    this.#addLayers();
    this.#addControls();
    new ResizeObserver(() => this.#resize()).observe(canvas.parentElement);
    this.#resize();
  }

  #addLayers() {
    const {run, space} = this;
    const ratio = this.renderer.getPixelRatio();
    this.pointSize = this.#spacing();
    this.lid = new Plane(new Vector3(0, 0, -1), Infinity);
    const grid = gridLayer(space);
    this.gridStep = grid.step;
    this.layers = {
      map: mapLayer(run, space, this.pointSize),
      moving: movingLayer(run, space, this.pointSize),
      trajectory: trajectoryLayer(run, space, ratio),
      initial: initialLayer(run, space),
      links: linksLayer(run, space),
      planes: planesLayer(run, space),
      objects: objectsLayer(run, space),
      grid: grid.object,
    };
    this.picked = scanPoints(run, space, this.pointSize * 1.3);
    this.picked.visible = false;
    this.scene.add(...Object.values(this.layers), this.picked);
    if (run.map.positions.length > 0) this.colourBy('height');
  }

  /** How far neighbouring points are from each other [m], roughly: points on surfaces of the
   * size of the map from above. */
  #spacing() {
    const {low, high} = this.space;
    const area = Math.max(1e-3, (high[0] - low[0]) * (high[1] - low[1]));
    const spacing = Math.sqrt(area / Math.max(1, this.run.map.positions.length / 3));
    return Math.min(Math.max(2 * spacing, this.run.map.step * 4), this.space.radius / 20);
  }

  #addControls() {
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableZoom = false; // until the reader turns to the map; the page must scroll
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.draw());
    this.controls.addEventListener('start', () => { this.from = null; }); // the reader's own view stays
    this.canvas.addEventListener('pointerdown', () => { this.controls.enableZoom = true; });
    this.canvas.addEventListener('blur', () => { this.controls.enableZoom = false; });
    this.canvas.addEventListener('focus', () => { this.controls.enableZoom = true; });
    this.controls.listenToKeyEvents(this.canvas);
  }

  #resize() {
    const {clientWidth, clientHeight} = this.canvas.parentElement;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    if (this.from) this.look(this.from);
    else this.render();
  }

  /** Draws with the next frame of the screen, however often it is called before. */
  draw() {
    this.frame ??= requestAnimationFrame(() => this.render());
  }

  render() {
    if (this.frame) cancelAnimationFrame(this.frame);
    this.frame = undefined;
    this.lighting.render(this.renderer, this.scene, this.camera);
    this.onrender?.();
  }

  show(name, visible) {
    this.layers[name].visible = visible;
    this.draw();
  }

  colourBy(mode) {
    colourMap(this.layers.map, this.run, this.space, mode);
    this.draw();
  }

  /** Hides what lies above a height of the world [m]; null: nothing. */
  hideAbove(height) {
    this.lid.constant = height === null ? 1e9 : height - this.space.centre[2];
    const lids = height === null ? null : [this.lid];
    for (const layer of [this.layers.map, this.layers.moving, this.layers.planes, this.picked])
      layer.traverse((part) => {
        if (!part.material) return;
        part.material.clippingPlanes = lids;
        part.material.needsUpdate = true;
      });
    this.draw();
  }

  setPointSize(factor) {
    for (const layer of [this.layers.map, this.layers.moving])
      layer.material.size = this.pointSize * factor;
    this.draw();
  }

  /** Looks at the whole from "oblique" or "top". */
  look(from) {
    this.from = from;
    const elevation = from === 'top' ? Math.PI / 2 - 1e-3 : 0.62; // [rad]
    const azimuth = this.space.axis - (this.camera.aspect < 1 ? 0 : Math.PI / 2); // fills the window
    const towards = new Vector3(Math.cos(azimuth) * Math.cos(elevation),
      Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation));
    this.#fit(towards);
    this.controls.update();
    this.render();
  }

  /** Moves the camera so that the whole fills the picture. */
  #fit(towards) {
    const {low, high, local, radius} = this.space;
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((bits) => new Vector3(
      ...local([0, 1, 2].map((axis) => (bits >> axis & 1 ? high : low)[axis]))));
    const {target} = this.controls;
    target.set(0, 0, 0);
    let distance = 4 * radius;
    for (let round = 0; round < 12; ++round) {
      this.camera.position.copy(target).addScaledVector(towards, distance);
      this.camera.lookAt(target);
      this.camera.updateMatrixWorld();
      const seen = corners.map((corner) => corner.clone().project(this.camera));
      const [left, right] = [Math.min(...seen.map((p) => p.x)), Math.max(...seen.map((p) => p.x))];
      const [below, above] = [Math.min(...seen.map((p) => p.y)), Math.max(...seen.map((p) => p.y))];
      const half = distance * Math.tan((kFieldOfView / 2) * Math.PI / 180); // of the height [m]
      const {elements} = this.camera.matrixWorld;
      target.addScaledVector(new Vector3(...elements.slice(0, 3)), half * this.camera.aspect * (left + right) / 2)
        .addScaledVector(new Vector3(...elements.slice(4, 7)), half * (below + above) / 2);
      const fill = Math.max(right - left, above - below) / 2;
      distance = Math.min(20 * radius, Math.max(0.5 * radius, distance * (0.4 + 0.6 * fill / 0.86)));
    }
    this.camera.position.copy(target).addScaledVector(towards, distance);
  }

  /** Marks a scan and its points. */
  pick(scan) {
    const indices = scan ? placesOfScan(this.run, scan) : [];
    this.picked.visible = indices.length > 0;
    this.picked.geometry.setIndex(indices);
    this.draw();
  }

  /** Where a place of the world is on the canvas [CSS px], or null behind the camera. */
  toPixel(place) {
    const p = new Vector3(...this.space.local(place)).project(this.camera);
    if (p.z > 1) return null;
    return [(p.x + 1) / 2 * this.canvas.clientWidth, (1 - p.y) / 2 * this.canvas.clientHeight];
  }

  /** The scan whose position is nearest to a pixel, or null. */
  scanAt(x, y) {
    let nearest = null, least = 14; // [px]
    for (const scan of this.run.scans) {
      const pixel = isPlace(scan.position) ? this.toPixel(scan.position) : null;
      const distance = pixel ? Math.hypot(pixel[0] - x, pixel[1] - y) : Infinity;
      if (distance < least) [nearest, least] = [scan, distance];
    }
    return nearest;
  }
}
