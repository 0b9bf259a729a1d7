// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef } from "preact/hooks";
import { computed, effect, signal } from "@preact/signals";
import { withGiven, type Vec } from "../document/document";
import {
  abandonDrag, change, combEvery, combHeight, current, doc, drag, drawn, drop, fitted, hovered, insertPoint,
  isDragged, movePoint, pointed, region, removePoint, select, selected, shadesRegion, shown, snaps,
} from "../state";
import { adjacentOf } from "./adjacent";
import { around, fromScreen, gridStep, panned, toScreen, zoomed, type Camera } from "./camera";
import { barOf, GRID, HANDLE, kappaAt, onBar, paint, radiusOnBar, regionOf, tangentTip, type Bar } from "./paint";
import { theme } from "./theme";
import { kept, picture, scaling } from "./underlay";
import { words } from "../words/words";

const camera = signal<Camera>({ scale: 1, x: 0, y: 0 });
/** By how much the width of the region is drawn larger; null: there is none to be drawn. */
export const magnification = computed(() => {
  const curve = shadesRegion.value ? drawn.value?.curve : null, carrier = drawn.value?.report?.carrier;
  return curve && !promisesNothing(carrier) ? regionOf(curve, camera.value).factor : null;
});

/** Curves whose curvature goes every way have no region. */
function promisesNothing(carrier: string | undefined): boolean {
  return carrier === "cubic" || carrier === "baseline" || carrier === "imported";
}

/** The bar of curvatures that is dragged along stays as it was. */
const held = signal<Bar | null>(null);
/** Pixels from a handle within which it is meant, and those that a click may slip. */
const REACH = { mouse: 2 * HANDLE, finger: 4 * HANDLE }, SLACK = { mouse: 2, finger: 6 };
type Hand = keyof typeof REACH;

function handOf(e: PointerEvent): Hand {
  return e.pointerType === "touch" ? "finger" : "mouse";
}

export function showAll(): void {
  const canvas = document.querySelector<HTMLCanvasElement>("#drawing");
  if (canvas) camera.value = around(doc.value.points, canvas.clientWidth, canvas.clientHeight);
}

/** Lays a picture below the drawing, as large as that. */
export async function layPicture(file: File): Promise<void> {
  const canvas = document.querySelector<HTMLCanvasElement>("#drawing"), image = await createImageBitmap(file);
  if (!canvas) return;
  const fill = 0.9 * Math.min(canvas.clientWidth / image.width, canvas.clientHeight / image.height);
  const corner: Vec = [(canvas.clientWidth - fill * image.width) / 2, (canvas.clientHeight - fill * image.height) / 2];
  picture.value = { image, at: fromScreen(camera.value, corner), unit: fill / camera.value.scale };
}

/** Where a point of the document lies in the window, pixels. */
export function onScreen(p: Vec): Vec {
  const box = document.querySelector("#drawing")!.getBoundingClientRect(), [x, y] = toScreen(camera.value, p);
  return [box.left + x, box.top + y];
}

/** Where a curvature stands on the bar of the selected point, pixels of the window. */
export function bendPlace(kappa?: number): Vec | null {
  const { bar } = scene();
  if (!bar) return null;
  const box = document.querySelector("#drawing")!.getBoundingClientRect(), [x, y] = onBar(bar, kappa ?? bar.kappa);
  return [box.left + x, box.top + y];
}

type Grip = { kind: "point"; index: number; off: Vec } | { kind: "tangent"; index: number } | { kind: "bend"; index: number; bar: Bar } | { kind: "view" };

