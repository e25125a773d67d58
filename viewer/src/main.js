// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// The page begins here. `window.crease` is its state, for tests and for the console:
//
//   state       'loading', then 'ready' or 'failed'
//   message     why it failed
//   times       { unpacked, ready }: milliseconds since the page was asked for
//   drawings    how often the scene was drawn; frames: the last times between two of them while it moved
//   budget      how many points are drawn while it moves
//   layers      [{ name, kind, count, visible }]
//   colouring   { field, range }
//   picked      { kind, layer, item, position } of what is picked, of a point also { index, values }; or null
//   tool        'pick' or 'measure'; measured: rows { name, value } of what is measured
//   section     { on, axis, at }
//   setVisible(layer, shown), colourBy(field), setRange([from, to]), look(view)
//   spot(layer, point)   where a point is on the page: { x, y } in CSS pixels
//   place(position)      the same for a place of the file

import { Vector3 } from 'three';
import { Card } from './card.js';
import { Colouring, Shading } from './colouring.js';
import { mapsOf } from './colours.js';
import { drawCompass } from './compass.js';
import { description, readNumbers } from './data.js';
import { shapeOf } from './geometry.js';
import { listenToKeys } from './keys.js';
import { layersOf } from './layers.js';
import { Measure } from './measure.js';
import { Overlay } from './overlay.js';
import { Panel } from './panel.js';
import { pick } from './pick.js';
import { savePicture } from './picture.js';
import { Section } from './section.js';
import { Stage } from './stage.js';
import { theme } from './theme.js';
import { get } from './text.js';

const canvas = get('view');
const hook = { state: 'loading', message: '', times: {} };
window.crease = hook;

/** Says something to those who do not see it. */
function say(text) {
  get('status').textContent = text;
}

class App {
  constructor(scene) {
    this.scene = scene;
    this.tool = 'pick';
    this.current = null;
    const maps = mapsOf(scene);
    const halfSize = scene.highest.map((high, c) => (high - scene.lowest[c]) / 2 / scene.scale);
    this.stage = new Stage(canvas, halfSize, layersOf(scene));
    this.overlay = new Overlay(this.stage);
    this.card = new Card(scene, this.stage);
    this.measure = new Measure(scene, this.overlay);
    this.section = new Section(scene, this.stage, () => this.direction(), say);
    this.panel = new Panel(scene, this.stage, say);
    this.colouring = new Colouring(this.stage, maps, say);
    this.shading = new Shading(this.stage, maps);
    this.connect();
  }

  connect() {
    const compass = get('compass');
    this.stage.afterDrawing = () => {
      drawCompass(compass, this.stage.camera);
      this.overlay.place();
    };
    this.stage.afterLayout = () => this.layOut();
    this.panel.onLayers = () => this.section.outlines();
    this.panel.onUnit = () => this.tellUnit();
    theme.onChange(() => this.stage.refresh());
    get('tool-pick').addEventListener('click', () => this.use('pick'));
    get('tool-measure').addEventListener('click', () => this.use(this.tool === 'measure' ? 'pick' : 'measure'));
    get('tool-section').addEventListener('click', () => this.section.toggle());
    get('tool-picture').addEventListener('click', () => this.savePicture());
    get('tool-help').addEventListener('click', () => this.help());
    get('let-go').addEventListener('click', () => this.letGo());
    this.listenToClicks();
    listenToKeys(this);
    this.layOut();
  }

  /** The small scale over the scene is for when the panel does not show it. */
  layOut() {
    get('key').hidden = !this.panel.folded || get('key').classList.contains('empty');
  }

