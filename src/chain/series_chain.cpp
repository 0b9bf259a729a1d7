// SPDX-License-Identifier: Apache-2.0
#include "obvid/chain/series_chain.h"

#include <fmt/format.h>
#include <algorithm>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace obvid {
namespace {

/// A link whose closed-form margin is below this gets a free element: two pieces carry it with
/// room to spare instead of one at its limit.
constexpr double kThinMargin = 0.02;
/// Rounds of inserting free elements; each starts inside all cones, so one normally suffices.
constexpr int kInsertionRounds = 4;
/// Infeasible by less than this many roundings of the coordinates: the rounding decides.
constexpr double kRoundingsThatDecide = 64.0;

double heading_on_stretch(const Analysis& a, const CircularStretch& s, std::size_t i) {
  // next to the stretch's ends the adjacent circle is another one: go by the chord inside
  if (i < s.last) {
    const std::size_t inner = i == s.first ? i + 1 : i;
    const double angle = i == s.first ? a.circles[inner].eta_in : a.circles[inner].eta_out;
    return a.chords[i].omega - (s.kappa == 0.0 ? 0.0 : angle);
  }
  return a.chords[i - 1].omega + (s.kappa == 0.0 ? 0.0 : a.circles[i - 1].eta_out);
}

/// Sign that the curvature must keep at a point: that of its circle, unless the series changes
/// sign right beside it.
int forced_sign(const Analysis& a, std::size_t i) {
  const auto sign = [&a](std::size_t j) {
    const AdjacentCircle& c = a.circles[j];
    return std::abs(c.kappa) <= c.rounding ? 0 : c.kappa > 0.0 ? 1 : -1;
  };
  const int own = sign(i);
  const int before = i > 0 ? sign(i - 1) : own,
            after = i + 1 < a.circles.size() ? sign(i + 1) : own;
  return before == -own || after == -own ? 0 : own;
}

/// Whether data fixed at a point of a stretch are others than the stretch's own.
bool contradicts(const NodeData& node, double theta, double kappa, double rounding) {
  constexpr double kSameHeading = 1e-9;    // rad: far below what a user can give
  constexpr double kSameCurvature = 1e-6;  // of the stretch's curvature
  const bool turned = node.theta && std::abs(std::remainder(*node.theta - theta,
                                                            2.0 * std::numbers::pi)) > kSameHeading;
  const bool bent = node.kappa && std::abs(*node.kappa - kappa) >
                                      std::max(kSameCurvature * std::abs(kappa), rounding);
  return turned || bent;
}

Result<ChainProblem> set_up(const Analysis& a, const ChainWishes& wishes) {
  ChainProblem p{a.chords, a.circles, a.direction, {}, std::vector<NodeData>(a.circles.size())};
  for (const std::int8_t d : a.direction)
    p.cone.push_back(d == 0 ? Cone::kNone : Cone::kClosedForm);
  int turns = 0;
  for (std::size_t i = 0; i < p.nodes.size(); ++i) {
    p.nodes[i].curvature_sign = forced_sign(a, i);
    if (i < wishes.fixed.size()) {
      p.nodes[i].theta = wishes.fixed[i].theta;
      p.nodes[i].kappa = wishes.fixed[i].kappa;
    }
    turns += a.circles[i].kappa > 0.0 ? 1 : a.circles[i].kappa < 0.0 ? -1 : 0;
  }
  if (wishes.convex) {
    for (std::size_t i = 0; i < p.nodes.size(); ++i) {
      const AdjacentCircle& c = a.circles[i];
      if (turns * c.kappa < 0.0 && std::abs(c.kappa) > c.rounding) {
        return fail({ErrorCode::kFixedDataContradict,
                     "a convex contour was asked for, but the points turn the other way here",
                     "point " + std::to_string(i + 1), "drop the wish for a convex contour",
                     static_cast<std::ptrdiff_t>(i), c.kappa});
      }
      p.nodes[i].curvature_sign = turns > 0 ? 1 : -1;
    }
  }
  for (const CircularStretch& s : a.stretches) {
    for (std::size_t i = s.first; i <= s.last; ++i) {
      if (contradicts(p.nodes[i], heading_on_stretch(a, s, i), s.kappa, a.circles[i].rounding)) {
        return fail({ErrorCode::kFixedDataContradict,
                     "the points lie on one circle or line here, with another heading or radius "
                     "than the fixed one",
                     fmt::format("point {}", i + 1), "free the heading and radius there",
                     static_cast<std::ptrdiff_t>(i), s.kappa});
      }
      p.nodes[i].theta = heading_on_stretch(a, s, i);
      p.nodes[i].kappa = s.kappa;
      p.nodes[i].curvature_sign = 0;
    }
  }
  return p;
}

std::string point_range(const Infeasibility& why) {
  return "points " + std::to_string(why.first_point + 1) + " to " +
         std::to_string(why.last_point + 1);
}

bool touches_stretch(const Analysis& a, const Infeasibility& why) {
  return std::any_of(a.stretches.begin(), a.stretches.end(), [&](const CircularStretch& s) {
    return s.first <= why.last_point && why.first_point <= s.last;
  });
}

/// Largest move of a point by rounding, among the points of the infeasible part and its neighbours.
double rounding_move(const std::vector<Vec2>& points, const Infeasibility& why) {
  double largest = 0.0;
  const std::size_t first = why.first_point >= 2 ? why.first_point - 2 : 0;
  for (std::size_t i = first; i < std::min(points.size(), why.last_point + 3); ++i) {
    largest = std::max(largest, 0x1p-53 * (std::abs(points[i].x) + std::abs(points[i].y)));
  }
  return largest;
}

bool anything_wished(const ChainWishes& wishes) {
  return wishes.convex ||
         std::any_of(wishes.fixed.begin(), wishes.fixed.end(),
                     [](const FixedData& f) { return f.theta.has_value() || f.kappa.has_value(); });
}

Error explain(const std::vector<Vec2>& points, const Analysis& a, const ChainWishes& wishes,
              const Infeasibility& why) {
  const auto index = static_cast<std::ptrdiff_t>(why.first_point);
  const std::string where = point_range(why);
  const bool leaps = why.slack == 0.0;
  if (!leaps && why.move <= kRoundingsThatDecide * rounding_move(points, why)) {
    return {ErrorCode::kRoundingDecides,
            "the rounding of the coordinates, not the curve, decides how the curvature changes",
            where,
            "give coordinates relative to a nearer origin, or leave out points that lie "
            "closer together than their digits can tell",
            index,
            why.move};
  }
  if (touches_stretch(a, why)) {
    return {ErrorCode::kNoRoomForTransition,
            "a straight or circular stretch leaves no room for a change of curvature beside it",
            where,
            "remove a point at the end of the stretch, or move one off it",
            index,
            why.move};
  }
  if (anything_wished(wishes)) {
    return {ErrorCode::kFixedDataContradict,
            "the fixed headings, curvatures or convexity cannot be met by a monotone contour",
            where,
            "free the data there",
            index,
            why.move};
  }
  if (leaps) {
    return {ErrorCode::kNoSpiral,
            "a curve with curvature changing as the points demand would have to leap at them",
            where,
            "move points there, or add points",
            index,
            why.move};
  }
  return {ErrorCode::kNoSpiral,
          "no curve with curvature changing as the points demand runs through them",
          where,
          "move points there, or add points",
          index,
          why.move};
}

/// Puts a free element into every link that one closed-form piece cannot carry well.
struct Extended {
  std::vector<Vec2> points;
  std::vector<Element> start;
  std::vector<std::optional<std::size_t>> source;
  ChainProblem problem;
  std::vector<bool> turned;  ///< links whose direction was turned
  std::size_t inserted = 0;
};

Extended with_free_elements(const Extended& before, const ChainSolution& solution) {
  Extended out;
  const std::size_t n = before.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    out.points.push_back(before.points[i]);
    out.start.push_back(solution.elements[i]);
    out.source.push_back(before.source[i]);
    out.problem.nodes.push_back(before.problem.nodes[i]);
    if (i + 1 == n) break;
    const std::int8_t direction = before.problem.direction[i];
    const Cone cone = direction == 0 ? Cone::kNone : Cone::kClosedForm;
    out.problem.direction.push_back(direction);
    out.problem.cone.push_back(cone);
    const LinkState& link = solution.links[i];
    if (cone == Cone::kNone || cone_margin(link, direction, cone) >= kThinMargin) continue;
    const Element e = free_element(link, direction, before.points[i]);
    out.points.push_back(e.point);
    out.start.push_back(e);
    out.source.emplace_back(std::nullopt);
    out.problem.nodes.emplace_back();
    out.problem.direction.push_back(direction);
    out.problem.cone.push_back(cone);
    ++out.inserted;
  }
  out.turned.assign(out.problem.direction.size(), false);
  out.problem.chords = measure_chords(out.points);
  out.problem.circles = measure_circles(out.points, out.problem.chords);
  return out;
}

