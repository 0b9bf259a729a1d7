// SPDX-License-Identifier: Apache-2.0
// Draws the document and its contour on a canvas.

import type { Document, Vec } from "../document/document";
import type { Curve, EngineError, RegionPoint } from "../engine/engine";
import type { Shown } from "../state";
import { gridStep, toScreen, type Camera } from "./camera";
import { marks, usualSize, values } from "./comb";
import { figure } from "../words/figures";

export const HANDLE = 6;       // pixels: radius of points
export const TANGENT = 64;     // length of the handle of a heading
const COMB_SHARE = 0.13;       // of the smaller side of the canvas

export interface Scene {
  readonly doc: Document;
  readonly camera: Camera;
  readonly curve: Curve | null;
  readonly grey: boolean;
  readonly error: EngineError | null;
  readonly selected: number | null;
  readonly hovered: number | null;
  readonly shown: Shown;
  readonly combHeight: number;
  readonly region: RegionPoint | null;
  readonly units: string;
}

export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
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
  grid(context, scene, width, height);
  if (scene.curve) {
    comb(context, scene, scene.curve, COMB_SHARE * Math.min(width, height));
    contour(context, scene, scene.curve);
    if (!scene.grey) signs(context, scene, scene.curve);
  }
  ranges(context, scene);
  handles(context, scene);
}

function grid(c: CanvasRenderingContext2D, s: Scene, width: number, height: number): void {
  const step = gridStep(s.camera, 80), pixels = step * s.camera.scale;
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

function at(curve: Curve, camera: Camera, i: number): Vec {
  return toScreen(camera, [curve.xy[2 * i]!, curve.xy[2 * i + 1]!]);
}

function comb(c: CanvasRenderingContext2D, s: Scene, curve: Curve, high: number): void {
  const all = values(curve, s.shown), usual = usualSize(all);
  if (!(usual > 0)) return;
  const scale = (s.combHeight * high) / usual, most = 3 * high;
  c.strokeStyle = colour(s.grey ? "grid" : "comb");
  c.lineWidth = 0.8;
  c.beginPath();
  const tips: Vec[] = [];
  for (let i = 0; i < all.length; ++i) {
    const p = at(curve, s.camera, i), heading = curve.heading[i]!;
    const tooth = Math.max(-most, Math.min(most, -scale * all[i]!));
    const tip: Vec = [p[0] - tooth * Math.sin(heading), p[1] - tooth * Math.cos(heading)];
    tips.push(tip);
    c.moveTo(p[0], p[1]);
    c.lineTo(tip[0], tip[1]);
  }
  c.stroke();
  c.lineWidth = 1.2;
  c.beginPath();
  tips.forEach((tip, i) => (i === 0 ? c.moveTo(tip[0], tip[1]) : c.lineTo(tip[0], tip[1])));
  c.stroke();
}

function contour(c: CanvasRenderingContext2D, s: Scene, curve: Curve): void {
  const each = curve.samples;
  c.lineWidth = 2.4;
  c.lineJoin = c.lineCap = "round";
  for (let piece = 0; piece < curve.pieces; ++piece) {
    const first = piece * each, middle = first + (each >> 1);
    c.strokeStyle = s.grey ? colour("faint") : colour(curve.slope[middle]! >= 0 ? "rising" : "falling");
    c.beginPath();
    for (let k = 0; k < each; ++k) {
      const p = at(curve, s.camera, first + k);
      if (k === 0) c.moveTo(p[0], p[1]); else c.lineTo(p[0], p[1]);
    }
    c.stroke();
  }
}

function signs(c: CanvasRenderingContext2D, s: Scene, curve: Curve): void {
  for (const mark of marks(curve)) {
    const [x, y] = at(curve, s.camera, mark.place);
    c.fillStyle = colour(mark.kind === "vertex" ? "vertex" : "inflection");
    c.beginPath();
    if (mark.kind === "vertex") { c.moveTo(x, y - 8); c.lineTo(x + 6, y + 4); c.lineTo(x - 6, y + 4); } else c.rect(x - 4, y - 4, 8, 8);
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
  c.fill();
  c.beginPath();
  c.arc(x, y, TANGENT, -low, -high, true);
  c.stroke();
}

/** Heading at a point, rad: as given, else of the contour. */
export function headingAt(doc: Document, index: number, curve: Curve | null): number | null {
  const given = doc.given[index]?.heading;
  if (typeof given === "number") return (given * Math.PI) / 180;
  const p = doc.points[index];
  if (!p || !curve) return null;
  let best = Infinity, heading: number | null = null;
  for (let i = 0; i < curve.t.length; ++i) {
    const d = Math.hypot(curve.xy[2 * i]! - p[0], curve.xy[2 * i + 1]! - p[1]);
    if (d < best) { best = d; heading = curve.heading[i]!; }
  }
  return heading;
}

export function tangentTip(s: Pick<Scene, "doc" | "camera" | "curve">, index: number): Vec | null {
  const p = s.doc.points[index], heading = headingAt(s.doc, index, s.curve);
  if (!p || heading === null) return null;
  const [x, y] = toScreen(s.camera, p);
  return [x + TANGENT * Math.cos(heading), y - TANGENT * Math.sin(heading)];
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
  const few = s.doc.points.length <= 120;
  c.font = "11px system-ui, sans-serif";
  s.doc.points.forEach((p, i) => {
    const [x, y] = toScreen(s.camera, p), given = s.doc.given[i] ?? {};
    c.fillStyle = colour(blamed.has(i) ? "vertex" : i === s.selected ? "accent" : "paper");
    c.strokeStyle = colour(blamed.has(i) ? "vertex" : i === s.selected ? "accent" : "ink");
    c.lineWidth = 1.6;
    c.beginPath();
    const r = few ? HANDLE : 3;
    if (given.corner) { c.moveTo(x, y - r - 1); c.lineTo(x + r, y + r); c.lineTo(x - r, y + r); c.closePath(); } else if (given.radius !== undefined) c.rect(x - r, y - r, 2 * r, 2 * r);
    else c.arc(x, y, r, 0, 2 * Math.PI);
    c.fill();
    c.stroke();
    if (few) { c.fillStyle = colour("faint"); c.fillText(String(i + 1), x + r + 3, y - r - 2); }
  });
}
