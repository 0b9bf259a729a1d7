// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "obvid/surface/space_curve.h"

namespace obvid::mesh {

/// A line of constant parameter: the span's number in the upper half, the part of the span in the
/// lower half as a binary fraction. The last line of span k is the first of span k + 1.
using Line = std::uint64_t;
inline constexpr int kFractionBits = 32;
inline constexpr Line kSpan = Line{1} << kFractionBits;
[[nodiscard]] constexpr std::size_t span_of(Line line) {
  return static_cast<std::size_t>(line >> kFractionBits);
}

/// A parameter and the span it is taken in: at a knot that decides from which side.
struct Place {
  std::size_t span = 0;
  double t = 0.0;
};

/// B-splines that are not zero on a span, with their first derivatives: degree + 1 of each.
struct SpanBasis {
  std::size_t first;
  std::array<double, kMaxNurbsDegree + 1> value;
  std::array<double, kMaxNurbsDegree + 1> slope;
};

/// One direction of the parameters of a patch: its spans.
class PatchAxis {
 public:
  PatchAxis(int degree, const std::vector<double>& knots);

  [[nodiscard]] std::size_t spans() const { return knot_of_.size(); }
  [[nodiscard]] Line last() const { return static_cast<Line>(spans()) << kFractionBits; }
  [[nodiscard]] double from() const { return ends_.front(); }
  [[nodiscard]] double to() const { return ends_.back(); }
  /// Parameter at the begin of span k; k = spans(): the end.
  [[nodiscard]] double end(std::size_t k) const { return ends_[k]; }
  [[nodiscard]] int degree() const { return degree_; }

  [[nodiscard]] double at(Line line) const;
  /// The span that holds a parameter; at a knot the one above, at the end the last.
  [[nodiscard]] Place locate(double t) const;
  /// Derivatives may jump at the begin of span k.
  [[nodiscard]] bool may_bend(std::size_t k) const { return may_bend_[k]; }
  [[nodiscard]] SpanBasis basis(const Place& place) const;

 private:
  int degree_;
  const std::vector<double>& knots_;
  std::vector<double> ends_;          ///< of spans, one more than spans
  std::vector<std::size_t> knot_of_;  ///< number of the knot at the begin of each span
  std::vector<bool> may_bend_;
};

}  // namespace obvid::mesh
