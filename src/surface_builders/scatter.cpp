// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "bounding_rectangle.h"
#include "height_fit.h"
#include "network_curves.h"
#include "obvid/curve/internal/basis.h"
#include "obvid/geom/internal/angle.h"
#include "plane_neighbours.h"
#include "scatter_outliers.h"

namespace obvid {
namespace {

constexpr std::size_t kMostControlPoints = 40000;
constexpr const char* kStage = "surface near points";

Result<void> check_options(const std::vector<Vec3>& points, const ScatterOptions& options) {
  OBVID_TRY(check_tolerance(options.tolerance));
  if (!is_finite(options.up) || !(norm(options.up) > 0.0)) {
    return error(ErrorCode::kBadOption, "the direction of the heights has no length");
  }
  if (!(options.steepest > 0.0 && options.steepest < 0.5 * std::numbers::pi)) {
    return error(ErrorCode::kBadOption, "the steepest slope does not lie between 0 and 90 degrees");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_finite(points[i])) continue;
    return error(ErrorCode::kNotFinite, fmt::format("point {} is not finite", i + 1)).point(i);
  }
  if (points.size() >= 3) return {};
  return error(ErrorCode::kTooFewPoints, fmt::format("{} points span no surface", points.size()))
      .hint("give 3 points at least that do not lie on one line");
}

Vec3 centre_of(const std::vector<Vec3>& points) {
  Vec3 centre;
  for (const Vec3& p : points) centre = centre + p / static_cast<double>(points.size());
  return centre;
}

/// Perpendicular to `up`; x and y of space where up is z.
Frame frame_over(Vec3 origin, Vec3 up) {
  const Vec3 normal = unit(up / std::max({std::abs(up.x), std::abs(up.y), std::abs(up.z)}));
  const bool along_x = std::abs(normal.x) > std::max(std::abs(normal.y), std::abs(normal.z));
  const Vec3 axis = along_x ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0};
  const Vec3 x = unit(axis - dot(axis, normal) * normal);
  return {origin, x, cross(normal, x)};
}

std::vector<PlacedHeight> placed_over(const Frame& plane, const std::vector<Vec3>& points) {
  std::vector<PlacedHeight> out;
  out.reserve(points.size());
  for (const Vec3& p : points) out.push_back({plane.in_plane(p), plane.height(p)});
  return out;
}

std::vector<Vec2> places_of(const std::vector<PlacedHeight>& points) {
  std::vector<Vec2> out;
  out.reserve(points.size());
  for (const PlacedHeight& p : points) out.push_back(p.place);
  return out;
}

/// Refuses neighbours that leave no room for a surface of the steepest slope.
Result<void> check_steepness(const std::vector<PlacedHeight>& points,
                             const ScatterNeighbours& neighbours, const std::vector<char>& used,
                             const ScatterOptions& options, std::size_t outliers) {
  const double most = std::tan(options.steepest);
  std::size_t steep = 0, one = 0, other = 0, counted = 0;
  double worst = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (used[i] == 0) continue;
    ++counted;
    bool here = false;
    for (std::size_t k = 0; k < neighbours.number; ++k) {
      const std::size_t j = neighbours.begin_of(i)[k];
      if (used[j] == 0) continue;
      const double rise = std::abs(points[i].height - points[j].height) - 2.0 * options.tolerance;
      const double run = norm(points[i].place - points[j].place);
      if (!(rise > most * run) || !(rise > 0.0)) continue;
      here = true;
      const double slope = std::atan2(rise, run);
      if (slope <= worst) continue;
      worst = slope;
      one = std::min(i, j);
      other = std::max(i, j);
    }
    steep += here ? 1 : 0;
  }
  if (steep == 0) return {};
  const double apart = norm(points[one].place - points[other].place);
  const double rise = std::abs(points[one].height - points[other].height);
  return error(ErrorCode::kSurfaceFolds,
               fmt::format(
                   "points {} and {} lie {:.4g} apart in the plane and {:.4g} in height: a surface "
                   "within {:g} of both rises by {:.1f} degrees there; {} of {} points have such a "
                   "neighbour",
                   one + 1, other + 1, apart, rise, options.tolerance, worst / kOneDegree, steep,
                   counted))
      .hint(fmt::format("a wall, a fold, an outlier ({} found) or noise above the tolerance: give "
                        "another direction (--up), leave outliers out (--drop-outliers), raise "
                        "--tolerance, or allow more (--steepest, degrees)",
                        outliers))
      .points(one, other)
      .value(worst / kOneDegree);
}

