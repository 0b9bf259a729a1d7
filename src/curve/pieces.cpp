// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/pieces.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>

#include "obvid/curve/internal/clothoid.h"
#include "obvid/numeric/internal/gauss.h"
#include "obvid/numeric/internal/halving.h"
#include "obvid/numeric/internal/strict_arithmetic.h"

namespace obvid {
namespace {

/// Point of the projective plane: weighted coordinates and weight.
struct Homogeneous {
  double x = 0.0, y = 0.0, w = 0.0;

  friend Homogeneous operator+(Homogeneous a, Homogeneous b) {
    return {a.x + b.x, a.y + b.y, a.w + b.w};
  }
  friend Homogeneous operator*(double s, Homogeneous a) { return {s * a.x, s * a.y, s * a.w}; }
};

/// Value and the first three derivatives of one coordinate.
using CoordinateJet = std::array<double, 4>;

/// De Casteljau for one coordinate, in registers: the degree is known when this is compiled.
/// Derivatives beyond it are zero.
template <std::size_t Degree>
CoordinateJet coordinate_jet(std::array<double, Degree + 1> c, double t) {
  constexpr int n = static_cast<int>(Degree);
  CoordinateJet jet{};
  for (std::size_t left = Degree;; --left) {
    // `left` steps remain, so c[0..left] yields the derivative of that order.
    if (left == 0) jet[0] = c[0];
    if constexpr (Degree >= 1) {
      if (left == 1) jet[1] = n * (c[1] - c[0]);
    }
    if constexpr (Degree >= 2) {
      if (left == 2) jet[2] = (n * (n - 1)) * (c[2] - c[1] - (c[1] - c[0]));
    }
    if constexpr (Degree >= 3) {
      if (left == 3) {
        jet[3] = (n * (n - 1) * (n - 2)) * ((c[3] - c[2]) - 2.0 * (c[2] - c[1]) + (c[1] - c[0]));
      }
    }
    if (left == 0) return jet;
    for (std::size_t j = 0; j < left; ++j) c[j] = (1.0 - t) * c[j] + t * c[j + 1];
  }
}

/// Places at which a coordinate is evaluated side by side.
constexpr std::size_t kLanes = 4;
template <typename Number>
using Lanes = std::array<Number, kLanes>;

/// The same at several places at once: operation by operation what is done at one place.
template <std::size_t Degree>
std::array<Lanes<double>, 4> coordinate_jets(const std::array<double, Degree + 1>& c,
                                             const Lanes<double>& t) {
  constexpr int n = static_cast<int>(Degree);
  std::array<Lanes<double>, 4> jets{};
  std::array<Lanes<double>, Degree + 1> q{};
  Lanes<double> s{};
  for (std::size_t l = 0; l < kLanes; ++l) s[l] = 1.0 - t[l];
  for (std::size_t j = 0; j <= Degree; ++j) q[j].fill(c[j]);
  for (std::size_t left = Degree;; --left) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      if (left == 0) jets[0][l] = q[0][l];
      if constexpr (Degree >= 1) {
        if (left == 1) jets[1][l] = n * (q[1][l] - q[0][l]);
      }
      if constexpr (Degree >= 2) {
        if (left == 2) {
          jets[2][l] = (n * (n - 1)) * (q[2][l] - q[1][l] - (q[1][l] - q[0][l]));
        }
      }
      if constexpr (Degree >= 3) {
        if (left == 3) {
          jets[3][l] = (n * (n - 1) * (n - 2)) *
                       ((q[3][l] - q[2][l]) - 2.0 * (q[2][l] - q[1][l]) + (q[1][l] - q[0][l]));
        }
      }
    }
    if (left == 0) return jets;
    for (std::size_t j = 0; j < left; ++j) {
      for (std::size_t l = 0; l < kLanes; ++l) q[j][l] = s[l] * q[j][l] + t[l] * q[j + 1][l];
    }
  }
}

/// Control points relative to `reference`: the products with the weights then carry the size of
/// the piece, not of its coordinates, so curvature survives a piece far from the origin.
using ControlNet = std::array<Homogeneous, kMaxBezierDegree + 1>;

