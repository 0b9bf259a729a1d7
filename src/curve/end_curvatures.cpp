// SPDX-License-Identifier: Apache-2.0
// Control points with more digits across the curve than rounding leaves: docs/methods/curve.md.
#include "obvid/curve/internal/end_curvatures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "exact_cross.h"

namespace obvid {
namespace {

using namespace curve_detail;
using numeric::DoubleDouble;

/// Ends that are right to this part of their curvature stay as they are.
constexpr double kRight = 1e-10;
/// Curvature at an end that is less than this part of the other end's counts as flat: its error is
/// measured against this part (docs/claims.md, joint_gaps).
constexpr double kFlat = 1e-6;
/// What control points are moved for: a tenth of kRight, so that weights have little to do.
constexpr double kSought = 1e-11;
/// A control point may be moved by this part of its leg along the tangent.
constexpr double kFarthest = 1e-6;
/// Tangents at the ends may turn by this, rad.
constexpr double kLegTurn = 1e-11;
/// Weights take up at most this factor of a curvature: beyond, the piece would change its shape.
constexpr double kMostOfWeight = 1.5;
/// Roundings of a control point, in units of 2^-53 of the largest offset, that a curvature carries
/// at the most: two of half a unit in each of two legs.
constexpr double kRoundings = 4.0 * 0x1p-53;

std::size_t index(const RationalBezier& piece, bool at_start, int j) {
  return static_cast<std::size_t>(at_start ? j : piece.degree - j);
}

/// The first three control points from one end.
struct End {
  Vec2 p0, p1, p2;
  double factor = 0.0;  ///< curvature = factor * cross(leg to p1, leg to p2) / |leg to p1|^3
};

End end_of(const RationalBezier& piece, bool at_start) {
  const auto at = [&](int j) { return index(piece, at_start, j); };
  const double n = piece.degree, w1 = piece.weight[at(1)];
  const double weights = piece.weight[at(0)] / w1 * (piece.weight[at(2)] / w1);
  return {piece.offset[at(0)], piece.offset[at(1)], piece.offset[at(2)],
          (at_start ? 1.0 : -1.0) * (n - 1.0) / n * weights};
}

double curvature_of(const End& e) {
  const Leg l1 = leg(e.p0, e.p1);
  const double length = norm(rounded(l1));
  return e.factor * (cross(l1, leg(e.p0, e.p2)).hi / length) / length / length;
}

/// The cross product of both legs with which an end has this curvature.
double wanted_cross(const End& e, double kappa) {
  const double length = norm(rounded(leg(e.p0, e.p1)));
  return kappa / e.factor * length * length * length;
}

/// Whether a curvature comes out of a jet with all digits but the last four: both derivatives carry
/// roundings of the control points, the second one with the squared degree.
bool keeps_digits(const RationalBezier& piece, const Jet& jet) {
  constexpr double kLost = 1e-12;  // of the area
  constexpr double kRoundingsOfDifferences = 8.0 * 0x1p-53;
  double size = 0.0;
  for (int j = 1; j <= piece.degree; ++j) {
    size = std::max(size, norm(piece.offset[static_cast<std::size_t>(j)] - piece.offset[0]));
  }
  const double n = piece.degree;
  const double blur =
      kRoundingsOfDifferences * n * size * ((n - 1.0) * norm(jet.d1) + norm(jet.d2));
  return blur <= kLost * std::abs(cross(jet.d1, jet.d2));
}

/// A weighted point, from the start of its piece.
struct WeightedPoint {
  DoubleDouble x, y, w;
};

WeightedPoint between(const WeightedPoint& a, const WeightedPoint& b, DoubleDouble s,
                      DoubleDouble t) {
  return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.w + t * b.w};
}

/// From one weighted point to another, times both weights.
Leg weighted_leg(const WeightedPoint& from, const WeightedPoint& to) {
  return {from.w * to.x - to.w * from.x, from.w * to.y - to.w * from.y};
}

/// Curvature at t <= 1/2: that of the first end of the part behind t, whose control points the
/// algorithm of de Casteljau leaves, in some 106 bits. Nothing where that end has no tangent.
std::optional<double> curvature_of_rest(const RationalBezier& piece, double t) {
  std::array<WeightedPoint, kMaxBezierDegree + 1> net{};
  const auto degree = static_cast<std::size_t>(piece.degree);
  for (std::size_t j = 0; j <= degree; ++j) {
    const Leg from_start = leg(piece.offset[0], piece.offset[j]);
    const DoubleDouble w{piece.weight[j], 0.0};
    net[j] = {w * from_start.x, w * from_start.y, w};
  }
  const DoubleDouble s = numeric::two_sum(1.0, -t), then{t, 0.0};
  for (std::size_t left = degree; left > 0; --left) {
    // the last of each row stays: it belongs to the part behind t
    for (std::size_t j = 0; j < left; ++j) net[j] = between(net[j], net[j + 1], s, then);
  }
  const Leg first = weighted_leg(net[0], net[1]);
  const double length = norm(rounded(first)), weight = net[0].w.hi;
  if (!(length > 0.0)) return std::nullopt;
  const double n = piece.degree;
  const double area =
      cross(first, weighted_leg(net[0], net[2])).hi / length * weight / length * weight;
  return (n - 1.0) / n * area / length;
}

/// The same anywhere, by the longer of both parts: a short one has lost its digits.
std::optional<double> inner_curvature(const RationalBezier& piece, double t) {
  if (t <= 0.5) return curvature_of_rest(piece, t);
  RationalBezier back = piece;
  const auto end = piece.degree + 1;
  std::reverse(back.offset.begin(), back.offset.begin() + end);
  std::reverse(back.weight.begin(), back.weight.begin() + end);
  const auto found = curvature_of_rest(back, 1.0 - t);
  return found ? std::optional(-*found) : std::nullopt;
}

double spacing(double x, double size) {
  constexpr double kFinest = 0x1p-40;  // of the size: a component near zero has digits to spare
  const double a = std::max(std::abs(x), kFinest * size);
  return std::nextafter(a, std::numeric_limits<double>::infinity()) - a;
}

/// The doubles around a point as a lattice, seen along and across a direction.
class Lattice {
 public:
  Lattice(Vec2 at, const Leg& direction) : at_(at), direction_(direction) {
    const double size = std::max(std::abs(at.x), std::abs(at.y));
    step_ = {spacing(at.x, size), spacing(at.y, size)};
    length_ = norm(rounded(direction));
  }

