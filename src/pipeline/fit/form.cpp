// SPDX-License-Identifier: Apache-2.0
#include "fit/form.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "fit/parts.h"
#include "fit/series_ranges.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/region/internal/refine.h"

namespace obvid::pipeline_detail {
namespace {

constexpr std::size_t kFewPoints = 3;  // they lie on one circle, whatever curve was meant

constexpr double kMostArcTurn = 2.5;  // rad, of each of several pieces
constexpr double kOneArcTurn =
    3.0;  // rad, of a piece alone: what turns by half a turn has no proof

/// The link from the last element of a chain to the next point, along an arc or a line; in parts
/// where it turns by half a turn or nearly so. `alpha` is the heading before the chord, from it.
void add_arc(SeriesChain& chain, Vec2 to, std::size_t source, const Chord& chord, double alpha,
             double theta) {
  const bool whole = 2.0 * std::abs(alpha) <= kOneArcTurn;
  const auto parts =
      whole ? std::size_t{1}
            : static_cast<std::size_t>(std::ceil(2.0 * std::abs(alpha) / kMostArcTurn));
  const double kappa = chain.elements.back().kappa;
  const double turn = -2.0 * alpha / static_cast<double>(parts);
  const double length = whole ? chord.length : 2.0 * std::abs(std::sin(0.5 * turn) / kappa);
  for (std::size_t k = 1; k <= parts; ++k) {
    const double before = chain.elements.back().theta;
    const double omega = whole ? chord.omega : before + 0.5 * turn;
    const Vec2 start = chain.elements.back().point;
    const bool last = k == parts;
    chain.cone.push_back(Cone::kNone);
    chain.direction.push_back(0);
    chain.elements.push_back({last ? to : start + length * Vec2{std::cos(omega), std::sin(omega)},
                              last ? theta : before + turn, kappa});
    chain.source.push_back(last ? std::optional<std::size_t>(source) : std::nullopt);
    if (whole) {
      chain.links.push_back({length, omega, before - omega, theta - omega, 0.0, 0.0, 0.0});
    } else {
      chain.links.push_back({length, omega, -0.5 * turn, 0.5 * turn, 0.0, 0.0, 0.0});
    }
  }
}

/// One line or arc through all points, a piece for each chord, or more where it is a half circle or
/// more.
SeriesChain one_circle(const std::vector<Vec2>& points, const Analysis& a) {
  SeriesChain out;
  const std::size_t n = points.size();
  const double kappa = a.stretches.front().kappa;
  out.converged = true;
  out.smallest_margin = 1.0;
  const auto theta_at = [&](std::size_t i) {
    const bool last = i + 1 == n;
    const double angle = kappa == 0.0 ? 0.0 : last ? a.circles[i].eta_in : -a.circles[i].eta_out;
    return a.chords[last ? i - 1 : i].omega + angle;
  };
  out.elements.push_back({points[0], theta_at(0), kappa});
  out.source.emplace_back(0);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Chord& chord = a.chords[i];
    add_arc(out, points[i + 1], i + 1, chord, out.elements.back().theta - chord.omega,
            theta_at(i + 1));
  }
  return out;
}

bool wholly_circular(const std::vector<Vec2>& points, const Analysis& a) {
  return !a.stretches.empty() && a.stretches.front().first == 0 &&
         a.stretches.front().last + 1 == points.size();
}

bool anything_fixed(const ChainConstraints& constraints) {
  return std::any_of(constraints.fixed.begin(), constraints.fixed.end(),
                     [](const FixedData& f) { return f.says_how(); });
}

/// Values, not ranges: one circle may lie inside these.
bool any_value_fixed(const ChainConstraints& constraints) {
  return std::any_of(constraints.fixed.begin(), constraints.fixed.end(),
                     [](const FixedData& f) { return f.theta || f.kappa; });
}

/// The analysis with the directions of the curve that the points have when no heading and no
/// curvature is given. Nothing where they are those of the adjacent circles, or where a vertex lies
/// inside a chord.
std::optional<Analysis> turned_as_when_free(const std::vector<Vec2>& points,
                                            const Analysis& analysis,
                                            const ChainConstraints& constraints, Watch& watch) {
  ChainConstraints free = constraints;
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
                                    const ChainConstraints& constraints, Watch& watch) {
  if (constraints.central) {
    if (auto central = central_chain(points, analysis, constraints, ChoiceOrder::kAlong, watch)) {
      return std::move(*central);
    }
    return error(ErrorCode::kFixedDataContradict,
                 "what is given leaves no headings and curvatures with which a monotone contour "
                 "exists")
        .hint("free some of it")
        .point(0);
  }
  auto chosen = choose_elements(points, analysis, constraints, watch);
  if (!constraints.to_the_edge || !anything_fixed(constraints)) return chosen;
  const bool as_circles = chosen && chosen->turned_directions == 0 && !chosen->unforced_inflection;
  if (as_circles && least_evenness(*chosen) >= kEven) return chosen;
  const bool asked_too_much = !chosen && chosen.error().code == ErrorCode::kFixedDataContradict;
  if (!chosen && !asked_too_much && chosen.error().code != ErrorCode::kNoSpiral) return chosen;
  const auto central = [&](const Analysis& directed) {
    return central_chain(points, directed, constraints, ChoiceOrder::kHalves, watch);
  };
  auto found = central(analysis);
  if (as_circles && (!found || least_evenness(*found) < least_evenness(*chosen))) return chosen;
  if (found) return std::move(*found);
  if (chosen) return chosen;
  if (const auto turned = turned_as_when_free(points, analysis, constraints, watch)) {
    if (auto other = central(*turned)) return std::move(*other);
  }
  return chosen;
}

/// Two points whose headings lie alike on both sides of their chord: the arc, or line, that has
/// them. Nothing for other headings, and where a curvature is given that is not its own.
std::optional<SeriesChain> arc_between(const std::vector<Vec2>& points, const Analysis& analysis,
                                       const ChainConstraints& constraints) {
  constexpr double kArcHeading = 1e-12;    // rad: what typed degrees leave of their sum
  constexpr double kArcCurvature = 1e-12;  // of the arc's
  const FixedData &first = constraints.fixed.front(), &last = constraints.fixed.back();
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
  SeriesChain out;
  out.converged = true;
  out.smallest_margin = 1.0;
  out.elements = {{points[0], omega + alpha, kappa}};
  out.source = {std::size_t{0}};
  add_arc(out, points[1], 1, analysis.chords.front(), alpha, omega - alpha);
  return out;
}

/// Two or three points lie on one circle, but fixed data ask for another curve through them: it may
/// increase or decrease its curvature. Where it may do both, it turns one way if it can.
Result<SeriesChain> few_points_with_fixed_data(const std::vector<Vec2>& points, Analysis analysis,
                                               const ChainConstraints& constraints, Watch& watch) {
  if (auto arc = arc_between(points, analysis, constraints)) return std::move(*arc);
  analysis.stretches.clear();
  std::optional<Result<SeriesChain>> first;
  for (const int direction : {1, -1}) {
    analysis.direction.assign(points.size() - 1, static_cast<std::int8_t>(direction));
    auto chain = chosen_elements(points, analysis, constraints, watch);
    if (chain && chain->turned_directions == 0 && !chain->unforced_inflection) return chain;
    const bool better = !first || (chain && !*first);
    if (better) first = std::move(chain);
  }
  return std::move(*first);
}

/// Whether the circle or line of a wholly circular series has what is given.
Result<void> keeps_constraints(const Analysis& analysis, const ChainConstraints& constraints) {
  if (!anything_fixed(constraints)) return {};
  const auto problem = chain_problem(analysis, constraints);
  OBVID_TRY(problem);
  return {};
}

}  // namespace

Result<SeriesChain> form_elements(const std::vector<Vec2>& points, const Analysis& analysis,
                                  const ChainConstraints& constraints, Watch& watch) {
  if (!wholly_circular(points, analysis))
    return chosen_elements(points, analysis, constraints, watch);
  const auto has_them = keeps_constraints(analysis, constraints);
  if (has_them) return one_circle(points, analysis);
  if (points.size() > kFewPoints) return fail(has_them.error());
  // fewer may be asked for another curve, but not by ranges: what holds in them is found first
  if (!any_value_fixed(constraints)) return one_circle(points, analysis);
  return few_points_with_fixed_data(points, analysis, constraints, watch);
}

bool is_few_on_one_circle(const std::vector<Vec2>& points, const Analysis& analysis) {
  return points.size() <= kFewPoints && wholly_circular(points, analysis);
}

bool is_one_circle(const std::vector<Vec2>& points, const Analysis& analysis,
                   const ChainConstraints& constraints) {
  return points.size() > kFewPoints && wholly_circular(points, analysis) &&
         keeps_constraints(analysis, constraints);
}

}  // namespace obvid::pipeline_detail
