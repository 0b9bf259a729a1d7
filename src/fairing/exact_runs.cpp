// SPDX-License-Identifier: Apache-2.0
#include "obvid/fairing/internal/exact_runs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "build_tube.h"
#include "draft.h"
#include "obvid/chain/internal/series_chain.h"
#include "run_search.h"
#include "tube_solver.h"

namespace obvid {
namespace {

using namespace fairing_detail;

constexpr double kNoEnergy = std::numeric_limits<double>::infinity();
constexpr std::size_t kBefore = 5, kBeyond = 11;  ///< links of a window before and behind its place
constexpr std::size_t kStride = 8;                ///< links from one window to the next
constexpr std::size_t kReach = 3;    ///< links on each side of the trouble that are changed
constexpr int kMendsPerWindow = 12;  ///< changes of one window
constexpr std::size_t kLeastMends = 10, kLinksPerMend = 4;  ///< at the end, of the whole
constexpr double kTubeBarrier = 0.02;    ///< of free nodes in their room, in the final problem
constexpr double kRunFairEnough = 1e-6;  ///< Newton's decrement
constexpr int kRunFairSteps = 60;
constexpr int kRoughSteps = 12;  ///< towards the fairest state of a window, to compare windows
/// Headings farther from their chord than 120 degrees belong to loops.
constexpr double kLeastCosine = -0.5;
/// Least sigma over B - A of the pieces of a link: below it curvature leaps at their ends and rests
/// between them. The first where room is asked for, the second a little more than the chain refuses.
constexpr double kRoom = 2e-3, kRefused = 1.1e-3;
constexpr double kLoop = -1.0;  ///< stands for the room of a loop
/// Closed-form margin with which the chain carries a link in one piece.
constexpr double kOnePiece = 0.02;
/// Newton steps times links, some microseconds each: the search gives up beyond, within a few
/// seconds.
constexpr double kWork = 200'000.0, kWorkPerLink = 14'000.0, kMostWork = 1'000'000.0;

/// What a window of a draft came to.
struct Trial {
  double slack = kNoEnergy;  ///< 0: feasible
  double energy = kNoEnergy;
  std::size_t trouble = 0;  ///< link of the window that pushes hardest
  bool loops = false;       ///< feasible, but the curve turns away from its chord there
  State x;

  [[nodiscard]] bool feasible() const { return slack == 0.0; }
};

/// A window that grows with the nodes that are put into it.
struct GrowingWindow {
  std::size_t first = 0, beyond = 0;  ///< links before and behind it
  [[nodiscard]] Window of(const Draft& d) const { return {first, d.links() - beyond}; }
};

LinkState link_between(const NodeEnd& a, const NodeEnd& b) {
  const Vec2 chord = b.position - a.position;
  LinkState s;
  s.h = norm(chord);
  s.omega = heading(chord);
  s.alpha = turning(chord, a.tangent);
  s.beta = turning(chord, b.tangent);
  s.A = 0.5 * s.h * a.kappa + std::sin(s.alpha);
  s.B = 0.5 * s.h * b.kappa - std::sin(s.beta);
  s.sigma = s.alpha + s.beta;
  return s;
}

/// Least sigma over B - A of the one or two pieces that carry a link, or kLoop.
double room_of(const NodeEnd& a, const NodeEnd& b, std::int8_t direction) {
  const LinkState link = link_between(a, b);
  if (std::min(std::cos(link.alpha), std::cos(link.beta)) < kLeastCosine) return kLoop;
  const double whole = link.sigma / (link.B - link.A);
  if (cone_margin(link, direction, Cone::kClosedForm) >= kOnePiece) return whole;
  const Element e = free_element(link, direction, a.position);
  const NodeEnd middle{e.point, unit_at(e.theta), e.kappa};
  const LinkState first = link_between(a, middle), second = link_between(middle, b);
  return std::min({whole, first.sigma / (first.B - first.A), second.sigma / (second.B - second.A)});
}

class Mender {
 public:
  Mender(const ExactSeries& series, Watch& watch)
      : series_(series), watch_(watch), draft_(draft_of(series, watch)) {}