SeriesChain collect(const Extended& e, ChainSolution solution, int steps) {
  SeriesChain out;
  out.elements = std::move(solution.elements);
  out.links = std::move(solution.links);
  out.source = e.source;
  out.direction = e.problem.direction;
  out.cone = e.problem.cone;
  out.newton_steps = steps;
  out.smallest_margin = solution.smallest_margin;
  out.converged = solution.converged;
  for (const auto& s : out.source) out.free_elements += s ? 0U : 1U;
  return out;
}

/// Below this part of B - A a link's sigma says that the curvature leaps at both its ends and
/// stays put between them: formally monotone, of no use to anybody, and beyond proof.
constexpr double kLeapingSigma = 1e-3;

/// Index of the worst link whose curvature leaps, or nothing.
std::optional<std::size_t> leaping_link(const ChainProblem& problem, const ChainSolution& s) {
  std::optional<std::size_t> worst;
  double least = kLeapingSigma;
  for (std::size_t i = 0; i < s.links.size(); ++i) {
    if (problem.cone[i] == Cone::kNone) continue;
    const double ratio = s.links[i].sigma / (s.links[i].B - s.links[i].A);
    if (ratio >= least) continue;
    least = ratio;
    worst = i;
  }
  return worst;
}

/// All cones with room, by the true cone of the closed form, and no leaps.
bool carried(const ChainProblem& problem, const ChainSolution& s) {
  return s.feasible && s.smallest_margin > 0.0 && !leaping_link(problem, s);
}

