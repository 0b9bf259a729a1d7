// SPDX-License-Identifier: Apache-2.0
#include "prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "obvid/series/coarse_polygon.h"

namespace obvid::pipeline_detail {
namespace {

FixedData merged(FixedData a, const FixedData& b) {
  if (!a.theta) a.theta = b.theta;
  if (!a.kappa) a.kappa = b.kappa;
  if (b.tolerance) a.tolerance = a.tolerance ? std::min(*a.tolerance, *b.tolerance) : b.tolerance;
  a.corner = a.corner || b.corner;
  return a;
}

/// Moves below this cannot be told from the rounding of the coordinates.
double least_move(Vec2 p) {
  constexpr double kRoundings = 16.0;
  return kRoundings * 0x1p-53 * (std::abs(p.x) + std::abs(p.y));
}

class Preparation {
 public:
  Preparation(const PointSeries& series, const FitJob& job) : series_(series), job_(job) {}

  Result<Prepared> run() {
    out_.convex = job_.convex;
    out_.primitives = job_.primitives;
    if (auto done = gather(); !done) return fail(done.error());
    give_ends();
    set_tolerances();
    close();
    cut();
    if (out_.points.size() < 2) {
      return fail({ErrorCode::kTooFewPoints, "a contour needs at least two distinct points", "",
                   "add points", -1, static_cast<double>(out_.points.size())});
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] Result<std::vector<FixedData>> all_fixed() const {
    std::vector<FixedData> fixed = series_.fixed;
    fixed.resize(series_.points.size());
    for (const PointWish& wish : job_.wishes) {
      if (wish.index >= fixed.size()) {
        return fail({ErrorCode::kBadOption, "there is no such point",
                     fmt::format("point {}", wish.index + 1),
                     fmt::format("the series has {} points", fixed.size()),
                     static_cast<std::ptrdiff_t>(wish.index), 0.0});
      }
      FixedData& data = fixed[wish.index];
      if (wish.theta) data.theta = wish.theta;
      if (wish.kappa) data.kappa = wish.kappa;
      data.corner = data.corner || wish.corner;
    }
    return fixed;
  }

  Result<void> gather() {
    const auto fixed = all_fixed();
    if (!fixed) return fail(fixed.error());
    std::size_t merges = 0;
    std::vector<std::size_t> place;  // of each point among those that are left
    for (std::size_t i = 0; i < series_.points.size(); ++i) {
      const Vec2 p = series_.points[i];
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
        return fail({ErrorCode::kNotFinite, "a coordinate is not a finite number",
                     "point " + std::to_string(i + 1), "remove the point",
                     static_cast<std::ptrdiff_t>(i), 0.0});
      }
      if (!out_.points.empty() && out_.points.back() == p) {
        ++merges;
        out_.fixed.back() = merged(out_.fixed.back(), (*fixed)[i]);
        place.push_back(out_.points.size() - 1);
        continue;
      }
      place.push_back(out_.points.size());
      out_.points.push_back(p);
      out_.fixed.push_back((*fixed)[i]);
    }
    if (merges > 0) {
      out_.warnings.push_back(std::to_string(merges) +
                              " points equal to the one before were merged");
    }
    if (out_.points.size() < 2) {
      return fail({ErrorCode::kTooFewPoints, "a contour needs at least two distinct points", "",
                   "add points", -1, static_cast<double>(out_.points.size())});
    }
    if (series_.kept.empty()) return {};
    out_.kept.resize(out_.points.size());
    for (const KeptPiece& one : series_.kept) out_.kept[place[one.from]] = one.piece;
    return keeps_wishes(place);
  }

  /// Whether a piece that stays as it is begins or ends at a point.
  [[nodiscard]] bool beside_kept(std::size_t i) const {
    if (out_.kept.empty()) return false;
    const std::size_t n = out_.points.size();
    return out_.kept[i].has_value() || out_.kept[(i + n - 1) % n].has_value();
  }

