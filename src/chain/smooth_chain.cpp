// SPDX-License-Identifier: Apache-2.0
#include "obvid/chain/internal/smooth_chain.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "obvid/chain/internal/chain_part.h"
#include "obvid/geom/internal/angle.h"
#include "part_window.h"
#include "slope_solver.h"

namespace obvid {
namespace {

using namespace chain_detail;

/// Newton steps of one solution; a handful are the rule.
constexpr int kMostSlopeSteps = 100;
/// Slopes count as equal when their logarithms differ by no more.
constexpr double kEqualSlopes = 1e-7;
/// How often joints of a run are given up whose slopes do not become equal.
constexpr int kMostDrops = 6;
/// Joints whose gap is at least this part of the largest are given up together.
constexpr double kWorstPart = 0.3;

bool is_spiral(const SeriesChain& c, std::size_t link) { return c.cone[link] != Cone::kNone; }

/// Element in the middle of the even spiral over a link.
Element middle_element(const LinkState& link, int direction, const Element& start) {
  const SpiralShape s = spiral_shape(link, direction, SpiralForm::kEven);
  const double d = direction, root = std::sqrt(s.gain);
  const Vec2 lead = root * unit_at(s.lead), trail = root * unit_at(s.trail);
  const Vec2 mu = s.mu * unit_at(d * link.alpha - s.lead);
  // where numerator and denominator of the homography weigh alike
  const double x = 1.0 / (1.0 + std::sqrt(s.mu)), y = 1.0 - x;
  const auto times = [](Vec2 a, Vec2 b) { return complex_product(a, b); };
  const Vec2 one = {1.0, 0.0};
  const auto over = [&](Vec2 a, Vec2 b) { return times(a, {b.x, -b.y}) / dot(b, b); };
  const Vec2 n0 = times(mu, x * (y * lead + x * one)),
             n1 = times(mu, (y - x) * lead + 2.0 * x * one);
  const Vec2 n2 = times(mu, 2.0 * (one - lead));
  const Vec2 m0 = y * (y * one + x * trail), m1 = (y - x) * trail - 2.0 * y * one;
  const Vec2 m2 = 2.0 * (one - trail);
  const Vec2 D0 = n0 + m0, D1 = n1 + m1, D2 = n2 + m2;
  // z + 1 = 2 N / D
  const Vec2 z = over(2.0 * n0, D0), z1 = over(2.0 * n1 - times(z, D1), D0);
  const Vec2 z2 = over(2.0 * n2 - 2.0 * times(z1, D1) - times(z, D2), D0);
  const double speed = norm(z1), kappa = cross(z1, z2) / (speed * speed * speed);
  const Vec2 half_chord = 0.5 * link.h * unit_at(link.omega);
  return {start.point + complex_product({z.x, d * z.y}, half_chord), link.omega + d * heading(z1),
          d * kappa / (0.5 * link.h)};
}

/// Whether the slope is zero at an element: the direction changes there, or an arc or line begins.
/// The ends of a loop are one element.
bool rests_at(const SeriesChain& c, std::size_t element, bool loop) {
  const bool end = element == 0 || element + 1 == c.elements.size();
  if (end) return loop && c.direction.front() != c.direction.back();
  return c.direction[element - 1] != c.direction[element];
}

/// A chain with an element in the middle of each link that `wanted` names. Without the links'
/// states.
template <class Wanted>
SeriesChain halved_where(const SeriesChain& chain, Wanted&& wanted) {
  SeriesChain out;
  const auto append = [&](const Element& e, std::optional<std::size_t> source,
                          const NodeData& data) {
    out.elements.push_back(e);
    out.source.push_back(source);
    out.nodes.push_back(data);
  };
  const std::size_t n = chain.elements.size();
  for (std::size_t i = 0; i < n; ++i) {
    append(chain.elements[i], chain.source[i], chain.nodes[i]);
    if (i + 1 == n) break;
    const bool halve = wanted(i);
    if (halve) {
      append(middle_element(chain.links[i], chain.direction[i], chain.elements[i]), std::nullopt,
             {});
    }
    out.direction.insert(out.direction.end(), halve ? 2 : 1, chain.direction[i]);
    out.cone.insert(out.cone.end(), halve ? 2 : 1, chain.cone[i]);
  }
  return out;
}

SeriesChain halved(const SeriesChain& chain) {
  return halved_where(chain, [](std::size_t) { return true; });
}

/// Links that rest at both ends: no closed form has two slopes of zero.
SeriesChain halved_where_resting(const SeriesChain& chain, bool loop) {
  return halved_where(chain, [&](std::size_t i) {
    return is_spiral(chain, i) && rests_at(chain, i, loop) && rests_at(chain, i + 1, loop);
  });
}

/// The same loop from its element `first` on.
SeriesChain rotated(const SeriesChain& loop, std::size_t first) {
  SeriesChain out = loop;
  const std::size_t m = loop.direction.size();
  const double turn = loop.elements.back().theta - loop.elements.front().theta;
  for (std::size_t i = 0; i <= m; ++i) {
    const bool wraps = first + i >= m;
    const std::size_t from = wraps ? first + i - m : first + i;
    out.elements[i] = loop.elements[from];
    out.elements[i].theta += wraps ? turn : 0.0;
    out.source[i] = loop.source[from];
    out.nodes[i] = loop.nodes[from];
    if (i == m) break;
    out.direction[i] = loop.direction[from];
    out.cone[i] = loop.cone[from];
    if (!loop.links.empty()) {
      out.links[i] = loop.links[from];
      out.links[i].omega += wraps ? turn : 0.0;
    }
    if (!loop.form.empty()) out.form[i] = loop.form[from];
  }
  for (std::size_t i = 0; !loop.slope_step.empty() && i <= m; ++i) {
    out.slope_step[i] = loop.slope_step[first + i >= m ? first + i - m : first + i];
  }
  return out;
}

/// One full turn of a loop taken off, which it goes on by when it is rotated.
SeriesChain turned_back(SeriesChain loop) {
  const double turn = loop.elements.back().theta - loop.elements.front().theta;
  for (Element& e : loop.elements) e.theta -= turn;
  for (LinkState& link : loop.links) link.omega -= turn;
  return loop;
}

/// From now on the element there is given.
void hold_at(const Element& element, NodeData& node) {
  node.theta = element.theta;
  node.kappa = element.kappa;
}

/// Elements of a chain at which the slope is zero, and which are others' too: they stay as they
/// are.
struct Ends {
  std::vector<bool> rest;
  bool hold_first = false, hold_last = false;
};

Ends ends_of_chain(const SeriesChain& chain, bool loop) {
  Ends out;
  for (std::size_t i = 0; i < chain.elements.size(); ++i) {
    out.rest.push_back(rests_at(chain, i, loop));
  }
  out.hold_first = out.hold_last = loop;
  return out;
}

/// Whether every link that is to be a spiral is one in doubles too.
bool are_spirals(const SeriesChain& chain) {
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    if (!is_spiral(chain, i)) continue;
    const SpiralForm form = chain.form.empty() ? SpiralForm::kOneSided : chain.form[i];
    if (!(cone_margin(chain.links[i], chain.direction[i], cone_of(form)) > 0.0)) return false;
    if (form == SpiralForm::kOneSided) continue;
    if (!spiral_shape(chain.links[i], chain.direction[i], form).exists()) return false;
  }
  return true;
}

/// The problem of the slopes of a chain, and its solution.
class Slopes {
 public:
  /// The chain's own links are not looked at.
  Slopes(SeriesChain chain, Ends ends, Watch& watch)
      : work_(std::move(chain)), ends_(std::move(ends)), watch_(watch) {
    given_ = work_.nodes;
    for (const Element& e : work_.elements) points_.push_back(e.point);
    if (ends_.hold_first) hold_at(work_.elements.front(), work_.nodes.front());
    if (ends_.hold_last) hold_at(work_.elements.back(), work_.nodes.back());
    keep_signs();
    set_forms();
  }

