// SPDX-License-Identifier: Apache-2.0
#include "given.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "obvid/curve/nearest.h"

namespace obvid::pipeline_detail {
namespace {

/// What counts as kept: as much as joints may differ (docs/methods/certify.md).
constexpr double kKeptHeading = 1e-6;    // rad
constexpr double kSameCurvature = 1e-6;  // of the given one

struct Miss {
  double heading = 0.0;
  double curvature = 0.0;
};

/// One side of a place: a piece and where on it.
struct Side {
  const Piece* piece;
  double t;
};

class GivenCheck {
 public:
  explicit GivenCheck(const Contour& contour)
      : contour_(contour), joint_(contour.points.size(), contour.joints.size()) {
    for (std::size_t j = contour.joints.size(); j-- > 0;) {
      const auto source = contour.joints[j].source;
      if (source && *source < joint_.size()) joint_[*source] = j;
    }
  }

  /// At an end of an open contour there is nothing to turn.
  [[nodiscard]] bool stands_on_corner(std::size_t point) const {
    const std::size_t joint = point < joint_.size() ? joint_[point] : contour_.joints.size();
    if (joint == contour_.joints.size()) return false;
    const bool end = !contour_.closed && (joint == 0 || joint == contour_.pieces.size());
    return end || contour_.joints[joint].leaving.has_value();
  }

  [[nodiscard]] Miss operator()(const GivenDatum& given) const {
    Miss miss;
    if (given.point >= joint_.size()) return {HUGE_VAL, HUGE_VAL};
    const std::vector<Side> sides = sides_of(given.point);
    if (given.theta) miss.heading = heading_miss(sides, *given.theta);
    if (given.kappa) miss.curvature = curvature_miss(sides, *given.kappa);
    return miss;
  }

 private:
  [[nodiscard]] std::vector<Side> sides_of(std::size_t point) const {
    const std::size_t n = contour_.pieces.size(), joint = joint_[point];
    if (joint == contour_.joints.size()) return {nearest(contour_.points[point])};
    std::vector<Side> out;
    if (joint > 0 || contour_.closed) {
      out.push_back({&contour_.pieces[joint > 0 ? joint - 1 : n - 1], 1.0});
    }
    if (joint < n) out.push_back({&contour_.pieces[joint], 0.0});
    return out;
  }

  /// At the place of the contour nearest to a point that is no joint.
  [[nodiscard]] Side nearest(Vec2 p) const {
    Side out{&contour_.pieces.front(), 0.0};
    double least = HUGE_VAL;
    for (const Piece& piece : contour_.pieces) {
      const double t = nearest_parameter(piece, p);
      const double away = norm(evaluate(piece, t).point - p);
      if (away >= least) continue;
      least = away;
      out = {&piece, t};
    }
    return out;
  }

  static double heading_miss(const std::vector<Side>& sides, double theta) {
    double miss = 0.0;
    for (const Side& side : sides) {
      const double here = heading(evaluate(*side.piece, side.t).d1);
      miss = std::max(miss, std::abs(std::remainder(here - theta, 2.0 * std::numbers::pi)));
    }
    return miss;
  }

  [[nodiscard]] double curvature_miss(const std::vector<Side>& sides, double kappa) const {
    double low = HUGE_VAL, high = -HUGE_VAL, scale = std::abs(kappa);
    for (const Side& side : sides) {
      const double here = curvature(evaluate(*side.piece, side.t));
      low = std::min(low, here);
      high = std::max(high, here);
      if (kappa != 0.0) continue;
      // a given 0 has no size of its own: against what turns beside it
      for (const double end : {0.0, 1.0}) {
        scale = std::max(scale, std::abs(curvature(evaluate(*side.piece, end))));
      }
    }
    const bool between = contour_.carrier == Carrier::kArcs;
    const double miss = between ? std::max({0.0, low - kappa, kappa - high})
                                : std::max(std::abs(low - kappa), std::abs(high - kappa));
    return miss > 0.0 ? miss / scale : 0.0;
  }

  const Contour& contour_;
  std::vector<std::size_t> joint_;  // on each point, or the number of joints
};

/// Misses are told in steps of this, upward: what rounding of their own evaluation hides (1e-12
/// rad, or of the curvature) is added, and nothing below it means anything.
constexpr double kMissStep = 1e-12;

double told(double miss) {
  return miss > 0.0 ? (std::floor(miss / kMissStep) + 1.0) * kMissStep : 0.0;
}

}  // namespace

GivenReport measure_given(const Contour& contour) {
  GivenReport out;
  if (contour.given.empty()) return out;
  const GivenCheck miss_of(contour);
  for (const GivenDatum& given : contour.given) {
    const Miss miss = miss_of(given);
    out.headings += given.theta ? 1 : 0;
    out.curvatures += given.kappa ? 1 : 0;
    out.corners += given.corner ? 1 : 0;
    out.heading_miss = std::max(out.heading_miss, told(miss.heading));
    out.curvature_miss = std::max(out.curvature_miss, told(miss.curvature));
  }
  return out;
}

Result<void> keeps_given(const Contour& contour) {
  if (contour.given.empty()) return {};
  const GivenCheck miss_of(contour);
  for (const GivenDatum& given : contour.given) {
    const Miss miss = miss_of(given);
    if (given.corner && !miss_of.stands_on_corner(given.point)) {
      return fail({ErrorCode::kCarrierCannotKeep, "no corner can be made there",
                   fmt::format("point {}", given.point + 1), "mark another point, or none",
                   static_cast<std::ptrdiff_t>(given.point), 0.0});
    }
    const bool turned = !(miss.heading <= kKeptHeading);
    if (!turned && miss.curvature <= kSameCurvature) continue;
    const double off = turned ? miss.heading * 180.0 / std::numbers::pi : 100.0 * miss.curvature;
    return fail(
        {ErrorCode::kCarrierCannotKeep,
         fmt::format("{} cannot keep the {} given there: the nearest found is off by {:.3g}{}",
                     to_string(contour.carrier), turned ? "heading" : "curvature", off,
                     turned ? " degrees" : " %"),
         fmt::format("point {}", given.point + 1),
         "give less there, or use carrier spiral or clothoids",
         static_cast<std::ptrdiff_t>(given.point), off});
  }
  return {};
}

}  // namespace obvid::pipeline_detail