ControlNet control_net(const RationalBezier& piece, Vec2 reference) {
  ControlNet net{};
  for (std::size_t j = 0; j <= static_cast<std::size_t>(piece.degree); ++j) {
    const Vec2 q = piece.offset[j] - reference;
    net[j] = {piece.weight[j] * q.x, piece.weight[j] * q.y, piece.weight[j]};
  }
  return net;
}

/// Those of a piece whose degree is known, coordinate by coordinate.
template <std::size_t Degree>
std::array<std::array<double, Degree + 1>, 3> weighted(const RationalBezier& piece,
                                                       Vec2 reference) {
  std::array<std::array<double, Degree + 1>, 3> out{};
  auto& [x, y, w] = out;
  for (std::size_t j = 0; j <= Degree; ++j) {
    const Vec2 q = piece.offset[j] - reference;
    w[j] = piece.weight[j];
    x[j] = w[j] * q.x;
    y[j] = w[j] * q.y;
  }
  return out;
}

/// Value and derivatives of the homogeneous curve.
template <std::size_t Degree>
std::array<Homogeneous, 4> homogeneous_jet(const RationalBezier& piece, Vec2 reference, double t) {
  const auto [x, y, w] = weighted<Degree>(piece, reference);
  const CoordinateJet jx = coordinate_jet<Degree>(x, t), jy = coordinate_jet<Degree>(y, t),
                      jw = coordinate_jet<Degree>(w, t);
  std::array<Homogeneous, 4> jet{};
  for (std::size_t r = 0; r < 4; ++r) jet[r] = {jx[r], jy[r], jw[r]};
  return jet;
}

/// The same at several places.
template <std::size_t Degree>
Lanes<std::array<Homogeneous, 4>> homogeneous_jets(const RationalBezier& piece, Vec2 reference,
                                                   const Lanes<double>& t) {
  const auto [x, y, w] = weighted<Degree>(piece, reference);
  const auto jx = coordinate_jets<Degree>(x, t), jy = coordinate_jets<Degree>(y, t),
             jw = coordinate_jets<Degree>(w, t);
  Lanes<std::array<Homogeneous, 4>> jets{};
  for (std::size_t l = 0; l < kLanes; ++l) {
    for (std::size_t r = 0; r < 4; ++r) jets[l][r] = {jx[r][l], jy[r][l], jw[r][l]};
  }
  return jets;
}

template <std::size_t... Degrees>
Lanes<std::array<Homogeneous, 4>> jets_by_degree(const RationalBezier& piece, Vec2 reference,
                                                 const Lanes<double>& t,
                                                 std::index_sequence<Degrees...>) {
  constexpr std::array kOfDegree = {&homogeneous_jets<Degrees>...};
  return kOfDegree[static_cast<std::size_t>(piece.degree)](piece, reference, t);
}

template <std::size_t... Degrees>
std::array<Homogeneous, 4> jet_by_degree(const RationalBezier& piece, Vec2 reference, double t,
                                         std::index_sequence<Degrees...>) {
  constexpr std::array kOfDegree = {&homogeneous_jet<Degrees>...};
  return kOfDegree[static_cast<std::size_t>(piece.degree)](piece, reference, t);
}

/// Of the curve in the plane, from that of the homogeneous one seen from `reference`.
Jet in_plane(const std::array<Homogeneous, 4>& h, Vec2 origin, Vec2 reference) {
  const double inverse = 1.0 / h[0].w;
  const Vec2 q = inverse * Vec2{h[0].x, h[0].y};
  const Vec2 d1 = inverse * (Vec2{h[1].x, h[1].y} - h[1].w * q);
  const Vec2 d2 = inverse * (Vec2{h[2].x, h[2].y} - 2.0 * h[1].w * d1 - h[2].w * q);
  const Vec2 d3 =
      inverse * (Vec2{h[3].x, h[3].y} - 3.0 * h[1].w * d2 - 3.0 * h[2].w * d1 - h[3].w * q);
  return {origin + (reference + q), d1, d2, d3};
}

/// The nearer end: it is met exactly when coordinates are seen from it.
Vec2 nearer_end(const RationalBezier& piece, double t) {
  return piece.offset[t <= 0.5 ? 0 : static_cast<std::size_t>(piece.degree)];
}

