// SPDX-License-Identifier: Apache-2.0
"use strict";
/** @type {(id: string) => any} */
const byId = id => document.getElementById(id);
/** @type {(selector: string) => any} */
const oneOf = selector => document.querySelector(selector);
/** @type {(selector: string) => Iterable<any>} */
const allOf = selector => document.querySelectorAll(selector);
const model = JSON.parse(byId("model").textContent);
const dark = matchMedia("(prefers-color-scheme: dark)");
const putOnTheme = () => { document.documentElement.dataset.theme = dark.matches ? "dark" : "light"; };
putOnTheme();
dark.addEventListener("change", putOnTheme);
const calm = matchMedia("(prefers-reduced-motion: reduce)");

function fail(text) {
  byId("failed").hidden = false;
  byId("failed").firstChild.textContent = text;
  byId("panel").hidden = true;
  document.documentElement.dataset.state = "failed";
}

/** All numbers of the page, as bytes. */
function bytesOfPage() {
  const element = byId("data"), text = atob(element.textContent.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  element.remove();
  return bytes.buffer;
}

/** Views of the bytes of each patch, in the order in which they were written. */
function readPatches(buffer) {
  let at = 0;
  const take = (Kind, count) => {
    const view = new Kind(buffer, at, count);
    at += (view.byteLength + 3) & ~3;
    return view;
  };
  for (const patch of model.patches) {
    const n = patch.vertices;
    patch.position = take(Float32Array, 3 * n);
    patch.normal = take(Int16Array, 2 * n);
    patch.uv = take(Float32Array, 2 * n);
    const [[spansU, cellsU], [spansV, cellsV]] = patch.raster, nodes = spansU * (cellsU + 1) * spansV * (cellsV + 1);
    patch.sides = [{breaks: take(Float32Array, spansU + 1), cells: cellsU}, {breaks: take(Float32Array, spansV + 1), cells: cellsV}];
    patch.k = take(Float32Array, 2 * nodes);
    patch.nodeNormal = take(Int16Array, 2 * nodes);
    patch.off = model.off ? take(Float32Array, nodes) : null;
    patch.index = take(n > 65536 ? Uint32Array : Uint16Array, 3 * patch.triangles);
    patch.shown = true;
  }
  for (const line of model.lines) {
    line.position = take(Float32Array, 3 * line.count);
    line.shown = true;
  }
  model.dotPosition = take(Float32Array, 3 * model.dots);
  model.dotValue = take(Float32Array, model.dots);
}

/** Each edge of the triangles once. */
function edgesOf(patch) {
  const index = patch.index, keys = new Float64Array(index.length);
  for (let t = 0; t < index.length; t += 3) {
    for (let k = 0; k < 3; ++k) {
      const a = index[t + k], b = index[t + (k + 1) % 3];
      keys[t + k] = Math.min(a, b) * 4294967296 + Math.max(a, b);
    }
  }
  keys.sort();
  const edges = new index.constructor(2 * keys.length);
  let count = 0, last = -1;
  for (const key of keys) {
    if (key === last) continue;
    last = key;
    edges[count++] = Math.floor(key / 4294967296);
    edges[count++] = key % 4294967296;
  }
  return edges.subarray(0, count);
}

/** Every so many vertices of what is shown: enough to fit the view. */
function samplePoints() {
  const points = [];
  const add = (position, most) => {
    const step = 3 * Math.max(1, Math.ceil(position.length / 3 / most));
    for (let i = 0; i < position.length; i += step) points.push([position[i], position[i + 1], position[i + 2]]);
  };
  const shown = model.patches.filter(p => p.shown);
  for (const patch of shown.length ? shown : model.patches) add(patch.position, Math.max(40, 6000 / model.patches.length));
  if (state.mode === "deviation" && model.dots) add(model.dotPosition, 2000);
  for (const line of model.lines) if (line.shown) add(line.position, Math.max(20, 2000 / model.lines.length));
  return points;
}

/** First triangle that a ray meets; the ray and the triangles are in offsets from the centre. */
function hit(origin, direction) {
  let best = null, nearest = Infinity;
  for (const patch of model.patches) {
    if (!patch.shown) continue;
    const p = patch.position, index = patch.index;
    for (let t = 0; t < index.length; t += 3) {
      const a = 3 * index[t], b = 3 * index[t + 1], c = 3 * index[t + 2];
      const e1x = p[b] - p[a], e1y = p[b + 1] - p[a + 1], e1z = p[b + 2] - p[a + 2];
      const e2x = p[c] - p[a], e2y = p[c + 1] - p[a + 1], e2z = p[c + 2] - p[a + 2];
      const hx = direction[1] * e2z - direction[2] * e2y, hy = direction[2] * e2x - direction[0] * e2z,
            hz = direction[0] * e2y - direction[1] * e2x;
      const det = e1x * hx + e1y * hy + e1z * hz;
      if (det === 0) continue;
      const sx = origin[0] - p[a], sy = origin[1] - p[a + 1], sz = origin[2] - p[a + 2];
      const f = (sx * hx + sy * hy + sz * hz) / det;
      if (!(f >= 0 && f <= 1)) continue;
      const qx = sy * e1z - sz * e1y, qy = sz * e1x - sx * e1z, qz = sx * e1y - sy * e1x;
      const g = (direction[0] * qx + direction[1] * qy + direction[2] * qz) / det;
      if (!(g >= 0 && f + g <= 1)) continue;
      const s = (e2x * qx + e2y * qy + e2z * qz) / det;
      if (s < nearest) {
        nearest = s;
        best = {patch, corners: [index[t], index[t + 1], index[t + 2]], weights: [1 - f - g, f, g]};
      }
    }
  }
  return best;
}

/** Value of a vertex attribute inside a triangle. */
function between(found, array, size) {
  const out = new Array(size).fill(0);
  found.corners.forEach((v, i) => {
    for (let k = 0; k < size; ++k) out[k] += found.weights[i] * array[size * v + k];
  });
  return out;
}

/** Node before a part of the domain, and how far it is to the next one. */
function nodeOf({breaks, cells}, part) {
  let low = 0, high = breaks.length - 1;
  while (high - low > 1) {
    const middle = low + high >> 1;
    if (part < breaks[middle]) high = middle;
    else low = middle;
  }
  const s = cells * Math.min(1, Math.max(0, (part - breaks[low]) / (breaks[low + 1] - breaks[low])));
  const cell = Math.min(Math.floor(s), cells - 1);
  return [low * (cells + 1) + cell, s - cell];
}

/** What the nodes of a patch say at parts of its domain, as the pixels have it. */
function valueAt(patch, part, array, size) {
  const [[i, f], [j, g]] = patch.sides.map((side, k) => nodeOf(side, part[k]));
  const row = (patch.sides[0].breaks.length - 1) * (patch.sides[0].cells + 1), first = j * row + i;
  const value = (node, k) => array[size * node + k];
  return Array.from({length: size}, (_, k) => (1 - g) * ((1 - f) * value(first, k) + f * value(first + 1, k)) +
      g * ((1 - f) * value(first + row, k) + f * value(first + row + 1, k)));
}

const raised = n => String(n).replace("-", "⁻").replace(/\d/g, d => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]);
/** A number for reading. */
function readable(x, digits = 3) {
  if (x === 0 || !isFinite(x)) return x === 0 ? "0" : "∞";
  const size = Math.abs(x), sign = x < 0 ? "−" : "";
  if (size >= 1e-3 && size < 1e6) return sign + String(Number(size.toPrecision(digits)));
  const [mantissa, power] = size.toExponential(digits - 1).split("e");
  return `${sign}${Number(mantissa)}·10${raised(Number(power))}`;
}
