// SPDX-License-Identifier: Apache-2.0
#include "element_table.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "table.h"
#include "text.h"

namespace obvid {
namespace {

/// Degrees, never 360.
std::string azimuth_text(double theta) {
  std::string text = fmt::format("{:.4f}", azimuth_deg(theta));
  return text == "360.0000" ? "0.0000" : text;
}

/// Of elements that a line replaces within a billionth of the size: "straight".
std::string element_radius(double kappa, double length, double size) {
  constexpr double kStraight = 1e-9;  // sagitta, of the size
  if (!std::isfinite(kappa)) return "-";
  return radius_over(kappa, length, kStraight * size);
}

}  // namespace

std::string elements_text(const std::vector<AlignmentElement>& elements, double size,
                          const std::optional<SpeedLimit>& limit) {
  Table table;
  table.column("element");
  table.column("kind", Table::Align::kLeft);
  for (const char* head : {"station", "length", "radius\nat start", "radius\nat end"}) {
    table.column(head);
  }
  table.column_if_told("A");
  for (const char* head : {"azimuth\ndegrees", "\nx", "\ny"}) table.column(head);
  if (limit) table.column("speed\nkm/h");
  table.column("", Table::Align::kLeft);
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const AlignmentElement& e = elements[k];
    const double parameter = clothoid_parameter(e);
    std::vector<std::string> cells{std::to_string(k + 1),
                                   to_string(e.kind),
                                   coordinate(e.station, size),
                                   coordinate(e.length, size),
                                   element_radius(e.start.kappa, e.length, size),
                                   element_radius(e.kappa1, e.length, size),
                                   parameter > 0.0 ? significant(parameter, 5) : "-",
                                   azimuth_text(e.start.theta),
                                   coordinate(e.start.point.x, size),
                                   coordinate(e.start.point.y, size)};
    if (limit) {
      const auto speed = speed_kmh(e, *limit);
      cells.push_back(speed ? significant(*speed, 4) : "-");
    }
    cells.emplace_back(e.step ? "curvature steps here" : "");
    table.row(std::move(cells));
  }
  return table.text();
}

std::string profile_text(const VerticalProfile& profile, double size) {
  constexpr double kPercent = 100.0;
  Table table;
  table.column("element");
  table.column("kind", Table::Align::kLeft);
  for (const char* head : {"station", "length", "height", "grade\nat start %", "grade\nat end %"}) {
    table.column(head);
  }
  for (const char* head : {"radius", "K"}) table.column_if_told(head);
  for (std::size_t k = 0; k < profile.elements.size(); ++k) {
    const ProfileElement& e = profile.elements[k];
    const bool bends = e.kind != ProfileKind::kGrade;
    // length for a change of the grade of one percent
    const double change = kPercent * std::abs(e.grade1 - e.grade0);
    table.row({std::to_string(k + 1), to_string(e.kind), coordinate(e.station, size),
               coordinate(e.length, size), coordinate(e.height, size),
               fmt::format("{:.4f}", kPercent * e.grade0),
               fmt::format("{:.4f}", kPercent * e.grade1), bends ? significant(e.radius, 5) : "-",
               bends && change > 0.0 ? significant(e.length / change, 4) : "-"});
  }
  return table.text();
}

}  // namespace obvid
