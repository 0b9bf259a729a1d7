// SPDX-License-Identifier: Apache-2.0
// What the page knows: the document with its history, what is selected, and the newest answers.

import { batch, computed, signal } from "@preact/signals";
import {
  documentIn, documentOf, jobOptions, SERIES10, withGiven, withInserted, withOptions, withoutPoint, withPoint,
  type Document, type Given, type Options, type Vec,
} from "./document/document";
import { begun, did, redone, undone } from "./document/history";
import {
  CANCELLED, type Answer, type Engine, type ExportAnswer, type FitAnswer, type RegionPoint,
  type SeriesReport,
} from "./engine/engine";

export type Shown = "curvature" | "slope" | "radius";

const history = signal(begun<Document>(SERIES10));
/** While something is dragged: what it would become. */
const draft = signal<Document | null>(null);
export const doc = computed(() => draft.value ?? history.value.now);
export const canUndo = computed(() => history.value.past.length > 0);
export const canRedo = computed(() => history.value.future.length > 0);

export const selected = signal<number | null>(null);
export const shown = signal<Shown>("curvature");
export const combHeight = signal(1);
/** Whether the region of all monotone curves is shaded, and points move in steps of the grid. */
export const shadesRegion = signal(false), snaps = signal(false);
/** Sample under the cursor, in the drawing or in the plot. */
export const hovered = signal<number | null>(null);

/** The newest answer, and the document that it is about. */
export const fitted = signal<{ readonly of: Document; readonly answer: FitAnswer } | null>(null);
/** The last answer with a curve. */
export const drawn = signal<FitAnswer | null>(null);
export const region = signal<{ readonly of: Document; readonly points: readonly RegionPoint[] } | null>(null);
export const unreachable = signal<string | null>(null);
export const message = signal<string | null>(null);
/** Whether what is drawn is of the document as it is. */
export const current = computed(() => fitted.value !== null && fitted.value.of === doc.value);

let engine: Engine;

export function useEngine(one: Engine): void {
  engine = one;
}
export function theEngine(): Engine {
  return engine;
}

// ---- what the user does ---------------------------------------------------------------------

export function change(next: Document): void {
  batch(() => {
    draft.value = null;
    history.value = did(history.value, next);
  });
  compute();
}

export function drag(next: Document): void {
  draft.value = next;
  compute();
}

export function drop(): void {
  if (draft.value) change({ ...draft.value }); // another object: the contour file comes with its answer
}

export function abandonDrag(): void {
  draft.value = null;
  compute();
}

export function undo(): void {
  batch(() => {
    draft.value = null;
    history.value = undone(history.value);
    keepSelection();
  });
  compute();
}

export function redo(): void {
  batch(() => {
    draft.value = null;
    history.value = redone(history.value);
    keepSelection();
  });
  compute();
}

function keepSelection(): void {
  const at = selected.value;
  if (at !== null && at >= doc.value.points.length) selected.value = null;
}

export function movePoint(index: number, at: Vec): void {
  drag(withPoint(doc.value, index, at));
}
export function setGiven(index: number, given: Given): void {
  change(withGiven(doc.value, index, given));
}
export function setOptions(options: Partial<Options>): void {
  change(withOptions(doc.value, options));
}
export function setUnits(units: string): void {
  change({ ...doc.value, units });
}
export function insertPoint(index: number, at: Vec): void {
  change(withInserted(doc.value, index, at));
  selected.value = index;
}
export function removePoint(index: number): void {
  batch(() => {
    selected.value = null;
    change(withoutPoint(doc.value, index));
  });
}

// ---- what the engine says -------------------------------------------------------------------

const MOST_PLACES = 4000; // drawn of a contour

/** Milliseconds after which work goes on beside a newer piece of its kind; the engine ends it then. */
const PATIENCE = 3000;

/** Does a piece of work for the document as it is: one at a time, and once more when it changed. */
function follower(work: () => Promise<void>): () => void {
  let running: number | null = null, count = 0, again = false, begun = 0, late: ReturnType<typeof setTimeout> | undefined;
  const start = (): void => {
    again = false;
    clearTimeout(late);
    late = undefined;
    begun = performance.now();
    const mine = running = ++count;
    void work().finally(() => {
      if (mine !== running) return; // a newer one took its place
      running = null;
      if (again) start();
    });
  };
  return () => {
    if (running === null) return start();
    again = true;
    late ??= setTimeout(() => { late = undefined; if (again && running !== null) start(); }, Math.max(0, PATIENCE - (performance.now() - begun)));
  };
}

