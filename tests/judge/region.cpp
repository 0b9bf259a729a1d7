// SPDX-License-Identifier: Apache-2.0
#include "region.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace judge {
namespace {

constexpr Real kPi = std::numbers::pi_v<Real>;
/// Rounding of long double, with a reserve, relative to terms that cancel.
constexpr Real kRounding = 1e-17L;

Real wrapped(Real angle) { return std::remainder(angle, 2.0L * kPi); }

/// Chord vector of an arc that turns by `turn` from heading `theta`.
Vec arc_vector(Real theta, Real kappa, Real turn) {
  return (2.0L * std::sin(0.5L * turn) / kappa) * unit_at(theta + 0.5L * turn);
}

/// In half chords a = k0 h/2, b = k1 h/2: closing the chord gives the heading at the joint,
/// (b - a) e^{i theta} = 2 i a b + b e^{i alpha} - a e^{i beta}. `blur0`, `blur1`: rounding of both
/// curvatures, relative.
Biarc closing(Real h, Real alpha, Real beta, Real k0, Real k1, Real blur0, Real blur1) {
  const Real a = 0.5L * k0 * h, b = 0.5L * k1 * h;
  Vec v = Vec{0.0L, 2.0L * a * b} + b * unit_at(alpha) - a * unit_at(beta);
  if (b < a) v = -1.0L * v;
  const bool circle = norm(v) <= kRounding * (std::abs(a) + std::abs(b));
  Real theta = circle ? alpha : std::atan2(v.y, v.x);
  // both turns together are beta - alpha: of the headings that differ by a whole turn the one that
  // goes least against the curvatures
  const auto off = [](Real turn, Real k) {  // a line does not turn
    return k == 0.0L ? std::abs(turn) : std::max(0.0L, -std::copysign(1.0L, k) * turn);
  };
  const auto against = [&](Real at) { return std::max(off(at - alpha, k0), off(beta - at, k1)); };
  // beside an inflection both could turn once more: only what rounding of the three terms and of
  // the curvatures in them (derivatives of the right side) cannot have turned makes them
  const Real rounding =
      kRounding * (2.0L * std::abs(a * b) + std::abs(a) + std::abs(b)) +
      blur0 * std::abs(a) * norm(Vec{0.0L, 2.0L * b} - unit_at(beta)) +
      blur1 * std::abs(b) * norm(Vec{0.0L, 2.0L * a} + unit_at(alpha));
  if (!(k0 * k1 < 0.0L) || against(theta) * norm(v) > rounding) {
    const Real first = theta;
    for (const Real at : {first - 2.0L * kPi, first + 2.0L * kPi}) {
      if (against(at) < against(theta)) theta = at;
    }
  }
  // a turn against its curvature is rounding: then the arcs touch at an end of the chord
  if ((theta - alpha) * k0 < 0.0L) theta = alpha;
  if ((beta - theta) * k1 < 0.0L) theta = beta;
  Biarc out;
  const Vec end{h, 0.0L};
  const Real turn0 = theta - alpha, turn1 = beta - theta;
  Vec joint;
  if (std::abs(k0) >= std::abs(k1)) {
    joint = k0 == 0.0L ? end : arc_vector(alpha, k0, turn0);
  } else {
    joint = end - arc_vector(theta, k1, turn1);
  }
  out.first = {{}, joint, alpha, k0, turn0, false};
  out.second = {joint, end, theta, k1, turn1, true};
  return out;
}

/// A circle of radius 0 at one end: the arc that keeps the other tangent spans the chord.
Biarc behind_a_point(Real h, Real beta) {
  const Real kappa = 2.0L * std::sin(beta) / h;
  return {{{}, {}, -beta, kappa, 0.0L, false}, {{}, {h, 0.0L}, -beta, kappa, 2.0L * beta, true}};
}
Biarc before_a_point(Real h, Real alpha) {
  const Real kappa = -2.0L * std::sin(alpha) / h;
  const Vec end{h, 0.0L};
  return {{{}, end, alpha, kappa, -2.0L * alpha, false}, {end, end, -alpha, kappa, 0.0L, true}};
}

struct Reach : Extent {
  void reach(const BoundaryArc& arc) {
    meet(arc.start.y);
    meet(arc.end.y);
    // where the arc runs along or against the chord
    for (const Real parallel : {0.0L, kPi, -kPi, 2.0L * kPi, -2.0L * kPi, 3.0L * kPi, -3.0L * kPi}) {
      const Real turned = parallel - arc.theta;
      const bool passed = arc.turn >= 0.0L ? turned > 0.0L && turned < arc.turn
                                           : turned < 0.0L && turned > arc.turn;
      if (!passed || arc.kappa == 0.0L) continue;
      meet(arc.from_end ? arc.end.y - arc_vector(parallel, arc.kappa, arc.turn - turned).y
                        : arc.start.y + arc_vector(arc.theta, arc.kappa, turned).y);
    }
  }
  void meet(Real y) {
    high = std::max(high, y);
    low = std::min(low, y);
  }
};

bool is_graph(const Biarc& b) {
  for (const BoundaryArc* arc : {&b.first, &b.second}) {
    for (const Real theta : {arc->theta, arc->theta + arc->turn}) {
      if (!(std::abs(theta) < 0.5L * kPi)) return false;
    }
  }
  return b.first.end.x >= 0.0L && b.first.end.x <= b.second.end.x;
}

/// A boundary over the chord. The sine of its heading is linear in the abscissa on each arc.
struct Graph {
  Real h, joint, k0, k1, sine0, sine1;

