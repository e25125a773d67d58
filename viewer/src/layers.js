// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// From the layers of the description to what three.js draws: one call for each kind of mark.

import {
  BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, Group, LineBasicMaterial,
  LinearFilter, LineSegments, Mesh, MeshLambertMaterial, Points, RGBAFormat, ShaderMaterial,
  Vector2,
} from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { colourMap, numbers } from './data.js';

// A dot is a ball that a surface through its middle must not cut: its depth is that of its front.
const vertexShader = `
attribute float value;
uniform float size;
uniform float perPixel;
varying float carried;
void main() {
  carried = value;
  vec4 place = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * place;
  vec4 front = projectionMatrix * (place - vec4(0.0, 0.0, 0.5 * size * perPixel * place.z, 0.0));
  gl_Position.z = front.z / front.w * gl_Position.w;
  gl_PointSize = size;
}`;

// A value that is no number fails every comparison, also with itself.
const fragmentShader = `
uniform bool mapped;
uniform vec2 range;
uniform vec3 plain;
uniform sampler2D map;
varying float carried;
void main() {
  vec2 place = 2.0 * gl_PointCoord - 1.0;
  float radius = dot(place, place);
  if (radius > 1.0) discard;
  vec3 colour = plain;
  if (mapped) {
    float t = clamp((carried - range.x) / (range.y - range.x), 0.0, 1.0);
    bool finite = carried >= -3.0e38 && carried <= 3.0e38;
    colour = finite ? texture2D(map, vec2(t * 255.0 / 256.0 + 0.5 / 256.0, 0.5)).rgb : vec3(0.6);
  }
  gl_FragColor = vec4(colour * (1.0 - 0.35 * radius * radius), 1.0);
}`;

function textureOf(bytes) {
  const rgba = new Uint8Array(1024);
  for (let i = 0; i < 256; i++) rgba.set([bytes[3 * i], bytes[3 * i + 1], bytes[3 * i + 2], 255], 4 * i);
  const texture = new DataTexture(rgba, 256, 1, RGBAFormat);
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** Colours as the screen shows them: the shader writes them without conversion. */
function screenColour(colour) {
  const n = parseInt(colour.slice(1), 16);
  return new Color().setRGB((n >> 16) / 255, ((n >> 8) & 255) / 255, (n & 255) / 255, '');
}

function pointsMaterial(colour) {
  return new ShaderMaterial({
    vertexShader,
    fragmentShader,
    uniforms: {
      size: { value: 4 },
      perPixel: { value: 0 },
      mapped: { value: false },
      range: { value: new Vector2(0, 1) },
      plain: { value: screenColour(colour) },
      map: { value: null },
    },
  });
}

/** A ring around the point that was picked, seen through everything. */
export function ringOf(size) {
  const ring = pointsOf(new Float32Array(3), '#ff2ec4');
  const { material } = ring;
  material.fragmentShader = `
uniform vec3 plain;
void main() {
  float radius = length(2.0 * gl_PointCoord - 1.0);
  if (radius > 1.0 || radius < 0.62) discard;
  gl_FragColor = vec4(plain, 1.0);
}`;
  material.uniforms.size.value = size;
  material.depthTest = false;
  material.transparent = true;
  ring.renderOrder = 10;
  ring.visible = false;
  return ring;
}

function pointsOf(positions, colour) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  const points = new Points(geometry, pointsMaterial(colour));
  points.frustumCulled = false;
  return points;
}

function linesOf(positions, links, colour, opacity) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(links, 1));
  return new LineSegments(geometry, new LineBasicMaterial({ color: colour, transparent: opacity < 1, opacity }));
}

function thickLinesOf(positions, links, colour, width) {
  const ends = new Float32Array(3 * links.length);
  links.forEach((node, i) => ends.set(positions.subarray(3 * node, 3 * node + 3), 3 * i));
  const geometry = new LineSegmentsGeometry().setPositions(ends);
  return new LineSegments2(geometry, new LineMaterial({ color: colour, linewidth: width }));
}

function surfaceOf(layer) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(numbers(layer.positions, 'float32'), 3));
  geometry.setAttribute('normal', new BufferAttribute(numbers(layer.normals, 'float32'), 3));
  geometry.setIndex(new BufferAttribute(numbers(layer.indices, 'uint32'), 1));
  return new Mesh(geometry, new MeshLambertMaterial({
    color: layer.colour, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1.5, polygonOffsetUnits: 2,
  }));
}

/** Nets of more links are drawn in lines of one pixel. */
const THICK_LINKS_MOST = 20000;

/** Dots are smaller the more there are; in CSS pixels. */
function dotSize(count) {
  return Math.min(10, Math.max(2, 220 / Math.sqrt(count + 1)));
}

class Layer {
  constructor(description) {
    this.description = description;
    this.kind = description.kind;
    this.name = description.name;
    this.group = new Group();
  }

  get visible() { return this.group.visible; }
  set visible(shown) { this.group.visible = shown; }

  add(object) {
    this.group.add(object);
    return object;
  }
}

/** A cloud: its points, and the fields that can colour them. */
class PointsLayer extends Layer {
  constructor(description) {
    super(description);
    this.count = description.count;
    this.positions = numbers(description.positions, 'float32');
    this.fields = description.fields.map((field) => ({ ...field, values: numbers(field.data, field.type) }));
    this.points = this.add(pointsOf(this.positions, description.colour));
    this.dots = dotSize(this.count);
  }

  colourBy(name, range, map) {
    const field = this.fields.find((candidate) => candidate.name === name);
    const { geometry, material } = this.points;
    material.uniforms.mapped.value = Boolean(field);
    if (!field) return;
    if (this.shown !== field) {
      geometry.deleteAttribute('value');
      geometry.setAttribute('value', new BufferAttribute(Float32Array.from(field.values), 1));
      this.shown = field;
    }
    material.uniforms.range.value.set(range[0], range[1]);
    material.uniforms.map.value = map;
  }
}

class SurfaceLayer extends Layer {
  constructor(description) {
    super(description);
    this.count = description.triangles;
    this.mesh = this.add(surfaceOf(description));
    this.lines = this.add(linesOf(
      numbers(description.nodes, 'float32'), numbers(description.links, 'uint32'), '#3a4a68', 0.35));
  }
}

class NetLayer extends Layer {
  constructor(description) {
    super(description);
    this.count = description.count;
    const positions = numbers(description.nodes, 'float32');
    const links = numbers(description.links, 'uint32');
    this.add(links.length > THICK_LINKS_MOST
      ? linesOf(positions, links, description.colour, 1)
      : thickLinesOf(positions, links, description.colour, 1.6));
    this.points = this.add(pointsOf(positions, description.colour));
    this.dots = Math.min(8, dotSize(this.count));
  }
}

class CurvesLayer extends Layer {
  constructor(description) {
    super(description);
    this.count = description.curves;
    this.thick = this.add(thickLinesOf(
      numbers(description.nodes, 'float32'), numbers(description.links, 'uint32'), description.colour, 4));
  }
}

const classes = { points: PointsLayer, surface: SurfaceLayer, net: NetLayer, curves: CurvesLayer };

/** The layers of a scene, in its order. */
export function layersOf(scene) {
  return scene.layers.map((description) => new classes[description.kind](description));
}

/** The colour maps of a scene: bytes for the bar, a texture for the points. */
export function mapsOf(scene) {
  const maps = {};
  for (const name of Object.keys(scene.maps)) {
    const bytes = colourMap(scene, name);
    maps[name] = { bytes, texture: textureOf(bytes) };
  }
  return maps;
}
