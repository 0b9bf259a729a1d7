// SPDX-License-Identifier: Apache-2.0
#include "form.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "obvid/contour/arcs.h"
#include "obvid/contour/spirals.h"
#include "obvid/region/refine.h"

namespace obvid::pipeline_detail {
namespace {

/// Rounding of the coordinates may blur at most this part of a piece's change of curvature;
/// where it blurs more, the piece keeps its start as origin and its offsets their own digits.
constexpr double kLargestBlur = 1e-3;
/// Curvature error of a quartic Bezier per rounding of a control point, over (chord)^2.
constexpr double kCurvaturePerRounding = 48.0;

bool fits_global_coordinates(const RationalBezier& piece, double change_of_kappa) {
  const Vec2 a = piece.origin + piece.offset[0], b = piece.origin + piece.offset[4];
  const double extent = std::max(std::abs(a.x) + std::abs(a.y), std::abs(b.x) + std::abs(b.y));
  const Vec2 chord = piece.offset[4] - piece.offset[0];
  const double chord2 = dot(chord, chord);
  const double blur = kCurvaturePerRounding * 0x1p-53 * extent / chord2;
  return blur <= kLargestBlur * std::abs(change_of_kappa);
}

RationalBezier in_global_coordinates(RationalBezier piece) {
  for (int j = 0; j <= piece.degree; ++j) {
    const auto k = static_cast<std::size_t>(j);
    piece.offset[k] = piece.origin + piece.offset[k];
  }
  piece.origin = {0.0, 0.0};
  return piece;
}

/// One line or arc through all points, as many pieces as chords.
SeriesChain one_circle(const std::vector<Vec2>& points, const Analysis& a) {
  SeriesChain out;
  const std::size_t n = points.size();
  const double kappa = a.stretches.front().kappa;
  out.cone.assign(n - 1, Cone::kNone);
  out.direction.assign(n - 1, 0);
  out.converged = true;
  out.smallest_margin = 1.0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool last = i + 1 == n;
    const Chord& chord = a.chords[last ? i - 1 : i];
    const double angle = kappa == 0.0 ? 0.0 : last ? a.circles[i].eta_in : -a.circles[i].eta_out;
    out.elements.push_back({points[i], chord.omega + angle, kappa});
    out.source.emplace_back(i);
  }
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double omega = a.chords[i].omega;
    out.links.push_back({a.chords[i].length, omega, out.elements[i].theta - omega,
                         out.elements[i + 1].theta - omega, 0.0, 0.0, 0.0});
  }
  return out;
}

/// Circle or line over a chord: heading from chord and curvature, so that the arc ends on its end.
Piece arc_over_chord(const LinkState& link, const Element& a, const Element& b) {
  if (a.kappa == 0.0) return LinePiece{a.point, b.point};
  const double sine = std::clamp(0.5 * a.kappa * link.h, -1.0, 1.0);
  const bool beyond_half = std::abs(link.alpha) > 0.5 * std::numbers::pi;
  const double half_turn =
      beyond_half ? std::copysign(std::numbers::pi, sine) - std::asin(sine) : std::asin(sine);
  return ArcPiece{a.point, b.point, link.omega - half_turn, a.kappa, 2.0 * half_turn / a.kappa};
}

/// Element at the start of a part inside a link, its heading unwrapped between both ends'.
Element element_between(const RationalBezier& part, double theta_before, double theta_after) {
  Element e = element_at(Piece{part}, 0.0);
  const double middle = 0.5 * (theta_before + theta_after);
  e.theta = middle + std::remainder(e.theta - middle, 2.0 * std::numbers::pi);
  return e;
}

bool wholly_circular(const std::vector<Vec2>& points, const Analysis& a) {
  return !a.stretches.empty() && a.stretches.front().first == 0 &&
         a.stretches.front().last + 1 == points.size();
}

bool anything_fixed(const ChainWishes& wishes) {
  return std::any_of(wishes.fixed.begin(), wishes.fixed.end(),
                     [](const FixedData& f) { return f.theta || f.kappa; });
}

}  // namespace

Result<SeriesChain> form_elements(const std::vector<Vec2>& points, const Analysis& analysis,
                                  const ChainWishes& wishes) {
  if (!wholly_circular(points, analysis)) return choose_elements(points, analysis, wishes);
  if (anything_fixed(wishes)) {
    return fail(
        {ErrorCode::kFixedDataContradict,
         "the points lie on one circle or line, which leaves no heading or radius to choose", "",
         "drop the fixed data, or add points", 0, analysis.stretches.front().kappa});
  }
  return one_circle(points, analysis);
}

