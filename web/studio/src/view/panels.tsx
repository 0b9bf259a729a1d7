// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import { signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { CARRIERS, jobOptions, type Carrier, type Closing, type Document, type Given } from "../document/document";
import type { Answer } from "../engine/engine";
import {
  current, doc, drawn, fitted, movePoint, drop, region, removePoint, selected, setGiven, setOptions,
  setUnits, theEngine,
} from "../state";
import { headingAt } from "./paint";
import { DEGREES, figure, inFirstTurn } from "../words/figures";
import { words } from "../words/words";

const UNITS = ["um", "mm", "cm", "m", "km", "in", "ft", "usft", "yd", "mi", "chord"];

function Row(props: { label: string; hint?: string; children: ComponentChildren }) {
  return <label title={props.hint ?? ""}><span>{props.label}</span>{props.children}</label>;
}

/** A number that may be left out; nothing is changed by what is no number. */
export function NumberBox(props: { id: string; value: number | null; onValue: (v: number | null) => void; placeholder?: string; min?: number }) {
  const [typed, setTyped] = useState<string | null>(null); // answers that come meanwhile leave it
  const take = (e: Event) => {
    setTyped(null);
    const text = (e.currentTarget as HTMLInputElement).value.trim().replace(",", ".");
    if (text === "") return props.onValue(null);
    const value = text === "inf" ? Infinity : Number(text);
    if (!Number.isNaN(value) && (props.min === undefined || value >= props.min)) props.onValue(value);
  };
  const shown = props.value === null ? "" : Number.isFinite(props.value) ? String(props.value) : "inf";
  return <input id={props.id} inputMode="decimal" value={typed ?? shown} placeholder={props.placeholder ?? ""}
    onInput={(e) => setTyped(e.currentTarget.value)} onChange={take} />;
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
      <Row label={w.noise} hint={w.noiseHint}>
        <NumberBox id="noise" min={0} value={typeof o.noise === "number" ? o.noise : null} placeholder="0"
          onValue={(noise) => setOptions({ noise })} />
      </Row>
      <Row label={w.tolerance} hint={w.toleranceHint}>
        <NumberBox id="tolerance" min={0} value={o.tolerance} placeholder={figure(fitted.value?.answer.report?.report.tolerance)}
          onValue={(tolerance) => setOptions({ tolerance })} />
      </Row>
      <Row label={w.closing}>
        <select id="closing" value={o.closing} onChange={(e) => setOptions({ closing: e.currentTarget.value as Closing })}>
          <option value="auto">{w.auto}</option><option value="closed">{w.closed}</option><option value="open">{w.openEnds}</option>
        </select>
      </Row>
      {check("convex", w.convex, w.convexHint, o.convex, (convex) => setOptions({ convex }))}
      {check("primitives", w.primitives, w.primitivesHint, o.primitives, (primitives) => setOptions({ primitives }))}
      {check("corners", w.corners, "", o.findCorners, (findCorners) => setOptions({ findCorners }))}
      <Row label={w.units}>
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
  const heading = typeof given.heading === "number" ? given.heading : null;
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
      <Row label="x"><NumberBox key={`x${at}`} id="x" value={p[0]} onValue={coordinate(0)} /></Row>
      <Row label="y"><NumberBox key={`y${at}`} id="y" value={p[1]} onValue={coordinate(1)} /></Row>
      <Row label={w.heading} hint={w.headingHint}>
        <NumberBox key={`h${at}`} id="heading" value={heading} placeholder={free === null ? "" : inFirstTurn(free * DEGREES).toFixed(2)}
          onValue={(v) => setGiven(at, v === null ? without(given, "heading") : { ...given, heading: v })} />
      </Row>
      <p class="hint" id="headings">{w.feasible}: {found && found.heading_low !== null && found.heading_high !== null
        ? headings(found.heading_low * DEGREES, found.heading_high * DEGREES) : "-"}</p>
      <Row label={`${w.radius}, ${doc.value.units}`} hint={w.radiusHint}>
        <NumberBox key={`r${at}`} id="radius" value={given.radius ?? null}
          onValue={(v) => setGiven(at, v === null || v === 0 ? without(given, "radius") : { ...given, radius: v })} />
      </Row>
      <p class="hint" id="curvatures">{w.feasible}: {found ? curvatures(found.kappa_low, found.kappa_high) : "-"}</p>
      <p class="hint" id="radii">R {found ? radii(found.kappa_low, found.kappa_high) : "-"}</p>
      <Row label={w.corner} hint={w.cornerHint}>
        <input id="corner" type="checkbox" checked={given.corner === true}
          onChange={(e) => setGiven(at, e.currentTarget.checked ? { ...given, corner: true } : without(given, "corner"))} />
      </Row>
      <button id="remove" onClick={() => removePoint(at)}>{w.remove}</button>
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

interface CompareRow {
  readonly carrier: string;
  readonly [name: string]: unknown;
}
const compared = signal<{ readonly of: Document; readonly rows: readonly CompareRow[] } | null>(null);
const suggested = signal<{ readonly of: Document; readonly rows: readonly Record<string, unknown>[] } | null>(null);

async function ask(kind: "compare" | "suggest"): Promise<void> {
  const of = doc.value;
  const options = jobOptions(of);
  delete options["carrier"];
  if (kind === "suggest") delete options["noise"];
  const answer = await theEngine().call<Answer<Record<string, unknown>>>(kind, { points: of.points, options });
  const report = answer.report ?? {};
  const rows = (report["carriers"] ?? report["rows"] ?? report["steps"] ?? []) as CompareRow[];
  if (kind === "compare") compared.value = { of, rows };
  else suggested.value = { of, rows };
}

export function Tables() {
  const w = words();
  const tabs: [Tab, string][] = [["segments", w.segments], ["compare", w.compare], ["noise", w.noiseTab]];
  return (
    <section class="panel" id="tables">
      <div role="tablist">
        {tabs.map(([name, label]) => (
          <button role="tab" id={`tab-${name}`} aria-selected={tab.value === name}
            onClick={() => { tab.value = name; if (name === "compare") void ask("compare"); if (name === "noise") void ask("suggest"); }}>
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
      <thead><tr><th>{w.points}</th><th>{w.chord}</th><th>{w.pointsOnly}</th><th>{w.own}</th></tr></thead>
      <tbody>
        {report.report.segments.slice(0, MOST_ROWS).map((s) => (
          <tr onClick={() => { selected.value = s.points[0]; }}>
            <td>{s.points[0] + 1}-{s.points[1] + 1}</td><td>{figure(s.chord)}</td>
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
      <thead><tr><th>{w.family}</th><th>{w.pieces}</th><th>{w.vertices}</th><th>{w.error}</th></tr></thead>
      <tbody>
        {compared.value.rows.map((row) => (
          <tr onClick={() => setOptions({ carrier: row.carrier as Carrier })}>
            <td>{row.carrier}</td><td>{cell(row["pieces"])}</td><td>{cell(row["vertices"])}</td><td>{cell(row["error_bound"])}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Suggested() {
  const w = words();
  if (!suggested.value) return <p class="hint">{w.computing}</p>;
  return (
    <table id="suggested" class={suggested.value.of === doc.value ? "" : "stale"} title={w.suggestHint}>
      <thead><tr><th>{w.noise}</th><th>{w.vertices}</th></tr></thead>
      <tbody>
        {suggested.value.rows.map((row) => (
          <tr onClick={() => { const t = row["tolerance"]; if (typeof t === "number") setOptions({ noise: t > 0 ? t : null }); }}>
            <td>{cell(row["tolerance"])}</td><td>{cell(row["vertices"])}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function cell(value: unknown): string {
  return typeof value === "number" ? (Number.isInteger(value) ? String(value) : figure(value)) : value === null || value === undefined ? "-" : String(value);
}
