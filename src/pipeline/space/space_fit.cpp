// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/space_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "fit/prepare.h"
#include "obvid/geom/internal/box.h"
#include "obvid/io/read_sections.h"
#include "obvid/pipeline/skin_sections.h"
#include "space/space_shape.h"

namespace obvid {
namespace {

using pipeline_detail::HeightOrder;
using pipeline_detail::SpaceEnds;
using pipeline_detail::SpacePlace;
using pipeline_detail::SpaceShape;

/// Planar is what leaves its plane by no more than this part of its size: rounding of doubles.
constexpr double kPlanarPart = 1e-9;
/// What evaluating a height may cost, of the distance from the origin of the plane.
constexpr double kHeightRoundings = 8.0 * 0x1p-53;
/// Between two joints: places where curvature and torsion are looked at.
constexpr int kPlacesOfSpan = 32;
/// Places among which the one nearest to a moved point is sought before it is refined.
constexpr int kGuesses = 32;

/// Frame whose normal is the direction that is looked along, or its opposite: x to the right and y
/// upward as drawings have them.
Frame frame_along(Vec3 direction, Vec3 origin) {
  const Vec3 d = unit(direction);
  const Vec3 up{0, 0, 1};
  if (norm(cross(up, d)) == 0.0) return {origin, {1, 0, 0}, {0, 1, 0}};
  Vec3 x = unit(cross(up, d));
  // seen along y, x points to the right
  if (x.x < 0.0 || (x.x == 0.0 && x.y < 0.0)) x = -x;
  const Vec3 y = unit(cross(d, x));
  return {origin, x, dot(y, up) < 0.0 ? -y : y};
}

/// Whether the last point is the first one again but for noise and print.
bool returns(const SpaceSeries& series, const FitJob& job) {
  const double near =
      std::max({series.rounding.x, series.rounding.y, series.rounding.z, job.noise.value_or(0.0)});
  return norm(series.points.back() - series.points.front()) <= near;
}

/// A last point that is the first one again but for noise is that one. Ends at corners stay.
PointSeries flat_series(const SpaceSeries& series, const Frame& frame, const SpaceJob& space,
                        const SpaceEnds& ends) {
  const FitJob& job = space.fit;
  PointSeries out;
  out.fixed = space.fixed;
  out.name = series.name;
  out.units = series.units;
  out.rounding = rounding_in(frame, series.rounding).within;
  for (const Vec3& p : series.points) out.points.push_back(frame.in_plane(p));
  if (job.closing != Closing::kOpen && returns(series, job)) out.points.back() = out.points.front();
  if (ends.first_is_corner || ends.last_is_corner) out.fixed.resize(out.points.size());
  if (ends.first_is_corner) out.fixed.front().tolerance = 0.0;
  if (ends.last_is_corner) out.fixed.back().tolerance = 0.0;
  return out;
}

/// The plane through both ends (one, where they are the same) that the others are nearest to.
Frame plane_through_ends(const std::vector<Vec3>& points) {
  const Vec3 start = points.front(), chord = points.back() - start;
  const double length = norm(chord), size = farthest_from_first(points);
  const Vec3 along = length > 0.0 ? chord / length : Vec3{};
  std::vector<Vec3> around;
  for (const Vec3& p : points) {
    const Vec3 off = (p - start) - dot(p - start, along) * along;
    around.push_back(off);
    around.push_back(-off);
  }
  // spread along the chord so far that no other direction is before it
  const double far = static_cast<double>(points.size()) * size;
  if (length > 0.0) {
    around.push_back(far * along);
    around.push_back(-far * along);
  }
  Frame frame = plane_of(around);
  frame.origin = start;
  return frame;
}

/// More than a mark of a corner.
bool fixes_more(const PointConstraint& constraint) {
  return constraint.theta || constraint.kappa || constraint.thetas || constraint.kappas;
}

bool fixes_columns(const SpaceJob& job) {
  return std::any_of(job.fixed.begin(), job.fixed.end(),
                     [](const FixedData& f) { return f.says_how() || f.tolerance; });
}

bool fixes_data(const FitJob& job) {
  return job.start_heading || job.end_heading || job.start_kappa || job.end_kappa ||
         job.start_thetas || job.end_thetas || job.start_kappas || job.end_kappas ||
         std::any_of(job.constraints.begin(), job.constraints.end(), fixes_more);
}

Error within_part(Error error, const char* part) {
  error.what = fmt::format("{}: {}", part, error.what);
  return error;
}

Error of_space(ErrorCode code, std::string what, std::string hint) {
  return {code, std::move(what), "", std::move(hint), -1, 0.0};
}

/// Arc lengths of a contour at its points.
std::vector<double> lengths_at_points(const Contour& contour, const ContourPath& path) {
  const HeightOrder order(contour);
  std::vector<std::optional<double>> at(contour.points.size());
  for (std::size_t k = 0; k < contour.joints.size(); ++k) {
    if (const auto source = contour.joints[k].source) at[*source] = path.joint(k);
  }
  std::vector<double> out(at.size(), 0.0);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const std::size_t i = order.point(k);
    if (at[i]) {
      out[i] = *at[i];
      continue;
    }
    const double from = k > 0 ? out[order.point(k - 1)] : 0.0;
    double to = path.length();
    for (std::size_t j = k + 1; j < at.size(); ++j) {
      if (const auto& next = at[order.point(j)]) {
        to = *next;
        break;
      }
    }
    double guess = from, least = norm(path.at(from).point - contour.points[i]);
    for (int guessed = 1; guessed <= kGuesses; ++guessed) {
      const double s = from + (to - from) * guessed / kGuesses;
      const double far = norm(path.at(s).point - contour.points[i]);
      if (far >= least) continue;
      least = far;
      guess = s;
    }
    out[i] = path.nearest(contour.points[i], guess, from, to);
  }
  return out;
}

double largest_of(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

/// From the places whose lengths the heights stand on; these need not be the nearest ones.
double farthest_from_places(const Fit& plan) {
  const ContourPath path(plan.contour.pieces);
  const std::vector<double> lengths = lengths_at_points(plan.contour, path);
  double farthest = 0.0;
  for (std::size_t i = 0; i < lengths.size() && i < plan.report.moves.size(); ++i) {
    if (plan.report.moves[i] == 0.0) continue;
    const double away = norm(path.at(lengths[i]).point - plan.contour.points[i]);
    farthest = std::max({farthest, plan.report.moves[i], away});
  }
  return farthest;
}

/// Points of a closed curve that are its first one again: at most that many units from it.
double closing_gap(const SpaceFit& out) {
  const Contour& plan = out.plan.contour;
  const bool again = plan.closed && plan.points.size() < out.points.size();
  return again ? norm(out.points.back() - out.points.front()) : 0.0;
}

/// Curvatures of both contours are monotone on their pieces, so that ends of a cell bound them.
void enclose(const SpaceShape::Curvatures& a, const SpaceShape::Curvatures& b, double width,
             bool first, SpaceFit& out) {
  const auto largest = [](double x, double y) { return std::max(std::abs(x), std::abs(y)); };
  const auto least = [](double x, double y) {
    return (x < 0.0) != (y < 0.0) ? 0.0 : std::min(std::abs(x), std::abs(y));
  };
  const double turn = width * largest(a.unrolled, b.unrolled);
  const double steep = largest(a.slope, b.slope) + turn;
  const double level = std::max(0.0, least(a.slope, b.slope) - turn);
  const double high = std::hypot(largest(a.unrolled, b.unrolled),
                                 largest(a.plan, b.plan) * std::pow(std::cos(level), 2));
  const double cosine = std::max(0.0, std::cos(std::min(steep, 0.5 * std::numbers::pi)));
  const double low =
      std::hypot(least(a.unrolled, b.unrolled), least(a.plan, b.plan) * cosine * cosine);
  out.least_curvature = first ? low : std::min(out.least_curvature, low);
  out.largest_curvature = first ? high : std::max(out.largest_curvature, high);
}

void at_points(const SpaceShape& shape, SpaceFit& out) {
  const std::vector<double> lengths = lengths_at_points(out.unrolled->contour, shape.unrolled());
  const HeightOrder order(out.plan.contour);
  const bool closed = out.plan.contour.closed;
  out.at_points.resize(out.plan.contour.points.size());
  for (std::size_t k = 0; k < out.at_points.size(); ++k) {
    const SpacePlace before = shape.at(closed && k == 0 ? shape.length() : lengths[k], true),
                     after = shape.at(lengths[k]);
    out.at_points[order.point(k)] = {after.plan_length, after.height, after.curvature,
                                     before.torsion, after.torsion};
  }
  // a last point that is the first one again
  if (out.at_points.size() < out.points.size()) out.at_points.push_back(out.at_points.front());
}

Result<void> measure_space(SpaceFit& out) {
  const SpaceShape shape(out.frame, out.plan.contour, out.unrolled->contour);
  const std::vector<double> joints = shape.joints();
  out.torsion_places = 0;
  out.torsion_step = 0.0;
  bool torsion_begun = false;
  for (std::size_t k = 0; k + 1 < joints.size(); ++k) {
    const double width = (joints[k + 1] - joints[k]) / kPlacesOfSpan;
    for (int j = 0; j < kPlacesOfSpan; ++j) {
      const double from = joints[k] + width * j,
                   to = j + 1 < kPlacesOfSpan ? joints[k] + width * (j + 1) : joints[k + 1];
      const auto a = shape.curvatures(from, false), b = shape.curvatures(to, true);
      enclose(a, b, to - from, k == 0 && j == 0, out);
      // headings within the cell: between both ends, and further by what it may turn
      const double turn = (to - from) * std::max(std::abs(a.unrolled), std::abs(b.unrolled));
      if (std::max(std::abs(a.slope), std::abs(b.slope)) + turn >= 0.5 * std::numbers::pi) {
        return fail(of_space(ErrorCode::kWanders,
                             "the curve rises so steeply that its projection may run back",
                             "choose another direction with --along"));
      }
      for (const auto& torsion : {shape.at(from).torsion, shape.at(to, true).torsion}) {
        ++out.torsion_places;
        if (!torsion) continue;
        out.least_torsion = torsion_begun ? std::min(out.least_torsion, *torsion) : *torsion;
        out.largest_torsion = torsion_begun ? std::max(out.largest_torsion, *torsion) : *torsion;
        torsion_begun = true;
      }
    }
    if (k == 0) continue;
    const auto before = shape.at(joints[k], true).torsion, after = shape.at(joints[k]).torsion;
    if (before && after) out.torsion_step = std::max(out.torsion_step, std::abs(*after - *before));
  }
  if (out.plan.contour.closed) {
    out.seam = shape.seam();
    const auto before = shape.at(shape.length(), true).torsion, after = shape.at(0.0).torsion;
    if (before && after) out.torsion_step = std::max(out.torsion_step, std::abs(*after - *before));
  }
  at_points(shape, out);
  out.largest_move =
      farthest_from_places(out.plan) + largest_of(out.unrolled->report.moves) + closing_gap(out);
  return {};
}

std::string heights_name(const HeightOrder& order) {
  if (order.point(0) == 0) return "heights over the arc length";
  return fmt::format("heights over the arc length (their point 1 is point {})", order.point(0) + 1);
}

/// A curve that does not lie in a plane, in one projection.
class SpatialForming {
 public:
  SpatialForming(const SpaceSeries& series, const SpaceJob& job, const SpaceEnds& ends,
                 const RunContext& run)
      : series_(series), job_(job), ends_(ends), run_(run) {}

  Result<SpaceFit> along(Vec3 direction) const {
    SpaceFit out;
    out.name = series_.name;
    out.units = series_.units;
    out.points = series_.points;
    out.frame = frame_along(direction, {});
    const PlaneRounding rounding = rounding_in(out.frame, series_.rounding);
    PointSeries plan = flat_series(series_, out.frame, job_, ends_);
    FitJob plan_job = job_.fit;
    plan_job.corners_between = false;  // no height stands there
    // both parts move a point: together no further than the noise
    if (plan_job.noise) plan_job.noise = std::numbers::sqrt2 / 2.0 * *plan_job.noise;
    // what ends elsewhere is open, also where its projection returns
    if (plan_job.closing == Closing::kAutomatic && !returns(series_, job_.fit)) {
      plan_job.closing = Closing::kOpen;
    }
    auto first = fit(plan, plan_job, run_);
    if (!first) return fail(within_part(first.error(), "projection"));
    out.plan = std::move(*first);
    if (out.plan.certificate.corners > 0) {
      return fail(of_space(ErrorCode::kUnsupported,
                           "the projection has a corner where the points in space have none",
                           "choose another direction with --along, or mark it with --corner-at"));
    }
    auto second = heights(out, rounding.across);
    OBVID_TRY(second);
    out.unrolled = std::move(*second);
    OBVID_TRY(measure_space(out));
    const SpaceShape shape(out.frame, out.plan.contour, out.unrolled->contour);
    if (out.seam && !pipeline_detail::meets(*out.seam, shape.seam_bounds())) {
      return fail(of_space(ErrorCode::kNotProved,
                           fmt::format("the heights do not meet at point {}: gaps of {:.3g} of the "
                                       "length, {:.3g} rad, {:.3g} of the curvature",
                                       HeightOrder(out.plan.contour).point(0) + 1,
                                       out.seam->position, out.seam->heading, out.seam->curvature),
                           "--open forms it with ends that meet, without a common tangent"));
    }
    return out;
  }

 private:
  Result<Fit> heights(const SpaceFit& so_far, double across) const {
    const Contour& plan = so_far.plan.contour;
    const ContourPath path(plan.pieces);
    const std::vector<double> lengths = lengths_at_points(plan, path);
    const std::size_t n = lengths.size(), all = series_.points.size();
    if (n != all && !(plan.closed && n + 1 == all)) {
      return fail(of_space(ErrorCode::kChordReversal,
                           "neighbouring points have one place in the projection",
                           "choose another direction with --along"));
    }
    if (plan.closed && !plan.joints.front().source) {
      return fail(of_space(ErrorCode::kUnsupported,
                           "the projection begins between two points: no height stands there",
                           "--open forms it with ends that meet, without a common tangent"));
    }
    const HeightOrder order(plan);
    PointSeries unrolled;
    unrolled.name = series_.name;
    unrolled.units = series_.units;
    // the lengths are computed, not given: heights need not be met better than they are printed
    const double noise = std::max(across, std::numbers::sqrt2 / 2.0 * job_.fit.noise.value_or(0.0));
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = order.point(k), before = order.point(k > 0 ? k - 1 : 0);
      if (k > 0 && !(lengths[i] > lengths[before])) {
        return fail(of_space(ErrorCode::kChordReversal,
                             fmt::format("the projection does not get on between points {} and {}",
                                         before + 1, i + 1),
                             "choose another direction with --along"));
      }
      unrolled.points.push_back({lengths[i], so_far.frame.height(series_.points[i])});
      FixedData free;
      const bool end = k == 0 || (!plan.closed && k + 1 == n);
      if (noise > 0.0 && !end) free.tolerance = noise;
      unrolled.fixed.push_back(free);
    }
    if (noise == 0.0) unrolled.fixed.clear();
    FitJob job = job_.fit;
    job.noise.reset();
    job.noise_from_rounding = false;
    job.noise_from_scatter = false;
    job.start_heading.reset();
    job.end_heading.reset();
    job.start_kappa.reset();
    job.end_kappa.reset();
    job.start_thetas.reset();
    job.end_thetas.reset();
    job.start_kappas.reset();
    job.end_kappas.reset();
    job.constraints.clear();
    job.closing = Closing::kOpen;
    auto made = plan.closed ? one_turn(unrolled, path.length(), job) : fit(unrolled, job, run_);
    if (!made) {
      Error error = made.error();
      if (order.point(0) > 0) error.index = error.last = -1;  // its points are counted from there
      return fail(within_part(std::move(error), heights_name(order).c_str()));
    }
    if (made->certificate.corners > 0) {
      return fail(of_space(ErrorCode::kUnsupported,
                           "the heights have a corner where the points in space have none",
                           "choose another direction with --along, or mark it with --corner-at"));
    }
    return made;
  }

  /// One turn of heights from their first point to it again. G2 contours are looked for with what
  /// lies beyond, and have one heading and curvature at both ends; G3 ones are given these.
  Result<Fit> one_turn(PointSeries turn, double length, FitJob job) const {
    job.period = Vec2{length, 0.0};
    turn.points.push_back(turn.points.front() + *job.period);
    if (!turn.fixed.empty()) turn.fixed.push_back(turn.fixed.front());
    FitJob plain = job;
    plain.continuity = Continuity::kG2;
    auto around = fit(turn, plain, run_);
    if (!around || wanted_continuity(job) == Continuity::kG2) return around;
    const Element& seam = around->contour.joints.front().element;
    job.start_heading = job.end_heading = seam.theta;
    job.start_kappa = job.end_kappa = seam.kappa;
    auto smooth = fit(turn, job, run_);
    if (smooth && smooth->certificate.proved) return smooth;
    if (!smooth && smooth.error().code == ErrorCode::kCancelled) return smooth;
    around->warnings.emplace_back(
        "with the heading and curvature of the seam no G3 contour was found: it is G2");
    return around;
  }

  const SpaceSeries& series_;
  const SpaceJob& job_;
  const SpaceEnds& ends_;
  const RunContext& run_;
};

int bends_of(const SpaceFit& one) {
  const auto count = [](const Fit& part) { return part.report.vertices + part.report.inflections; };
  return count(one.plan) + count(*one.unrolled);
}

Result<SpaceFit> planar_fit(const SpaceSeries& series, const SpaceJob& job, const SpaceEnds& ends,
                            const Frame& frame, double flatness, const RunContext& run) {
  SpaceFit out;
  out.name = series.name;
  out.units = series.units;
  out.points = series.points;
  out.frame = frame;
  out.flatness = flatness;
  const PointSeries flat = flat_series(series, frame, job, ends);
  FitJob plane_job = job.fit;
  plane_job.corners_between = false;
  const bool line = flat.points.size() == 2 && (ends.first_is_corner || ends.last_is_corner);
  if (line) {
    plane_job.start_heading = plane_job.end_heading = heading(flat.points[1] - flat.points[0]);
  }
  auto made = fit(flat, plane_job, run);
  OBVID_TRY(made);
  out.plan = std::move(*made);
  // across the plane and in it
  out.largest_move = std::hypot(flatness, largest_of(out.plan.report.moves)) + closing_gap(out);
  out.warnings = out.plan.warnings;
  return out;
}

/// The fewest vertices and inflections of the directions that give a curve.
Result<SpaceFit> best_projection(const SpaceSeries& series, const SpaceJob& job,
                                 const SpaceEnds& ends, Vec3 normal, const RunContext& run) {
  std::optional<SpaceFit> best;
  std::optional<Error> refused;
  for (const Vec3 direction : {normal, Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{1, 0, 0}}) {
    auto one = SpatialForming(series, job, ends, run).along(direction);
    if (!one && one.error().code == ErrorCode::kCancelled) return fail(one.error());
    if (!one && !refused) refused = one.error();
    if (one && (!best || bends_of(*one) < bends_of(*best))) best = std::move(*one);
  }
  if (best) return std::move(*best);
  return fail(*refused);
}

}  // namespace

