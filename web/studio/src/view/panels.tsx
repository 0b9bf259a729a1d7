// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import { signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import {
  CARRIERS, givenOf, jobOf, PREFER, textOf,
  type Carrier, type Closing, type Document, type Given, type Prefer, type Range,
} from "../document/document";
import {
  asked, current, doc, drawn, fitted, movePoint, drop, region, removePoint, select, selected, setGiven, setOptions, setUnits,
} from "../state";
import { headingAt } from "./paint";
import { DEGREES, figure, inFirstTurn } from "../words/figures";
import { words } from "../words/words";

const UNITS = ["nm", "um", "mm", "cm", "dm", "m", "km", "mil", "in", "ft", "usft", "yd", "mi", "chord"];

function Row(props: { label: string; hint?: string; children: ComponentChildren }) {
  return <label title={props.hint ?? ""}><span>{props.label}</span>{props.children}</label>;
}

/** A value that may be left out; nothing is changed by what `read` does not know (undefined). */
function ValueBox<T>(props: {
  id: string; value: T | null; show: (v: T) => string; read: (text: string) => T | undefined;
  onValue: (v: T | null) => void; placeholder?: string; title?: string;
}) {
  const [typed, setTyped] = useState<string | null>(null); // answers that come meanwhile leave it
  const take = (e: Event) => {
    setTyped(null);
    const text = (e.currentTarget as HTMLInputElement).value.trim();
    if (text === "") return props.onValue(null);
    const value = props.read(text);
    if (value !== undefined) props.onValue(value);
  };
  return <input id={props.id} value={typed ?? (props.value === null ? "" : props.show(props.value))}
    placeholder={props.placeholder ?? ""} title={props.title} onInput={(e) => setTyped(e.currentTarget.value)} onChange={take} />;
}

export function NumberBox(props: { id: string; value: number | null; onValue: (v: number | null) => void; placeholder?: string; min?: number }) {
  const read = (text: string) => {
    const value = text === "inf" ? Infinity : Number(text.replace(",", "."));
    return Number.isNaN(value) || (props.min !== undefined && value < props.min) ? undefined : value;
  };
  return <ValueBox {...props} show={textOf} read={read} />;
}

/** A number or a range. */
function GivenBox(props: { id: string; value: number | Range | null; onValue: (v: number | Range | null) => void; placeholder?: string; title: string }) {
  return <ValueBox {...props} show={textOf} read={givenOf} />;
}

/** How far points may move: a number, or "rounding". */
function NoiseBox(props: { value: number | "rounding" | null; onValue: (v: number | "rounding" | null) => void }) {
  const read = (text: string) => {
    const value = Number(text.replace(",", "."));
    return text === "rounding" ? text : Number.isNaN(value) || value < 0 ? undefined : value;
  };
  return <ValueBox<number | "rounding"> id="noise" placeholder="0" show={String} read={read} {...props} />;
}