/// sin(x)/x without a hole at 0.
double sinc(double x) { return std::abs(x) < 1e-8 ? 1.0 : std::sin(x) / x; }  // 1 - x^2/6 == 1

/// Vector along an arc of signed length `s` that leaves with heading `theta`.
Vec2 arc_step(double theta, double kappa, double s) {
  const double half = 0.5 * kappa * s;
  return s * sinc(half) * unit_at(theta + half);
}

double speed_integral(const RationalBezier& piece, double a, double b) {
  return gauss_integral<8>(a, b, [&](double t) { return norm(evaluate(piece, t).d1); });
}

constexpr int kMaxHalvings = 40;               // a speed that is smooth converges in less than ten
constexpr double kQuadratureRounding = 1e-14;  // relative; two such sums agree no better

double refined_length(const RationalBezier& piece, double a, double b, double whole,
                      double tolerance, int halvings) {
  const double middle = 0.5 * (a + b);
  const double left = speed_integral(piece, a, middle);
  const double right = speed_integral(piece, middle, b);
  const double error = std::abs(left + right - whole);
  if (error <= std::max(tolerance, kQuadratureRounding * whole) || halvings == 0) {
    return left + right;
  }
  return refined_length(piece, a, middle, left, 0.5 * tolerance, halvings - 1) +
         refined_length(piece, middle, b, right, 0.5 * tolerance, halvings - 1);
}

/// Along the first leg from an end of the control polygon that has a length; nothing when none has.
Vec2 limit_direction(const RationalBezier& piece, bool at_end) {
  const auto n = static_cast<std::size_t>(piece.degree);
  const Vec2 end = piece.offset[at_end ? n : 0];
  for (std::size_t k = 1; k <= n; ++k) {
    const Vec2 leg = piece.offset[at_end ? n - k : k] - end;
    if (!(leg == Vec2{})) return at_end ? -1.0 * leg : leg;
  }
  return {};
}

}  // namespace

Jet evaluate(const LinePiece& piece, double t) {
  const Vec2 d = piece.end - piece.start;
  return {t <= 0.5 ? piece.start + t * d : piece.end - (1.0 - t) * d, d, {}, {}};
}

Jet evaluate(const ArcPiece& piece, double t) {
  const double heading_here = piece.theta0 + piece.kappa * piece.length * t;
  // Each half is measured from its own end, so both ends come out exactly.
  const Vec2 point =
      t <= 0.5 ? piece.start + arc_step(piece.theta0, piece.kappa, piece.length * t)
               : piece.end - arc_step(heading_here, piece.kappa, piece.length * (1.0 - t));
  const Vec2 d1 = piece.length * unit_at(heading_here);
  const double turn = piece.length * piece.kappa;
  return {point, d1, turn * left_normal(d1), -(turn * turn) * d1};
}

Jet evaluate(const RationalBezier& piece, double t) {
  assert(piece.degree >= 1 && piece.degree <= kMaxBezierDegree);
  const Vec2 reference = nearer_end(piece, t);
  return in_plane(
      jet_by_degree(piece, reference, t, std::make_index_sequence<kMaxBezierDegree + 1>{}),
      piece.origin, reference);
}

void evaluate(const RationalBezier& piece, std::span<const double> t, std::span<Jet> jets) {
  assert(t.size() == jets.size());
  std::size_t i = 0;
  while (i < t.size()) {
    const std::size_t end = i + kLanes;
    const bool one_half =
        end <= t.size() && std::all_of(t.begin() + static_cast<std::ptrdiff_t>(i),
                                       t.begin() + static_cast<std::ptrdiff_t>(end),
                                       [&](double u) { return (u <= 0.5) == (t[i] <= 0.5); });
    if (!one_half) {
      jets[i] = evaluate(piece, t[i]);
      ++i;
      continue;
    }
    const Vec2 reference = nearer_end(piece, t[i]);
    Lanes<double> places{};
    std::copy_n(t.begin() + static_cast<std::ptrdiff_t>(i), kLanes, places.begin());
    const auto all =
        jets_by_degree(piece, reference, places, std::make_index_sequence<kMaxBezierDegree + 1>{});
    for (const auto& one : all) jets[i++] = in_plane(one, piece.origin, reference);
  }
}

