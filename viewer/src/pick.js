// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// Finds what is under the pointer: a point or an edge close by on the canvas, otherwise the face
// that the line of sight meets first. What a face hides, or a section cuts away, is not picked.
//
// A pick: { kind: 'point' | 'edge' | 'face', layer, item, place }, the place in the coordinates of
// the page; item is the number of the point, curve or surface.

import { Matrix4, Raycaster, Vector2, Vector3 } from 'three';

const NEAR = 4;
const REACH = { mouse: 9, pen: 12, touch: 18 };

/** From coordinates of the page to CSS pixels of the canvas and a depth; null behind the eye. */
class Sight {
  constructor(stage, x, y, pointer) {
    this.stage = stage;
    this.width = stage.canvas.clientWidth;
    this.height = stage.canvas.clientHeight;
    this.x = x;
    this.y = y;
    this.reach = REACH[pointer] ?? REACH.mouse;
    stage.camera.updateMatrixWorld();
    this.matrix = new Matrix4().multiplyMatrices(stage.camera.projectionMatrix, stage.camera.matrixWorldInverse);
    this.raycaster = new Raycaster();
    this.raycaster.setFromCamera(new Vector2((2 * x) / this.width - 1, 1 - (2 * y) / this.height), stage.camera);
    this.planes = stage.planes ?? [];
  }

  cutsAway(place) {
    return this.planes.some((plane) => plane.distanceToPoint(place) < 0);
  }

  /** The nearest face: a pick with the distance from the eye, or null. */
  face() {
    let best = null;
    for (const layer of this.stage.layers) {
      if (!layer.mesh || !layer.visible) continue;
      const hit = this.raycaster.intersectObject(layer.mesh, false).find(({ point }) => !this.cutsAway(point));
      if (!hit || (best && best.distance <= hit.distance)) continue;
      best = { kind: 'face', layer, item: layer.owners[hit.faceIndex], place: hit.point.clone(), distance: hit.distance,
        normal: hit.face.normal.clone() };
    }
    return best;
  }

  /** The depth behind which a face hides everything; 1: nothing. */
  limitBehind(face) {
    if (!face) return 1;
    const slack = 0.01 * this.stage.radius;
    return face.place.clone().addScaledVector(this.raycaster.ray.direction, slack).project(this.stage.camera).z;
  }

  searchPoints(layer, limit, best) {
    const e = this.matrix.elements;
    const p = layer.positions;
    const place = new Vector3();
    for (let i = 0; i < layer.count; i++) {
      const px = p[3 * i], py = p[3 * i + 1], pz = p[3 * i + 2];
      const w = e[3] * px + e[7] * py + e[11] * pz + e[15];
      if (w <= 0) continue;
      const dx = ((e[0] * px + e[4] * py + e[8] * pz + e[12]) / w + 1) * 0.5 * this.width - this.x;
      const dy = (1 - (e[1] * px + e[5] * py + e[9] * pz + e[13]) / w) * 0.5 * this.height - this.y;
      const distance = Math.hypot(dx, dy);
      if (distance > this.reach) continue;
      const depth = (e[2] * px + e[6] * py + e[10] * pz + e[14]) / w;
      const rank = distance <= NEAR ? depth - 2 : distance;
      if (depth > limit || rank >= best.rank || !layer.keeps(i) || this.cutsAway(place.set(px, py, pz))) continue;
      Object.assign(best, { rank, distance, kind: 'point', layer, item: i, place: place.clone() });
    }
  }

  /** The point nearest to the line of sight on each link of the visible curves. */
  searchEdges(layer, limit, best) {
    const a = new Vector3(), b = new Vector3();
    for (let item = 0; item < layer.items; item++) {
      const [first, end] = layer.linksOf(item);
      for (let link = first; link < end; link++) {
        a.fromArray(layer.positions, 3 * layer.links[2 * link]);
        b.fromArray(layer.positions, 3 * layer.links[2 * link + 1]);
        this.tryLink(layer, item, a, b, limit, best);
      }
    }
  }

  /** How far a place is in front of the eye. */
  depthOf(place) {
    const e = this.matrix.elements;
    return e[3] * place.x + e[7] * place.y + e[11] * place.z + e[15];
  }

  tryLink(layer, item, a, b, limit, best) {
    const from = a.clone().applyMatrix4(this.matrix), to = b.clone().applyMatrix4(this.matrix);
    const px = (v) => [(v.x + 1) * 0.5 * this.width - this.x, (1 - v.y) * 0.5 * this.height - this.y];
    const [ax, ay] = px(from), [bx, by] = px(to);
    const long = (bx - ax) ** 2 + (by - ay) ** 2;
    const t = long > 0 ? Math.min(1, Math.max(0, -(ax * (bx - ax) + ay * (by - ay)) / long)) : 0;
    const distance = Math.hypot(ax + t * (bx - ax), ay + t * (by - ay));
    if (distance > this.reach || distance >= best.distance) return;
    const far = this.depthOf(a), near = this.depthOf(b);
    const place = a.clone().lerp(b, (t * far) / ((1 - t) * near + t * far)); // what is further away looks shorter
    if (Math.abs(place.clone().applyMatrix4(this.matrix).z) > 1 || this.cutsAway(place)) return;
    if (place.clone().project(this.stage.camera).z > limit) return;
    Object.assign(best, { kind: 'edge', layer, item, place, distance, tangent: b.clone().sub(a).normalize() });
  }
}

/** What is picked at a place of the canvas in CSS pixels, or null. wanted: '' or one kind only. */
export function pick(stage, x, y, pointer = 'mouse', wanted = '') {
  const sight = new Sight(stage, x, y, pointer);
  const face = sight.face();
  const limit = sight.limitBehind(face);
  const edge = { distance: Infinity };
  const point = { rank: Infinity, distance: Infinity };
  for (const layer of stage.layers.filter(({ visible }) => visible)) {
    if (layer.links && wanted !== 'point' && wanted !== 'face') sight.searchEdges(layer, limit, edge);
    if (layer.kind === 'points' && wanted !== 'edge' && wanted !== 'face') sight.searchPoints(layer, limit, point);
  }
  if (wanted === 'face') return face;
  if (edge.layer && (edge.distance <= NEAR + 1 || edge.distance < point.distance)) return edge;
  if (point.layer) return point;
  return wanted ? null : face;
}
