// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { documentOf, jobOf, pointsCsv } from "../document/document";
import {
  asked, canRedo, canUndo, combEvery, combHeight, current, curves, doc, drawn, empty, fitted, listCurves, message, open, redo,
  shadesRegion, shown, snaps, theEngine, undo, type Shown,
} from "../state";
import { Below } from "./below";
import { Drawing, layPicture, magnification, showAll } from "./drawing";
import { OptionsPanel, PointPanel, Tables } from "./panels";
import { Plot } from "./plot";
import { Preview, SaveChoice } from "./preview";
import { theme } from "./theme";
import { Verdict } from "./verdict";
import { language, words } from "../words/words";

const tourStep = signal<number | null>(null);
try {
  if (window.localStorage.getItem("obvid-tour") !== "done") tourStep.value = 0;
} catch {
  tourStep.value = null; // a page from a folder may have no storage
}

const NEEDS_PROGRAM = /\.(step|stp|iges|igs|brep|brp)$/i;

async function take(file: File): Promise<void> {
  if (theEngine().inPage && NEEDS_PROGRAM.test(file.name)) {
    message.value = words().needsProgram.replace("{file}", file.name);
    return;
  }
  if (file.type.startsWith("image/") && file.type !== "image/svg+xml") return layPicture(file);
  await opened(file.name, await file.text());
}

/** A text as the document, all of it in view, and what else it holds to choose from. */
export async function opened(name: string, text: string): Promise<void> {
  await open(name, text);
  showAll();
  await listCurves(text, name);
}

function CurveChoice() {
  const { source } = doc.value, list = curves.value, w = words();
  if (!source) return null;
  return (
    <>
      {list?.of === source.text ? (
        <select id="curve" title={w.whichCurve} aria-label={w.whichCurve} value={String(source.curve ?? 0)}
          onChange={(e) => { const n = Number(e.currentTarget.value); void open(source.name, source.text, n === 0 ? undefined : n).then(showAll); }}>
          <option value="0">{w.longest}</option>
          {list.names.map((name, i) => <option value={String(i + 1)}>{i + 1}: {name}</option>)}
        </select>
      ) : null}
      {source.holds ? <span id="as-drawn" class="hint" title={w.asDrawnHint}>{w.asDrawn}</span> : null}
    </>
  );
}

async function whyNot(): Promise<void> {
  message.value = words().computing;
  const answer = await asked("why_not", jobOf(doc.value));
  if (answer && !answer.error) message.value = null;
}

/** Whether a box of text has the keyboard, which undoes and pastes itself. */
function isTyping(e: Event): boolean {
  return e.target instanceof HTMLInputElement && e.target.type === "text";
}

export function keys(e: KeyboardEvent): void {
  if (!(e.ctrlKey || e.metaKey) || isTyping(e)) return;
  const name = e.key.toLowerCase();
  if (name === "z" && !e.shiftKey) undo();
  else if (name === "y" || (name === "z" && e.shiftKey)) redo();
  else return;
  e.preventDefault();
}

export function pasted(e: ClipboardEvent): void {
  if (isTyping(e)) return;
  const text = e.clipboardData?.getData("text/plain") ?? "";
  if (text.trim() !== "") void opened("pasted.csv", text);
}

