// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/placement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace obvid {
namespace {

class Placing {
 public:
  explicit Placing(const Placement& placement) : p_(placement) {
    const double quarters = p_.turn / (0.5 * std::numbers::pi);
    const double whole = std::round(quarters);
    quarter_ = quarters == whole;
    if (quarter_) {
      constexpr double kSines[] = {0.0, 1.0, 0.0, -1.0};
      const auto at = static_cast<int>(std::fmod(std::fmod(whole, 4.0) + 4.0, 4.0));
      sine_ = kSines[at];
      cosine_ = kSines[(at + 1) % 4];
    } else {
      sine_ = std::sin(p_.turn);
      cosine_ = std::cos(p_.turn);
    }
  }

  /// Without the move.
  [[nodiscard]] Vec2 vector(Vec2 v) const {
    if (p_.mirror == Mirror::kX) v.y = -v.y;
    if (p_.mirror == Mirror::kY) v.x = -v.x;
    v = p_.scale * v;
    // adding +0 turns -0 into +0: the same place, but another heading of a chord
    return {cosine_ * v.x - sine_ * v.y + 0.0, sine_ * v.x + cosine_ * v.y + 0.0};
  }

  [[nodiscard]] Vec2 point(Vec2 v) const { return vector(v) + Vec2{p_.move.x, p_.move.y}; }

  [[nodiscard]] double heading(double theta) const {
    if (p_.mirror == Mirror::kX) theta = -theta;
    if (p_.mirror == Mirror::kY) theta = std::numbers::pi - theta;
    return theta + p_.turn;
  }

  [[nodiscard]] double kappa(double value) const {
    return (mirrored() ? -value : value) / p_.scale;
  }

  [[nodiscard]] double length(double value) const { return p_.scale * value; }

  [[nodiscard]] double height(double value) const { return length(value) + p_.move.z; }

  [[nodiscard]] bool mirrored() const { return p_.mirror != Mirror::kNone; }

  [[nodiscard]] Vec2 rounding(Vec2 half) const {
    half = p_.scale * half;
    if (half.x == half.y || (quarter_ && sine_ == 0.0)) return half;
    if (quarter_) return {half.y, half.x};
    const double least = std::min(half.x, half.y);
    return {least, least};
  }

  void fixed(FixedData& data) const {
    if (data.theta) data.theta = heading(*data.theta);
    if (data.kappa) data.kappa = kappa(*data.kappa);
    if (data.tolerance) data.tolerance = length(*data.tolerance);
    if (data.height) data.height = height(*data.height);
    if (data.thetas) data.thetas = range(heading(data.thetas->low), heading(data.thetas->high));
    if (data.kappas) data.kappas = range(kappa(data.kappas->low), kappa(data.kappas->high));
  }

  /// Heights grow as lengths do, and are lifted.
  void profile(VerticalProfile& heights) const {
    for (ProfileElement& e : heights.elements) {
      for (double* one : {&e.station, &e.length, &e.radius}) *one = length(*one);
      e.height = height(e.height);
    }
    heights.end_station = length(heights.end_station);
    heights.end_height = height(heights.end_height);
  }

  [[nodiscard]] Piece operator()(const LinePiece& line) const {
    return LinePiece{point(line.start), point(line.end)};
  }
  [[nodiscard]] Piece operator()(const ArcPiece& arc) const {
    return ArcPiece{point(arc.start), point(arc.end), heading(arc.theta0), kappa(arc.kappa),
                    length(arc.length)};
  }
  [[nodiscard]] Piece operator()(const ClothoidPiece& one) const {
    return ClothoidPiece{point(one.start),  point(one.end),    heading(one.theta0),
                         kappa(one.kappa0), kappa(one.kappa1), length(one.length)};
  }
  [[nodiscard]] Piece operator()(RationalBezier curve) const {
    curve.origin = point(curve.origin);
    for (int j = 0; j <= curve.degree; ++j) {
      Vec2& offset = curve.offset[static_cast<std::size_t>(j)];
      offset = vector(offset);
    }
    return curve;
  }

 private:
  [[nodiscard]] ValueRange range(double a, double b) const {
    return {std::min(a, b), std::max(a, b)};
  }

  Placement p_;
  double sine_ = 0.0, cosine_ = 1.0;
  bool quarter_ = true;
};

}  // namespace

void place(const Placement& placement, FixedData& fixed) {
  if (!placement.changes_nothing()) Placing(placement).fixed(fixed);
}

void place(const Placement& placement, PointSeries& series) {
  if (placement.changes_nothing()) return;
  const Placing placing(placement);
  for (Vec2& p : series.points) p = placing.point(p);
  for (FixedData& fixed : series.fixed) placing.fixed(fixed);
  for (KeptPiece& kept : series.kept) kept.piece = std::visit(placing, kept.piece);
  series.rounding = placing.rounding(series.rounding);
  series.height_rounding = placing.length(series.height_rounding);
}

void place(const Placement& placement, SpaceSeries& series) {
  if (placement.changes_nothing()) return;
  const Placing placing(placement);
  for (Vec3& p : series.points) {
    const Vec2 flat = placing.point({p.x, p.y});
    p = {flat.x, flat.y, placing.height(p.z)};
  }
  const Vec2 half = placing.rounding({series.rounding.x, series.rounding.y});
  series.rounding = {half.x, half.y, placing.length(series.rounding.z)};
}

void place(const Placement& placement, Drawing& drawing) {
  if (placement.changes_nothing()) return;
  const Placing placing(placement);
  for (DrawnCurve& curve : drawing.curves) {
    for (Piece& piece : curve.pieces) piece = std::visit(placing, piece);
    if (curve.station) curve.station = placing.length(*curve.station);
    for (PlacedTransition& one : curve.transitions) {
      one.kappa0 = placing.kappa(one.kappa0);
      one.kappa1 = placing.kappa(one.kappa1);
      one.length = placing.length(one.length);
    }
    if (curve.profile) placing.profile(*curve.profile);
  }
  for (PointSeries& series : drawing.series) place(placement, series);
}

}  // namespace obvid
