// SPDX-License-Identifier: Apache-2.0
import { render } from "preact";
import "./look/look.css";
import "./studio.css";
import { LocalEngine } from "./engine/local";
import { embedded, WasmEngine } from "./engine/wasm";
import {
  compute, current, doc, fitted, hovered, region, selected, unreachable, useEngine,
} from "./state";
import { App, keys, opened, pasted } from "./view/app";
import { bendPlace, onScreen as place, showAll } from "./view/drawing";
import { adjacentOf as adjacent } from "./view/adjacent";
import { marks } from "./view/comb";
import { regions } from "./view/region";
import { kept, picture } from "./view/underlay";

const within = embedded();
const engine = within ? new WasmEngine(within) : new LocalEngine(new URL(window.location.href));
useEngine(engine);
render(<App />, document.getElementById("app")!);
window.addEventListener("keydown", keys);
window.addEventListener("paste", pasted);
engine.opened().then(
  async (file) => {
    if (file) return opened(file.name, file.text);
    compute();
    showAll();
  },
  (error: unknown) => { unreachable.value = String(error); },
);

// for tests and for scripts in the console: what the page knows, to read
Object.assign(window, { studio: { doc, fitted, current, hovered, selected, region, place, bendPlace, regions, marks, adjacent, picture, kept, engine } });
