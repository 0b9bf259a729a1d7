// SPDX-License-Identifier: Apache-2.0
// Controls of what lies below the contour.

import { doc, drawn } from "../state";
import { NumberBox } from "./panels";
import { apart, kept, picture, scaled, scaling } from "./underlay";
import { figure } from "../words/figures";
import { words } from "../words/words";

export function Below() {
  const w = words(), below = picture.value, clicked = scaling.value;
  const stop = () => { picture.value = null; scaling.value = null; };
  const take = (length: number | null) => {
    if (below && clicked && length !== null) picture.value = scaled(below, clicked, length);
    scaling.value = null;
  };
  return (
    <>
      <label title={w.keepHint}><input id="keep" type="checkbox" checked={kept.value !== null} disabled={!drawn.value?.curve}
        onChange={(e) => { kept.value = e.currentTarget.checked ? drawn.value?.curve ?? null : null; }} /> {w.keep}
        {apart.value === null ? null : <span id="apart"> {w.apart} {figure(apart.value)} {doc.value.units}</span>}</label>
      {below ? (
        <span id="below">{w.picture}{" "}
          <button id="scale" title={w.setScaleHint} onClick={() => { scaling.value = []; }}>{w.setScale}</button>
          {clicked && clicked.length < 2 ? <span class="hint"> {w.clickTwo}</span> : null}
          {clicked && clicked.length === 2
            ? <label> {w.howFar} <NumberBox id="length" min={0} value={null} onValue={take} /></label> : null}
          {" "}<button id="no-picture" onClick={stop}>{w.remove}</button>
        </span>
      ) : null}
    </>
  );
}