Result<Contour> form_spirals(const std::vector<Vec2>& points, const Analysis& analysis,
                             const SeriesChain& chain) {
  (void)analysis;
  Contour contour;
  contour.points = points;
  contour.pieces.reserve(chain.links.size());
  contour.joints.reserve(chain.elements.size());
  std::vector<int> direction;
  direction.reserve(chain.links.size());
  std::vector<RationalBezier> parts;
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    const Element& a = chain.elements[i];
    const Element& b = chain.elements[i + 1];
    contour.joints.push_back({a, chain.source[i]});
    direction.push_back(chain.direction[i]);
    if (chain.cone[i] == Cone::kNone) {
      contour.pieces.push_back(arc_over_chord(chain.links[i], a, b));
      continue;
    }
    parts.clear();
    if (!append_spiral(chain.links[i], chain.direction[i], a.point, b.point, parts)) {
      return fail({ErrorCode::kInternal, "a link of the chain left its cone",
                   "piece " + std::to_string(i), "report this series",
                   static_cast<std::ptrdiff_t>(i), chain.links[i].sigma});
    }
    for (std::size_t j = 0; j < parts.size(); ++j) {
      if (j > 0) {  // a piece that turns far came out in parts
        contour.joints.push_back({element_between(parts[j], a.theta, b.theta), std::nullopt});
        direction.push_back(chain.direction[i]);
      }
      const bool global = fits_global_coordinates(parts[j], b.kappa - a.kappa);
      contour.pieces.emplace_back(global ? in_global_coordinates(parts[j]) : parts[j]);
    }
  }
  contour.joints.push_back({chain.elements.back(), chain.source.back()});
  contour.runs = collect_runs(direction);
  return contour;
}

std::vector<Run> collect_runs(const std::vector<int>& direction) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < direction.size(); ++i) {
    if (!runs.empty() && runs.back().direction == direction[i]) {
      runs.back().last_piece = i;
    } else {
      runs.push_back({i, i, direction[i]});
    }
  }
  return runs;
}

std::vector<int> piece_directions(const Contour& contour) {
  std::vector<int> direction(contour.pieces.size(), 0);
  for (const Run& run : contour.runs) {
    for (std::size_t i = run.first_piece; i <= run.last_piece && i < direction.size(); ++i) {
      direction[i] = run.direction;
    }
  }
  return direction;
}

Result<Contour> form_arcs(const Contour& spirals, double tolerance) {
  Contour contour;
  contour.units = spirals.units;
  contour.carrier = Carrier::kArcs;
  contour.points = spirals.points;
  const std::vector<int> spiral_direction = piece_directions(spirals);
  std::vector<int> direction;
  for (std::size_t i = 0; i < spirals.pieces.size(); ++i) {
    const Piece& piece = spirals.pieces[i];
    contour.joints.push_back(spirals.joints[i]);
    if (!std::holds_alternative<RationalBezier>(piece)) {
      contour.pieces.push_back(piece);
      direction.push_back(0);
      continue;
    }
    const int d = spiral_direction[i];
    const std::vector<double> steps = fewest_elements(piece, d, tolerance);
    if (steps.back() < 1.0) {
      return fail({ErrorCode::kToleranceNotReached, "the tolerance asks for too many arcs",
                   "piece " + std::to_string(i), "choose a larger --tolerance",
                   static_cast<std::ptrdiff_t>(i), tolerance});
    }
    Element from = spirals.joints[i].element;
    for (std::size_t j = 1; j < steps.size(); ++j) {
      const bool last = j + 1 == steps.size();
      Element to = last ? spirals.joints[i + 1].element : element_at(piece, steps[j]);
      to.theta = from.theta + std::remainder(to.theta - from.theta, 2.0 * std::numbers::pi);
      const auto k = choose_biarc(chord_frame(from, to), d);
      if (!k) {
        return fail({ErrorCode::kNotProved, "no pair of arcs joins two elements of the contour",
                     "piece " + std::to_string(i), "report this series",
                     static_cast<std::ptrdiff_t>(i), 0.0});
      }
      const auto arcs = biarc(from, to, *k);
      const Vec2 joint = end_point(arcs[0]);
      const double theta = std::holds_alternative<ArcPiece>(arcs[1])
                               ? std::get<ArcPiece>(arcs[1]).theta0
                               : from.theta;
      if (contour.pieces.empty() || j == 1) {
        if (contour.joints.size() == 1) contour.joints.back().element.kappa = k->first;
      }
      contour.pieces.push_back(arcs[0]);
      contour.pieces.push_back(arcs[1]);
      direction.push_back(d);
      direction.push_back(d);
      contour.joints.push_back({{joint, theta, 0.5 * (k->first + k->second)}, std::nullopt});
      if (!last) contour.joints.push_back({to, std::nullopt});
      from = to;
    }
  }
  contour.joints.push_back(spirals.joints.back());
  if (!contour.pieces.empty()) {
    if (const auto* arc = std::get_if<ArcPiece>(&contour.pieces.back())) {
      contour.joints.back().element.kappa = arc->kappa;
    }
  }
  contour.runs = collect_runs(direction);
  return contour;
}

}  // namespace obvid::pipeline_detail
