// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// Numbers, units and texts.

const MINUS = '\u2212';

/** A number with so many significant digits, without needless zeros. */
export function short(value, digits = 5) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? 'no value' : String(value);
  return String(Number(value.toPrecision(digits))).replaceAll('-', MINUS);
}

/** A number with so many decimals. */
export function fixed(value, decimals) {
  const text = value.toFixed(decimals);
  return (Number(text) === 0 ? text.replace('-', '') : text).replace('-', MINUS);
}

/** A count with thin spaces between thousands. */
export function count(value) {
  return String(value).replace(/\B(?=(\d{3})+$)/g, '\u2009');
}

/** The name that the reader gave to the unit of the file; '' for none. */
export const unit = { name: '' };

/** Decimals that a length is worth, from the size of the scene: six digits of it. */
export function decimalsFor(size) {
  return Math.min(12, Math.max(0, 5 - Math.floor(Math.log10(size))));
}

const withUnit = (text, power) => {
  if (!unit.name) return text;
  return `${text}\u00a0${unit.name}${['', '', '\u00b2', '\u00b3'][power]}`;
};

/** A length (power 1), area (2) or volume (3) with its unit. */
export function measure(value, power = 1, digits = 6) {
  return withUnit(short(value, digits), power);
}

/** A coordinate or distance with fixed decimals and its unit. */
export function coordinate(value, decimals) {
  return withUnit(fixed(value, decimals), 1);
}

/** An angle in degrees. */
export function degrees(value, decimals = 3) {
  return `${fixed(value, decimals)}\u00b0`;
}

/** An element with text, which is never read as HTML. */
export function element(name, text = '', properties = {}) {
  const made = Object.assign(document.createElement(name), properties);
  made.textContent = text;
  return made;
}

export const get = (id) => document.getElementById(id);