  /// `drops`: how often joints may be given up whose slopes do not become equal. False where
  /// nothing could be done.
  bool run(int drops, SmoothedSlopes& out) { return run_from(work_.elements, drops, out); }

  /// The same from other headings and curvatures than the chain's own.
  bool run_from(const std::vector<Element>& start, int drops, SmoothedSlopes& out) {
    SlopeProblem problem{problem_of(), work_.form, equal_};
    for (int round = 0; round <= drops && !watch_.cancelled(); ++round) {
      SlopeSolver solver(problem);
      const SlopeSolver::Outcome found = solver.run(start, kMostSlopeSteps, watch_);
      out.newton_steps += found.steps;
      if (!found.valid) return false;
      if (found.largest_gap <= kEqualSlopes) {
        take(solver, problem, found, out);
        return are_spirals(work_);
      }
      const std::vector<double>& gap = solver.gaps();
      for (std::size_t i = 0; i < gap.size(); ++i) {
        if (std::abs(gap[i]) >= kWorstPart * found.largest_gap) problem.equal_slope[i] = false;
      }
    }
    return false;
  }

  [[nodiscard]] SeriesChain result() && { return std::move(work_); }

  /// Holds heading and curvature of an element at what they are in another chain.
  void hold_as(std::size_t i, const Element& element) {
    hold_at(element, work_.nodes[i]);
    held_.push_back(i);
  }
  /// Nothing is asked of slopes between held elements.
  void ask_nothing_of_held() {
    const auto is_held = [&](std::size_t i) {
      return std::find(held_.begin(), held_.end(), i) != held_.end();
    };
    for (std::size_t i = 1; i + 1 < equal_.size(); ++i) {
      if (is_held(i - 1) && is_held(i) && is_held(i + 1)) equal_[i] = false;
    }
    equal_.front() = equal_.back() = false;
  }

