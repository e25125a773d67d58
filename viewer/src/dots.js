// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// Points: one call draws them all, or while the scene moves as many as the machine can manage.

import { BufferAttribute, BufferGeometry, Color, Points, ShaderMaterial, Vector4 } from 'three';

// A dot is a ball that a surface through its middle must not cut: its depth is that of its front.
// Colours come from outside, one for each point; one without opacity is not shown.
const vertexShader = `
attribute vec4 tint;
uniform float size, perPixel;
uniform bool tinted;
uniform vec3 plain;
uniform vec4 cut;
varying vec3 colour;
void main() {
  colour = tinted ? tint.rgb : plain;
  vec4 place = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * place;
  float front = place.z * (1.0 - 0.5 * size * perPixel);
  gl_Position.z = (projectionMatrix[2][2] * front + projectionMatrix[3][2]) / -front * gl_Position.w;
  if (dot(cut.xyz, position) > cut.w || (tinted && tint.a < 0.5)) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
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
      tinted: { value: false },
      plain: { value: screenColour(colour) },
      cut: { value: NO_CUT },
    },
  });
}

/** Fewer points are always drawn all. */
const FEW = 20000;
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

/** The positions in another order. */
function sorted(positions, order) {
  const out = new Float32Array(positions.length);
  for (let i = 0; i < order.length; i++)
    for (let c = 0; c < 3; c++) out[3 * i + c] = positions[3 * order[i] + c];
  return out;
}

export class Dots {
  constructor(positions, colour, largest = 10) {
    const geometry = new BufferGeometry();
    this.count = positions.length / 3;
    this.order = this.count > FEW ? sampleOrder(this.count) : null;
    geometry.setAttribute('position', new BufferAttribute(this.order ? sorted(positions, this.order) : positions, 3));
    this.object = new Points(geometry, materialOf(colour));
    this.object.frustumCulled = false;
    this.size = Math.min(largest, dotSize(this.count));
    this.uniforms = this.object.material.uniforms;
  }

  /** How large dots are, and the most of them that are drawn: fewer are drawn larger. */
  prepare(factor, ratio, perPixel, most) {
    const shown = Math.min(this.count, Math.max(FEW, Math.round(most)));
    const size = this.size * factor * ratio;
    this.object.geometry.setDrawRange(0, shown === this.count ? Infinity : shown);
    this.uniforms.size.value = size * Math.min(2.5, Math.sqrt(this.count / shown));
    this.uniforms.perPixel.value = perPixel;
    const round = size > 3 * ratio;
    const { material } = this.object;
    if (Boolean(material.defines.ROUND) === round) return;
    material.defines = round ? { ROUND: 1 } : {};
    material.needsUpdate = true;
  }

  /** Colours for the points, 4 bytes each, in their order; null: one colour for all. */
  tint(colours) {
    this.uniforms.tinted.value = Boolean(colours);
    if (!colours) return;
    const { geometry } = this.object;
    if (!geometry.attributes.tint)
      geometry.setAttribute('tint', new BufferAttribute(new Uint8Array(4 * this.count), 4, true));
    const from = new Uint32Array(colours.buffer);
    const to = new Uint32Array(geometry.attributes.tint.array.buffer);
    if (this.order) for (let i = 0; i < to.length; i++) to[i] = from[this.order[i]];
    else to.set(from);
    geometry.attributes.tint.needsUpdate = true;
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