  /** A click is a press and a release of one pointer at nearly the same place. */
  listenToClicks() {
    let pressed = null;
    canvas.addEventListener('pointerdown', (event) => { pressed = event.isPrimary && event.button === 0 ? event : null; });
    canvas.addEventListener('pointerup', (event) => {
      const slack = event.pointerType === 'touch' ? 10 : 4;
      if (!pressed || Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) > slack) return;
      const frame = canvas.getBoundingClientRect();
      this.pickAt(event.clientX - frame.left, event.clientY - frame.top, event.pointerType);
    });
  }

  pickAt(x, y, pointer) {
    const wanted = document.querySelector('#reach input:checked').value;
    this.choose(pick(this.stage, x, y, pointer, wanted));
  }

  /** Coordinates of the file, to the digits that single precision holds. */
  positionOf(place) {
    const { centre, scale } = this.scene;
    const decimals = Math.min(15, Math.max(0, 6 - Math.floor(Math.log10(scale))));
    return place.toArray().map((v, c) => Number((centre[c] + scale * v).toFixed(decimals)));
  }

  choose(found) {
    if (!found && this.tool === 'pick') this.letGo();
    if (!found) return;
    this.panel.makeRoom();
    if (this.tool === 'measure') {
      this.measured = this.measure.add(found);
      this.card.measured(this.measure.picks, this.measured);
    }
    this.mark(found);
    if (this.tool === 'pick') this.card.tell(found, this.positionOf(found.place));
    say(get('picked').innerText);
  }

  mark(found) {
    this.current = found;
    this.stage.mark(found && found.kind !== 'edge' ? found.place.toArray() : null);
    const marked = this.tool === 'measure' ? this.measure.picks : [];
    this.stage.emphasise([...marked, found].filter((one) => one && one.kind !== 'point'));
  }

  /** Lets go of what is picked or measured; without that, of the tool. */
  letGo() {
    const held = this.current || this.measure.picks.length;
    this.measure.clear();
    this.mark(null);
    this.measured = [];
    if (this.tool === 'measure' && held) this.card.measured([], []);
    else if (this.tool === 'measure') this.use('pick');
    else this.card.hide();
  }

  use(tool) {
    this.tool = tool;
    for (const name of ['pick', 'measure']) get(`tool-${name}`).setAttribute('aria-pressed', String(name === tool));
    canvas.classList.toggle('aim', tool === 'measure');
    this.measure.clear();
    this.measured = [];
    this.mark(null);
    this.card.hide();
    if (tool === 'measure') {
      this.panel.makeRoom();
      this.card.measured([], []);
      say('Measure: pick the first point, edge or face');
    }
  }

  /** The next or previous face or edge, for those who do not point. */
  step(kind, by) {
    const all = this.stage.layers
      .filter((layer) => layer.visible && (kind === 'face' ? layer.mesh : layer.links))
      .flatMap((layer) => Array.from({ length: layer.items }, (_, item) => ({ layer, item })));
    if (!all.length) return;
    const at = all.findIndex(({ layer, item }) => layer === this.current?.layer && item === this.current?.item);
    const { layer, item } = all[at < 0 ? (by > 0 ? 0 : all.length - 1) : (at + by + all.length) % all.length];
    this.choose({ kind, layer, item, ...this.placeOn(layer, item) });
  }

  /** A place on an item, with its normal or tangent. */
  placeOn(layer, item) {
    if (layer.links) {
      const nodes = layer.nodesOf(item).map((node) => new Vector3(...node));
      const at = Math.floor((nodes.length - 1) / 2);
      return { place: nodes[at].clone().lerp(nodes[at + 1], 0.5), tangent: nodes[at + 1].clone().sub(nodes[at]).normalize() };
    }
    const corners = layer.trianglesOf(item);
    const p = layer.mesh.geometry.attributes.position;
    const first = 3 * Math.floor(corners.length / 6);
    const [a, b, c] = [0, 1, 2].map((k) => new Vector3().fromBufferAttribute(p, corners[first + k] ?? 0));
    const normal = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
    return { place: a.add(b).add(c).multiplyScalar(1 / 3), normal };
  }

  /** The direction of what is picked, for a section across it: { direction, place } or null. */
  direction() {
    const found = this.current;
    if (!found) return null;
    const { place } = found;
    if (found.kind === 'edge') return { direction: this.edgeDirection(found), place };
    const of = found.kind === 'point' ? this.card.itemOf(found.layer, found.item) : found;
    const known = of && (of.layer.fact(of.item, 'normal') ?? of.layer.fact(of.item, 'axis'));
    const direction = known ? new Vector3(...known) : found.normal;
    return direction ? { direction, place } : null;
  }

  edgeDirection({ layer, item, tangent }) {
    const { shape, axis, direction } = shapeOf(layer.nodesOf(item));
    if (shape === 'circle') return new Vector3(...axis);
    return shape === 'straight' ? new Vector3(...direction) : tangent;
  }

  tellUnit() {
    this.colouring.setRange(this.colouring.range);
    this.shading.shadeBy(get('shade').value);
    if (this.section.on) this.section.show();
    if (this.tool === 'measure') {
      this.card.measured(this.measure.picks, this.measured ?? []);
      if (this.measured?.length) this.overlay.label.textContent = this.measure.headline();
    } else if (this.current) this.card.tell(this.current, this.positionOf(this.current.place));
  }

  async savePicture() {
    const name = await savePicture(this.scene, this.stage, this.colouring, this.overlay);
    say(`Saved ${name}`);
    hook.saved = name;
  }

  help() { get('help').showModal(); }

  get picked() {
    if (!this.current) return null;
    const { kind, layer, item, place } = this.current;
    const told = { kind, layer: this.stage.layers.indexOf(layer), item, position: this.positionOf(place) };
    if (kind !== 'point') return { ...told, facts: Object.fromEntries(layer.facts.get(item) ?? []) };
    return { ...told, index: item, values: Object.fromEntries(layer.fields.map(({ name, values }) => [name, values[item]])) };
  }
}

function describeState(app) {
  const { stage, panel, colouring, section, scene } = app;
  const getters = {
    drawings: () => stage.drawings,
    frames: () => stage.frames,
    budget: () => stage.budget,
    layers: () => stage.layers.map(({ name, kind, count: size, visible }) => ({ name, kind, count: size, visible })),
    colouring: () => ({ field: colouring.field, range: colouring.range }),
    picked: () => app.picked,
    tool: () => app.tool,
    measured: () => app.measured ?? [],
    section: () => ({ on: section.on, axis: section.axis, at: section.on ? section.number() : null }),
  };
  for (const [name, read] of Object.entries(getters)) Object.defineProperty(hook, name, { get: read });
  hook.setVisible = (index, shown) => panel.setVisible(index, shown);
  hook.colourBy = (name) => colouring.colourBy(name);
  hook.setRange = (range) => colouring.setRange(range);
  hook.look = (name) => stage.look(name);
  hook.spot = (layer, point) => stage.project(stage.layers[layer].positions.subarray(3 * point, 3 * point + 3));
  hook.place = (position) => stage.project(position.map((v, c) => (v - scene.centre[c]) / scene.scale));
}

async function start() {
  const scene = description();
  await readNumbers();
  hook.times.unpacked = performance.now();
  const app = new App(scene);
  app.stage.look('home');
  describeState(app);
  get('loading').hidden = true;
  app.stage.draw();
  hook.times.ready = performance.now();
  hook.state = 'ready';
}

start().catch((error) => {
  const message = get('message');
  const webgl = /webgl/i.test(error.message);
  hook.state = 'failed';
  hook.message = error.message;
  get('loading').hidden = true;
  message.textContent = webgl
    ? 'The scene cannot be drawn: this browser offers no WebGL 2. Turn on graphics acceleration or use another browser.'
    : `The scene cannot be shown: ${error.message}.`;
  message.hidden = false;
});
