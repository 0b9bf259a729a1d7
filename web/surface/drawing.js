// SPDX-License-Identifier: Apache-2.0
const modes = {shaded: 0, isolines: 1, curvature: 2, zebra: 3, isophotes: 4, reflection: 5, deviation: 2};
/** The scale that the colours follow. */
const scaleName = () => state.mode === "deviation" ? "deviation" : state.quantity;
const quantities = ["gaussian", "mean", "k1", "k2"];
const views = {iso: [35, 28], front: [0, 0], top: [0, 90], side: [90, 0], back: [180, 0], bottom: [0, -90]};
const state = {mode: "shaded", quantity: "gaussian", u: 10, v: 10, stripes: 10, borders: true, wireframe: false,
  perspective: true, azimuth: 35, elevation: 28, target: [0, 0, 0], span: 2, lit: -1, found: null, placed: false};
const canvas = byId("view");
/** Half the angle of view; small, as through a long lens. */
const tangent = Math.tan(13 * Math.PI / 180);
let gl = null, surfaceProgram = null, lineProgram = null, dotProgram = null, dotArray = null, paletteTextures = null, rasterTexture = null, pending = false;

function program(vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw new Error(gl.getShaderInfoLog(shader));
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(gl.getProgramInfoLog(made));
  const at = {};
  for (let i = 0; i < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); ++i) {
    const name = gl.getActiveUniform(made, i).name;
    at[name] = gl.getUniformLocation(made, name);
  }
  return {made, at};
}

function attribute(place, data, size, kind, normalized) {
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(place);
  gl.vertexAttribPointer(place, size, kind, normalized, 0, 0);
}

function indices(data) {
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, data, gl.STATIC_DRAW);
}
const indexKind = patch => patch.index.BYTES_PER_ELEMENT === 4 ? gl.UNSIGNED_INT : gl.UNSIGNED_SHORT;

function paletteTexture(stops) {
  const texels = new Uint8Array(4 * stops.length);
  stops.forEach((s, i) => texels.set([1, 3, 5].map(k => parseInt(s.slice(k, k + 2), 16)).concat(255), 4 * i));
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, stops.length, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, texels);
  for (const [key, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
                              [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) {
    gl.texParameteri(gl.TEXTURE_2D, key, value);
  }
  return texture;
}

/** Nodes of all patches one after the other in rows of `rasterWidth`, each followed by its breaks. */
const rasterWidth = 2048;
function rasterOfPatches() {
  const count = patch => patch.k.length / 2 + patch.sides[0].breaks.length + patch.sides[1].breaks.length;
  const height = Math.ceil(model.patches.reduce((sum, patch) => sum + count(patch), 0) / rasterWidth);
  const texels = new Uint32Array(4 * rasterWidth * height), reals = new Float32Array(texels.buffer), halves = new Int16Array(texels.buffer);
  let at = 0;
  for (const patch of model.patches) {
    patch.firstNode = at;
    for (let i = 0; i < patch.k.length / 2; ++i, ++at) {
      reals[4 * at] = patch.k[2 * i];
      reals[4 * at + 1] = patch.k[2 * i + 1];
      halves[8 * at + 4] = patch.nodeNormal[2 * i];
      halves[8 * at + 5] = patch.nodeNormal[2 * i + 1];
      if (patch.off) reals[4 * at + 3] = patch.off[i];
    }
    for (const side of patch.sides) {
      side.first = at;
      for (const part of side.breaks) reals[4 * at++] = part;
    }
  }
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32UI, rasterWidth, height, 0, gl.RGBA_INTEGER, gl.UNSIGNED_INT, texels);
  for (const key of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, key, gl.NEAREST);
  return texture;
}

