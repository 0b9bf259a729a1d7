// SPDX-License-Identifier: Apache-2.0
#include "obvid/idspline/internal/id_curve.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace obvid {
namespace {

template <std::size_t N>
double distance(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < N; ++k) sum = std::hypot(sum, b[k] - a[k]);
  return sum;
}

template <std::size_t N>
Result<std::vector<double>> chord_lengths(std::span<const std::array<double, N>> points) {
  std::vector<double> nodes(points.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string where = "point " + std::to_string(i + 1);
    const auto index = static_cast<std::ptrdiff_t>(i);
    if (!std::all_of(points[i].begin(), points[i].end(),
                     [](double c) { return std::isfinite(c); })) {
      return fail({ErrorCode::kNotFinite, "a coordinate is not a finite number", where,
                   "remove or repair the point", index, 0.0});
    }
    if (i == 0) continue;
    nodes[i] = nodes[i - 1] + distance(points[i - 1], points[i]);
    if (!(nodes[i] > nodes[i - 1])) {
      return fail({ErrorCode::kChordReversal, "two neighbouring points coincide", where,
                   "remove one of them", index, 0.0});
    }
    if (!std::isfinite(nodes[i])) {
      return fail({ErrorCode::kSizeOutOfRange, "a chord leaves the range of numbers", where,
                   "change the unit so that sizes are usual numbers", index, nodes[i]});
    }
  }
  return nodes;
}

}  // namespace

template <std::size_t N>
Result<IdCurve<N>> id_curve(std::span<const std::array<double, N>> points,
                            const IdSplineOptions& options) {
  const auto nodes = chord_lengths(points);
  if (!nodes) return tl::unexpected(nodes.error());
  IdCurve<N> curve;
  for (std::size_t k = 0; k < N; ++k) {
    IdSplineData data{*nodes, std::vector<double>(points.size())};
    for (std::size_t i = 0; i < points.size(); ++i) data.values[i] = points[i][k];
    auto part = id_spline(std::move(data), options);
    if (!part) return tl::unexpected(part.error());
    curve.part[k] = std::move(*part);
  }
  return curve;
}

template <std::size_t N>
VectorJet<N> evaluate(const IdCurve<N>& curve, double u) {
  const std::size_t i = cell_index(curve.part[0].nodes, u);
  VectorJet<N> out;
  for (std::size_t k = 0; k < N; ++k) {
    const ScalarJet jet = evaluate(cell(curve.part[k], i), u);
    out.point[k] = jet.value;
    out.d1[k] = jet.d1;
    out.d2[k] = jet.d2;
    out.d3[k] = jet.d3;
  }
  return out;
}

template <std::size_t N>
double largest_move(const IdCurve<N>& curve, std::span<const std::array<double, N>> points) {
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<double, N> place;
    for (std::size_t k = 0; k < N; ++k) place[k] = curve.part[k].values[i];
    largest = std::max(largest, distance(points[i], place));
  }
  return largest;
}

template Result<IdCurve<2>> id_curve(std::span<const std::array<double, 2>>,
                                     const IdSplineOptions&);
template Result<IdCurve<3>> id_curve(std::span<const std::array<double, 3>>,
                                     const IdSplineOptions&);
template VectorJet<2> evaluate(const IdCurve<2>&, double);
template VectorJet<3> evaluate(const IdCurve<3>&, double);
template double largest_move(const IdCurve<2>&, std::span<const std::array<double, 2>>);
template double largest_move(const IdCurve<3>&, std::span<const std::array<double, 3>>);

}  // namespace obvid