export function OptionsPanel() {
  const w = words(), o = doc.value.options;
  const check = (id: string, label: string, hint: string, value: boolean, set: (v: boolean) => void) => (
    <Row label={label} hint={hint}>
      <input id={id} type="checkbox" checked={value} onChange={(e) => set(e.currentTarget.checked)} />
    </Row>
  );
  return (
    <section class="panel" id="options">
      <Row label={w.carrier} hint={w.carrierHint}>
        <select id="carrier" value={o.carrier} onChange={(e) => setOptions({ carrier: e.currentTarget.value as Carrier })}>
          {CARRIERS.map((c) => <option value={c}>{c}</option>)}
        </select>
      </Row>
      <Row label={w.continuity} hint={w.continuityHint}>
        <select id="continuity" value={o.continuity} disabled={o.carrier !== "spiral"}
          onChange={(e) => setOptions({ continuity: e.currentTarget.value as "G2" | "G3" })}>
          <option>G3</option><option>G2</option>
        </select>
      </Row>
      <Row label={w.prefer} hint={w.preferHint}>
        <select id="prefer" value={o.prefer} onChange={(e) => setOptions({ prefer: e.currentTarget.value as Prefer })}>
          {PREFER.map((p) => <option value={p}>{w.preferNames[p]}</option>)}
        </select>
      </Row>
      <Row label={w.noise} hint={w.noiseHint}>
        <NoiseBox value={o.noise} onValue={(noise) => setOptions({ noise })} />
      </Row>
      <Row label={w.tolerance} hint={w.toleranceHint}>
        <NumberBox id="tolerance" min={0} value={o.tolerance} placeholder={figure(fitted.value?.answer.report?.report.tolerance)}
          onValue={(tolerance) => setOptions({ tolerance })} />
      </Row>
      <Row label={w.closing} hint={w.closingHint}>
        <select id="closing" value={o.closing} onChange={(e) => setOptions({ closing: e.currentTarget.value as Closing })}>
          <option value="auto">{w.auto}</option><option value="closed">{w.closed}</option><option value="open">{w.openEnds}</option>
        </select>
      </Row>
      {check("convex", w.convex, w.convexHint, o.convex, (convex) => setOptions({ convex }))}
      {check("primitives", w.primitives, w.primitivesHint, o.primitives, (primitives) => setOptions({ primitives }))}
      {check("corners", w.corners, w.cornersHint, o.findCorners, (findCorners) => setOptions({ findCorners }))}
      <Row label={w.units} hint={w.unitsHint}>
        <select id="units" value={doc.value.units} onChange={(e) => setUnits(e.currentTarget.value)}>
          {(UNITS.includes(doc.value.units) ? UNITS : [doc.value.units, ...UNITS]).map((u) => <option value={u}>{u}</option>)}
        </select>
      </Row>
    </section>
  );
}

function without(given: Given, what: keyof Given): Given {
  const { [what]: _gone, ...rest } = given;
  return rest;
}

export function PointPanel() {
  const w = words(), at = selected.value;
  const p = at === null ? undefined : doc.value.points[at];
  if (at === null || !p) return <section class="panel" id="point"><p class="hint">{w.noSelection}</p></section>;
  const given = doc.value.given[at] ?? {};
  const free = headingAt(doc.value, at, drawn.value?.curve ?? null);
  const found = region.value?.of !== doc.value ? undefined : region.value.points.find((one) => one.index === at);
  const coordinate = (k: 0 | 1) => (v: number | null) => {
    if (v === null || !Number.isFinite(v)) return;
    movePoint(at, k === 0 ? [v, p[1]] : [p[0], v]);
    drop();
  };
  return (
    <section class="panel" id="point">
      <h2>{w.point} {at + 1}</h2>
      <Row label="x" hint={w.coordinateHint}><NumberBox key={`x${at}`} id="x" value={p[0]} onValue={coordinate(0)} /></Row>
      <Row label="y" hint={w.coordinateHint}><NumberBox key={`y${at}`} id="y" value={p[1]} onValue={coordinate(1)} /></Row>
      <Row label={w.heading} hint={w.headingHint}>
        <GivenBox key={`h${at}`} id="heading" title={w.rangeHint} value={given.heading ?? null} placeholder={free === null ? "" : inFirstTurn(free * DEGREES).toFixed(2)}
          onValue={(v) => setGiven(at, v === null ? without(given, "heading") : { ...given, heading: v })} />
      </Row>
      <p class="hint" id="headings" title={w.feasibleHeadings}>{w.feasible}: {found && found.heading_low !== null && found.heading_high !== null
        ? headings(found.heading_low * DEGREES, found.heading_high * DEGREES) : "-"}</p>
      <Row label={`${w.radius}, ${doc.value.units}`} hint={w.radiusHint}>
        <GivenBox key={`r${at}`} id="radius" title={w.radiusRangeHint} value={given.radius ?? null}
          onValue={(v) => setGiven(at, v === null || v === 0 ? without(given, "radius") : { ...without(given, "kappa"), radius: v })} />
      </Row>
      {given.kappa ? <p class="hint" id="given-kappa">{w.given}: κ {textOf(given.kappa)}</p> : null}
      <p class="hint" id="curvatures" title={w.feasibleCurvatures}>{w.feasible}: {found ? curvatures(found.kappa_low, found.kappa_high) : "-"}</p>
      <p class="hint" id="radii" title={w.feasibleCurvatures}>R {found ? radii(found.kappa_low, found.kappa_high) : "-"}</p>
      <Row label={w.corner} hint={w.cornerHint}>
        <input id="corner" type="checkbox" checked={given.corner === true}
          onChange={(e) => setGiven(at, e.currentTarget.checked ? { ...given, corner: true } : without(given, "corner"))} />
      </Row>
      <button id="remove" title={w.removePoint} onClick={() => removePoint(at)}>{w.remove}</button>
    </section>
  );
}

