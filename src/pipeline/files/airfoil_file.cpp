// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/airfoil_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "obvid/core/files.h"
#include "obvid/core/internal/data_table.h"
#include "obvid/exchange/internal/points/airfoil.h"
#include "obvid/io/read_points.h"
#include "obvid/pipeline/file_formats.h"

namespace obvid {

std::optional<AirfoilPointFigures> figures_of_airfoil_file(const std::string& text) {
  const auto series = parse_points(text, "airfoil.dat", {});
  if (!series || series->points.size() < 2) return std::nullopt;
  const std::vector<Vec2>& points = series->points;
  const Vec2 end = 0.5 * (points.front() + points.back());
  const Vec2 nose = *std::max_element(
      points.begin(), points.end(), [&](Vec2 a, Vec2 b) { return norm(a - end) < norm(b - end); });
  AirfoilFigures along;
  along.chord = norm(end - nose);
  if (!(along.chord > 0.0)) return std::nullopt;
  along.turn = heading(end - nose);
  along.leading_edge = nose;
  return airfoil_point_figures(points, along);
}

std::vector<SummaryCell> airfoil_cells(const std::vector<std::string>& files) {
  const auto dat = std::find_if(files.begin(), files.end(), [](const std::string& file) {
    return format_of(file) == FileFormat::kAirfoil;
  });
  if (dat == files.end()) return {};
  const auto text = read_file(*dat);
  const auto f = text ? figures_of_airfoil_file(*text) : std::nullopt;
  if (!f) {
    return {{"thickness", "", ""}, {"camber", "", ""}, {"trailing_edge", "", ""}};
  }
  return {{"thickness", fmt::format("thickness {:.3f} %", 100.0 * f->thickness),
           csv_cell(f->thickness)},
          {"camber", fmt::format("camber {:.3f} %", 100.0 * f->camber), csv_cell(f->camber)},
          {"trailing_edge",
           fmt::format("trailing edge {}{:.3f} %", f->trailing_round ? "round " : "",
                       100.0 * f->trailing_thickness),
           csv_cell(f->trailing_thickness)}};
}

std::string side_ends_text(const std::string& side, double gap) {
  constexpr double kBeside = 5e-4;  // chords
  if (!(gap > kBeside)) return "";
  return fmt::format(
      "{} side ends {:.3f} % of the chord before the other one, as where a file lacks its last "
      "point",
      side, 100.0 * gap);
}

std::vector<Vec2> airfoil_points_around(const Contour& contour, const AirfoilFigures& f) {
  std::vector<Vec2> out = contour.points;
  if (!contour.closed || out.empty()) return out;
  const double x = dot(out.front() - f.leading_edge, unit_at(f.turn)) / f.chord;
  constexpr double kAftOf = 0.5;
  if (x > kAftOf) out.push_back(out.front());
  return out;
}

}  // namespace obvid
