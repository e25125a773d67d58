// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// Points: one call draws them all, or while the scene moves as many as the machine can manage.

import { BufferAttribute, BufferGeometry, Color, Points, ShaderMaterial, Vector2, Vector4 } from 'three';

// A dot is a ball that a surface through its middle must not cut: its depth is that of its front.
// A value that is no number fails every comparison.
const vertexShader = `
attribute float value;
uniform float size, perPixel;
uniform int mode;
uniform bool within;
uniform vec2 range;
uniform vec3 plain;
uniform vec4 cut;
uniform sampler2D map;
uniform sampler2D hidden;
varying vec3 colour;
void paint() {
  colour = plain;
  if (mode == 0) return;
  bool finite = value >= -3.0e38 && value <= 3.0e38;
  colour = vec3(0.6);
  if (mode == 1 && finite) {
    float t = clamp((value - range.x) / (range.y - range.x), 0.0, 1.0);
    colour = texture2D(map, vec2(t * 255.0 / 256.0 + 0.5 / 256.0, 0.5)).rgb;
  }
  if (mode == 2 && value >= 0.0) colour = texture2D(map, vec2((mod(value, 1024.0) + 0.5) / 1024.0, 0.5)).rgb;
}
bool away() {
  if (dot(cut.xyz, position) > cut.w) return true;
  if (mode == 1 && within && !(value >= range.x && value <= range.y)) return true;
  return mode == 2 && texture2D(hidden, vec2((mod(value, 1024.0) + 0.5) / 1024.0, 0.5)).r > 0.5;
}
void main() {
  paint();
  vec4 place = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * place;
  vec4 front = projectionMatrix * (place - vec4(0.0, 0.0, 0.5 * size * perPixel * place.z, 0.0));
  gl_Position.z = front.z / front.w * gl_Position.w;
  if (away()) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  gl_PointSize = size;
}`;

const fragmentShader = `
varying vec3 colour;
void main() {
#ifdef ROUND
  vec2 place = 2.0 * gl_PointCoord - 1.0;
  float radius = dot(place, place);
  if (radius > 1.0) discard;
  gl_FragColor = vec4(colour * (1.0 - 0.35 * radius * radius), 1.0);
#else
  gl_FragColor = vec4(colour, 1.0);
#endif
}`;

const ringShader = `
uniform vec3 plain;
void main() {
  float radius = length(2.0 * gl_PointCoord - 1.0);
  if (radius > 1.0 || radius < 0.62) discard;
  gl_FragColor = vec4(plain, 1.0);
}`;

/** Colours as the screen shows them: the shader writes them without conversion. */
function screenColour(colour) {
  const n = parseInt(colour.slice(1), 16);
  return new Color().setRGB((n >> 16) / 255, ((n >> 8) & 255) / 255, (n & 255) / 255, '');
}

/** Keeps everything: no point is on the far side of this plane. */
export const NO_CUT = new Vector4(0, 0, 0, 1);

function materialOf(colour) {
  return new ShaderMaterial({
    vertexShader,
    fragmentShader,
    defines: { ROUND: 1 },
    uniforms: {
      size: { value: 4 },
      perPixel: { value: 0 },
      mode: { value: 0 },
      within: { value: false },
      range: { value: new Vector2(0, 1) },
      plain: { value: screenColour(colour) },
      cut: { value: NO_CUT },
      map: { value: null },
      hidden: { value: null },
    },
  });
}

/** Fewer points are always drawn all. */
const FEW = 100000;
const LEVELS = 7;

/** An even share of the bits of i, the same on every machine. */
function scramble(i) {
  i = Math.imul(i ^ (i >>> 16), 0x45d9f3b);
  i = Math.imul(i ^ (i >>> 16), 0x45d9f3b);
  return i ^ (i >>> 16);
}

/** An order of the points in which any beginning is an even sample of all; within a level they stay
 * in the order of the file, which is kind to the memory. */
function sampleOrder(count) {
  const levels = new Uint8Array(count);
  const begins = new Uint32Array(LEVELS + 1);
  for (let i = 0; i < count; i++) {
    levels[i] = LEVELS - 1 - Math.min(LEVELS - 1, Math.clz32(scramble(i + 1)));
    begins[levels[i] + 1]++;
  }
  for (let level = 0; level < LEVELS; level++) begins[level + 1] += begins[level];
  const order = new Uint32Array(count);
  for (let i = 0; i < count; i++) order[begins[levels[i]]++] = i;
  return order;
}

/** Dots are smaller the more there are; in CSS pixels. */
function dotSize(count) {
  return Math.min(10, Math.max(2, 220 / Math.sqrt(count + 1)));
}

export class Dots {
  constructor(positions, colour, largest = 10) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    this.count = positions.length / 3;
    if (this.count > FEW) geometry.setIndex(new BufferAttribute(sampleOrder(this.count), 1));
    this.object = new Points(geometry, materialOf(colour));
    this.object.frustumCulled = false;
    this.size = Math.min(largest, dotSize(this.count));
    this.uniforms = this.object.material.uniforms;
  }

  /** How large dots are, and the most of them that are drawn: fewer are drawn larger. */
  prepare(factor, ratio, perPixel, most) {
    const shown = this.count > FEW ? Math.min(this.count, Math.max(FEW, most)) : this.count;
    const size = this.size * factor * ratio;
    this.object.geometry.setDrawRange(0, shown === this.count ? Infinity : shown);
    this.uniforms.size.value = size * Math.min(2.5, Math.sqrt(this.count / shown));
    this.uniforms.perPixel.value = perPixel;
    const round = size > 3 * ratio;
    const { material } = this.object;
    if (Boolean(material.defines.ROUND) !== round) {
      material.defines = round ? { ROUND: 1 } : {};
      material.needsUpdate = true;
    }
    this.shown = shown;
  }

  /** Values to colour by; null for one colour. */
  setValues(values) {
    const { geometry } = this.object;
    geometry.deleteAttribute('value');
    if (values) geometry.setAttribute('value', new BufferAttribute(Float32Array.from(values), 1));
  }
}

/** A ring around what was picked, seen through everything. */
export function ringOf(size) {
  const { object } = new Dots(new Float32Array(3), '#ff2ec4');
  const { material } = object;
  material.fragmentShader = ringShader;
  material.uniforms.size.value = size;
  material.depthTest = false;
  material.transparent = true;
  object.renderOrder = 10;
  object.visible = false;
  return object;
}
