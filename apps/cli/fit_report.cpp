// SPDX-License-Identifier: Apache-2.0
#include "fit_report.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "obvid/core/internal/data_table.h"
#include "obvid/core/units.h"
#include "obvid/pipeline/internal/end_curvatures.h"
#include "obvid/pipeline/internal/lines_and_arcs.h"
#include "outputs.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Joint that stands on each input point.
std::vector<std::size_t> joints_of_points(const Contour& contour) {
  std::vector<std::size_t> joint(contour.points.size(), kNone);
  for (std::size_t j = 0; j < contour.joints.size(); ++j) {
    const auto source = contour.joints[j].source;
    if (source && *source < joint.size() && joint[*source] == kNone) joint[*source] = j;
  }
  return joint;
}

/// Pieces from one joint to another; around the seam of a closed contour the last joint is the
/// first.
std::string pieces_text(const Contour& contour, std::size_t from, std::size_t to) {
  if (from == kNone || to == kNone) return "-";
  const std::size_t end = to > from ? to : to + (contour.closed ? contour.pieces.size() : 0);
  return end > from ? std::to_string(end - from) : "-";
}

std::string points_text(const SegmentReport& segment) {
  return fmt::format("{}-{}", segment.from.value_or(0) + 1, segment.to.value_or(0) + 1);
}

Table fit_segments(const Fit& fit) {
  const Contour& contour = fit.contour;
  const std::vector<std::size_t> joint = joints_of_points(contour);
  Table table;
  table.column("points");
  table.column("chord");
  table.column("points-only\nerror");
  table.column("region\nwidth");
  table.column("inserted\nelements");
  table.column("pieces");
  table.column("radius\nat start");
  table.column("radius\nat end");
  std::vector<double> width;
  for (const SegmentReport& segment : fit.report.segments) width.push_back(segment.width);
  const std::vector<EndCurvatures> curvatures = end_curvatures(contour);
  std::size_t before = 0;
  for (const std::size_t i : rows_worth_showing(width)) {
    if (i > before) table.gap();
    before = i + 1;
    const SegmentReport& segment = fit.report.segments[i];
    const std::size_t from = joint[segment.from.value_or(0)], to = joint[segment.to.value_or(0)];
    table.row({points_text(segment), significant(segment.chord),
               significant(segment.points_only_error, 4), significant(segment.width, 4),
               std::to_string(segment.inserted), pieces_text(contour, from, to),
               radius_text(curvatures[i].start), radius_text(curvatures[i].end)});
  }
  return table;
}

/// Lines and arcs that several points lie on; empty without any.
std::string lines_and_arcs_text(const Contour& contour) {
  const std::vector<LineOrArc> all = lines_and_arcs(contour);
  if (all.empty()) return {};
  Table table;
  table.column("line or arc\npoints", Table::Align::kLeft);
  table.column("\nradius");
  table.column("centre\nx");
  table.column("\ny");
  table.column("heading\nat start");
  table.column("\nlength");
  table.column("farthest\npoint");
  std::vector<double> off;
  for (const LineOrArc& one : all) off.push_back(one.off);
  std::optional<std::size_t> before;
  const std::vector<std::size_t> shown = rows_worth_showing(off);
  for (const std::size_t i : shown) {
    if (before && i > *before + 1) table.gap();
    before = i;
    const LineOrArc& one = all[i];
    const bool line = one.kappa == 0.0;
    table.row({fmt::format("{}-{}", one.from + 1, one.to + 1), radius_text(one.kappa),
               line ? "-" : significant(one.centre.x), line ? "-" : significant(one.centre.y),
               significant(std::remainder(one.theta, kFullTurn) / kOneDegree),
               significant(one.length), significant(one.off, 4)});
  }
  return table.text() + shown_note(shown.size(), all.size(), "farthest", "lines and arcs") + "\n";
}

std::string fairness_text(const FitReport& report) {
  return fmt::format(
      "{} ({}), {}", counted(static_cast<std::size_t>(report.vertices), "vertex", "vertices"),
      vertex_bound_text(report.vertices_lower_bound),
      counted(static_cast<std::size_t>(report.inflections), "inflection", "inflections"));
}

std::string time_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.0f} us", seconds * 1e6);
  if (seconds < 1.0) return fmt::format("{:.1f} ms", seconds * 1e3);
  return fmt::format("{:.2f} s", seconds);
}

struct LargestError {
  double value = 0.0;
  bool known = false;                      // on any segment
  const SegmentReport* segment = nullptr;  // none: not known on any segment, or 0 on all

  void meet(double other, const SegmentReport& at) {
    known = known || !std::isnan(other);
    if (!(other > value)) return;  // unknown ones are not met
    value = other;
    segment = &at;
  }
};

