// SPDX-License-Identifier: Apache-2.0
#include "dxf/arcs.h"

#include <algorithm>
#include <cmath>

#include "obvid/geom/internal/angle.h"

namespace obvid::dxf {
namespace {

constexpr double kMostArc = 3.0;      // of one arc, rad: below half a turn
constexpr double kMostQuarter = 1.6;  // of one conic, rad: weights above 0.69

Vec2 on(const EllipseFrame& f, double angle) {
  return f.centre + std::cos(angle) * f.p + std::sin(angle) * f.q;
}

/// The point, exactly the same one after a whole turn.
struct Stations {
  const EllipseFrame& frame;
  double from, sweep;
  int count;

  [[nodiscard]] double angle(int k) const { return from + sweep * k / count; }
  [[nodiscard]] Vec2 point(int k) const {
    const bool whole = std::abs(sweep) >= kFullTurn;
    return on(frame, k == count && whole ? from : angle(k));
  }
};

void append_circular(const Stations& s, std::vector<Piece>& pieces) {
  const EllipseFrame& f = s.frame;
  const double radius = norm(f.p);
  const double side = (cross(f.p, f.q) > 0.0) == (s.sweep > 0.0) ? 1.0 : -1.0;
  for (int k = 0; k < s.count; ++k) {
    const Vec2 tangent = std::cos(s.angle(k)) * f.q - std::sin(s.angle(k)) * f.p;
    pieces.emplace_back(ArcPiece{s.point(k), s.point(k + 1),
                                 heading(s.sweep > 0.0 ? tangent : -tangent), side / radius,
                                 radius * std::abs(s.sweep) / s.count});
  }
}

void append_conics(const Stations& s, std::vector<Piece>& pieces) {
  const EllipseFrame& f = s.frame;
  const double half = 0.5 * s.sweep / s.count, weight = std::cos(half);
  for (int k = 0; k < s.count; ++k) {
    const double middle = s.angle(k) + half;
    RationalBezier conic;
    conic.degree = 2;
    const Vec2 apex =
        f.centre + (std::cos(middle) / weight) * f.p + (std::sin(middle) / weight) * f.q;
    conic.offset[0] = s.point(k);
    conic.offset[1] = apex;
    conic.offset[2] = s.point(k + 1);
    conic.weight[0] = conic.weight[2] = 1.0;
    conic.weight[1] = weight;
    pieces.emplace_back(conic);
  }
}

}  // namespace

bool is_circular(const EllipseFrame& frame) {
  constexpr double kRounding = 1e-14;  // of rotations and scales that were multiplied
  const double p = norm(frame.p), q = norm(frame.q);
  return std::abs(p - q) <= kRounding * p && std::abs(dot(frame.p, frame.q)) <= kRounding * p * q;
}

double sweep_of(double from, double to, double turn) {
  constexpr double kWhole = 1e-9;  // of a turn: digits that a whole turn is printed with
  const double difference = to - from;
  if (std::abs(std::abs(difference) - turn) <= kWhole * turn) return turn;
  const double sweep = positive_angle(difference, turn);
  return sweep > 0.0 ? sweep : turn;
}

void append_elliptic(const EllipseFrame& frame, double from, double sweep,
                     std::vector<Piece>& pieces) {
  const bool circular = is_circular(frame);
  const double most = circular ? kMostArc : kMostQuarter;
  const int count = std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / most)));
  const Stations stations{frame, from, sweep, count};
  if (circular) {
    append_circular(stations, pieces);
  } else {
    append_conics(stations, pieces);
  }
}

void append_bulge(Vec2 from, Vec2 to, double bulge, std::vector<Piece>& pieces) {
  const Vec2 chord = to - from;
  const double c = norm(chord), sweep = 4.0 * std::atan(bulge);
  const double kappa = 4.0 * bulge / (c * (1.0 + bulge * bulge));
  const double theta = heading(chord) - 0.5 * sweep;
  if (std::abs(sweep) <= kMostArc) {
    pieces.emplace_back(ArcPiece{from, to, theta, kappa, sweep / kappa});
    return;
  }
  // The middle of the arc lies beside that of the chord, by the bulge times half of it.
  const Vec2 middle = 0.5 * (from + to) - (0.5 * bulge) * left_normal(chord);
  const double half = bulge / (1.0 + std::sqrt(1.0 + bulge * bulge));  // tangent of half the angle
  append_bulge(from, middle, half, pieces);
  append_bulge(middle, to, half, pieces);
}

}  // namespace obvid::dxf
