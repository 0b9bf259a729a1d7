// SPDX-License-Identifier: Apache-2.0
#include "fit/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>

#include "fit/closing_hint.h"
#include "fit/fixed_once.h"
#include "obvid/core/internal/figures.h"
#include "obvid/core/units.h"
#include "obvid/numeric/internal/median.h"
#include "obvid/series/internal/coarse_polygon.h"
#include "obvid/series/internal/order.h"
#include "obvid/series/internal/scatter.h"

namespace obvid::pipeline_detail {
namespace {

/// Moves below this cannot be told from the rounding of the coordinates.
double least_move(Vec2 p) {
  constexpr double kRoundings = 16.0;
  return kRoundings * 0x1p-53 * (std::abs(p.x) + std::abs(p.y));
}

/// What the least largest curvature is exceeded by, so that there is room to choose the rest.
constexpr double kAboveLeastCurvature = 1.005;

class Preparation {
 public:
  Preparation(const PointSeries& series, const FitJob& job) : series_(series), job_(job) {}

  Result<Prepared> run() {
    out_.convex = job_.convex;
    out_.prefer = job_.prefer;
    out_.above_least = job_.above_least.value_or(kAboveLeastCurvature);
    out_.primitives = job_.primitives;
    out_.period = job_.period;
    OBVID_TRY(gather());
    OBVID_TRY(give_ends());
    OBVID_TRY(has_enough_data());
    OBVID_TRY(set_tolerances());
    OBVID_TRY(close());
    for (const FixedOnce& one : fixed_) out_.fixed.push_back(one.data);
    cut();
    if (out_.points.size() < 2) {
      return error(ErrorCode::kTooFewPoints, "a contour needs at least two distinct points")
          .hint("add points")
          .value(static_cast<double>(out_.points.size()));
    }
    OBVID_TRY(can_prefer());
    if (job_.primitives && out_.exact()) {
      out_.warnings.emplace_back(
          out_.kept.empty()
              ? "--primitives looks for lines and arcs within the points' tolerances, and exact "
                "points have none: --noise gives them"
              : "--primitives finds nothing to do: lines and arcs of the drawing stay as they are "
                "drawn, exactly, whatever --noise; --drawing points takes points of them instead");
    }
    return std::move(out_);
  }

 private:
  /// Two points leave any curve, and turns, unless both have a heading or a piece stays between.
  [[nodiscard]] Result<void> has_enough_data() const {
    if (out_.points.size() != 2 || !out_.kept.empty()) return {};
    const auto headed = [](const FixedOnce& one) { return one.data.theta || one.data.thetas; };
    if (headed(fixed_[0]) && headed(fixed_[1])) return {};
    return error(ErrorCode::kTooFewPoints, "a contour needs 3 distinct points, the series has 2")
        .hint("two do when both have a heading")
        .value(2.0);
  }

  /// Choices other than the fairest chain are made among curves through the points.
  [[nodiscard]] Result<void> can_prefer() const {
    if (job_.prefer == Prefer::kFair) return {};
    const auto refused = [](const char* why) {
      return error(ErrorCode::kBadOption, why)
          .where("--prefer")
          .hint("leave it out: the fairest is taken");
    };
    if (info_of(job_.carrier).needs == CarrierNeeds::kPoints) {
      return refused("the spline of CAD systems leaves nothing to prefer");
    }
    if (!out_.exact())
      return refused("only where points are met, without noise, is there a choice");
    return {};
  }

  [[nodiscard]] Result<void> has_constrained_points() const {
    const std::size_t n = series_.points.size();
    for (const PointConstraint& constraint : job_.constraints) {
      if (constraint.index < n) continue;
      return error(ErrorCode::kBadOption, "there is no such point")
          .where(fmt::format("point {}", constraint.index + 1))
          .hint(fmt::format("the series has {} points", n))
          .point(constraint.index);
    }
    return {};
  }

  [[nodiscard]] FixedOnce of_series(std::size_t i) const {
    FixedOnce out;
    if (i < series_.fixed.size()) out.data = series_.fixed[i];
    return out;
  }

