// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// What measuring draws over the scene: a line seen through everything, and its length beside it.

import { Vector3 } from 'three';
import { thickLinesOf } from './layers.js';
import { element, get } from './text.js';

const COLOUR = '#ff2ec4';

export class Overlay {
  constructor(stage) {
    this.stage = stage;
    this.label = element('span');
    this.label.hidden = true;
    get('overlay').append(this.label);
  }

  /** Shows a line between two places of the page with a text; null: nothing. */
  show(line, text = '') {
    if (this.line) {
      this.stage.scene.remove(this.line);
      this.line.geometry.dispose();
      this.line.material.dispose();
      this.line = null;
    }
    this.label.hidden = !line || !text;
    this.label.textContent = text;
    if (line) {
      this.line = thickLinesOf(Float32Array.from(line.flat()), COLOUR, 2.5);
      Object.assign(this.line.material, { depthTest: false, transparent: true });
      this.line.renderOrder = 9;
      this.stage.scene.add(this.line);
      this.middle = new Vector3(...line[0]).add(new Vector3(...line[1])).multiplyScalar(0.5);
    }
    this.stage.refresh();
  }

  /** Keeps the text beside its line. */
  place() {
    if (this.label.hidden) return;
    const { x, y } = this.stage.project(this.middle.toArray());
    this.label.style.transform = `translate(${Math.round(x + 10)}px, ${Math.round(y - 12)}px)`;
  }
}
