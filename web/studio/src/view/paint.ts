// SPDX-License-Identifier: Apache-2.0
// Draws the document and its contour on a canvas.

import type { Document, Vec } from "../document/document";
import type { Curve, EngineError, FitReport, RegionPoint } from "../engine/engine";
import type { Shown } from "../state";
import type { Adjacent } from "./adjacent";
import { gridStep, toScreen, type Camera } from "./camera";
import { marks, parts, usualSize, values, ways } from "./comb";
import { magnified } from "./region";
import type { Picture } from "./underlay";
import { figure } from "../words/figures";

export const HANDLE = 6;       // pixels: radius of points
export const GRID = 80;        // least distance of its lines
export const TANGENT = 64;     // length of the handle of a heading
const BACK = 34;               // from the point to the bar of its curvature
const LARGEST_BEND = 60;       // height of the largest of what is and what is possible on that bar
const MOST_BEND = 90;
const MOST_NUMBERED = 120;     // points with a handle and a number each
const MARK = HANDLE + 2;       // from the contour to the mark of a vertex or an inflection
const REGION_WIDTH = 26;       // of the widest region, as it is drawn
const COMB_SHARE = 0.13;       // of the smaller side of the canvas
const LEAST_GAP = 3;           // pixels between teeth

export interface Scene {
  readonly doc: Document;
  readonly camera: Camera;
  readonly curve: Curve | null;
  /** What was proved of it. */
  readonly report: FitReport | undefined;
  readonly grey: boolean;
  readonly error: EngineError | null;
  readonly selected: number | null;
  readonly hovered: number | null;
  readonly shown: Shown;
  readonly combHeight: number;
  /** Every how manyth place has a tooth. */
  readonly combEvery: number;
  /** Of the point under the cursor. */
  readonly adjacent: Adjacent | null;
  readonly region: RegionPoint | null;
  /** Whether the region is of the document as it was a moment ago. */
  readonly stale: boolean;
  readonly units: string;
  /** How far points may move, in units; 0: they are met. */
  readonly noise: number;
  readonly shadesRegion: boolean;
  /** Of the selected point. */
  readonly bar: Bar | null;
  readonly picture: Picture | null;
  /** Places clicked to tell its scale. */
  readonly scaling: readonly Vec[] | null;
  /** An earlier contour. */
  readonly kept: Curve | null;
}

/** Distances from the contour to the boundaries, and by how much they are drawn larger. */
export function regionOf(curve: Curve, camera: Camera) {
  return magnified(curve, REGION_WIDTH / camera.scale);
}

let palette = new Map<string, string>(), paletteOf: string | undefined;

/** A colour of the style sheet; asked for once in each theme. */
export function colour(name: string): string {
  const now = document.documentElement.dataset["theme"];
  if (now !== paletteOf) [palette, paletteOf] = [new Map(), now];
  let value = palette.get(name);
  if (value === undefined) {
    value = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
    palette.set(name, value);
  }
  return value;
}

export function paint(canvas: HTMLCanvasElement, scene: Scene): void {
  const context = canvas.getContext("2d");
  if (!context) return;
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  picture(context, scene);
  grid(context, scene, width, height);
  if (scene.kept) line(context, scene, scene.kept, () => colour("faint"), 1.4);
  if (scene.curve && scene.shadesRegion && !scene.grey) shade(context, scene, scene.curve);
  discs(context, scene);
  dots(context, scene);
  if (scene.curve) {
    comb(context, scene, scene.curve, COMB_SHARE * Math.min(width, height));
    contour(context, scene, scene.curve);
    if (!scene.grey) signs(context, scene, scene.curve);
  }
  if (scene.adjacent) neighbours(context, scene, scene.adjacent);
  ranges(context, scene);
  bends(context, scene);
  handles(context, scene);
}