export function Drawing() {
  const ref = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const canvas = ref.current!;
    showAll();
    let frame = 0;
    const draw = () => {
      cancelAnimationFrame(frame);
      frame = requestAnimationFrame(() => paint(canvas, scene()));
    };
    const stop = effect(() => {
      scene();
      void theme.value;
      draw();
    });
    let [width, height] = [canvas.clientWidth, canvas.clientHeight];
    const resized = new ResizeObserver(() => {
      const by = width > 0 ? canvas.clientWidth / width : 1, { scale, x, y } = camera.value;
      // what was in the middle stays there; another height alone moves nothing
      if (by !== 1 && by > 0) camera.value = { scale: scale * by, x: x * by, y: canvas.clientHeight / 2 + (y - height / 2) * by };
      [width, height] = [canvas.clientWidth, canvas.clientHeight];
      draw();
    });
    resized.observe(canvas);
    const wheel = (e: WheelEvent) => {
      e.preventDefault();
      camera.value = zoomed(camera.value, place(canvas, e), Math.exp(-0.0015 * e.deltaY));
    };
    canvas.addEventListener("wheel", wheel, { passive: false });
    return () => {
      stop();
      resized.disconnect();
      canvas.removeEventListener("wheel", wheel);
    };
  }, []);

  const fingers = useRef(new Map<number, Vec>());
  const grip = useRef<Grip | null>(null), last = useRef<Vec>([0, 0]);
  const down = (e: PointerEvent) => {
    const canvas = ref.current!, at = place(canvas, e);
    canvas.focus();
    canvas.setPointerCapture(e.pointerId);
    fingers.current.set(e.pointerId, at);
    if (fingers.current.size === 2) { // a pinch, whatever the first finger had taken
      if (grip.current && grip.current.kind !== "view") abandonDrag();
      grip.current = held.value = null;
      return;
    }
    if (scaling.value && scaling.value.length < 2) {
      scaling.value = [...scaling.value, fromScreen(camera.value, at)];
      grip.current = null;
      return;
    }
    grip.current = gripAt(at, handOf(e));
    held.value = grip.current.kind === "bend" ? grip.current.bar : null;
    last.current = at;
    if (grip.current.kind === "point") select(grip.current.index);
  };
  const move = (e: PointerEvent) => {
    const at = place(ref.current!, e), held = grip.current;
    const before = fingers.current.get(e.pointerId), other = [...fingers.current].find(([id]) => id !== e.pointerId)?.[1];
    if (before) fingers.current.set(e.pointerId, at);
    if (before && other) {
      const wide = (p: Vec) => Math.max(1, Math.hypot(p[0] - other[0], p[1] - other[1]));
      camera.value = panned(zoomed(camera.value, other, wide(at) / wide(before)), [0.5 * (at[0] - before[0]), 0.5 * (at[1] - before[1])]);
      return;
    }
    if (!held) {
      hover(at);
      return;
    }
    if (held.kind === "point" && !isDragged.value && Math.hypot(at[0] - last.current[0], at[1] - last.current[1]) < SLACK[handOf(e)]) return;
    if (held.kind === "view") camera.value = panned(camera.value, [at[0] - last.current[0], at[1] - last.current[1]]);
    if (held.kind === "point") movePoint(held.index, snapped(fromScreen(camera.value, [at[0] + held.off[0], at[1] + held.off[1]])));
    if (held.kind === "bend") bend(held.index, held.bar, at);
    if (held.kind === "tangent") turn(held.index, at);
    last.current = at;
  };
  const up = (e: PointerEvent) => {
    fingers.current.delete(e.pointerId);
    if (grip.current && grip.current.kind !== "view") drop();
    grip.current = null;
    held.value = null;
  };
  const twice = (e: MouseEvent) => {
    const at = place(ref.current!, e);
    if (gripAt(at).kind === "view") addAt(at);
  };
  return (
    <canvas id="drawing" ref={ref} tabIndex={0} role="application" aria-label={words().title}
      onPointerDown={down} onPointerMove={move} onPointerUp={up}
      onPointerCancel={(e) => { fingers.current.delete(e.pointerId); grip.current = null; held.value = null; abandonDrag(); }}
      onPointerLeave={() => { hovered.value = pointed.value = null; }} onDblClick={twice} onKeyDown={key} />
  );
}

function place(canvas: HTMLCanvasElement, e: MouseEvent): Vec {
  const box = canvas.getBoundingClientRect();
  return [e.clientX - box.left, e.clientY - box.top];
}

function scene() {
  const at = selected.value, found = region.value, answer = fitted.value?.answer;
  const points = at === null || !found ? [] : found.points.filter((p) => p.index === at);
  const curve = drawn.value?.curve ?? null;
  return {
    bar: held.value ? { ...held.value, kappa: kappaAt(doc.value, at!, curve) ?? held.value.kappa }
      : at === null ? null : barOf({ doc: doc.value, camera: camera.value, curve, region: points[0] ?? null }, at),
    doc: doc.value, camera: camera.value, curve: drawn.value?.curve ?? null,
    report: drawn.value?.report, grey: !answer?.curve, error: current.value ? answer?.error ?? null : null,
    selected: at, hovered: hovered.value, shown: shown.value, combHeight: combHeight.value, combEvery: combEvery.value,
    adjacent: pointed.value === null || pointed.value >= doc.value.points.length ? null
      : adjacentOf(doc.value, drawn.value?.curve?.closed ?? false, pointed.value),
    region: points[0] ?? null, stale: found?.of !== doc.value, units: doc.value.units,
    noise: typeof doc.value.options.noise === "number" ? doc.value.options.noise : 0,
    picture: picture.value, scaling: scaling.value, kept: kept.value,
    shadesRegion: shadesRegion.value && !promisesNothing(drawn.value?.report?.carrier),
  };
}

function gripAt(at: Vec, hand: Hand = "mouse"): Grip {
  const s = scene();
  let best = REACH[hand], found: Grip = { kind: "view" };
  const offer = (p: Vec | null, grip: Grip) => {
    const away = p ? Math.hypot(p[0] - at[0], p[1] - at[1]) : Infinity;
    if (away < best) [best, found] = [away, grip];
  };
  s.doc.points.forEach((p, index) => {
    const on = toScreen(s.camera, p);
    offer(on, { kind: "point", index, off: [on[0] - at[0], on[1] - at[1]] });
  });
  if (s.selected !== null) {
    offer(tangentTip(s, s.selected), { kind: "tangent", index: s.selected });
    if (s.bar) offer(onBar(s.bar, s.bar.kappa), { kind: "bend", index: s.selected, bar: s.bar });
  }
  return found;
}

