// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// Finds the point under the pointer: of those right under it the nearest to the eye, otherwise the
// one closest by on the canvas. Points behind a surface are not picked.

import { Matrix4 } from 'three';

const NEAR = 4;
const REACH = { mouse: 9, pen: 12, touch: 18 };

function search(layer, matrix, size, x, y, limit, best) {
  const e = matrix.elements;
  const p = layer.positions;
  for (let i = 0; i < layer.count; i++) {
    const px = p[3 * i], py = p[3 * i + 1], pz = p[3 * i + 2];
    const w = e[3] * px + e[7] * py + e[11] * pz + e[15];
    if (w <= 0) continue;
    const dx = ((e[0] * px + e[4] * py + e[8] * pz + e[12]) / w + 1) * 0.5 * size.width - x;
    const dy = (1 - (e[1] * px + e[5] * py + e[9] * pz + e[13]) / w) * 0.5 * size.height - y;
    const distance = Math.hypot(dx, dy);
    if (distance > best.reach) continue;
    const depth = (e[2] * px + e[6] * py + e[10] * pz + e[14]) / w;
    if (depth > limit) continue;
    const rank = distance <= NEAR ? depth - 2 : distance;
    if (rank < best.rank) Object.assign(best, { rank, layer, index: i });
  }
}

/** { layer, index } of the point at a place of the canvas in CSS pixels, or null. */
export function pick(stage, x, y, pointer = 'mouse') {
  const size = { width: stage.canvas.clientWidth, height: stage.canvas.clientHeight };
  stage.camera.updateMatrixWorld();
  const matrix = new Matrix4().multiplyMatrices(stage.camera.projectionMatrix, stage.camera.matrixWorldInverse);
  const best = { rank: Infinity, reach: REACH[pointer] ?? REACH.mouse };
  const limit = stage.surfaceDepth(x, y);
  for (const layer of stage.layers)
    if (layer.kind === 'points' && layer.visible) search(layer, matrix, size, x, y, limit, best);
  return best.layer ? { layer: best.layer, index: best.index } : null;
}