function grid(c: CanvasRenderingContext2D, s: Scene, width: number, height: number): void {
  const step = gridStep(s.camera, GRID), pixels = step * s.camera.scale;
  const first = (offset: number) => ((offset % pixels) + pixels) % pixels;
  c.strokeStyle = colour("grid");
  c.lineWidth = 1;
  c.beginPath();
  for (let x = first(s.camera.x); x < width; x += pixels) { c.moveTo(x, 0); c.lineTo(x, height); }
  for (let y = first(s.camera.y); y < height; y += pixels) { c.moveTo(0, y); c.lineTo(width, y); }
  c.stroke();
  c.strokeStyle = c.fillStyle = colour("faint");
  c.font = "12px system-ui, sans-serif";
  c.lineWidth = 1.5;
  c.beginPath();
  c.moveTo(16, height - 20); c.lineTo(16, height - 14); c.lineTo(16 + pixels, height - 14); c.lineTo(16 + pixels, height - 20);
  c.stroke();
  c.fillText(`${figure(step, 1)} ${s.units}`, 22, height - 20);
}

function shade(c: CanvasRenderingContext2D, s: Scene, curve: Curve): void {
  c.fillStyle = colour("range");
  c.strokeStyle = colour("accent");
  c.lineWidth = 0.7;
  for (const outline of regionOf(curve, s.camera).outlines) {
    c.beginPath();
    outline.forEach((p, i) => {
      const [x, y] = toScreen(s.camera, p);
      if (i === 0) c.moveTo(x, y); else c.lineTo(x, y);
    });
    c.closePath();
    c.fill();
    c.stroke();
  }
}

/** The circle through a point and its neighbours, dashed, and the limiting arcs beside it. */
function neighbours(c: CanvasRenderingContext2D, s: Scene, { circle, arcs }: Adjacent): void {
  const draw = (points: readonly Vec[]) => {
    c.beginPath();
    points.forEach((p, i) => {
      const [x, y] = toScreen(s.camera, p);
      if (i === 0) c.moveTo(x, y); else c.lineTo(x, y);
    });
    c.stroke();
  };
  c.strokeStyle = colour("faint");
  c.lineWidth = 1;
  c.setLineDash([6, 4]);
  draw(circle);
  c.setLineDash([]);
  c.strokeStyle = colour("accent");
  c.lineWidth = 1.2;
  arcs.forEach(draw);
}

/** How far each point may move. */
function discs(c: CanvasRenderingContext2D, s: Scene): void {
  const radius = s.noise * s.camera.scale;
  if (!(radius >= 1)) return;
  c.fillStyle = colour("range");
  for (const p of s.doc.points) {
    const [x, y] = toScreen(s.camera, p);
    c.beginPath();
    c.arc(x, y, radius, 0, 2 * Math.PI);
    c.fill();
  }
}

function at(curve: Curve, camera: Camera, i: number): Vec {
  return toScreen(camera, [curve.xy[2 * i]!, curve.xy[2 * i + 1]!]);
}

function comb(c: CanvasRenderingContext2D, s: Scene, curve: Curve, high: number): void {
  const all = values(curve, s.shown), usual = usualSize(all);
  if (!(usual > 0)) return;
  const scale = (s.combHeight * high) / usual, most = 3 * high;
  // where places lie closer on the screen than teeth can be told apart, some have none
  const every = s.combEvery * Math.max(1, Math.ceil((LEAST_GAP * all.length) / (curve.length * s.camera.scale)));
  c.strokeStyle = colour(s.grey ? "grid" : "comb");
  c.lineWidth = 0.8;
  c.beginPath();
  const tips: Vec[] = [];
  for (let i = 0; i < all.length; ++i) {
    const p = at(curve, s.camera, i), heading = curve.heading[i]!;
    const tooth = Math.max(-most, Math.min(most, -scale * all[i]!));
    const tip: Vec = [p[0] - tooth * Math.sin(heading), p[1] - tooth * Math.cos(heading)];
    tips.push(tip);
    if (i % every !== 0) continue;
    c.moveTo(p[0], p[1]);
    c.lineTo(tip[0], tip[1]);
  }
  c.stroke();
  c.lineWidth = 1.2;
  c.beginPath();
  tips.forEach((tip, i) => (i === 0 || parts(all, s.shown, i) ? c.moveTo(tip[0], tip[1]) : c.lineTo(tip[0], tip[1])));
  c.stroke();
}