namespace pipeline_detail {

Result<void> measure(SpaceFit& fit) { return measure_space(fit); }

bool returns_in_space(const SpaceSeries& series, const FitJob& job) { return returns(series, job); }

bool fixes_space_data(const SpaceJob& job) { return fixes_data(job.fit) || fixes_columns(job); }

PlaneOfSpace plane_of_space(const SpaceSeries& series, const SpaceJob& job, const SpaceEnds& ends) {
  const bool pinned = ends.first_is_corner || ends.last_is_corner;
  PlaneOfSpace out{pinned ? plane_through_ends(series.points) : plane_of(series.points)};
  const double across = rounding_in(out.frame, series.rounding).across;
  const double allowed = std::max(
      {kPlanarPart * farthest_from_first(series.points), across, job.fit.noise.value_or(0.0)});
  for (const Vec3& p : series.points) {
    const double height = std::abs(out.frame.height(p));
    if (height == 0.0) continue;  // in a plane along the axes, exactly
    out.flatness = std::max(out.flatness, height + kHeightRoundings * norm(p - out.frame.origin));
  }
  const bool line = pinned && series.points.size() == 2;
  out.holds = line || (!job.along && out.flatness <= allowed && !fixes_columns(job));
  return out;
}

}  // namespace pipeline_detail