  /// `place`: of each point of the series among those that are left.
  Result<void> give_constraints(const std::vector<std::size_t>& place) {
    for (const PointConstraint& constraint : job_.constraints) {
      FixedOnce more = fixed_by(FixedBy::kPoint, constraint.theta, constraint.kappa);
      more.data.thetas = constraint.thetas;
      more.data.kappas = constraint.kappas;
      more.data.corner = constraint.corner;
      auto done = add_fixed(fixed_[place[constraint.index]], more, constraint.index);
      if (!done) return done;
    }
    return {};
  }

  Result<void> gather() {
    OBVID_TRY(has_constrained_points());
    std::size_t merges = 0;
    std::vector<std::size_t> place;  // of each point among those that are left
    for (std::size_t i = 0; i < series_.points.size(); ++i) {
      const Vec2 p = series_.points[i];
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
        return error(ErrorCode::kNotFinite, "a coordinate is not a finite number")
            .where("point " + std::to_string(i + 1))
            .hint("remove the point")
            .point(i);
      }
      if (!out_.points.empty() && out_.points.back() == p) {
        ++merges;
        OBVID_TRY(add_fixed(fixed_.back(), of_series(i), i));
        place.push_back(out_.points.size() - 1);
        continue;
      }
      place.push_back(out_.points.size());
      out_.points.push_back(p);
      fixed_.push_back(of_series(i));
    }
    if (merges > 0) {
      out_.warnings.push_back(std::to_string(merges) +
                              " points equal to the one before were merged");
    }
    if (out_.points.size() < 2) {
      return error(ErrorCode::kTooFewPoints, "a contour needs at least two distinct points")
          .hint("add points")
          .value(static_cast<double>(out_.points.size()));
    }
    if (!series_.kept.empty()) {
      out_.kept.resize(out_.points.size());
      for (const KeptPiece& one : series_.kept) out_.kept[place[one.from]] = one.piece;
      OBVID_TRY(keeps_constraints(place));
    }
    return give_constraints(place);
  }

  /// Whether a piece that stays as it is begins or ends at a point.
  [[nodiscard]] bool beside_kept(std::size_t i) const {
    if (out_.kept.empty()) return false;
    const std::size_t n = out_.points.size();
    return out_.kept[i].has_value() || out_.kept[(i + n - 1) % n].has_value();
  }

  /// What a user fixes beside a line or arc of a drawing would change it.
  [[nodiscard]] Result<void> keeps_constraints(const std::vector<std::size_t>& place) const {
    const auto refused = [](std::size_t point) {
      return error(ErrorCode::kFixedDataContradict,
                   "a line or arc of the drawing begins or ends here and stays as it is")
          .where(fmt::format("point {}", point + 1))
          .hint(
              "drop the fixed heading or radius, or take points of the drawing with "
              "--drawing points")
          .point(point);
    };
    for (const PointConstraint& constraint : job_.constraints) {
      const bool says_how =
          constraint.theta || constraint.kappa || constraint.thetas || constraint.kappas;
      if (says_how && beside_kept(place[constraint.index])) return refused(constraint.index);
    }
    const std::size_t last = out_.points.size() - 1;
    if (fixed_start().data.says_how() && out_.kept.front()) return refused(0);
    if (fixed_end().data.says_how() && last > 0 && out_.kept[last - 1]) {
      return refused(last);
    }
    return {};
  }

  Result<void> give_ends() {
    OBVID_TRY(add_fixed(fixed_.front(), fixed_start(), 0));
    return add_fixed(fixed_.back(), fixed_end(), fixed_.size() - 1);
  }

  [[nodiscard]] FixedOnce fixed_start() const {
    FixedOnce out = fixed_by(FixedBy::kStart, job_.start_heading, job_.start_kappa);
    out.data.thetas = job_.start_thetas;
    out.data.kappas = job_.start_kappas;
    return out;
  }
  [[nodiscard]] FixedOnce fixed_end() const {
    FixedOnce out = fixed_by(FixedBy::kEnd, job_.end_heading, job_.end_kappa);
    out.data.thetas = job_.end_thetas;
    out.data.kappas = job_.end_kappas;
    return out;
  }