  ExactRuns run() {
    // counted from the end, which stays while nodes are put in before it
    const std::size_t links = draft_.links();
    for (std::size_t done = 0; done < links; done += kStride) {
      watch_.tell("searching runs", static_cast<double>(done) / static_cast<double>(links));
      const GrowingWindow window = around(draft_.links() - (links - done));
      for (int k = 0; k < kMendsPerWindow && !holds(window.of(draft_)); ++k) {
        if (!mend(window.of(draft_))) break;
      }
    }
    return finish();
  }

 private:
  [[nodiscard]] GrowingWindow around(std::size_t at, std::size_t wider = 1) const {
    return {at - std::min(at, wider * kBefore),
            draft_.links() - std::min(draft_.links(), at + wider * kBeyond)};
  }

  Trial attempt(const Draft& draft, Window window, int fair_steps) {
    const Draft part = part_of(draft, window);
    Trial out = attempt_from(part.x, part, fair_steps);
    if (!std::isfinite(out.energy)) {
      Trial other = attempt_from(part.plain, part, fair_steps);
      if (std::isfinite(other.energy)) return other;
    }
    return out;
  }

  Trial attempt_from(State x, const Draft& part, int fair_steps) {
    TubeModel model(part.tube, part.direction, Cone::kSpiral, kFairEnergy);
    TubeSolver solver(model, watch_);
    Trial out;
    const Feasibility f = solver.find_inside(x);
    if (f.feasible) {
      const Weights weights{1.0, kFinalBarrier, kTubeBarrier};
      solver.descend(x, weights, kRunFairEnough, fair_steps);
      out.slack = 0.0;
      out.energy = model.merit(x, 0.0, weights);
      judge(part, x, out);
    } else {
      out.slack = f.slack;
      const std::vector<double> force = model.link_forces(x, f.slack);
      out.trouble =
          static_cast<std::size_t>(std::max_element(force.begin(), force.end()) - force.begin());
    }
    steps_ += solver.steps();
    work_ += static_cast<double>(solver.steps()) * static_cast<double>(part.links());
    out.x = std::move(x);
    return out;
  }

  /// Names the link that is carried worst, if one leaps, hardly lies in its cone or loops.
  void judge(const Draft& part, const State& x, Trial& trial) const {
    double least = series_.with_room ? kRoom : kRefused;
    for (std::size_t i = 0; i < part.links(); ++i) {
      const NodeEnd a = place(part.tube.nodes[i], &x[kPerNode * i]).out;
      const NodeEnd b = place(part.tube.nodes[i + 1], &x[kPerNode * (i + 1)]).in;
      const double room = room_of(a, b, part.direction[i]);
      if (room >= least) continue;
      least = room;
      trial.slack = std::numeric_limits<double>::min();
      trial.trouble = i;
      trial.loops = room == kLoop;
    }
  }

  /// Whether the window holds as it is; where it does, its state is kept to begin with.
  bool holds(Window window) {
    last_ = attempt(draft_, window, kRoughSteps);
    if (!last_.feasible()) return false;
    std::copy(last_.x.begin(), last_.x.end(),
              draft_.x.begin() + static_cast<std::ptrdiff_t>(kPerNode * window.first));
    return true;
  }

  [[nodiscard]] bool worn_out() const {
    return !watch_.may_go_on() ||
           work_ > std::min(kMostWork,
                            kWork + kWorkPerLink * static_cast<double>(series_.points.size()));
  }

