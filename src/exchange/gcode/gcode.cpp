// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/gcode/gcode.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "obvid/contour/arcs/arcs_along.h"
#include "obvid/contour/arcs/polyline_along.h"
#include "obvid/contour/bsplines/cubic_along.h"
#include "obvid/core/internal/figures.h"
#include "obvid/core/internal/plain_letters.h"
#include "obvid/core/version.h"
#include "obvid/curve/internal/path_distance.h"
#include "obvid/curve/internal/smooth_parts.h"
#include "obvid/exchange/internal/gcode/dialect.h"
#include "obvid/exchange/internal/gcode/path.h"
#include "obvid/exchange/internal/whole_arcs.h"

namespace obvid {
namespace {

using exchange::fixed;
using exchange::GcodePath;

constexpr double kOfBlockTolerance = 0.995;  // aimed at, so that what is measured stays below
constexpr int kToleranceTrials = 5;

class Program {
 public:
  Program(const Contour& contour, const GcodeOptions& options, Watch* watch)
      : contour_(contour),
        options_(options),
        watch_(watch),
        inches_(exchange::in_inches(contour.units)) {
    scale_ = *exchange::machine_units_in(contour.units);
    decimals_ = options.decimals.value_or(exchange::decimals_of_digit(
        exchange::kDigitOfTolerance * (options.tolerance * scale_), inches_));
    unit_ = std::pow(10.0, -decimals_) / scale_;
  }

  Result<GcodeText> run() const {
    const double tolerance = of_blocks();
    double within = tolerance - unit_;  // ends move by 0.71 of the last digit at most
    double deviation = unit_;
    for (int trial = 0; trial < kToleranceTrials && within > 0.0; ++trial) {
      GcodePath path(scale_, decimals_);
      if (!path.holds(largest_coordinate())) return fail(too_large());
      path.start_at(start_point(contour_.pieces.front()));
      OBVID_TRY(follow(path, within));
      deviation = path_distance(contour_.pieces, path.pieces(), watch_) + path.radius_mismatch();
      if (has_ended(watch_)) return fail(cancelled_error());
      if (path.pieces().empty()) return fail(nothing_left());
      if (deviation <= tolerance) return finished(path, deviation);
      if (path.lost_arcs()) return fail(too_large());
      within -= deviation - kOfBlockTolerance * tolerance;
    }
    return error(ErrorCode::kToleranceNotReached,
                 fmt::format("no program with {} decimals was found within a tolerance of {:g} {}",
                             decimals_, options_.tolerance, contour_.units.text()))
        .hint("print more (--decimals), or allow a larger tolerance (--output-tolerance)")
        .value(deviation);
  }

 private:
  /// What a controller that blends leaves of the tolerance.
  [[nodiscard]] double of_blocks() const {
    return options_.tolerance -
           exchange::blending_of(options_.controller, options_.tolerance * scale_) / scale_;
  }
  /// Of the ends of the pieces: twice as much is room enough for what lies between.
  [[nodiscard]] double largest_coordinate() const {
    double most = 0.0;
    for (const Piece& piece : contour_.pieces) {
      for (const Vec2 p : {start_point(piece), end_point(piece)}) {
        most = std::max({most, std::abs(p.x), std::abs(p.y)});
      }
    }
    return most;
  }
  [[nodiscard]] Error too_large() const {
    return error(ErrorCode::kToleranceNotReached,
                 fmt::format("the coordinates are too large for {} decimals", decimals_))
        .hint("move the contour near the origin; --units says what a unit is")
        .value(largest_coordinate());
  }
  /// All ends are printed as one place.
  [[nodiscard]] Error nothing_left() const {
    return error(ErrorCode::kToleranceNotReached,
                 fmt::format("the contour is smaller than {} decimals can print", decimals_))
        .hint("--units says what a unit is")
        .value(unit_);
  }
  Result<void> follow(GcodePath& path, double within) const {
    switch (options_.motion) {
      case GcodeMotion::kArcs:
        return arcs(path, within);
      case GcodeMotion::kLines:
        return lines(path, within);
      case GcodeMotion::kSplines:
        break;
    }
    return splines(path, within);
  }

  Result<void> arcs(GcodePath& path, double within) const {
    const auto along = arcs_along(contour_, within, watch_);
    OBVID_TRY(along);
    for (const Piece& piece : exchange::whole_arcs(along->pieces)) {
      if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
        path.follow_arc(*arc);
      } else {
        path.line_to(end_point(piece));
      }
    }
    return {};
  }

