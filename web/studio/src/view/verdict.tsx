// SPDX-License-Identifier: Apache-2.0
// What is proved of the very contour that is drawn, in one line.
import { current, fitted, told, unreachable } from "../state";
import { words } from "../words/words";
import { figure } from "../words/figures";
import { showTab } from "./panels";

export function Verdict() {
  const w = words(), answer = fitted.value?.answer;
  if (unreachable.value) return <p id="verdict" class="bad" role="status">{w.unreachable}: {unreachable.value}</p>;
  if (!answer || !current.value) return <p id="verdict" class="waiting" role="status">{w.computing}</p>;
  const report = answer.report, error = answer.error;
  if (!report) {
    return (
      <p id="verdict" class="bad" role="status">
        <b>{w.none}</b> {error ? told(error) : ""}
      </p>
    );
  }
  const { report: r, certificate: c } = report;
  const gaps = [`${figure(c.joint_gaps.heading, 2)} rad`, `κ ${figure(c.joint_gaps.curvature, 2)}`];
  if (c.joint_gaps.slope !== undefined) gaps.push(`κ′ ${figure(c.joint_gaps.slope, 2)}`);
  return (
    <p id="verdict" class={c.proved ? "good" : "bad"} role="status" onClick={() => showTab("segments")}>
      <b>{c.proved ? w.proved : w.notProved}</b>{" "}
      {c.proved ? <span>{report.continuity ?? ""}</span> : <span>{c.reason}</span>}
      <Fact name={w.vertices} hint={w.verticesHint} value={`${r.vertices} (${w.forced.replace("{n}", String(r.vertices_lower_bound))})`} />
      <Fact name={w.inflections} hint={w.inflectionsHint} value={String(r.inflections)} />
      <Fact name={w.error} hint={w.errorHint} value={`${figure(r.largest_deviation)} ${report.units}`} />
      <Fact name={w.gaps} hint={w.gapsHint} value={gaps.join(", ")} />
      {r.waviness !== null ? <Fact name={w.waviness} hint={w.wavinessHint} value={figure(r.waviness)} /> : null}
      <Fact name={w.time} hint={w.timeHint} value={`${figure(1000 * r.seconds, 3)} ms`} />
      <button id="details" title={w.detailsHint} onClick={() => showTab("segments")}>{w.segments} ▾</button>
    </p>
  );
}

function Fact(props: { name: string; hint: string; value: string }) {
  return <span class="fact" title={props.hint}><i>{props.name}</i> {props.value}</span>;
}
