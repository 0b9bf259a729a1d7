// SPDX-License-Identifier: Apache-2.0
#include "obvid/toolpath/internal/toolpath_gcode.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "obvid/core/internal/figures.h"
#include "obvid/core/internal/parallel.h"
#include "obvid/core/version.h"
#include "obvid/exchange/internal/gcode/dialect.h"
#include "obvid/toolpath/toolpath.h"
#include "program_text.h"

namespace obvid {
namespace {

constexpr double kDigitsOfPrint = 1.0 / 3.0;  // of what printing may, the last digit's worth

std::string cutter_text(const Toolpath& path, double scale) {
  const double d = path.cutter.diameter * scale;
  switch (path.cutter.kind) {
    case CutterKind::kBall:
      return fmt::format("ball mill D{:.4g}", d);
    case CutterKind::kFlat:
      return fmt::format("flat mill D{:.4g}", d);
    case CutterKind::kBullNose:
      break;
  }
  return fmt::format("bull nose mill D{:.4g} R{:.4g}", d, path.cutter.corner_radius * scale);
}

std::string head(const Toolpath& path, const ToolpathGcodeOptions& options, double scale,
                 double minutes) {
  const bool inches = exchange::in_inches(path.units);
  std::vector<std::string> remarks{
      fmt::format("Obvid {}: {}", kVersion, gcode_comment(options.name)),
      cutter_text(path, scale) + ", places are those of the tip",
      fmt::format("{} passes, about {:.1f} min, within {} {}", path.report.passes, minutes,
                  significant_above(path.tolerance * scale, kDigitsOfBounds),
                  exchange::machine_unit(path.units))};
  for (std::string& one : exchange::gcode_unit_remarks(path.units)) {
    remarks.push_back(std::move(one));
  }
  return exchange::gcode_head(options.controller, inches, path.tolerance * scale, remarks);
}

void write_moves(const Toolpath& path, double scale, std::size_t threads,
                 toolpath::ProgramText& program, ToolpathGcode& out) {
  const auto scaled = [&](const ToolpathMove& move) {
    std::vector<Vec3> points = move.points;
    for (Vec3& p : points) p = scale * p;
    return points;
  };
  std::vector<toolpath::ProgramText::Way> ways(path.moves.size());
  in_parallel(ways.size(), threads, [&](std::size_t k) {
    const ToolpathMove& move = path.moves[k];
    if (move.kind == ToolMove::kRapid) return;
    ways[k] = move.kind == ToolMove::kPass ? program.way_of_pass(scaled(move), move.plane)
                                           : program.straight_way(scaled(move));
  });
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const ToolpathMove& move = path.moves[k];
    const double before = program.length();
    if (move.kind == ToolMove::kRapid) {
      program.rapid(scaled(move));
    } else {
      program.print(ways[k], move.kind == ToolMove::kPlunge ? path.feeds.plunge : path.feeds.pass);
    }
    (move.kind == ToolMove::kRapid    ? out.rapid_length
     : move.kind == ToolMove::kPlunge ? out.plunge_length
                                      : out.cutting_length) += (program.length() - before) / scale;
  }
  program.level_plane();
}

}  // namespace

ToolpathFeeds default_feeds(const Units& units) {
  const bool inches = exchange::in_inches(units);
  return {default_feed(units), inches ? 12.0 : 300.0, inches ? 200.0 : 5000.0};
}

Result<ToolpathGcode> toolpath_gcode(const Toolpath& path, const ToolpathGcodeOptions& options,
                                     std::size_t threads) {
  const auto unit = exchange::machine_units_in(path.units);
  OBVID_TRY(unit);
  OBVID_TRY(exchange::check_gcode_decimals(options.decimals));
  const double scale = *unit, print = path.print_within * scale;
  const bool inches = exchange::in_inches(path.units);
  const int decimals =
      options.decimals.value_or(exchange::decimals_of_digit(kDigitsOfPrint * print, inches));
  const double within = print - std::pow(10.0, -decimals);
  if (!(within > 0.0)) {
    return error(ErrorCode::kToleranceNotReached,
                 fmt::format("{} decimals do not keep a tolerance of {:g} {}", decimals,
                             path.tolerance, path.units.text()))
        .hint("print more decimals, or allow a larger tolerance")
        .value(path.tolerance);
  }
  const exchange::MotionRules machine{path.feeds.rapid,
                                      exchange::machine_acceleration(path.acceleration, inches),
                                      path.tolerance * scale};
  toolpath::ProgramText program(decimals, within, options.arcs, machine);
  ToolpathGcode out;
  write_moves(path, scale, threads, program, out);
  out.minutes = program.seconds() / exchange::kSecondsOfMinute;
  out.blocks = program.blocks();
  out.arc_blocks = program.arcs();
  const std::string on = path.spindle ? fmt::format("M3 S{:.0f}\n", *path.spindle) : "";
  out.text = head(path, options, scale, out.minutes) + on + program.text() +
             (path.spindle ? "M5\n" : "") + exchange::gcode_end(options.controller);
  return out;
}

}  // namespace obvid
