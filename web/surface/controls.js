// SPDX-License-Identifier: Apache-2.0
const say = text => { byId("said").textContent = text; };
const whole = (text, least, most) => {
  const n = Math.round(Number(text));
  return isFinite(n) && text !== "" ? Math.min(most, Math.max(least, n)) : null;
};

// ---- panel -------------------------------------------------------------------------------------

/** Some round values inside a range. */
function roundTicks(low, high) {
  const rough = (high - low) / 7, base = 10 ** Math.floor(Math.log10(rough)), ticks = [];
  const step = [1, 2, 5, 10].map(f => f * base).find(s => s >= rough * (1 - 1e-9));
  for (let k = Math.ceil(low / step - 1e-9); k <= high / step + 1e-9; ++k) ticks.push(k === 0 ? 0 : k * step);
  return ticks;
}

function showLegend() {
  const shown = state.mode === "curvature" || state.mode === "deviation";
  byId("legend").hidden = !shown;
  if (!shown) return;
  const scale = model.scales[scaleName()], stops = model.palettes[scale.diverging ? "diverging" : "sequential"];
  const [title, bar, ticks, extremes] = ["legend h2", "bar", "ticks", "extremes"].map(id => oneOf("#" + id));
  title.textContent = scale.title + " ";
  title.append(Object.assign(document.createElement("small"), {textContent: "in " + scale.unit}));
  const constant = !(scale.high > scale.low);
  bar.style.background = constant ? stops[stops.length >> 1] : `linear-gradient(90deg,${stops.join(",")})`;
  ticks.replaceChildren();
  for (const value of constant ? [scale.low] : roundTicks(scale.low, scale.high)) {
    const label = document.createElement("span"), part = constant ? 0.5 : (value - scale.low) / (scale.high - scale.low);
    label.textContent = readable(value);
    label.style.left = 100 * part + "%";
    ticks.append(label);
  }
  const endless = scale.least === null || scale.most === null;  // no bound there
  const end = value => value === null ? "no bound" : readable(value);
  const cut = endless || scale.least < scale.low || scale.most > scale.high;
  extremes.textContent = constant && !endless ? "the same everywhere" : `least ${end(scale.least)}, greatest ${end(scale.most)}` +
      (!cut ? "" : scale.diverging ? `; colours to ±${readable(scale.high)}` : `; colours ${readable(scale.low)} to ${readable(scale.high)}`);
}

function showState() {
  for (const button of allOf("#modes button")) button.setAttribute("aria-pressed", String(button.dataset.mode === state.mode));
  for (const button of allOf("#views button")) {
    const v = views[button.dataset.view];
    button.setAttribute("aria-pressed", String(v[0] === state.azimuth && v[1] === state.elevation));
  }
  const striped = ["zebra", "isophotes", "reflection"].includes(state.mode);
  for (const mode of ["isolines", "curvature"]) byId(mode).hidden = mode !== state.mode;
  byId("zebra").hidden = !striped;
  for (const id of ["u", "v", "stripes"]) {
    byId(id).value = state[id];
    byId(id).nextElementSibling.textContent = state[id];
  }
  for (const id of ["borders", "wireframe", "perspective"]) byId(id).checked = state[id];
  byId("quantity").value = state.quantity;
  document.documentElement.dataset.look = state.mode;
  showLegend();
  redraw();
}

function setMode(mode) {
  state.mode = mode;
  showState();
  say(oneOf(`#modes [data-mode=${mode}]`).textContent);
}

/** Moves the camera, softly unless the viewer wants none of that. */
let journey = 0;
function travel(to, quick) {
  const from = {azimuth: state.azimuth, elevation: state.elevation, span: state.span, target: state.target.slice()};
  const turn = ((to.azimuth - from.azimuth + 540) % 360 + 360) % 360 - 180, begun = performance.now(), mine = ++journey;
  const step = now => {
    if (mine !== journey) return;
    const t = quick || calm.matches ? 1 : Math.min(1, (now - begun) / 380), e = t < 1 ? t * t * (3 - 2 * t) : 1;
    state.azimuth = e < 1 ? from.azimuth + e * turn : to.azimuth;
    state.elevation = from.elevation + e * (to.elevation - from.elevation);
    state.span = from.span * Math.pow(to.span / from.span, e);
    state.target = from.target.map((x, k) => x + e * (to.target[k] - x));
    showState();
    if (t < 1) requestAnimationFrame(step);
  };
  step(begun);
}

