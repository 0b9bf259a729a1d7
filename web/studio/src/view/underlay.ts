// SPDX-License-Identifier: Apache-2.0
// What lies below the contour: a picture to click points over, and an earlier contour beside it.

import { computed, signal } from "@preact/signals";
import type { Vec } from "../document/document";
import type { Curve } from "../engine/engine";
import type { DrawnAnswer, EngineError, FitAnswer } from "../engine/engine";
import { drawn, theEngine } from "../state";
import { largestDistance } from "./region";

export interface Picture {
  readonly image: ImageBitmap;
  /** Where its upper left corner lies, units of the document. */
  readonly at: Vec;
  /** Units of one of its pixels. */
  readonly unit: number;
}

export const picture = signal<Picture | null>(null);
/** Places clicked to tell the scale, of two; null: none is asked for. */
export const scaling = signal<readonly Vec[] | null>(null);

/** Stretched about the first of two places until they are so far apart. */
export function scaled(p: Picture, [a, b]: readonly Vec[], length: number): Picture {
  const apart = a && b ? Math.hypot(b[0] - a[0], b[1] - a[1]) : 0;
  if (!a || !(apart > 0) || !(length > 0)) return p;
  const by = length / apart;
  return { ...p, unit: p.unit * by, at: [a[0] + by * (p.at[0] - a[0]), a[1] + by * (p.at[1] - a[1])] };
}

/** An earlier contour, kept to be seen beside the one that is drawn. */
export const kept = signal<Curve | null>(null);

const PLACES = 256; // of a piece that is kept: enough for four figures of a distance

/** Keeps a curve: of a contour file or drawing as it stands, of points the contour through them; what is
 * wrong with the text otherwise. */
export async function keep(text: string, name: string): Promise<EngineError | null> {
  const request = { text, name, samples: PLACES };
  const stored = await theEngine().call<DrawnAnswer>("drawn", request);
  const curve = stored.curve ? stored : await theEngine().call<FitAnswer>("fit", { ...request, options: {}, file: false });
  if (curve.curve) kept.value = curve.curve;
  return curve.curve ? null : curve.error;
}

/** How far the contour goes from the one that was kept, as measured at places of it. */
export const apart = computed(() => {
  const now = drawn.value?.curve;
  return kept.value && now ? largestDistance(now, kept.value) : null;
});