/// Heights over a rectangle without the plane through them: it comes back exactly.
struct Levelled {
  std::vector<HeightPoint> points;
  double at_corner = 0.0, along_u = 0.0, along_v = 0.0;  ///< of the plane
};

Levelled levelled(const std::vector<Vec2>& places, const std::vector<double>& heights) {
  const auto n = static_cast<double>(places.size());
  double u = 0.0, v = 0.0, h = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    u += places[i].x / n;
    v += places[i].y / n;
    h += heights[i] / n;
  }
  double uu = 0.0, uv = 0.0, vv = 0.0, uh = 0.0, vh = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double a = places[i].x - u, b = places[i].y - v, c = heights[i] - h;
    uu += a * a;
    uv += a * b;
    vv += b * b;
    uh += a * c;
    vh += b * c;
  }
  Levelled out;
  const double det = uu * vv - uv * uv;
  if (det > 0.0) {
    out.along_u = (vv * uh - uv * vh) / det;
    out.along_v = (uu * vh - uv * uh) / det;
  }
  out.at_corner = h - out.along_u * u - out.along_v * v;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double plane = out.at_corner + out.along_u * places[i].x + out.along_v * places[i].y;
    out.points.push_back({places[i].x, places[i].y, heights[i] - plane});
  }
  return out;
}

/// Knots that follow the residuals, weights that follow the tolerance.
class Refinement {
 public:
  Refinement(const std::vector<HeightPoint>& points, double width, double depth, double tolerance)
      : points_(points), width_(width), depth_(depth), tolerance_(tolerance) {}

  /// True when within the tolerance; false when no more knots are to be had.
  Result<bool> run(const RunContext& run) {
    for (;;) {
      OBVID_TRY(level(run));
      if (worst_ <= tolerance_) return true;
      progress_ = std::max(progress_, part_done());
      OBVID_TRY(tell(run, kStage, progress_));
      if (!refine()) return false;
    }
  }

  [[nodiscard]] const HeightSpline& spline() const { return spline_; }
  [[nodiscard]] double weight() const { return weight_; }
  [[nodiscard]] double bending() const { return bending_; }

 private:
  // of the weight that makes both matrices equally large
  static constexpr double kUsual = 1e-8, kLeast = 1e-12, kMost = 1.0, kStep = 100.0;

  Result<void> level(const RunContext& run) {
    const HeightFit fit(points_, knots_u_, knots_v_, width_, depth_);
    double share = kUsual;
    worst_ = HUGE_VAL;
    for (; share <= kMost; share *= kStep) {  // more, where the equations were singular
      OBVID_TRY(take(fit, share, run));
      if (worst_ < HUGE_VAL) break;
    }
    if (worst_ > tolerance_ && worst_ <= kStep * tolerance_) OBVID_TRY(take(fit, kLeast, run));
    if (!(worst_ <= tolerance_)) return {};
    const double taken = weight_ / fit.balance();
    for (share = kMost; share > kStep * taken / 10.0; share /= kStep) {
      OBVID_TRY(take(fit, share, run));
      if (weight_ == share * fit.balance()) break;
    }
    bending_ = fit.bending(spline_);
    return {};
  }

  /// Takes the spline of this weight when it is nearer, or within the tolerance.
  Result<void> take(const HeightFit& fit, double share, const RunContext& run) {
    auto solved = fit.solved(share * fit.balance(), run);
    OBVID_TRY(solved);
    if (!*solved) return {};
    double worst = 0.0;
    std::vector<double> off;
    off.reserve(points_.size());
    for (const HeightPoint& p : points_) {
      off.push_back(std::abs((*solved)->at(p.u, p.v) - p.height));
      worst = std::max(worst, off.back());
    }
    if (!(worst <= tolerance_) && !(worst < worst_)) return {};
    worst_ = worst;
    off_ = std::move(off);
    spline_ = std::move(**solved);
    weight_ = share * fit.balance();
    return {};
  }

  [[nodiscard]] double part_done() const {
    const double points = static_cast<double>(spline_.value.size());
    return std::log(points) / std::log(static_cast<double>(kMostControlPoints));
  }

  struct Span {
    double off = 0.0;  ///< largest residual that this span is to be halved for
    bool u = true;
    double middle = 0.0;
  };