function look(azimuth, elevation, quick) {
  state.placed = false;
  const before = [state.azimuth, state.elevation];
  [state.azimuth, state.elevation] = [azimuth, elevation];
  const goal = {azimuth, elevation, ...fitted()};
  [state.azimuth, state.elevation] = before;
  travel(goal, quick);
}

function setView(name, quick) {
  look(...views[name], quick);
  if (!quick) say("View " + name);
}

function toggle(id) {
  state[id] = !state[id];
  showState();
}

function listOf(box, items, changed) {
  items.forEach((item, i) => {
    const label = document.createElement("label"), input = document.createElement("input"), name = document.createElement("span");
    input.type = "checkbox";
    input.checked = true;
    name.textContent = name.title = item.name;
    input.addEventListener("change", () => changed(item, i, input.checked));
    label.append(input, name);
    label.addEventListener("pointerenter", () => { if (box.id === "patches") { state.lit = i; redraw(); } });
    label.addEventListener("pointerleave", () => { state.lit = -1; redraw(); });
    box.append(label);
  });
}

function setAllPatches(shown) {
  for (const patch of model.patches) patch.shown = shown;
  for (const input of byId("patches").querySelectorAll("input")) input.checked = shown;
  forget();
  redraw();
}

function savePicture() {
  draw();
  const whole = document.createElement("canvas"), pen = whole.getContext("2d");
  [whole.width, whole.height] = [canvas.width, canvas.height];
  pen.fillStyle = dark.matches ? "#1b2229" : "#ffffff";
  pen.fillRect(0, 0, whole.width, whole.height);
  pen.drawImage(canvas, 0, 0);
  whole.toBlob(blob => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = (model.name.replace(/[^\p{L}\p{N}_-]+/gu, "-").slice(0, 60) || "surface") + ".png";
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  });
}

// ---- values at a point -------------------------------------------------------------------------

function forget() {
  state.found = null;
  byId("point").hidden = true;
}

function readOff(x, y) {
  const {origin, direction} = ray(x, y), found = hit(origin, direction);
  if (!found) {
    forget();
    redraw();
    return;
  }
  const point = between(found, found.patch.position, 3), part = between(found, found.patch.uv, 2), k = valueAt(found.patch, part, found.patch.k, 2);
  const domain = found.patch.domain, at = part.map((t, i) => domain[2 * i] + t * (domain[2 * i + 1] - domain[2 * i]));
  const one = " 1/" + model.units, rows = [["x, y, z", point.map((t, i) => readable(model.centre[i] + t, 7)).join("  ") + " " + model.units],
    ["u, v", at.map(t => readable(t, 4)).join("  ")], ["k1", readable(k[0], 4) + one], ["k2", readable(k[1], 4) + one],
    ["smallest radius", readable(1 / Math.max(Math.abs(k[0]), Math.abs(k[1])), 4) + " " + model.units]];
  if (found.patch.off) rows.push(["deviation", readable(valueAt(found.patch, part, found.patch.off, 1)[0], 4) + " " + model.units]);
  state.found = {point};
  const box = byId("point"), list = box.querySelector("dl");
  box.querySelector("h2").textContent = found.patch.name;
  list.replaceChildren();
  for (const [name, value] of rows) {
    list.append(Object.assign(document.createElement("dt"), {textContent: name}), Object.assign(document.createElement("dd"), {textContent: value}));
  }
  box.hidden = false;
  redraw();
}

// ---- mouse, touch, keys ------------------------------------------------------------------------