  /// The noise of all points alike: what was said, what the digits say, or what the points show.
  Result<Vec2> common_noise() {
    if (job_.noise_from_rounding && job_.primitives) {
      // a line that was built passes its points as far as half the diagonal of their cells
      const double diagonal = norm(series_.rounding);
      return Vec2{diagonal, diagonal};
    }
    if (job_.noise_from_rounding) return series_.rounding;
    if (!job_.noise_from_scatter) {
      const double noise = job_.noise.value_or(0.0);
      return Vec2{noise, noise};
    }
    auto seen = scatter_of(out_.points);
    if (!seen) {
      if (auto hint = no_order_hint(out_.points)) {
        seen = error(ErrorCode::kOutOfOrder,
                     "noise shows between neighbours, and these do not follow one another")
                   .hint(std::move(*hint));
      }
      seen.error().where = "--noise auto";
      return fail(seen.error());
    }
    out_.warnings.push_back(fmt::format(
        "--noise auto: points may move {} {}, {} times their scatter of {} about cubics through "
        "four neighbours each (median of {} points)",
        significant(seen->bound, 4), series_.units.text(), significant(seen->bound_factor, 3),
        significant(seen->deviation, 4), seen->places));
    return Vec2{seen->bound, seen->bound};
  }

  Result<void> set_tolerances() {
    const Result<Vec2> noise = common_noise();
    OBVID_TRY(noise);
    Vec2 common = *noise;
    warn_of_own_tolerances();
    double least = 0.0;
    for (const Vec2 p : out_.points) least = std::max(least, least_move(p));
    // all alike: some points that are met and some that move by roundings would be no contour's
    // gain
    constexpr double kWorthMoving = 4.0;
    const double asked = std::max(common.x, common.y);
    if (asked < kWorthMoving * least) {
      common = {};
      if (job_.noise.value_or(0.0) > 0.0 && !job_.noise_from_scatter) {
        out_.warnings.push_back(fmt::format(
            "--noise {:.4g} says nothing here: moves below {:.2g} {} cannot be told from the "
            "rounding of coordinates as large as these, and the points are met as they are",
            asked, kWorthMoving * least, series_.units.text()));
      }
    }
    for (std::size_t i = 0; i < out_.points.size(); ++i) {
      const FixedData& f = fixed_[i].data;
      const double reach = beside_kept(i) ? 0.0 : f.tolerance ? *f.tolerance : across(i, common);
      out_.tolerance.push_back(reach < least ? 0.0 : reach);
    }
    return {};
  }

  /// Tolerances of single points go before one for all.
  void warn_of_own_tolerances() {
    const bool asked =
        job_.noise.has_value() || job_.noise_from_rounding || job_.noise_from_scatter;
    const auto own = std::count_if(fixed_.begin(), fixed_.end(), [](const FixedOnce& one) {
      return one.data.tolerance.has_value();
    });
    if (!asked || own == 0) return;
    const auto all = static_cast<std::ptrdiff_t>(fixed_.size());
    out_.warnings.push_back(
        own == all ? "--noise says nothing here: the file gives every point a tolerance of its own"
                   : fmt::format("--noise holds for {} of {} points: the file gives the others a "
                                 "tolerance of their own",
                                 all - own, all));
  }

  /// How far the ellipse with these semi-axes reaches across the series at a point.
  [[nodiscard]] double across(std::size_t i, Vec2 axes) const {
    if (axes.x == axes.y) return axes.x;
    if (!(std::min(axes.x, axes.y) > 0.0)) return 0.0;
    const std::size_t last = out_.points.size() - 1;
    const Vec2 along = out_.points[std::min(i + 1, last)] - out_.points[i > 0 ? i - 1 : 0];
    const Vec2 normal = left_normal(along);
    return norm(normal) / std::hypot(normal.x / axes.x, normal.y / axes.y);
  }