function picture(c: CanvasRenderingContext2D, s: Scene): void {
  if (!s.picture) return;
  const { image, at: corner, unit } = s.picture, [x, y] = toScreen(s.camera, corner), scale = unit * s.camera.scale;
  c.globalAlpha = 0.55;
  c.drawImage(image, x, y, scale * image.width, scale * image.height);
  c.globalAlpha = 1;
  c.strokeStyle = colour("accent");
  c.lineWidth = 2;
  for (const p of s.scaling ?? []) {
    const [px, py] = toScreen(s.camera, p);
    c.beginPath(); c.moveTo(px - 7, py); c.lineTo(px + 7, py); c.moveTo(px, py - 7); c.lineTo(px, py + 7); c.stroke();
  }
}

function contour(c: CanvasRenderingContext2D, s: Scene, curve: Curve): void {
  const way = ways(curve, s.report);
  const tint = (piece: number) => {
    const slope = way[piece] ?? curve.slope[piece * curve.samples + (curve.samples >> 1)]!;
    return slope === 0 ? "level" : slope > 0 ? "rising" : "falling";
  };
  line(c, s, curve, (piece) => colour(s.grey ? "faint" : tint(piece)), 2.4);
}

/** One path for each colour: strokes take time, not places. */
function line(c: CanvasRenderingContext2D, s: Scene, curve: Curve, tint: (piece: number) => string, width: number): void {
  const each = curve.samples, { scale, x, y } = s.camera, xy = curve.xy, paths = new Map<string, Path2D>();
  for (let piece = 0; piece < curve.pieces; ++piece) {
    const first = piece * each, name = tint(piece);
    let path = paths.get(name);
    if (!path) paths.set(name, path = new Path2D());
    path.moveTo(x + scale * xy[2 * first]!, y - scale * xy[2 * first + 1]!);
    for (let i = first + 1; i < first + each; ++i) path.lineTo(x + scale * xy[2 * i]!, y - scale * xy[2 * i + 1]!);
  }
  c.lineWidth = width;
  c.lineJoin = c.lineCap = "round";
  for (const [name, path] of paths) {
    c.strokeStyle = name;
    c.stroke(path);
  }
}

function signs(c: CanvasRenderingContext2D, s: Scene, curve: Curve): void {
  for (const mark of marks(curve, s.report)) {
    // beside the contour, opposite the comb: many stand at points
    const [x, y] = at(curve, s.camera, mark.place), heading = curve.heading[mark.place]!, side = curve.kappa[mark.place]! < 0 ? -1 : 1;
    const n: Vec = [-side * Math.sin(heading), -side * Math.cos(heading)], put = (along: number, out: number): Vec =>
      [x + out * n[0] - along * n[1], y + out * n[1] + along * n[0]];
    c.fillStyle = colour(mark.kind === "vertex" ? "vertex" : "inflection");
    c.beginPath();
    const corners = mark.kind === "vertex" ? [put(0, MARK), put(5, MARK + 10), put(-5, MARK + 10)]
      : [put(4, MARK), put(4, MARK + 8), put(-4, MARK + 8), put(-4, MARK)];
    corners.forEach(([px, py], i) => (i === 0 ? c.moveTo(px, py) : c.lineTo(px, py)));
    c.fill();
  }
  if (s.hovered === null || s.hovered >= curve.t.length) return;
  const [x, y] = at(curve, s.camera, s.hovered);
  c.strokeStyle = colour("accent");
  c.lineWidth = 2;
  c.beginPath();
  c.arc(x, y, 7, 0, 2 * Math.PI);
  c.stroke();
}

/** The headings that are possible at the selected point, as an arc; dashed where they have no end. */
function ranges(c: CanvasRenderingContext2D, s: Scene): void {
  if (s.selected === null || !s.region) return;
  const { heading_low: low, heading_high: high } = s.region;
  const p = s.doc.points[s.selected];
  if (!p || low === null || high === null) return;
  const [x, y] = toScreen(s.camera, p);
  c.strokeStyle = colour("accent");
  c.fillStyle = colour("range");
  c.lineWidth = 2;
  c.beginPath();
  c.moveTo(x, y);
  c.arc(x, y, TANGENT, -low, -high, true);
  c.closePath();
  if (!s.stale) c.fill();
  c.setLineDash(s.stale ? [3, 5] : []);
  c.beginPath();
  c.arc(x, y, TANGENT, -low, -high, true);
  for (const end of [low, high]) { // of a narrow range the arc alone is a dot
    c.moveTo(x + (TANGENT - HANDLE) * Math.cos(end), y - (TANGENT - HANDLE) * Math.sin(end));
    c.lineTo(x + (TANGENT + 2 * HANDLE) * Math.cos(end), y - (TANGENT + 2 * HANDLE) * Math.sin(end));
  }
  c.stroke();
  c.setLineDash([]);
}

