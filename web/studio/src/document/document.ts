// SPDX-License-Identifier: Apache-2.0
// What the user says: points, what is given at them, options. Never changed, only replaced.

export type Vec = readonly [number, number];

/** What is given at one point beyond its place. */
export interface Given {
  /** Degrees, counter-clockwise from the x axis; or a range of them. */
  readonly heading?: number | readonly [number, number];
  /** Positive to the left; Infinity is straight. */
  readonly radius?: number;
  readonly corner?: boolean;
}

export type Carrier =
  | "spiral" | "arcs" | "conics" | "beziers" | "clothoids" | "bspline" | "cubic" | "baseline";
export const CARRIERS: readonly Carrier[] =
  ["spiral", "arcs", "conics", "beziers", "clothoids", "bspline", "cubic", "baseline"];

export type Closing = "auto" | "closed" | "open";

export interface Options {
  readonly carrier: Carrier;
  readonly continuity: "G2" | "G3";
  readonly noise: number | "rounding" | null;
  readonly tolerance: number | null;
  readonly closing: Closing;
  readonly convex: boolean;
  readonly primitives: boolean;
  readonly findCorners: boolean;
}

export interface Document {
  readonly name: string;
  readonly units: string;
  readonly points: readonly Vec[];
  /** One entry per point. */
  readonly given: readonly Given[];
  readonly options: Options;
}

export const USUAL: Options = {
  carrier: "spiral", continuity: "G3", noise: null, tolerance: null, closing: "auto",
  convex: false, primitives: false, findCorners: true,
};

export function documentOf(name: string, points: readonly Vec[]): Document {
  return { name, units: "mm", points, given: points.map(() => ({})), options: USUAL };
}

/** The first reference series of the papers. */
export const SERIES10: Document = documentOf("series10", [
  [0, 0], [0.21, -5.28], [-5.11, -10.13], [-20.48, -7.65], [-28.68, 16.23],
  [-13.87, 40.95], [17.95, 55.28], [54.24, 53.04], [100.94, 36.19], [230.38, -50.82],
]);

export function withPoint(doc: Document, index: number, at: Vec): Document {
  return { ...doc, points: doc.points.map((p, i) => (i === index ? at : p)) };
}

export function withGiven(doc: Document, index: number, given: Given): Document {
  return { ...doc, given: doc.given.map((g, i) => (i === index ? given : g)) };
}

export function withOptions(doc: Document, options: Partial<Options>): Document {
  return { ...doc, options: { ...doc.options, ...options } };
}

export function withoutPoint(doc: Document, index: number): Document {
  const kept = <T>(all: readonly T[]) => all.filter((_, i) => i !== index);
  return { ...doc, points: kept(doc.points), given: kept(doc.given) };
}

/** A new point before the one at `index`; `index` = number of points: at the end. */
export function withInserted(doc: Document, index: number, at: Vec): Document {
  const points = [...doc.points], given = [...doc.given];
  points.splice(index, 0, at);
  given.splice(index, 0, {});
  return { ...doc, points, given };
}

/** Options of the job, with the names of the command line. */
export function jobOptions(doc: Document): Record<string, unknown> {
  const o = doc.options, out: Record<string, unknown> = { units: doc.units };
  if (o.carrier !== "spiral") out["carrier"] = o.carrier;
  else if (o.continuity === "G2") out["continuity"] = "G2";
  if (o.noise !== null) out["noise"] = o.noise;
  if (o.tolerance !== null) out["tolerance"] = o.tolerance;
  if (o.closing === "closed") out["closed"] = true;
  if (o.closing === "open") out["open"] = true;
  if (o.convex) out["convex"] = true;
  if (o.primitives) out["primitives"] = true;
  if (!o.findCorners) out["no-corners"] = true;
  const headings: Record<string, unknown> = {}, radii: Record<string, unknown> = {};
  const corners: number[] = [];
  doc.given.forEach((g, i) => {
    if (g.heading !== undefined) {
      headings[i + 1] = typeof g.heading === "number" ? g.heading : `${g.heading[0]}..${g.heading[1]}`;
    }
    if (g.radius !== undefined) radii[i + 1] = Number.isFinite(g.radius) ? g.radius : "inf";
    if (g.corner) corners.push(i + 1);
  });
  if (Object.keys(headings).length > 0) out["heading-at"] = headings;
  if (Object.keys(radii).length > 0) out["radius-at"] = radii;
  if (corners.length > 0) out["corner-at"] = corners;
  return out;
}

/** The same series for the command line: a file of points, and the options beside it. */
export function pointsCsv(doc: Document): string {
  const columns = ["x_" + doc.units, "y_" + doc.units];
  const has = (what: (g: Given) => boolean) => doc.given.some(what);
  const heading = has((g) => typeof g.heading === "number"), radius = has((g) => g.radius !== undefined);
  const corner = has((g) => g.corner === true);
  if (heading) columns.push("heading_deg");
  if (radius) columns.push("radius");
  if (corner) columns.push("corner");
  const rows = doc.points.map((p, i) => {
    const g = doc.given[i] ?? {};
    const cells: (string | number)[] = [p[0], p[1]];
    if (heading) cells.push(typeof g.heading === "number" ? g.heading : "");
    if (radius) cells.push(g.radius === undefined ? "" : Number.isFinite(g.radius) ? g.radius : "inf");
    if (corner) cells.push(g.corner ? 1 : 0);
    return cells.join(",");
  });
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