 private:
  /// At vertices and ends the curvature keeps its sign: then so does the number of inflections.
  void keep_signs() {
    for (std::size_t i = 0; i < work_.elements.size(); ++i) {
      const bool end = i == 0 || i + 1 == work_.elements.size();
      NodeData& node = work_.nodes[i];
      const double kappa = work_.elements[i].kappa;
      if (node.kappa || node.curvature_sign != 0 || !(end || ends_.rest[i]) || kappa == 0.0)
        continue;
      node.curvature_sign = kappa > 0.0 ? 1 : -1;
    }
  }

  void set_forms() {
    const std::size_t n = work_.elements.size();
    equal_.assign(n, false);
    work_.form.clear();
    for (std::size_t i = 0; i + 1 < n; ++i) {
      work_.form.push_back(ends_.rest[i]       ? SpiralForm::kRestAtStart
                           : ends_.rest[i + 1] ? SpiralForm::kRestAtEnd
                                               : SpiralForm::kEven);
      if (i > 0) equal_[i] = is_spiral(work_, i) && is_spiral(work_, i - 1) && !ends_.rest[i];
    }
  }

  [[nodiscard]] ChainProblem problem_of() const {
    ChainProblem out;
    out.chords = measure_chords(points_);
    out.circles = measure_circles(points_, out.chords);
    out.direction = work_.direction;
    out.cone = work_.cone;
    out.nodes = work_.nodes;
    return out;
  }

