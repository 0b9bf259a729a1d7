// SPDX-License-Identifier: Apache-2.0
#include "fit/given.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "obvid/curve/internal/end_curvatures.h"
#include "obvid/curve/internal/nearest.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/value_range.h"
#include "obvid/series/point_series.h"

namespace obvid::pipeline_detail {
namespace {

/// What counts as kept: as much as joints may differ (docs/methods/certify.md).
constexpr double kKeptHeading = 1e-6;    // rad
constexpr double kSameCurvature = 1e-6;  // of the given one

/// Places are one when nothing but this share of their coordinates is between them.
constexpr double kSamePlace = 64.0 * 0x1p-53;

struct Miss {
  double heading = 0.0;
  double curvature = 0.0;
};

/// One side of a place: a piece and where on it.
struct Side {
  const Piece* piece;
  double t;
};

/// How far a value is beyond the ends of a range; 0 inside.
double beyond(const ValueRange& range, double value) {
  return std::max({0.0, range.low - value, value - range.high});
}

/// The end of a range that a curvature outside it has passed.
double crossed_end(const ValueRange& kappas, double kappa) {
  return kappa < kappas.low ? kappas.low : kappas.high;
}

/// The size against which a curvature is measured that passes the end of a range: that end's, and
/// of 0 and of ends that are none, its own.
double scale_at(const ValueRange& kappas, double kappa) {
  const double end = crossed_end(kappas, kappa);
  return end != 0.0 && std::isfinite(end) ? std::abs(end) : std::abs(kappa);
}

/// Where the curvatures on both sides of a point lie, as a range.
struct AtPoint {
  double low = HUGE_VAL, high = -HUGE_VAL;
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
    if (given.thetas) {
      for (const Side& side : sides) {
        const double here = turned_to(*given.thetas, heading(evaluate(*side.piece, side.t).d1));
        miss.heading = std::max(miss.heading, beyond(*given.thetas, here));
      }
    }
    if (given.kappas) {
      const double here = nearest_curvature(sides, *given.kappas);
      const double off = beyond(*given.kappas, here);
      if (off > 0.0) {
        const double scale = end_scale(sides, crossed_end(*given.kappas, here));
        miss.curvature = std::max(miss.curvature, off / scale);
      }
    }
    return miss;
  }

  /// The ends of its ranges at which the contour lies on one of its sides (at a corner it may lie
  /// at both), as nearly as given values are kept.
  void add_active(const GivenDatum& given, std::vector<ActiveRange>& out) const {
    if (given.point >= joint_.size()) return;
    const std::vector<Side> sides = sides_of(given.point);
    for (const bool high : {false, true}) {
      if (given.thetas && at_heading(sides, *given.thetas, high)) {
        out.push_back({given.point, true, high});
      }
    }
    for (const bool high : {false, true}) {
      if (given.kappas && at_curvature(sides, *given.kappas, high)) {
        out.push_back({given.point, false, high});
      }
    }
  }

  /// What the contour has at a point of a range, when it passes an end of it.
  [[nodiscard]] FixedData passed_ends(const GivenDatum& given) const {
    FixedData out;
    if (given.point >= joint_.size()) return out;
    const std::vector<Side> sides = sides_of(given.point);
    for (const Side& side : sides) {
      if (!given.thetas || given.theta || out.theta) break;
      out.theta = passed_heading(*given.thetas, heading(evaluate(*side.piece, side.t).d1));
    }
    if (!given.kappas || given.kappa) return out;
    const double here = nearest_curvature(sides, *given.kappas);
    const double off = beyond(*given.kappas, here);
    const double end = crossed_end(*given.kappas, here);
    if (off > 0.0 && off > kSameCurvature * end_scale(sides, end)) out.kappa = end;
    return out;
  }

 private:
  [[nodiscard]] std::vector<Side> sides_of(std::size_t point) const {
    const std::size_t n = contour_.pieces.size(), joint = joint_[point];
    if (joint == contour_.joints.size()) return sides_nearest(contour_.points[point]);
    std::vector<Side> out;
    if (joint > 0 || contour_.closed) {
      out.push_back({&contour_.pieces[joint > 0 ? joint - 1 : n - 1], 1.0});
    }
    if (joint < n) out.push_back({&contour_.pieces[joint], 0.0});
    return out;
  }

