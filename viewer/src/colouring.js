// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// How points and faces are coloured: the field, its range with a histogram and two thumbs, the
// groups of a field of numbers that name something; and the faces by what is known of them.

import { colourAt, css, drawBar, groupColour, tintsOfGroups, tintsOfMap } from './colours.js';
import { theme } from './theme.js';
import { count, element, get, measure, short } from './text.js';

const STEPS = 1000;
const BINS = 128;
/** More groups than this get no list. */
const GROUPS_MOST = 400;
const FIRST = ['deviation', 'region', 'variance'];

/** Lowest and highest finite value. */
function extentOf(values) {
  let low = Infinity, high = -Infinity;
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}

export class Colouring {
  constructor(stage, maps, say) {
    Object.assign(this, { stage, maps, say });
    this.clouds = stage.layers.filter((layer) => layer.kind === 'points');
    this.fields = this.clouds.flatMap((layer) => [...layer.fields, ...layer.heights]);
    this.names = [...new Set(this.fields.map(({ name }) => name))];
    this.hidden = new Set();
    get('colouring').hidden = this.clouds.length === 0;
    get('field').append(element('option', 'one colour', { value: '' }));
    for (const name of this.names) get('field').append(element('option', name, { value: name }));
    this.listen();
    this.colourBy(FIRST.find((name) => this.names.includes(name)) ?? '');
    theme.onChange(() => this.field && !this.grouped && this.drawHistogram());
  }

  listen() {
    get('field').addEventListener('change', () => this.colourBy(get('field').value));
    for (const id of ['lowest', 'highest']) get(id).addEventListener('change', () => this.readRange());
    for (const id of ['from', 'to']) get(id).addEventListener('input', () => this.readThumbs(id));
    get('whole').addEventListener('click', () => this.colourBy(this.field));
    get('within').addEventListener('change', () => this.apply());
  }

  /** The next field, after the last one colour. */
  next() {
    const all = [...this.names, ''];
    this.colourBy(all[(all.indexOf(this.field) + 1) % all.length]);
    this.say(`Points coloured by ${this.field || 'one colour'}`);
  }

  /** Colours the points by a field in the range proposed for it; '' for one colour. */
  colourBy(name) {
    const field = this.fields.find((candidate) => candidate.name === name);
    this.field = field ? name : '';
    this.described = field;
    this.grouped = Boolean(field?.grouped);
    this.map = !field ? null : this.maps[this.grouped ? 'groups' : field.map];
    this.hidden = new Set();
    get('field').value = this.field;
    get('scale').hidden = !field || this.grouped;
    get('groups').hidden = !this.grouped;
    if (field && !this.grouped) this.measureDomain(field);
    this.setRange(field ? [field.lowest, field.highest] : [0, 1]);
    if (this.grouped) this.listGroups();
    if (field && !this.grouped) {
      drawBar(get('bar'), this.map);
      drawBar(get('key').querySelector('canvas'), this.map);
    }
    get('key').classList.toggle('empty', !field || this.grouped);
    this.stage.afterLayout?.();
  }

  /** What the thumbs can reach: the proposed range and half as much to both sides, as far as there are values. */
  measureDomain(field) {
    const wide = field.highest - field.lowest;
    const values = this.fields.filter(({ name }) => name === field.name).map((one) => one.values);
    const [low, high] = extentOf(values.map(extentOf).flat());
    this.domain = [Math.max(Math.min(low, field.lowest), field.lowest - wide / 2),
      Math.min(Math.max(high, field.highest), field.highest + wide / 2)];
    this.bins = new Uint32Array(BINS);
    const factor = BINS / (this.domain[1] - this.domain[0]);
    for (const list of values)
      for (const value of list) {
        const bin = Math.floor((value - this.domain[0]) * factor);
        if (bin >= 0 && bin < BINS) this.bins[bin]++;
      }
  }

  number(value) {
    const length = this.described?.unit === 'length';
    return length ? measure(value, 1, 4) : short(value, 4);
  }

  setRange(range) {
    this.range = range;
    if (this.field && !this.grouped) this.showRange();
    this.apply();
  }

  showRange() {
    const { range, domain } = this;
    get('lowest').value = Number(range[0].toPrecision(4));
    get('highest').value = Number(range[1].toPrecision(4));
    const step = (value) => Math.round((STEPS * (value - domain[0])) / (domain[1] - domain[0]));
    for (const [id, value] of [['from', range[0]], ['to', range[1]]]) {
      get(id).value = step(value);
      get(id).setAttribute('aria-valuetext', this.number(value));
    }
    get('key-name').textContent = this.field;
    get('key-low').textContent = this.number(range[0]);
    get('key-high').textContent = this.number(range[1]);
    this.drawHistogram();
  }

  apply() {
    const within = get('within').checked;
    const tintsOf = (values, room) => (this.grouped ? tintsOfGroups(values, this.hidden, room)
      : tintsOfMap(values, this.range, this.map, within, room));
    for (const layer of this.clouds) layer.colourBy(this.field, tintsOf);
    this.stage.refresh();
  }

  /** Takes the range that was typed in, if it is one. */
  readRange() {
    const range = [get('lowest').valueAsNumber, get('highest').valueAsNumber];
    this.setRange(range[1] > range[0] ? range : this.range);
  }