/** A range of headings, its lower end in the first turn. */
function headings(low: number, high: number): string {
  const first = inFirstTurn(low);
  return `${first.toFixed(2)}° ... ${(first + high - low).toFixed(2)}°`;
}

function curvatures(low: number | null, high: number | null): string {
  return `κ ${low === null ? "-∞" : figure(low)} ... ${high === null ? "∞" : figure(high)}`;
}

/** A range of curvatures as radii: what has no end stays open. */
function radii(low: number | null, high: number | null): string {
  const radius = (k: number | null) => (k === null ? "0" : k === 0 ? "∞" : figure(1 / k));
  return `${radius(low)} ... ${radius(high)}`;
}

// ---- tables ---------------------------------------------------------------------------------

const MOST_ROWS = 200; // of the table of segments; files have them all

type Tab = "segments" | "compare" | "noise";
const tab = signal<Tab>("segments");

export function showTab(name: Tab): void {
  tab.value = name;
  if (name === "compare") void ask("compare");
  if (name === "noise") void ask("suggest");
  document.querySelector("#tables")?.scrollIntoView({ block: "nearest" });
}

interface CompareRow {
  readonly carrier: string;
  readonly [name: string]: unknown;
}
const compared = signal<{ readonly of: Document; readonly rows: readonly CompareRow[] } | null>(null);
const suggested = signal<{ readonly of: Document; readonly rows: readonly Record<string, unknown>[] } | null>(null);

async function ask(kind: "compare" | "suggest"): Promise<void> {
  const of = doc.value;
  const report = (await asked<Record<string, unknown>>(kind, jobOf(of, kind === "suggest" ? ["carrier", "noise"] : ["carrier"])))?.report ?? {};
  const rows = (report["carriers"] ?? report["rows"] ?? report["steps"] ?? []) as CompareRow[];
  if (kind === "compare") compared.value = { of, rows };
  else suggested.value = { of, rows };
}

export function Tables() {
  const w = words();
  const tabs: [Tab, string, string][] = [["segments", w.segments, w.segmentsHint], ["compare", w.compare, w.compareHint], ["noise", w.noiseTab, w.noiseTabHint]];
  return (
    <section class="panel" id="tables">
      <div role="tablist">
        {tabs.map(([name, label, hint]) => (
          <button role="tab" id={`tab-${name}`} aria-selected={tab.value === name} title={hint} onClick={() => showTab(name)}>
            {label}
          </button>
        ))}
      </div>
      {tab.value === "segments" ? <Segments /> : tab.value === "compare" ? <Compared /> : <Suggested />}
    </section>
  );
}

function Segments() {
  const w = words(), report = fitted.value?.answer.report;
  if (!report) return null;
  return (
    <table id="segments" class={current.value ? "" : "stale"}>
      <thead><tr><th title={w.pointsHint}>{w.points}</th><th title={w.chordHint}>{w.chord}</th><th title={w.pointsOnlyHint}>{w.pointsOnly}</th><th title={w.ownHint}>{w.own}</th></tr></thead>
      <tbody>
        {report.report.segments.slice(0, MOST_ROWS).map((s) => (
          <tr title={w.pointsHint} onClick={() => select(s.points[0])}>
            <td><button id={`segment-${s.points[0] + 1}`}>{s.points[0] + 1}-{s.points[1] + 1}</button></td><td>{figure(s.chord)}</td>
            <td>{figure(s.points_only_error)}</td><td>{figure(s.deviation)}</td>
          </tr>
        ))}
        {report.report.segments.length > MOST_ROWS ? <tr><td>...</td></tr> : null}
      </tbody>
    </table>
  );
}

