// SPDX-License-Identifier: Apache-2.0
// What the page asks of the engine, wherever that runs.

import type { Vec } from "../document/document";

export interface EngineError {
  readonly code: number;
  readonly category: number;
  readonly message: string;
  readonly where: string;
  readonly advice: string;
  readonly points: readonly number[];
}

/** Another, newer request took its place. */
export const CANCELLED = 103;
/** Formed, but it does not keep its promise. */
export const NOT_PROVED = 5;

export interface Request {
  readonly points?: readonly Vec[];
  readonly text?: string;
  readonly name?: string;
  readonly options?: Record<string, unknown>;
  readonly contour?: string;
  readonly format?: string;
  readonly samples?: number;
  /** Whether `fit` hands out the contour file too. */
  readonly file?: boolean;
}

export interface Curve {
  readonly pieces: number;
  /** Places of each piece, both ends among them. */
  readonly samples: number;
  readonly t: readonly number[];
  readonly xy: readonly number[];
  readonly heading: readonly number[];
  readonly kappa: readonly number[];
  readonly slope: readonly number[];
  readonly length: number;
  readonly closed: boolean;
}

export interface Segment {
  readonly points: readonly [number, number];
  readonly chord: number;
  readonly points_only_error: number | null;
  readonly width: number | null;
  readonly deviation: number | null;
  readonly inserted: number;
}

export interface FitReport {
  readonly units: string;
  readonly carrier: string;
  readonly continuity: string;
  readonly points: number;
  readonly pieces: number;
  readonly report: {
    readonly segments: readonly Segment[];
    readonly tolerance: number;
    readonly largest_deviation: number | null;
    readonly largest_move: number;
    readonly vertices: number;
    readonly vertices_lower_bound: number;
    readonly inflections: number;
    readonly inserted_points: number;
    readonly waviness: number | null;
    readonly seconds: number;
  };
  readonly certificate: {
    readonly proved: boolean;
    readonly reason: string;
    readonly corners: number;
    readonly curvature_steps: number;
    readonly slope_steps?: number;
    readonly vertices: number;
    readonly inflections: number;
    readonly monotone: readonly { readonly verdict: "increasing" | "decreasing" | "constant" | "has-vertex" | "undecided" }[];
    readonly joint_gaps: {
      readonly position: number;
      readonly heading: number;
      readonly curvature: number | null;
      readonly slope?: number | null;
    };
  };
}

export interface FitAnswer {
  readonly error: EngineError | null;
  readonly report?: FitReport;
  readonly contour?: string;
  readonly curve?: Curve | null;
  readonly warnings?: readonly string[];
}

export interface RegionPoint {
  readonly index: number;
  readonly heading: number | null;
  readonly heading_low: number | null;
  readonly heading_high: number | null;
  readonly kappa_low: number | null;
  readonly kappa_high: number | null;
}

export interface SeriesReport {
  readonly name: string;
  readonly units: string;
  readonly units_source: string;
  readonly points: readonly Vec[];
  readonly given: readonly {
    readonly point: number;
    readonly heading?: number;
    readonly kappa?: number;
    readonly headings?: readonly [number, number];
    readonly kappas?: readonly [number | null, number | null];
    readonly corner?: boolean;
    readonly tolerance?: number;
  }[];
  /** Lines, arcs, ... of a drawing that the contour takes over. */
  readonly pieces_as_drawn: number;
  readonly warnings: readonly string[];
}

export interface Answer<Report> {
  readonly error: EngineError | null;
  readonly report?: Report;
}

/** A curve as it stands in a file. */
export interface DrawnAnswer {
  readonly error: EngineError | null;
  readonly curve?: Curve | null;
}

export interface ExportAnswer {
  readonly error: EngineError | null;
  readonly files?: readonly { readonly suffix: string; readonly text: string }[];
  readonly remarks?: readonly string[];
}

export type Kind =
  | "series" | "fit" | "drawn" | "worksheet" | "region" | "analyse" | "compare" | "suggest" | "why_not" | "verify"
  | "export";

export interface Engine {
  /** Whether it needs no program on the machine. */
  readonly inPage: boolean;
  /** Rejects when the engine cannot be reached; refusals of the engine are answers. */
  call<T>(kind: Kind, request: Request): Promise<T>;
  /** The file that the page was opened with. */
  opened(): Promise<{ readonly name: string; readonly text: string } | null>;
}
