// SPDX-License-Identifier: Apache-2.0
import { effect, signal } from "@preact/signals";

export type Theme = "light" | "dark";

const usual: Theme = window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
export const theme = signal<Theme>(usual);
effect(() => { document.documentElement.dataset["theme"] = theme.value; });