  explicit Graph(const Biarc& b)
      : h(b.second.end.x),
        joint(b.first.end.x),
        k0(b.first.kappa),
        k1(b.second.kappa),
        sine0(std::sin(b.first.theta)),
        sine1(std::sin(b.second.theta + b.second.turn)) {}

  [[nodiscard]] Real ordinate(Real x) const {
    return x <= joint ? rise(sine0, k0, x) : rise(sine1, k1, x - h);
  }
  /// Intercept and slope of the sine of the heading around an abscissa.
  [[nodiscard]] std::array<Real, 2> sine(Real x) const {
    return x <= joint ? std::array{sine0, k0} : std::array{sine1 - k1 * h, k1};
  }

 private:
  static Real rise(Real sine, Real kappa, Real run) {
    const Real after = sine + kappa * run;
    const Real c0 = std::sqrt(std::max(0.0L, 1.0L - sine * sine));
    const Real c1 = std::sqrt(std::max(0.0L, 1.0L - after * after));
    return run * (sine + after) / (c0 + c1);
  }
};

/// The gap is largest at a joint, or where both boundaries have the same heading.
Real largest_gap(const Biarc& first, const Biarc& second) {
  const Graph a(first), b(second);
  const std::array<Real, 4> stops = {0.0L, std::min(a.joint, b.joint), std::max(a.joint, b.joint),
                                     a.h};
  const auto gap = [&](Real x) { return std::abs(a.ordinate(x) - b.ordinate(x)); };
  Real most = std::max(gap(stops[1]), gap(stops[2]));
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const Real middle = 0.5L * (stops[i] + stops[i + 1]);
    const auto p = a.sine(middle), q = b.sine(middle);
    const Real x = (q[0] - p[0]) / (p[1] - q[1]);
    if (x > stops[i] && x < stops[i + 1]) most = std::max(most, gap(x));
  }
  return most;
}

}  // namespace