  /// The lattice point whose distance from the direction's line is nearest to `across` more than
  /// that of `at`, to about `tolerance`, as little along it as possible.
  [[nodiscard]] Vec2 nearest(double across, double tolerance) const {
    constexpr double kMostStretch = 0x1p60;
    const double rough = std::max(step_.x, step_.y);
    const double stretch = std::clamp(rough / tolerance * (rough / tolerance), 1.0, kMostStretch);
    Vector a = vector(1.0, 0.0), b = vector(0.0, 1.0);
    reduce(a, b, stretch);
    // Babai's nearest plane in the reduced basis
    double left = across, along = 0.0;
    Vector sum = vector(0.0, 0.0);
    for (const Vector* v : {&b, &a}) {
      const Vector* other = v == &b ? &a : nullptr;
      double e = v->across, s = v->along;
      if (other != nullptr) {  // the part of b that a cannot do
        const double part = product_of(*v, *other, stretch) / product_of(*other, *other, stretch);
        e -= part * other->across;
        s -= part * other->along;
      }
      const double square = stretch * e * e + s * s;
      const double times = std::round((stretch * left * e + along * s) / square);
      sum.m += times * v->m;
      sum.n += times * v->n;
      left -= times * v->across;
      along -= times * v->along;
    }
    return {at_.x + sum.m * step_.x, at_.y + sum.n * step_.y};
  }

  /// A short lattice vector along the direction: its multiples up to the size of the point `at`
  /// stay within about half a step of the line.
  [[nodiscard]] Vec2 along() const {
    constexpr double kStretch = 0x1p104;  // some 2^26 steps long, 2^-26 of a step across
    Vector a = vector(1.0, 0.0), b = vector(0.0, 1.0);
    reduce(a, b, kStretch);
    if (product_of(a, a, kStretch) > product_of(b, b, kStretch)) std::swap(a, b);
    return {a.m * step_.x, a.n * step_.y};
  }

 private:
  struct Vector {
    double m, n;           // in steps
    double across, along;  // units
  };

  [[nodiscard]] Vector vector(double m, double n) const {
    const Leg l{{m * step_.x, 0.0}, {n * step_.y, 0.0}};
    const Vec2 d = rounded(direction_);
    return {m, n, cross(direction_, l).hi / length_, dot(d, rounded(l)) / length_};
  }

  static double product_of(const Vector& a, const Vector& b, double stretch) {
    return stretch * a.across * b.across + a.along * b.along;
  }

