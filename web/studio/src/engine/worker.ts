// SPDX-License-Identifier: Apache-2.0
// The worker of the engine within the page. Before it stands what emscripten made.

import type { FromWorker, ToWorker } from "./wasm";

interface Program {
  readonly HEAPU8: Uint8Array; // another one whenever the memory has grown
  _malloc(size: number): number;
  _free(at: number): void;
  _obvid_web_answer(kind: number, request: number): number;
  UTF8ToString(at: number): string;
}
interface Options {
  readonly printErr: (text: string) => void;
  readonly instantiateWasm: (imports: WebAssembly.Imports, done: (made: WebAssembly.Instance) => void) => object;
}
declare function createEngine(options: Options): Promise<Program>;

const WARMING = 25; // fits until browsers have compiled the program for speed

const tell = (message: FromWorker): void => self.postMessage(message);

async function unpacked(packed: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(packed), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

function asked(program: Program, kind: string, request: string): string {
  const put = (text: string): number => {
    const bytes = new TextEncoder().encode(text), at = program._malloc(bytes.length + 1);
    if (at === 0) throw new Error("out of memory");
    program.HEAPU8.set(bytes, at);
    program.HEAPU8[at + bytes.length] = 0;
    return at;
  };
  const name = put(kind), body = put(request);
  const answer = program._obvid_web_answer(name, body);
  program._free(name);
  program._free(body);
  if (answer === 0) throw new Error("out of memory");
  const text = program.UTF8ToString(answer);
  program._free(answer);
  return text;
}

/** Between two of these the worker listens. */
function warm(program: Program, left: number): void {
  if (left === 0) return;
  const points = Array.from({ length: 10 }, (_, i) => [Math.exp(0.1 * i) * Math.cos(0.4 * i), Math.exp(0.1 * i) * Math.sin(0.4 * i)]);
  asked(program, "fit", JSON.stringify({ points, options: {}, file: false }));
  setTimeout(() => warm(program, left - 1));
}

async function started(module: WebAssembly.Module): Promise<Program> {
  return new Promise((made, failed) => {
    const instantiateWasm: Options["instantiateWasm"] = (imports, done) => {
      WebAssembly.instantiate(module, imports).then(done, failed);
      return {};
    };
    createEngine({ printErr: () => undefined, instantiateWasm }).then(made, failed);
  });
}

let program: Promise<Program> | null = null;

self.onmessage = (e: MessageEvent<ToWorker>) => {
  const message = e.data;
  const broken = (reason: unknown) => tell({ broken: String(reason) });
  if ("packed" in message || "module" in message) {
    const begun = performance.now();
    const module = "module" in message ? Promise.resolve(message.module) : unpacked(message.packed).then((bytes) => WebAssembly.compile(bytes));
    program = module.then(started);
    Promise.all([program, module]).then(([made, compiled]) => {
      tell({ ready: performance.now() - begun, module: compiled });
      setTimeout(() => { try { warm(made, WARMING); } catch (reason) { broken(reason); } });
    }).catch(broken);
    return;
  }
  program?.then((made) => tell({ id: message.id, answer: asked(made, message.kind, message.request) })).catch(broken);
};