  void take(const SlopeSolver& solver, const SlopeProblem& problem,
            const SlopeSolver::Outcome& found, SmoothedSlopes& out) {
    std::vector<Element> elements = solver.elements(points_);
    const double turns =
        std::round((work_.elements.front().theta - elements.front().theta) / kFullTurn) * kFullTurn;
    for (Element& e : elements) e.theta += turns;
    const Element first = work_.elements.front(), last = work_.elements.back();
    work_.elements = std::move(elements);
    // what is shared stays to the last bit
    if (ends_.hold_first) work_.elements.front() = first;
    if (ends_.hold_last) work_.elements.back() = last;
    work_.links = solver.links();
    for (LinkState& link : work_.links) link.omega += turns;
    work_.nodes = given_;
    out.converged = found.converged;
    work_.slope_step.assign(equal_.size(), false);
    for (std::size_t i = 0; i < equal_.size(); ++i) {
      work_.slope_step[i] = problem.equal_slope[i] != equal_[i];
    }
  }

  SeriesChain work_;
  Ends ends_;
  Watch& watch_;
  std::vector<Vec2> points_;
  std::vector<NodeData> given_;
  std::vector<bool> equal_;
  std::vector<std::size_t> held_;
};

/// Elements first..last of a chain, before anything was done to their slopes.
SeriesChain part_of(const SeriesChain& chain, std::size_t first, std::size_t last) {
  SeriesChain out = slice_of(chain, first, last);
  out.smooth = false;
  if (out.form.empty()) out.form.assign(out.links.size(), SpiralForm::kOneSided);
  out.slope_step.assign(out.elements.size(), true);
  return out;
}

/// Joins the parts of a chain; a joint steps when it does in either of them.
void append_part(SeriesChain part, SeriesChain& whole) {
  if (whole.elements.empty()) {
    whole = std::move(part);
    return;
  }
  const bool steps = whole.slope_step.back() || part.slope_step.front();
  const auto add = [](const auto& from, auto& to, std::ptrdiff_t skip) {
    to.insert(to.end(), from.begin() + skip, from.end());
  };
  whole.slope_step.back() = steps;
  add(part.elements, whole.elements, 1);
  add(part.source, whole.source, 1);
  add(part.nodes, whole.nodes, 1);
  add(part.slope_step, whole.slope_step, 1);
  add(part.links, whole.links, 0);
  add(part.direction, whole.direction, 0);
  add(part.cone, whole.cone, 0);
  add(part.form, whole.form, 0);
}

/// Every run by itself, its ends as they were: one that fails spoils no other.
class RunByRun {
 public:
  /// Runs with a link of `keep` stay as they are.
  RunByRun(const SeriesChain& chain, const std::vector<bool>& keep, bool loop, Watch& watch)
      : chain_(chain),
        keep_(keep),
        rest_(ends_of_chain(chain, loop).rest),
        loop_(loop),
        watch_(watch) {}

  SeriesChain run(SmoothedSlopes& out) {
    SeriesChain whole;
    out.converged = true;
    std::size_t first = 0;
    for (std::size_t i = 1; i < rest_.size(); ++i) {
      if (!rest_[i] && i + 1 < rest_.size()) continue;
      append_part(smoothed(first, i, out), whole);
      first = i;
    }
    return whole;
  }

 private:
  SeriesChain smoothed(std::size_t first, std::size_t last, SmoothedSlopes& out) {
    SeriesChain part = part_of(chain_, first, last);
    if (!is_spiral(part, 0)) {
      part.slope_step.assign(part.elements.size(), false);
      return part;
    }
    const bool both = rest_[first] && rest_[last] && last == first + 1;
    SeriesChain fine = halved(part);
    for (const int drops : {0, kMostDrops}) {
      if (is_kept(first, last)) break;
      if (!both) {
        if (auto done = solved(part, first, last, drops, out)) return std::move(*done);
      }
      if (auto done = solved(fine, first, last, drops, out)) return std::move(*done);
    }
    out.converged = false;
    part.slope_step.front() = rest_[first];
    part.slope_step.back() = rest_[last];
    return part;
  }

  [[nodiscard]] bool is_kept(std::size_t first, std::size_t last) const {
    for (std::size_t i = first; i < last && !keep_.empty(); ++i) {
      if (keep_[i]) return true;
    }
    return false;
  }