  /// Lagrange and Gauss: two short vectors of the lattice, across counted `stretch` times.
  void reduce(Vector& a, Vector& b, double stretch) const {
    constexpr int kMostRounds = 200;  // each at least halves a vector
    for (int k = 0; k < kMostRounds; ++k) {
      if (product_of(a, a, stretch) > product_of(b, b, stretch)) std::swap(a, b);
      const double times = std::round(product_of(a, b, stretch) / product_of(a, a, stretch));
      if (times == 0.0 || !std::isfinite(times)) return;
      b = vector(b.m - times * a.m, b.n - times * a.n);
    }
  }

  Vec2 at_;
  Leg direction_;
  Vec2 step_;
  double length_;
};

class Keeper {
 public:
  Keeper(RationalBezier& piece, WantedCurvatures wanted, InnerWeights weights)
      : piece_(piece), wanted_(wanted), weights_(weights) {}

  void run() {
    if (surely_right() || error() <= kRight) return;
    const RationalBezier before = piece_;
    const double error_before = error();
    take_origin();
    if (piece_.degree == 2) {
      move_apex();
    } else {
      move_inner_points();
    }
    if (weights_ == InnerWeights::kFree) set_weights();
    if (!(error() < error_before)) piece_ = before;
  }

 private:
  [[nodiscard]] double wanted(bool at_start) const {
    return at_start ? wanted_.start : wanted_.end;
  }
  /// What errors of the curvature at an end are measured by.
  [[nodiscard]] double unit(bool at_start) const {
    return std::max(std::abs(wanted(at_start)),
                    kFlat * std::max(std::abs(wanted_.start), std::abs(wanted_.end)));
  }
  [[nodiscard]] double error(bool at_start) const {
    const double off = stored_curvature(piece_, at_start) - wanted(at_start);
    return off == 0.0 ? 0.0 : std::abs(off) / unit(at_start);
  }
  [[nodiscard]] double error() const { return std::max(error(true), error(false)); }

  /// Whether rounding alone, as large as it may be, leaves both ends right: no need to look.
  [[nodiscard]] bool surely_right() const {
    double size = 0.0;
    for (int j = 0; j <= piece_.degree; ++j) {
      const Vec2 p = piece_.offset[static_cast<std::size_t>(j)];
      size = std::max({size, std::abs(p.x), std::abs(p.y)});
    }
    for (const bool at_start : {true, false}) {
      const End e = end_of(piece_, at_start);
      const Vec2 first = e.p1 - e.p0, second = e.p2 - e.p0;
      const double square = dot(first, first);
      const double lever = 1.0 + std::sqrt(dot(second, second) / square);
      const double blur = std::abs(e.factor) * kRoundings * size * lever / square;
      if (!(blur <= kRight * unit(at_start))) return false;
    }
    return true;
  }

  /// Small against its coordinates: its own digits from its start on.
  void take_origin() {
    if (!(piece_.origin == Vec2{})) return;
    const Vec2 start = piece_.offset[0];
    piece_.origin = start;
    for (int j = 0; j <= piece_.degree; ++j) {
      Vec2& p = piece_.offset[static_cast<std::size_t>(j)];
      p = p - start;
    }
  }

  /// The apex of a conic decides both curvatures at once: across the chord in common, along it
  /// their ratio, which rounding leaves alone.
  void move_apex() {
    const Vec2 chord = piece_.offset[2] - piece_.offset[0];
    const double h = norm(chord);
    double across = 0.0, tolerance = 0.0;
    for (const bool at_start : {true, false}) {
      const End e = end_of(piece_, at_start);
      const double off =
          wanted_cross(e, wanted(at_start)) - cross(leg(e.p0, e.p1), leg(e.p0, e.p2)).hi;
      // the cross product of an end is the chord times the height of the apex
      across += (at_start ? -0.5 : 0.5) * off / h;
      tolerance = std::max(tolerance, std::abs(wanted_cross(e, kSought * unit(at_start))) / h);
    }
    const Vec2 first = piece_.offset[1] - piece_.offset[0];
    const Vec2 last = piece_.offset[2] - piece_.offset[1];
    place(1, Lattice(piece_.offset[1], leg(piece_.offset[0], piece_.offset[2])), across, tolerance,
          std::min(farthest(first, chord), farthest(last, chord)));
  }

  /// The flatter end comes first: the point that it has in common with the other end is set by it.
  void move_inner_points() {
    const bool start_first = std::abs(wanted_.start) <= std::abs(wanted_.end);
    if (wanted(start_first) == 0.0) {
      align(start_first);
    } else {
      move_second(start_first);
    }
    if (piece_.degree > 4) {
      move_second(!start_first);
    } else {
      move_first(!start_first);
    }
  }