Real BoundaryArc::distance(Vec p) const {
  const Vec from_start = p - start, behind = p - end;
  const Real ends = std::min(norm(from_start), norm(behind));
  const Vec tangent = unit_at(theta), end_tangent = unit_at(theta + turn);
  const Vec from = from_end ? behind : from_start, ahead = from_end ? end_tangent : tangent;
  // left_of(ahead) points to the centre; this is kappa (p - centre)
  const Vec radius = kappa * from - left_of(ahead);
  const Vec along = left_of(radius);  // tangent of the circle abreast of p
  constexpr Real kGentle = 1e-3L;
  bool abreast = false;
  if (std::abs(turn) < kGentle) {
    abreast = dot(from_start, tangent) >= 0.0L && dot(behind, end_tangent) <= 0.0L;
  } else {
    Real passed = std::atan2(cross(tangent, along), dot(tangent, along));
    if (turn > 0.0L && passed < 0.0L) passed += 2.0L * kPi;
    if (turn < 0.0L && passed > 0.0L) passed -= 2.0L * kPi;
    abreast = std::abs(passed) <= std::abs(turn);
  }
  if (!abreast) return ends;
  // | |p - centre| - R | without the cancellation of a large circle
  const Real power = kappa * dot(from, from) - 2.0L * cross(ahead, from);
  return std::min(ends, std::abs(power) / (norm(radius) + 1.0L));
}

std::optional<Region> Region::of(const Element& from, const Element& to, int direction) {
  Region out;
  const Vec chord = to.point - from.point;
  out.h_ = norm(chord);
  if (!(out.h_ > 0.0L)) return std::nullopt;
  out.origin_ = from.point;
  out.along_ = (1.0L / out.h_) * chord;
  const Real d = direction, omega = std::atan2(chord.y, chord.x), half = 0.5L * out.h_;
  // for increasing curvature; the other case is the mirror image
  const Real alpha = d * wrapped(from.theta - omega), beta = d * wrapped(to.theta - omega);
  const Real k0 = d * from.kappa, k1 = d * to.kappa;
  const Real square = std::pow(std::sin(0.5L * (alpha + beta)), 2);
  Real a = k0 * half + std::sin(alpha), b = k1 * half - std::sin(beta);
  const bool any_start = std::isinf(k0), any_end = std::isinf(k1);
  const auto noise = [&](bool any, Real kappa, Real angle) {
    return kRounding * ((any ? 0.0L : std::abs(kappa * half)) + std::abs(std::sin(angle)));
  };
  const Real noise_a = noise(any_start, k0, alpha), noise_b = noise(any_end, k1, beta);
  if (a > noise_a || b < -noise_b) return std::nullopt;
  const Real slack = kRounding + noise_a + noise_b;
  // Vogt: a curve of increasing curvature ends steeper over its chord than it begins. Elements that
  // do not are joined only by curves that turn by a whole turn more
  if (std::sin(0.5L * (alpha + beta)) < -slack) return std::nullopt;
  if (!any_start && !any_end && -a * b < square &&
      std::sqrt(square) > std::sqrt(std::max(0.0L, -a * b)) + slack) {
    return std::nullopt;
  }
  const bool flat_a = !any_start && -a <= noise_a, flat_b = !any_end && b <= noise_b;
  const Real end_of_first = flat_a ? k1 : (std::sin(beta) + square / -a) / half;
  const Real start_of_second = flat_b ? k0 : (-std::sin(alpha) - square / b) / half;
  // rounding of A, or of the half angle, in the quotient that makes the other curvature
  const auto blur = [&](Real rest, Real noise_of_rest, Real kappa) {
    const Real half_angle = kRounding * std::sqrt(square) + kRounding * kRounding;
    const Real off = (square * noise_of_rest / std::abs(rest) + 2.0L * half_angle) / std::abs(rest);
    return kRounding + (off + kRounding) / std::abs(kappa * half);
  };
  out.from_start_ = any_start ? behind_a_point(out.h_, beta)
                              : closing(out.h_, alpha, beta, k0, end_of_first, 0.0L,
                                        blur(a, noise_a, end_of_first));
  out.to_end_ = any_end ? before_a_point(out.h_, alpha)
                        : closing(out.h_, alpha, beta, start_of_second, k1,
                                  blur(b, noise_b, start_of_second), 0.0L);
  if (direction < 0) {  // mirror the boundaries back
    for (Biarc* biarc : {&out.from_start_, &out.to_end_}) {
      for (BoundaryArc* arc : {&biarc->first, &biarc->second}) {
        arc->start.y = -arc->start.y;
        arc->end.y = -arc->end.y;
        arc->theta = -arc->theta;
        arc->kappa = -arc->kappa;
        arc->turn = -arc->turn;
      }
    }
  }
  return out;
}

