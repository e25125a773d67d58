// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// What the report says of faces, edges and regions, as rows to read: its names in words, its numbers
// with their units, a standard error beside what it belongs to.

import { coordinate, count, degrees, fixed, measure, short } from './text.js';

const length = (value, decimals) => coordinate(value, decimals + 1);
const angle = (value) => degrees(value);
const number = (value) => short(value, 4);

/** Names of the report: what they are called here, and how their numbers are written. */
const known = {
  place: ['place', length], normal: ['normal'], axis: ['axis'], radius: ['radius', length], tube_radius: ['tube radius', length],
  slope: ['half angle', (value) => angle((Math.atan(value) * 180) / Math.PI)],
  area: ['area', (value) => measure(value, 2)], points: ['points', (value) => count(value)], mean: ['mean deviation', length],
  rms: ['rms', length], p95: ['95 % within', length], max: ['largest', length], chi: ['\u03c7\u00b2 per point', number],
  length: ['length', length], angle: ['dihedral angle', angle], position: ['place', length],
  position_error: ['standard error of place', length], regions: ['regions'], faces: ['faces'], region: ['region'], edge: ['edge'],
  corners: ['corners'], smooth: ['smooth'], closed: ['closed'], type: ['type'],
};

const ERROR = /_error$/;

function words(name) {
  return known[name]?.[0] ?? name.replaceAll('_', ' ');
}

/** Unit vectors have four decimals, places the ones the scene is worth. */
function vector(name, value, decimals) {
  const unit = name === 'normal' || name === 'axis' || name === 'direction';
  return value.map((v) => (unit ? fixed(v, 5) : coordinate(v, decimals))).join('\n');
}

function text(name, value, decimals) {
  if (typeof value === 'string') return value;
  if (value.some((v) => v === null)) return 'not known';
  if (value.length === 3) return vector(name, value, decimals);
  const write = known[name]?.[1] ?? ((v) => short(v, 6));
  return value.map((v) => write(v, decimals)).join(', ');
}

/** Errors are written like what they belong to, with two digits. */
function errorText(name, value) {
  if (value.some((v) => v === null)) return '';
  const two = (v) => short(v, 2);
  const isAngle = name === 'angle' || name === 'slope';
  const isBare = name === 'normal' || name === 'axis';
  if (value.length === 3) return value.map((v) => (isBare ? two(v) : measure(v, 1, 2))).join('\n');
  return value.map((v) => (isAngle ? `${two(v)}\u00b0` : isBare ? two(v) : measure(v, 1, 2))).join(', ');
}

/** Rows [name, value, error or ''] of a list [name, value]; what is said elsewhere is left out. */
export function rowsOf(facts, decimals, leave = []) {
  const errors = new Map(facts.filter(([name]) => ERROR.test(name)).map(([name, value]) => [name.replace(ERROR, ''), value]));
  const names = new Set(facts.map(([name]) => name));
  return facts
    .filter(([name]) => !leave.includes(name) && !(ERROR.test(name) && names.has(name.replace(ERROR, ''))))
    .filter(([name, value]) => !(name === 'corners' && value.every((v) => v < 0)))
    .map(([name, value]) => [words(name), text(name, value, decimals), errors.has(name) ? errorText(name, errors.get(name)) : '']);
}
