// SPDX-License-Identifier: Apache-2.0
#include "form.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "fit/parts.h"
#include "fit/series_ranges.h"
#include "obvid/contour/arcs.h"
#include "obvid/contour/spirals.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/region/internal/refine.h"

namespace obvid::pipeline_detail {
namespace {

/// Rounding of the coordinates may blur at most this part of a piece's change of curvature, and
/// this part of its curvature (a quarter of what is called continuous); where it blurs more, the
/// piece keeps its start as origin and its offsets their own digits.
constexpr double kLargestBlurOfChange = 1e-3;
constexpr double kLargestBlurOfChangeG3 = 1e-11;  // slopes feel it some ten times as much, and are
                                                  // as small as 1e-9 at vertices
constexpr double kLargestBlur = 2.5e-10;
constexpr std::size_t kFewPoints = 3;  // they lie on one circle, whatever curve was meant
/// Curvature error at an end per rounding of a control point, over the square of the end's leg.
constexpr double kCurvaturePerRounding = 8.0;

bool fits_global_coordinates(const RationalBezier& piece, double kappa_start, double kappa_end,
                             double largest_blur_of_change) {
  const Vec2 a = piece.origin + piece.offset[0], b = piece.origin + piece.offset[4];
  const double extent = std::max(std::abs(a.x) + std::abs(a.y), std::abs(b.x) + std::abs(b.y));
  const Vec2 first = piece.offset[1] - piece.offset[0], last = piece.offset[4] - piece.offset[3];
  const double leg2 = std::min(dot(first, first), dot(last, last));
  const double blur = kCurvaturePerRounding * 0x1p-53 * extent / leg2;
  const double kappa = std::max(std::abs(kappa_start), std::abs(kappa_end));
  return blur <= largest_blur_of_change * std::abs(kappa_end - kappa_start) &&
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
  e.theta = nearest_angle(e.theta, middle);
  return e;
}

bool wholly_circular(const std::vector<Vec2>& points, const Analysis& a) {
  return !a.stretches.empty() && a.stretches.front().first == 0 &&
         a.stretches.front().last + 1 == points.size();
}

bool anything_fixed(const ChainWishes& wishes) {
  return std::any_of(wishes.fixed.begin(), wishes.fixed.end(),
                     [](const FixedData& f) { return f.says_how(); });
}

/// Values, not ranges: one circle may lie inside these.
bool any_value_fixed(const ChainWishes& wishes) {
  return std::any_of(wishes.fixed.begin(), wishes.fixed.end(),
                     [](const FixedData& f) { return f.theta || f.kappa; });
}

/// The analysis with the directions of the curve that the points have when no heading and no
/// curvature is given. Nothing where they are those of the adjacent circles, or where a vertex lies
/// inside a chord.
std::optional<Analysis> turned_as_when_free(const std::vector<Vec2>& points,
                                            const Analysis& analysis, const ChainWishes& wishes,
                                            Watch& watch) {
  ChainWishes free = wishes;
  free.fixed.clear();
  const auto chain = choose_elements(points, analysis, free, watch);
  if (!chain || chain->turned_directions == 0 || chain->unforced_inflection) return std::nullopt;
  Analysis out = analysis;
  std::size_t chord = 0;
  for (std::size_t link = 0; link < chain->direction.size(); ++link) {
    const bool starts = chain->source[link].has_value();
    if (starts && link > 0) ++chord;
    if (!starts && out.direction[chord] != chain->direction[link]) return std::nullopt;
    out.direction[chord] = chain->direction[link];
  }
  return out;
}

/// How evenly the curvature changes over the link where it does least: 0 where it leaps at both
/// ends and rests between them.
double least_evenness(const SeriesChain& chain) {
  double least = 1.0;
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    const LinkState& link = chain.links[i];
    if (chain.cone[i] != Cone::kNone) least = std::min(least, link.sigma / (link.B - link.A));
  }
  return least;
}
/// As evenly as where nothing is given. Below this rounding may leave no proof.
constexpr double kEven = 1e-3;

/// The fairest elements; near the ends of what the points allow the search for them may miss the
/// ones that the ranges of headings and curvatures tell of.
Result<SeriesChain> chosen_elements(const std::vector<Vec2>& points, const Analysis& analysis,
                                    const ChainWishes& wishes, Watch& watch) {
  if (wishes.central) {
    if (auto central = central_chain(points, analysis, wishes, ChoiceOrder::kAlong, watch)) {
      return std::move(*central);
    }
    return error(ErrorCode::kFixedDataContradict,
                 "what is given leaves no headings and curvatures with which a monotone contour "
                 "exists")
        .hint("free some of it")
        .point(0);
  }
  auto chosen = choose_elements(points, analysis, wishes, watch);
  if (!wishes.to_the_edge || !anything_fixed(wishes)) return chosen;
  const bool as_circles = chosen && chosen->turned_directions == 0 && !chosen->unforced_inflection;
  if (as_circles && least_evenness(*chosen) >= kEven) return chosen;
  const bool asked_too_much = !chosen && chosen.error().code == ErrorCode::kFixedDataContradict;
  if (!chosen && !asked_too_much && chosen.error().code != ErrorCode::kNoSpiral) return chosen;
  const auto central = [&](const Analysis& directed) {
    return central_chain(points, directed, wishes, ChoiceOrder::kHalves, watch);
  };
  auto found = central(analysis);
  if (as_circles && (!found || least_evenness(*found) < least_evenness(*chosen))) return chosen;
  if (found) return std::move(*found);
  if (chosen) return chosen;
  if (const auto turned = turned_as_when_free(points, analysis, wishes, watch)) {
    if (auto other = central(*turned)) return std::move(*other);
  }
  return chosen;
}

/// Two points whose headings lie alike on both sides of their chord: the arc, or line, that has
/// them. Nothing for other headings, and where a curvature is given that is not its own.
std::optional<SeriesChain> arc_between(const std::vector<Vec2>& points, const Analysis& analysis,
                                       const ChainWishes& wishes) {
  constexpr double kArcHeading = 1e-12;    // rad: what typed degrees leave of their sum
  constexpr double kArcCurvature = 1e-12;  // of the arc's
  constexpr double kMostArcTurn = 2.5;     // rad, of one piece: below half a turn
  const FixedData &first = wishes.fixed.front(), &last = wishes.fixed.back();
  if (points.size() != 2 || !first.theta || !last.theta) return std::nullopt;
  const double omega = analysis.chords.front().omega, h = analysis.chords.front().length;
  const double alpha = nearest_angle(*first.theta, omega) - omega;
  const double beta = nearest_angle(*last.theta, omega) - omega;
  if (std::abs(alpha + beta) > kArcHeading) return std::nullopt;
  const double kappa = -2.0 * std::sin(alpha) / h;
  for (const FixedData* given : {&first, &last}) {
    const double off = given->kappa ? std::abs(*given->kappa - kappa) : 0.0;
    if (off > kArcCurvature * std::abs(kappa)) return std::nullopt;
  }
  const auto parts =
      static_cast<std::size_t>(std::max(std::ceil(2.0 * std::abs(alpha) / kMostArcTurn), 1.0));
  const double turn = -2.0 * alpha / static_cast<double>(parts);
  const double length = kappa == 0.0 ? h : 2.0 * std::abs(std::sin(0.5 * turn) / kappa);
  SeriesChain out;
  out.converged = true;
  out.smallest_margin = 1.0;
  out.elements = {{points[0], omega + alpha, kappa}};
  out.source = {std::size_t{0}};
  for (std::size_t k = 1; k <= parts; ++k) {
    const double before = out.elements.back().theta, chord = before + 0.5 * turn;
    const Vec2 start = out.elements.back().point;
    const bool last_one = k == parts;
    out.cone.push_back(Cone::kNone);
    out.direction.push_back(0);
    out.elements.push_back(
        {last_one ? points[1] : start + length * Vec2{std::cos(chord), std::sin(chord)},
         last_one ? omega - alpha : before + turn, kappa});
    out.source.push_back(last_one ? std::optional<std::size_t>(1) : std::nullopt);
    out.links.push_back({length, chord, -0.5 * turn, 0.5 * turn, 0.0, 0.0, 0.0});
  }
  return out;
}

/// Two or three points lie on one circle, but fixed data ask for another curve through them: it may
/// increase or decrease its curvature. Where it may do both, it turns one way if it can.
Result<SeriesChain> few_points_with_fixed_data(const std::vector<Vec2>& points, Analysis analysis,
                                               const ChainWishes& wishes, Watch& watch) {
  if (auto arc = arc_between(points, analysis, wishes)) return std::move(*arc);
  analysis.stretches.clear();
  std::optional<Result<SeriesChain>> first;
  for (const int direction : {1, -1}) {
    analysis.direction.assign(points.size() - 1, static_cast<std::int8_t>(direction));
    auto chain = chosen_elements(points, analysis, wishes, watch);
    if (chain && chain->turned_directions == 0 && !chain->unforced_inflection) return chain;
    const bool better = !first || (chain && !*first);
    if (better) first = std::move(chain);
  }
  return std::move(*first);
}

/// Whether the circle or line of a wholly circular series has what is given.
Result<void> has_wishes(const Analysis& analysis, const ChainWishes& wishes) {
  if (!anything_fixed(wishes)) return {};
  const auto problem = chain_problem(analysis, wishes);
  OBVID_TRY(problem);
  return {};
}

}  // namespace

