// SPDX-License-Identifier: Apache-2.0
#include "form.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "obvid/contour/arcs.h"
#include "obvid/contour/spirals.h"
#include "obvid/region/refine.h"
#include "parts.h"

namespace obvid::pipeline_detail {
namespace {

/// Rounding of the coordinates may blur at most this part of a piece's change of curvature, and
/// this part of its curvature (a quarter of what is called continuous); where it blurs more, the
/// piece keeps its start as origin and its offsets their own digits.
constexpr double kLargestBlurOfChange = 1e-3;
constexpr double kLargestBlur = 2.5e-10;
/// Curvature error at an end per rounding of a control point, over the square of the end's leg.
constexpr double kCurvaturePerRounding = 8.0;

bool fits_global_coordinates(const RationalBezier& piece, double kappa_start, double kappa_end) {
  const Vec2 a = piece.origin + piece.offset[0], b = piece.origin + piece.offset[4];
  const double extent = std::max(std::abs(a.x) + std::abs(a.y), std::abs(b.x) + std::abs(b.y));
  const Vec2 first = piece.offset[1] - piece.offset[0], last = piece.offset[4] - piece.offset[3];
  const double leg2 = std::min(dot(first, first), dot(last, last));
  const double blur = kCurvaturePerRounding * 0x1p-53 * extent / leg2;
  const double kappa = std::max(std::abs(kappa_start), std::abs(kappa_end));
  return blur <= kLargestBlurOfChange * std::abs(kappa_end - kappa_start) &&
         blur <= kLargestBlur * kappa;
}

RationalBezier in_global_coordinates(RationalBezier piece, Vec2 end) {
  for (int j = 0; j <= piece.degree; ++j) {
    const auto k = static_cast<std::size_t>(j);
    piece.offset[k] = piece.origin + piece.offset[k];
  }
  piece.origin = {0.0, 0.0};
  piece.offset[static_cast<std::size_t>(piece.degree)] =
      end;  // neighbours share it to the last bit
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

}  // namespace

Piece arc_over_chord(const LinkState& link, const Element& a, const Element& b) {
  if (a.kappa == 0.0) return LinePiece{a.point, b.point};
  const double sine = std::clamp(0.5 * a.kappa * link.h, -1.0, 1.0);
  const bool beyond_half = std::abs(link.alpha) > 0.5 * std::numbers::pi;
  const double half_turn =
      beyond_half ? std::copysign(std::numbers::pi, sine) - std::asin(sine) : std::asin(sine);
  return ArcPiece{a.point, b.point, link.omega - half_turn, a.kappa, 2.0 * half_turn / a.kappa};
}

namespace {

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

/// Three points lie on one circle, but fixed data ask for another curve through them: it may
/// increase or decrease its curvature.
Result<SeriesChain> three_points_with_fixed_data(const std::vector<Vec2>& points, Analysis analysis,
                                                 const ChainWishes& wishes, Watch& watch) {
  analysis.stretches.clear();
  analysis.direction.assign(2, std::int8_t{1});
  auto increasing = choose_elements(points, analysis, wishes, watch);
  if (increasing) return increasing;
  analysis.direction.assign(2, std::int8_t{-1});
  auto decreasing = choose_elements(points, analysis, wishes, watch);
  return decreasing ? decreasing : increasing;
}

}  // namespace

Result<SeriesChain> form_elements(const std::vector<Vec2>& points, const Analysis& analysis,
                                  const ChainWishes& wishes, Watch& watch) {
  if (!wholly_circular(points, analysis)) return choose_elements(points, analysis, wishes, watch);
  if (anything_fixed(wishes) && points.size() == 3) {
    return three_points_with_fixed_data(points, analysis, wishes, watch);
  }
  if (anything_fixed(wishes)) {
    return fail(
        {ErrorCode::kFixedDataContradict,
         "the points lie on one circle or line, which leaves no heading or radius to choose", "",
         "drop the fixed data, or add points", 0, analysis.stretches.front().kappa});
  }
  return one_circle(points, analysis);
}

Result<Contour> form_spirals(const std::vector<Vec2>& points, const SeriesChain& chain) {
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
      const bool global = fits_global_coordinates(parts[j], a.kappa, b.kappa);
      const bool last = j + 1 == parts.size();
      const Vec2 to = last ? b.point : parts[j].origin + parts[j].offset[4];
      contour.pieces.emplace_back(global ? in_global_coordinates(parts[j], to) : parts[j]);
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

namespace {

/// Arcs in place of spirals, piece by piece.
class ArcBuilder {
 public:
  ArcBuilder(const Contour& spirals, double tolerance, const std::vector<GivenDatum>& given)
      : spirals_(spirals), tolerance_(tolerance) {
    start_given_ = curvature_given(spirals.joints.front(), given);
    end_given_ = curvature_given(spirals.joints.back(), given);
    contour_.units = spirals.units;
    contour_.carrier = Carrier::kArcs;
    contour_.points = spirals.points;
  }

  Result<Contour> run() {
    const std::vector<int> directions = piece_directions(spirals_);
    for (std::size_t i = 0; i < spirals_.pieces.size(); ++i) {
      contour_.joints.push_back(spirals_.joints[i]);
      const auto* spiral = std::get_if<RationalBezier>(&spirals_.pieces[i]);
      if (spiral == nullptr) {
        contour_.pieces.push_back(spirals_.pieces[i]);
        direction_.push_back(0);
        continue;
      }
      if (const auto added = add(i, *spiral, directions[i]); !added) {
        return tl::unexpected(added.error());
      }
    }
    contour_.joints.push_back(spirals_.joints.back());
    settle_joint_curvatures();
    contour_.runs = collect_runs(direction_);
    return std::move(contour_);
  }

 private:
  Result<void> add(std::size_t i, const RationalBezier& spiral, int direction) {
    const Vec2 anchor = spirals_.joints[i].element.point;
    // seen from its own start, so that arcs keep all digits of its shape
    const Piece local = moved(spiral, -anchor);
    const std::vector<double> steps = fewest_elements(local, direction, tolerance_);
    if (steps.back() < 1.0) {
      return fail({ErrorCode::kToleranceNotReached, "the tolerance asks for too many arcs",
                   "piece " + std::to_string(i), "choose a larger --tolerance",
                   static_cast<std::ptrdiff_t>(i), tolerance_});
    }
    Element from = spirals_.joints[i].element, last = spirals_.joints[i + 1].element;
    from.point = {0.0, 0.0};
    last.point = last.point - anchor;
    for (std::size_t j = 1; j < steps.size(); ++j) {
      Element to = j + 1 == steps.size() ? last : element_at(local, steps[j]);
      to.theta = from.theta + std::remainder(to.theta - from.theta, 2.0 * std::numbers::pi);
      const bool begins = start_given_ && i == 0 && j == 1;
      const bool ends = end_given_ && i + 1 == spirals_.pieces.size() && j + 1 == steps.size();
      const auto k = choose_arcs(chord_frame(from, to), direction, begins, ends);
      if (!k) {
        return fail({ErrorCode::kRoundingDecides,
                     "the rounding of the coordinates decides which arcs join two elements",
                     "piece " + std::to_string(i),
                     "give coordinates relative to a nearer origin, or fewer points",
                     static_cast<std::ptrdiff_t>(i), norm(to.point - from.point)});
      }
      if (!add_pair(from, to, *k, anchor, direction)) {
        return fail({ErrorCode::kRoundingDecides,
                     "two elements of the contour are too close for arcs between them",
                     "piece " + std::to_string(i), "choose a larger --tolerance",
                     static_cast<std::ptrdiff_t>(i), norm(to.point - from.point)});
      }
      if (j + 1 < steps.size()) {
        contour_.joints.push_back({{to.point + anchor, to.theta, to.kappa}, std::nullopt});
      }
      from = to;
    }
    return {};
  }

  static bool curvature_given(const Joint& end, const std::vector<GivenDatum>& given) {
    return std::any_of(given.begin(), given.end(), [&](const GivenDatum& one) {
      return end.source == one.point && one.kappa.has_value();
    });
  }

  /// The arc at an end where a curvature was given takes it over: the boundary of the region, by
  /// which a curvature is still monotone.
  static std::optional<BiarcCurvatures> choose_arcs(const ChordFrame& frame, int direction,
                                                    bool begins, bool ends) {
    if (begins)
      return BiarcCurvatures{frame.kappa_start, second_curvature(frame, frame.kappa_start)};
    if (!ends) return choose_biarc(frame, direction);
    // the same from the other end: mirrored in the bisector of the chord, curvatures change places
    const ChordFrame reversed{frame.h,
                              {frame.end_tangent.x, -frame.end_tangent.y},
                              {frame.start_tangent.x, -frame.start_tangent.y},
                              frame.kappa_end,
                              frame.kappa_start};
    return BiarcCurvatures{second_curvature(reversed, frame.kappa_end), frame.kappa_end};
  }

  /// False when an arc would run backwards.
  bool add_pair(const Element& from, const Element& to, const BiarcCurvatures& k, Vec2 anchor,
                int direction) {
    const auto arcs = biarc(from, to, k);
    const auto* first = std::get_if<ArcPiece>(&arcs[0]);
    const auto* second = std::get_if<ArcPiece>(&arcs[1]);
    if ((first != nullptr && !(first->length > 0.0)) ||
        (second != nullptr && !(second->length > 0.0))) {
      return false;
    }
    const double theta = second != nullptr ? second->theta0 : to.theta;
    contour_.pieces.push_back(moved(arcs[0], anchor));
    contour_.pieces.push_back(moved(arcs[1], anchor));
    direction_.insert(direction_.end(), 2, direction);
    contour_.joints.push_back(
        {{end_point(arcs[0]) + anchor, theta, 0.5 * (k.first + k.second)}, std::nullopt});
    return true;
  }

  /// The curvature at a joint lies between those of its arcs; an end has one arc only. A vertex of
  /// the spirals is sharper than both its arcs.
  void settle_joint_curvatures() {
    const auto kappa_of = [](const Piece& piece) {
      const auto* arc = std::get_if<ArcPiece>(&piece);
      return arc != nullptr ? arc->kappa : 0.0;
    };
    const std::size_t n = contour_.pieces.size();
    for (std::size_t j = 0; j <= n; ++j) {
      const double before = kappa_of(contour_.pieces[j > 0 ? j - 1 : 0]);
      const double after = kappa_of(contour_.pieces[j < n ? j : n - 1]);
      double& kappa = contour_.joints[j].element.kappa;
      kappa = std::clamp(kappa, std::min(before, after), std::max(before, after));
    }
  }

  const Contour& spirals_;
  double tolerance_;
  bool start_given_ = false, end_given_ = false;
  Contour contour_;
  std::vector<int> direction_;
};

}  // namespace

Result<Contour> form_arcs(const Contour& spirals, double tolerance,
                          const std::vector<GivenDatum>& given) {
  return ArcBuilder(spirals, tolerance, given).run();
}

}  // namespace obvid::pipeline_detail