  /// What the run shares with its neighbours stays as it is.
  std::optional<SeriesChain> solved(const SeriesChain& part, std::size_t first, std::size_t last,
                                    int drops, SmoothedSlopes& out) {
    Ends ends;
    ends.rest.assign(part.elements.size(), false);
    ends.rest.front() = rest_[first];
    ends.rest.back() = rest_[last];
    ends.hold_first = rest_[first] || (loop_ && first == 0);
    ends.hold_last = rest_[last] || (loop_ && last + 1 == rest_.size());
    SmoothedSlopes now;
    Slopes slopes(part, std::move(ends), watch_);
    const bool done = slopes.run(drops, now);
    out.newton_steps += now.newton_steps;
    if (!done) return std::nullopt;
    out.converged = out.converged && now.converged;
    return std::move(slopes).result();
  }

  const SeriesChain& chain_;
  const std::vector<bool>& keep_;
  std::vector<bool> rest_;
  bool loop_;
  Watch& watch_;
};

/// The whole chain at once, or run by run. Of a loop that begins at rest, if it rests anywhere.
SeriesChain smoothed_chain(const SeriesChain& chain, const std::vector<bool>& keep, bool loop,
                           Watch& watch, SmoothedSlopes& out) {
  if (!keep.empty()) return RunByRun(chain, keep, loop, watch).run(out);
  SeriesChain work = halved_where_resting(chain, loop);
  Ends ends = ends_of_chain(work, loop);
  Slopes slopes(std::move(work), std::move(ends), watch);
  if (slopes.run(0, out)) return std::move(slopes).result();
  return RunByRun(chain, keep, loop, watch).run(out);
}

/// The element at rest that is farthest from a loop's seam; nothing where there is none.
std::optional<std::size_t> across_from_seam(const SeriesChain& loop) {
  const std::size_t m = loop.direction.size();
  const auto off = [m](std::size_t i) { return i < m - i ? m - 2 * i : 2 * i - m; };
  std::optional<std::size_t> best;
  for (std::size_t i = 1; i < m; ++i) {
    if (rests_at(loop, i, true) && (!best || off(i) < off(*best))) best = i;
  }
  return best;
}

/// How much an element turned and bent, of the turning of its link.
double change_of(const Element& a, const Element& b, const LinkState& link) {
  const double turn = std::max(std::abs(link.sigma), std::abs(link.beta - link.alpha));
  const double heading = turn_between(b.theta, a.theta);
  return (std::abs(heading) + std::abs(a.kappa - b.kappa) * link.h) / turn;
}

/// A seam holds its element as it came. Laid to the other side of the loop it frees that one, and
/// so to and fro until neither changes: then it does not matter where the loop begins.
SeriesChain without_seam(SeriesChain loop, Watch& watch, SmoothedSlopes& out) {
  constexpr int kMostRounds = 24, kSides = 2;
  constexpr double kStays = 1e-10;  // of the element's change, far below what is written
  const std::size_t m = loop.direction.size();
  std::size_t way = 0;
  for (int round = 0, still = 0; round < kMostRounds && still < kSides; ++round) {
    const auto far = across_from_seam(loop);
    if (!far) break;
    const Element before = loop.elements.front();
    SeriesChain turned = rotated(loop, *far);
    Ends ends = ends_of_chain(turned, true);
    Slopes slopes(std::move(turned), std::move(ends), watch);
    SmoothedSlopes now;
    const bool done = slopes.run(0, now);
    out.newton_steps += now.newton_steps;
    if (!done) break;
    out.converged = now.converged;
    loop = std::move(slopes).result();
    way += *far;
    const std::size_t old = m - *far;  // where the seam was
    still = change_of(loop.elements[old], before, loop.links[old]) < kStays ? still + 1 : 0;
  }
  const std::size_t back = (m - way % m) % m;
  if (back > 0) loop = rotated(loop, back);
  for (std::size_t turns = (way + back) / m; turns > 0; --turns)
    loop = turned_back(std::move(loop));
  return loop;
}

/// Counts what meets and what steps.
void count_joints(SeriesChain& chain, bool loop, SmoothedSlopes& out) {
  const std::size_t n = chain.elements.size();
  for (std::size_t i = loop ? 0 : 1; i + 1 < n; ++i) {
    const std::size_t before = i > 0 ? i - 1 : n - 2;
    const bool meet = is_spiral(chain, before) || is_spiral(chain, i);
    if (!meet) chain.slope_step[i] = false;
    out.joints += meet ? 1U : 0U;
    if (chain.slope_step[i]) out.stepped.push_back(i);
  }
}

/// Whether slopes were made equal everywhere and at once, without further elements: then they
/// follow from the directions and points alone.
bool made_at_once(const SeriesChain& before, const SeriesChain& smooth, bool loop,
                  std::size_t cut) {
  const std::size_t n = before.elements.size();
  if (!smooth.smooth || smooth.elements.size() != n || smooth.form.size() + 1 != n) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const bool end = i == 0 || i + 1 == n;
    if (i < n - 1 && smooth.form[i] == SpiralForm::kOneSided) return false;
    if (smooth.slope_step[i] && !(loop && end)) return false;
    const bool held = smooth.elements[i].kappa == before.elements[i].kappa &&
                      smooth.elements[i].theta == before.elements[i].theta;
    if (!end && i != cut && held && rests_at(before, i, loop)) return false;
  }
  return true;
}

