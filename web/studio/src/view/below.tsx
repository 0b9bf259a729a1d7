// SPDX-License-Identifier: Apache-2.0
// Controls of what lies below the contour.

import { current, doc, fitted, message, told } from "../state";
import { NumberBox } from "./panels";
import { apart, keep, kept, picture, scaled, scaling } from "./underlay";
import { figure } from "../words/figures";
import { words } from "../words/words";

async function overlay(file: File): Promise<void> {
  const error = await keep(await file.text(), file.name);
  if (error) message.value = told(error);
}

export function Below() {
  const w = words(), below = picture.value, clicked = scaling.value, contour = fitted.value?.answer.contour;
  const stop = () => { picture.value = null; scaling.value = null; };
  const take = (length: number | null) => {
    if (below && clicked && length !== null) picture.value = scaled(below, clicked, length);
    scaling.value = null;
  };
  return (
    <>
      <label title={w.keepHint}><input id="keep" type="checkbox" checked={kept.value !== null} disabled={kept.value === null && !(current.value && contour)}
        onChange={(e) => { if (e.currentTarget.checked && contour) void keep(contour, "contour.json"); else kept.value = null; }} /> {w.keep}
        {apart.value === null ? null : <span id="apart"> {w.apart} {figure(apart.value)} {doc.value.units}</span>}</label>
      <label class="button" title={w.overlayHint}>{w.overlay}
        <input id="overlay" type="file" onChange={(e) => { const f = e.currentTarget.files?.[0]; if (f) void overlay(f); e.currentTarget.value = ""; }} />
      </label>
      {below ? (
        <span id="below" title={w.pictureHint}>{w.picture}{" "}
          <button id="scale" title={w.setScaleHint} onClick={() => { scaling.value = []; }}>{w.setScale}</button>
          {clicked && clicked.length < 2 ? <span class="hint"> {w.clickTwo}</span> : null}
          {clicked && clicked.length === 2
            ? <label title={w.setScaleHint}> {w.howFar} <NumberBox id="length" min={0} value={null} onValue={take} /></label> : null}
          {" "}<button id="no-picture" title={w.remove} onClick={stop}>{w.remove}</button>
        </span>
      ) : null}
    </>
  );
}
