// SPDX-License-Identifier: Apache-2.0
// Curves of a net over new parameters: c(phi(u)) + d(u) with a smooth ascending phi that brings the
// crossings to their common parameters and a smooth d that brings them to their common points,
// interpolated as closely as the tolerance asks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "network_side.h"

namespace obvid {
namespace {

/// Ascending function through given values: the C2 cubic spline where that ascends well enough,
/// else the cubics of Fritsch and Carlson, which always do but are only C1.
class Ascending {
 public:
  Ascending(const std::vector<double>& at, const std::vector<double>& values)
      : at_(at), values_(values), slope_(at.size(), 0.0) {
    if (!take_spline_slopes()) take_safe_slopes();
  }

  [[nodiscard]] double operator()(double u) const {
    const std::size_t k = interval(u);
    const double h = at_[k + 1] - at_[k], x = (u - at_[k]) / h;
    const double a = values_[k], b = values_[k + 1];
    const double value = a + (b - a) * x * x * (3.0 - 2.0 * x) +
                         h * x * (1.0 - x) * (slope_[k] * (1.0 - x) - slope_[k + 1] * x);
    return std::clamp(value, a, b);
  }

 private:
  [[nodiscard]] std::size_t interval(double u) const {
    const auto next = std::upper_bound(at_.begin() + 1, at_.end() - 1, u) - at_.begin();
    return static_cast<std::size_t>(next) - 1;
  }
  [[nodiscard]] double chord(std::size_t k) const {
    return (values_[k + 1] - values_[k]) / (at_[k + 1] - at_[k]);
  }

  /// False unless all slopes are such that the cubics between them ascend. Slopes up to 3 times
  /// those of the chords suffice (Fritsch and Carlson); slopes near 0 would bunch the points.
  bool take_spline_slopes() {
    constexpr double kLeast = 0.2, kMost = 3.0;
    std::vector<Vec3> points;
    for (const double value : values_) points.push_back({value, 0.0, 0.0});
    const Result<SpaceCurve> spline = interpolated(points, at_);
    if (!spline) return false;
    for (std::size_t k = 0; k < at_.size(); ++k) slope_[k] = evaluate(*spline, at_[k]).d1.x;
    for (std::size_t k = 0; k + 1 < at_.size(); ++k) {
      const auto [least, most] = std::minmax(slope_[k], slope_[k + 1]);
      if (!(least >= kLeast * chord(k) && most <= kMost * chord(k))) return false;
    }
    return true;
  }

  void take_safe_slopes() {
    const std::size_t n = at_.size();
    for (std::size_t k = 1; k + 1 < n; ++k) {
      const double h0 = at_[k] - at_[k - 1], h1 = at_[k + 1] - at_[k];
      const double w0 = h0 + 2.0 * h1, w1 = 2.0 * h0 + h1;  // harmonic mean, weighted by lengths
      slope_[k] = (w0 + w1) / (w0 / chord(k - 1) + w1 / chord(k));
    }
    slope_.front() = chord(0);
    slope_.back() = chord(n - 2);
  }

  std::vector<double> at_, values_, slope_;
};

/// The curve that is wanted, at any parameter.
class Wanted {
 public:
  Wanted(const SpaceCurve& curve, const std::vector<double>& own, const std::vector<double>& common,
         const std::vector<Vec3>& points)
      : curve_(curve), phi_(common, own) {
    std::vector<Vec3> moves;
    for (std::size_t j = 0; j < own.size(); ++j) {
      moves.push_back(points[j] - evaluate(curve, own[j]).point);
    }
    if (Result<SpaceCurve> moved = interpolated(moves, common)) move_ = std::move(*moved);
  }

  [[nodiscard]] Vec3 operator()(double u) const {
    const Vec3 point = evaluate(curve_, phi_(u)).point;
    return move_.points.empty() ? point : point + evaluate(move_, u).point;
  }

 private:
  const SpaceCurve& curve_;
  Ascending phi_;
  SpaceCurve move_;
};

Result<std::vector<SpaceCurve>> through(const std::vector<Wanted>& wanted,
                                        const std::vector<double>& nodes) {
  std::vector<SpaceCurve> curves;
  std::vector<Vec3> points(nodes.size());
  for (const Wanted& w : wanted) {
    std::transform(nodes.begin(), nodes.end(), points.begin(), std::cref(w));
    Result<SpaceCurve> curve = interpolated(points, nodes);
    if (!curve) return fail(curve.error());
    curves.push_back(std::move(*curve));
  }
  return curves;
}

/// Nodes with those intervals halved where a curve is off by more than the tolerance; `worst`
/// becomes the largest distance.
std::vector<double> refined(const std::vector<Wanted>& wanted,
                            const std::vector<SpaceCurve>& curves, const std::vector<double>& nodes,
                            double tolerance, double& worst) {
  std::vector<double> finer{nodes.front()};
  worst = 0.0;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const Range gap{nodes[k], nodes[k + 1]};
    double off = 0.0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      for (const double part : {0.25, 0.5, 0.75}) {
        const double u = gap.at(part);
        off = std::max(off, norm(evaluate(curves[i], u).point - wanted[i](u)));
      }
    }
    if (off > tolerance) finer.push_back(gap.at(0.5));
    finer.push_back(gap.to);
    worst = std::max(worst, off);
  }
  return finer;
}

std::vector<double> first_nodes(const std::vector<double>& parameters) {
  constexpr std::size_t kPartsOfGap = 4;  // between crossings: enough to see what happens there
  std::vector<double> nodes{parameters.front()};
  for (std::size_t j = 0; j + 1 < parameters.size(); ++j) {
    const Range gap{parameters[j], parameters[j + 1]};
    for (std::size_t i = 1; i <= kPartsOfGap; ++i) {
      nodes.push_back(gap.at(static_cast<double>(i) / static_cast<double>(kPartsOfGap)));
    }
  }
  return nodes;
}

}  // namespace

Result<std::vector<SpaceCurve>> rebuilt(const NetSide& side, const std::vector<double>& parameters,
                                        const CrossingPoints& points, double tolerance) {
  constexpr std::size_t kMostNodes = 20'000;  // corners need some 3 for each halving
  constexpr double kMeasured =
      0.8;  // of the tolerance: between the samples it may be a little more
  std::vector<Wanted> wanted;
  for (std::size_t i = 0; i < side.curves.size(); ++i) {
    wanted.emplace_back(side.curves[i], side.at[i], parameters, points[i]);
  }
  std::vector<double> nodes = first_nodes(parameters);
  double worst = 0.0;
  while (nodes.size() <= kMostNodes) {
    Result<std::vector<SpaceCurve>> curves = through(wanted, nodes);
    if (!curves) break;  // nodes have become one by rounding
    std::vector<double> finer = refined(wanted, *curves, nodes, kMeasured * tolerance, worst);
    if (finer.size() == nodes.size()) return curves;
    nodes = std::move(finer);
  }
  return fail({ErrorCode::kToleranceNotReached,
               fmt::format("curves {} over common parameters stay {:g} away from those given",
                           side.kind, worst),
               "", "give a larger tolerance, or curves whose parameters agree", -1, worst});
}

}  // namespace obvid