/// Elements for given directions, or why there are none.
struct Attempt {
  std::optional<SeriesChain> chain;
  Infeasibility why;
  int steps = 0;
};

Attempt refuse(Infeasibility why, int steps) { return {std::nullopt, why, steps}; }

Infeasibility blame(std::size_t link) { return {link, link + 1, 0.0, 0.0}; }

Attempt insert_and_solve(Extended current, ChainSolution solution, int steps) {
  for (int round = 0; round < kInsertionRounds; ++round) {
    current = with_free_elements(current, solution);
    solution = solve_chain(current.points, current.problem, {}, &current.start);
    steps += solution.newton_steps;
    if (carried(current.problem, solution)) {
      return {collect(current, std::move(solution), steps), {}, steps};
    }
    if (!solution.feasible) return refuse(solution.infeasibility, steps);
    if (const auto link = leaping_link(current.problem, solution)) {
      std::size_t point = 0;  // of the series, before the link
      for (std::size_t i = 0; i <= *link; ++i) point = current.source[i].value_or(point);
      return refuse(blame(point), steps);
    }
  }
  return refuse(blame(0), steps);
}

/// Closed-form cones first; then mere existence and free elements; then without the wish that the
/// curvature keep its sign, which can turn out to be impossible.
Attempt attempt(Extended current, bool convex) {
  ChainSolution solution = solve_chain(current.points, current.problem);
  int steps = solution.newton_steps;
  if (carried(current.problem, solution)) {
    return {collect(current, std::move(solution), steps), {}, steps};
  }
  if (solution.feasible) {
    if (const auto link = leaping_link(current.problem, solution))
      return refuse(blame(*link), steps);
  }
  for (Cone& c : current.problem.cone) c = c == Cone::kNone ? c : Cone::kSpiral;
  solution = solve_chain(current.points, current.problem);
  steps += solution.newton_steps;
  bool unforced_inflection = false;
  if (!solution.feasible && !convex) {
    const Infeasibility with_signs = solution.infeasibility;
    for (NodeData& node : current.problem.nodes) node.curvature_sign = 0;
    solution = solve_chain(current.points, current.problem);
    steps += solution.newton_steps;
    unforced_inflection = solution.feasible;
    if (!solution.feasible) solution.infeasibility = with_signs;
  }
  if (!solution.feasible) return refuse(solution.infeasibility, steps);
  Attempt out = insert_and_solve(std::move(current), std::move(solution), steps);
  if (out.chain) out.chain->unforced_inflection = unforced_inflection;
  return out;
}

