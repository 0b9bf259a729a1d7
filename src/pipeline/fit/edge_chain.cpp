// SPDX-License-Identifier: Apache-2.0
#include "fit/edge_chain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fit/form.h"
#include "fit/keep_joints.h"
#include "obvid/certify/certify.h"
#include "obvid/contour/spirals.h"
#include "obvid/contour/spirals/over_chain.h"
#include "obvid/curve/internal/end_curvatures.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/value_range.h"
#include "obvid/region/internal/feasible_data.h"

namespace obvid::pipeline_detail {
namespace {

bool goes_way(const Piece& piece, int direction) {
  const Verdict verdict = prove_piece(piece).verdict;
  return verdict == (direction > 0   ? Verdict::kIncreasing
                     : direction < 0 ? Verdict::kDecreasing
                                     : Verdict::kConstant);
}

/// Points with the directions of their links; a node without a source carries a vertex between two
/// points.
struct Directed {
  std::vector<Vec2> points;
  std::vector<std::optional<std::size_t>> source;
  std::vector<int> direction;
  std::vector<NodeData> own;  ///< of arcs and lines, and signs of curvatures

  [[nodiscard]] std::size_t count() const { return points.size(); }
};

/// Of the range of an end that is open on one side, where the middle of the whole leaps.
constexpr std::array<double, 5> kPartsOfOpenEnds{1.0, 1e-2, 1e-4, 1e-7, 1e-10};
/// Forms in the order in which they are tried on a link.
constexpr std::array<SpiralForm, 2> kForms{SpiralForm::kEven, SpiralForm::kOneSided};

class EdgeChain {
 public:
  EdgeChain(const ChainConstraints& constraints, Directed series, Watch& watch)
      : constraints_(constraints),
        series_(std::move(series)),
        chords_(measure_chords(series_.points)),
        watch_(watch) {}

  /// Whether headings and curvatures are left with which every link has a spiral.
  [[nodiscard]] bool has_data() const {
    return central_data(links(), nodes(), {}, ChoiceOrder::kAlong, SharpCurvature::kCalm, &watch_)
        .has_value();
  }

  /// The first choice of data whose spirals are proved.
  std::optional<SeriesChain> run() const {
    const std::vector<RangeLink> along = links();
    const std::vector<RangeNode> given = nodes();
    for (const double part : kPartsOfOpenEnds) {
      const auto calmer = part < 1.0 ? with_calm_ends(along, given, part) : given;
      if (part < 1.0 && calmer.empty()) return std::nullopt;
      for (const ChoiceOrder order : {ChoiceOrder::kHalves, ChoiceOrder::kAlong}) {
        const auto data = central_data(along, calmer, {}, order, SharpCurvature::kCalm, &watch_);
        if (!data) return std::nullopt;
        for (const Leaps leaps : {Leaps::kInOne, Leaps::kInTwo}) {
          auto chain = carried_by(*data, leaps);
          if (chain && proved_as_stored(series_.points, *chain)) return chain;
        }
      }
    }
    return std::nullopt;
  }

 private:
  /// Spirals over a link whose curvature leaps at one end and rests else: doubles hold one only as
  /// far as they tell that end from its neighbourhood.
  enum class Leaps { kInOne, kInTwo };
  static bool leaps_over(const SeriesChain& chain, std::size_t i) {
    constexpr double kWithoutLeap = 1e-4;  ///< sigma of B - A; of a clothoid a half
    const LinkState& link = chain.links[i];
    return chain.cone[i] != Cone::kNone &&
           std::abs(link.sigma) < kWithoutLeap * std::abs(link.B - link.A);
  }