/// What the points alone leave open, and what is left once tangents and curvatures are chosen.
std::string error_text(const FitReport& report, const std::string& units) {
  LargestError points_only;
  LargestError chosen;
  bool everywhere = true;
  for (const SegmentReport& segment : report.segments) {
    points_only.meet(segment.points_only_error, segment);
    chosen.meet(segment.deviation, segment);
    everywhere = everywhere && !std::isnan(segment.points_only_error);
  }
  // lines and circles alone say nothing of what lies between them
  if (points_only.segment == nullptr && !everywhere) points_only.known = false;
  const auto text_of = [&units](const LargestError& error) {
    return error.known ? known_length(error.value, units) : "unknown";
  };
  std::string text = text_of(points_only) + " from the points alone";
  if (points_only.segment != nullptr) {
    text += fmt::format(" (points {})", points_text(*points_only.segment));
  }
  text += fmt::format("; {} with these tangents and curvatures", text_of(chosen));
  if (chosen.segment != nullptr) {
    const Vec2 at = chosen.segment->deviation_at;
    text += fmt::format(" (points {}, at {}, {})", points_text(*chosen.segment), significant(at.x),
                        significant(at.y));
  }
  return text;
}

std::string given_text(const GivenReport& given) {
  std::vector<std::string> kinds;
  if (given.headings > 0) kinds.push_back(counted(given.headings, "heading", "headings"));
  if (given.curvatures > 0) kinds.push_back(counted(given.curvatures, "radius", "radii"));
  if (given.corners > 0) kinds.push_back(counted(given.corners, "corner", "corners"));
  const std::size_t ranges = given.heading_ranges + given.curvature_ranges;
  if (ranges > 0) kinds.push_back(counted(ranges, "range", "ranges"));
  std::string text = listed(kinds) + " met";
  std::vector<std::string> misses;
  if (given.headings + given.heading_ranges > 0)
    misses.push_back(significant(given.heading_miss, 2) + " rad");
  if (given.curvatures + given.curvature_ranges > 0) {
    misses.push_back(significant(given.curvature_miss, 2) + " of the curvature");
  }
  return misses.empty() ? text : text + "; largest miss " + listed(misses);
}

/// "at point 5 the greatest heading, at point 10 the least curvature"; "none" where the contour
/// lies inside all ranges.
std::string active_text(const std::vector<ActiveRange>& active) {
  std::string text;
  for (const ActiveRange& one : active) {
    text += fmt::format("{}at point {} the {} {}", text.empty() ? "" : ", ", one.point + 1,
                        one.high ? "greatest" : "least", one.heading ? "heading" : "curvature");
  }
  return text.empty() ? "none: the contour lies inside all ranges" : text;
}

void add_bounds(Facts& facts, const Fit& fit) {
  const FitReport& report = fit.report;
  facts.add("largest error", error_text(report, fit.contour.units.text()));
  facts.add(
      "largest width",
      fmt::format("{} (tolerance {})", known_length(report.largest_width, fit.contour.units.text()),
                  significant(report.tolerance, 4)));
  facts.add("bound needed",
            counted(report.inserted_points, "inserted element", "inserted elements"));
}

/// What stays of a drawing, and what stands between; empty for points.
std::string kept_text(const Contour& contour, const Certificate& certificate) {
  std::string text = as_drawn_text(contour);
  if (text.empty()) return text;
  const std::size_t made = contour.pieces.size() - contour.kept.size();
  text += "; " + counted(static_cast<std::size_t>(certificate.corners), "corner", "corners");
  if (certificate.curvature_steps > 0) {
    text += fmt::format(", {} with a step of the curvature",
                        counted(static_cast<std::size_t>(certificate.curvature_steps),
                                "common tangent", "common tangents"));
  }
  if (made > 0) text += "; " + counted(made, "other piece", "other pieces") + " through points";
  return text;
}

/// Where joints of a G3 contour are G2 only: the points at or before them.
std::string slope_steps_text(const Contour& contour) {
  constexpr std::size_t kMostNamed = 8;
  std::vector<std::size_t> beside;
  std::optional<std::size_t> last = contour.joints.front().source;
  for (const Joint& joint : contour.joints) {
    if (joint.source) last = joint.source;
    if (!joint.slope_step || !last) continue;
    if (beside.empty() || beside.back() != *last) beside.push_back(*last);
  }
  if (beside.empty()) return {};
  std::string out = beside.size() == 1 ? "beside point " : "beside points ";
  for (std::size_t i = 0; i < std::min(beside.size(), kMostNamed); ++i) {
    out += fmt::format("{}{}", i > 0 ? ", " : "", beside[i] + 1);
  }
  if (beside.size() > kMostNamed) {
    out += fmt::format(" and {} more", beside.size() - kMostNamed);
  }
  return out;
}

