// SPDX-License-Identifier: Apache-2.0
#include "fit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "obvid/core/internal/data_table.h"
#include "obvid/core/units.h"
#include "obvid/pipeline/internal/end_curvatures.h"
#include "obvid/pipeline/internal/fit_figures.h"
#include "obvid/pipeline/internal/lines_and_arcs.h"
#include "outputs.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

/// Pieces of a part whose ends are joints.
std::string pieces_text(const EndCurvatures& row) {
  return row.pieces > 0 ? std::to_string(row.pieces) : "-";
}

/// How far a line may be off what is called straight: a hundredth of what the points may be off,
/// where they say no curvature any more, and at least a billionth of the size, as in tables of
/// elements.
double straight_within(const Contour& contour) {
  constexpr double kOfTolerance = 1e-2, kOfSize = 1e-9;
  double tolerance = HUGE_VAL;
  for (const double one : contour.point_tolerance) tolerance = std::min(tolerance, one);
  if (contour.point_tolerance.empty()) tolerance = 0.0;
  return std::max(kOfTolerance * tolerance, kOfSize * bounding_diagonal(contour.points));
}

Table fit_segments(const Fit& fit) {
  const Contour& contour = fit.contour;
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
  const double within = straight_within(contour);
  add_rows_worth_showing(width, table, [&](std::size_t i) {
    const SegmentReport& segment = fit.report.segments[i];
    table.row({points_of_segment(segment), significant(segment.chord),
               significant(segment.points_only_error, 4), significant(segment.width, 4),
               std::to_string(segment.inserted), pieces_text(curvatures[i]),
               radius_over(curvatures[i].start, segment.chord, within),
               radius_over(curvatures[i].end, segment.chord, within)});
  });
  return table;
}

/// Points of a line or arc, in order along the contour; around a whole circle they are all.
std::string points_on_text(const LineOrArc& one) {
  if (one.from == one.to) return fmt::format("all, from {}", one.from + 1);
  return fmt::format("{}-{}", one.from + 1, one.to + 1);
}

/// A coordinate of a centre; below the rounding of what it was computed from it is 0.
std::string centre_text(double value, const LineOrArc& one) {
  constexpr double kRounding = 1e-14;
  const double size = 1.0 / std::abs(one.kappa) + norm(one.centre);
  return significant(std::abs(value) <= kRounding * size ? 0.0 : value);
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
  const std::size_t shown = add_rows_worth_showing(off, table, [&](std::size_t i) {
    const LineOrArc& one = all[i];
    const bool line = one.kappa == 0.0;
    table.row({points_on_text(one), radius_text(one.kappa),
               line ? "-" : centre_text(one.centre.x, one),
               line ? "-" : centre_text(one.centre.y, one), significant(one.heading_deg()),
               significant(one.length), significant(one.off, 4)});
  });
  return table.text() + shown_note(shown, all.size(), "farthest", "lines and arcs") + "\n";
}

Facts summary(const Fit& fit, const Written& written) {
  Facts facts;
  for (auto& [label, value] : fit_figures(fit.contour, fit.report, fit.certificate)) {
    facts.add(std::move(label), std::move(value));
  }
  for (const std::string& remark : written.remarks) facts.add("note", remark);
  if (!written.files.empty()) facts.add("written", listed(written.files));
  return facts;
}

}  // namespace

void add_gaps(Facts& facts, const Certificate& certificate, Carrier carrier) {
  facts.add("joint gaps", gaps_text(carrier, certificate));
}

std::string fit_report_csv(const Fit& fit) {
  DataTable out{heads_of(
      "from,to,chord,points_only_error,width,deviation,inserted,pieces,kappa_start,kappa_end")};
  const std::vector<EndCurvatures> curvatures = end_curvatures(fit.contour);
  for (std::size_t i = 0; i < fit.report.segments.size(); ++i) {
    const SegmentReport& s = fit.report.segments[i];
    const std::string pieces = pieces_text(curvatures[i]);
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