  [[nodiscard]] static bool at_heading(const std::vector<Side>& sides, const ValueRange& thetas,
                                       bool high) {
    const double end = high ? thetas.high : thetas.low;
    return std::any_of(sides.begin(), sides.end(), [&](const Side& side) {
      const double here = turned_to(thetas, heading(evaluate(*side.piece, side.t).d1));
      return std::abs(here - end) <= kKeptHeading;
    });
  }

  [[nodiscard]] bool at_curvature(const std::vector<Side>& sides, const ValueRange& kappas,
                                  bool high) const {
    const double end = high ? kappas.high : kappas.low;
    if (!std::isfinite(end)) return false;
    const double within = kSameCurvature * end_scale(sides, end);
    const auto at_end = [&](double here) { return std::abs(here - end) <= within; };
    // the point of arcs has all curvatures between both
    if (steps_at_joints(contour_.carrier)) return at_end(nearest_curvature(sides, kappas));
    return std::any_of(sides.begin(), sides.end(), [&](const Side& side) {
      return at_end(accurate_curvature(*side.piece, side.t));
    });
  }

  /// At the place of the contour nearest to a point that is on no joint; where a joint of other
  /// points, or of none, is that place but for rounding, on both sides of it.
  [[nodiscard]] std::vector<Side> sides_nearest(Vec2 p) const {
    const std::size_t n = contour_.pieces.size();
    std::size_t found = 0;
    double at = 0.0, least = HUGE_VAL;
    for (std::size_t i = 0; i < n; ++i) {
      const double t = nearest_parameter(contour_.pieces[i], p);
      const double away = norm(evaluate(contour_.pieces[i], t).point - p);
      if (away >= least) continue;
      least = away;
      found = i;
      at = t;
    }
    const Vec2 place = evaluate(contour_.pieces[found], at).point;
    const double rounding = kSamePlace * (std::abs(place.x) + std::abs(place.y));
    const auto is_at = [&](double end) {
      return norm(evaluate(contour_.pieces[found], end).point - place) <= rounding;
    };
    std::vector<Side> out;
    if (is_at(0.0) && (found > 0 || contour_.closed)) {
      out.push_back({&contour_.pieces[(found + n - 1) % n], 1.0});
    }
    out.push_back({&contour_.pieces[found], at});
    if (is_at(1.0) && (found + 1 < n || contour_.closed)) {
      out.push_back({&contour_.pieces[(found + 1) % n], 0.0});
    }
    return out;
  }

  static double heading_miss(const std::vector<Side>& sides, double theta) {
    double miss = 0.0;
    for (const Side& side : sides) {
      const double here = heading(evaluate(*side.piece, side.t).d1);
      miss = std::max(miss, std::abs(turn_between(theta, here)));
    }
    return miss;
  }

  /// Of the curvatures on both sides the one that is farthest from a range; of arcs, whose point
  /// has all curvatures between both, one that the range holds too, if there is any.
  [[nodiscard]] double nearest_curvature(const std::vector<Side>& sides,
                                         const ValueRange& kappas) const {
    AtPoint at;
    for (const Side& side : sides) {
      const double here = accurate_curvature(*side.piece, side.t);
      at.low = std::min(at.low, here);
      at.high = std::max(at.high, here);
    }
    if (steps_at_joints(contour_.carrier)) {
      const double from = std::max(at.low, kappas.low), to = std::min(at.high, kappas.high);
      if (from > to) return at.high < kappas.low ? at.high : at.low;
      return 0.5 * (from + to);
    }
    return beyond(kappas, at.low) > beyond(kappas, at.high) ? at.low : at.high;
  }

  /// What a curvature at an end of a range is measured against: that end, and of 0 the largest one
  /// around, as `curvature_miss` has it for a given 0.
  static double end_scale(const std::vector<Side>& sides, double end) {
    double scale = std::abs(end);
    for (const Side& side : sides) {
      for (const double t : {0.0, 1.0}) {
        if (end == 0.0) scale = std::max(scale, std::abs(accurate_curvature(*side.piece, t)));
      }
    }
    return scale;
  }