function turnBy(dx, dy) {
  ++journey;
  state.placed = true;
  state.azimuth = ((state.azimuth - dx) % 360 + 360) % 360;
  state.elevation = Math.min(90, Math.max(-90, state.elevation + dy));
  showState();
}
function panBy(dx, dy) {
  ++journey;
  state.placed = true;
  const b = basis(), step = 2 * state.span / size().height;
  state.target = state.target.map((t, k) => t - step * (dx * b[0][k] - dy * b[1][k]));
  redraw();
}
/** What stands under (x, y) stays there. */
function zoomBy(factor, x, y) {
  ++journey;
  state.placed = true;
  const b = basis(), before = ray(x, y), span = Math.min(50, Math.max(1e-4, state.span * factor)), kept = 1 - span / state.span;
  state.target = state.target.map((t, k) => t + kept * (before.sx * b[0][k] + before.sy * b[1][k]));
  state.span = span;
  redraw();
}
const zoomMiddle = factor => {
  const {width, height} = size(), c = covered();
  zoomBy(factor, (width - c.right) / 2, (height - c.bottom + c.top) / 2);
};

function listenToPointers() {
  const fingers = new Map();
  let moved = 0;
  canvas.addEventListener("pointerdown", e => {
    canvas.setPointerCapture(e.pointerId);
    if (fingers.size === 0) moved = 0;
    fingers.set(e.pointerId, [e.clientX, e.clientY]);
  });
  canvas.addEventListener("pointermove", e => {
    const last = fingers.get(e.pointerId);
    if (!last) return;
    const now = [e.clientX, e.clientY], dx = now[0] - last[0], dy = now[1] - last[1];
    moved += Math.abs(dx) + Math.abs(dy);
    if (fingers.size === 2) {
      const other = [...fingers].find(([id]) => id !== e.pointerId)[1];
      const gap = p => Math.max(8, Math.hypot(p[0] - other[0], p[1] - other[1]));
      panBy(dx / 2, dy / 2);
      zoomBy(gap(last) / gap(now), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
    } else if (fingers.size === 1) {
      if (e.shiftKey || e.buttons & 6) panBy(dx, dy);
      else turnBy(dx * 0.4, dy * 0.4);
    }
    fingers.set(e.pointerId, now);
  });
  const end = e => {
    const single = fingers.size === 1 && fingers.delete(e.pointerId);
    fingers.delete(e.pointerId);
    if (single && e.type === "pointerup" && moved < 4 && e.button === 0) readOff(e.clientX, e.clientY);
  };
  canvas.addEventListener("pointerup", end);
  canvas.addEventListener("pointercancel", end);
  canvas.addEventListener("contextmenu", e => e.preventDefault());
  canvas.addEventListener("wheel", e => {
    e.preventDefault();
    const lines = e.deltaMode === 1 ? 24 : e.deltaMode === 2 ? 400 : 1;
    zoomBy(Math.exp(Math.max(-120, Math.min(120, e.deltaY * lines)) * 0.0016), e.clientX, e.clientY);
  }, {passive: false});
}

const keys = {f: () => look(state.azimuth, state.elevation), "+": () => zoomMiddle(0.85), "=": () => zoomMiddle(0.85), "-": () => zoomMiddle(1 / 0.85),
  "0": () => setView("iso"), "1": () => setView("front"), "2": () => setView("top"), "3": () => setView("side"),
  s: () => setMode("shaded"), i: () => setMode("isolines"), c: () => setMode("curvature"), z: () => setMode("zebra"), o: () => setMode("isophotes"), r: () => setMode("reflection"),
  d: () => { if (model.scales.deviation) setMode("deviation"); },
  b: () => toggle("borders"), w: () => toggle("wireframe"), p: () => toggle("perspective"), escape: () => { forget(); redraw(); }};
function onKey(e) {
  if (e.ctrlKey || e.metaKey || e.altKey || /^(INPUT|SELECT)$/.test(e.target.tagName)) return;
  const arrow = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[e.key];
  const act = keys[e.key.toLowerCase()];
  if (arrow) (e.shiftKey ? panBy : turnBy)(...arrow.map(x => x * (e.shiftKey ? 30 : 6)));
  else if (act) act();
  else return;
  e.preventDefault();
}

// ---- start -------------------------------------------------------------------------------------

/** `#mode=zebra&view=top&projection=orthographic&wireframe=1&u=12&v=6&stripes=20` */
function readAddress() {
  const given = new URLSearchParams(location.hash.slice(1)), mode = given.get("mode") ?? model.start.mode;
  if (quantities.includes(mode)) [state.mode, state.quantity] = ["curvature", mode];
  else if (Object.hasOwn(modes, mode) && (mode !== "deviation" || model.scales.deviation)) state.mode = mode;
  const chosen = given.get("quantity");
  if (quantities.includes(chosen)) state.quantity = chosen;
  for (const id of ["u", "v", "stripes"]) state[id] = whole(given.get(id) ?? "", Number(byId(id).min), Number(byId(id).max)) ?? state[id];
  for (const id of ["borders", "wireframe"]) if (given.has(id)) state[id] = given.get(id) !== "0";
  const projection = given.get("projection");
  if (projection) state.perspective = projection !== "orthographic";
  const view = given.get("view") ?? model.start.view;
  setView(Object.hasOwn(views, view) ? view : "iso", true);
}

function listen() {
  listenToPointers();
  document.addEventListener("keydown", onKey);
  for (const button of allOf("#modes button")) button.addEventListener("click", () => setMode(button.dataset.mode));
  for (const button of allOf("#views button")) button.addEventListener("click", () => setView(button.dataset.view));
  for (const id of ["u", "v", "stripes"]) byId(id).addEventListener("input", () => { state[id] = Number(byId(id).value); showState(); });
  for (const id of ["borders", "wireframe", "perspective"]) byId(id).addEventListener("change", () => toggle(id));
  byId("quantity").addEventListener("change", () => { state.quantity = byId("quantity").value; showState(); });
  byId("fit").addEventListener("click", keys.f);
  byId("save").addEventListener("click", savePicture);
  byId("all").addEventListener("click", () => setAllPatches(true));
  byId("none").addEventListener("click", () => setAllPatches(false));
  byId("point").querySelector("button").addEventListener("click", keys.escape);
  // until the viewer chooses a place the surface keeps filling the window
  new ResizeObserver(() => {
    if (!state.placed) look(state.azimuth, state.elevation, true);
    draw();  // in the same frame, or it would show stretched
  }).observe(canvas);
  addEventListener("hashchange", readAddress);
  dark.addEventListener("change", redraw);
  canvas.addEventListener("webglcontextlost", e => e.preventDefault());
  canvas.addEventListener("webglcontextrestored", () => { upload(); redraw(); });
}

function start() {
  gl = canvas.getContext("webgl2", {antialias: true, alpha: true, premultipliedAlpha: true});
  if (!gl) {
    fail("This page draws the surface with WebGL 2, which this browser does not offer or has switched off. Any current Firefox, Chrome, Edge or Safari shows it.");
    return;
  }
  readPatches(bytesOfPage());
  Object.assign(state, {u: model.start.u, v: model.start.v, stripes: model.start.stripes, perspective: !model.start.orthographic});
  const roles = [...new Set(model.lines.map(line => line.role))];
  byId("lines").hidden = roles.length === 0;
  oneOf("#modes [data-mode=deviation]").hidden = !model.scales.deviation;
  byId("parts").hidden = model.patches.length < 2;
  listOf(byId("patches"), model.patches, (patch, _number, shown) => { patch.shown = shown; forget(); redraw(); });
  listOf(byId("roles"), roles.map(role => ({name: role})), (item, _number, shown) => {
    for (const line of model.lines) if (line.role === item.name) line.shown = shown;
    redraw();
  });
  upload();
  listen();
  readAddress();
  draw();
  const error = gl.getError();
  document.documentElement.dataset.state = error ? "failed" : "ready";
  if (error) console.error("WebGL error " + error);
}
try {
  start();
} catch (error) {
  console.error(error);
  fail("The surface cannot be drawn in this browser: " + error.message);
}