/** Everything that lives in the graphics card; again after it was lost. */
function upload() {
  surfaceProgram = program(surfaceVertex, surfaceFragment);
  lineProgram = program(lineVertex, lineFragment);
  dotProgram = program(dotVertex, dotFragment);
  paletteTextures = {sequential: paletteTexture(model.palettes.sequential), diverging: paletteTexture(model.palettes.diverging)};
  rasterTexture = rasterOfPatches();
  for (const patch of model.patches) {
    patch.edges = null;
    patch.array = gl.createVertexArray();
    gl.bindVertexArray(patch.array);
    attribute(0, patch.position, 3, gl.FLOAT, false);
    attribute(1, patch.normal, 2, gl.SHORT, true);
    attribute(2, patch.uv, 2, gl.FLOAT, false);
    indices(patch.index);
  }
  dotArray = gl.createVertexArray();
  gl.bindVertexArray(dotArray);
  attribute(0, model.dotPosition, 3, gl.FLOAT, false);
  attribute(1, model.dotValue, 1, gl.FLOAT, false);
  for (const line of model.lines) {
    line.array = gl.createVertexArray();
    gl.bindVertexArray(line.array);
    attribute(0, line.position, 3, gl.FLOAT, false);
  }
  gl.bindVertexArray(null);
}

function edgeArray(patch) {
  if (patch.edges) return patch.edges;
  const index = edgesOf(patch);
  patch.edges = {array: gl.createVertexArray(), count: index.length};
  gl.bindVertexArray(patch.edges.array);
  attribute(0, patch.position, 3, gl.FLOAT, false);
  indices(index);
  return patch.edges;
}

// ---- camera: lengths are parts of the radius, z points up --------------------------------------

/** Unit vectors of the view: to the right, upwards, towards the viewer. */
function basis() {
  const a = state.azimuth * Math.PI / 180, e = state.elevation * Math.PI / 180;
  const ca = Math.cos(a), sa = Math.sin(a), ce = Math.cos(e), se = Math.sin(e);
  return [[ca, sa, 0], [-sa * se, ca * se, ce], [sa * ce, -ca * ce, se]];
}
const dot3 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const distance = () => state.span / tangent;
const size = () => ({width: Math.max(1, canvas.clientWidth), height: Math.max(1, canvas.clientHeight)});
/** Px at the edges of the window that belong to title, panel and legend. */
function covered() {
  const {width} = size();
  return width > 720 ? {right: 288, top: 60, bottom: 118} : {right: 0, top: 64, bottom: byId("panel").offsetHeight + 10};
}

function matrices() {
  const b = basis(), {width, height} = size(), c = covered(), s = 1 / model.radius, d = distance();
  const toView = new Float32Array(16), turn = new Float32Array(9), toClip = new Float32Array(16);
  b.forEach((axis, row) => {
    for (let k = 0; k < 3; ++k) {
      toView[4 * k + row] = axis[k] * s;
      turn[3 * k + row] = axis[k];
    }
    toView[12 + row] = -dot3(axis, state.target);
  });
  toView[14] -= d;
  toView[15] = 1;
  const middle = d + dot3(b[2], state.target), far = middle + 1.05, aspect = width / height;
  const near = state.perspective ? Math.max(middle - 1.05, far * 1e-4) : middle - 1.05;
  if (state.perspective) {
    toClip[0] = 1 / (tangent * aspect);
    toClip[5] = 1 / tangent;
    toClip[10] = -(far + near) / (far - near);
    toClip[11] = -1;
    toClip[14] = -2 * far * near / (far - near);
  } else {
    toClip[0] = 1 / (state.span * aspect);
    toClip[5] = 1 / state.span;
    toClip[10] = -2 / (far - near);
    toClip[14] = -(far + near) / (far - near);
    toClip[15] = 1;
  }
  // the middle of the part that the panel leaves free
  const x = -c.right / width, y = (c.bottom - c.top) / height;
  for (let k = 0; k < 4; ++k) {
    toClip[4 * k] += x * toClip[4 * k + 3];
    toClip[4 * k + 1] += y * toClip[4 * k + 3];
  }
  return {toView, toClip, turn, shift: [x, y], aspect};
}

/** Where a point (offset from the centre, units) stands in the window, px. */
function project(point) {
  const {toView: a, toClip: c} = matrices(), {width, height} = size(), times = (m, p) =>
      [0, 1, 2, 3].map(i => m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i] * p[3]);
  const q = times(c, times(a, [...point, 1]));
  return [(q[0] / q[3] + 1) * width / 2, (1 - q[1] / q[3]) * height / 2];
}

