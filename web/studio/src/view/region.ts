// SPDX-License-Identifier: Apache-2.0
// The region of all monotone curves with the elements of the contour at the ends of its pieces.
// Kurnosenko, "Biarcs and bilens", 2013: between the osculating circle at one end, followed by the
// arc that touches it and ends in the other element, and its mirror image.

import type { Vec } from "../document/document";
import type { Curve } from "../engine/engine";

const PLACES = 24;       // on each of the two arcs of a boundary
const STRAIGHT = 1e-9;   // turning below which an arc is drawn as a line, rad

interface Element {
  readonly p: Vec;
  readonly heading: number;
  readonly kappa: number;
}

const cross = (a: Vec, b: Vec): number => a[0] * b[1] - a[1] * b[0];
const dot = (a: Vec, b: Vec): number => a[0] * b[0] + a[1] * b[1];
const minus = (a: Vec, b: Vec): Vec => [a[0] - b[0], a[1] - b[1]];
const unit = (angle: number): Vec => [Math.cos(angle), Math.sin(angle)];
const turn = (from: Vec, to: Vec): number => Math.atan2(cross(from, to), dot(from, to));

/** Places along an arc from p in the direction of t that turns by `angle` and ends in q. */
function arcTo(p: Vec, t: Vec, q: Vec, angle: number, out: Vec[]): void {
  const chord = Math.hypot(q[0] - p[0], q[1] - p[1]);
  const kappa = Math.abs(angle) < STRAIGHT || chord === 0 ? 0 : (2 * Math.sin(angle / 2)) / chord;
  const along = kappa === 0 ? chord : angle / kappa, heading = Math.atan2(t[1], t[0]);
  for (let k = 1; k <= PLACES; ++k) {
    const s = (along * k) / PLACES;
    const reach = kappa === 0 ? s : (2 * Math.sin(0.5 * kappa * s)) / kappa;
    const way = unit(heading + 0.5 * kappa * s);
    out.push([p[0] + reach * way[0], p[1] + reach * way[1]]);
  }
}

/**
 * The boundary that begins with the osculating circle of `a` and ends in the point and tangent of
 * `b`. An arc from q with tangent w ends in p with tangent T where p - q is parallel to w + T; for
 * q on the circle of `a` that is linear in w, and one solution is w = -T.
 */
export function boundary(a: Element, b: Element): Vec[] | null {
  const s = unit(a.heading), t = unit(b.heading), v = minus(b.p, a.p);
  const m: Vec = [a.kappa * v[1] - s[0] + t[0], -a.kappa * v[0] - s[1] + t[1]];
  const size = dot(m, m);
  if (!(size > 0)) return null;
  const k = (2 * dot(t, m)) / size;
  const w: Vec = [t[0] - k * m[0], t[1] - k * m[1]], first = turn(s, w);
  const along = Math.abs(first) < STRAIGHT ? cross([s[0] + t[0], s[1] + t[1]], v) / cross([s[0] + t[0], s[1] + t[1]], s)
    : first / a.kappa;
  if (!Number.isFinite(along) || along < 0) return null;
  const reach = Math.abs(a.kappa * along) < STRAIGHT ? along : (2 * Math.sin(0.5 * a.kappa * along)) / a.kappa;
  const way = unit(a.heading + 0.5 * a.kappa * along);
  const q: Vec = [a.p[0] + reach * way[0], a.p[1] + reach * way[1]];
  const out: Vec[] = [a.p];
  arcTo(a.p, s, q, first, out);
  arcTo(q, w, b.p, turn(w, t), out);
  return out;
}

function reversed(e: Element): Element {
  return { p: e.p, heading: e.heading + Math.PI, kappa: -e.kappa };
}

/** Both boundaries of every piece, from its start to its end; none where there is no region. */
export function regions(curve: Curve): (readonly [Vec[], Vec[]] | null)[] {
  const out: (readonly [Vec[], Vec[]] | null)[] = [];
  const element = (i: number): Element => ({
    p: [curve.xy[2 * i]!, curve.xy[2 * i + 1]!], heading: curve.heading[i]!, kappa: curve.kappa[i]!,
  });
  for (let piece = 0; piece < curve.pieces; ++piece) {
    const a = element(piece * curve.samples), b = element((piece + 1) * curve.samples - 1);
    const one = boundary(a, b), other = boundary(reversed(b), reversed(a))?.reverse();
    out.push(one && other ? [one, other] : null);
  }
  return out;
}

