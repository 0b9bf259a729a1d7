// SPDX-License-Identifier: Apache-2.0
// What the user says: points, what is given at them, options. Never changed, only replaced.

export type Vec = readonly [number, number];

/** From one end to the other; null: no end there. */
export type Range = readonly [number | null, number | null];

/** What is given at one point beyond its place. */
export interface Given {
  /** Degrees, counter-clockwise from the x axis; or a range with both ends. */
  readonly heading?: number | Range;
  /** Positive to the left; Infinity is straight; or a range whose ends have one sign. */
  readonly radius?: number | Range;
  /** Range of the curvature, of files alone: what is no range of radii. */
  readonly kappa?: Range;
  readonly corner?: boolean;
}

export const CARRIERS =
  ["spiral", "arcs", "conics", "beziers", "clothoids", "bspline", "cubic", "baseline"] as const;
export type Carrier = (typeof CARRIERS)[number];

export type Prefer = "fair" | "centre" | "least-change" | "least-curvature";
export const PREFER: readonly Prefer[] = ["fair", "centre", "least-change", "least-curvature"];

export type Closing = "auto" | "closed" | "open";

export interface Options {
  readonly carrier: Carrier;
  readonly continuity: "G2" | "G3";
  readonly prefer: Prefer;
  readonly noise: number | "rounding" | null;
  readonly tolerance: number | null;
  readonly closing: Closing;
  readonly convex: boolean;
  readonly primitives: boolean;
  readonly findCorners: boolean;
}

/** The file that a document was opened from: what it holds beside points is kept while they stay as they are. */
export interface Source {
  readonly text: string;
  readonly name: string;
  readonly units: string;
  /** Whether it holds more than points and what is given at them: pieces as drawn, tolerances. */
  readonly holds: boolean;
  /** Which of its curves, from 1; left out: the one that the program takes. */
  readonly curve?: number;
}

export interface Document {
  readonly name: string;
  readonly units: string;
  readonly points: readonly Vec[];
  /** One entry per point. */
  readonly given: readonly Given[];
  readonly options: Options;
  /** Lines, arcs, clothoids and tolerances of this file count; none: the points alone do. */
  readonly source?: Source;
}

export const USUAL: Options = {
  carrier: "spiral", continuity: "G3", prefer: "fair", noise: null, tolerance: null, closing: "auto",
  convex: false, primitives: false, findCorners: true,
};

const JOB = "obvid-job";

export function documentOf(name: string, points: readonly Vec[]): Document {
  return { name, units: "mm", points, given: points.map(() => ({})), options: USUAL };
}

/** The first reference series of the papers. */
export const SERIES10: Document = documentOf("series10", [
  [0, 0], [0.21, -5.28], [-5.11, -10.13], [-20.48, -7.65], [-28.68, 16.23],
  [-13.87, 40.95], [17.95, 55.28], [54.24, 53.04], [100.94, 36.19], [230.38, -50.82],
]);

/** What is left when points or what is given at them change. */
function ofPoints(doc: Document): Document {
  const { source: _gone, ...rest } = doc;
  return rest;
}

export function withPoint(doc: Document, index: number, at: Vec): Document {
  return { ...ofPoints(doc), points: doc.points.map((p, i) => (i === index ? at : p)) };
}

export function withGiven(doc: Document, index: number, given: Given): Document {
  return { ...ofPoints(doc), given: doc.given.map((g, i) => (i === index ? given : g)) };
}

export function withOptions(doc: Document, options: Partial<Options>): Document {
  return { ...doc, options: { ...doc.options, ...options } };
}

export function withoutPoint(doc: Document, index: number): Document {
  const kept = <T>(all: readonly T[]) => all.filter((_, i) => i !== index);
  return { ...ofPoints(doc), points: kept(doc.points), given: kept(doc.given) };
}

/** A new point before the one at `index`; `index` = number of points: at the end. */
export function withInserted(doc: Document, index: number, at: Vec): Document {
  const points = [...doc.points], given = [...doc.given];
  points.splice(index, 0, at);
  given.splice(index, 0, {});
  return { ...ofPoints(doc), points, given };
}

