// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// Distances and angles between two picks, in the coordinates of the file, in double precision. A
// pick is, as far as its facts tell, a plane, an axis with a radius, a centre, or a place with a
// direction.

const sub = (a, b) => a.map((v, i) => v - b[i]);
const dot = (a, b) => a.reduce((sum, v, i) => sum + v * b[i], 0);
const along = (a, t, b) => a.map((v, i) => v + t * b[i]);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const size = (a) => Math.hypot(...a);
const unit = (a) => a.map((v) => v / size(a));

/** Directions this close are called parallel: 2 degrees. */
const PARALLEL = 2;

/** The angle between two directions whose signs do not matter, 0 to 90 degrees. */
function between(a, b) {
  return (Math.atan2(size(cross(a, b)), Math.abs(dot(a, b))) * 180) / Math.PI;
}

/** Straight, a circle, or neither: what the nodes of an edge lie on within a part of its size. */
export function shapeOf(nodes) {
  const first = nodes[0], last = nodes[nodes.length - 1];
  const extent = Math.max(...nodes.map((node) => size(sub(node, first))));
  const chord = sub(last, first);
  if (size(chord) > 0.5 * extent) {
    const direction = unit(chord);
    const off = Math.max(...nodes.map((node) => size(cross(sub(node, first), direction))));
    if (off < 1e-4 * extent) return { shape: 'straight', place: first, direction };
  }
  return circleThrough(nodes, extent) ?? { shape: 'curved' };
}

function circleThrough(nodes, extent) {
  const third = (nodes.length - 1) / 3;
  const [a, b, c] = [0, third, 2 * third].map((at) => nodes[Math.round(at)]);
  const u = sub(b, a), v = sub(c, a), n = cross(u, v);
  const nn = dot(n, n);
  if (!(nn > 1e-12 * extent ** 4)) return null;
  const toCentre = cross(n, u).map((value, i) => (value * dot(v, v) + cross(v, n)[i] * dot(u, u)) / (2 * nn));
  const centre = along(a, 1, toCentre);
  const radius = size(toCentre), axis = unit(n);
  const off = Math.max(...nodes.map((node) => {
    const out = sub(node, centre);
    return Math.max(Math.abs(size(out) - radius), Math.abs(dot(out, axis)));
  }));
  return off < 2e-3 * radius ? { shape: 'circle', centre, axis, radius } : null;
}

/** The place on a line nearest to a point. */
const foot = (point, line) => along(line.place, dot(sub(point, line.place), line.axis), line.axis);

/** The nearest places of two lines; of parallel ones, those at the place of the first. */
function feetOf(a, b) {
  const n = cross(a.axis, b.axis);
  if (size(n) < 1e-9) return [a.place, foot(a.place, b)];
  const apart = sub(b.place, a.place);
  const nn = dot(n, n);
  return [along(a.place, dot(cross(apart, b.axis), n) / nn, a.axis), along(b.place, dot(cross(apart, a.axis), n) / nn, b.axis)];
}

const row = (name, value, power) => ({ name, value, power });
const angleRow = (name, value) => ({ name, value, angle: true });

function planes(a, b) {
  const angle = between(a.normal, b.normal);
  const rows = [angleRow('angle between the planes', angle)];
  if (angle > PARALLEL) return { rows };
  const height = dot(sub(b.at, a.place), a.normal);
  const back = dot(sub(a.at, b.place), b.normal);
  rows.push(row('distance of the planes', (Math.abs(height) + Math.abs(back)) / 2, 1));
  return { rows, line: [b.at, along(b.at, -height, a.normal)] };
}

function planeAndAxis(plane, axis) {
  const angle = 90 - between(plane.normal, axis.axis);
  const rows = [angleRow('angle of axis and plane', angle)];
  if (angle > PARALLEL) return { rows };
  const near = foot(plane.at, axis);
  const height = dot(sub(near, plane.place), plane.normal);
  rows.push(row('distance of axis and plane', Math.abs(height), 1));
  return { rows, line: [near, along(near, -height, plane.normal)] };
}

function axes(a, b) {
  const angle = between(a.axis, b.axis);
  const [p, q] = angle > PARALLEL ? feetOf(a, b) : [foot(a.at, a), foot(foot(a.at, a), b)];
  return { rows: [angleRow('angle between the axes', angle), row('distance of the axes', size(sub(q, p)), 1)], line: [p, q] };
}

function planeAndPoint(plane, point) {
  const height = dot(sub(point, plane.place), plane.normal);
  return { rows: [row('distance from the plane', Math.abs(height), 1)], line: [point, along(point, -height, plane.normal)] };
}

function axisAndPoint(axis, point) {
  const near = foot(point, axis);
  const distance = size(sub(point, near));
  const rows = [row('distance from the axis', distance, 1)];
  if (axis.wall) rows.push(row('distance from the wall', Math.abs(distance - axis.radius), 1));
  return { rows, line: [point, near] };
}

const KINDS = ['plane', 'axis', 'point'];
const kindOf = (entity) => (entity.normal && entity.flat ? 'plane' : entity.axis ? 'axis' : 'point');

/** What can be measured between two picks: { rows, line }. An entity: { at } the place picked, and
 * { place, normal, flat } of a plane, { place, axis, radius, wall } of what has an axis, { centre }
 * of a sphere. */
export function relate(first, second) {
  const [a, b] = KINDS.indexOf(kindOf(first)) <= KINDS.indexOf(kindOf(second)) ? [first, second] : [second, first];
  const kinds = `${kindOf(a)} ${kindOf(b)}`;
  const point = b.centre ?? b.at;
  const found = {
    'plane plane': () => planes(a, b),
    'plane axis': () => planeAndAxis(a, b),
    'plane point': () => planeAndPoint(a, point),
    'axis axis': () => axes(a, b),
    'axis point': () => axisAndPoint(a, point),
    'point point': () => ({ rows: [], line: [a.centre ?? a.at, point] }),
  }[kinds]();
  const d = sub(second.centre ?? second.at, first.centre ?? first.at);
  const direct = [row(first.centre || second.centre ? 'distance of the centres' : 'distance of the picks', size(d), 1),
    ...d.map((v, i) => row(`\u0394${'xyz'[i]}`, v, 1))];
  return { rows: [...found.rows, ...direct], line: found.line ?? [first.at, second.at] };
}

/** The angle at the second of three places, in degrees. */
export function corner(a, b, c) {
  const u = sub(a, b), v = sub(c, b);
  return (Math.atan2(size(cross(u, v)), dot(u, v)) * 180) / Math.PI;
}
