// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// The stage: camera, light, controls and drawing. It draws when something changed and rests
// otherwise. Coordinates are those of the page: relative to the centre of the scene, -1 to 1.

import {
  AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, LineBasicMaterial, LineSegments,
  DoubleSide, Mesh, MeshBasicMaterial, PerspectiveCamera, Plane, Scene, Spherical, Vector3, Vector4, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { NO_CUT, ringOf } from './dots.js';
import { endsOf, nearer, thickLinesOf } from './layers.js';
import { theme } from './theme.js';

/** Where the eye stands, seen from the centre. */
export const views = {
  home: [0.346, -0.742, 0.574],
  '+x': [1, 0, 0],
  '\u2212x': [-1, 0, 0],
  '+y': [0, 1, 0],
  '\u2212y': [0, -1, 0],
  '+z': [0, 0, 1],
  '\u2212z': [0, 0, -1],
};

/** While the scene moves a drawing should take no longer than this, in milliseconds. */
const FRAME = 33;
const REST = 180;
const PICKED = '#ff2ec4';

function boxOf(size) {
  const [x, y, z] = size;
  const corners = [];
  for (let i = 0; i < 8; i++) corners.push(i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? z : -z);
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(corners), 3));
  geometry.setIndex([0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7]);
  return new LineSegments(geometry, new LineBasicMaterial({ color: '#8a8a99', transparent: true, opacity: 0.5 }));
}