  /// The first and the last heading may turn away by a right angle, the middle of what is left to
  /// them by half of that: where the points bend by next to nothing that is a leap. Headings in a
  /// part of that range beside its other end; empty where neither is free.
  [[nodiscard]] std::vector<RangeNode> with_calm_ends(const std::vector<RangeLink>& links,
                                                      std::vector<RangeNode> nodes,
                                                      double part) const {
    const std::vector<FeasibleData> ranges = feasible_data(links, nodes, &watch_);
    bool any = false;
    for (const std::size_t i : {std::size_t{0}, nodes.size() - 1}) {
      const auto& range = ranges[i].heading;
      const bool free = range && !nodes[i].theta && !nodes[i].thetas;
      if (!free || range->low_is_open == range->high_is_open) continue;
      const double reach = part * (range->high - range->low);
      nodes[i].thetas = range->low_is_open ? ValueRange{range->high - reach, range->high}
                                           : ValueRange{range->low, range->low + reach};
      any = true;
    }
    return any ? nodes : std::vector<RangeNode>{};
  }

  [[nodiscard]] std::vector<RangeLink> links() const {
    std::vector<RangeLink> out;
    for (std::size_t i = 0; i < chords_.size(); ++i) {
      out.push_back({chords_[i].length, chords_[i].omega, series_.direction[i]});
    }
    return out;
  }

  /// Between the headings of both chords.
  [[nodiscard]] double along(std::size_t i) const {
    const double before = chords_[i > 0 ? i - 1 : 0].omega;
    return 0.5 * (before + chords_[std::min(i, chords_.size() - 1)].omega);
  }

  [[nodiscard]] std::vector<RangeNode> nodes() const {
    std::vector<RangeNode> out;
    for (std::size_t i = 0; i < series_.count(); ++i) {
      RangeNode node{series_.own[i].theta, series_.own[i].kappa, series_.own[i].curvature_sign};
      if (const auto source = series_.source[i]; source && *source < constraints_.fixed.size()) {
        const FixedData& given = constraints_.fixed[*source];
        if (!node.theta) node.theta = given.theta;
        if (!node.kappa) node.kappa = given.kappa;
        node.thetas = given.thetas;
        node.kappas = given.kappas;
      }
      if (node.theta) node.theta = nearest_angle(*node.theta, along(i));
      if (node.thetas) node.thetas = turned_near(*node.thetas, along(i));
      out.push_back(node);
    }
    return out;
  }

  [[nodiscard]] std::optional<SeriesChain> carried_by(const std::vector<RangeNode>& data,
                                                      Leaps leaps) const {
    std::vector<Element> elements;
    for (std::size_t i = 0; i < series_.count(); ++i) {
      if (!data[i].theta || !data[i].kappa) return std::nullopt;
      elements.push_back({series_.points[i], *data[i].theta, *data[i].kappa});
    }
    std::vector<NodeData> nodes = series_.own;
    for (std::size_t i = 0; i < series_.count(); ++i) {
      nodes[i].theta = nodes_theta(i, data);
      nodes[i].kappa = nodes_kappa(i, data);
    }
    auto whole = judged({elements, series_.source, series_.direction, nodes});
    if (!whole) return std::nullopt;
    Links all{std::move(elements), series_.source, series_.direction, std::move(nodes)};
    std::size_t added = 0;
    for (std::size_t i = 0; i < whole->links.size(); ++i) {
      if (proved_form(*whole, i) && !(leaps == Leaps::kInTwo && leaps_over(*whole, i))) continue;
      const auto at = static_cast<std::ptrdiff_t>(i + 1 + added++);
      all.elements.insert(
          all.elements.begin() + at,
          element_beyond_leap(whole->links[i], whole->direction[i], whole->elements[i].point));
      all.source.insert(all.source.begin() + at, std::nullopt);
      all.direction.insert(all.direction.begin() + at, whole->direction[i]);
      all.nodes.insert(all.nodes.begin() + at, NodeData{});
    }
    if (added > 0) whole = judged(all);
    if (!whole) return std::nullopt;
    for (std::size_t i = 0; i < whole->links.size(); ++i) {
      const auto form = proved_form(*whole, i);
      if (!form) return std::nullopt;
      whole->form.push_back(*form);
    }
    return whole;
  }