export interface Magnified {
  /** By how much distances from the contour are drawn larger: 1, 2, 5, 10, ... */
  readonly factor: number;
  readonly outlines: readonly Vec[][];
}

interface Offset {
  readonly p: Vec;
  readonly n: Vec;
  readonly away: number;
}
interface Measured {
  readonly sides: readonly (readonly Offset[][])[];
  readonly widest: number;
}
const known = new WeakMap<Curve, Measured>(); // a curve is drawn in many frames

function measured(curve: Curve): Measured {
  const before = known.get(curve);
  if (before) return before;
  let widest = 0;
  const sides: Offset[][][] = [];
  regions(curve).forEach((both, piece) => {
    if (!both) return;
    sides.push(both.map((side) => side.map((q) => {
      const found = offset(curve, piece, q);
      widest = Math.max(widest, Math.abs(found.away));
      return found;
    })));
  });
  const now = { sides, widest };
  known.set(curve, now);
  return now;
}

/** Regions so far from the contour that the widest is as wide as asked for, in the same units. */
export function magnified(curve: Curve, wanted: number): Magnified {
  const { sides, widest } = measured(curve);
  const factor = widest > 0 ? nice(wanted / widest) : 1;
  const outlines = sides.map((both) => {
    const [one, other] = both.map((side) => side.map(({ p, n, away }): Vec =>
      [p[0] + factor * away * n[0], p[1] + factor * away * n[1]]));
    return [...one!, ...other!.reverse()];
  });
  return { factor, outlines };
}

const MOST_PLACES = 400; // of a curve whose distance from another is measured

/** Largest distance of some places of a curve from another one. */
export function largestDistance(of: Curve, from: Curve): number {
  const n = of.t.length, step = Math.max(1, Math.floor(n / MOST_PLACES));
  let most = 0;
  for (let i = 0; i < n; i += step) {
    const q: Vec = [of.xy[2 * i]!, of.xy[2 * i + 1]!], { p } = nearest(from, 0, from.t.length - 1, q);
    most = Math.max(most, Math.hypot(q[0] - p[0], q[1] - p[1]));
  }
  return most;
}

/** The place of a piece that a point lies beside, and how far to the left. */
function offset(curve: Curve, piece: number, q: Vec): Offset {
  const first = piece * curve.samples;
  return nearest(curve, first, first + curve.samples - 1, q);
}

/** The nearest place between two samples. */
function nearest(curve: Curve, first: number, last: number, q: Vec): Offset {
  let best = Infinity, at = first, p: Vec = q;
  for (let i = first; i < last; ++i) {
    const a: Vec = [curve.xy[2 * i]!, curve.xy[2 * i + 1]!], d = minus([curve.xy[2 * i + 2]!, curve.xy[2 * i + 3]!], a);
    const t = Math.max(0, Math.min(1, dot(minus(q, a), d) / (dot(d, d) || 1)));
    // along the chord of two samples; across it the curve bulges by its sagitta
    const mean = 0.5 * (curve.kappa[i]! + curve.kappa[i + 1]!), bulge = 0.5 * mean * t * (1 - t);
    const foot: Vec = [a[0] + t * d[0] + bulge * Math.hypot(d[0], d[1]) * d[1], a[1] + t * d[1] - bulge * Math.hypot(d[0], d[1]) * d[0]];
    const away = Math.hypot(q[0] - foot[0], q[1] - foot[1]);
    if (away < best) [best, at, p] = [away, i, foot];
  }
  const n = unit(curve.heading[at]! + Math.PI / 2);
  return { p, n, away: dot(minus(q, p), n) };
}

/** 1, 2, 5, 10, ... at most so large, 1 at least. */
function nice(value: number): number {
  if (!(value > 1)) return 1;
  const power = 10 ** Math.floor(Math.log10(value)), lead = value / power;
  return power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}
