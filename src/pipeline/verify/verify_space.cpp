// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "obvid/contour/bsplines/nurbs_of.h"
#include "obvid/io/internal/json_text.h"
#include "obvid/pipeline/internal/promise.h"
#include "obvid/pipeline/internal/report_json.h"
#include "obvid/pipeline/space_fit.h"
#include "space/space_shape.h"
#include "verify/false_claim.h"

namespace obvid {
namespace {

using pipeline_detail::SpaceShape;

/// Figures follow again from the same numbers; sines may be rounded otherwise elsewhere.
constexpr double kSameSpaceFigure = 1e-9;
/// Torsion is a quotient of third derivatives, of the largest one.
constexpr double kSameTorsion = 1e-6;
/// Lengths are rounding below this part of the size, and this many roundings of a coordinate.
constexpr double kRoundedPart = 1e-12, kRoundingsOfSpace = 64.0;
constexpr double kUnitVector = 1e-12;  ///< what the length of a written one may miss 1 by
/// The bound of the file has a part for what lies between places; here that part is small.
constexpr double kBetweenPlaces = 0.05;

class SpaceClaims {
 public:
  SpaceClaims(const StoredSpace& stored, Watch& watch)
      : stored_(stored), fit_(space_fit_of(stored)), watch_(watch) {
    double coordinate = 0.0;
    for (const Vec3& p : stored.points) {
      coordinate = std::max({coordinate, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    near_ = kRoundedPart * size_of(fit_) + kRoundingsOfSpace * 0x1p-53 * coordinate;
  }

  std::optional<Error> run() {
    frame();
    points();
    if (refused_) return refused_;
    if (stored_.heights) {
      figures();
      if (!refused_) cubic();
    } else {
      planar();
    }
    return refused_;
  }

 private:
  void refuse(const std::string& name, double claimed, double found) {
    if (!refused_) refused_ = pipeline_detail::false_claim_in_space(name, claimed, found);
  }
  void same(const std::string& name, double claimed, double found, double scale) {
    if (!(std::abs(claimed - found) <= kSameSpaceFigure * std::abs(found) + scale)) {
      refuse(name, claimed, found);
    }
  }

  void frame() {
    const Frame& f = stored_.frame;
    const double off = std::max({std::abs(norm(f.x) - 1.0), std::abs(norm(f.y) - 1.0),
                                 std::abs(dot(f.x, f.y)), norm(f.normal() - stored_.normal)});
    if (!(off <= kUnitVector)) refuse("frame", 0.0, off);
  }

  /// Each contour is one of the points.
  void points() {
    const std::vector<Vec2>& flat = stored_.plan.contour.points;
    const std::size_t n = stored_.points.size();
    const bool round = stored_.plan.contour.closed && flat.size() + 1 == n;
    if (flat.size() != n && !round) {
      return refuse("points", static_cast<double>(n), static_cast<double>(flat.size()));
    }
    const std::size_t with_end = pipeline_detail::HeightOrder(stored_.plan.contour).size();
    if (stored_.heights && stored_.heights->contour.points.size() != with_end) {
      return refuse("heights/points", static_cast<double>(stored_.heights->contour.points.size()),
                    static_cast<double>(with_end));
    }
    double flatness = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 p = stored_.points[i];
      const double height = stored_.frame.height(p);
      flatness = std::max(flatness, std::abs(height));
      if (i == flat.size()) break;  // the first one again, as far as the largest move allows
      const double off = norm(stored_.frame.in_plane(p) - flat[i]);
      if (!(off <= near_)) refuse(fmt::format("points/{}", i), 0.0, off);
    }
    if (stored_.heights) heights();
    same("flatness", stored_.flatness, stored_.heights ? 0.0 : flatness, near_);
  }

  void heights() {
    const pipeline_detail::HeightOrder order(stored_.plan.contour);
    for (std::size_t k = 0; k < order.size(); ++k) {
      const double claimed = stored_.heights->contour.points[k].y,
                   height = stored_.frame.height(stored_.points[order.point(k)]);
      if (!(std::abs(claimed - height) <= near_)) {
        refuse(fmt::format("heights/points/{}", k), claimed, height);
      }
    }
  }

  /// Gaps are rounding: those of the file may be others than those found, within the bounds.
  void seam() {
    if (!stored_.seam) return;
    const SpaceShape shape(stored_.frame, stored_.plan.contour, stored_.heights->contour);
    const SpaceSeam found = shape.seam(), bounds = shape.seam_bounds();
    const auto gap = [&](const char* name, double claimed, double here, double bound) {
      if (!(std::abs(claimed) <= bound && here <= bound)) refuse(name, claimed, here);
    };
    gap("seam/position", stored_.seam->position, found.position, bounds.position);
    gap("seam/heading", stored_.seam->heading, found.heading, bounds.heading);
    gap("seam/curvature", stored_.seam->curvature, found.curvature, bounds.curvature);
    const double apart = norm(stored_.curve.points.front() - stored_.curve.points.back());
    if (!(apart <= near_)) refuse("curve/points", apart, 0.0);
  }

  void figures() {
    SpaceFit found = fit_;
    if (auto done = pipeline_detail::measure(found); !done) {
      refused_ = done.error();
      refused_->code = ErrorCode::kFalseClaim;
      return;
    }
    const double length = ContourPath(stored_.plan.contour.pieces).length();
    const std::vector<Vec2>& unrolled = stored_.heights->contour.points;
    same("heights/points/0/0", unrolled.front().x, 0.0, kSameSpaceFigure * length);
    const ContourPath path(stored_.heights->contour.pieces);
    same("heights", path.at(path.length(), true).point.x, length, kSameSpaceFigure * length);
    const SpaceFigures& f = stored_.figures;
    const double bend = kSameSpaceFigure * found.largest_curvature;
    same("least_curvature", f.least_curvature, found.least_curvature, bend);
    same("largest_curvature", f.largest_curvature, found.largest_curvature, bend);
    same("torsion_places", static_cast<double>(f.torsion_places),
         static_cast<double>(found.torsion_places), 0.0);
    const double torsion =
        kSameTorsion * std::max(std::abs(found.least_torsion), std::abs(found.largest_torsion));
    same("least_torsion", f.least_torsion, found.least_torsion, torsion);
    same("largest_torsion", f.largest_torsion, found.largest_torsion, torsion);
    same("torsion_step", f.torsion_step, found.torsion_step, torsion);
    at_most("largest_move", stored_.largest_move, found.largest_move);
    seam();
  }

  void cubic() {
    const SpaceShape shape(stored_.frame, stored_.plan.contour, stored_.heights->contour);
    const double length = shape.length();
    if (stored_.curve.degree != 3 || !stored_.curve.weights.empty()) {
      return refuse("curve/degree", stored_.curve.degree, 3.0);
    }
    same("curve/knots", stored_.curve.knots.back() - stored_.curve.knots.front(), length,
         kSameSpaceFigure * length);
    if (refused_) return;
    if (!(stored_.deviation >= 0.0)) return refuse("curve/deviation", stored_.deviation, 0.0);
    // a straight curve far from the origin is nearer to its cubic than coordinates are rounded
    const double found = pipeline_detail::distance_bound(
        shape, stored_.curve, kBetweenPlaces * std::max(stored_.deviation, near_), &watch_);
    if (!(found <= (1.0 + 2.0 * kBetweenPlaces) * stored_.deviation + near_)) {
      refuse("curve/deviation", stored_.deviation, found);
    }
  }

  void planar() {
    double farthest = 0.0;
    if (const auto& report = stored_.plan.report) {
      for (const double move : report->moves) farthest = std::max(farthest, move);
    }
    double most = std::hypot(stored_.flatness, farthest);  // across the plane and in it
    if (stored_.plan.contour.closed && stored_.plan.contour.points.size() < stored_.points.size()) {
      most += norm(stored_.points.back() - stored_.points.front());
    }
    at_most("largest_move", stored_.largest_move, most);
    if (stored_.deviation != 0.0) return;
    const auto made = nurbs_of(stored_.plan.contour, {true, near_});
    if (!made) return refuse("curve", 0.0, 1.0);
    const SpaceCurve curve = placed(made->curve, stored_.frame);
    if (curve.points.size() != stored_.curve.points.size() ||
        curve.knots.size() != stored_.curve.knots.size() ||
        curve.weights.size() != stored_.curve.weights.size() ||
        curve.degree != stored_.curve.degree) {
      return refuse("curve/points", static_cast<double>(stored_.curve.points.size()),
                    static_cast<double>(curve.points.size()));
    }
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const double off = norm(curve.points[i] - stored_.curve.points[i]);
      if (!(off <= near_)) refuse(fmt::format("curve/points/{}", i), 0.0, off);
    }
    for (std::size_t i = 0; i < curve.weights.size(); ++i) {
      same(fmt::format("curve/weights/{}", i), stored_.curve.weights[i], curve.weights[i], 0.0);
    }
    const double range = curve.knots.back() - curve.knots.front();
    for (std::size_t i = 0; i < curve.knots.size(); ++i) {
      same(fmt::format("curve/knots/{}", i), stored_.curve.knots[i], curve.knots[i],
           kRoundedPart * range);
    }
  }

  /// A bound that may be wider than what is found.
  void at_most(const std::string& name, double claimed, double found) {
    if (!(found <= claimed * (1.0 + kSameSpaceFigure) + near_)) refuse(name, claimed, found);
  }

  const StoredSpace& stored_;
  SpaceFit fit_;
  Watch& watch_;
  double near_ = 0.0;
  std::optional<Error> refused_;
};

void add_fields_of_part(std::vector<std::string>& out, const char* part,
                        const std::vector<std::string>& fields) {
  for (const std::string& one : fields) out.push_back(part + one);
}

const char* plan_name(const StoredSpace& stored) {
  return stored.heights ? "/projection" : "/contour";
}

}  // namespace

SpaceFit space_fit_of(const StoredSpace& stored) {
  SpaceFit out;
  out.name = stored.name;
  out.units = stored.units;
  out.points = stored.points;
  out.frame = stored.frame;
  out.flatness = stored.flatness;
  const auto part = [](const StoredContour& one) {
    Fit fit;
    fit.contour = one.contour;
    if (one.report) fit.report = *one.report;
    if (one.certificate) fit.certificate = *one.certificate;
    return fit;
  };
  out.plan = part(stored.plan);
  if (stored.heights) out.unrolled = part(*stored.heights);
  out.largest_move = stored.largest_move;
  out.least_curvature = stored.figures.least_curvature;
  out.largest_curvature = stored.figures.largest_curvature;
  out.torsion_places = stored.figures.torsion_places;
  out.least_torsion = stored.figures.least_torsion;
  out.largest_torsion = stored.figures.largest_torsion;
  out.torsion_step = stored.figures.torsion_step;
  out.seam = stored.seam;
  return out;
}

SpaceVerification verify(const StoredSpace& stored) { return *verify(stored, RunContext{}); }

Result<SpaceVerification> verify(const StoredSpace& stored, const RunContext& run) {
  SpaceVerification out;
  auto plan = verify(stored.plan, run);
  OBVID_TRY(plan);
  out.plan = std::move(*plan);
  if (stored.heights) {
    auto heights = verify(*stored.heights, run);
    OBVID_TRY(heights);
    out.heights = std::move(*heights);
  }
  Watch watch(run);
  out.false_claim = SpaceClaims(stored, watch).run();
  if (watch.was_cancelled()) return fail(cancelled_error());
  out.not_checked = {"/name", "/units", "/units_source"};
  if (!stored.heights && stored.deviation != 0.0) {
    out.not_checked.emplace_back("/curve (only that it is a NURBS curve)");
  }
  if (stored.seam) out.not_checked.emplace_back("/seam (only that its gaps are within bounds)");
  add_fields_of_part(out.not_checked, plan_name(stored), out.plan.not_checked);
  if (out.heights) add_fields_of_part(out.not_checked, "/heights", out.heights->not_checked);
  out.not_checked.insert(out.not_checked.end(), stored.unread.begin(), stored.unread.end());
  return out;
}

std::optional<Error> broken_promise(const StoredSpace& stored, const SpaceVerification& found) {
  if (found.false_claim) return found.false_claim;
  const auto of_part = [](std::optional<Error> error, const char* part) {
    if (error) error->where = part + error->where;
    return error;
  };
  if (auto error = of_part(broken_promise(stored.plan, found.plan), plan_name(stored))) {
    return error;
  }
  if (!stored.heights) return std::nullopt;
  return of_part(broken_promise(*stored.heights, *found.heights), "/heights");
}

std::string space_verification_json(const StoredSpace& stored, const SpaceVerification& found) {
  JsonText json;
  const auto broken = broken_promise(stored, found);
  json.begin_object().pair("holds", !broken);
  const bool is_false = broken && broken->code == ErrorCode::kFalseClaim;
  pipeline_detail::add_false_claim(json, is_false ? &*broken : nullptr);
  json.key("not_checked").begin_array();
  for (const std::string& one : found.not_checked) json.value(one);
  json.end_array();
  json.key(plan_name(stored) + 1).raw(verification_json(stored.plan, found.plan));
  if (stored.heights) json.key("heights").raw(verification_json(*stored.heights, *found.heights));
  json.end_object();
  return json.take();
}

}  // namespace obvid
