// SPDX-License-Identifier: Apache-2.0
// What is shown along the curve: its figure at each place, and how high teeth stand.

import type { Curve, FitReport } from "../engine/engine";
import type { Shown } from "../state";

export function values(curve: Curve, shown: Shown): readonly number[] {
  if (shown === "curvature") return curve.kappa;
  if (shown === "slope") return curve.slope;
  return curve.kappa.map((k) => (k === 0 ? Infinity : 1 / k));
}

/** Whether the figure has no end between a place and the one before: a radius where the curve bends the other way. */
export function parts(all: readonly number[], shown: Shown, i: number): boolean {
  return shown === "radius" && i > 0 && !(all[i]! * all[i - 1]! > 0);
}

/** Arc length at each place, by chords of the places. */
export function lengths(curve: Curve): Float64Array {
  const n = curve.t.length, out = new Float64Array(n);
  for (let i = 1; i < n; ++i) {
    const step = Math.hypot(curve.xy[2 * i]! - curve.xy[2 * i - 2]!, curve.xy[2 * i + 1]! - curve.xy[2 * i - 1]!);
    out[i] = out[i - 1]! + step;
  }
  const whole = out[n - 1] ?? 0;
  if (whole > 0) for (let i = 0; i < n; ++i) out[i] = out[i]! * (curve.length / whole);
  return out;
}

/** The largest of all but a hundredth: one place of great curvature does not flatten the rest. */
export function usualSize(all: readonly number[]): number {
  const sizes = all.map(Math.abs).filter(Number.isFinite).sort((a, b) => a - b);
  return sizes[Math.floor(0.99 * (sizes.length - 1))] ?? 0;
}

/** A place of the curve where its curvature turns back, or its sign. */
export interface Mark {
  readonly place: number;
  readonly kind: "vertex" | "inflection";
}

const LEAST_TURN = 1e-9; // rad that a piece turns: less is straight but for rounding

/** The way in which the curvature goes on each piece, as it was proved; null: both ways, or nobody knows. */
export function ways(curve: Curve, report: FitReport | undefined): (number | null)[] {
  const proved = report?.certificate.monotone ?? [];
  return Array.from({ length: curve.pieces }, (_, piece) => {
    const verdict = proved[piece]?.verdict;
    return verdict === "increasing" ? 1 : verdict === "decreasing" ? -1 : verdict === "constant" ? 0 : null;
  });
}

/** Where the curvature turns back or changes its sign: between pieces as they were proved. */
export function marks(curve: Curve, report: FitReport | undefined): Mark[] {
  const out: Mark[] = [], each = curve.samples, proved = ways(curve, report);
  const turned = { vertex: 0, inflection: 0 }, since = { vertex: 0, inflection: 0 };
  const first: Partial<Record<Mark["kind"], number>> = {};
  const see = (kind: Mark["kind"], sign: number, from: number, to: number) => {
    if (sign === 0) return;
    first[kind] ??= sign;
    // what lies between both ways has neither: its middle stands for it
    if (turned[kind] !== 0 && turned[kind] !== sign) out.push({ place: (since[kind] + from) >> 1, kind });
    [turned[kind], since[kind]] = [sign, to];
  };
  const whole = curve.length / Math.max(1, curve.pieces);
  for (let piece = 0; piece < curve.pieces; ++piece) {
    const begin = piece * each, end = begin + each - 1, way = proved[piece]!;
    if (piece > 0 && jumps(curve, begin)) see("vertex", Math.sign(curve.kappa[begin]! - curve.kappa[begin - 1]!), begin, begin);
    if (way !== null) see("vertex", way, begin, end);
    for (let i = begin; i <= end; ++i) {
      if (way === null && i > begin && i < end) see("vertex", Math.sign(curve.slope[i]!), i, i);
      const kappa = curve.kappa[i]!;
      see("inflection", Math.abs(kappa) * whole < LEAST_TURN ? 0 : Math.sign(kappa), i, i);
    }
  }
  if (curve.closed) {
    const last = curve.t.length - 1, step = curve.kappa[0]! - curve.kappa[last]!;
    if (Math.abs(step) > STEP * Math.max(Math.abs(curve.kappa[0]!), Math.abs(curve.kappa[last]!))) see("vertex", Math.sign(step), last, last);
    for (const kind of ["vertex", "inflection"] as const) see(kind, first[kind] ?? 0, last, last);
  }
  return out;
}

const STEP = 1e-4; // of the larger curvature: a gap beyond it is no rounding

/** Whether the curvature steps between this place and the one before. */
function jumps(curve: Curve, i: number): boolean {
  const larger = Math.max(Math.abs(curve.kappa[i]!), Math.abs(curve.kappa[i - 1]!));
  return Math.abs(curve.kappa[i]! - curve.kappa[i - 1]!) > STEP * larger;
}