/// The element at which a loop was cut to make its slopes equal.
std::size_t cut_of(const SeriesChain& chain, bool loop) {
  for (std::size_t i = 0; loop && i < chain.direction.size(); ++i) {
    if (rests_at(chain, i, true)) return i;
  }
  return 0;
}

/// Elements with fixed data on either side of those that are chosen again: the slope at the outer
/// one's neighbour is that of the link between them.
constexpr std::size_t kHeldSlopes = 2;

/// Equal slopes in a neighbourhood: the chain's elements there, and outside those of `smooth`.
std::optional<SeriesChain> smoothed_part(const SeriesChain& before, const SeriesChain& after,
                                         const PartWindow& window, bool loop,
                                         const SeriesChain& smooth, Watch& watch) {
  const PartWindow slice = window.widened(kHeldSlopes);
  SeriesChain part = part_of(after, slice.first, slice.last);
  part.newton_steps = 0;
  std::vector<Element> start = part.elements;
  Ends ends;
  for (std::size_t i = slice.first; i <= slice.last; ++i) {
    ends.rest.push_back(rests_at(after, i, loop));
    Element& e = start[i - slice.first];
    e.theta += smooth.elements[i].theta - before.elements[i].theta;
    e.kappa += smooth.elements[i].kappa - before.elements[i].kappa;
  }
  Slopes slopes(part, ends, watch);
  for (std::size_t i = slice.first; i <= slice.last; ++i) {
    if (!window.has(i)) slopes.hold_as(i - slice.first, smooth.elements[i]);
  }
  slopes.ask_nothing_of_held();
  SmoothedSlopes out;
  if (!slopes.run_from(start, 0, out) || !out.converged) return std::nullopt;
  return std::move(slopes).result();
}

}  // namespace