/** Ray through a place of the window, in units. */
function ray(x, y) {
  const {shift, aspect} = matrices(), {width, height} = size(), b = basis(), r = model.radius;
  const sx = (2 * x / width - 1 - shift[0]) * aspect * state.span, sy = (1 - 2 * y / height - shift[1]) * state.span;
  const at = b[0].map((_, k) => state.target[k] + sx * b[0][k] + sy * b[1][k]);
  const eye = state.target.map((t, k) => t + distance() * b[2][k]);
  const origin = state.perspective ? eye : at.map((t, k) => t + 4 * b[2][k]);
  return {origin: origin.map(t => t * r), direction: at.map((t, k) => (t - origin[k]) * r), sx, sy};
}

/** Turns the camera's target and width so that everything shown fills the free part. */
function fitted() {
  const b = basis(), {width, height} = size(), c = covered();
  const points = samplePoints().map(p => b.map(axis => dot3(axis, p) / model.radius));
  const low = [0, 1, 2].map(k => points.reduce((least, p) => Math.min(least, p[k]), Infinity));
  const high = [0, 1, 2].map(k => points.reduce((most, p) => Math.max(most, p[k]), -Infinity));
  const free = [Math.max(0.3, (width - c.right) / width), Math.max(0.3, (height - c.bottom - c.top) / height)];
  const room = [free[0] * width / height * 0.9, free[1] * 0.96];
  const middle = low.map((l, k) => (l + high[k]) / 2);
  let span = Math.max((high[0] - low[0]) / 2 / room[0], (high[1] - low[1]) / 2 / room[1], 1e-6);
  if (state.perspective) {
    // what is nearer looks larger: the eye steps back until every point lies within
    let d = 0;
    for (const p of points) {
      const z = p[2] - middle[2];
      d = Math.max(d, Math.abs(p[0] - middle[0]) / (room[0] * tangent) + z, Math.abs(p[1] - middle[1]) / (room[1] * tangent) + z);
    }
    span = Math.max(d * tangent, 1e-6);
  }
  return {target: [0, 1, 2].map(k => b.reduce((sum, axis, i) => sum + middle[i] * axis[k], 0)), span};
}

// ---- drawing -----------------------------------------------------------------------------------

const roleInks = () => dark.matches
    ? {section: [1, .45, .38, 1], toolpath: [1, .78, .30, .95], rapid: [.62, .70, .78, .7], other: [.55, .85, .80, 1]}
    : {section: [.78, .10, .12, 1], toolpath: [.80, .32, .02, .95], rapid: [.35, .42, .50, .6], other: [.04, .48, .46, 1]};

function drawSurfaces(m) {
  const scale = model.scales[scaleName()], {made, at} = surfaceProgram;
  // points alone have colours: the surface under them stays plain
  const plain = state.mode === "deviation" && !model.off;
  gl.useProgram(made);
  gl.uniformMatrix4fv(at.toView, false, m.toView);
  gl.uniformMatrix4fv(at.toClip, false, m.toClip);
  gl.uniformMatrix3fv(at.turn, false, m.turn);
  gl.uniform1i(at.mode, plain ? 0 : modes[state.mode]);
  gl.uniform1i(at.quantity, state.mode === "deviation" ? 4 : quantities.indexOf(state.quantity));
  gl.uniform3f(at.middle, m.toView[12], m.toView[13], m.toView[14]);
  gl.uniform1i(at.perspective, state.perspective);
  gl.uniform1i(at.borders, state.borders);
  gl.uniform1i(at.night, dark.matches);
  gl.uniform1f(at.stripes, state.stripes);
  gl.uniform2f(at.cells, state.u, state.v);
  gl.uniform2f(at.range, scale.low, scale.high);
  gl.bindTexture(gl.TEXTURE_2D, paletteTextures[scale.diverging ? "diverging" : "sequential"]);
  gl.uniform1i(at.raster, 1);
  gl.activeTexture(gl.TEXTURE1);
  gl.bindTexture(gl.TEXTURE_2D, rasterTexture);
  gl.activeTexture(gl.TEXTURE0);
  gl.enable(gl.POLYGON_OFFSET_FILL);
  gl.polygonOffset(1, 1);
  model.patches.forEach((patch, i) => {
    if (!patch.shown || !patch.triangles) return;
    gl.uniform1f(at.lit, i === state.lit ? 1 : 0);
    gl.uniform4fv(at.real, patch.borders);
    gl.uniform1i(at.firstNode, patch.firstNode);
    patch.sides.forEach((side, k) => gl.uniform3i(k ? at.sideV : at.sideU, side.first, side.breaks.length - 1, side.cells));
    gl.bindVertexArray(patch.array);
    gl.drawElements(gl.TRIANGLES, patch.index.length, indexKind(patch), 0);
  });
  gl.disable(gl.POLYGON_OFFSET_FILL);
}

