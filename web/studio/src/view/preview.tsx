// SPDX-License-Identifier: Apache-2.0
// What is about to be written: shown, then saved or copied.

import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { jobText } from "../document/document";
import type { ExportAnswer } from "../engine/engine";
import { current, doc, exported, fitted, message, told, worksheet } from "../state";
import { words } from "../words/words";

const FORMATS = ["json", "step", "dxf", "svg", "csv", "nc", "xodr", "xml", "sldcrv", "swb", "obj", "ply"];
const SHEETS = ["tex", "csv", "svg", "dxf", "json"];
const MOST_LINES = 200; // shown

interface Made {
  readonly name: string;
  readonly text: string;
}
const preview = signal<{ readonly files: readonly Made[]; readonly remarks: readonly string[] } | null>(null);

async function show(choice: string): Promise<void> {
  const [kind, format] = choice.split(".") as [string, string];
  const answer: ExportAnswer = kind === "job" ? { error: null, files: [{ suffix: "", text: jobText(doc.value) }] } : kind === "sheet" ? await worksheet(format) : await exported(format);
  const base = (doc.value.name.replace(/\.[^.]*$/, "") || "contour") + (kind === "contour" ? "" : `-${kind === "job" ? "job" : "region"}`);
  if (answer.error || !answer.files || answer.files.length === 0) {
    message.value = answer.error ? told(answer.error) : words().nothing;
    return;
  }
  preview.value = {
    files: answer.files.map((file) => ({ name: `${base}${file.suffix}.${format}`, text: file.text })),
    remarks: answer.remarks ?? [],
  };
}

function save({ name, text }: Made): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type: "application/octet-stream" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

export function SaveChoice() {
  const w = words();
  return (
    <select id="save" aria-label={w.save} title={w.saveHint} value=""
      onChange={(e) => { const choice = e.currentTarget.value; e.currentTarget.value = ""; if (choice) void show(choice); }}>
      <option value="">{w.save} ...</option>
      <option value="job.json">{w.jobFile}</option>
      <optgroup label={w.contourFiles} disabled={!current.value || !fitted.value?.answer.contour}>{FORMATS.map((f) => <option value={`contour.${f}`}>.{f}</option>)}</optgroup>
      <optgroup label={w.sheetFiles}>{SHEETS.map((f) => <option value={`sheet.${f}`}>.{f}</option>)}</optgroup>
    </select>
  );
}

function Picture(props: { text: string; name: string }) {
  const ref = useRef<HTMLImageElement>(null);
  useEffect(() => {
    const address = URL.createObjectURL(new Blob([props.text], { type: "image/svg+xml" }));
    ref.current!.src = address;
    return () => URL.revokeObjectURL(address);
  }, [props.text]);
  return <img ref={ref} alt={props.name} />;
}

export function Preview() {
  const w = words(), made = preview.value, ref = useRef<HTMLButtonElement>(null);
  useEffect(() => { if (made) ref.current?.focus(); }, [made]);
  if (!made) return null;
  const close = () => { preview.value = null; };
  const first = made.files[0]!;
  const copy = () => navigator.clipboard.writeText(made.files.map((f) => f.text).join("\n")).then(() => { message.value = w.copied; }, (e: unknown) => { message.value = String(e); });
  return (
    <div id="preview" role="dialog" aria-modal="true" aria-label={w.previewOf} onKeyDown={(e) => { if (e.key === "Escape") close(); }}>
      <h2>{w.previewOf}: {made.files.map((f) => `${f.name} (${new Blob([f.text]).size} B)`).join(", ")}</h2>
      {made.remarks.map((remark) => <p class="hint">{remark}</p>)}
      <div id="preview-text" tabIndex={0}>
        {first.name.endsWith(".svg") ? <Picture text={first.text} name={first.name} /> : <pre>{first.text.split("\n").slice(0, MOST_LINES).join("\n")}</pre>}
      </div>
      {first.text.split("\n").length > MOST_LINES && !first.name.endsWith(".svg")
        ? <p class="hint">{w.previewLines.replace("{n}", String(first.text.split("\n").length))}</p> : null}
      <button id="preview-save" ref={ref} onClick={() => { made.files.forEach(save); close(); }}>{w.saveIt}</button>{" "}
      <button id="preview-copy" onClick={() => void copy()}>{w.copyIt}</button>{" "}
      <button id="preview-close" onClick={close}>{w.close}</button>
    </div>
  );
}