  /// Elements with what lies between them and what was given at them.
  struct Links {
    std::vector<Element> elements;
    std::vector<std::optional<std::size_t>> source;
    std::vector<int> direction;
    std::vector<NodeData> nodes;
  };

  /// The chain of these elements, its forms left open. Nothing where a link has no spiral.
  static std::optional<SeriesChain> judged(const Links& all) {
    std::vector<Vec2> points;
    for (const Element& element : all.elements) points.push_back(element.point);
    ChainProblem problem;
    problem.chords = measure_chords(points);
    problem.circles = measure_circles(points, problem.chords);
    problem.nodes = all.nodes;
    for (const int direction : all.direction) {
      problem.direction.push_back(static_cast<std::int8_t>(direction));
      problem.cone.push_back(direction == 0 ? Cone::kNone : Cone::kSpiral);
    }
    ChainSolution solution = judge_chain(points, problem, all.elements);
    if (!solution.feasible) return std::nullopt;
    SeriesChain out;
    out.elements = std::move(solution.elements);
    out.links = std::move(solution.links);
    out.source = all.source;
    out.direction = problem.direction;
    out.cone = problem.cone;
    out.nodes = problem.nodes;
    out.smallest_margin = solution.smallest_margin;
    out.converged = true;
    for (const auto& source : out.source) out.free_elements += source ? 0U : 1U;
    return out;
  }

  /// What was given, for those who choose again.
  [[nodiscard]] std::optional<double> nodes_theta(std::size_t i,
                                                  const std::vector<RangeNode>& data) const {
    const auto source = series_.source[i];
    const bool given =
        source && *source < constraints_.fixed.size() && constraints_.fixed[*source].theta;
    return given || series_.own[i].theta ? data[i].theta : std::nullopt;
  }
  [[nodiscard]] std::optional<double> nodes_kappa(std::size_t i,
                                                  const std::vector<RangeNode>& data) const {
    const auto source = series_.source[i];
    const bool given =
        source && *source < constraints_.fixed.size() && constraints_.fixed[*source].kappa;
    return given || series_.own[i].kappa ? data[i].kappa : std::nullopt;
  }

  static std::optional<SpiralForm> proved_form(const SeriesChain& chain, std::size_t i) {
    if (chain.cone[i] == Cone::kNone) return SpiralForm::kOneSided;
    for (const SpiralForm form : kForms) {
      std::vector<RationalBezier> parts;
      const bool made = append_spiral(chain.links[i], chain.direction[i], form,
                                      chain.elements[i].point, chain.elements[i + 1].point, parts);
      const bool proved =
          made && std::all_of(parts.begin(), parts.end(), [&](const RationalBezier& part) {
            return goes_way(Piece{part}, chain.direction[i]);
          });
      if (proved) return form;
    }
    return std::nullopt;
  }