function drawLines(m) {
  const {made, at} = lineProgram, inks = roleInks();
  gl.useProgram(made);
  gl.uniformMatrix4fv(at.toView, false, m.toView);
  gl.uniformMatrix4fv(at.toClip, false, m.toClip);
  gl.enable(gl.BLEND);
  gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  if (state.wireframe) {
    gl.uniform1f(at.nearer, 0);
    gl.uniform4f(at.ink, .02, .05, .10, .26);
    for (const patch of model.patches) {
      if (!patch.shown) continue;
      const edges = edgeArray(patch);
      gl.bindVertexArray(edges.array);
      gl.drawElements(gl.LINES, edges.count, indexKind(patch), 0);
    }
  }
  // lines on the surface stand before it by this part of the depth
  gl.uniform1f(at.nearer, 1e-3);
  for (const line of model.lines) {
    if (!line.shown) continue;
    gl.uniform4fv(at.ink, Object.hasOwn(inks, line.role) ? inks[line.role] : inks.other);
    gl.bindVertexArray(line.array);
    gl.drawArrays(gl.LINE_STRIP, 0, line.count);
  }
  gl.disable(gl.BLEND);
}

function drawDots(m) {
  if (state.mode !== "deviation" || !model.dots) return;
  const {made, at} = dotProgram, scale = model.scales.deviation;
  gl.useProgram(made);
  gl.uniformMatrix4fv(at.toView, false, m.toView);
  gl.uniformMatrix4fv(at.toClip, false, m.toClip);
  gl.uniform1f(at.size, 4 * Math.min(devicePixelRatio || 1, 2));
  gl.uniform1f(at.nearer, 2e-3);
  gl.uniform2f(at.range, scale.low, scale.high);
  gl.bindTexture(gl.TEXTURE_2D, paletteTextures[scale.diverging ? "diverging" : "sequential"]);
  gl.bindVertexArray(dotArray);
  gl.drawArrays(gl.POINTS, 0, model.dots);
}

/** The axes in the corner and the ring around the point that is read off. */
function drawOver() {
  const {height, width} = size(), b = basis(), x = 58, y = height - (width > 720 ? 58 : covered().bottom + 48);
  const inks = dark.matches ? ["#ff8a80", "#8fd07a", "#6cb2ff"] : ["#c0392b", "#3f8a3a", "#1b6ec2"];
  const order = [0, 1, 2].sort((i, j) => b[2][i] - b[2][j]);
  let text = "";
  for (const i of order) {
    const dx = 34 * b[0][i], dy = -34 * b[1][i], far = 46 / 34;
    text += `<path d="M${x} ${y}l${dx.toFixed(1)} ${dy.toFixed(1)}" stroke="${inks[i]}" stroke-width="2.2" stroke-linecap="round"/>`;
    if (Math.hypot(dx, dy) > 6) text += `<text x="${(x + far * dx).toFixed(1)}" y="${(y + far * dy + 4).toFixed(1)}" text-anchor="middle" fill="${inks[i]}">${"xyz"[i]}</text>`;
  }
  if (state.found) {
    const [px, py] = project(state.found.point);
    text += `<circle cx="${px.toFixed(1)}" cy="${py.toFixed(1)}" r="6" fill="none" stroke="#fff" stroke-width="4"/><circle cx="${px.toFixed(1)}" cy="${py.toFixed(1)}" r="6" fill="none" stroke="#1c2733" stroke-width="2"/>`;
  }
  byId("over").innerHTML = text;
}

function draw() {
  pending = false;
  if (gl.isContextLost()) return;
  const {width, height} = size(), ratio = Math.min(devicePixelRatio || 1, 2);
  const w = Math.round(width * ratio), h = Math.round(height * ratio);
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
  }
  gl.viewport(0, 0, w, h);
  gl.clearColor(0, 0, 0, 0);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.LEQUAL);
  const m = matrices();
  drawSurfaces(m);
  drawLines(m);
  drawDots(m);
  gl.bindVertexArray(null);
  drawOver();
}
function redraw() {
  if (!pending) requestAnimationFrame(draw);
  pending = true;
}
