// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// Colours of values: maps for quantities, distinct colours for numbered groups.

import { colourMap } from './data.js';

export const GROUPS = 1024;
const NONE = [150, 150, 150];

const channel = (v) => Math.round(255 * Math.min(1, Math.max(0, v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055)));

/** OKLCh to the bytes of sRGB. Based on: Ottosson. A perceptual color space for image processing. 2020. */
function screen(lightness, chroma, hue) {
  const a = chroma * Math.cos(hue), b = chroma * Math.sin(hue);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    channel(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    channel(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    channel(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  ];
}

/** Hues a golden section of the circle apart, in two shades. */
function groupBytes() {
  const bytes = new Uint8Array(3 * GROUPS);
  for (let i = 0; i < GROUPS; i++)
    bytes.set(screen(i % 2 ? 0.62 : 0.76, 0.13, 2.39996323 * i + 4.3), 3 * i);
  return bytes;
}

export const groups = groupBytes();

/** The bytes of the colour of a numbered group; of no group (below zero) grey. */
export function groupColour(number) {
  if (number < 0) return NONE;
  const at = 3 * (number % GROUPS);
  return [groups[at], groups[at + 1], groups[at + 2]];
}

export const css = ([red, green, blue]) => `rgb(${red}, ${green}, ${blue})`;

/** The colour maps of a scene, 256 triples of bytes each. */
export function mapsOf(scene) {
  const maps = { groups: { bytes: groups } };
  for (const name of Object.keys(scene.maps)) maps[name] = { bytes: colourMap(scene, name) };
  return maps;
}

const OPAQUE = 0xff000000;
const GREY = OPAQUE | (NONE[2] << 16) | (NONE[1] << 8) | NONE[0];

/** Triples of bytes as numbers of four, the last being opacity. */
function packed(bytes) {
  return Uint32Array.from({ length: bytes.length / 3 }, (_, i) =>
    (OPAQUE | (bytes[3 * i + 2] << 16) | (bytes[3 * i + 1] << 8) | bytes[3 * i]) >>> 0);
}

function roomFor(values, room) {
  return room?.length === 4 * values.length ? room : new Uint8Array(4 * values.length);
}

/** Colours of quantities: 4 bytes for each value; within: what is outside the range is not shown. */
export function tintsOfMap(values, [low, high], map, within, room) {
  const bytes = roomFor(values, room);
  const out = new Uint32Array(bytes.buffer);
  const table = packed(map.bytes);
  const factor = 255 / (high - low);
  for (let i = 0; i < values.length; i++) {
    const value = values[i];
    if (within && !(value >= low && value <= high)) out[i] = 0;
    else if (!(Math.abs(value) <= 3e38)) out[i] = GREY;
    else {
      const at = (value - low) * factor;
      out[i] = table[at <= 0 ? 0 : at >= 255 ? 255 : (at + 0.5) | 0];
    }
  }
  return bytes;
}

/** Colours of numbered groups, of which some are hidden. */
export function tintsOfGroups(values, hidden, room) {
  const bytes = roomFor(values, room);
  const out = new Uint32Array(bytes.buffer);
  const table = packed(groups);
  for (let i = 0; i < values.length; i++) {
    const value = values[i];
    out[i] = hidden.size && hidden.has(value) ? 0 : value < 0 ? GREY : table[value % GROUPS];
  }
  return bytes;
}

/** The bytes of the colour at t of 0 to 1. */
export function colourAt(map, t) {
  const at = 3 * Math.round(255 * Math.min(1, Math.max(0, t)));
  return [map.bytes[at], map.bytes[at + 1], map.bytes[at + 2]];
}

/** Draws a map from left to right. */
export function drawBar(canvas, map) {
  const context = canvas.getContext('2d');
  const image = context.createImageData(256, 1);
  for (let i = 0; i < 256; i++) image.data.set([...colourAt(map, i / 255), 255], 4 * i);
  context.putImageData(image, 0, 0);
}
