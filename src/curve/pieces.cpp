// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/pieces.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "homogeneous.h"
#include "obvid/curve/clothoid.h"
#include "obvid/numeric/internal/strict_arithmetic.h"

namespace obvid {
namespace {

using curve_detail::Homogeneous;

using ControlNet = std::array<Homogeneous, kMaxBezierDegree + 1>;

/// Control points relative to `reference`: the products with the weights then carry the size of
/// the piece, not of its coordinates, so curvature survives a piece far from the origin.
ControlNet control_net(const RationalBezier& piece, Vec2 reference) {
  ControlNet net{};
  for (std::size_t j = 0; j <= static_cast<std::size_t>(piece.degree); ++j) {
    const Vec2 q = piece.offset[j] - reference;
    net[j] = {piece.weight[j] * q.x, piece.weight[j] * q.y, piece.weight[j]};
  }
  return net;
}

/// Value and derivatives of the homogeneous curve; those beyond the degree are zero.
std::array<Homogeneous, 4> homogeneous_jet(ControlNet net, int degree, double t) {
  std::array<Homogeneous, 4> jet{};
  for (int left = degree; left >= 0; --left) {
    // `left` steps of de Casteljau remain, so net[0..left] yields the derivative of that order.
    const Homogeneous first = net[1] - net[0];
    const Homogeneous second = net[2] - net[1] - first;
    if (left == 0) jet[0] = net[0];
    if (left == 1) jet[1] = degree * first;
    if (left == 2) jet[2] = (degree * (degree - 1)) * second;
    if (left == 3) {
      const Homogeneous third = (net[3] - net[2]) - 2.0 * (net[2] - net[1]) + first;
      jet[3] = (degree * (degree - 1) * (degree - 2)) * third;
    }
    for (std::size_t j = 0; j < static_cast<std::size_t>(left); ++j) {
      net[j] = (1.0 - t) * net[j] + t * net[j + 1];
    }
  }
  return jet;
}

/// sin(x)/x without a hole at 0.
double sinc(double x) { return std::abs(x) < 1e-8 ? 1.0 : std::sin(x) / x; }  // 1 - x^2/6 == 1

/// Vector along an arc of signed length `s` that leaves with heading `theta`.
Vec2 arc_step(double theta, double kappa, double s) {
  const double half = 0.5 * kappa * s;
  return s * sinc(half) * unit_at(theta + half);
}

// Gauss-Legendre nodes and weights on [-1, 1], 8 points (Abramowitz and Stegun, table 25.4).
constexpr std::array<double, 4> kGaussNode = {0.1834346424956498, 0.5255324099163290,
                                              0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> kGaussWeight = {0.3626837833783620, 0.3137066458778873,
                                                0.2223810344533745, 0.1012285362903763};

double speed_integral(const RationalBezier& piece, double a, double b) {
  const double middle = 0.5 * (a + b);
  const double half = 0.5 * (b - a);
  double sum = 0.0;
  for (std::size_t j = 0; j < kGaussNode.size(); ++j) {
    sum += kGaussWeight[j] * (norm(evaluate(piece, middle - half * kGaussNode[j]).d1) +
                              norm(evaluate(piece, middle + half * kGaussNode[j]).d1));
  }
  return half * sum;
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
  // The nearer end is the reference: the end itself is then met exactly.
  const Vec2 reference = piece.offset[t <= 0.5 ? 0 : static_cast<std::size_t>(piece.degree)];
  const auto h = homogeneous_jet(control_net(piece, reference), piece.degree, t);
  const double inverse = 1.0 / h[0].w;
  const Vec2 q = inverse * Vec2{h[0].x, h[0].y};
  const Vec2 d1 = inverse * (Vec2{h[1].x, h[1].y} - h[1].w * q);
  const Vec2 d2 = inverse * (Vec2{h[2].x, h[2].y} - 2.0 * h[1].w * d1 - h[2].w * q);
  const Vec2 d3 =
      inverse * (Vec2{h[3].x, h[3].y} - 3.0 * h[1].w * d2 - 3.0 * h[2].w * d1 - h[3].w * q);
  return {piece.origin + (reference + q), d1, d2, d3};
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

double curvature_rate(const Jet& jet) {
  const double speed = norm(jet.d1);
  const Vec2 tangent = jet.d1 / speed;
  const Vec2 second = jet.d2 / speed;
  const Vec2 third = jet.d3 / speed;
  const double bend = cross(tangent, second);
  return (cross(tangent, third) - 3.0 * bend * dot(tangent, second)) / speed / speed;
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