  /// What a user fixes beside a line or arc of a drawing would change it.
  [[nodiscard]] Result<void> keeps_wishes(const std::vector<std::size_t>& place) const {
    const auto refused = [](std::size_t point) {
      return fail({ErrorCode::kFixedDataContradict,
                   "a line or arc of the drawing begins or ends here and stays as it is",
                   fmt::format("point {}", point + 1),
                   "drop the fixed heading or radius, or take points of the drawing with "
                   "--drawing points",
                   static_cast<std::ptrdiff_t>(point), 0.0});
    };
    for (const PointWish& wish : job_.wishes) {
      if ((wish.theta || wish.kappa) && beside_kept(place[wish.index])) return refused(wish.index);
    }
    const std::size_t last = out_.points.size() - 1;
    if ((job_.start_heading || job_.start_kappa) && out_.kept.front()) return refused(0);
    if ((job_.end_heading || job_.end_kappa) && last > 0 && out_.kept[last - 1]) {
      return refused(last);
    }
    return {};
  }

  void give_ends() {
    FixedData &first = out_.fixed.front(), &last = out_.fixed.back();
    if (job_.start_heading) first.theta = job_.start_heading;
    if (job_.start_kappa) first.kappa = job_.start_kappa;
    if (job_.end_heading) last.theta = job_.end_heading;
    if (job_.end_kappa) last.kappa = job_.end_kappa;
  }

