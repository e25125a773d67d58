// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// A small cross in the corner that tells where x, y and z point.

import { Vector3 } from 'three';
import { theme } from './theme.js';

const axes = [
  { name: 'x', direction: new Vector3(1, 0, 0), light: '#b3261e', dark: '#ff8a80' },
  { name: 'y', direction: new Vector3(0, 1, 0), light: '#1b7f3b', dark: '#7fe0a0' },
  { name: 'z', direction: new Vector3(0, 0, 1), light: '#1f5fbf', dark: '#8fb8ff' },
];

export function drawCompass(canvas, camera) {
  const context = canvas.getContext('2d');
  const half = canvas.width / 2;
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.lineCap = 'round';
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.font = '26px system-ui, "DejaVu Sans", sans-serif';
  context.lineWidth = 4;
  const turned = axes
    .map((axis) => ({ axis, tip: axis.direction.clone().transformDirection(camera.matrixWorldInverse) }))
    .sort((a, b) => a.tip.z - b.tip.z);
  for (const { axis, tip } of turned) {
    context.strokeStyle = context.fillStyle = theme.dark ? axis.dark : axis.light;
    context.globalAlpha = tip.z < -0.05 ? 0.55 : 1;
    context.beginPath();
    context.moveTo(half, half);
    context.lineTo(half + 52 * tip.x, half - 52 * tip.y);
    context.stroke();
    context.fillText(axis.name, half + 74 * tip.x, half - 74 * tip.y);
  }
}