const followContour = follower(form);
const followRegion = follower(formRegion);

/** Asks for the contour of the document as it is, and for what is possible at the selected point. */
export function compute(): void {
  followContour();
  if (selected.value !== null) followRegion();
}

async function form(): Promise<void> {
  const of = doc.value;
  const samples = Math.max(3, Math.min(20, Math.floor(MOST_PLACES / of.points.length)));
  const request = { points: of.points, options: jobOptions(of), samples, file: draft.value === null };
  try {
    const answer = await engine.call<FitAnswer>("fit", request);
    if (answer.error?.code === CANCELLED) return;
    batch(() => {
      unreachable.value = null;
      fitted.value = { of, answer };
      if (answer.curve) drawn.value = answer;
    });
  } catch (error) {
    unreachable.value = String(error);
  }
}

/** What is possible at the selected point, were nothing given there. */
async function formRegion(): Promise<void> {
  const of = doc.value, at = selected.value;
  if (at === null || of.points.length < 3) return;
  const free = withGiven(of, at, {});
  const request = { points: free.points, options: jobOptions(free) };
  try {
    const answer = await engine.call<Answer<{ points: readonly RegionPoint[] }>>("region", request);
    if (selected.value !== at) return;
    if (answer.report) region.value = { of, points: answer.report.points };
    else if (answer.error?.code !== CANCELLED) region.value = null;
  } catch (error) {
    unreachable.value = String(error);
  }
}

export function select(index: number | null): void {
  if (selected.value === index) return;
  selected.value = index;
  region.value = null;
  if (index !== null) followRegion();
}

function givenIn(g: SeriesReport["given"][number]): Given {
  const degrees = (v: number) => (v * 180) / Math.PI;
  const [low, high] = g.kappas ?? [null, null];
  const oneWay = low !== null && low >= 0 || high !== null && high <= 0;
  const end = (k: number | null) => (k === null || k === 0 ? null : 1 / k);
  return {
    ...(g.headings !== undefined ? { heading: [degrees(g.headings[0]), degrees(g.headings[1])] } : {}),
    ...(g.heading !== undefined ? { heading: degrees(g.heading) } : {}),
    ...(g.kappas === undefined ? {} : oneWay && (end(low) !== null || end(high) !== null)
      ? { radius: [end(high), end(low)] } : { kappa: [low, high] }),
    ...(g.kappa !== undefined ? { radius: g.kappa === 0 ? Infinity : 1 / g.kappa } : {}),
    ...(g.corner ? { corner: true } : {}),
  };
}

/** Reads a file of points or a drawing. */
export async function open(name: string, text: string): Promise<void> {
  const saved = documentIn(text);
  if (saved) {
    selected.value = null;
    message.value = null;
    return change({ ...saved, name });
  }
  const answer = await engine.call<Answer<SeriesReport>>("series", { text, name });
  if (!answer.report) {
    message.value = answer.error ? `${answer.error.message} (${answer.error.where}); ${answer.error.advice}` : null;
    return;
  }
  const report = answer.report;
  let next: Document = { ...documentOf(name, report.points), units: report.units };
  for (const g of report.given) {
    next = withGiven(next, g.point, givenIn(g));
  }
  selected.value = null;
  message.value = report.warnings.length > 0 ? report.warnings.join("; ") : null;
  change(next);
}

/** The files of the contour that is drawn, in a format. */
export async function exported(format: string): Promise<ExportAnswer> {
  const contour = fitted.value?.answer.contour;
  if (contour === undefined) return { error: fitted.value?.answer.error ?? null };
  return engine.call<ExportAnswer>("export", { contour, format, name: doc.value.name });
}

/** The tables and drawings of the region of the points as they are. */
export async function worksheet(format: string): Promise<ExportAnswer> {
  const { points, units, name } = doc.value;
  const text = [`x_${units},y_${units}`, ...points.map((p) => p.join(",")), ""].join("\n");
  const request = { text, name, options: jobOptions(doc.value), format };
  return engine.call<ExportAnswer>("worksheet", request);
}

/** Every how manyth place has a tooth of the comb. */
export const combEvery = signal(1);
/** Point under the cursor, whose neighbouring circles are drawn. */
export const pointed = signal<number | null>(null);