/** The sample of the contour nearest to a point. */
function sampleAt(doc: Document, index: number, curve: Curve | null): number | null {
  const p = doc.points[index];
  if (!p || !curve) return null;
  let best = Infinity, found: number | null = null;
  for (let i = 0; i < curve.t.length; ++i) {
    const d = Math.hypot(curve.xy[2 * i]! - p[0], curve.xy[2 * i + 1]! - p[1]);
    if (d < best) [best, found] = [d, i];
  }
  return found;
}

/** Heading at a point, rad: as given, else of the contour. */
export function headingAt(doc: Document, index: number, curve: Curve | null): number | null {
  const given = doc.given[index]?.heading;
  if (typeof given === "number") return (given * Math.PI) / 180;
  const i = sampleAt(doc, index, curve);
  return i === null ? null : curve!.heading[i]!;
}

/** Curvature at a point: as given, else of the contour. */
export function kappaAt(doc: Document, index: number, curve: Curve | null): number | null {
  const given = doc.given[index]?.radius;
  if (typeof given === "number") return 1 / given;
  const i = sampleAt(doc, index, curve);
  return i === null ? null : curve!.kappa[i]!;
}

/** The bar of curvatures behind a point: where 0 stands, the way in which they grow, pixels of one. */
export interface Bar {
  readonly zero: Vec;
  readonly way: Vec;
  readonly scale: number;
  readonly kappa: number;
}

export function barOf(s: Pick<Scene, "doc" | "camera" | "curve" | "region">, index: number): Bar | null {
  const p = s.doc.points[index], heading = headingAt(s.doc, index, s.curve), kappa = kappaAt(s.doc, index, s.curve);
  if (!p || heading === null || kappa === null || !s.curve) return null;
  const sizes = [kappa, s.region?.kappa_low ?? 0, s.region?.kappa_high ?? 0].map(Math.abs);
  const largest = Math.max(...sizes) || usualSize(s.curve.kappa);
  if (!(largest > 0)) return null;
  const [x, y] = toScreen(s.camera, p);
  return {
    zero: [x - BACK * Math.cos(heading), y + BACK * Math.sin(heading)],
    way: [-Math.sin(heading), -Math.cos(heading)],
    scale: LARGEST_BEND / largest,
    kappa,
  };
}

export function onBar(bar: Bar, kappa: number): Vec {
  const along = Math.max(-MOST_BEND, Math.min(MOST_BEND, bar.scale * kappa));
  return [bar.zero[0] + along * bar.way[0], bar.zero[1] + along * bar.way[1]];
}

/** The radius at a place beside the bar: straight near its zero, four figures. */
export function radiusOnBar(bar: Bar, at: Vec): number {
  const along = (at[0] - bar.zero[0]) * bar.way[0] + (at[1] - bar.zero[1]) * bar.way[1];
  return Math.abs(along) < 1.5 ? Infinity : Number((bar.scale / along).toPrecision(4));
}

/** The curvature at the selected point on its bar; thick: what is possible. */
function bends(c: CanvasRenderingContext2D, s: Scene): void {
  if (s.selected === null) return;
  const bar = s.bar;
  if (!bar) return;
  const stroke = (from: number, to: number, width: number) => {
    const a = onBar(bar, from), b = onBar(bar, to);
    c.lineWidth = width;
    c.beginPath(); c.moveTo(a[0], a[1]); c.lineTo(b[0], b[1]); c.stroke();
  };
  c.strokeStyle = colour("faint");
  stroke(-Infinity, Infinity, 1);
  c.strokeStyle = colour("accent");
  if (s.region && !s.stale) stroke(s.region.kappa_low ?? -Infinity, s.region.kappa_high ?? Infinity, 5);
  const [x, y] = onBar(bar, bar.kappa), given = s.doc.given[s.selected]?.radius !== undefined;
  c.fillStyle = colour(given ? "accent" : "paper");
  c.lineWidth = 1.5;
  c.beginPath();
  c.rect(x - HANDLE, y - HANDLE, 2 * HANDLE, 2 * HANDLE);
  c.fill();
  c.stroke();
  c.strokeStyle = colour("faint");
  c.beginPath(); c.moveTo(bar.zero[0] - 4, bar.zero[1]); c.lineTo(bar.zero[0] + 4, bar.zero[1]); c.stroke();
}