  Result<void> close() {
    const std::size_t n = out_.points.size();
    const bool again =
        n > 2 && norm(out_.points.back() - out_.points.front()) <= least_move(out_.points.front());
    const bool returns = n > 2 && (again || returns_to_start(out_.points, out_.tolerance.front(),
                                                             out_.tolerance.back()));
    out_.closed =
        job_.closing == Closing::kClosed || (job_.closing == Closing::kAutomatic && returns);
    if (!out_.closed && job_.closing == Closing::kAutomatic && out_.kept.empty()) {
      auto hint = hint_at_closing(out_.points, series_.units);
      if (hint) out_.warnings.push_back(std::move(*hint));
    }
    if (!out_.closed || !returns) return {};
    if (again && out_.points.front() != out_.points.back()) {
      out_.warnings.emplace_back(
          "the last point is the first one again but for rounding: the first one stands for both");
    }
    if (again) {
      out_.tolerance.front() = std::min(out_.tolerance.front(), out_.tolerance.back());
    } else {
      const JoinedPoint joined = join_points(out_.points.front(), out_.tolerance.front(),
                                             out_.points.back(), out_.tolerance.back());
      const double away = std::max(norm(joined.point - out_.points.front()),
                                   norm(joined.point - out_.points.back()));
      out_.points.front() = joined.point;
      out_.tolerance.front() = joined.tolerance;
      out_.warnings.push_back(fmt::format(
          "the last point lies within its tolerance of the first one: the contour is closed, and "
          "both became one at {:.9g}, {:.9g}, up to {:.4g} from them, where moves are counted "
          "from; --open keeps both",
          joined.point.x, joined.point.y, away));
    }
    if (auto done = add_fixed(fixed_.front(), fixed_.back(), 0); !done) {
      done.error().hint += ", or ask for an open contour (--open): the last point is the first one";
      return done;
    }
    out_.points.pop_back();
    out_.tolerance.pop_back();
    fixed_.pop_back();
    if (!out_.kept.empty()) out_.kept.pop_back();
    return {};
  }

  [[nodiscard]] std::vector<double> chords() const {
    std::vector<double> out;
    for (std::size_t i = 1; i < out_.points.size(); ++i) {
      out.push_back(norm(out_.points[i] - out_.points[i - 1]));
    }
    return out;
  }

  /// The printed rounding where it is one: few digits beside the chords belong to nominal sizes.
  [[nodiscard]] double printed_blur() const {
    constexpr double kLargestPart = 0.05;  // of the middle one of all chords
    const double rounding = std::max(series_.rounding.x, series_.rounding.y);
    return rounding <= kLargestPart * median_of(chords()) ? rounding : 0.0;
  }

  void cut() {
    CornerConstraints constraints;
    constraints.find = job_.find_corners;
    if (job_.corner_angle) constraints.angle = *job_.corner_angle;
    constraints.exact = std::all_of(out_.tolerance.begin(), out_.tolerance.end(),
                                    [](double t) { return t == 0.0; });
    // points that are met exactly were rounded all the same, in print and as doubles
    const double printed = printed_blur();
    std::vector<double> blur = out_.tolerance;
    for (std::size_t i = 0; i < blur.size(); ++i) {
      blur[i] = std::max({blur[i], printed, least_move(out_.points[i])});
    }
    std::vector<std::size_t> corners =
        out_.kept.empty() ? find_corners(out_.points, blur, out_.closed, out_.fixed, constraints)
                          : cuts_of_drawing(blur, constraints);
    if (out_.kept.empty() && constraints.find) look_for_polygon(blur, constraints.angle, corners);
    for (const double t : out_.tolerance) out_.reach.push_back(t);
    for (const std::size_t i : corners) out_.reach[i] = 0.0;  // both sides meet in the point itself
    out_.split = split_sections(out_.points.size(), corners, out_.closed);
    if (std::all_of(out_.tolerance.begin(), out_.tolerance.end(),
                    [](double t) { return t == 0.0; })) {
      out_.tolerance.clear();
    }
    list_given();
    const bool nothing = std::all_of(out_.fixed.begin(), out_.fixed.end(),
                                     [](const FixedData& f) { return !f.says_how(); });
    if (nothing) out_.fixed.clear();
  }