function Compared() {
  const w = words();
  if (!compared.value) return <p class="hint">{w.computing}</p>;
  return (
    <table id="compared" class={compared.value.of === doc.value ? "" : "stale"}>
      <thead><tr><th title={w.familyHint}>{w.family}</th><th title={w.piecesHint}>{w.pieces}</th><th title={w.verticesHint}>{w.vertices}</th><th title={w.comparedError}>{w.error}</th></tr></thead>
      <tbody>
        {compared.value.rows.map((row) => (
          <tr title={w.compareHint} onClick={() => setOptions({ carrier: row.carrier as Carrier })}>
            <td><button id={`family-${row.carrier}`}>{row.carrier}</button></td><td>{cell(row["pieces"])}</td><td>{cell(row["vertices"])}</td><td>{cell(row["error_bound"])}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** The noise that a row of the table asks for: as its option says it. */
function noiseOf(row: Record<string, unknown>): number | "rounding" | null {
  const text = /--noise (\S+)/.exec(String(row["option"] ?? ""))?.[1];
  return text === undefined ? null : text === "rounding" ? text : Number(text);
}

function Suggested() {
  const w = words();
  if (!suggested.value) return <p class="hint">{w.computing}</p>;
  const { rows } = suggested.value, take = (row: Record<string, unknown> | undefined) => { if (row) setOptions({ noise: noiseOf(row) }); };
  const at = rows.findIndex((row) => noiseOf(row) === doc.value.options.noise);
  return (
    <div class={suggested.value.of.points === doc.value.points ? "" : "stale"}>
      <TradeOff rows={rows} at={at} take={take} />
      <input id="noise-slider" type="range" min="0" max={rows.length - 1} step="1" value={Math.max(0, at)} aria-label={w.slider} title={w.slider}
        onChange={(e) => take(rows[Number(e.currentTarget.value)])} />
      <table id="suggested" title={w.suggestHint}>
        <thead><tr><th title={w.noiseHint}>{w.noise}</th><th title={w.verticesHint}>{w.vertices}</th></tr></thead>
        <tbody>
          {rows.map((row, i) => (
            <tr class={i === at ? "taken" : ""} onClick={() => take(row)}><td><button id={`noise-${i + 1}`}>{cell(row["tolerance"])}</button></td><td>{cell(row["vertices"])}</td></tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

/** Vertices over noise, a step a row; a click takes one. */
function TradeOff(props: { rows: readonly Record<string, unknown>[]; at: number; take: (row: Record<string, unknown> | undefined) => void }) {
  const width = 280, height = 96, edge = 10, { rows } = props;
  const vertices = rows.map((row) => (typeof row["vertices"] === "number" ? row["vertices"] : null));
  const most = Math.max(1, ...vertices.map((v) => v ?? 0));
  const x = (i: number) => edge + (i * (width - 2 * edge)) / Math.max(1, rows.length - 1), y = (v: number) => height - edge - (v / most) * (height - 2 * edge);
  const line = vertices.flatMap((v, i) => (v === null ? [] : [`${x(i)},${y(v)}`])).join(" ");
  return (
    <svg id="trade-off" viewBox={`0 0 ${width} ${height}`} role="img" aria-label={words().suggestHint}>
      <polyline points={line} />
      {vertices.map((v, i) => (v === null ? null
        : <circle cx={x(i)} cy={y(v)} r={i === props.at ? 6 : 4} class={i === props.at ? "taken" : ""} onClick={() => props.take(rows[i])}>
          <title>{`${cell(rows[i]!["tolerance"])}: ${v}`}</title></circle>))}
    </svg>
  );
}

function cell(value: unknown): string {
  return typeof value === "number" ? (Number.isInteger(value) ? String(value) : figure(value)) : value === null || value === undefined ? "-" : String(value);
}