Vec Region::local(Vec p) const {
  const Vec v = p - origin_;
  return {dot(along_, v), cross(along_, v)};
}

Real Region::farther(Vec p) const {
  const Vec q = local(p);
  return std::max(from_start_.distance(q), to_end_.distance(q));
}

Real Region::nearer(Vec p) const {
  const Vec q = local(p);
  return std::min(from_start_.distance(q), to_end_.distance(q));
}

Real Region::width() const {
  const auto [a, b] = extents();
  const Real parallels = std::max(std::abs(a.high - b.high), std::abs(a.low - b.low));
  if (!is_graph(from_start_) || !is_graph(to_end_)) return parallels;
  return std::max(parallels, largest_gap(from_start_, to_end_));
}

std::optional<std::array<Real, 2>> Region::over_middle() const {
  if (!is_graph(from_start_) || !is_graph(to_end_)) return std::nullopt;
  return std::array{Graph(from_start_).ordinate(0.5L * h_), Graph(to_end_).ordinate(0.5L * h_)};
}

bool Region::turns_half() const {
  const auto far = [](const Biarc& both) {
    const BoundaryArc &first = both.first, &second = both.second;
    return (norm(first.end - first.start) == 0.0L && std::abs(second.turn) >= kPi) ||
           (norm(second.end - second.start) == 0.0L && std::abs(first.turn) >= kPi);
  };
  return far(from_start_) || far(to_end_);
}

std::array<Extent, 2> Region::extents() const {
  Reach a, b;
  for (const BoundaryArc* arc : {&from_start_.first, &from_start_.second}) a.reach(*arc);
  for (const BoundaryArc* arc : {&to_end_.first, &to_end_.second}) b.reach(*arc);
  return {a, b};
}

std::array<Span, 2> Region::arcs(std::size_t boundary) const {
  const Biarc& both = boundary == 0 ? from_start_ : to_end_;
  const Real omega = std::atan2(along_.y, along_.x);
  const auto placed = [&](const BoundaryArc& arc) {
    const Vec start = origin_ + arc.start.x * along_ + arc.start.y * left_of(along_);
    const Real length = arc.kappa == 0.0L ? norm(arc.end - arc.start) : arc.turn / arc.kappa;
    return Span(start, arc.theta + omega, arc.kappa, length);
  };
  return {placed(both.first), placed(both.second)};
}

Real Region::distance(Vec p, std::size_t boundary) const {
  return (boundary == 0 ? from_start_ : to_end_).distance(local(p));
}

Real Region::outside(Vec p) const {
  if (!is_graph(from_start_) || !is_graph(to_end_)) return 0.0L;
  const Vec q = local(p);
  if (q.x >= 0.0L && q.x <= h_) {
    const Real y0 = Graph(from_start_).ordinate(q.x), y1 = Graph(to_end_).ordinate(q.x);
    if (q.y >= std::min(y0, y1) && q.y <= std::max(y0, y1)) return 0.0L;
  }
  return nearer(p);
}

Lens Lens::of(Vec a, Vec b, Vec c, Vec d) {
  const auto between = [](Vec u, Vec v) { return std::atan2(cross(u, v), dot(u, v)); };
  // inscribed angles over the chord, seen from the points beside it
  Lens out{between(b - a, c - a), between(d - b, d - c), norm(c - b), 0.0L, 0.0L};
  out.shortest = std::min({norm(b - a), out.chord, norm(d - c)});
  out.turning = std::abs(between(b - a, c - b)) + std::abs(between(c - b, d - c));
  return out;
}

bool Lens::holds() const { return turning < kPi; }

Real Lens::height() const {
  return 0.5L * chord * std::abs(std::tan(0.5L * after) - std::tan(0.5L * before));
}

Real Lens::growth() const {
  const Real u = std::tan(0.5L * before), v = std::tan(0.5L * after);
  return 0.5L * chord * (2.0L + u * u + v * v);
}

}  // namespace judge