  void list_given() {
    for (std::size_t i = 0; i < out_.fixed.size(); ++i) {
      const FixedData& f = out_.fixed[i];
      const bool corner = f.corner && !beside_kept(i);  // nobody asked for those of a drawing
      if (!f.says_how() && !corner) continue;
      out_.asked.push_back({i, f.theta, f.kappa, corner, f.thetas, f.kappas});
    }
    out_.given = out_.asked;
  }

  /// Corners of a polygon, when an angle was asked for; else a word that there may be some.
  void look_for_polygon(const std::vector<double>& blur, double angle,
                        std::vector<std::size_t>& corners) {
    const CoarsePolygon polygon = coarse_polygon(out_.points, blur, out_.closed, angle);
    if (!polygon.found()) return;
    std::vector<std::size_t> all;
    std::set_union(corners.begin(), corners.end(), polygon.corners.begin(), polygon.corners.end(),
                   std::back_inserter(all));
    if (job_.corner_angle) {
      corners = std::move(all);
      return;
    }
    if (all.size() == corners.size()) return;
    out_.polygon = fmt::format(
        "the points turn by {:.0f} degrees, and {} of {} that turn so were not taken for corners: "
        "they may be a coarse curve; --corner-angle {:.0f} makes corners of all of them, "
        "--corner-at "
        "of single ones, --no-corners says that there are none",
        polygon.turn / kOneDegree, all.size() - corners.size(), polygon.corners.size(),
        std::floor(angle / kOneDegree));
    out_.warnings.push_back(out_.polygon);
  }

  /// Both ends of what stays as it is, and the corners of the points between.
  [[nodiscard]] std::vector<std::size_t> cuts_of_drawing(
      const std::vector<double>& blur, const CornerConstraints& constraints) const {
    const std::size_t n = out_.points.size();
    std::vector<std::size_t> cuts;
    const bool open = !out_.closed;
    for (std::size_t i = 0; i < n; ++i) {
      const bool end = open && (i == 0 || i + 1 == n);
      if (beside_kept(i) && !end) cuts.push_back(i);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const bool begins = !out_.kept[i] && (beside_kept(i) || (open && i == 0));
      if (begins) add_corners_from(i, blur, constraints, cuts);
    }
    std::sort(cuts.begin(), cuts.end());
    return cuts;
  }

  /// Corners inside the points from `first` to the next piece that stays, an open series of its
  /// own.
  void add_corners_from(std::size_t first, const std::vector<double>& blur,
                        const CornerConstraints& constraints,
                        std::vector<std::size_t>& cuts) const {
    const std::size_t n = out_.points.size();
    std::vector<std::size_t> index{first};
    while (!out_.kept[index.back()] && (out_.closed || index.back() + 1 < n)) {
      index.push_back((index.back() + 1) % n);
    }
    std::vector<Vec2> points;
    std::vector<double> tolerance;
    std::vector<FixedData> fixed;
    fixed.reserve(index.size());
    for (const std::size_t i : index) {
      points.push_back(out_.points[i]);
      tolerance.push_back(blur[i]);
      fixed.push_back(out_.fixed[i]);
    }
    for (const std::size_t k : find_corners(points, tolerance, false, fixed, constraints)) {
      cuts.push_back(index[k]);
    }
  }

  const PointSeries& series_;
  const FitJob& job_;
  std::vector<FixedOnce> fixed_;  // of each point
  Prepared out_;
};

}  // namespace

Result<Prepared> prepare(const PointSeries& series, const FitJob& job) {
  return Preparation(series, job).run();
}

Result<void> check_noise_in_space(const FitJob& job) {
  if (!job.noise_from_scatter) return {};
  return error(ErrorCode::kBadOption, "the noise is estimated of points in a plane only")
      .where("--noise auto")
      .hint("say how far the points may move, or rounding");
}

}  // namespace obvid::pipeline_detail