function turn(index: number, at: Vec): void {
  const p = doc.value.points[index];
  if (!p) return;
  const [x, y] = toScreen(camera.value, p);
  const heading = Math.round((Math.atan2(y - at[1], at[0] - x) * 180) / Math.PI * 10) / 10;
  drag(withGiven(doc.value, index, { ...doc.value.given[index], heading }));
}

function bend(index: number, bar: Bar, at: Vec): void {
  drag(withGiven(doc.value, index, { ...doc.value.given[index], radius: radiusOnBar(bar, at) }));
}

/** On a tenth of the grid, where that is asked for. */
function snapped(p: Vec): Vec {
  if (!snaps.value) return p;
  const step = gridStep(camera.value, GRID) / 10, places = Math.max(0, 1 - Math.floor(Math.log10(step)));
  const rounded = (v: number) => Number((Math.round(v / step) * step).toFixed(Math.min(100, places)));
  return [rounded(p[0]), rounded(p[1])];
}

/** Between the two neighbours that it lies nearest to; beyond an end, at that end. */
function addAt(at: Vec): void {
  const points = doc.value.points, screen = points.map((p) => toScreen(camera.value, p));
  let best = Infinity, index = points.length;
  for (let i = 0; i + 1 < screen.length; ++i) {
    const a = screen[i]!, b = screen[i + 1]!, dx = b[0] - a[0], dy = b[1] - a[1];
    const t = ((at[0] - a[0]) * dx + (at[1] - a[1]) * dy) / (dx * dx + dy * dy || 1);
    const within = Math.max(0, Math.min(1, t)), d = Math.hypot(a[0] + within * dx - at[0], a[1] + within * dy - at[1]);
    if (d >= best) continue;
    best = d;
    index = t < 0 && i === 0 ? 0 : t > 1 && i + 2 === screen.length ? points.length : i + 1;
  }
  insertPoint(index, fromScreen(camera.value, at));
}

/** Half-way to the next point; behind the last one as far again. */
function addBehind(index: number): void {
  const points = doc.value.points, p = points[index], next = points[index + 1], before = points[index - 1];
  if (!p) { // the first one stands in the middle
    const canvas = document.querySelector<HTMLCanvasElement>("#drawing")!;
    return insertPoint(0, snapped(fromScreen(camera.value, [canvas.clientWidth / 2, canvas.clientHeight / 2])));
  }
  if (!next && !before) return insertPoint(1, snapped([p[0] + gridStep(camera.value, GRID), p[1]]));
  const [q, share] = next ? [next, 0.5] : [before!, -0.5];
  insertPoint(index + 1, snapped([p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])]));
}

function hover(at: Vec): void {
  const over = gripAt(at);
  pointed.value = over.kind === "point" ? over.index : null;
  const curve = drawn.value?.curve;
  if (!curve) return;
  const [x, y] = fromScreen(camera.value, at);
  let best = 14 / camera.value.scale, found: number | null = null;
  for (let i = 0; i < curve.t.length; ++i) {
    const d = Math.hypot(curve.xy[2 * i]! - x, curve.xy[2 * i + 1]! - y);
    if (d < best) [best, found] = [d, i];
  }
  hovered.value = found;
}

const ARROWS: Record<string, Vec> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

function key(e: KeyboardEvent): void {
  const n = doc.value.points.length, at = selected.value;
  const arrow = ARROWS[e.key];
  if (e.key === "Tab" && !(at === null && e.shiftKey) && !(at === n - 1 && !e.shiftKey) && !(at === 0 && e.shiftKey)) {
    select(at === null ? 0 : at + (e.shiftKey ? -1 : 1));
    e.preventDefault();
  } else if (e.key === "Escape") {
    select(null);
  } else if ((e.key === "Delete" || e.key === "Backspace") && at !== null) {
    removePoint(at);
  } else if (arrow && at !== null) {
    const step = (e.shiftKey ? 10 : 1) / camera.value.scale, p = doc.value.points[at]!;
    movePoint(at, [p[0] + arrow[0] * step, p[1] + arrow[1] * step]);
    drop();
    e.preventDefault();
  } else if (arrow) {
    camera.value = panned(camera.value, [-40 * arrow[0], 40 * arrow[1]]);
    e.preventDefault();
  } else if (e.key === "+" || e.key === "-") {
    const canvas = e.currentTarget as HTMLCanvasElement;
    camera.value = zoomed(camera.value, [canvas.clientWidth / 2, canvas.clientHeight / 2], e.key === "+" ? 1.25 : 0.8);
  } else if (e.key === "0") {
    showAll();
  } else if ((e.key === "n" || e.key === "Insert") && !e.ctrlKey && !e.metaKey) {
    addBehind(at ?? n - 1);
  } else if (e.key === "a" && at !== null && !e.ctrlKey && !e.metaKey) {
    pointed.value = pointed.value === at ? null : at;
  } else if (e.key === "c" && at !== null && !e.ctrlKey && !e.metaKey) {
    const { corner, ...rest } = doc.value.given[at] ?? {};
    change(withGiven(doc.value, at, corner ? rest : { ...rest, corner: true }));
  }
}
