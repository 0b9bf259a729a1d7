// SPDX-License-Identifier: Apache-2.0
#include "fit/fixed_once.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/value_range.h"

namespace obvid::pipeline_detail {
namespace {

/// What two ways of writing one value differ: a radius and its inverse, degrees and whole turns.
constexpr double kFixedRounding = 8.0 * std::numeric_limits<double>::epsilon();

bool same_heading(double a, double b) {
  const double size = std::max({1.0, std::abs(a), std::abs(b)});  // rad
  return std::abs(turn_between(b, a)) <= kFixedRounding * size;
}

bool same_curvature(double a, double b) {
  return std::abs(a - b) <= kFixedRounding * std::max(std::abs(a), std::abs(b));
}

const char* words_of(FixedBy by) {
  switch (by) {
    case FixedBy::kSeries:
      return "in the series";
    case FixedBy::kPoint:
      return "for the point";
    case FixedBy::kStart:
      return "for the start";
    case FixedBy::kEnd:
      break;
  }
  return "for the end";
}

std::string heading_text(double theta, FixedBy by) {
  return fmt::format("{:.15g} degrees {}", theta / kOneDegree, words_of(by));
}

std::string curvature_text(double kappa, FixedBy by) {
  if (kappa == 0.0) return fmt::format("0 (straight) {}", words_of(by));
  return fmt::format("{:.15g} (radius {:.15g}) {}", kappa, 1.0 / kappa, words_of(by));
}

/// Headings count modulo a full turn.
bool holds(const ValueRange& thetas, double theta) {
  const double middle = 0.5 * (thetas.low + thetas.high), half = 0.5 * (thetas.high - thetas.low);
  return std::abs(turn_between(middle, theta)) <=
         half + kFixedRounding * std::max(1.0, std::abs(theta));
}

Error two_ranges_left(std::size_t point) {
  return error(ErrorCode::kFixedDataContradict,
               "what is given for the heading here leaves two ranges apart from each other")
      .where(fmt::format("point {}", point + 1))
      .hint("give one range")
      .point(point);
}

Error no_common_value(bool heading, std::size_t point) {
  return error(ErrorCode::kFixedDataContradict,
               fmt::format("what is given for the {} here has no value in common",
                           heading ? "heading" : "curvature"))
      .where(fmt::format("point {}", point + 1))
      .hint("give one value, or one range")
      .point(point);
}

Error fixed_twice(const char* what, const std::string& one, const std::string& other, bool series,
                  std::size_t point) {
  return {series ? ErrorCode::kFixedDataContradict : ErrorCode::kBadOption,
          fmt::format("two {}s are fixed at one point: {}, and {}", what, one, other),
          fmt::format("point {}", point + 1),
          "give one of them",
          static_cast<std::ptrdiff_t>(point),
          0.0};
}

}  // namespace

FixedOnce fixed_by(FixedBy by, std::optional<double> theta, std::optional<double> kappa) {
  FixedOnce out;
  out.data.theta = theta;
  out.data.kappa = kappa;
  out.theta_by = out.kappa_by = by;
  return out;
}

Result<void> add_fixed(FixedOnce& into, const FixedOnce& more, std::size_t point) {
  FixedData& a = into.data;
  const FixedData& b = more.data;
  const auto series = [](FixedBy x, FixedBy y) {
    return x == FixedBy::kSeries && y == FixedBy::kSeries;
  };
  if (a.theta && b.theta && !same_heading(*a.theta, *b.theta)) {
    return fail(fixed_twice("heading", heading_text(*a.theta, into.theta_by),
                            heading_text(*b.theta, more.theta_by),
                            series(into.theta_by, more.theta_by), point));
  }
  if (a.kappa && b.kappa && !same_curvature(*a.kappa, *b.kappa)) {
    return fail(fixed_twice("curvature", curvature_text(*a.kappa, into.kappa_by),
                            curvature_text(*b.kappa, more.kappa_by),
                            series(into.kappa_by, more.kappa_by), point));
  }
  if (b.theta && !a.theta) {
    a.theta = b.theta;
    into.theta_by = more.theta_by;
  }
  if (b.kappa && !a.kappa) {
    a.kappa = b.kappa;
    into.kappa_by = more.kappa_by;
  }
  if (b.thetas) {
    a.thetas = a.thetas ? common_headings(*a.thetas, *b.thetas) : *b.thetas;
    if (!a.thetas) return fail(two_ranges_left(point));
    if (a.thetas->empty()) return fail(no_common_value(true, point));
  }
  if (b.kappas) {
    a.kappas = a.kappas ? common(*a.kappas, *b.kappas) : *b.kappas;
    if (a.kappas->empty()) return fail(no_common_value(false, point));
  }
  if (a.theta && a.thetas && !holds(*a.thetas, *a.theta)) return fail(no_common_value(true, point));
  if (a.kappa && a.kappas && !(a.kappas->low <= *a.kappa && *a.kappa <= a.kappas->high)) {
    return fail(no_common_value(false, point));
  }
  if (b.tolerance) a.tolerance = std::min(a.tolerance.value_or(*b.tolerance), *b.tolerance);
  a.corner = a.corner || b.corner;
  return {};
}

}  // namespace obvid::pipeline_detail
