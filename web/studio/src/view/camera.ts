// SPDX-License-Identifier: Apache-2.0
// From units of the document to pixels of the canvas and back.

import type { Vec } from "../document/document";

export interface Camera {
  /** Pixels of one unit. */
  readonly scale: number;
  /** Where the origin lies, pixels. */
  readonly x: number;
  readonly y: number;
}

export function toScreen(c: Camera, p: Vec): Vec {
  return [c.x + c.scale * p[0], c.y - c.scale * p[1]];
}

export function fromScreen(c: Camera, p: Vec): Vec {
  return [(p[0] - c.x) / c.scale, (c.y - p[1]) / c.scale];
}

/** All points inside, with room around them for the comb. */
export function around(points: readonly Vec[], width: number, height: number): Camera {
  const room = 0.16;
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [x, y] of points) {
    x0 = Math.min(x0, x); x1 = Math.max(x1, x);
    y0 = Math.min(y0, y); y1 = Math.max(y1, y);
  }
  if (!(x1 >= x0)) [x0, y0, x1, y1] = [0, 0, 1, 1];
  const wide = Math.max(x1 - x0, 1e-300), high = Math.max(y1 - y0, 1e-300);
  const scale = (1 - 2 * room) * Math.min(width / wide, height / high);
  return { scale, x: width / 2 - scale * (x0 + x1) / 2, y: height / 2 + scale * (y0 + y1) / 2 };
}

/** A place stays where it is on the screen. */
export function zoomed(c: Camera, at: Vec, factor: number): Camera {
  return { scale: c.scale * factor, x: at[0] + (c.x - at[0]) * factor, y: at[1] + (c.y - at[1]) * factor };
}

export function panned(c: Camera, by: Vec): Camera {
  return { ...c, x: c.x + by[0], y: c.y + by[1] };
}

/** 1, 2 or 5 times a power of ten, at least so many pixels long. */
export function gridStep(c: Camera, pixels: number): number {
  const least = pixels / c.scale, power = 10 ** Math.floor(Math.log10(least));
  for (const k of [1, 2, 5]) if (k * power >= least) return k * power;
  return 10 * power;
}