  /// Changes the directions around the trouble that `last_` names. False when nothing helps.
  bool mend(Window window) {
    if (worn_out()) return false;
    const Draft part = part_of(draft_, window);
    const std::size_t trouble = last_.trouble;
    const std::size_t first = trouble - std::min(trouble, kReach);
    const std::size_t last = std::min(part.links(), trouble + kReach + 1);
    best_ = last_;
    best_part_ = {};
    best_vertices_ = std::numeric_limits<int>::max();
    for (const Change change : {Change::kTurn, Change::kSplit, Change::kSplitTwice}) {
      for (std::size_t i = first; i < last; ++i) {
        for (Draft& changed_part : changed(part, change, i)) {
          consider(std::move(changed_part), window);
        }
      }
      if (best_.feasible() && change != Change::kTurn) break;
    }
    if (best_part_.direction.empty() && !last_.loops) {  // several links are in the way
      best_.slack = kNoEnergy;
      for (Draft& split : changed(part, Change::kSplitTwice, trouble)) {
        consider(std::move(split), window);
      }
    }
    if (best_part_.direction.empty()) return false;
    if (best_.feasible()) best_part_.x = best_.x;
    splice(draft_, window, std::move(best_part_));
    return true;
  }

  void consider(Draft part, Window window) {
    const int vertices = vertices_with_neighbours(part, window);
    if (worn_out() || (best_.feasible() && vertices > best_vertices_)) return;
    Trial trial = attempt(part, {0, part.links()}, kRoughSteps);
    const bool better = trial.feasible() != best_.feasible() ? trial.feasible()
                        : !trial.feasible()                  ? trial.slack < best_.slack
                        : vertices != best_vertices_         ? vertices < best_vertices_
                                                             : trial.energy < best_.energy;
    if (!better) return;
    best_ = std::move(trial);
    best_vertices_ = vertices;
    best_part_ = std::move(part);
  }

  /// Changes of direction inside a part and towards the links before and behind its window.
  [[nodiscard]] int vertices_with_neighbours(const Draft& part, Window window) const {
    std::vector<std::int8_t> all = part.direction;
    if (window.first > 0) all.insert(all.begin(), draft_.direction[window.first - 1]);
    if (window.last < draft_.links()) all.push_back(draft_.direction[window.last]);
    return vertices_of(all);
  }

  ExactRuns finish() {
    const std::size_t mends = kLeastMends + draft_.links() / kLinksPerMend;
    std::set<std::size_t> seen;
    std::size_t wider = 1;
    for (std::size_t k = 0; k <= mends; ++k) {
      const Window whole{0, draft_.links()};
      last_ = attempt(draft_, whole, kRunFairSteps);
      if (last_.feasible() || k == mends) break;
      // a window that holds promises too much when the whole fails there again
      const std::size_t trouble = last_.trouble;
      wider = seen.insert(point_before(trouble)).second ? 1 : std::min(2 * wider, draft_.links());
      const Window here = around(trouble, wider).of(draft_);
      last_.trouble = trouble - here.first;
      if (!mend(here)) break;
    }
    return result();
  }

  [[nodiscard]] std::size_t point_before(std::size_t node) const {
    while (!draft_.source[node]) --node;
    return *draft_.source[node];
  }

  ExactRuns result() {
    ExactRuns out;
    out.feasible = std::isfinite(last_.energy);
    out.newton_steps = steps_;
    out.source = draft_.source;
    out.direction = draft_.direction;
    for (std::size_t i = 0; i < draft_.tube.nodes.size(); ++i) {
      const TubeNode& n = draft_.tube.nodes[i];
      const double* x = &last_.x[kPerNode * i];
      const NodeEnd end = place(n, x).in;
      const Vec2 point =
          out.source[i] ? series_.points[*out.source[i]] : draft_.tube.origin + end.position;
      out.elements.push_back({point, n.theta + x[1], end.kappa});
      if (i <= last_.trouble && out.source[i]) out.trouble = *out.source[i];
    }
    return out;
  }

  const ExactSeries& series_;
  Watch& watch_;
  Draft draft_, best_part_;
  Trial last_, best_;
  int best_vertices_ = 0;
  int steps_ = 0;
  double work_ = 0.0;
};

}  // namespace

ExactRuns exact_runs(const ExactSeries& series, Watch& watch) {
  return Mender(series, watch).run();
}

}  // namespace obvid