  [[nodiscard]] double curvature_miss(const std::vector<Side>& sides, double kappa) const {
    double low = HUGE_VAL, high = -HUGE_VAL, scale = std::abs(kappa);
    for (const Side& side : sides) {
      const double here = accurate_curvature(*side.piece, side.t);
      low = std::min(low, here);
      high = std::max(high, here);
      if (kappa != 0.0) continue;
      // a given 0 has no size of its own: against what turns beside it
      for (const double end : {0.0, 1.0}) {
        scale = std::max(scale, std::abs(accurate_curvature(*side.piece, end)));
      }
    }
    const bool between = steps_at_joints(contour_.carrier);
    const double miss = between ? std::max({0.0, low - kappa, kappa - high})
                                : std::max(std::abs(low - kappa), std::abs(high - kappa));
    return miss > 0.0 ? miss / scale : 0.0;
  }

  const Contour& contour_;
  std::vector<std::size_t> joint_;  // on each point, or the number of joints
};

/// Misses are told in steps of this (rad, or of the curvature), upward by half a step at least: the
/// rounding of their own evaluation stays below that, and nothing below it means anything.
constexpr double kMissStep = 1e-12;

double told(double miss) { return (std::floor(miss / kMissStep + 0.5) + 1.0) * kMissStep; }

}  // namespace

std::optional<double> passed_heading(const ValueRange& thetas, double theta) {
  const double here = turned_to(thetas, theta);
  if (beyond(thetas, here) <= kKeptHeading) return std::nullopt;
  return here < thetas.low ? thetas.low : thetas.high;
}

std::optional<double> passed_end(const ValueRange& kappas, double kappa) {
  if (beyond(kappas, kappa) <= kSameCurvature * scale_at(kappas, kappa)) return std::nullopt;
  return crossed_end(kappas, kappa);
}

std::vector<GivenDatum> passed_ends(const Contour& contour) {
  std::vector<GivenDatum> out;
  if (contour.given.empty()) return out;
  const GivenCheck check(contour);
  for (const GivenDatum& given : contour.given) {
    if (!given.thetas && !given.kappas) continue;
    const FixedData passed = check.passed_ends(given);
    if (passed.theta || passed.kappa) out.push_back({given.point, passed.theta, passed.kappa});
  }
  return out;
}

GivenReport measure_given(const Contour& contour) {
  GivenReport out;
  if (contour.given.empty()) return out;
  const GivenCheck miss_of(contour);
  for (const GivenDatum& given : contour.given) {
    const Miss miss = miss_of(given);
    out.headings += given.theta ? 1 : 0;
    out.curvatures += given.kappa ? 1 : 0;
    out.corners += given.corner && miss_of.stands_on_corner(given.point) ? 1 : 0;
    out.heading_ranges += given.thetas ? 1 : 0;
    out.curvature_ranges += given.kappas ? 1 : 0;
    const std::size_t before = out.active.size();
    miss_of.add_active(given, out.active);
    const auto at_end = [&](bool heading) {
      return std::any_of(out.active.begin() + static_cast<std::ptrdiff_t>(before), out.active.end(),
                         [heading](const ActiveRange& one) { return one.heading == heading; });
    };
    // a miss of 0 is one that rounding hides, but inside a range
    if (given.theta || miss.heading > 0.0 || at_end(true)) {
      out.heading_miss = std::max(out.heading_miss, told(miss.heading));
    }
    if (given.kappa || miss.curvature > 0.0 || at_end(false)) {
      out.curvature_miss = std::max(out.curvature_miss, told(miss.curvature));
    }
  }
  return out;
}

Result<void> keeps_given(const Contour& contour) {
  if (contour.given.empty()) return {};
  const GivenCheck miss_of(contour);
  for (const GivenDatum& given : contour.given) {
    const Miss miss = miss_of(given);
    if (given.corner && !miss_of.stands_on_corner(given.point)) {
      return error(ErrorCode::kCarrierCannotKeep, "no corner can be made there")
          .where(fmt::format("point {}", given.point + 1))
          .hint("mark another point, or none")
          .point(given.point);
    }
    const bool turned = !(miss.heading <= kKeptHeading);
    if (!turned && miss.curvature <= kSameCurvature) continue;
    const double off = turned ? miss.heading / kOneDegree : 100.0 * miss.curvature;
    return error(ErrorCode::kCarrierCannotKeep,
                 fmt::format(
                     "{} cannot keep the {} given there: the nearest found is off by {:.3g}{}",
                     to_string(contour.carrier), turned ? "heading" : "curvature", off,
                     turned ? " degrees" : " %"))
        .where(fmt::format("point {}", given.point + 1))
        .hint("give less there, or use carrier spiral or clothoids")
        .point(given.point)
        .value(off);
  }
  return {};
}

}  // namespace obvid::pipeline_detail