  bool refine() {
    constexpr double kAlso = 1.0 / 16.0;  // what halving leaves of a cubic's error
    constexpr double kAlike = 1.5;        // sides of a cell that are both halved
    constexpr double kShortest = 1.0 / (1U << 30U);
    const double limit = std::max(tolerance_, kAlso * worst_);
    const std::vector<double> at_u = distinct(knots_u_), at_v = distinct(knots_v_);
    std::vector<Span> all_u(at_u.size() - 1), all_v(at_v.size() - 1);
    const auto span_in = [](const std::vector<double>& at, double t) {
      const auto next = std::upper_bound(at.begin() + 1, at.end() - 1, t);
      return static_cast<std::size_t>(next - at.begin()) - 1;
    };
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (!(off_[k] > limit)) continue;
      const std::size_t i = span_in(at_u, points_[k].u), j = span_in(at_v, points_[k].v);
      const double a = width_ * (at_u[i + 1] - at_u[i]), b = depth_ * (at_v[j + 1] - at_v[j]);
      if (kAlike * a >= b) all_u[i].off = std::max(all_u[i].off, off_[k]);
      if (kAlike * b >= a) all_v[j].off = std::max(all_v[j].off, off_[k]);
    }
    std::vector<Span> wanted;
    const auto collect = [&](std::vector<Span>& all, const std::vector<double>& at, bool u) {
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (!(all[i].off > 0.0) || at[i + 1] - at[i] < kShortest) continue;
        wanted.push_back({all[i].off, u, 0.5 * (at[i] + at[i + 1])});
      }
    };
    collect(all_u, at_u, true);
    collect(all_v, at_v, false);
    std::stable_sort(wanted.begin(), wanted.end(),
                     [](const Span& a, const Span& b) { return a.off > b.off; });
    std::size_t nu = spline_.count_u(), nv = spline_.count_v();
    bool added = false;
    for (const Span& span : wanted) {
      std::size_t& count = span.u ? nu : nv;
      if ((count + 1) * (span.u ? nv : nu) > kMostControlPoints) continue;
      ++count;
      added = true;
      std::vector<double>& knots = span.u ? knots_u_ : knots_v_;
      knots.insert(std::upper_bound(knots.begin(), knots.end(), span.middle), span.middle);
    }
    return added;
  }

  const std::vector<HeightPoint>& points_;
  double width_, depth_, tolerance_;
  std::vector<double> knots_u_ = {0, 0, 0, 0, 1, 1, 1, 1}, knots_v_ = knots_u_;
  HeightSpline spline_;
  std::vector<double> off_;  ///< residuals
  double worst_ = 0.0, weight_ = 0.0, bending_ = 0.0, progress_ = 0.0;
};

/// Mean of the three inner knots of each B-spline: where its control point stands (Greville 1969).
std::vector<double> greville(const std::vector<double>& knots) {
  std::vector<double> out;
  for (std::size_t i = 0; i + 4 < knots.size(); ++i) {
    out.push_back((knots[i + 1] + knots[i + 2] + knots[i + 3]) / 3.0);
  }
  return out;
}

NurbsSurface surface_over(const Frame& plane, double width, double depth, const Levelled& level,
                          const HeightSpline& spline) {
  const std::vector<double> u = greville(spline.knots_u), v = greville(spline.knots_v);
  const Vec3 up = plane.normal();
  NurbsSurface out{3, 3, spline.knots_u, spline.knots_v, {}, {}};
  for (std::size_t j = 0; j < v.size(); ++j) {
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double height = spline.value[j * u.size() + i] + level.at_corner +
                            level.along_u * u[i] + level.along_v * v[j];
      out.points.push_back(plane.at({width * u[i], depth * v[j]}) + height * up);
    }
  }
  return out;
}

Result<EmptyParts> empty_parts(const ScatteredSurface& made, const std::vector<Vec2>& places,
                               const RunContext& run) {
  constexpr double kRaster = 40000.0, kReach = 2.5;
  EmptyParts out;
  const double area = made.width * made.depth;
  out.reach = kReach * std::sqrt(area / static_cast<double>(places.size()));
  const auto lines = [&](double side, double other) {
    return static_cast<std::size_t>(
        std::clamp(std::round(std::sqrt(kRaster * side / other)), 5.0, kRaster / 5.0));
  };
  const std::size_t nu = lines(made.width, made.depth), nv = lines(made.depth, made.width);
  std::vector<Vec2> in_units;
  for (const Vec2 p : places) in_units.push_back({made.width * p.x, made.depth * p.y});
  const PlaneNeighbours tree(std::move(in_units));
  std::vector<PlaneNeighbour> found;
  std::size_t without = 0;
  Vec2 where;
  for (std::size_t j = 0; j < nv; ++j) {
    OBVID_TRY(may_go_on(run));
    const double v = static_cast<double>(j) / static_cast<double>(nv - 1);
    for (std::size_t i = 0; i < nu; ++i) {
      const double u = static_cast<double>(i) / static_cast<double>(nu - 1);
      tree.nearest({made.width * u, made.depth * v}, 1, found);
      const double distance = std::sqrt(found.front().square);
      without += distance > out.reach ? 1 : 0;
      if (distance <= out.farthest) continue;
      out.farthest = distance;
      where = {u, v};
    }
  }
  out.raster = nu * nv;
  out.share = static_cast<double>(without) / static_cast<double>(out.raster);
  out.where = evaluate(made.surface, where.x, where.y).point;
  return out;
}

}  // namespace

