// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// From the layers of the description to what three.js draws: one call for each kind of mark.

import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, Group, LineBasicMaterial, LineSegments, Mesh,
  MeshLambertMaterial, SRGBColorSpace,
} from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { numbers } from './data.js';
import { Dots } from './dots.js';

function linesOf(positions, links, colour, opacity) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(links, 1));
  return new LineSegments(geometry, new LineBasicMaterial({ color: colour, transparent: opacity < 1, opacity }));
}

/** The ends of links `first` to `end`, three coordinates each. */
export function endsOf(positions, links, first = 0, end = links.length / 2) {
  const ends = new Float32Array(6 * (end - first));
  for (let i = 0, at = 2 * first; at < 2 * end; i++, at++)
    for (let c = 0; c < 3; c++) ends[3 * i + c] = positions[3 * links[at] + c];
  return ends;
}

/** How much nearer to the eye thick lines are than they should be, as a part of their distance: dots
 * that lie on them are balls, and would hide them. */
export const nearer = { value: 0 };

export function thickLinesOf(ends, colour, width) {
  const geometry = new LineSegmentsGeometry().setPositions(ends);
  const material = new LineMaterial({ color: colour, linewidth: width });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.nearer = nearer;
    shader.vertexShader = `uniform float nearer;\n${shader.vertexShader}`.replace('#include <logdepthbuf_vertex>',
      `vec4 ahead = projectionMatrix * vec4(mvPosition.xyz * (1.0 - nearer), 1.0);
      gl_Position.z = ahead.z / ahead.w * gl_Position.w;`);
  };
  return new LineSegments2(geometry, material);
}

/** The back of a surface is seen where a section opens a body: it is told from the front. */
function showBacks(material) {
  material.userData.inside = { value: 0 };
  material.onBeforeCompile = (shader) => {
    shader.uniforms.inside = material.userData.inside;
    shader.fragmentShader = `uniform float inside;\n${shader.fragmentShader}`.replace('#include <color_fragment>',
      '#include <color_fragment>\nif (!gl_FrontFacing) diffuseColor.rgb = mix(diffuseColor.rgb, vec3(0.52, 0.36, 0.24), inside);');
  };
}

function surfaceOf(layer) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(numbers(layer.positions), 3));
  geometry.setAttribute('normal', new BufferAttribute(numbers(layer.normals), 3));
  geometry.setIndex(new BufferAttribute(numbers(layer.indices), 1));
  const material = new MeshLambertMaterial({
    color: layer.colour, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1.5, polygonOffsetUnits: 2,
  });
  showBacks(material);
  return new Mesh(geometry, material);
}

/** Nets of more links are drawn in lines of one pixel. */
const THICK_LINKS_MOST = 20000;

/** [item, name, value] of the description as one list of [name, value] for each item. */
function factsOf(list) {
  const items = new Map();
  for (const [item, name, value] of list) {
    if (!items.has(item)) items.set(item, []);
    items.get(item).push([name, value]);
  }
  return items;
}

class Layer {
  constructor(description) {
    this.description = description;
    this.kind = description.kind;
    this.name = description.name;
    this.facts = factsOf(description.facts);
    this.group = new Group();
    this.materials = [];
  }

  get visible() { return this.group.visible; }
  set visible(shown) { this.group.visible = shown; }

  add(object) {
    this.group.add(object);
    if (!object.material.isShaderMaterial || object.material.isLineMaterial) this.materials.push(object.material);
    return object;
  }

  /** The value of a fact of an item, or undefined. */
  fact(item, name) {
    return this.facts.get(item)?.find(([candidate]) => candidate === name)?.[1];
  }

  /** Keeps only what lies on the near side of these planes. */
  cutBy(planes, cut) {
    for (const material of this.materials) {
      material.clippingPlanes = planes;
      if (material.userData.inside) material.userData.inside.value = planes.length ? 1 : 0;
    }
    if (this.dots) this.dots.uniforms.cut.value = cut;
  }
}

/** Fields whose integers name something: they get a colour each. */
const GROUP_NAMES = /^(region|face|label|class|classification|segment|cluster|part|id)$/i;

function fieldOf(description) {
  const values = numbers(description.data);
  const grouped = description.type !== 'float32' && GROUP_NAMES.test(description.name);
  return { ...description, values, grouped, unit: description.name === 'deviation' ? 'length' : '' };
}

/** A coordinate of the points as a field, relative to nothing but the axes. */
function heightOf(scene, positions, axis) {
  const field = { name: `height ${'xyz'[axis]}`, type: 'float32', map: 'sequential', grouped: false, unit: 'length', made: true,
    lowest: scene.lowest[axis], highest: scene.highest[axis] };
  Object.defineProperty(field, 'values', { get() {
    const values = new Float32Array(positions.length / 3);
    for (let i = 0; i < values.length; i++) values[i] = scene.centre[axis] + scene.scale * positions[3 * i + axis];
    Object.defineProperty(field, 'values', { value: values });
    return values;
  }, configurable: true });
  return field;
}

