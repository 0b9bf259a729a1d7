// SPDX-License-Identifier: Apache-2.0
// The curvature over arc length, with one cursor for the plot and the drawing.
import { useEffect, useRef } from "preact/hooks";
import { effect } from "@preact/signals";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { doc, drawn, hovered, shown } from "../state";
import { lengths, parts, values } from "./comb";
import { colour } from "./paint";
import { theme } from "./theme";
import { language, words } from "../words/words";

function unitOf(units: string): string {
  return shown.value === "curvature" ? `1/${units}` : shown.value === "slope" ? `1/${units}²` : units;
}

/** Figures at the ticks, as many digits as tell two of them apart. */
function marked(_: uPlot, ticks: number[], _axis: number, _space: number, step: number): string[] {
  const largest = Math.max(...ticks.map(Math.abs), step), digits = Math.min(15, Math.ceil(Math.log10(largest / step)) + 2);
  return ticks.map((t) => String(Number((Math.round(t / step) * step).toPrecision(digits))));
}

const MOST_MEDIANS = 4; // of a radius that is shown: those of nearly straight places have no end

/** From the least to the largest radius, but for those that would flatten the others. */
function heights(all: readonly (number | null | undefined)[]): [number, number] {
  const radii = all.filter((v): v is number => typeof v === "number"), sizes = radii.map(Math.abs).sort((a, b) => a - b);
  const most = MOST_MEDIANS * (sizes[sizes.length >> 1] ?? 0);
  let [low, high] = [most, -most];
  for (const v of radii) [low, high] = [Math.min(low, Math.max(v, -most)), Math.max(high, Math.min(v, most))];
  const room = 0.05 * (high - low || Math.abs(high) || 1);
  return [low - room, high + room];
}

function options(width: number, height: number): uPlot.Options {
  const w = words(), what = shown.value === "curvature" ? w.curvature : shown.value === "slope" ? w.slope : w.radiusPlot;
  const axis = { stroke: colour("ink"), grid: { stroke: colour("grid") }, ticks: { stroke: colour("grid") } };
  return {
    width, height, legend: { show: false },
    scales: { x: { time: false }, y: shown.value === "radius" ? { range: (u) => heights(Array.from(u.data[1] ?? [])) } : {} },
    axes: [
      { ...axis, label: `${w.arcLength}, ${doc.value.units}`, labelSize: 18, size: 34, values: marked },
      { ...axis, label: `${what}, ${unitOf(doc.value.units)}`, labelSize: 18, size: 78, values: marked },
    ],
    series: [{}, { stroke: colour("rising"), width: 1.8, pxAlign: 0, points: { show: false } }],
    cursor: { drag: { x: false, y: false }, points: { size: 8, fill: colour("accent") } },
    hooks: { setCursor: [(u) => { if (!moving) hovered.value = u.cursor.idx ?? null; }] },
  };
}

let moving = false; // the cursor of the plot is put where the drawing says

export function Plot() {
  const ref = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const box = ref.current!;
    let plot: uPlot | null = null, made = "";
    const draw = () => {
      const curve = drawn.value?.curve;
      const look = [theme.value, language.value, shown.value, doc.value.units].join();
      if (!curve || box.clientWidth === 0) return;
      const all = values(curve, shown.value);
      const data: uPlot.AlignedData = [lengths(curve), all.map((v, i) => (Number.isFinite(v) && !parts(all, shown.value, i) ? v : null))];
      if (!plot || look !== made) {
        plot?.destroy();
        plot = new uPlot(options(box.clientWidth, box.clientHeight), data, box);
        made = look;
      } else {
        plot.setData(data);
      }
    };
    const stop = effect(draw);
    const stopCursor = effect(() => {
      const i = hovered.value;
      if (!plot || plot.cursor.idx === i) return;
      moving = true;
      const x = i === null ? undefined : plot.data[0]?.[i], y = i === null ? undefined : plot.data[1]?.[i];
      plot.setCursor(x === undefined ? { left: -10, top: -10 }
        : { left: plot.valToPos(x, "x"), top: plot.valToPos(y ?? 0, "y") });
      moving = false;
    });
    const resized = new ResizeObserver(() => plot?.setSize({ width: box.clientWidth, height: box.clientHeight }));
    resized.observe(box);
    return () => {
      stop();
      stopCursor();
      resized.disconnect();
      plot?.destroy();
    };
  }, []);
  const step = (e: KeyboardEvent) => {
    const last = (drawn.value?.curve?.t.length ?? 0) - 1, by = e.shiftKey ? 10 : 1, at = hovered.value ?? 0;
    const to = { ArrowLeft: at - by, ArrowRight: at + by, Home: 0, End: last }[e.key];
    if (to === undefined || last < 0) return;
    hovered.value = Math.max(0, Math.min(last, to));
    e.preventDefault();
  };
  return <div id="plot" ref={ref} tabIndex={0} role="application" aria-label={words().plotHint} title={words().plotHint} onKeyDown={step} />;
}