  void set_tolerances() {
    const double noise = job_.noise.value_or(0.0);
    const Vec2 common = job_.noise_from_rounding ? series_.rounding : Vec2{noise, noise};
    double least = 0.0;
    for (const Vec2 p : out_.points) least = std::max(least, least_move(p));
    for (std::size_t i = 0; i < out_.points.size(); ++i) {
      const FixedData& f = out_.fixed[i];
      const double reach = beside_kept(i) ? 0.0 : f.tolerance ? *f.tolerance : across(i, common);
      out_.tolerance.push_back(reach < least ? 0.0 : reach);
    }
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

  void close() {
    const std::size_t n = out_.points.size();
    const bool returns =
        n > 2 && returns_to_start(out_.points, out_.tolerance.front(), out_.tolerance.back());
    out_.closed =
        job_.closing == Closing::kClosed || (job_.closing == Closing::kAutomatic && returns);
    if (!out_.closed || !returns) return;
    const JoinedPoint joined = join_points(out_.points.front(), out_.tolerance.front(),
                                           out_.points.back(), out_.tolerance.back());
    if (out_.points.front() != out_.points.back()) {
      out_.points.front() = joined.point;
      out_.tolerance.front() = joined.tolerance;
      out_.warnings.emplace_back(
          "the last point lies within its tolerance of the first one: both became one");
    }
    out_.fixed.front() = merged(out_.fixed.front(), out_.fixed.back());
    out_.points.pop_back();
    out_.tolerance.pop_back();
    out_.fixed.pop_back();
    if (!out_.kept.empty()) out_.kept.pop_back();
  }

  /// The printed rounding where it is one: few digits beside the chords belong to nominal sizes.
  [[nodiscard]] double printed_blur() const {
    constexpr double kLargestPart = 0.05;  // of the middle one of all chords
    std::vector<double> chords;
    for (std::size_t i = 1; i < out_.points.size(); ++i) {
      chords.push_back(norm(out_.points[i] - out_.points[i - 1]));
    }
    const auto middle = chords.begin() + static_cast<std::ptrdiff_t>(chords.size() / 2);
    std::nth_element(chords.begin(), middle, chords.end());
    const double rounding = std::max(series_.rounding.x, series_.rounding.y);
    return rounding <= kLargestPart * *middle ? rounding : 0.0;
  }

  void cut() {
    CornerWishes wishes;
    wishes.find = job_.find_corners;
    if (job_.corner_angle) wishes.angle = *job_.corner_angle;
    // points that are met exactly were rounded all the same, in print and as doubles
    const double printed = printed_blur();
    std::vector<double> blur = out_.tolerance;
    for (std::size_t i = 0; i < blur.size(); ++i) {
      blur[i] = std::max({blur[i], printed, least_move(out_.points[i])});
    }
    std::vector<std::size_t> corners =
        out_.kept.empty() ? find_corners(out_.points, blur, out_.closed, out_.fixed, wishes)
                          : cuts_of_drawing(blur, wishes);
    if (out_.kept.empty() && wishes.find) look_for_polygon(blur, wishes.angle, corners);
    for (const double t : out_.tolerance) out_.reach.push_back(t);
    for (const std::size_t i : corners) out_.reach[i] = 0.0;  // both sides meet in the point itself
    out_.split = split_sections(out_.points.size(), corners, out_.closed);
    if (std::all_of(out_.tolerance.begin(), out_.tolerance.end(),
                    [](double t) { return t == 0.0; })) {
      out_.tolerance.clear();
    }
    list_given();
    const bool nothing = std::all_of(out_.fixed.begin(), out_.fixed.end(),
                                     [](const FixedData& f) { return !f.theta && !f.kappa; });
    if (nothing) out_.fixed.clear();
  }

  void list_given() {
    for (std::size_t i = 0; i < out_.fixed.size(); ++i) {
      const FixedData& f = out_.fixed[i];
      const bool corner = f.corner && !beside_kept(i);  // nobody asked for those of a drawing
      if (f.theta || f.kappa || corner) out_.given.push_back({i, f.theta, f.kappa, corner});
    }
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
    constexpr double kDegree = std::numbers::pi / 180.0;
    out_.polygon = fmt::format(
        "the points turn by {:.0f} degrees, and {} of {} that turn so were not taken for corners: "
        "they may be a coarse curve; --corner-angle {:.0f} makes corners of all of them, --corner-at "
        "of single ones, --no-corners says that there are none",
        polygon.turn / kDegree, all.size() - corners.size(), polygon.corners.size(),
        std::floor(angle / kDegree));
    out_.warnings.push_back(out_.polygon);
  }

  /// Both ends of what stays as it is, and the corners of the points between.
  [[nodiscard]] std::vector<std::size_t> cuts_of_drawing(const std::vector<double>& blur,
                                                         const CornerWishes& wishes) const {
    const std::size_t n = out_.points.size();
    std::vector<std::size_t> cuts;
    const bool open = !out_.closed;
    for (std::size_t i = 0; i < n; ++i) {
      const bool end = open && (i == 0 || i + 1 == n);
      if (beside_kept(i) && !end) cuts.push_back(i);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const bool begins = !out_.kept[i] && (beside_kept(i) || (open && i == 0));
      if (begins) add_corners_from(i, blur, wishes, cuts);
    }
    std::sort(cuts.begin(), cuts.end());
    return cuts;
  }

  /// Corners inside the points from `first` to the next piece that stays, an open series of its own.
  void add_corners_from(std::size_t first, const std::vector<double>& blur,
                        const CornerWishes& wishes, std::vector<std::size_t>& cuts) const {
    const std::size_t n = out_.points.size();
    std::vector<std::size_t> index{first};
    while (!out_.kept[index.back()] && (out_.closed || index.back() + 1 < n)) {
      index.push_back((index.back() + 1) % n);
    }
    std::vector<Vec2> points;
    std::vector<double> tolerance;
    std::vector<FixedData> fixed;
    for (const std::size_t i : index) {
      points.push_back(out_.points[i]);
      tolerance.push_back(blur[i]);
      fixed.push_back(out_.fixed[i]);
    }
    for (const std::size_t k : find_corners(points, tolerance, false, fixed, wishes)) {
      cuts.push_back(index[k]);
    }
  }

  const PointSeries& series_;
  const FitJob& job_;
  Prepared out_;
};

}  // namespace

Result<Prepared> prepare(const PointSeries& series, const FitJob& job) {
  return Preparation(series, job).run();
}

}  // namespace obvid::pipeline_detail