  Result<void> lines(GcodePath& path, double within) const {
    const auto along = polyline_along(contour_, within, watch_);
    OBVID_TRY(along);
    for (const Vec2 p : along->points) path.line_to(p);
    return {};
  }

  Result<void> splines(GcodePath& path, double within) const {
    for (const Contour& part : smooth_parts(contour_, false)) {
      const auto along = cubic_along(part, within, watch_);
      OBVID_TRY(along);
      for (const RationalBezier& span : bezier_pieces(along->spline)) path.follow_cubic(span);
    }
    return {};
  }

  [[nodiscard]] GcodeText finished(const GcodePath& path, double deviation) const {
    GcodeText out;
    out.blocks = path.pieces().size();
    out.arc_blocks = path.arcs();
    out.deviation = deviation;
    out.text = head(out.blocks, deviation) + approach(path) + path.text() + end();
    return out;
  }

  [[nodiscard]] std::string head(std::size_t blocks, double deviation) const {
    std::vector<std::string> remarks{
        fmt::format("Obvid {}: {}", kVersion, gcode_comment(options_.name)),
        fmt::format("{} blocks within {} {} of the contour", blocks,
                    significant_above(deviation * scale_, kDigitsOfBounds), inches_ ? "in" : "mm")};
    for (std::string& one : exchange::gcode_unit_remarks(contour_.units)) {
      remarks.push_back(std::move(one));
    }
    return exchange::gcode_head(options_.controller, inches_, options_.tolerance * scale_, remarks);
  }

  [[nodiscard]] std::string approach(const GcodePath& path) const {
    std::string out;
    if (options_.safe_z)
      out += "G0 Z" + fixed(*options_.safe_z, exchange::kLeastGcodeDecimals) + "\n";
    out +=
        "G0 " + path.start() + "\nF" +
        fixed(options_.feed.value_or(default_feed(contour_.units)), exchange::kLeastGcodeDecimals) +
        "\n";
    if (options_.safe_z) out += "G1 Z0.000\n";
    return out;
  }

  [[nodiscard]] std::string end() const {
    const std::string up =
        options_.safe_z ? "G0 Z" + fixed(*options_.safe_z, exchange::kLeastGcodeDecimals) + "\n"
                        : "";
    return up + exchange::gcode_end(options_.controller);
  }

  const Contour& contour_;
  const GcodeOptions& options_;
  Watch* watch_;
  bool inches_;
  double scale_ = 1.0;  ///< machine units in a unit of the contour
  double unit_ = 0.0;   ///< the last printed digit, units of the contour
  int decimals_ = exchange::kLeastGcodeDecimals;
};

Result<void> check(const Contour& contour, const GcodeOptions& options) {
  const auto bad = [](std::string what, std::string hint, double value) {
    return error(ErrorCode::kBadOption, std::move(what)).hint(std::move(hint)).value(value);
  };
  const double feed = options.feed.value_or(default_feed(contour.units));
  if (!(options.tolerance > 0.0) || !std::isfinite(options.tolerance) || !(feed > 0.0) ||
      !std::isfinite(feed)) {
    return bad("tolerance and feed must be greater than 0", "", options.tolerance);
  }
  OBVID_TRY(exchange::check_gcode_decimals(options.decimals));
  if (options.safe_z && !std::isfinite(*options.safe_z)) {
    return bad("the height is no number", "", *options.safe_z);
  }
  if (options.motion == GcodeMotion::kSplines) OBVID_TRY(exchange::check_g5(options.controller));
  if (contour.pieces.empty()) {
    return error(ErrorCode::kNothingThere, "the contour has no pieces");
  }
  OBVID_TRY(exchange::machine_units_in(contour.units));
  return {};
}

}  // namespace

std::string gcode_comment(std::string_view name) {
  constexpr std::size_t kLongestComment = 58;  // a line has to fit into 80 characters of grbl
  constexpr std::string_view kMore = "...";
  std::string out;
  for (const char c : plain_letters(name)) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code < 0x7F && c != '(' && c != ')' && c != '%' && c != ';') out += c;
    if (out.size() > kLongestComment) {
      return out.substr(0, kLongestComment - kMore.size()).append(kMore);
    }
  }
  return out;
}

double default_feed(const Units& units) {
  constexpr double kMillimetres = 1000.0, kInches = 40.0;  // a minute
  return exchange::in_inches(units) ? kInches : kMillimetres;
}

Result<GcodeText> gcode_text(const Contour& contour, const GcodeOptions& options, Watch* watch) {
  OBVID_TRY(check(contour, options));
  return Program(contour, options, watch).run();
}

}  // namespace obvid
