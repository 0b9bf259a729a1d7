// SPDX-License-Identifier: Apache-2.0
#include "step/piece_chain.h"

#include <algorithm>
#include <cmath>

#include "exact_conics.h"
#include "obvid/curve/internal/piece_box.h"
#include "obvid/geom/internal/angle.h"

namespace obvid::exchange {
namespace {

tl::unexpected<Error> refused_curve(ErrorCode code, const char* what, int index = -1) {
  return error(code, what).hint("look at the contour with `obvid verify`").point(index);
}

NurbsCurve quadratic(Vec2 a, Vec2 b, Vec2 c, double weight) {
  return {2, {0, 0, 0, 1, 1, 1}, {a, b, c}, {1.0, weight, 1.0}};
}

class StepShaper {
 public:
  StepShaper(double scale, double size) : scale_(scale), size_(size) {}

  StepShape shape(const NurbsCurve& curve) const {
    NurbsCurve out = curve;
    for (Vec2& p : out.points) p = scale_ * p;
    const Vec2 start = out.points.front(), end = out.points.back();
    return {std::move(out), start, end};
  }

  StepShape shape(const LinePiece& line) const {
    const Vec2 start = scale_ * line.start, end = scale_ * line.end;
    const double length = norm(end - start);
    return {StepLine{(end - start) / length, length}, start, end};
  }

  StepShape shape(const ArcPiece& arc) const {
    const Vec2 start = scale_ * arc.start, end = scale_ * arc.end;
    const double radius = scale_ / std::abs(arc.kappa), turn = std::abs(arc.kappa * arc.length);
    const bool left = arc.kappa > 0.0;
    const Vec2 ahead = unit_at(arc.theta0);
    if (!centre_is_near(arc, size_) && turn < 0.25 * kFullTurn) {
      const Vec2 middle = start + (radius * std::tan(0.5 * turn)) * ahead;
      return {quadratic(start, middle, end, std::cos(0.5 * turn)), start, end};
    }
    const Vec2 out = left ? -left_normal(ahead) : left_normal(ahead);
    return {StepConic{start - radius * out, out, radius, radius, 0.0, turn, left}, start, end};
  }

  StepShape shape(const RationalBezier& piece) const {
    const auto e = ellipse_within(piece, size_);
    if (!e) return shape(nurbs_of(piece));
    const double sign = e->from < e->to ? 1.0 : -1.0;
    return {StepConic{scale_ * e->centre, unit_at(e->rotation), scale_ * e->semi_major,
                      scale_ * e->semi_minor, sign * e->from, sign * e->to, sign > 0.0},
            scale_ * start_point(piece), scale_ * end_point(piece)};
  }

 private:
  double scale_, size_;
};

bool all_numbers_finite(const StepShape& shape) {
  const auto fine = [](double x) { return std::isfinite(x); };
  bool sound = is_finite(shape.start) && is_finite(shape.end);
  if (const auto* line = std::get_if<StepLine>(&shape.curve)) {
    sound = sound && is_finite(line->direction);
  } else if (const auto* conic = std::get_if<StepConic>(&shape.curve)) {
    sound = sound && is_finite(conic->centre) && is_finite(conic->axis) && fine(conic->major) &&
            fine(conic->minor) && fine(conic->from) && fine(conic->to);
  } else {
    const auto& nurbs = std::get<NurbsCurve>(shape.curve);
    sound = sound &&
            std::all_of(nurbs.points.begin(), nurbs.points.end(),
                        [](Vec2 p) { return is_finite(p); }) &&
            std::all_of(nurbs.knots.begin(), nurbs.knots.end(), fine) &&
            std::all_of(nurbs.weights.begin(), nurbs.weights.end(), fine);
  }
  return sound;
}

/// Lists of the right lengths, knots that ascend without tearing the curve, positive weights. What
/// is not a number passes: that is another error.
bool makes_a_curve(const NurbsCurve& curve) {
  const std::size_t n = curve.points.size();
  if (curve.degree < 1 || n <= static_cast<std::size_t>(curve.degree)) return false;
  const auto p = static_cast<std::size_t>(curve.degree);
  if ((!curve.weights.empty() && curve.weights.size() != n) || curve.knots.size() != n + p + 1)
    return false;
  for (std::size_t i = 0; i + 1 < curve.knots.size(); ++i) {
    if (curve.knots[i] > curve.knots[i + 1]) return false;
  }
  for (std::size_t i = 1; i < n; ++i) {
    if (curve.knots[i] >= curve.knots[i + p]) return false;
  }
  return std::none_of(curve.weights.begin(), curve.weights.end(),
                      [](double w) { return w <= 0.0; });
}

Result<std::vector<StepShape>> shapes_of(const CadCurve& curve, double scale) {
  std::vector<StepShape> out;
  if (const auto* nurbs = std::get_if<NurbsCurve>(&curve.geometry)) {
    if (!makes_a_curve(*nurbs)) {
      return refused_curve(ErrorCode::kInternal, "knots, points and weights make no NURBS curve");
    }
    out.push_back(StepShaper(scale, 0.0).shape(*nurbs));
    return out;
  }
  const auto& pieces = std::get<std::vector<Piece>>(curve.geometry);
  if (pieces.empty()) return refused_curve(ErrorCode::kNothingThere, "a curve has no pieces");
  const StepShaper shaper(scale, about_size(pieces));
  for (const Piece& piece : pieces) {
    if (const auto* line = std::get_if<LinePiece>(&piece)) out.push_back(shaper.shape(*line));
    if (const auto* arc = std::get_if<ArcPiece>(&piece)) out.push_back(shaper.shape(*arc));
    if (const auto* one = std::get_if<RationalBezier>(&piece)) out.push_back(shaper.shape(*one));
    if (std::holds_alternative<ClothoidPiece>(piece)) {
      return error(ErrorCode::kUnsupported, "CAD files know no clothoids")
          .hint("form the contour with --carrier spiral or bspline")
          .point(static_cast<int>(&piece - pieces.data()));
    }
  }
  return out;
}

}  // namespace

Result<StepChain> step_chain(const CadCurve& curve, double scale, double same) {
  auto shapes = shapes_of(curve, scale);
  OBVID_TRY(shapes);
  StepChain out{std::move(*shapes), false};
  const std::size_t n = out.shapes.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!all_numbers_finite(out.shapes[i])) {
      return refused_curve(ErrorCode::kNotFinite, "a number of the curve is not finite",
                           static_cast<int>(i));
    }
    if (i + 1 < n && !(norm(out.shapes[i].end - out.shapes[i + 1].start) <= same)) {
      return refused_curve(ErrorCode::kInternal, "the pieces of the curve do not meet",
                           static_cast<int>(i));
    }
  }
  out.closed = norm(out.shapes.back().end - out.shapes.front().start) <= same;
  return out;
}

}  // namespace obvid::exchange