Jet evaluate(const ClothoidPiece& piece, double t) {
  const double change = piece.kappa1 - piece.kappa0;
  // Each half is measured from its own end, so both ends come out exactly.
  const bool first_half = t <= 0.5;
  const double kappa = first_half ? piece.kappa0 + t * change : piece.kappa1 - (1.0 - t) * change;
  const double heading_here = piece.theta0 + 0.5 * (piece.kappa0 + kappa) * piece.length * t;
  const Vec2 point =
      first_half
          ? piece.start + clothoid_step(piece.theta0, piece.kappa0, kappa, piece.length * t)
          : piece.end - clothoid_step(heading_here, kappa, piece.kappa1, piece.length * (1.0 - t));
  const Vec2 d1 = piece.length * unit_at(heading_here);
  const double turn = piece.length * kappa;
  const Vec2 normal = left_normal(d1);
  return {point, d1, turn * normal, (piece.length * change) * normal - (turn * turn) * d1};
}

Jet evaluate(const Piece& piece, double t) {
  return std::visit([t](const auto& p) { return evaluate(p, t); }, piece);
}

double curvature(const Jet& jet) {
  const double speed = norm(jet.d1);
  return cross(jet.d1 / speed, jet.d2 / speed) / speed;
}

namespace {

double turning_both_ways(const LinePiece& /*piece*/, double /*t0*/, double /*t1*/) { return 0.0; }

double turning_both_ways(const ArcPiece& p, double t0, double t1) {
  return std::abs(p.kappa) * p.length * (t1 - t0);
}

double turning_both_ways(const ClothoidPiece& p, double t0, double t1) {
  const double length = p.length * (t1 - t0);
  const double from = p.kappa0 + (p.kappa1 - p.kappa0) * t0;
  const double to = p.kappa0 + (p.kappa1 - p.kappa0) * t1;
  if (from * to >= 0.0) return 0.5 * (std::abs(from) + std::abs(to)) * length;
  const double part = from / (from - to);  // up to the inflection
  return 0.5 * (std::abs(from) * part + std::abs(to) * (1.0 - part)) * length;
}

/// Where a curvature that has one sign at t0 and another one at t1 changes it.
double inflection_between(const RationalBezier& p, double t0, double t1) {
  const double start = curvature(evaluate(p, t0));
  const auto has_its_sign = [&](double t) { return start * curvature(evaluate(p, t)) > 0.0; };
  return end_of_condition(t0, t1, has_its_sign).middle();
}

double turning_both_ways(const RationalBezier& p, double t0, double t1) {
  const Jet start = evaluate(p, t0), end = evaluate(p, t1);
  if (!(curvature(start) * curvature(end) < 0.0)) return std::abs(turning(start.d1, end.d1));
  const Vec2 between = evaluate(p, inflection_between(p, t0, t1)).d1;
  return std::abs(turning(start.d1, between)) + std::abs(turning(between, end.d1));
}

}  // namespace

double turning_both_ways(const Piece& piece, double t0, double t1) {
  return std::visit([&](const auto& p) { return turning_both_ways(p, t0, t1); }, piece);
}

double curvature_rate(const Jet& jet) {
  const double speed = norm(jet.d1);
  const Vec2 tangent = jet.d1 / speed;
  const Vec2 second = jet.d2 / speed;
  const Vec2 third = jet.d3 / speed;
  const double bend = cross(tangent, second);
  return (cross(tangent, third) - 3.0 * bend * dot(tangent, second)) / speed / speed;
}

bool is_polynomial(const RationalBezier& b) {
  for (int j = 1; j <= b.degree; ++j) {
    if (b.weight[static_cast<std::size_t>(j)] != b.weight[0]) return false;
  }
  return true;
}