  /// Both inner control points from an end on one line with it: curvature 0, exactly.
  void align(bool at_start) {
    const End e = end_of(piece_, at_start);
    const Vec2 first = e.p1 - e.p0, second = e.p2 - e.p0;
    const Vec2 widest = norm(e.p0) > norm(e.p2) ? e.p0 : e.p2;
    const Vec2 step = Lattice(widest, leg(e.p0, e.p1)).along();
    const double square = dot(step, step);
    const auto multiple = [&](Vec2 v) { return std::round(dot(step, v) / square) * step; };
    const Vec2 p1 = e.p0 + multiple(first), p2 = e.p0 + multiple(second);
    const bool near =
        norm(p1 - e.p1) <= kFarthest * norm(first) && norm(p2 - e.p2) <= kFarthest * norm(second);
    if (!near || cross(leg(e.p0, p1), leg(e.p0, p2)).hi != 0.0) return move_second(at_start);
    piece_.offset[index(piece_, at_start, 1)] = p1;
    piece_.offset[index(piece_, at_start, 2)] = p2;
  }

  /// The second inner control point from an end: its distance from the end's tangent.
  void move_second(bool at_start) {
    const End e = end_of(piece_, at_start);
    const Leg tangent = leg(e.p0, e.p1);
    const double length = norm(rounded(tangent));
    const double off = wanted_cross(e, wanted(at_start)) - cross(tangent, leg(e.p0, e.p2)).hi;
    const double tolerance = std::abs(wanted_cross(e, kSought * unit(at_start))) / length;
    place(index(piece_, at_start, 2), Lattice(e.p2, tangent), off / length, tolerance,
          kFarthest * norm(e.p2 - e.p0));
  }

  /// The first one: its distance from the line through the end and the second one.
  void move_first(bool at_start) {
    const End e = end_of(piece_, at_start);
    const Leg second = leg(e.p0, e.p2);
    const double length = norm(rounded(second));
    const double off = wanted_cross(e, wanted(at_start)) - cross(leg(e.p0, e.p1), second).hi;
    const double tolerance = std::abs(wanted_cross(e, kSought * unit(at_start))) / length;
    place(index(piece_, at_start, 1), Lattice(e.p1, second), -off / length, tolerance,
          farthest(e.p1 - e.p0, rounded(second)));
  }

  /// How far the control point at the end of a leg may be moved along a direction: the leg, a
  /// tangent, hardly turns.
  static double farthest(Vec2 leg, Vec2 along) {
    const double slope = std::abs(cross(leg, along)) / (norm(leg) * norm(along));
    return norm(leg) * std::min(kFarthest, kLegTurn / slope);
  }

  void place(std::size_t j, const Lattice& lattice, double across, double tolerance, double limit) {
    if (std::abs(across) <= tolerance) return;
    const Vec2 moved = lattice.nearest(across, tolerance);
    if (norm(moved - piece_.offset[j]) <= limit) piece_.offset[j] = moved;
  }

  /// Curvature at an end goes with 1 / w1^2, of a conic at both.
  void set_weights() {
    const auto ratio = [&](bool at_start) {
      const double r = stored_curvature(piece_, at_start) / wanted(at_start);
      return r > 1.0 / kMostOfWeight && r < kMostOfWeight ? r : 1.0;
    };
    if (piece_.degree == 2) {
      piece_.weight[1] *= std::sqrt(std::sqrt(ratio(true) * ratio(false)));
      return;
    }
    for (const bool at_start : {true, false}) {
      piece_.weight[index(piece_, at_start, 1)] *= std::sqrt(ratio(at_start));
    }
  }

  RationalBezier& piece_;
  WantedCurvatures wanted_;
  InnerWeights weights_;
};

}  // namespace

double stored_curvature(const RationalBezier& piece, bool at_start) {
  return curvature_of(end_of(piece, at_start));
}

double accurate_curvature(const Piece& piece, double t) {
  return accurate_curvature(piece, t, evaluate(piece, t));
}

double accurate_curvature(const Piece& piece, double t, const Jet& jet) {
  const auto* bezier = std::get_if<RationalBezier>(&piece);
  if (bezier == nullptr || bezier->degree < 2) return curvature(jet);
  const bool at_end = t == 0.0 || t == 1.0;
  if (at_end) {
    return is_singular_end(piece, t) ? curvature(jet) : stored_curvature(*bezier, t == 0.0);
  }
  if (keeps_digits(*bezier, jet)) return curvature(jet);
  return inner_curvature(*bezier, t).value_or(curvature(jet));
}

void keep_end_curvatures(RationalBezier& piece, WantedCurvatures wanted, InnerWeights weights) {
  Keeper(piece, wanted, weights).run();
}

}  // namespace obvid