/** Input and options of a job: the file as it is, or points and what is given at them. */
export function jobOf(doc: Document, without: readonly string[] = []): { text?: string; name?: string; points?: readonly Vec[]; options: Record<string, unknown> } {
  const { source } = doc, options = jobOptions(source ? { ...doc, given: [] } : doc);
  if (source?.curve !== undefined) options["curve"] = source.curve;
  if (source?.units === doc.units) delete options["units"]; // the file says it
  for (const name of without) delete options[name];
  return source ? { text: source.text, name: source.name, options } : { points: doc.points, options };
}

/** Options of the job, with the names of the command line. */
export function jobOptions(doc: Document): Record<string, unknown> {
  const o = doc.options, out: Record<string, unknown> = { units: doc.units };
  if (o.carrier !== "spiral") out["carrier"] = o.carrier;
  else if (o.continuity === "G2") out["continuity"] = "G2";
  if (o.prefer !== "fair") out["prefer"] = o.prefer;
  if (o.noise !== null) out["noise"] = o.noise;
  if (o.tolerance !== null) out["tolerance"] = o.tolerance;
  if (o.closing === "closed") out["closed"] = true;
  if (o.closing === "open") out["open"] = true;
  if (o.convex) out["convex"] = true;
  if (o.primitives) out["primitives"] = true;
  if (!o.findCorners) out["no-corners"] = true;
  const headings: Record<string, unknown> = {}, radii: Record<string, unknown> = {}, bends: Record<string, unknown> = {};
  const corners: number[] = [];
  doc.given.forEach((g, i) => {
    if (g.heading !== undefined) headings[i + 1] = valueOf(g.heading);
    if (g.radius !== undefined) radii[i + 1] = valueOf(g.radius);
    if (g.kappa !== undefined) bends[i + 1] = textOf(g.kappa);
    if (g.corner) corners.push(i + 1);
  });
  if (Object.keys(headings).length > 0) out["heading-at"] = headings;
  if (Object.keys(radii).length > 0) out["radius-at"] = radii;
  if (Object.keys(bends).length > 0) out["kappa-at"] = bends;
  if (corners.length > 0) out["corner-at"] = corners;
  return out;
}

/** The document as a file: points and options as the C interface takes them. */
export function jobText(doc: Document): string {
  const { name, units, points, source } = doc;
  return JSON.stringify({ format: JOB, version: 1, name, units, points, options: jobOptions(doc), source }, null, 1) + "\n";
}

/** What jobText wrote; null: it is another text. */
export function documentIn(text: string): Document | null {
  let job: { format?: unknown; name?: unknown; points?: unknown; options?: unknown; source?: Partial<Record<keyof Source, unknown>> | null };
  try {
    job = JSON.parse(text);
  } catch {
    return null;
  }
  if (job === null || typeof job !== "object" || job.format !== JOB || !Array.isArray(job.points)) return null;
  const isPoint = (p: unknown): p is Vec => Array.isArray(p) && p.length === 2 && p.every((v) => Number.isFinite(v));
  if (!job.points.every(isPoint)) return null;
  const o = (job.options ?? {}) as Record<string, unknown>, plain = documentOf(String(job.name ?? "points"), job.points);
  const at = (name: string, i: number) => (o[name] as Record<string, unknown> | undefined)?.[String(i + 1)];
  const value = (name: string, i: number) => { const v = at(name, i); return v === undefined ? undefined : givenOf(String(v)); };
  const one = <T extends string>(name: string, of: readonly T[], otherwise: T): T => of.find((v) => v === o[name]) ?? otherwise;
  const number = (name: string) => (typeof o[name] === "number" ? (o[name] as number) : null);
  const given = plain.points.map((_, i): Given => {
    const heading = value("heading-at", i), radius = value("radius-at", i), kappa = value("kappa-at", i);
    return {
      ...(heading === undefined ? {} : { heading }), ...(radius === undefined ? {} : { radius }),
      ...(kappa === undefined || typeof kappa === "number" ? {} : { kappa }),
      ...(Array.isArray(o["corner-at"]) && o["corner-at"].includes(i + 1) ? { corner: true } : {}),
    };
  });
  const options: Options = {
    carrier: one("carrier", CARRIERS, "spiral"), continuity: one("continuity", ["G2", "G3"], "G3"), prefer: one("prefer", PREFER, "fair"),
    noise: o["noise"] === "rounding" ? "rounding" : number("noise"), tolerance: number("tolerance"),
    closing: o["closed"] === true ? "closed" : o["open"] === true ? "open" : "auto", convex: o["convex"] === true,
    primitives: o["primitives"] === true, findCorners: o["no-corners"] !== true,
  };
  const units = typeof o["units"] === "string" ? o["units"] : "mm", from = job.source;
  const source = typeof from?.text === "string" && typeof from.name === "string" && typeof from.units === "string" && typeof from.holds === "boolean"
    ? { source: { text: from.text, name: from.name, units: from.units, holds: from.holds, ...(typeof from.curve === "number" ? { curve: from.curve } : {}) } } : {};
  return { ...plain, units, given, options, ...source };
}

