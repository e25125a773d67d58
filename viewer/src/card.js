// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// The card that tells of what is picked or measured.

import { rowsOf } from './facts.js';
import { shapeOf } from './geometry.js';
import { coordinate, count, decimalsFor, degrees, element, fixed, get, short } from './text.js';

function cell(text, error) {
  const cell = element('td');
  const errors = error ? error.split('\n') : [];
  text.split('\n').forEach((line, i) => {
    if (i) cell.append(element('br'));
    cell.append(element('span', line));
    if (errors[i]) cell.append(' ', element('span', `\u00b1 ${errors[i]}`, { className: 'error' }));
  });
  return cell;
}

function table(rows, caption) {
  const made = element('table');
  if (caption) made.append(element('caption', caption));
  const body = element('tbody');
  for (const [name, text, error] of rows) {
    const row = element('tr');
    row.append(element('th', name, { scope: 'row' }), cell(text, error));
    body.append(row);
  }
  made.append(body);
  return made;
}

export class Card {
  constructor(scene, stage) {
    Object.assign(this, { scene, stage });
    this.decimals = decimalsFor(2 * scene.scale);
  }

  hide() { get('picked').hidden = true; }

  show(title, hint, tables) {
    get('picked').hidden = false;
    get('picked').querySelector('h2').textContent = title;
    get('picked').querySelector('.hint').textContent = hint;
    get('picked').querySelector('.hint').hidden = !hint;
    get('picked').querySelector('.tables').replaceChildren(...tables);
  }

  /** A place of the page as three rows of coordinates. */
  places(position) {
    return position.map((value, c) => ['xyz'[c], coordinate(value, this.decimals)]);
  }

  title(pick) {
    const { layer, item, kind } = pick;
    if (kind === 'point') return `Point ${count(item)}`;
    const type = layer.fact(item, 'type');
    if (kind === 'face') return `Face ${item}${type ? `: ${type}` : ''}`;
    return `Edge ${layer.fact(item, 'edge')?.[0] ?? item}`;
  }

  /** The item that a point belongs to: { layer, item, name }, or null. */
  itemOf(layer, index) {
    const field = layer.itemField;
    const item = field?.values[index];
    if (item === undefined || item < 0) return null;
    const owner = [layer, ...this.stage.layers.filter(({ mesh }) => mesh)].find(({ facts }) => facts.has(item));
    return owner ? { layer: owner, item, name: field.name } : null;
  }

  pointTables({ layer, item }, position) {
    const values = layer.fields.map((field) => [field.name,
      field.unit === 'length' ? coordinate(field.values[item], this.decimals + 1) : short(field.values[item], field.type === 'float32' ? 5 : 15)]);
    const tables = [table([...this.places(position), ...values])];
    const of = this.itemOf(layer, item);
    if (of) {
      const type = of.layer.fact(of.item, 'type');
      tables.push(table(rowsOf(of.layer.facts.get(of.item), this.decimals, ['type']), `${of.name} ${of.item}${type ? `: ${type}` : ''}`));
    }
    return tables;
  }

  edgeTables({ layer, item }) {
    const inFile = (place) => place.map((v, c) => this.scene.centre[c] + this.scene.scale * v);
    const shape = shapeOf(layer.nodesOf(item).map(inFile));
    const rows = [['layer', layer.name], ['shape', shape.shape]];
    if (shape.shape === 'circle')
      rows.push(['radius', coordinate(shape.radius, this.decimals + 1)], ['diameter', coordinate(2 * shape.radius, this.decimals + 1)],
        ['centre', shape.centre.map((v) => coordinate(v, this.decimals)).join('\n')], ['axis', shape.axis.map((v) => fixed(v, 5)).join('\n')]);
    if (shape.shape === 'straight') rows.push(['direction', shape.direction.map((v) => fixed(v, 5)).join('\n')]);
    return [table([...rows, ...rowsOf(layer.facts.get(item) ?? [], this.decimals, ['edge', 'closed'])])];
  }

  faceTables({ layer, item }, position) {
    const facts = layer.facts.get(item) ?? [];
    const tables = facts.length ? [table(rowsOf(facts, this.decimals, ['type']))] : [];
    return [...tables, table(this.places(position), 'place of the pick')];
  }

  /** Tells of a pick at a position of the file. */
  tell(pick, position) {
    const tables = { point: 'pointTables', edge: 'edgeTables', face: 'faceTables' }[pick.kind];
    this.show(this.title(pick), pick.kind === 'point' ? pick.layer.name : '', this[tables](pick, position));
  }

  /** Tells of what is measured between picks. */
  measured(picks, rows) {
    const names = picks.map((pick) => this.title(pick)).join(' \u2013 ');
    const hints = ['Pick the first point, edge or face.', 'Pick the second.', picks.every(({ kind }) => kind === 'point') ? 'A third point gives the angle at the second.' : '', ''];
    const texts = rows.map(({ name, value, angle }) => [name, angle ? degrees(value) : coordinate(value, this.decimals), '']);
    this.show(picks.length ? names : 'Measure', hints[picks.length], texts.length ? [table(texts)] : []);
  }
}
