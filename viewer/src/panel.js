// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// The panel: layers, colours, views, and the numbers of the point picked.

import { views } from './stage.js';
import { count, element, short } from './text.js';

const get = (id) => document.getElementById(id);
const units = { points: 'point', surface: 'triangle', net: 'control point', curves: 'curve' };

function layerItem(layer, index, shown, onChange) {
  const box = element('input', '', { type: 'checkbox', checked: shown, id: `layer-${index}` });
  box.addEventListener('change', () => onChange(box.checked));
  const label = element('label');
  const swatch = element('span', '', { className: `swatch ${layer.kind}` });
  swatch.style.background = layer.description?.colour ?? 'transparent';
  label.append(box, swatch, element('span', layer.name || layer.kind), element('span', layer.note, { className: 'count' }));
  const item = element('li');
  item.append(label);
  return item;
}

export class Panel {
  constructor(scene, stage, maps) {
    Object.assign(this, { scene, stage, maps });
    this.clouds = stage.layers.filter((layer) => layer.kind === 'points');
    this.describe();
    this.listLayers();
    this.listFields();
    this.listViews();
    get('size').addEventListener('input', (event) => {
      stage.sizeFactor = Number(event.target.value);
      stage.refresh();
    });
    get('fold').addEventListener('click', () => this.fold());
  }

  describe() {
    get('title').textContent = this.scene.title || 'crease';
    const sums = {};
    for (const layer of this.stage.layers) sums[layer.kind] = (sums[layer.kind] ?? 0) + layer.count;
    const parts = Object.keys(sums).map((kind) => `${count(sums[kind])} ${units[kind]}${sums[kind] === 1 ? '' : 's'}`);
    const size = this.scene.highest.map((high, c) => short(high - this.scene.lowest[c], 4));
    get('counts').textContent = `${parts.join(', ')}. Size ${size.join(' \u00d7 ')}.`;
  }

  listLayers() {
    this.stage.layers.forEach((layer, i) => {
      layer.note = count(layer.count);
      get('layers').append(layerItem(layer, i, true, (shown) => this.setVisible(i, shown)));
    });
    const box = { kind: 'box', name: 'box', note: '' };
    get('layers').append(layerItem(box, 'box', true, (shown) => {
      this.stage.box.visible = shown;
      this.stage.refresh();
    }));
  }

  setVisible(index, shown) {
    this.stage.layers[index].visible = shown;
    get(`layer-${index}`).checked = shown;
    this.stage.refresh();
  }

  listFields() {
    const names = new Set(this.clouds.flatMap((layer) => layer.fields.map((field) => field.name)));
    get('colouring').hidden = this.clouds.length === 0;
    get('field').append(element('option', 'one colour', { value: '' }));
    for (const name of names) get('field').append(element('option', name, { value: name }));
    get('field').addEventListener('change', () => this.colourBy(get('field').value));
    for (const id of ['lowest', 'highest']) get(id).addEventListener('change', () => this.readRange());
    get('whole').addEventListener('click', () => this.colourBy(this.field));
    this.colourBy([...names].find((name) => name === 'variance') ?? '');
  }

  /** Colours the points by a field in the range proposed for it; '' for one colour. */
  colourBy(name) {
    const field = this.clouds.flatMap((layer) => layer.fields).find((candidate) => candidate.name === name);
    this.field = field ? name : '';
    this.map = field ? this.maps[field.map] : null;
    get('field').value = this.field;
    get('scale').hidden = !field;
    this.setRange(field ? [field.lowest, field.highest] : [0, 1]);
    if (field) this.drawBar();
  }

  setRange(range) {
    this.range = range;
    get('lowest').value = Number(range[0].toPrecision(4));
    get('highest').value = Number(range[1].toPrecision(4));
    const marks = [range[0], (range[0] + range[1]) / 2, range[1]];
    const step = 10 ** (Math.floor(Math.log10(range[1] - range[0])) - 2);
    [...get('marks').children].forEach((mark, i) => {
      mark.textContent = short(Math.round(marks[i] / step) * step, 4);
    });
    for (const layer of this.clouds) layer.colourBy(this.field, range, this.map?.texture);
    this.stage.refresh();
  }

  /** Takes the range that was typed in, if it is one. */
  readRange() {
    const range = [get('lowest').valueAsNumber, get('highest').valueAsNumber];
    this.setRange(range[1] > range[0] ? range : this.range);
  }

  drawBar() {
    const context = get('bar').getContext('2d');
    const image = context.createImageData(256, 1);
    for (let i = 0; i < 256; i++)
      image.data.set([this.map.bytes[3 * i], this.map.bytes[3 * i + 1], this.map.bytes[3 * i + 2], 255], 4 * i);
    context.putImageData(image, 0, 0);
  }

  listViews() {
    Object.keys(views).forEach((name, i) => {
      const button = element('button', name, { type: 'button', title: `Key ${i + 1}` });
      button.addEventListener('click', () => this.stage.look(name));
      get('views').append(button);
    });
  }

  fold() {
    const controls = get('controls');
    controls.hidden = !controls.hidden;
    get('fold').textContent = controls.hidden ? 'Show' : 'Hide';
    get('fold').setAttribute('aria-expanded', String(!controls.hidden));
  }

  /** Shows what is known of a point: rows of name and value; null for no point. */
  showPicked(rows) {
    const table = get('picked').querySelector('table');
    table.hidden = !rows;
    const body = table.tBodies[0];
    body.replaceChildren(...(rows ?? []).map(([name, value]) => {
      const row = element('tr');
      row.append(element('th', name, { scope: 'row' }), element('td', value));
      return row;
    }));
  }
}
