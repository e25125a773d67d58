// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// Colours of values: maps for quantities, distinct colours for numbered groups.

import { ClampToEdgeWrapping, DataTexture, LinearFilter, NearestFilter, RGBAFormat } from 'three';
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

function textureOf(bytes, filter) {
  const size = bytes.length / 3;
  const rgba = new Uint8Array(4 * size);
  for (let i = 0; i < size; i++) rgba.set([bytes[3 * i], bytes[3 * i + 1], bytes[3 * i + 2], 255], 4 * i);
  const texture = new DataTexture(rgba, size, 1, RGBAFormat);
  texture.minFilter = texture.magFilter = filter;
  texture.wrapS = ClampToEdgeWrapping;
  texture.needsUpdate = true;
  return texture;
}

/** The colour maps of a scene: bytes for the bar, a texture for the points. */
export function mapsOf(scene) {
  const maps = { groups: { bytes: groups, texture: textureOf(groups, NearestFilter) } };
  for (const name of Object.keys(scene.maps)) {
    const bytes = colourMap(scene, name);
    maps[name] = { bytes, texture: textureOf(bytes, LinearFilter) };
  }
  return maps;
}

/** Groups that are not shown: as a set, and as a texture for the points. */
export function hiddenOf(set) {
  const bytes = new Uint8Array(3 * GROUPS);
  for (const number of set) bytes.fill(255, 3 * (((number % GROUPS) + GROUPS) % GROUPS), 3 * (((number % GROUPS) + GROUPS) % GROUPS) + 3);
  return { set, texture: textureOf(bytes, NearestFilter) };
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