Result<SeriesChain> form_elements(const std::vector<Vec2>& points, const Analysis& analysis,
                                  const ChainWishes& wishes, Watch& watch) {
  if (!wholly_circular(points, analysis)) return chosen_elements(points, analysis, wishes, watch);
  const auto has_them = has_wishes(analysis, wishes);
  if (has_them) return one_circle(points, analysis);
  if (points.size() > kFewPoints) return fail(has_them.error());
  // fewer may be asked for another curve, but not by ranges: what holds in them is found first
  if (!any_value_fixed(wishes)) return one_circle(points, analysis);
  return few_points_with_fixed_data(points, analysis, wishes, watch);
}

bool is_few_on_one_circle(const std::vector<Vec2>& points, const Analysis& analysis) {
  return points.size() <= kFewPoints && wholly_circular(points, analysis);
}

bool is_one_circle(const std::vector<Vec2>& points, const Analysis& analysis,
                   const ChainWishes& wishes) {
  return points.size() > kFewPoints && wholly_circular(points, analysis) &&
         has_wishes(analysis, wishes);
}

Result<Contour> form_spirals(const std::vector<Vec2>& points, const SeriesChain& chain) {
  Contour contour;
  contour.points = points;
  contour.continuity = chain.smooth ? Continuity::kG3 : Continuity::kG2;
  contour.pieces.reserve(chain.links.size());
  contour.joints.reserve(chain.elements.size());
  std::vector<int> direction;
  direction.reserve(chain.links.size());
  std::vector<RationalBezier> parts;
  const double blur = chain.smooth ? kLargestBlurOfChangeG3 : kLargestBlurOfChange;
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    const Element& a = chain.elements[i];
    const Element& b = chain.elements[i + 1];
    contour.joints.push_back({a, chain.source[i]});
    contour.joints.back().slope_step = chain.smooth && chain.slope_step[i];
    direction.push_back(chain.direction[i]);
    if (chain.cone[i] == Cone::kNone) {
      contour.pieces.push_back(arc_over_chord(chain.links[i], a, b));
      continue;
    }
    parts.clear();
    const SpiralForm form = chain.form.empty() ? SpiralForm::kOneSided : chain.form[i];
    if (!append_spiral(chain.links[i], chain.direction[i], form, a.point, b.point, parts)) {
      return error(ErrorCode::kInternal, "a link of the chain left its cone")
          .where("piece " + std::to_string(i))
          .hint("report this series")
          .point(i)
          .value(chain.links[i].sigma);
    }
    for (std::size_t j = 0; j < parts.size(); ++j) {
      if (j > 0) {  // a piece that turns far came out in parts
        contour.joints.push_back({element_between(parts[j], a.theta, b.theta), std::nullopt});
        direction.push_back(chain.direction[i]);
      }
      const bool global = fits_global_coordinates(parts[j], a.kappa, b.kappa, blur);
      const bool last = j + 1 == parts.size();
      const Vec2 to = last ? b.point : parts[j].origin + parts[j].offset[4];
      contour.pieces.emplace_back(global ? in_global_coordinates(parts[j], to) : parts[j]);
    }
  }
  contour.joints.push_back({chain.elements.back(), chain.source.back()});
  contour.runs = collect_runs(direction);
  return contour;
}