/** Without a graphics processor smooth borders of lines cost more than all else. */
function drawsInSoftware() {
  const context = document.createElement('canvas').getContext('webgl2');
  const facts = context?.getExtension('WEBGL_debug_renderer_info');
  const name = facts ? context.getParameter(facts.UNMASKED_RENDERER_WEBGL) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

export class Stage {
  constructor(canvas, halfSize, layers) {
    this.canvas = canvas;
    this.layers = layers;
    this.sizeFactor = 1;
    this.drawings = 0;
    this.marks = [];
    this.frames = [];
    this.moves = false;
    this.fence = null;
    const slow = drawsInSoftware();
    this.renderer = new WebGLRenderer({ canvas, antialias: !slow });
    this.budget = slow ? 40000 : 1000000;
    this.renderer.localClippingEnabled = true;
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(30, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.box = boxOf(halfSize);
    this.ring = ringOf(16 * window.devicePixelRatio);
    this.halfSize = halfSize;
    this.radius = Math.hypot(...halfSize);
    this.scene.add(this.camera, this.box, this.ring, ...layers.map((layer) => layer.group));
    this.addLights();
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.minDistance = 0.02;
    this.controls.maxDistance = 40;
    this.controls.addEventListener('change', () => this.moving());
    new ResizeObserver(() => this.resize()).observe(canvas);
    theme.onChange(() => this.applyScheme());
    this.applyScheme();
    this.resize();
    this.look('home');
  }

  /** Light from above the left shoulder of the eye, so that no side is ever black. */
  addLights() {
    const key = new DirectionalLight('#ffffff', 2.1);
    key.position.set(-1.1, 1.2, 1.4);
    this.camera.add(key, key.target);
    this.scene.add(new AmbientLight('#ffffff', 1.25));
  }

  applyScheme() {
    this.scene.background = new Color(theme.dark ? '#16171b' : '#ffffff');
    for (const layer of this.layers)
      {
      if (layer.thick) layer.thick.material.color.set(theme.dark ? '#f4f4f8' : layer.description.colour);
      if (layer.lines) layer.lines.material.color.set(theme.dark ? '#0c1220' : '#3a4a68');
    }
    this.refresh();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** The room beside or above the panel, where the scene should be: [x, y, width, height]. */
  freeRoom() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const panel = document.getElementById('panel').getBoundingClientRect();
    if (panel.width > 0.7 * width) {
      const top = document.getElementById('tools').getBoundingClientRect().bottom;
      return [0, top, width, Math.max(0.25 * height, panel.top - top)];
    }
    const left = Math.min(panel.right, 0.5 * width);
    return [left, 0, width - left, height];
  }

  /** How far away the eye must stand for the box to fit a part of the window, in its heights. */
  distanceFor(direction, width, height) {
    const half = Math.tan((this.camera.fov * Math.PI) / 360);
    const upright = Math.abs(direction.z) > 0.999 ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1);
    const right = new Vector3().crossVectors(upright, direction).normalize();
    const up = new Vector3().crossVectors(direction, right);
    const position = this.box.geometry.attributes.position;
    let distance = 0;
    for (let i = 0; i < position.count; i++) {
      const corner = new Vector3().fromBufferAttribute(position, i);
      const aside = Math.max(Math.abs(corner.dot(right)) / width, Math.abs(corner.dot(up)) / height);
      distance = Math.max(distance, corner.dot(direction) + aside / half);
    }
    return distance;
  }

  /** Shows everything from a named view. */
  look(name) {
    const direction = new Vector3(...views[name]).normalize();
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const [x, y, roomWidth, roomHeight] = this.freeRoom();
    const distance = this.distanceFor(direction, (0.94 * roomWidth) / height, (0.94 * roomHeight) / height);
    this.camera.setViewOffset(width, height,
      (width - roomWidth) / 2 - x, (height - roomHeight) / 2 - y, width, height);
    this.camera.near = 0.005 * this.radius;
    this.camera.far = 60 * Math.max(1, this.radius);
    this.controls.target.set(0, 0, 0);
    this.camera.position.copy(direction.multiplyScalar(distance));
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.refresh();
  }

  /** Turns the eye about the target by angles to the right and up. */
  turn(right, up) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const zUp = new Spherical().setFromVector3(new Vector3(offset.x, offset.z, -offset.y));
    zUp.theta += right;
    zUp.phi = Math.min(Math.PI - 1e-3, Math.max(1e-3, zUp.phi - up));
    const turned = new Vector3().setFromSpherical(zUp);
    this.camera.position.copy(this.controls.target).add(new Vector3(turned.x, -turned.z, turned.y));
    this.controls.update();
    this.moving();
  }

  /** Moves the scene by fractions of the window's height. */
  move(right, up) {
    const distance = this.camera.position.distanceTo(this.controls.target);
    const step = 2 * distance * Math.tan((this.camera.fov * Math.PI) / 360);
    const x = new Vector3().setFromMatrixColumn(this.camera.matrix, 0).multiplyScalar(-right * step);
    const y = new Vector3().setFromMatrixColumn(this.camera.matrix, 1).multiplyScalar(-up * step);
    for (const place of [this.camera.position, this.controls.target]) place.add(x).add(y);
    this.controls.update();
    this.moving();
  }

  zoom(factor) {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.moving();
  }

  /** Marks one place, or none. */
  mark(place) {
    this.ring.visible = Boolean(place);
    if (place) this.ring.geometry.attributes.position.copyArray(place).needsUpdate = true;
    this.refresh();
  }

  /** Where a place falls on the canvas, in CSS pixels, with its depth of -1 to 1. */
  project(place) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const spot = new Vector3(...place).project(this.camera);
    return { x: ((spot.x + 1) / 2) * width, y: ((1 - spot.y) / 2) * height, depth: spot.z };
  }

  /** Marks items of layers of surfaces or curves: { layer, item } each. */
  emphasise(items) {
    for (const mark of this.marks) {
      this.scene.remove(mark);
      mark.geometry.dispose();
      mark.material.dispose();
    }
    this.marks = items.map(({ layer, item }) => (layer.mesh ? this.patchOf(layer, item) : this.strokeOf(layer, item)));
    for (const mark of this.marks) {
      mark.material.clippingPlanes = this.planes ?? [];
      this.scene.add(mark);
    }
    this.refresh();
  }

  strokeOf(layer, item) {
    const ends = endsOf(layer.positions, layer.links, ...layer.linksOf(item));
    const stroke = thickLinesOf(ends, PICKED, 6);
    stroke.renderOrder = 5;
    return stroke;
  }

  patchOf(layer, item) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', layer.mesh.geometry.attributes.position);
    geometry.setIndex(layer.trianglesOf(item));
    return new Mesh(geometry, new MeshBasicMaterial({
      color: PICKED, side: DoubleSide, transparent: true, opacity: 0.3, depthWrite: false,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    }));
  }

  /** Shows only where normal . place <= distance; null: everything. */
  cutBy(normal, distance) {
    this.planes = normal ? [new Plane(normal.clone().negate(), distance)] : [];
    const cut = normal ? new Vector4(normal.x, normal.y, normal.z, distance) : NO_CUT;
    for (const layer of this.layers) layer.cutBy(this.planes, cut);
    for (const mark of this.marks) mark.material.clippingPlanes = this.planes;
    this.refresh();
  }

  /** The scene has just moved: it is drawn at once with the points there is time for, and again with
   * all of them when it rests. */
  moving() {
    this.moves = true;
    this.refresh();
  }

  refresh() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => this.frame());
  }

  frame() {
    this.draw(this.moves ? this.budget : Infinity);
    if (this.moves) this.watch();
  }

  /** Waits until what was asked for is drawn, which tells how long it takes; then for a rest. */
  watch() {
    const gl = this.renderer.getContext();
    const now = performance.now();
    if (this.fence) {
      gl.deleteSync(this.fence);
      if (now - this.begun > FRAME) this.adapt(now - this.begun);
    }
    clearTimeout(this.resting);
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.begun = now;
    gl.flush();
    this.resting = setTimeout(() => this.lookBack(), 4);
  }

  lookBack() {
    const gl = this.renderer.getContext();
    if (gl.getSyncParameter(this.fence, gl.SYNC_STATUS) !== gl.SIGNALED) {
      this.resting = setTimeout(() => this.lookBack(), 4);
      return;
    }
    gl.deleteSync(this.fence);
    this.fence = null;
    this.adapt(performance.now() - this.begun);
    this.resting = setTimeout(() => {
      this.moves = false;
      this.refresh();
    }, REST);
  }

  /** Draws more or fewer points, as the time that a drawing took suggests. */
  adapt(time) {
    this.frames.push(time);
    if (this.frames.length > 120) this.frames.shift();
    if (time > FRAME) this.budget = Math.max(20000, this.budget * Math.max(0.25, FRAME / time));
    else if (time < 0.7 * FRAME) this.budget = Math.min(1e7, this.budget * 1.15);
  }

  draw(most = Infinity) {
    this.waiting = false;
    const ratio = this.renderer.getPixelRatio();
    const perPixel = (2 * Math.tan((this.camera.fov * Math.PI) / 360)) / (this.canvas.clientHeight * ratio);
    for (const { dots } of this.layers) dots?.prepare(this.sizeFactor, ratio, perPixel, most);
    const largest = this.layers.reduce((size, { dots }) => Math.max(size, dots?.uniforms.size.value ?? 0), 0);
    nearer.value = (0.6 * largest + 1) * perPixel;
    this.renderer.render(this.scene, this.camera);
    this.drawings++;
    if (this.afterDrawing) this.afterDrawing();
  }
}
