// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// Saves what is seen as a PNG file, with its title, the scale of its colours and what is measured.

import { drawBar } from './colours.js';
import { theme } from './theme.js';
import { get } from './text.js';

function write(context, ratio, text, x, y, align = 'left', weight = '400') {
  context.font = `${weight} ${13 * ratio}px system-ui, "DejaVu Sans", sans-serif`;
  context.textAlign = align;
  context.fillText(text, x * ratio, y * ratio);
}

function drawScale(context, ratio, width, height, colouring) {
  const bar = document.createElement('canvas');
  bar.width = 256;
  bar.height = 1;
  drawBar(bar, colouring.map);
  const x = width - 296, y = height - 40;
  write(context, ratio, colouring.field, x, y - 8);
  context.imageSmoothingEnabled = false;
  context.drawImage(bar, x * ratio, y * ratio, 180 * ratio, 10 * ratio);
  write(context, ratio, colouring.number(colouring.range[0]), x, y + 25);
  write(context, ratio, colouring.number(colouring.range[1]), x + 180, y + 25, 'right');
}

/** The picture as a canvas. */
export function pictureOf(scene, stage, colouring, overlay) {
  stage.draw();
  const source = stage.renderer.domElement;
  const canvas = document.createElement('canvas');
  canvas.width = source.width;
  canvas.height = source.height;
  const ratio = source.width / stage.canvas.clientWidth;
  const [width, height] = [stage.canvas.clientWidth, stage.canvas.clientHeight];
  const context = canvas.getContext('2d');
  context.drawImage(source, 0, 0);
  const compass = get('compass');
  context.drawImage(compass, (width - 100) * ratio, (height - 100) * ratio, 92 * ratio, 92 * ratio);
  context.fillStyle = theme.dark ? '#ececf1' : '#1c1c22';
  write(context, ratio, scene.title || 'crease', 16, 26, 'left', '600');
  if (colouring.field && !colouring.grouped) drawScale(context, ratio, width, height, colouring);
  if (!overlay.label.hidden) {
    const { x, y } = stage.project(overlay.middle.toArray());
    write(context, ratio, overlay.label.textContent, x + 12, y + 4, 'left', '600');
  }
  return canvas;
}

/** A file name of the title. */
function nameOf(title) {
  return `${(title || 'crease').replace(/\.[a-z0-9]{1,5}$/i, '').replace(/[^\p{L}\p{N}._-]+/gu, '_').replace(/^[._]+/, '') || 'crease'}.png`;
}

export async function savePicture(scene, stage, colouring, overlay) {
  const canvas = pictureOf(scene, stage, colouring, overlay);
  const blob = await new Promise((done) => canvas.toBlob(done, 'image/png'));
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = nameOf(scene.title);
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  return link.download;
}
