// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// The section plane: what lies beyond it is not drawn, and where it cuts faces their outline is.

import { Vector3 } from 'three';
import { thickLinesOf } from './layers.js';
import { coordinate, decimalsFor, fixed, get } from './text.js';

const AXES = { x: new Vector3(1, 0, 0), y: new Vector3(0, 1, 0), z: new Vector3(0, 0, 1) };
const STEPS = 1000;
const COLOUR = '#e07a00';

/** Where a plane cuts the triangles of a mesh: ends of segments. */
export function outline(mesh, normal, distance) {
  const p = mesh.geometry.attributes.position.array;
  const corners = mesh.geometry.index.array;
  const heights = new Float32Array(p.length / 3);
  for (let i = 0; i < heights.length; i++)
    heights[i] = normal.x * p[3 * i] + normal.y * p[3 * i + 1] + normal.z * p[3 * i + 2] - distance;
  const ends = [];
  for (let t = 0; t < corners.length; t += 3) {
    const before = ends.length;
    for (let k = 0; k < 3 && ends.length < before + 6; k++) {
      const a = corners[t + k], b = corners[t + ((k + 1) % 3)];
      if (heights[a] > 0 === heights[b] > 0) continue;
      const s = heights[a] / (heights[a] - heights[b]);
      for (let c = 0; c < 3; c++) ends.push(p[3 * a + c] + s * (p[3 * b + c] - p[3 * a + c]));
    }
    if (ends.length !== before + 6) ends.length = before;
  }
  return Float32Array.from(ends);
}

export class Section {
  /** picked() gives { direction, place } of what is picked, in coordinates of the page, or null. */
  constructor(scene, stage, picked, say) {
    Object.assign(this, { scene, stage, picked, say });
    this.on = false;
    this.axis = 'x';
    this.flipped = false;
    this.normal = AXES.x;
    this.at = 0;
    this.decimals = decimalsFor(2 * scene.scale);
    this.lines = [];
    for (const button of document.querySelectorAll('#section [data-axis]'))
      button.addEventListener('click', () => this.across(button.dataset.axis));
    get('cut').addEventListener('input', () => this.slide(Number(get('cut').value)));
    get('cut-at').addEventListener('change', () => this.moveTo(get('cut-at').valueAsNumber));
    get('cut-flip').addEventListener('click', () => this.flip());
    get('cut-off').addEventListener('click', () => this.toggle(false));
  }

  toggle(on = !this.on) {
    if (on) this.across(this.axis === 'n' ? 'x' : this.axis);
    else {
      this.on = false;
      this.apply();
      this.say('No section');
    }
  }

  /** Puts the plane across x, y, z or ('n') the direction of what is picked. */
  across(axis) {
    const picked = axis === 'n' ? this.picked() : null;
    if (axis === 'n' && !picked) {
      this.say('Pick a face, an edge or a point with a face first');
      return;
    }
    this.on = true;
    this.axis = axis;
    this.normal = picked ? picked.direction.clone().normalize() : AXES[axis];
    [this.low, this.high] = this.extent();
    this.at = picked ? this.normal.dot(picked.place) - 1e-4 * this.stage.radius : (this.low + this.high) / 2;
    this.apply();
    this.say(`Section across ${axis === 'n' ? 'the pick' : axis} at ${coordinate(this.number(), this.decimals)}`);
  }

  /** How far the box reaches along the normal. */
  extent() {
    const h = this.stage.halfSize;
    const reach = Math.abs(this.normal.x) * h[0] + Math.abs(this.normal.y) * h[1] + Math.abs(this.normal.z) * h[2];
    return [-reach, reach];
  }

  /** The place of the plane along its normal, as a number of the file. */
  number(at = this.at) {
    const { centre, scale } = this.scene;
    return scale * at + this.normal.x * centre[0] + this.normal.y * centre[1] + this.normal.z * centre[2];
  }

  slide(step) {
    this.at = this.low + ((this.high - this.low) * step) / STEPS;
    this.apply();
  }

  /** Shifts the plane by so many hundredths of its way. */
  shift(hundredths) {
    if (!this.on) return;
    this.at = Math.min(this.high, Math.max(this.low, this.at + ((this.high - this.low) * hundredths) / 100));
    this.apply();
    this.say(`Section at ${coordinate(this.number(), this.decimals)}`);
  }

  moveTo(number) {
    if (Number.isFinite(number)) this.at += (number - this.number()) / this.scene.scale;
    this.apply();
  }

  flip() {
    this.flipped = !this.flipped;
    this.apply();
  }

  apply() {
    get('section').hidden = !this.on;
    get('tool-section').setAttribute('aria-pressed', String(this.on));
    for (const button of document.querySelectorAll('#section [data-axis]'))
      button.setAttribute('aria-pressed', String(this.on && button.dataset.axis === this.axis));
    const sign = this.flipped ? -1 : 1;
    const kept = this.on ? this.normal.clone().multiplyScalar(sign) : null;
    this.stage.cutBy(kept, sign * this.at);
    this.outlines();
    if (this.on) this.show();
  }

  show() {
    get('cut').value = Math.round((STEPS * (this.at - this.low)) / (this.high - this.low));
    get('cut').setAttribute('aria-valuetext', coordinate(this.number(), this.decimals));
    get('cut-name').textContent = this.axis === 'n' ? 'along it' : this.axis;
    get('cut-at').value = Number(this.number().toFixed(this.decimals));
    get('cut-at').title = `normal ${this.normal.toArray().map((v) => fixed(v, 4)).join(', ')}`;
  }

  /** Draws where the plane cuts the visible faces. */
  outlines() {
    for (const line of this.lines) {
      this.stage.scene.remove(line);
      line.geometry.dispose();
      line.material.dispose();
    }
    this.lines = [];
    for (const layer of this.on ? this.stage.layers : []) {
      const ends = layer.mesh && layer.visible ? outline(layer.mesh, this.normal, this.at) : [];
      if (!ends.length) continue;
      const line = thickLinesOf(ends, COLOUR, 2.5);
      this.lines.push(line);
      this.stage.scene.add(line);
    }
    this.stage.refresh();
  }
}