/** As the options have it: a number, "inf", "40..45", "20..", "..30". */
export function textOf(given: number | Range): string {
  if (typeof given === "number") return given === Infinity ? "inf" : String(given);
  return `${given[0] ?? ""}..${given[1] ?? ""}`;
}

function valueOf(given: number | Range): number | string {
  return typeof given === "number" && Number.isFinite(given) ? given : textOf(given);
}

/** What textOf makes, and numbers with a decimal comma; undefined: it is none of these. */
export function givenOf(text: string): number | Range | undefined {
  const number = (part: string): number | undefined => {
    const value = part === "inf" ? Infinity : Number(part.replace(",", "."));
    return part === "" || Number.isNaN(value) ? undefined : value;
  };
  const ends = text.trim().split(/\s*(?:\.\.\.?|…)\s*/);
  if (ends.length === 1) return number(ends[0]!);
  const low = number(ends[0]!), high = number(ends[1]!);
  const wrong = ends.length > 2 || (low === undefined && ends[0] !== "") || (high === undefined && ends[1] !== "");
  return wrong || (low === undefined && high === undefined) ? undefined : [low ?? null, high ?? null];
}

/** The same series for the command line: a file of points, and the options beside it. */
export function pointsCsv(doc: Document): string {
  const columns = ["x_" + doc.units, "y_" + doc.units];
  const cells: ((g: Given) => string | number)[] = [];
  const add = (name: string, cell: (g: Given) => string | number) => {
    if (!doc.given.some((g) => cell(g) !== "")) return;
    columns.push(name);
    cells.push(cell);
  };
  for (const [what, unit] of [["heading", "_deg"], ["radius", ""], ["kappa", ""]] as const) {
    const value = (g: Given): number | Range | undefined => g[what];
    add(what + unit, (g) => { const v = value(g); return typeof v === "number" ? textOf(v) : ""; });
    for (const [end, k] of [["_min", 0], ["_max", 1]] as const) {
      add(what + end, (g) => { const v = value(g); return v === undefined || typeof v === "number" ? "" : v[k] ?? ""; });
    }
  }
  if (doc.given.some((g) => g.corner)) {
    columns.push("corner");
    cells.push((g) => (g.corner ? 1 : 0));
  }
  const rows = doc.points.map((p, i) => [p[0], p[1], ...cells.map((cell) => cell(doc.given[i] ?? {}))].join(","));
  return [columns.join(","), ...rows, ""].join("\n");
}

export function sizeOf(points: readonly Vec[]): number {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [x, y] of points) {
    x0 = Math.min(x0, x); x1 = Math.max(x1, x);
    y0 = Math.min(y0, y); y1 = Math.max(y1, y);
  }
  return points.length > 0 ? Math.hypot(x1 - x0, y1 - y0) || 1 : 1;
}
