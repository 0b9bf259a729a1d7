// SPDX-License-Identifier: Apache-2.0
#include "scatter_outliers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "obvid/numeric/internal/median.h"
#include "obvid/numeric/internal/small_system.h"

namespace obvid {
namespace {

constexpr std::size_t kLeastNeighbours = 6;  // twice what a plane needs
constexpr std::size_t kAskEvery = 4096;      // points
constexpr double kSigma = 1.4826;            // of a normal distribution whose median is 1

using Three = std::array<double, 3>;

/// What neighbours say of the height in their middle: 0, 0 of `place`, lengths of the farthest.
class Neighbourhood {
 public:
  void clear() { at_.clear(); }
  void add(Vec2 place, double height) { at_.push_back({place, height}); }

  /// Height at (0, 0) by their plane; `scatter` and `leverage` as s and k h in the header.
  bool predict(double& height, double& scatter, double& leverage) {
    double far = 0.0;
    for (const PlacedHeight& p : at_) far = std::max(far, norm(p.place));
    if (!(far > 0.0)) return false;
    for (PlacedHeight& p : at_) p.place = p.place / far;
    weight_.assign(at_.size(), 1.0);
    constexpr int kOutlierRounds = 8;
    Three plane{};
    for (int round = 0; round < kOutlierRounds; ++round) {
      plane = {};
      if (!fit(plane)) return false;
      scatter = kSigma * median_residual(plane);
      if (!(scatter > 0.0)) break;
      for (std::size_t k = 0; k < at_.size(); ++k) {
        weight_[k] = std::min(1.0, scatter / residual(k, plane));
      }
    }
    height = plane[0];
    Three unit = {1.0, 0.0, 0.0};
    if (!solve_small(matrix_, unit)) return false;
    leverage = unit[0] * static_cast<double>(at_.size());
    return true;
  }

 private:
  bool fit(Three& right) {
    // neighbours on one line say nothing across it: there the plane stays level
    constexpr double kLevel = 1e-6;
    matrix_ = {{{0, 0, 0}, {0, kLevel, 0}, {0, 0, kLevel}}};
    for (std::size_t k = 0; k < at_.size(); ++k) {
      const Three row = {1.0, at_[k].place.x, at_[k].place.y};
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) matrix_[i][j] += weight_[k] * row[i] * row[j];
        right[i] += weight_[k] * row[i] * at_[k].height;
      }
    }
    return solve_small(matrix_, right);
  }
  [[nodiscard]] double residual(std::size_t k, const Three& plane) const {
    const PlacedHeight& p = at_[k];
    return std::abs(p.height - plane[0] - plane[1] * p.place.x - plane[2] * p.place.y);
  }
  double median_residual(const Three& plane) {
    sorted_.clear();
    for (std::size_t k = 0; k < at_.size(); ++k) sorted_.push_back(residual(k, plane));
    return median_within(sorted_);
  }

  std::vector<PlacedHeight> at_;
  std::vector<double> weight_, sorted_;
  std::array<Three, 3> matrix_{};
};

}  // namespace

Result<ScatterNeighbours> neighbours_of(const std::vector<PlacedHeight>& points,
                                        const PlaneNeighbours& tree, const RunContext& run) {
  ScatterNeighbours out;
  out.number = std::min(kScatterNeighbours, points.size() - 1);
  out.of.reserve(points.size() * out.number);
  std::vector<PlaneNeighbour> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % kAskEvery == 0) OBVID_TRY(may_go_on(run));
    tree.nearest(points[i].place, out.number + 1, found);
    std::size_t taken = 0;
    for (const PlaneNeighbour& one : found) {
      if (one.point == i || taken == out.number) continue;
      out.of.push_back(one.point);
      ++taken;
    }
  }
  return out;
}

Result<std::vector<ScatterOutlier>> outliers_among(const std::vector<PlacedHeight>& points,
                                                   const ScatterNeighbours& neighbours,
                                                   double tolerance, const RunContext& run) {
  std::vector<ScatterOutlier> out;
  if (neighbours.number < kLeastNeighbours) return out;
  Neighbourhood around;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % kAskEvery == 0) OBVID_TRY(may_go_on(run));
    around.clear();
    const std::size_t* others = neighbours.begin_of(i);
    for (std::size_t k = 0; k < neighbours.number; ++k) {
      const PlacedHeight& p = points[others[k]];
      around.add(p.place - points[i].place, p.height - points[i].height);
    }
    double height = 0.0, scatter = 0.0, leverage = 0.0;
    if (!around.predict(height, scatter, leverage)) continue;
    const double usual = std::max(scatter, 0.25 * tolerance);
    const double limit = kOutlierFactor * (1.0 + std::sqrt(leverage)) * usual;
    if (std::abs(height) > limit) out.push_back({i, -height});
  }
  return out;
}

}  // namespace obvid