bool is_singular_end(const Piece& piece, double t) {
  const auto* bezier = std::get_if<RationalBezier>(&piece);
  if (bezier == nullptr || (t != 0.0 && t != 1.0)) return false;
  const auto n = static_cast<std::size_t>(bezier->degree);
  return t == 0.0 ? bezier->offset[1] == bezier->offset[0]
                  : bezier->offset[n - 1] == bezier->offset[n];
}

Element element_at(const Piece& piece, double t) {
  const Jet jet = evaluate(piece, t);
  if (!is_singular_end(piece, t)) return {jet.point, heading(jet.d1), curvature(jet)};
  return {jet.point, heading(limit_direction(std::get<RationalBezier>(piece), t == 1.0)),
          std::numeric_limits<double>::quiet_NaN()};
}

Piece reversed(const Piece& piece) {
  if (const auto* line = std::get_if<LinePiece>(&piece)) return LinePiece{line->end, line->start};
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
    const double theta = arc->theta0 + arc->kappa * arc->length + std::numbers::pi;
    return ArcPiece{arc->end, arc->start, theta, -arc->kappa, arc->length};
  }
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) {
    RationalBezier out = *bezier;
    std::reverse(out.offset.begin(), out.offset.begin() + out.degree + 1);
    std::reverse(out.weight.begin(), out.weight.begin() + out.degree + 1);
    return out;
  }
  const auto& c = std::get<ClothoidPiece>(piece);
  const double theta = c.theta0 + 0.5 * (c.kappa0 + c.kappa1) * c.length + std::numbers::pi;
  return ClothoidPiece{c.end, c.start, theta, -c.kappa1, -c.kappa0, c.length};
}

Piece moved(const Piece& piece, Vec2 by) {
  return std::visit(
      [by](auto shifted) -> Piece {
        if constexpr (std::is_same_v<decltype(shifted), RationalBezier>) {
          if (shifted.origin == Vec2{}) {
            for (int j = 0; j <= shifted.degree; ++j) {
              Vec2& offset = shifted.offset[static_cast<std::size_t>(j)];
              offset = offset + by;
            }
          } else {
            shifted.origin = shifted.origin + by;
          }
        } else {
          shifted.start = shifted.start + by;
          shifted.end = shifted.end + by;
        }
        return shifted;
      },
      piece);
}

Vec2 start_point(const Piece& piece) {
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) {
    return bezier->origin + bezier->offset[0];
  }
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) return arc->start;
  if (const auto* clothoid = std::get_if<ClothoidPiece>(&piece)) return clothoid->start;
  return std::get<LinePiece>(piece).start;
}

Vec2 end_point(const Piece& piece) {
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) {
    return bezier->origin + bezier->offset[static_cast<std::size_t>(bezier->degree)];
  }
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) return arc->end;
  if (const auto* clothoid = std::get_if<ClothoidPiece>(&piece)) return clothoid->end;
  return std::get<LinePiece>(piece).end;
}

double arc_length(const Piece& piece, double tolerance) {
  if (const auto* line = std::get_if<LinePiece>(&piece)) return norm(line->end - line->start);
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) return arc->length;
  if (const auto* clothoid = std::get_if<ClothoidPiece>(&piece)) return clothoid->length;
  const auto& bezier = std::get<RationalBezier>(piece);
  const double whole = speed_integral(bezier, 0.0, 1.0);
  return refined_length(bezier, 0.0, 1.0, whole, tolerance, kMaxHalvings);
}

std::array<RationalBezier, 2> split(const RationalBezier& piece, double t) {
  const auto degree = static_cast<std::size_t>(piece.degree);
  const Vec2 reference = piece.offset[0];
  ControlNet net = control_net(piece, reference);
  std::array<RationalBezier, 2> half = {piece, piece};
  const auto store = [&](RationalBezier& target, std::size_t j, const Homogeneous& h) {
    target.offset[j] = reference + Vec2{h.x / h.w, h.y / h.w};
    target.weight[j] = h.w;
  };
  for (std::size_t step = 1; step <= degree; ++step) {
    for (std::size_t j = 0; j + step <= degree; ++j) {
      net[j] = (1.0 - t) * net[j] + t * net[j + 1];
    }
    store(half[0], step, net[0]);
    store(half[1], degree - step, net[degree - step]);
  }
  return half;
}

}  // namespace obvid