std::optional<ChangedElements> follow_changed_elements(const SeriesChain& before,
                                                       const SeriesChain& after,
                                                       const ChangedElements& changed, bool loop,
                                                       SeriesChain& smooth, Watch& watch) {
  const std::size_t cut = cut_of(before, loop);
  if (before.direction != after.direction || !made_at_once(before, smooth, loop, cut)) {
    return std::nullopt;
  }
  const std::size_t last = before.elements.size() - 1;
  for (std::size_t half = kFirstHalfWidth;; half *= 2) {
    const auto window =
        PartWindow::around(changed.first, changed.last, half, kHeldSlopes, last, loop);
    if (!window || watch.was_cancelled()) return std::nullopt;
    const PartWindow slice = window->widened(kHeldSlopes);
    if (loop && slice.has(cut)) return std::nullopt;
    auto part = smoothed_part(before, after, *window, loop, smooth, watch);
    if (!part) return std::nullopt;
    ChainSolution solved;
    solved.elements = std::move(part->elements);
    solved.links = std::move(part->links);
    turn_to(smooth.elements, slice, solved);
    if (!settled(smooth.elements, *window, slice, solved)) continue;
    for (std::size_t i = window->first; i <= window->last; ++i) {
      smooth.elements[i] = solved.elements[i - slice.first];
      if (!smooth.nodes.empty()) smooth.nodes[i] = after.nodes[i];
    }
    for (std::size_t i = slice.first; i < slice.last; ++i) {
      if (window->has(i) || window->has(i + 1)) smooth.links[i] = solved.links[i - slice.first];
    }
    return ChangedElements{window->first, window->last};
  }
}

SmoothedSlopes smooth_slopes(SeriesChain& chain, bool loop, Watch& watch, std::vector<bool> keep,
                             const NodeData& seam_data) {
  SmoothedSlopes out;
  SeriesChain given = chain;
  if (given.nodes.empty()) given.nodes.resize(given.elements.size());
  if (loop) given.nodes.front() = given.nodes.back() = seam_data;
  std::size_t seam = 0;
  bool rests_somewhere = !loop;
  for (std::size_t i = given.direction.size(); loop && i-- > 0;) {
    if (!rests_at(given, i, true)) continue;
    seam = i;
    rests_somewhere = true;
  }
  if (seam > 0) given = rotated(given, seam);
  if (seam > 0 && !keep.empty()) {
    std::rotate(keep.begin(), keep.begin() + static_cast<std::ptrdiff_t>(seam), keep.end());
  }
  const std::size_t count = given.direction.size();
  SeriesChain work = smoothed_chain(given, keep, loop, watch, out);
  const bool whole =
      work.form.size() == work.links.size() && keep.empty() &&
      std::find(work.slope_step.begin(), work.slope_step.end(), true) == work.slope_step.end();
  if (loop && rests_somewhere && whole) work = without_seam(std::move(work), watch, out);
  if (seam > 0) {
    // elements may have been put between; the seam is the one element with its source again
    std::size_t back = work.direction.size();
    for (std::size_t i = 0, old = 0; i < work.elements.size() && old <= count; ++i) {
      if (!(work.elements[i].point == given.elements[old].point)) continue;
      if (old == count - seam) back = i;
      ++old;
    }
    work = turned_back(rotated(work, back));
  }
  for (std::size_t i = 0; i < work.links.size(); ++i) {
    if (is_spiral(work, i)) work.cone[i] = Cone::kSpiral;
  }
  if (loop) {
    hold_at(work.elements.front(), work.nodes.front());
    hold_at(work.elements.back(), work.nodes.back());
  }
  if (!rests_somewhere) work.slope_step.front() = work.slope_step.back() = true;
  work.smooth = true;
  work.newton_steps = chain.newton_steps + out.newton_steps;
  work.converged = chain.converged;
  work.turned_directions = chain.turned_directions;
  work.unforced_inflection = chain.unforced_inflection;
  work.smallest_margin = 1.0;
  for (std::size_t i = 0; i < work.links.size(); ++i) {
    if (!is_spiral(work, i)) continue;
    work.smallest_margin = std::min(work.smallest_margin,
                                    cone_margin(work.links[i], work.direction[i], Cone::kSpiral));
  }
  for (const auto& s : work.source) work.free_elements += s ? 0U : 1U;
  count_joints(work, loop, out);
  chain = std::move(work);
  return out;
}

}  // namespace obvid
