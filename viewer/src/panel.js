// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// The panel: layers, views, unit and theme. Colours are the matter of colouring.js.

import { views } from './stage.js';
import { theme } from './theme.js';
import { count, element, get, measure, unit } from './text.js';

const units = { points: 'point', surface: 'triangle', net: 'control point', curves: 'curve' };
const narrow = window.matchMedia('(max-width: 640px)');

function layerItem(entry, id, shown, onChange) {
  const box = element('input', '', { type: 'checkbox', checked: shown, id: `layer-${id}` });
  box.addEventListener('change', () => onChange(box.checked));
  const label = element('label');
  const swatch = element('span', '', { className: `swatch ${entry.kind}` });
  if (entry.colour && entry.kind !== 'curves') swatch.style.background = entry.colour;
  label.append(box, swatch, element('span', entry.name || entry.kind), element('span', entry.note ?? '', { className: 'count' }));
  const item = element('li');
  item.append(label);
  return item;
}

export class Panel {
  constructor(scene, stage, say) {
    Object.assign(this, { scene, stage, say });
    this.describe();
    this.listLayers();
    this.listViews();
    get('size').addEventListener('input', (event) => {
      stage.sizeFactor = Number(event.target.value);
      stage.refresh();
    });
    get('fold').addEventListener('click', () => this.fold());
    get('unit').addEventListener('change', () => this.setUnit(get('unit').value));
    get('theme').addEventListener('change', () => theme.choose(get('theme').value));
    if (narrow.matches) this.fold(false);
    narrow.addEventListener('change', () => this.fold(!narrow.matches));
  }

  describe() {
    get('title').textContent = this.scene.title || 'crease';
    const sums = {};
    for (const layer of this.stage.layers) sums[layer.kind] = (sums[layer.kind] ?? 0) + layer.count;
    const parts = Object.keys(sums).map((kind) => `${count(sums[kind])} ${units[kind]}${sums[kind] === 1 ? '' : 's'}`);
    const size = this.scene.highest.map((high, c) => measure(high - this.scene.lowest[c], 1, 5));
    get('counts').textContent = `${parts.join(', ')}. ${size.join(' \u00d7 ')}`;
  }

  listLayers() {
    const list = get('layers');
    this.stage.layers.forEach((layer, i) => {
      const note = count(layer.mesh ? layer.items : layer.count);
      const entry = { kind: layer.kind, name: layer.name, colour: layer.description.colour, note };
      list.append(layerItem(entry, i, layer.visible, (shown) => this.setVisible(i, shown)));
      if (layer.lines)
        list.append(layerItem({ kind: 'lines', name: `lines on ${layer.name}` }, `lines-${i}`, true, (shown) => {
          layer.lines.visible = shown;
          this.stage.refresh();
        }));
    });
    list.append(layerItem({ kind: 'box', name: 'box' }, 'box', true, (shown) => {
      this.stage.box.visible = shown;
      this.stage.refresh();
    }));
  }

  setVisible(index, shown) {
    this.stage.layers[index].visible = shown;
    get(`layer-${index}`).checked = shown;
    this.onLayers?.();
    this.stage.refresh();
  }

  listViews() {
    Object.keys(views).forEach((name, i) => {
      const button = element('button', name, { type: 'button', title: `Key ${i + 1}` });
      button.addEventListener('click', () => this.stage.look(name));
      get('views').append(button);
    });
  }

  /** Names the unit of the file; nothing is converted. */
  setUnit(name) {
    unit.name = name;
    get('unit').value = name;
    this.describe();
    this.onUnit?.();
  }

  nextTheme() {
    const names = ['', 'light', 'dark'];
    theme.choose(names[(names.indexOf(theme.chosen) + 1) % 3]);
    get('theme').value = theme.chosen;
    this.say(`Theme: ${theme.chosen || 'auto'}`);
  }

  get folded() { return get('controls').hidden; }

  fold(open = this.folded) {
    get('controls').hidden = !open;
    get('fold').textContent = open ? 'Hide' : 'Show';
    get('fold').setAttribute('aria-expanded', String(open));
    this.stage.afterLayout?.();
  }

  /** On a phone there is room for one thing at a time. */
  makeRoom() {
    if (narrow.matches && !this.folded) this.fold(false);
  }
}