/// Links from..to of a series as a series of their own, with the cones of mere existence.
Extended slice(const Extended& series, std::size_t from, std::size_t to) {
  const auto part = [&](const auto& all, std::size_t extra) {
    return std::vector(all.begin() + static_cast<std::ptrdiff_t>(from),
                       all.begin() + static_cast<std::ptrdiff_t>(to + extra));
  };
  const ChainProblem& p = series.problem;
  Extended out;
  out.points = part(series.points, 1);
  out.source = part(series.source, 1);
  out.problem = {part(p.chords, 0), part(p.circles, 1), part(p.direction, 0), part(p.cone, 0),
                 part(p.nodes, 1)};
  out.turned = part(series.turned, 0);
  for (Cone& c : out.problem.cone) c = c == Cone::kNone ? c : Cone::kSpiral;
  return out;
}

/// Links solved beyond the ones in question, when only a neighbourhood is looked at.
constexpr std::size_t kWindow = 4;

/// Turns directions where no monotone curve exists although the adjacent circles allow one.
class DirectionRepair {
 public:
  explicit DirectionRepair(const Extended& series) : series_(series) {}

  /// The link to turn for this infeasibility: one that makes its neighbourhood feasible, with as
  /// few vertices as possible; else the one that comes closest. Nothing when all were turned.
  [[nodiscard]] std::optional<std::size_t> choose(const Infeasibility& why) const {
    const ChainProblem& problem = series_.problem;
    const std::size_t links = problem.direction.size();
    const std::size_t first = why.first_point >= kReach ? why.first_point - kReach : 0;
    const std::size_t last = std::min({links, why.last_point + kReach, first + kMostCandidates});
    std::optional<std::size_t> best;
    Outcome least;
    for (std::size_t i = first; i < last; ++i) {
      if (problem.direction[i] == 0 || series_.turned[i]) continue;
      const Outcome outcome = try_turn(problem, i, first, last);
      if (best && !outcome.better_than(least)) continue;
      best = i;
      least = outcome;
    }
    return best;
  }

 private:
  static constexpr std::size_t kReach = 2;            // links beyond the infeasible ones
  static constexpr std::size_t kMostCandidates = 24;  // links looked at for one turn

  struct Outcome {
    double slack = 0.0;  // 0: feasible
    int vertices = 0;
    [[nodiscard]] bool better_than(const Outcome& o) const {
      if ((slack == 0.0) != (o.slack == 0.0)) return slack == 0.0;
      if (slack == 0.0) return vertices < o.vertices;
      return slack < o.slack;
    }
  };