export function tangentTip(s: Pick<Scene, "doc" | "camera" | "curve">, index: number): Vec | null {
  const p = s.doc.points[index], heading = headingAt(s.doc, index, s.curve);
  if (!p || heading === null) return null;
  const [x, y] = toScreen(s.camera, p);
  return [x + TANGENT * Math.cos(heading), y - TANGENT * Math.sin(heading)];
}

/** Whether nothing is to be said of a point but its place. */
function isPlain(s: Scene, i: number): boolean {
  return i !== s.selected && !(s.error?.points ?? []).includes(i) && Object.keys(s.doc.given[i] ?? {}).length === 0;
}

/** Many points, below the contour, which they would hide. */
function dots(c: CanvasRenderingContext2D, s: Scene): void {
  if (s.doc.points.length <= MOST_NUMBERED) return;
  const all = new Path2D();
  for (const p of s.doc.points) {
    const [x, y] = toScreen(s.camera, p);
    all.rect(x - 3, y - 3, 6, 6);
  }
  c.fillStyle = colour("comb");
  c.fill(all);
}

function handles(c: CanvasRenderingContext2D, s: Scene): void {
  if (s.selected !== null) {
    const p = s.doc.points[s.selected], tip = tangentTip(s, s.selected);
    if (p && tip) {
      const [x, y] = toScreen(s.camera, p);
      const given = s.doc.given[s.selected]?.heading !== undefined;
      c.strokeStyle = c.fillStyle = colour("accent");
      c.lineWidth = 1.5;
      c.setLineDash(given ? [] : [4, 4]);
      c.beginPath(); c.moveTo(x, y); c.lineTo(tip[0], tip[1]); c.stroke();
      c.setLineDash([]);
      c.beginPath(); c.arc(tip[0], tip[1], HANDLE, 0, 2 * Math.PI);
      if (given) c.fill(); else c.stroke();
    }
  }
  const blamed = new Set(s.error?.points ?? []);
  const few = s.doc.points.length <= MOST_NUMBERED;
  c.font = "11px system-ui, sans-serif";
  const r = few ? HANDLE : 3;
  s.doc.points.forEach((p, i) => {
    const [x, y] = toScreen(s.camera, p), given = s.doc.given[i] ?? {};
    if (!few && isPlain(s, i)) return;
    c.fillStyle = colour(blamed.has(i) ? "vertex" : i === s.selected ? "accent" : "paper");
    c.strokeStyle = colour(blamed.has(i) ? "vertex" : i === s.selected ? "accent" : "ink");
    c.lineWidth = 1.6;
    c.beginPath();
    if (given.heading !== undefined && !given.corner) { // a whisker along the heading that is given
      const range = given.heading, turn = (Math.PI / 180) * (typeof range === "number" ? range : 0.5 * ((range[0] ?? 0) + (range[1] ?? 0)));
      c.moveTo(x - 2.2 * r * Math.cos(turn), y + 2.2 * r * Math.sin(turn));
      c.lineTo(x + 2.2 * r * Math.cos(turn), y - 2.2 * r * Math.sin(turn));
      c.stroke();
      c.beginPath();
    }
    if (given.corner) { c.moveTo(x, y - r - 1); c.lineTo(x + r, y + r); c.lineTo(x - r, y + r); c.closePath(); } else if (given.radius !== undefined) c.rect(x - r, y - r, 2 * r, 2 * r);
    else c.arc(x, y, r, 0, 2 * Math.PI);
    c.fill();
    c.stroke();
    if (few) { c.fillStyle = colour("faint"); c.fillText(String(i + 1), x + r + 3, y - r - 2); }
  });
}
