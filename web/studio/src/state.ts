// SPDX-License-Identifier: Apache-2.0
// What the page knows: the document with its history, what is selected, and the newest answers.

import { batch, computed, signal } from "@preact/signals";
import {
  documentIn, documentOf, jobOf, SERIES10, withGiven, withInserted, withOptions, withoutPoint, withPoint,
  type Document, type Given, type Options, type Vec,
} from "./document/document";
import { begun, did, redone, undone } from "./document/history";
import {
  CANCELLED, type Answer, type Engine, type EngineError, type ExportAnswer, type FitAnswer, type Kind, type RegionPoint,
  type Request, type SeriesReport,
} from "./engine/engine";
import { words } from "./words/words";

export type Shown = "curvature" | "slope" | "radius";

const history = signal(begun<Document>(SERIES10));
/** While something is dragged: what it would become. */
const draft = signal<Document | null>(null);
export const doc = computed(() => draft.value ?? history.value.now);
/** Whether something is being dragged. */
export const isDragged = computed(() => draft.value !== null);
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

function replace(next: Document): void {
  batch(() => {
    draft.value = null;
    history.value = did(history.value, next);
  });
  compute();
}

export function change(next: Document): void {
  const left = history.value.now.source;
  if (left?.holds && !next.source) message.value = words().asPoints.replace("{file}", left.name);
  replace(next);
}

/** Another document without points, the unit as it was. */
export function empty(next: Document): void {
  selected.value = drawn.value = null;
  message.value = null;
  replace({ ...next, units: doc.value.units });
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
  const request = { ...jobOf(of), samples, file: draft.value === null };
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
  try {
    const answer = await engine.call<Answer<{ points: readonly RegionPoint[] }>>("region", jobOf(free));
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

/** What the engine refuses, as the page says it. */
export function told(error: EngineError): string {
  const where = error.where ? ` (${error.where})` : "", advice = error.advice ? `; ${error.advice}` : "";
  return error.message + where + advice;
}

/** An answer; where there is none, the page says why. */
export async function asked<T>(kind: Kind, request: Request): Promise<Answer<T> | null> {
  try {
    const answer = await engine.call<Answer<T>>(kind, request);
    if (answer.error) message.value = told(answer.error);
    return answer;
  } catch (error) {
    message.value = String(error);
    return null;
  }
}

/** Reads a file of points or a drawing; of a drawing, one of its curves. */
export async function open(name: string, text: string, curve?: number): Promise<void> {
  const saved = documentIn(text);
  if (saved) {
    selected.value = null;
    message.value = null;
    return replace({ ...saved, name });
  }
  const chosen = curve === undefined ? {} : { curve };
  const report = (await asked<SeriesReport>("series", { text, name, options: chosen }))?.report;
  if (!report) return compute(); // what was there stays
  let next: Document = { ...documentOf(name, report.points), units: report.units };
  for (const g of report.given) {
    next = withGiven(next, g.point, givenIn(g));
  }
  selected.value = null;
  const notes = report.warnings.filter((warning) => !/^curve \d+ of \d+ was taken/.test(warning));
  message.value = notes.length > 0 ? notes.join("; ") : null;
  const holds = report.pieces_as_drawn > 0 || report.given.some((g) => g.tolerance !== undefined);
  replace({ ...next, source: { text, name, units: report.units, holds, ...chosen } });
}

interface CurveList {
  readonly curves?: readonly { readonly label: string }[];
  readonly series?: readonly { readonly label: string }[];
}
/** Names of the curves of a drawing that holds several. */
export const curves = signal<{ readonly of: string; readonly names: readonly string[] } | null>(null);

/** Asks what else the file holds that the document was opened from. */
export async function listCurves(text: string, name: string): Promise<void> {
  const report = (await engine.call<Answer<CurveList>>("analyse", { text, name }).catch(() => null))?.report;
  const names = [...(report?.curves ?? []), ...(report?.series ?? [])].map((one) => one.label);
  curves.value = names.length > 1 ? { of: text, names } : null;
}

/** The files of the contour that is drawn, in a format. */
export async function exported(format: string): Promise<ExportAnswer> {
  const contour = fitted.value?.answer.contour;
  if (contour === undefined) return { error: fitted.value?.answer.error ?? null };
  return engine.call<ExportAnswer>("export", { contour, format, name: doc.value.name });
}

/** The tables and drawings of the region of the points as they are. */
export async function worksheet(format: string): Promise<ExportAnswer> {
  const { points, units, name } = doc.value, job = jobOf(doc.value);
  const text = job.text ?? [`x_${units},y_${units}`, ...points.map((p) => p.join(",")), ""].join("\n");
  return engine.call<ExportAnswer>("worksheet", { text, name, options: job.options, format });
}

/** Every how manyth place has a tooth of the comb. */
export const combEvery = signal(1);
/** Point under the cursor, whose neighbouring circles are drawn. */
export const pointed = signal<number | null>(null);
