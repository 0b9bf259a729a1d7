// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/internal/refine.h"

#include <algorithm>
#include <cmath>

#include "obvid/curve/internal/end_curvatures.h"
#include "obvid/series/analysis.h"

namespace obvid {
namespace {

/// Elements that one piece may take; widths fall with the third power, so this is 15 decades.
constexpr std::size_t kMostElements = 100000;
/// Least growth of their number from one attempt to the next, as its part: where rounding keeps the
/// widths from falling, the attempts come to an end.
constexpr std::size_t kLeastGrowth = 16;
/// Bisection steps for a step that uses the tolerance up: to a thousandth of the parameter step.
constexpr int kStepBisections = 10;

struct Sample {
  Vec2 point;
  Vec2 tangent;
  double kappa = 0.0;
};

Sample sample(const Piece& piece, double t) {
  const Jet jet = evaluate(piece, t);
  return {jet.point, jet.d1, accurate_curvature(piece, t, jet)};
}

/// Width of the region between two samples; the bilens where rounding hides the region.
double width_between(const Sample& a, const Sample& b, int direction) {
  const ChordFrame frame = chord_frame(a.point, a.tangent, a.kappa, b.point, b.tangent, b.kappa);
  const auto region = segment_region(frame, direction);
  return region ? region->width : bilens_width(frame);
}

}  // namespace

double least_tolerance(const std::vector<Vec2>& points) {
  constexpr double kOfSize = 1e-12;
  constexpr double kOfCoordinates = 8.0 * 0x1p-53;
  double largest = 0.0;
  for (const Vec2 p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  return std::max(kOfSize * bounding_diagonal(points), kOfCoordinates * largest);
}

PieceBound bound_piece(const Piece& piece, double t0, double t1, int direction, double tolerance,
                       std::optional<double> unrefined) {
  PieceBound bound;
  if (direction == 0 || std::holds_alternative<LinePiece>(piece) ||
      std::holds_alternative<ArcPiece>(piece)) {
    return bound;
  }
  if (unrefined && *unrefined <= tolerance) {
    bound.width = *unrefined;
    return bound;
  }
  const Sample first = sample(piece, t0), last = sample(piece, t1);
  bound.width = unrefined ? *unrefined : width_between(first, last, direction);
  double expected = bound.width;
  std::size_t count = 1;
  while (bound.width > tolerance) {
    const auto factor = std::cbrt(expected / tolerance);
    const auto wanted = static_cast<std::size_t>(std::ceil(factor * static_cast<double>(count)));
    if (wanted > kMostElements) {
      bound.reached = false;
      return bound;
    }
    count = std::max(count + 1 + count / kLeastGrowth, wanted);
    bound.width = 0.0;
    Sample before = first;
    for (std::size_t j = 1; j <= count; ++j) {
      const double t = t0 + (t1 - t0) * static_cast<double>(j) / static_cast<double>(count);
      const Sample here = j == count ? last : sample(piece, t);
      bound.width = std::max(bound.width, width_between(before, here, direction));
      before = here;
      if (bound.width > tolerance) break;  // this count does not do: no need to see the rest
    }
    expected = bound.width;
    bound.inserted = count - 1;
  }
  return bound;
}

std::vector<double> fewest_elements(const Piece& piece, int direction, double tolerance) {
  std::vector<double> parameters = {0.0};
  if (direction == 0) return {0.0, 1.0};
  double step = 1.0;
  while (parameters.back() < 1.0 && parameters.size() < kMostElements) {
    const double t = parameters.back();
    const Sample here = sample(piece, t);
    const auto fits = [&](double to) {
      return width_between(here, sample(piece, to), direction) <= tolerance;
    };
    if (fits(1.0)) {
      parameters.push_back(1.0);
      break;
    }
    double good = std::min(step, 1.0 - t);
    while (!fits(t + good)) good *= 0.5;
    double bad = 1.0 - t;
    while (2.0 * good < bad && fits(t + 2.0 * good)) good *= 2.0;
    bad = std::min(bad, 2.0 * good);
    for (int i = 0; i < kStepBisections; ++i) {
      const double middle = 0.5 * (good + bad);
      (fits(t + middle) ? good : bad) = middle;
    }
    step = good;
    parameters.push_back(t + good);
  }
  // the last step takes what is left: a sliver shares with the step before, which leaves both well
  // within the tolerance
  constexpr double kSliver = 0.1;
  const std::size_t n = parameters.size();
  if (n > 2 &&
      parameters[n - 1] - parameters[n - 2] < kSliver * (parameters[n - 2] - parameters[n - 3])) {
    parameters[n - 2] = 0.5 * (parameters[n - 3] + parameters[n - 1]);
  }
  return parameters;
}

}  // namespace obvid
