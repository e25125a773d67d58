// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// What crease_page_write() put into the page: one JSON element that describes the scene, and
// numbers in elements of their own, packed as src/view/pack.h says.

const BLOCK = 4096;
const LATTICE = 1 / 8388607;

/** How the numbers of each form are packed: in a tuple so many, of so many bytes each. */
const forms = {
  lattice: { components: 3, bytes: 3, differences: true, array: Float32Array, unit: LATTICE },
  direction: { components: 3, bytes: 2, differences: true, array: Float32Array, unit: 1 / 32767 },
  links: { components: 2, bytes: 4, differences: true, array: Uint32Array },
  triangles: { components: 3, bytes: 4, differences: true, array: Uint32Array },
  int8: { components: 1, bytes: 1, differences: true, array: Int8Array },
  uint8: { components: 1, bytes: 1, differences: true, array: Uint8Array },
  int16: { components: 1, bytes: 2, differences: true, array: Int16Array },
  uint16: { components: 1, bytes: 2, differences: true, array: Uint16Array },
  int32: { components: 1, bytes: 4, differences: true, array: Int32Array },
  uint32: { components: 1, bytes: 4, differences: true, array: Uint32Array },
  float32: { components: 1, bytes: 4, differences: false, array: Float32Array },
};

function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The numbers of one component of one block, one after the other, as bits. */
function gather(bytes, begin, size, width, out) {
  out.fill(0, 0, size);
  for (let b = 0; b < width; b++)
    for (let i = 0, at = begin + b * size, shift = 8 * b; i < size; i++, at++) out[i] |= bytes[at] << shift;
}

/** Undoes the differences modulo 2^bits; `last` is the number before. */
function addUp(values, size, bits, last) {
  const spare = 32 - bits;
  for (let i = 0; i < size; i++) {
    const folded = values[i];
    last = ((last + ((folded >>> 1) ^ -(folded & 1))) << spare) >> spare;
    values[i] = last;
  }
  return last;
}

function unpack(bytes, { components, bytes: width, differences, array, unit }) {
  const tuples = bytes.length / (components * width);
  const whole = new (unit ? Float32Array : Int32Array)(tuples * components);
  const block = new Int32Array(BLOCK);
  const last = [0, 0, 0];
  for (let first = 0; first < tuples; first += BLOCK) {
    const size = Math.min(BLOCK, tuples - first);
    for (let c = 0; c < components; c++) {
      gather(bytes, (first * components + c * size) * width, size, width, block);
      if (differences) last[c] = addUp(block, size, 8 * width, last[c]);
      for (let i = 0, at = first * components + c; i < size; i++, at += components)
        whole[at] = unit ? block[i] * unit : block[i];
    }
  }
  if (unit) return whole;
  return array.BYTES_PER_ELEMENT === 4 ? new array(whole.buffer) : array.from(whole);
}

function element(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page lacks its part ${id}`);
  return found;
}

const parts = new Map();

async function read(script) {
  const bytes = bytesOf(script.textContent.trim());
  script.textContent = '';
  parts.set(script.id, unpack(await inflate(bytes), forms[script.dataset.form]));
}

/** Reads all numbers; the texts they came from are given free. */
export async function readNumbers() {
  if (!globalThis.DecompressionStream) throw new Error('this browser is too old to unpack its numbers');
  for (const script of document.querySelectorAll('script[data-form]')) await read(script);
}

/** The numbers of part `id`. */
export function numbers(id) {
  const found = parts.get(id);
  if (!found) throw new Error(`the page lacks its part ${id}`);
  return found;
}

/** The description of the scene. */
export function description() {
  return JSON.parse(element('crease-scene').textContent);
}

/** A colour map as 256 triples of bytes. */
export function colourMap(scene, name) {
  return bytesOf(scene.maps[name]);
}