/** A cloud: its points, and the fields that can colour them. */
class PointsLayer extends Layer {
  constructor(description, scene) {
    super(description);
    this.count = description.count;
    this.positions = numbers(description.positions);
    this.fields = description.fields.map(fieldOf);
    this.heights = [2, 0, 1].filter((axis) => scene.highest[axis] > scene.lowest[axis])
      .map((axis) => heightOf(scene, this.positions, axis));
    this.dots = new Dots(this.positions, description.colour);
    this.add(this.dots.object);
  }

  /** The field that tells which item a point belongs to. */
  get itemField() {
    return this.fields.find(({ name }) => name === 'region') ?? this.fields.find(({ name }) => name === 'face');
  }

  /** Whether the range and the groups in force leave a point to be seen. */
  keeps(index) {
    return !this.tints || this.tints[4 * index + 3] > 0;
  }

  /** Colours the points by a field: tintsOf(values, room) gives 4 bytes for each. No such field: one colour. */
  colourBy(name, tintsOf) {
    const field = [...this.fields, ...this.heights].find((candidate) => candidate.name === name);
    this.tints = field ? tintsOf(field.values, this.tints) : null;
    this.dots.tint(this.tints);
  }
}

class SurfaceLayer extends Layer {
  constructor(description) {
    super(description);
    this.count = description.triangles;
    this.owners = numbers(description.owners);
    this.items = this.owners.reduce((most, owner) => Math.max(most, owner + 1), 0);
    this.mesh = this.add(surfaceOf(description));
    const links = numbers(description.links);
    if (links.length) this.lines = this.add(linesOf(numbers(description.nodes), links, '#3a4a68', 0.35));
  }

  /** The triangles of one item, as numbers of vertices. */
  trianglesOf(item) {
    const corners = this.mesh.geometry.index.array;
    const found = [];
    for (let i = 0; i < this.owners.length; i++)
      if (this.owners[i] === item) found.push(corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]);
    return found;
  }

  /** Colours each item by colourOf(item), bytes; null: one colour for all. */
  shade(colourOf) {
    const { geometry, material } = this.mesh;
    material.vertexColors = Boolean(colourOf);
    material.color.set(colourOf ? '#ffffff' : this.description.colour);
    material.needsUpdate = true;
    if (!colourOf) return;
    const colours = new Float32Array(geometry.attributes.position.array.length);
    const corners = geometry.index.array;
    const made = Array.from({ length: this.items }, (_, item) =>
      new Color().setRGB(...colourOf(item).map((byte) => byte / 255), SRGBColorSpace).toArray());
    for (let i = 0; i < corners.length; i++) colours.set(made[this.owners[(i / 3) | 0]], 3 * corners[i]);
    geometry.setAttribute('color', new BufferAttribute(colours, 3));
  }
}

class NetLayer extends Layer {
  constructor(description) {
    super(description);
    this.count = description.count;
    const positions = numbers(description.nodes);
    const links = numbers(description.links);
    this.add(links.length > THICK_LINKS_MOST
      ? linesOf(positions, links, description.colour, 1)
      : thickLinesOf(endsOf(positions, links), description.colour, 1.6));
    this.dots = new Dots(positions, description.colour, 8);
    this.add(this.dots.object);
  }
}

class CurvesLayer extends Layer {
  constructor(description) {
    super(description);
    this.count = description.curves;
    this.items = description.curves;
    this.positions = numbers(description.nodes);
    this.links = numbers(description.links);
    const quiet = /smooth|seam/.test(this.name);
    this.thick = this.add(thickLinesOf(endsOf(this.positions, this.links), description.colour, quiet ? 1.6 : 3.5));
    this.visible = !/seam/.test(this.name);
  }

  /** First and last link of a curve, the last excluded. */
  linksOf(item) {
    const { begins } = this.description;
    return [begins[item], begins[item + 1] ?? this.links.length / 2];
  }

  /** The nodes of a curve in their order: three coordinates each, of the page. */
  nodesOf(item) {
    const [first, end] = this.linksOf(item);
    const ends = endsOf(this.positions, this.links, first, end);
    const nodes = [Array.from(ends.subarray(0, 3))];
    for (let i = 3; i < ends.length; i += 6) nodes.push(Array.from(ends.subarray(i, i + 3)));
    return nodes;
  }
}

const classes = { points: PointsLayer, surface: SurfaceLayer, net: NetLayer, curves: CurvesLayer };

/** The layers of a scene, in its order. */
export function layersOf(scene) {
  return scene.layers.map((description) => new classes[description.kind](description, scene));
}