Result<ScatteredSurface> scattered(const std::vector<Vec3>& points, const ScatterOptions& options,
                                   const RunContext& run) {
  OBVID_TRY(check_options(points, options));
  OBVID_TRY(tell(run, kStage, 0.0));
  const Frame start = frame_over(centre_of(points), options.up);
  const std::vector<PlacedHeight> placed = placed_over(start, points);
  auto neighbours = neighbours_of(placed, PlaneNeighbours(places_of(placed)), run);
  OBVID_TRY(neighbours);
  auto outliers = outliers_among(placed, *neighbours, options.tolerance, run);
  OBVID_TRY(outliers);
  std::vector<char> use(points.size(), 1);
  if (options.drop_outliers) {
    for (const ScatterOutlier& one : *outliers) use[one.point] = 0;
  }
  std::vector<std::size_t> used;
  std::vector<Vec2> places;
  std::vector<double> heights;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (use[i] == 0) continue;
    used.push_back(i);
    places.push_back(placed[i].place);
    heights.push_back(placed[i].height);
  }
  const TurnedRectangle around = smallest_rectangle(places);
  constexpr double kNoDepth = 1e-12;  // of the width: what rounding leaves of a line
  if (places.size() < 3 || !(around.depth > kNoDepth * around.width)) {
    return error(ErrorCode::kTooFewPoints, "in the plane all points lie on one line")
        .hint("give another direction of the heights (--up)")
        .value(around.depth);
  }
  OBVID_TRY(check_steepness(placed, *neighbours, use, options, outliers->size()));
  neighbours = ScatterNeighbours{};  // memory

  ScatteredSurface out;
  out.outliers = std::move(*outliers);
  out.used = used.size();
  out.width = around.width;
  out.depth = around.depth;
  const Vec2 across = left_normal(around.along);
  out.plane = {start.at(around.corner), start.direction(around.along), start.direction(across)};
  for (Vec2& p : places) {
    const Vec2 from = p - around.corner;
    p = {std::clamp(dot(from, around.along) / out.width, 0.0, 1.0),
         std::clamp(dot(from, across) / out.depth, 0.0, 1.0)};
  }
  const Levelled level = levelled(places, heights);
  constexpr double kOfTolerance = 1.0 - 1e-6;  // the rest is for rounding of coordinates
  Refinement work(level.points, out.width, out.depth, kOfTolerance * options.tolerance);
  const auto within = work.run(run);
  OBVID_TRY(within);
  out.surface = surface_over(out.plane, out.width, out.depth, level, work.spline());
  out.weight = work.weight();
  out.bending = work.bending();
  for (std::size_t k = 0; k < used.size(); ++k) {
    const Vec3 there = evaluate(out.surface, places[k].x, places[k].y).point;
    const double off = norm(there - points[used[k]]);
    out.root_mean_square += off * off / static_cast<double>(used.size());
    if (!(off > out.deviation)) continue;
    out.deviation = off;
    out.farthest = used[k];
  }
  out.root_mean_square = std::sqrt(out.root_mean_square);
  if (!*within || !(out.deviation <= options.tolerance)) {
    return error(ErrorCode::kToleranceNotReached,
                 fmt::format("with {} x {} control points point {} is {:.4g} off, the tolerance "
                             "is {:g}",
                             out.surface.count_u(), out.surface.count_v(), out.farthest + 1,
                             out.deviation, options.tolerance))
        .hint("raise --tolerance above the noise and the rounding of the coordinates, or fit parts")
        .point(out.farthest)
        .value(out.deviation);
  }
  auto empty = empty_parts(out, places, run);
  OBVID_TRY(empty);
  out.empty = *empty;
  OBVID_TRY(tell(run, kStage, 1.0));
  return out;
}

}  // namespace obvid