  /** The thumbs do not pass each other. */
  readThumbs(moved) {
    const [from, to] = ['from', 'to'].map((id) => Number(get(id).value));
    if (from >= to) get(moved).value = moved === 'from' ? to - 1 : from + 1;
    const [low, high] = this.domain;
    const value = (id) => low + ((high - low) * Number(get(id).value)) / STEPS;
    this.setRange([value('from'), value('to')]);
  }

  /** How many points have which value: root of the counts, in the colours that they get. */
  drawHistogram() {
    const canvas = get('histogram');
    const context = canvas.getContext('2d');
    const most = Math.sqrt(Math.max(...this.bins));
    context.clearRect(0, 0, canvas.width, canvas.height);
    const wide = canvas.width / BINS;
    this.bins.forEach((size, bin) => {
      const value = this.domain[0] + ((bin + 0.5) / BINS) * (this.domain[1] - this.domain[0]);
      const t = (value - this.range[0]) / (this.range[1] - this.range[0]);
      const height = most ? ((canvas.height - 2) * Math.sqrt(size)) / most : 0;
      context.fillStyle = css(colourAt(this.map, t));
      context.globalAlpha = t < 0 || t > 1 ? 0.35 : 1;
      context.fillRect(bin * wide, canvas.height - height, wide, height);
    });
    context.globalAlpha = 1;
    context.fillStyle = theme.dark ? '#a9a9b6' : '#5b5b66';
    context.fillRect(0, canvas.height - 1, canvas.width, 1);
  }

  /** A button for each group: its colour, its number, a click hides or shows it. */
  listGroups() {
    const sizes = new Map();
    for (const field of this.fields.filter(({ name }) => name === this.field))
      for (const value of field.values) sizes.set(value, (sizes.get(value) ?? 0) + 1);
    const all = [...sizes].sort((a, b) => a[0] - b[0]);
    get('groups').replaceChildren(...(all.length > GROUPS_MOST ? [element('span', `${count(all.length)} groups`)]
      : all.map(([number, size]) => this.groupButton(number, size))));
  }

  groupButton(number, size) {
    const name = number < 0 ? 'none' : String(number);
    const button = element('button', '', { type: 'button', title: `${this.field} ${name}: ${count(size)} points` });
    button.setAttribute('aria-pressed', 'true');
    button.setAttribute('aria-label', `Show ${this.field} ${name}, ${size} points`);
    const dot = element('i');
    dot.style.background = css(groupColour(number));
    button.append(dot, element('span', number < 0 ? '\u2013' : name));
    button.addEventListener('click', () => {
      const off = !this.hidden.has(number);
      if (off) this.hidden.add(number);
      else this.hidden.delete(number);
      button.classList.toggle('off', off);
      button.setAttribute('aria-pressed', String(!off));
      this.apply();
    });
    return button;
  }
}

/** Facts of faces that make a scale of colours. */
const SHADES = { rms: 'rms deviation', p95: '95 % of the deviations', max: 'largest deviation', mean: 'mean deviation', area: 'area', chi: '\u03c7\u00b2' };

export class Shading {
  constructor(stage, maps) {
    Object.assign(this, { stage, maps });
    this.surfaces = stage.layers.filter((layer) => layer.mesh);
    const described = new Set(this.surfaces.flatMap((layer) => [...layer.facts.values()].flat().map(([name]) => name)));
    const many = this.surfaces.some(({ items }) => items > 1);
    get('facing').hidden = !many;
    get('shade').append(element('option', 'one colour', { value: '' }), element('option', 'each its own', { value: 'own' }));
    for (const name of Object.keys(SHADES))
      if (described.has(name)) get('shade').append(element('option', SHADES[name], { value: name }));
    get('shade').addEventListener('change', () => this.shadeBy(get('shade').value));
  }

  shadeBy(name) {
    get('shade').value = name;
    const scale = SHADES[name] ? this.scaleOf(name) : null;
    get('shade-scale').hidden = !scale;
    for (const layer of this.surfaces) {
      if (!name) layer.shade(null);
      else if (!scale) layer.shade(groupColour);
      else layer.shade((item) => this.colourOf(layer, item, name, scale));
    }
    if (scale) this.showScale(name, scale);
    this.stage.refresh();
  }

  colourOf(layer, item, name, { low, high, map }) {
    const value = layer.fact(item, name)?.[0];
    return Number.isFinite(value) ? colourAt(map, (value - low) / (high - low || 1)) : groupColour(-1);
  }

  scaleOf(name) {
    const values = this.surfaces.flatMap((layer) => Array.from({ length: layer.items }, (_, item) => layer.fact(item, name)?.[0]));
    const [low, high] = extentOf(values.filter((value) => value !== null && value !== undefined));
    if (name !== 'mean') return { low: Math.min(0, low), high, map: this.maps.sequential };
    const most = Math.max(Math.abs(low), Math.abs(high));
    return { low: -most, high: most, map: this.maps.diverging };
  }

  showScale(name, { low, high, map }) {
    drawBar(get('shade-scale').querySelector('canvas'), map);
    const power = name === 'area' ? 2 : name === 'chi' ? 0 : 1;
    const ends = get('shade-scale').querySelectorAll('.ends span');
    [low, high].forEach((value, i) => { ends[i].textContent = measure(value, power, 4); });
  }
}
