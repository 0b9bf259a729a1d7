// SPDX-License-Identifier: Apache-2.0
// Adjacent circles and limiting arcs: what the points alone say of the contour (Bogdanov, region of
// monotone curves through a series of points).

import type { Document, Vec } from "../document/document";

const STEPS = 48; // of an arc as it is drawn
const ALL_ROUND = 2 * Math.PI;

export interface Adjacent {
  /** The circle through the point and its neighbours; a line where they are on one. */
  readonly circle: readonly Vec[];
  /** On both segments beside it: arcs of the circles of their two points. */
  readonly arcs: readonly (readonly Vec[])[];
}

/** Points that follow each other without a corner between them, by their places; null: no such point. */
function neighbour(doc: Document, closed: boolean, i: number, by: number): number | null {
  const n = doc.points.length, j = closed ? (i + by + n) % n : i + by;
  return j < 0 || j >= n || j === i ? null : j;
}

/** How far the arc from p to q turns that does not pass r, all on one circle; positive to the left. */
function turning(p: Vec, q: Vec, r: Vec): number {
  const [ax, ay, bx, by] = [p[0] - r[0], p[1] - r[1], q[0] - r[0], q[1] - r[1]];
  return 2 * Math.atan2(ax * by - ay * bx, ax * bx + ay * by);
}

/** Points of the arc from p to q that turns so far. */
function arc(p: Vec, q: Vec, turn: number): Vec[] {
  const [dx, dy] = [q[0] - p[0], q[1] - p[1]], half = turn / 2, out: Vec[] = [];
  for (let k = 0; k <= STEPS; ++k) {
    const t = k / STEPS, share = Math.abs(half) < 1e-9 ? t : Math.sin(half * t) / Math.sin(half), angle = half * (t - 1);
    out.push([p[0] + share * (dx * Math.cos(angle) - dy * Math.sin(angle)), p[1] + share * (dx * Math.sin(angle) + dy * Math.cos(angle))]);
  }
  return out;
}

/** The points whose circle is that of point i: itself and both neighbours. */
function three(doc: Document, closed: boolean, i: number): readonly [Vec, Vec, Vec] | null {
  const before = neighbour(doc, closed, i, -1), after = neighbour(doc, closed, i, 1);
  if (before === null || after === null || before === after || doc.given[i]?.corner) return null;
  return [doc.points[before]!, doc.points[i]!, doc.points[after]!];
}

export function adjacentOf(doc: Document, closed: boolean, i: number): Adjacent {
  const own = three(doc, closed, i), arcs: Vec[][] = [];
  for (const [from, to] of [[neighbour(doc, closed, i, -1), i], [i, neighbour(doc, closed, i, 1)]]) {
    if (from === null || to === null || from === undefined || to === undefined) continue;
    const p = doc.points[from]!, q = doc.points[to]!;
    const first = three(doc, closed, from), second = three(doc, closed, to);
    if (first) arcs.push(arc(p, q, turning(p, q, first[0])));
    if (second) arcs.push(arc(p, q, turning(p, q, second[2])));
  }
  if (!own) return { circle: [], arcs };
  const turn = turning(own[0], own[2], own[1]); // the way round that does not pass the point
  const passing = turn > 0 ? turn - ALL_ROUND : turn + ALL_ROUND;
  return { circle: [...arc(own[0], own[2], passing), ...arc(own[2], own[0], -turn)], arcs };
}