namespace {

/// Arcs in place of spirals, piece by piece.
class ArcBuilder {
 public:
  ArcBuilder(const Contour& spirals, double tolerance, const std::vector<GivenDatum>& given,
             bool loop)
      : spirals_(spirals), tolerance_(tolerance), loop_(loop) {
    start_given_ = curvature_given(spirals.joints.front(), given);
    end_given_ = curvature_given(spirals.joints.back(), given);
    contour_.units = spirals.units;
    contour_.carrier = Carrier::kArcs;
    contour_.points = spirals.points;
  }

  Result<Contour> run(Watch& watch) {
    const std::vector<int> directions = piece_directions(spirals_);
    for (std::size_t i = 0; i < spirals_.pieces.size(); ++i) {
      if (watch.cancelled()) return fail(cancelled_error());
      contour_.joints.push_back(spirals_.joints[i]);
      const auto* spiral = std::get_if<RationalBezier>(&spirals_.pieces[i]);
      if (spiral == nullptr) {
        contour_.pieces.push_back(spirals_.pieces[i]);
        direction_.push_back(0);
        continue;
      }
      OBVID_TRY(add(i, *spiral, directions[i]));
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
      return error(ErrorCode::kToleranceNotReached, "the tolerance asks for too many arcs")
          .where("piece " + std::to_string(i))
          .hint("choose a larger --tolerance")
          .point(i)
          .value(tolerance_);
    }
    Element from = spirals_.joints[i].element, last = spirals_.joints[i + 1].element;
    from.point = {0.0, 0.0};
    last.point = last.point - anchor;
    for (std::size_t j = 1; j < steps.size(); ++j) {
      Element to = j + 1 == steps.size() ? last : element_at(local, steps[j]);
      to.theta = nearest_angle(to.theta, from.theta);
      const bool begins = start_given_ && i == 0 && j == 1;
      const bool ends = end_given_ && i + 1 == spirals_.pieces.size() && j + 1 == steps.size();
      const auto k = choose_arcs(chord_frame(from, to), direction, begins, ends);
      if (!k) {
        return error(ErrorCode::kRoundingDecides,
                     "the rounding of the coordinates decides which arcs join two elements")
            .where("piece " + std::to_string(i))
            .hint("give coordinates relative to a nearer origin, or fewer points")
            .point(i)
            .value(norm(to.point - from.point));
      }
      if (!add_pair(from, to, *k, anchor, direction)) {
        return error(ErrorCode::kRoundingDecides,
                     "two elements of the contour are too close for arcs between them")
            .where("piece " + std::to_string(i))
            .hint("choose a larger --tolerance")
            .point(i)
            .value(norm(to.point - from.point));
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
      const double before = kappa_of(contour_.pieces[j > 0 ? j - 1 : (loop_ ? n - 1 : 0)]);
      const double after = kappa_of(contour_.pieces[j < n ? j : (loop_ ? 0 : n - 1)]);
      double& kappa = contour_.joints[j].element.kappa;
      kappa = std::clamp(kappa, std::min(before, after), std::max(before, after));
    }
  }

  const Contour& spirals_;
  double tolerance_;
  bool loop_;  // the end is the start
  bool start_given_ = false, end_given_ = false;
  Contour contour_;
  std::vector<int> direction_;
};

}  // namespace

Result<Contour> form_arcs(const Contour& spirals, double tolerance,
                          const std::vector<GivenDatum>& given, bool loop, Watch& watch) {
  return ArcBuilder(spirals, tolerance, given, loop).run(watch);
}

}  // namespace obvid::pipeline_detail