  const ChainConstraints& constraints_;
  Directed series_;
  std::vector<Chord> chords_;
  Watch& watch_;
};

/// The points with the directions of their adjacent circles.
std::optional<Directed> as_circles(const std::vector<Vec2>& points, const Analysis& analysis,
                                   const ChainConstraints& constraints) {
  const auto problem = chain_problem(analysis, constraints);
  if (!problem) return std::nullopt;
  Directed out;
  out.points = points;
  for (std::size_t i = 0; i < points.size(); ++i) out.source.emplace_back(i);
  out.direction.assign(analysis.direction.begin(), analysis.direction.end());
  out.own = problem->nodes;
  return out;
}

/// Two or three points say neither how the curvature changes nor how the curve bends: both ways,
/// without an inflection first.
std::vector<Directed> both_ways(const std::vector<Vec2>& points, Analysis analysis,
                                const ChainConstraints& constraints) {
  analysis.stretches.clear();
  std::vector<Directed> out, bent;
  for (const std::int8_t direction : {std::int8_t{1}, std::int8_t{-1}}) {
    analysis.direction.assign(points.size() - 1, direction);
    auto series = as_circles(points, analysis, constraints);
    if (!series) continue;
    out.push_back(*series);
    for (NodeData& node : series->own) node.curvature_sign = 0;
    if (!constraints.convex) bent.push_back(std::move(*series));
  }
  out.insert(out.end(), bent.begin(), bent.end());
  return out;
}

/// Points and vertices of a chain. The curvature keeps its sign between vertices at whose ends the
/// chain has one sign.
Directed as_chain(const SeriesChain& chain) {
  Directed out;
  std::vector<double> kappa;
  for (std::size_t e = 0; e < chain.elements.size(); ++e) {
    const bool ends = e == 0 || e + 1 == chain.elements.size();
    const bool turns = !ends && chain.direction[e - 1] != chain.direction[e];
    if (!chain.source[e] && !turns) continue;
    out.points.push_back(chain.elements[e].point);
    out.source.push_back(chain.source[e]);
    out.own.emplace_back();
    kappa.push_back(chain.elements[e].kappa);
    const bool arc = (e > 0 && chain.cone[e - 1] == Cone::kNone) ||
                     (e < chain.cone.size() && chain.cone[e] == Cone::kNone);
    if (arc) {
      out.own.back().theta = chain.elements[e].theta;
      out.own.back().kappa = chain.elements[e].kappa;
    }
    if (e < chain.direction.size()) {
      out.direction.push_back(chain.cone[e] == Cone::kNone ? 0 : chain.direction[e]);
    }
  }
  for (std::size_t i = 0; i < out.direction.size();) {
    std::size_t last = i + 1;
    while (last < out.direction.size() && out.direction[last] == out.direction[i]) ++last;
    for (std::size_t k = i; k <= last && kappa[i] * kappa[last] > 0.0; ++k) {
      out.own[k].curvature_sign = kappa[i] > 0.0 ? 1 : -1;
    }
    i = last;
  }
  return out;
}

/// Arcs have their own headings and curvatures: where they go through a point at which others are
/// given, there is no such chain.
bool keeps_what_is_given(const SeriesChain& chain, const ChainConstraints& constraints) {
  constexpr double kSame = 1e-9;  ///< rad, and of a curvature
  if (constraints.fixed.empty()) return true;
  for (std::size_t e = 0; e < chain.elements.size(); ++e) {
    if (!chain.source[e]) continue;
    const FixedData& given = constraints.fixed[*chain.source[e]];
    const Element& at = chain.elements[e];
    if (given.theta && std::abs(turn_between(*given.theta, at.theta)) > kSame) {
      return false;
    }
    if (given.kappa && std::abs(at.kappa - *given.kappa) >
                           kSame * std::max(std::abs(at.kappa), std::abs(*given.kappa))) {
      return false;
    }
  }
  return true;
}

/// With data that ask for an inflection where the adjacent circles show none.
std::optional<SeriesChain> bent_as_needed(const Directed& series,
                                          const ChainConstraints& constraints, Watch& watch) {
  if (EdgeChain(constraints, series, watch).has_data()) return std::nullopt;
  Directed bent = series;
  for (NodeData& node : bent.own) node.curvature_sign = 0;
  auto chain = EdgeChain(constraints, std::move(bent), watch).run();
  if (!chain || !keeps_what_is_given(*chain, constraints)) return std::nullopt;
  for (std::size_t e = 0; e < chain->elements.size(); ++e) {
    const auto source = chain->source[e];
    if (!source) continue;
    const double shown = series.own[*source].curvature_sign;
    chain->unforced_inflection =
        chain->unforced_inflection || shown * chain->elements[e].kappa < 0.0;
  }
  return chain;
}

}  // namespace

ChainTurns turns_of_chain(const SeriesChain& chain) {
  ChainTurns out;
  int way = 0, bend = 0;
  for (std::size_t i = 0; i < chain.elements.size(); ++i) {
    const int sign = chain.elements[i].kappa > 0.0 ? 1 : chain.elements[i].kappa < 0.0 ? -1 : 0;
    if (sign != 0) out.inflections += std::exchange(bend, sign) == -sign ? 1 : 0;
    if (i >= chain.direction.size() || chain.cone[i] == Cone::kNone) continue;
    const int now = chain.direction[i];
    out.vertices += std::exchange(way, now) == -now ? 1 : 0;
  }
  return out;
}

namespace {

Result<Contour> as_stored(const std::vector<Vec2>& points, const SeriesChain& chain) {
  auto contour = spirals_over(points, chain);
  OBVID_TRY(contour);
  keep_joint_curvatures(*contour);
  take_piece_ends(*contour);
  return contour;
}

/// From a joint on, one way: the first end of a line or arc, and how many joints away it is.
/// Nothing where another point comes first.
struct EndBeside {
  std::size_t source = 0, away = 0;
};
std::optional<EndBeside> end_beside(const Contour& contour, std::size_t joint, bool forward) {
  const auto is_flat = [&](std::size_t piece) {
    return std::holds_alternative<LinePiece>(contour.pieces[piece]) ||
           std::holds_alternative<ArcPiece>(contour.pieces[piece]);
  };
  for (std::size_t away = 0, j = joint; j < contour.joints.size(); ++away) {
    if (const auto source = contour.joints[j].source) {
      const bool ends = (j > 0 && is_flat(j - 1)) || (j < contour.pieces.size() && is_flat(j));
      if (ends) return EndBeside{*source, away};
      if (away > 0) return std::nullopt;
    }
    if (!forward && j == 0) return std::nullopt;
    j = forward ? j + 1 : j - 1;
  }
  return std::nullopt;
}

}  // namespace

bool proved_as_stored(const std::vector<Vec2>& points, const SeriesChain& chain) {
  const auto contour = as_stored(points, chain);
  return contour && certify(*contour).proved;
}

std::optional<std::size_t> unproved_joint(const Certificate& certificate) {
  if (certificate.loose_joint) return certificate.loose_joint;
  for (std::size_t i = 0; i < certificate.pieces.size(); ++i) {
    const PieceProof& proof = certificate.pieces[i];
    const bool monotone =
        proof.verdict != Verdict::kHasVertex && proof.verdict != Verdict::kUndecided;
    if (!monotone || !proof.turns_below_half) return i;
  }
  return std::nullopt;
}

std::optional<std::size_t> primitive_end_unproved(const std::vector<Vec2>& points,
                                                  const SeriesChain& chain) {
  const auto contour = as_stored(points, chain);
  if (!contour) return std::nullopt;
  const auto joint = unproved_joint(certify(*contour));
  if (!joint) return std::nullopt;
  const auto before = end_beside(*contour, *joint, false);
  const auto after = end_beside(*contour, *joint, true);
  if (!before && !after) return std::nullopt;
  return before && (!after || before->away < after->away) ? before->source : after->source;
}

std::optional<SeriesChain> edge_chain(const std::vector<Vec2>& points, const Analysis& analysis,
                                      const ChainConstraints& constraints, const SeriesChain* free,
                                      Watch& watch) {
  std::vector<Directed> ways;
  if (is_few_on_one_circle(points, analysis)) {
    ways = both_ways(points, analysis, constraints);
  } else if (auto series = as_circles(points, analysis, constraints)) {
    ways.push_back(std::move(*series));
  }
  for (const Directed& series : ways) {
    auto chain = EdgeChain(constraints, series, watch).run();
    if (chain && keeps_what_is_given(*chain, constraints)) return chain;
  }
  if (free != nullptr) {
    auto chain = EdgeChain(constraints, as_chain(*free), watch).run();
    if (chain && keeps_what_is_given(*chain, constraints)) {
      chain->turned_directions = free->turned_directions;
      chain->unforced_inflection = free->unforced_inflection;
      return chain;
    }
  }
  return constraints.convex || ways.size() != 1 ? std::nullopt
                                                : bent_as_needed(ways.front(), constraints, watch);
}

}  // namespace obvid::pipeline_detail
