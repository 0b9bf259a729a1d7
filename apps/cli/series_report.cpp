// SPDX-License-Identifier: Apache-2.0
#include "series_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "fit_report.h"
#include "obvid/core/units.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A chord whose direction rounding decides has none.
const char* change_text(const std::optional<int>& change) {
  return change ? direction_text(*change) : "undecided";
}

double degrees(double rad) { return rad / kOneDegree; }

std::string to_next(const Analysis& analysis, std::size_t point) {
  return point < analysis.chords.size() ? significant(analysis.chords[point].length) : "";
}

/// Of three points on a line but for the digits of their coordinates, or within a billionth of the
/// size: "straight".
std::string adjacent_radius(const PointSeries& series, const Analysis& analysis,
                            std::size_t point) {
  constexpr double kStraight = 1e-9;  // of the size
  const double length = analysis.chords[point - 1].length + analysis.chords[point].length;
  return radius_over(analysis.circles[point].kappa, length,
                     std::max(kStraight * analysis.size, 2.0 * norm(series.rounding)));
}

Table point_table(const PointSeries& series, const Analysis& analysis) {
  Table table;
  table.column("point");
  table.column("adjacent\nradius");
  table.column("turning,\ndegrees");
  table.column("chord to\nthe next");
  table.column("curvature\nalong it", Table::Align::kLeft);
  table.column("points-only\nerror");
  std::vector<double> worst = analysis.points_only_error;
  worst.resize(analysis.circles.size(), kNan);
  add_rows_worth_showing(worst, table, [&](std::size_t i) {
    const bool chord = i < analysis.chords.size();
    const bool end = i == 0 || i + 1 == analysis.circles.size();
    table.row({std::to_string(i + 1), end ? "-" : adjacent_radius(series, analysis, i),
               significant(degrees(turning_at(analysis, i)), 4), to_next(analysis, i),
               chord ? change_text(analysis.change[i]) : "",
               chord ? significant(analysis.points_only_error[i], 4) : ""});
  });
  return table;
}

std::string runs_text(const Analysis& analysis) {
  constexpr std::size_t kMost = 12;
  std::string text = counted(analysis.runs.size(), "run", "runs");
  if (analysis.runs.size() > kMost) return text;
  for (std::size_t i = 0; i < analysis.runs.size(); ++i) {
    const SeriesRun& run = analysis.runs[i];
    text += fmt::format("{} {}-{} {}", i == 0 ? ": points" : ",", run.first_chord + 1,
                        run.last_chord + 2, direction_text(run.direction));
  }
  return text;
}

std::string with_bound(int now, const std::string& bound) {
  return fmt::format("{} ({})", now, bound);
}

}  // namespace

Facts series_facts(const PointSeries& series, const Analysis& analysis) {
  Facts facts;
  facts.add("size", significant(analysis.size) + " " + series.units.text());
  facts.add("curvature", runs_text(analysis));
  facts.add("vertices",
            with_bound(analysis.vertices, vertex_bound_text(analysis.vertices_lower_bound)));
  facts.add("inflections",
            with_bound(analysis.inflections, bound_text(analysis.inflections_lower_bound)));
  facts.add("largest turning", significant(degrees(analysis.largest_turning), 4) + " degrees");
  for (const CircularStretch& stretch : analysis.stretches) {
    facts.add(stretch.kappa == 0.0 ? "straight" : "circular",
              fmt::format("points {}-{}", stretch.first + 1, stretch.last + 1));
  }
  return facts;
}

std::string series_report_text(const PointSeries& series, const Analysis& analysis) {
  std::vector<double> worst = analysis.points_only_error;
  worst.resize(analysis.circles.size(), kNan);
  std::string out = series.name.empty() ? "" : bold(series.name) + "\n";
  out += fmt::format("lengths in {}; radius positive where the points turn left\n\n",
                     series.units.text());
  out += point_table(series, analysis).text();
  out += shown_note(rows_worth_showing(worst).size(), worst.size(), "least certain", "points");
  return out + "\n" + series_facts(series, analysis).text();
}

}  // namespace obvid