  /// Solves the neighbourhood alone with one direction turned.
  [[nodiscard]] Outcome try_turn(const ChainProblem& problem, std::size_t link, std::size_t first,
                                 std::size_t last) const {
    const std::size_t from = first >= kWindow ? first - kWindow : 0;
    const std::size_t to = std::min(problem.direction.size(), last + kWindow);
    Extended part = slice(series_, from, to);
    ChainProblem& window = part.problem;
    window.direction[link - from] = static_cast<std::int8_t>(-window.direction[link - from]);
    const ChainSolution s = solve_chain(part.points, window);
    int vertices = 0;
    for (std::size_t i = 0; i + 1 < window.direction.size(); ++i) {
      vertices += window.direction[i] * window.direction[i + 1] < 0 ? 1 : 0;
    }
    return {s.feasible ? 0.0 : s.infeasibility.slack, vertices};
  }

  const Extended& series_;
};

/// A vertex between a circular stretch and its neighbour: where the neighbour cannot lead into the
/// stretch monotonically, the curvature is let pass it and come back inside the link.
class TransitionVertex {
 public:
  /// Inserts one beside the first stretch that the infeasibility touches and that has none yet on
  /// that side. False when there is no such place.
  static bool insert(Extended& series, const Infeasibility& why) {
    const std::vector<Cone>& cone = series.problem.cone;
    const std::size_t first = why.first_point >= kReach ? why.first_point - kReach : 0;
    const std::size_t last = std::min(cone.size() - 1, why.last_point + kReach);
    for (std::size_t i = first; i < last; ++i) {
      const bool enters = cone[i] != Cone::kNone && cone[i + 1] == Cone::kNone;
      const bool leaves = cone[i] == Cone::kNone && cone[i + 1] != Cone::kNone;
      if (enters && series.source[i] && series.source[i + 1]) return insert_into(series, i, true);
      if (leaves && series.source[i + 1] && series.source[i + 2]) {
        return insert_into(series, i + 1, false);
      }
    }
    return false;
  }

 private:
  static constexpr std::size_t kReach = 3;  // links between the infeasible ones and the stretch

  /// Place for the vertex: over part `along` of the chord, at part `height` of the cubic whose ends
  /// have the tangents of the stretch and of the adjacent circle.
  static Vec2 place(const Extended& s, std::size_t link, double along, double height) {
    const Chord& chord = s.problem.chords[link];
    const auto tangent = [&](std::size_t node, double of_circle) {
      const double theta = s.problem.nodes[node].theta.value_or(chord.omega + of_circle);
      return chord.length * unit_at(theta - chord.omega);
    };
    const Vec2 t0 = tangent(link, -s.problem.circles[link].eta_out);
    const Vec2 t1 = tangent(link + 1, s.problem.circles[link + 1].eta_in);
    const double u = along, v = 1.0 - along;
    const double y = u * v * v * t0.y - u * u * v * t1.y;  // Hermite cubic over the chord
    return s.points[link] + complex_product({u * chord.length, height * y}, unit_at(chord.omega));
  }

  /// The place whose neighbourhood is feasible with the widest margin, else comes closest.
  static Vec2 best_place(const Extended& series, std::size_t link, bool before_stretch) {
    const std::size_t from = link >= kWindow ? link - kWindow : 0;
    const std::size_t to = std::min(series.problem.direction.size(), link + 1 + kWindow);
    const Extended window = slice(series, from, to);
    Vec2 best{};
    double best_score = -std::numeric_limits<double>::infinity();
    for (const double along : {0.25, 0.5, 0.75}) {
      for (const double height : {0.3, 0.5, 0.7, 0.85, 1.0, 1.15}) {
        const Vec2 point = place(series, link, along, height);
        Extended candidate = window;
        insert_at(candidate, link - from, before_stretch, point);
        const ChainSolution s = solve_chain(candidate.points, candidate.problem);
        const double score = s.feasible ? s.smallest_margin : -s.infeasibility.slack;
        if (score <= best_score) continue;
        best_score = score;
        best = point;
      }
    }
    return best;
  }