double size_of(const SpaceFit& fit) { return farthest_from_first(fit.points); }

namespace pipeline_detail {

Result<SpaceFit> form_in_space(const SpaceSeries& series, const SpaceJob& job,
                               const SpaceEnds& ends, const RunContext& run) {
  const PlaneOfSpace plane = plane_of_space(series, job, ends);
  if (plane.holds) return planar_fit(series, job, ends, plane.frame, plane.flatness, run);
  if (follows_spirals(job.fit.carrier)) {
    return fail(of_space(ErrorCode::kBadOption, "a curve that lies in no plane is made of spirals",
                         "leave --carrier out"));
  }
  if (!job.along && fixes_space_data(job)) {
    return fail(of_space(ErrorCode::kBadOption,
                         "headings, radii and corners of points in space are those of a projection",
                         "--along Z takes them as seen in the plane of x and y, --flat forms the "
                         "contour in that plane alone"));
  }
  auto out = job.along ? SpatialForming(series, job, ends, run).along(*job.along)
                       : best_projection(series, job, ends, plane.frame.normal(), run);
  if (!out) return out;
  if (closing_gap(*out) > 0.0) {
    out->warnings.emplace_back(
        "the last point is the first one again but for noise: the first one stands for both");
  }
  for (const Fit* part : {&out->plan, &*out->unrolled}) {
    const std::string name =
        part == &out->plan ? "projection" : heights_name(HeightOrder(out->plan.contour));
    for (const std::string& one : part->warnings) {
      out->warnings.push_back(fmt::format("{}: {}", name, one));
    }
  }
  return out;
}

}  // namespace pipeline_detail

Result<SpaceFit> fit_space(const SpaceSeries& series, const SpaceJob& job, const RunContext& run) {
  OBVID_TRY(pipeline_detail::check_noise_in_space(job.fit));
  if (job.along && !(is_finite(*job.along) && norm(*job.along) > 0.0)) {
    return fail(of_space(ErrorCode::kBadOption, "the direction has no length",
                         "X, Y, Z, or three numbers: 1,0,0.5"));
  }
  return pipeline_detail::form_in_space(series, job, {}, run);
}

}  // namespace obvid
