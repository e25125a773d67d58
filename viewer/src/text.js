// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

/** A number with so many significant digits, without needless zeros. */
export function short(value, digits = 5) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? 'no value' : String(value);
  return String(Number(value.toPrecision(digits))).replace('-', '\u2212');
}

/** A count with thin spaces between thousands. */
export function count(value) {
  return String(value).replace(/\B(?=(\d{3})+$)/g, '\u2009');
}

/** An element with text, which is never read as HTML. */
export function element(name, text = '', properties = {}) {
  const made = Object.assign(document.createElement(name), properties);
  made.textContent = text;
  return made;
}
