// SPDX-License-Identifier: Apache-2.0
// What is shown along the curve: its figure at each place, and how high teeth stand.

import type { Curve } from "../engine/engine";
import type { Shown } from "../state";

export function values(curve: Curve, shown: Shown): readonly number[] {
  if (shown === "curvature") return curve.kappa;
  if (shown === "slope") return curve.slope;
  return curve.kappa.map((k) => (k === 0 ? Infinity : 1 / k));
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

export interface Mark {
  readonly place: number;
  readonly kind: "vertex" | "inflection";
}

/** Where the curvature turns back or changes its sign, between corners. */
export function marks(curve: Curve): Mark[] {
  const out: Mark[] = [];
  const each = curve.samples;
  let rising = 0, side = 0;
  for (let i = 0; i < curve.t.length; ++i) {
    const joint = i > 0 && i % each === 0;
    if (joint && jumps(curve, i)) rising = side = 0;
    const slope = Math.sign(curve.slope[i]!), kappa = Math.sign(curve.kappa[i]!);
    if (i % each !== 0 && i % each !== each - 1 && slope !== 0) {
      if (rising !== 0 && slope !== rising) out.push({ place: i, kind: "vertex" });
      rising = slope;
    }
    if (kappa !== 0) {
      if (side !== 0 && kappa !== side) out.push({ place: i, kind: "inflection" });
      side = kappa;
    }
  }
  return out;
}

/** Whether the contour turns, or its curvature steps, between this place and the one before. */
function jumps(curve: Curve, i: number): boolean {
  const turn = Math.abs(Math.sin((curve.heading[i]! - curve.heading[i - 1]!) / 2));
  const larger = Math.max(Math.abs(curve.kappa[i]!), Math.abs(curve.kappa[i - 1]!));
  return turn > 1e-6 || Math.abs(curve.kappa[i]! - curve.kappa[i - 1]!) > 1e-4 * larger;
}
