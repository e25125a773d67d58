// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// The page begins here. `window.crease` is its state, for tests and for the console:
//
//   state       'loading', then 'ready' or 'failed'
//   message     why it failed
//   drawings    how often the scene was drawn
//   layers      [{ name, kind, count, visible }]
//   colouring   { field, range }
//   picked      { layer, index, position, values } of the point picked, or null
//   setVisible(layer, shown), colourBy(field), setRange([from, to]), look(view)
//   spot(layer, point)   where a point is on the page: { x, y } in CSS pixels

import { drawCompass } from './compass.js';
import { description } from './data.js';
import { layersOf, mapsOf } from './layers.js';
import { Panel } from './panel.js';
import { pick } from './pick.js';
import { Stage, views } from './stage.js';
import { count, short } from './text.js';

const canvas = document.getElementById('view');
const hook = { state: 'loading', message: '', picked: null };
window.crease = hook;

/** The coordinates of a point, to the digits that single precision holds. */
function positionOf(scene, layer, index) {
  const decimals = Math.min(15, Math.max(0, 6 - Math.floor(Math.log10(scene.scale))));
  return [0, 1, 2].map((c) =>
    Number((scene.centre[c] + scene.scale * layer.positions[3 * index + c]).toFixed(decimals)));
}

function choose(scene, stage, panel, found) {
  if (!found) {
    hook.picked = null;
    stage.mark(null);
    panel.showPicked(null);
    return;
  }
  const { layer, index } = found;
  const position = positionOf(scene, layer, index);
  const values = Object.fromEntries(layer.fields.map((field) => [field.name, field.values[index]]));
  hook.picked = { layer: stage.layers.indexOf(layer), index, position, values };
  stage.mark(layer.positions.subarray(3 * index, 3 * index + 3));
  panel.showPicked([
    [layer.name || 'points', `no. ${count(index)}`],
    ...position.map((value, c) => ['xyz'[c], short(value, 15)]),
    ...layer.fields.map((field) => [field.name, short(field.values[index], field.type === 'float32' ? 6 : 15)]),
  ]);
}

/** A click is a press and a release at nearly the same place. */
function listenToClicks(scene, stage, panel) {
  let pressed = null;
  canvas.addEventListener('pointerdown', (event) => { pressed = event; });
  canvas.addEventListener('pointerup', (event) => {
    if (!pressed || Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) > 4) return;
    const frame = canvas.getBoundingClientRect();
    choose(scene, stage, panel,
      pick(stage, event.clientX - frame.left, event.clientY - frame.top, event.pointerType));
  });
}

function listenToKeys(scene, stage, panel) {
  const step = Math.PI / 24;
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const arrow = arrows[event.key];
    const name = Object.keys(views)[Number(event.key) - 1];
    if (arrow && event.shiftKey) stage.move(0.06 * arrow[0], 0.06 * arrow[1]);
    else if (arrow) stage.turn(step * arrow[0], step * arrow[1]);
    else if (event.key === '+' || event.key === '=') stage.zoom(1 / 1.15);
    else if (event.key === '-') stage.zoom(1.15);
    else if (event.key === 'Escape') choose(scene, stage, panel, null);
    else if (name) stage.look(name);
    else return;
    event.preventDefault();
  });
}

function describeState(stage, panel) {
  Object.defineProperties(hook, {
    drawings: { get: () => stage.drawings },
    layers: {
      get: () => stage.layers.map(({ name, kind, count: size, visible }) => ({ name, kind, count: size, visible })),
    },
    colouring: { get: () => ({ field: panel.field, range: panel.range }) },
  });
  hook.setVisible = (index, shown) => panel.setVisible(index, shown);
  hook.colourBy = (name) => panel.colourBy(name);
  hook.setRange = (range) => panel.setRange(range);
  hook.look = (name) => stage.look(name);
  hook.spot = (layer, point) => stage.project(stage.layers[layer].positions.subarray(3 * point, 3 * point + 3));
}

function start() {
  const scene = description();
  const layers = layersOf(scene);
  const maps = mapsOf(scene);
  const halfSize = scene.highest.map((high, c) => (high - scene.lowest[c]) / 2 / scene.scale);
  const stage = new Stage(canvas, halfSize, layers);
  const compass = document.getElementById('compass');
  stage.afterDrawing = () => drawCompass(compass, stage.camera);
  const panel = new Panel(scene, stage, maps);
  stage.look('home');
  listenToClicks(scene, stage, panel);
  listenToKeys(scene, stage, panel);
  describeState(stage, panel);
  stage.draw();
  hook.state = 'ready';
}

try {
  start();
} catch (error) {
  const message = document.getElementById('message');
  const webgl = /webgl/i.test(error.message);
  hook.state = 'failed';
  hook.message = error.message;
  message.textContent = webgl
    ? 'The scene cannot be drawn: this browser offers no WebGL 2. Turn on graphics acceleration or use another browser.'
    : `The scene cannot be shown: ${error.message}.`;
  message.hidden = false;
}