Facts summary(const Fit& fit, const Written& written) {
  const Contour& contour = fit.contour;
  const FitReport& report = fit.report;
  Facts facts;
  std::string pieces = counted(contour.pieces.size(), "piece", "pieces") + " through " +
                       counted(contour.points.size(), "point", "points");
  if (report.chain.free_elements > 0) {
    pieces += fmt::format(", {} free between them",
                          counted(report.chain.free_elements, "joint", "joints"));
  }
  facts.add("contour",
            fmt::format("{} in {}", pieces, counted(contour.runs.size(), "run", "runs")));
  if (const std::string kept = kept_text(contour, fit.certificate); !kept.empty()) {
    facts.add("taken over", kept);
  }
  facts.add("fairness", fairness_text(report));
  if (const int crossings = fit.certificate.self_intersections; crossings > 0) {
    facts.add("self-intersections", std::to_string(crossings));
  }
  if (promises_monotone(contour.carrier)) add_bounds(facts, fit);
  const GivenReport& given = report.given;
  const std::size_t ranges = given.heading_ranges + given.curvature_ranges;
  if (given.headings + given.curvatures + given.corners + ranges > 0) {
    facts.add("given data", given_text(given));
  }
  if (ranges > 0) facts.add("at an end", active_text(given.active));
  if (report.carrier_deviation && report.outside_spirals_region) {
    const double outside = *report.outside_spirals_region;
    facts.add("from the spirals",
              fmt::format("{} {} as measured, {}", significant(*report.carrier_deviation, 4),
                          contour.units.text(),
                          outside > 0.0 ? significant(outside, 4) + " outside their region"
                                        : "inside their region"));
  }
  if (report.largest_move > 0.0) {
    facts.add("largest move", significant(report.largest_move, 4) + " " + contour.units.text());
  }
  add_gaps(facts, fit.certificate, contour.carrier);
  if (report.waviness) {
    facts.add("waviness", fmt::format("{} hills of the slope of curvature on a run",
                                      significant(*report.waviness, 4)));
  }
  if (const auto before = report.chain.slope_step_g2) {
    std::string text =
        fmt::format("the slope of curvature would step by {} of the largest beside it",
                    significant(*before, 2));
    if (const auto waviness = report.chain.waviness_g2) {
      text += fmt::format(", waviness {}", significant(*waviness, 4));
    }
    facts.add("as G2 contour", text);
  }
  if (!report.chain.g2_because.empty()) facts.add("G2 because", report.chain.g2_because);
  if (const std::string steps = slope_steps_text(contour); !steps.empty()) {
    facts.add("slope steps", steps);
  }
  facts.add("time", time_text(report.seconds));
  for (const std::string& remark : written.remarks) facts.add("note", remark);
  if (!written.files.empty()) facts.add("written", listed(written.files));
  return facts;
}

}  // namespace

void add_gaps(Facts& facts, const Certificate& certificate, Carrier carrier) {
  facts.add("joint gaps", gaps_text(carrier, certificate.gaps));
}

std::string as_drawn_text(const Contour& contour) {
  const KeptPieces kept = kept_pieces(contour);
  std::string text;
  const auto add = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, one, many);
  };
  add(kept.lines, "line", "lines");
  add(kept.arcs, "arc", "arcs");
  add(kept.ellipses, "arc of an ellipse", "arcs of ellipses");
  add(kept.clothoids, "clothoid", "clothoids");
  return text.empty() ? text : text + " as drawn";
}

std::string fit_report_csv(const Fit& fit) {
  DataTable out{heads_of(
      "from,to,chord,points_only_error,width,deviation,inserted,pieces,kappa_start,kappa_end")};
  const std::vector<std::size_t> joint = joints_of_points(fit.contour);
  const std::vector<EndCurvatures> curvatures = end_curvatures(fit.contour);
  for (std::size_t i = 0; i < fit.report.segments.size(); ++i) {
    const SegmentReport& s = fit.report.segments[i];
    const std::string pieces =
        pieces_text(fit.contour, joint[s.from.value_or(0)], joint[s.to.value_or(0)]);
    out.rows.push_back({s.from.value_or(0) + 1, s.to.value_or(0) + 1, finite_cell(s.chord),
                        finite_cell(s.points_only_error), finite_cell(s.width),
                        finite_cell(s.deviation), s.inserted,
                        pieces == "-" ? DataCell() : DataCell(pieces),
                        finite_cell(curvatures[i].start), finite_cell(curvatures[i].end)});
  }
  return csv_text(out);
}

std::string fit_report_text(const std::string& name, const Fit& fit, const Written& written) {
  const FitReport& report = fit.report;
  std::vector<double> width;
  for (const SegmentReport& segment : report.segments) width.push_back(segment.width);
  std::string out;
  if (!name.empty()) out += bold(name) + "\n";
  out += fmt::format("lengths in {}; radius positive where the contour turns left\n\n",
                     fit.contour.units.text());
  out += fit_segments(fit).text();
  out += shown_note(rows_worth_showing(width).size(), width.size(), "widest", "segments");
  out += "\n" + lines_and_arcs_text(fit.contour) + summary(fit, written).text();
  const std::string verdict = verdict_line(fit.contour.carrier, fit.certificate);
  return out + (fit.certificate.proved ? good(verdict) : bad(verdict)) + "\n";
}

}  // namespace obvid
