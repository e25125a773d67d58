// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// The measure tool: two picks, and what lies between them. A third pick of points gives the angle.

import { corner, relate, shapeOf } from './geometry.js';
import { coordinate, decimalsFor, degrees } from './text.js';

/** What geometry.js needs to know of a pick. */
export function entityOf(scene, pick) {
  const inFile = (place) => place.map((v, c) => scene.centre[c] + scene.scale * v);
  const entity = { at: inFile(pick.place.toArray()) };
  const { layer, item } = pick;
  if (pick.kind === 'edge') {
    const found = shapeOf(layer.nodesOf(item).map(inFile));
    if (found.shape === 'straight') return { ...entity, place: found.place, axis: found.direction };
    if (found.shape === 'circle') return { ...entity, place: found.centre, axis: found.axis, radius: found.radius };
    return entity;
  }
  if (pick.kind === 'point') return entity;
  const place = layer.fact(item, 'place');
  const normal = layer.fact(item, 'normal'), axis = layer.fact(item, 'axis');
  if (place && normal) return { ...entity, place, normal, flat: true };
  if (place && axis) {
    const wall = layer.fact(item, 'type') === 'cylinder';
    return { ...entity, place, axis, radius: layer.fact(item, 'radius')?.[0], wall };
  }
  if (place && layer.fact(item, 'radius')) return { ...entity, centre: place };
  return { ...entity, place: entity.at, normal: pick.normal?.toArray() };
}

export class Measure {
  constructor(scene, overlay) {
    Object.assign(this, { scene, overlay });
    this.decimals = decimalsFor(2 * scene.scale);
    this.clear();
  }

  clear() {
    this.picks = [];
    this.rows = [];
    this.overlay.show(null);
  }

  /** Takes a pick; the rows of what is measured so far. */
  add(pick) {
    const full = this.picks.length >= 2 && !(this.picks.length === 2 && [...this.picks, pick].every(({ kind }) => kind === 'point'));
    if (full) this.clear();
    this.picks.push(pick);
    if (this.picks.length === 1) return [];
    const entities = this.picks.map((one) => entityOf(this.scene, one));
    const [a, b] = entities.slice(-2);
    const { rows, line } = relate(a, b);
    this.rows = rows;
    if (entities.length === 3) this.rows = [{ name: 'angle at the second', value: corner(...entities.map(({ at }) => at)), angle: true }, ...rows];
    this.overlay.show(line.map((place) => this.toPage(place)), this.headline());
    return this.rows;
  }

  toPage(place) {
    return place.map((v, c) => (v - this.scene.centre[c]) / this.scene.scale);
  }

  text({ value, angle }) {
    return angle ? degrees(value) : coordinate(value, this.decimals);
  }

  /** What is written beside the line: an angle unless it is as good as none, otherwise the first distance. */
  headline() {
    const angle = this.rows.find((row) => row.angle);
    const distance = this.rows.find((row) => !row.angle);
    return this.text(angle && (angle.value > 2 || this.picks.length === 3) ? angle : distance);
  }
}
