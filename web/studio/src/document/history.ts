// SPDX-License-Identifier: Apache-2.0
// Undo and redo without end over values that are never changed.

export interface History<T> {
  readonly past: readonly T[];
  readonly now: T;
  readonly future: readonly T[];
}

export function begun<T>(now: T): History<T> {
  return { past: [], now, future: [] };
}

export function did<T>(h: History<T>, next: T): History<T> {
  return next === h.now ? h : { past: [...h.past, h.now], now: next, future: [] };
}

export function undone<T>(h: History<T>): History<T> {
  const last = h.past[h.past.length - 1];
  if (last === undefined) return h;
  return { past: h.past.slice(0, -1), now: last, future: [h.now, ...h.future] };
}

export function redone<T>(h: History<T>): History<T> {
  const next = h.future[0];
  if (next === undefined) return h;
  return { past: [...h.past, h.now], now: next, future: h.future.slice(1) };
}
