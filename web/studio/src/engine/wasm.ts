// SPDX-License-Identifier: Apache-2.0
// The engine within the page: the C interface compiled to WebAssembly, in workers of its own, so that
// the page is never blocked. tools/build_web puts its code into the page.

import { CANCELLED, type Engine, type EngineError, type Kind, type Request } from "./engine";

/** To a worker: its program first, packed or as another worker compiled it, then requests. */
export type ToWorker =
  | { readonly packed: string }
  | { readonly module: WebAssembly.Module }
  | { readonly id: number; readonly kind: Kind; readonly request: string };
/** From a worker: that it is ready, with its program, an answer, or that it broke down. */
export type FromWorker =
  | { readonly ready: number; readonly module: WebAssembly.Module }
  | { readonly id: number; readonly answer: string }
  | { readonly broken: string };

/** What tools/build_web embedded: the worker's script, and the program (gzip, base64). */
export interface Embedded {
  readonly script: string;
  readonly packed: string;
}

export function embedded(): Embedded | null {
  const script = document.getElementById("engine-script"), packed = document.getElementById("engine-program");
  return script && packed ? { script: script.textContent ?? "", packed: packed.textContent ?? "" } : null;
}

/** What workers run, and what the first of them made of it. */
interface Program {
  readonly packed: string;
  module: WebAssembly.Module | null;
}

interface Waiting {
  readonly id: number;
  readonly kind: Kind;
  readonly request: string;
  readonly done: (answer: unknown) => void;
  readonly failed: (reason: Error) => void;
}

/** Milliseconds after which a request is given up for a newer one of its kind: its worker with it. Shorter, a drag
 * of a contour that takes so long would never show one. */
const PATIENCE = 3000;

const OLDER: EngineError =
  { code: CANCELLED, category: 1, message: "cancelled", where: "", advice: "", points: [] };

/** One worker: answers one request after another; of two that wait, the newer of a kind stays. One that
 * takes long ends when a newer one of its kind comes, or when it is asked to. */
class Line {
  private worker: Worker | null = null;
  private running: Waiting | null = null;
  private waiting: Waiting[] = [];
  private count = 0;
  private begun = 0;
  private runningSince = 0;
  private late: ReturnType<typeof setTimeout> | undefined;
  /** Milliseconds from the start of the first worker until it could answer. */
  startup: number | null = null;

  constructor(private readonly address: string, private readonly program: Program) {
    this.start();
  }

  ask(kind: Kind, request: string): Promise<unknown> {
    return new Promise((done, failed) => {
      for (const older of this.waiting.filter((one) => one.kind === kind)) older.done({ error: OLDER });
      this.waiting = this.waiting.filter((one) => one.kind !== kind);
      this.waiting.push({ id: ++this.count, kind, request, done, failed });
      if (this.running?.kind === kind) this.endSoon();
      this.next();
    });
  }

  /** Ends what runs once it has had its time. */
  private endSoon(): void {
    if (this.late !== undefined || this.worker === null) return;
    const left = PATIENCE - (performance.now() - this.runningSince);
    this.late = setTimeout(() => {
      this.late = undefined;
      if (this.program.module === null) return; // the program is compiled once for all: not given up
      const older = this.running;
      this.running = null;
      this.worker?.terminate();
      this.worker = null;
      older?.done({ error: OLDER });
      this.next();
    }, Math.max(0, left));
  }

  private start(): Worker {
    const worker = new Worker(this.address);
    this.begun = performance.now();
    worker.onmessage = (e: MessageEvent<FromWorker>) => this.heard(e.data);
    worker.onerror = (e) => {
      e.preventDefault();
      this.broke(e.message);
    };
    const { module, packed } = this.program;
    worker.postMessage((module ? { module } : { packed }) satisfies ToWorker);
    this.worker = worker;
    return worker;
  }

  private next(): void {
    if (this.running) return;
    const one = this.waiting.shift();
    if (!one) return;
    this.running = one;
    this.runningSince = performance.now();
    const message: ToWorker = { id: one.id, kind: one.kind, request: one.request };
    (this.worker ?? this.start()).postMessage(message);
  }

  private heard(message: FromWorker): void {
    if ("ready" in message) {
      this.startup ??= performance.now() - this.begun;
      this.program.module = message.module;
    } else if ("broken" in message) {
      this.broke(message.broken);
    } else if (message.id === this.running?.id) {
      const { done } = this.running;
      this.running = null;
      clearTimeout(this.late);
      this.late = undefined;
      done(JSON.parse(message.answer));
      this.next();
    }
  }

  /** What memory it holds is lost with it; the next request starts another. */
  private broke(why: string): void {
    this.worker?.terminate();
    this.worker = null;
    clearTimeout(this.late);
    this.late = undefined;
    const lost = this.running;
    this.running = null;
    lost?.failed(new Error(why));
    this.next();
  }
}

/** What a drag waits for; everything else has a worker of its own and delays no drag. */
const WHILE_DRAGGING: readonly Kind[] = ["fit", "region"];

export class WasmEngine implements Engine {
  readonly inPage = true;
  private readonly quick: Line;
  private readonly program: Program;
  private slow: Line | null = null;

  constructor(private readonly parts: Embedded) {
    this.program = { packed: parts.packed, module: null };
    this.quick = this.line();
  }

  /** Milliseconds until the engine could answer; null before. */
  get startup(): number | null {
    return this.quick.startup;
  }

  async call<T>(kind: Kind, request: Request): Promise<T> {
    const line = WHILE_DRAGGING.includes(kind) ? this.quick : (this.slow ??= this.line());
    return (await line.ask(kind, JSON.stringify(request))) as T;
  }

  async opened(): Promise<null> {
    return null;
  }

  private line(): Line {
    const address = URL.createObjectURL(new Blob([this.parts.script], { type: "text/javascript" }));
    return new Line(address, this.program);
  }
}