  static bool insert_into(Extended& s, std::size_t link, bool before_stretch) {
    insert_at(s, link, before_stretch, best_place(s, link, before_stretch));
    return true;
  }

  static void insert_at(Extended& s, std::size_t link, bool before_stretch, Vec2 point) {
    const auto at = [](auto& v, std::size_t i) {
      return v.begin() + static_cast<std::ptrdiff_t>(i);
    };
    const std::size_t fixed = before_stretch ? link + 1 : link;
    const double kappa = *s.problem.nodes[fixed].kappa;
    s.points.insert(at(s.points, link + 1), point);
    s.source.insert(at(s.source, link + 1), std::nullopt);
    s.problem.nodes.insert(at(s.problem.nodes, link + 1), NodeData{});
    s.problem.cone.insert(at(s.problem.cone, link), s.problem.cone[link]);
    s.turned.insert(at(s.turned, link), false);
    s.problem.chords = measure_chords(s.points);
    s.problem.circles = measure_circles(s.points, s.problem.chords);
    // the half beside the stretch leads to its curvature, the other half the way back
    const double over = s.problem.circles[link + 1].kappa - kappa;
    const auto beside = static_cast<std::int8_t>((over > 0.0) == before_stretch ? -1 : 1);
    const auto away = static_cast<std::int8_t>(-beside);
    s.problem.direction[link] = before_stretch ? away : beside;
    s.problem.direction.insert(at(s.problem.direction, link + 1), before_stretch ? beside : away);
  }
};

/// Whether the points alone have a solution, so that it is the wishes which have none. Then no
/// direction is turned: further vertices are not what somebody who fixes a radius asks for.
bool fulfilled_without(const ChainWishes& wishes, const Analysis& analysis, Extended series) {
  if (!anything_wished(wishes)) return false;
  auto problem = set_up(analysis, {});
  if (!problem) return false;
  series.problem = std::move(*problem);
  return attempt(std::move(series), false).chain.has_value();
}

/// Directions that may be turned, and the longest series for which that is tried: every turn costs
/// a solution of the whole chain.
constexpr int kMostTurns = 100;
constexpr std::size_t kLongestRepair = 5000;

}  // namespace

Result<SeriesChain> choose_elements(const std::vector<Vec2>& points, const Analysis& analysis,
                                    const ChainWishes& wishes) {
  auto problem = set_up(analysis, wishes);
  if (!problem) return tl::unexpected(problem.error());
  Extended current;
  current.points = points;
  current.problem = std::move(*problem);
  for (std::size_t i = 0; i < points.size(); ++i) current.source.emplace_back(i);

  current.turned.assign(current.problem.direction.size(), false);
  Attempt tried = attempt(current, wishes.convex);
  if (!tried.chain && fulfilled_without(wishes, analysis, current)) {
    return fail(explain(points, analysis, wishes, tried.why));
  }
  const Infeasibility first_reason = tried.why;
  int steps = tried.steps;
  std::size_t turned = 0;
  for (int round = 0; !tried.chain && round < kMostTurns && points.size() <= kLongestRepair;
       ++round) {
    if (!TransitionVertex::insert(current, tried.why)) {
      const auto link = DirectionRepair(current).choose(tried.why);
      if (!link) break;
      current.turned[*link] = true;
      std::int8_t& direction = current.problem.direction[*link];
      direction = static_cast<std::int8_t>(-direction);
    }
    ++turned;
    tried = attempt(current, wishes.convex);
    steps += tried.steps;
  }
  if (!tried.chain) return fail(explain(points, analysis, wishes, first_reason));
  tried.chain->newton_steps = steps;
  tried.chain->turned_directions = turned;
  return std::move(*tried.chain);
}

}  // namespace obvid
