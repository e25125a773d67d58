// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// What crease_page_write() put into the page: one JSON element that describes the scene, and
// numbers in elements of their own, as base64 of little-endian arrays.

const arrays = {
  int8: Int8Array,
  uint8: Uint8Array,
  int16: Int16Array,
  uint16: Uint16Array,
  int32: Int32Array,
  uint32: Uint32Array,
  float32: Float32Array,
};

function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

function element(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page lacks its part ${id}`);
  return found;
}

/** The numbers of part `id`; the text they came from is given free. */
export function numbers(id, type) {
  const script = element(id);
  const bytes = bytesOf(script.textContent);
  script.textContent = '';
  return new arrays[type](bytes.buffer, bytes.byteOffset, bytes.byteLength / arrays[type].BYTES_PER_ELEMENT);
}

/** The description of the scene. */
export function description() {
  return JSON.parse(element('crease-scene').textContent);
}

/** A colour map as 256 triples of bytes. */
export function colourMap(scene, name) {
  return bytesOf(scene.maps[name]);
}
