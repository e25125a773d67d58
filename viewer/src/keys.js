// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// The keyboard: everything that the pointer can do.

import { views } from './stage.js';
import { get } from './text.js';

const TURN = Math.PI / 24;
const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** Where keys have a meaning of their own. */
function isField(target) {
  return target.closest?.('input:not([type="checkbox"]), select, textarea, dialog') !== null && target.closest !== undefined;
}

/** Keys that turn and move the scene while it has the focus. */
function forScene(app, event) {
  const { stage } = app;
  const arrow = arrows[event.key];
  if (arrow && event.shiftKey) stage.move(0.06 * arrow[0], 0.06 * arrow[1]);
  else if (arrow) stage.turn(TURN * arrow[0], TURN * arrow[1]);
  else if (event.key === 'Enter') app.pickAt(stage.canvas.clientWidth / 2, stage.canvas.clientHeight / 2, 'touch');
  else return false;
  return true;
}

/** Keys that work wherever the focus is, but for fields. */
function everywhere(app) {
  const { stage, section, panel, colouring } = app;
  return {
    '+': () => stage.zoom(1 / 1.15),
    '=': () => stage.zoom(1 / 1.15),
    '-': () => stage.zoom(1.15),
    l: () => panel.fold(),
    c: () => colouring.next(),
    t: () => panel.nextTheme(),
    p: () => app.savePicture(),
    m: () => app.use(app.tool === 'measure' ? 'pick' : 'measure'),
    s: () => section.toggle(),
    x: () => section.across('x'),
    y: () => section.across('y'),
    z: () => section.across('z'),
    n: () => section.across('n'),
    '[': () => section.shift(-2),
    ']': () => section.shift(2),
    f: (event) => app.step('face', event.shiftKey ? -1 : 1),
    e: (event) => app.step('edge', event.shiftKey ? -1 : 1),
    '?': () => app.help(),
    Escape: () => app.letGo(),
  };
}

export function listenToKeys(app) {
  const meanings = everywhere(app);
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || get('help').open) return;
    if (isField(event.target)) {
      if (event.key === 'Escape') event.target.blur();
      return;
    }
    const view = Object.keys(views)[Number(event.key) - 1];
    const meaning = meanings[event.key] ?? meanings[event.key.toLowerCase()];
    if (event.target === app.stage.canvas && forScene(app, event)) event.preventDefault();
    else if (view) app.stage.look(view);
    else if (meaning) meaning(event);
    else return;
    event.preventDefault();
  });
}
