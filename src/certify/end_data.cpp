// SPDX-License-Identifier: Apache-2.0
#include "end_data.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "obvid/numeric/double_double.h"

namespace obvid {
namespace {

/// Roundings that a stored number carries, in units of 2^-53 of its size: one half ulp from
/// storing it and a few from computing it.
constexpr double kStoredRoundings = 4.0;
constexpr double kStored = kStoredRoundings * kUnitRoundoff;

double largest_coordinate(Vec2 v) { return std::max(std::abs(v.x), std::abs(v.y)); }

EndData line_end(const LinePiece& line, Vec2 point) {
  const Vec2 d = line.end - line.start;
  const double length = norm(d);
  EndData end;
  end.point = point;
  end.direction = d / length;
  end.point_rounding = kStored * largest_coordinate(point);
  end.heading_rounding =
      kStored * (1.0 + (largest_coordinate(line.start) + largest_coordinate(line.end)) / length);
  return end;
}

/// The arc's `end` must be where its heading, curvature and length lead: what the arc says at its
/// end is taken from these, so the gap shows any contradiction.
EndData arc_end(const ArcPiece& arc, double t) {
  const double theta = arc.theta0 + arc.kappa * arc.length * t;
  const double half = 0.5 * arc.kappa * arc.length;
  const double chord = std::abs(half) > kUnitRoundoff ? std::sin(half) / half : 1.0;
  EndData end;
  end.point = t == 0.0 ? arc.start : arc.start + arc.length * chord * unit_at(arc.theta0 + half);
  end.direction = unit_at(theta);
  end.kappa = arc.kappa;
  // a short arc far from the origin: its points cannot say its heading better than this
  const double lever =
      (largest_coordinate(arc.start) + largest_coordinate(arc.end)) / norm(arc.end - arc.start);
  end.heading_rounding = kStored * (1.0 + std::abs(arc.theta0) + std::abs(theta) + lever);
  end.point_rounding = kStored * (largest_coordinate(arc.start) + largest_coordinate(arc.end)) +
                       end.heading_rounding * arc.length;
  end.kappa_rounding = kStored * std::abs(arc.kappa);
  return end;
}

// Gauss-Legendre nodes and weights on [-1, 1], 8 points (Abramowitz and Stegun, table 25.4).
constexpr std::array<double, 4> kGaussNode = {0.1834346424956498, 0.5255324099163290,
                                              0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> kGaussWeight = {0.3626837833783620, 0.3137066458778873,
                                                0.2223810344533745, 0.1012285362903763};
constexpr double kPanelTurn = 1.0;    // rad: 8 points are exact to rounding up to here
constexpr double kMostPanels = 64.0;  // ten full turns; a piece that is proved has less than half

/// Where a clothoid leads, by quadrature: the proof does not use the formulas that built the piece.
Vec2 clothoid_chord(const ClothoidPiece& piece) {
  const double sharpness = (piece.kappa1 - piece.kappa0) / piece.length;
  const double turn = std::max(std::abs(piece.kappa0), std::abs(piece.kappa1)) * piece.length;
  const int panels = 1 + static_cast<int>(std::min(kMostPanels, turn / kPanelTurn));
  const double half = 0.5 * piece.length / panels;
  Vec2 chord;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = (2 * panel + 1) * half;
    for (std::size_t j = 0; j < kGaussNode.size(); ++j) {
      for (const double s : {middle - half * kGaussNode[j], middle + half * kGaussNode[j]}) {
        const double theta = piece.theta0 + s * (piece.kappa0 + 0.5 * sharpness * s);
        chord = chord + half * kGaussWeight[j] * unit_at(theta);
      }
    }
  }
  return chord;
}

/// As for an arc, the stored `end` is compared with where the other numbers lead.
EndData clothoid_end(const ClothoidPiece& piece, double t) {
  const double turn = 0.5 * (piece.kappa0 + piece.kappa1) * piece.length;
  const double theta = t == 0.0 ? piece.theta0 : piece.theta0 + turn;
  EndData end;
  end.point = t == 0.0 ? piece.start : piece.start + clothoid_chord(piece);
  end.direction = unit_at(theta);
  end.kappa = t == 0.0 ? piece.kappa0 : piece.kappa1;
  const double lever = (largest_coordinate(piece.start) + largest_coordinate(piece.end)) /
                       norm(piece.end - piece.start);
  end.heading_rounding = kStored * (1.0 + std::abs(piece.theta0) + std::abs(theta) + lever);
  end.point_rounding = kStored * (largest_coordinate(piece.start) + largest_coordinate(piece.end)) +
                       end.heading_rounding * piece.length;
  end.kappa_rounding = kStored * std::abs(end.kappa);
  return end;
}

/// First three control points seen from one end, with their weights.
struct EndPolygon {
  Vec2 point, leg1, leg2;  ///< legs from the end to the next two control points
  double w0 = 1.0, w1 = 1.0, w2 = 1.0;
  double coordinate = 0.0;  ///< largest stored offset
  int degree = 0;
};

/// kappa = (n-1)/n (w0 w2 / w1^2) cross(leg1, leg2) / |leg1|^3, and what rounding does to it.
EndData bezier_end(const EndPolygon& p, double side) {
  const double length = norm(p.leg1);
  const double moved = kStored * p.coordinate / length;  // of a control point, against leg 1
  EndData end;
  end.point = p.point;
  end.direction = (side / length) * p.leg1;
  end.point_rounding = kStored * largest_coordinate(p.point);
  end.heading_rounding = kStored + 2.0 * moved;
  const double factor = (p.degree - 1.0) / p.degree * (p.w0 * p.w2 / (p.w1 * p.w1));
  const Vec2 unit = p.leg1 / length;
  end.kappa = side * factor * (cross(unit, p.leg2) / length) / length;
  const double lever = 1.0 + norm(p.leg2) / length;  // turning leg 1 sweeps point 2 this far
  end.kappa_rounding = std::abs(end.kappa) * 4.0 * (kStored + moved) +
                       std::abs(factor) * 2.0 * lever * (moved + kStored) / length;
  return end;
}

EndPolygon polygon_at(const RationalBezier& piece, bool at_start) {
  const auto n = static_cast<std::size_t>(piece.degree);
  const auto at = [&](std::size_t j) { return at_start ? j : n - j; };
  EndPolygon p;
  const Vec2 q = piece.offset[at(0)];
  p.point = piece.origin + q;
  p.leg1 = piece.offset[at(1)] - q;
  p.leg2 = n >= 2 ? piece.offset[at(2)] - q : 2.0 * p.leg1;
  p.w0 = piece.weight[at(0)];
  p.w1 = piece.weight[at(1)];
  p.w2 = n >= 2 ? piece.weight[at(2)] : 1.0;
  for (std::size_t j = 0; j < 3 && j <= n; ++j) {
    p.coordinate = std::max(p.coordinate, largest_coordinate(piece.offset[at(j)]));
  }
  p.degree = piece.degree;
  return p;
}

}  // namespace

EndData start_data(const Piece& piece) {
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) {
    return bezier_end(polygon_at(*bezier, true), 1.0);
  }
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) return arc_end(*arc, 0.0);
  if (const auto* one = std::get_if<ClothoidPiece>(&piece)) return clothoid_end(*one, 0.0);
  const auto& line = std::get<LinePiece>(piece);
  return line_end(line, line.start);
}

EndData end_data(const Piece& piece) {
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) {
    return bezier_end(polygon_at(*bezier, false), -1.0);
  }
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) return arc_end(*arc, 1.0);
  if (const auto* one = std::get_if<ClothoidPiece>(&piece)) return clothoid_end(*one, 1.0);
  const auto& line = std::get<LinePiece>(piece);
  return line_end(line, line.end);
}

}  // namespace obvid