export function App() {
  const w = words();
  const dropped = (e: DragEvent) => {
    e.preventDefault();
    const file = e.dataTransfer?.files[0];
    if (file) void take(file);
  };
  return (
    <main onDragOver={(e) => e.preventDefault()} onDrop={dropped}>
      <header>
        <h1>{w.title}</h1>
        <span id="name">{doc.value.name}</span>
        <CurveChoice />
        <button id="new" title={w.newHint} onClick={() => empty(documentOf("points", []))}>{w.newDocument}</button>
        <label class="button" title={w.openHint}>{w.open}
          <input id="file" type="file" onChange={(e) => { const f = e.currentTarget.files?.[0]; if (f) void take(f); e.currentTarget.value = ""; }} />
        </label>
        <SaveChoice />
        <button id="copy" title={w.copyHint} onClick={() => { void navigator.clipboard.writeText(pointsCsv(doc.value)).then(() => { message.value = w.copied; }); }}>{w.copyPoints}</button>
        <button id="undo" disabled={!canUndo.value} onClick={undo} title={w.undoHint}>{w.undo}</button>
        <button id="redo" disabled={!canRedo.value} onClick={redo} title={w.redoHint}>{w.redo}</button>
        <button id="fit" onClick={showAll} title={w.fitHint}>{w.fit}</button>
        <span class="space" />
        <button id="theme" title={w.themeHint} onClick={() => { theme.value = theme.value === "dark" ? "light" : "dark"; }}>{w.theme}</button>
        <button id="language" title={w.languageHint} onClick={() => { language.value = language.value === "en" ? "uk" : "en"; document.documentElement.lang = language.value; }}>{w.language}</button>
      </header>
      <Verdict />
      {message.value ? <p id="message" role="alert"><span>{message.value}</span> <button id="dismiss" title={w.dismiss} aria-label={w.dismiss} onClick={() => { message.value = null; }}>✕</button></p> : null}
      <div id="work">
        <div id="pictures">
          <Drawing />
          <div id="shown">
            <select id="what" aria-label={w.comb} title={w.whatHint} value={shown.value} onChange={(e) => { shown.value = e.currentTarget.value as Shown; }}>
              <option value="curvature">{w.curvature}</option><option value="slope">{w.slope}</option><option value="radius">{w.radiusPlot}</option>
            </select>
            <label title={w.combScale}>{w.comb} <input id="comb" type="range" min="0" max="3" step="0.05" value={combHeight.value} onInput={(e) => { combHeight.value = Number(e.currentTarget.value); }} /></label>
            <label title={w.combEveryHint}>{w.combEvery} <input id="every" type="range" min="1" max="8" step="1" value={9 - combEvery.value} onInput={(e) => { combEvery.value = 9 - Number(e.currentTarget.value); }} /></label>
            <label title={w.shadeRegionHint}><input id="shade" type="checkbox" checked={shadesRegion.value} onChange={(e) => { shadesRegion.value = e.currentTarget.checked; }} /> {w.shadeRegion}
              {shadesRegion.value && magnification.value !== null ? <span id="magnified"> × {magnification.value}</span> : null}</label>
            <label title={w.snapHint}><input id="snap" type="checkbox" checked={snaps.value} onChange={(e) => { snaps.value = e.currentTarget.checked; }} /> {w.snap}</label>
            <Below />
            {fitted.value && current.value && !fitted.value.answer.curve && drawn.value ? <span class="hint">{w.greyed}</span> : null}
            {fitted.value?.answer.error && fitted.value.answer.error.category === 4
              ? <button id="why" title={w.whyNotHint} onClick={() => void whyNot()}>{w.whyNot}</button> : null}
          </div>
          <Plot />
        </div>
        <aside><OptionsPanel /><PointPanel /><Tables />
          {theEngine().inPage ? <p class="panel hint" id="in-page">{w.inPage}</p> : null}</aside>
      </div>
      <Preview />
      <Tour />
    </main>
  );
}

function Tour() {
  const w = words(), step = tourStep.value;
  if (step === null) return null;
  const last = step + 1 === w.tour.length;
  const end = () => {
    tourStep.value = null;
    try { window.localStorage.setItem("obvid-tour", "done"); } catch { /* then it comes again */ }
  };
  return (
    <div id="tour" role="dialog" aria-label={w.title}>
      <p>{w.tour[step]}</p>
      <button id="tour-next" onClick={() => (last ? end() : (tourStep.value = step + 1))}>{last ? w.done : w.next}</button>
      {last ? null : <button id="tour-end" onClick={end}>✕</button>}
    </div>
  );
}
