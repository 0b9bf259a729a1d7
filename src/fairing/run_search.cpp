// SPDX-License-Identifier: Apache-2.0
#include "run_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "obvid/series/analysis.h"
#include "tube_solver.h"

namespace obvid::fairing_detail {
namespace {

constexpr std::size_t kContext = 8;  ///< links beside a change that are looked at, at least
constexpr int kRunsBeside = 2;       ///< and whole runs
/// Runs stronger than this cannot be flattened by moves of one reach: a bump of curvature K over a
/// length L leaves the nearest monotone curve by K L^2 / 500 or more.
constexpr double kHopeless = 2000.0;
constexpr int kMostAtOnce = 3;  ///< pairs of runs that are swallowed at once
constexpr int kMostMends = 4;
/// Work of the search and of each attempt to mend its outcome, in steps on every node; few nodes
/// have more to spare.
constexpr double kSearchSteps = 3000.0, kMendSteps = 500.0;
constexpr double kSpareWork = 2e5;

void fill(Layout& layout, std::size_t from, std::size_t to, std::int8_t sign) {
  std::fill(layout.begin() + static_cast<std::ptrdiff_t>(from),
            layout.begin() + static_cast<std::ptrdiff_t>(to), course(sign));
}

}  // namespace

/// Curvature along the smooth curve: of the circles through neighbouring nodes, and of primitives.
std::vector<double> RunSearch::smooth_curvatures() const {
  const std::size_t n = tube_.nodes.size();
  std::vector<Vec2> points;
  std::vector<std::size_t> place_of(n);
  const auto add = [&](std::size_t i) {
    const PlacedNode p = place(tube_.nodes[i], &smooth_[kPerNode * i]);
    place_of[i] = points.size();
    points.push_back(p.in.position);
    if (tube_.nodes[i].is_primitive()) points.push_back(p.out.position);
  };
  if (tube_.closed) add(n - 1);
  for (std::size_t i = 0; i < n; ++i) add(i);
  if (tube_.closed) {
    const std::size_t first = place_of.front();
    add(0);
    place_of.front() = first;
  }
  const std::vector<AdjacentCircle> circles = measure_circles(points, measure_chords(points));
  std::vector<double> kappa(n);
  for (std::size_t i = 0; i < n; ++i) {
    const TubeNode& node = tube_.nodes[i];
    kappa[i] = node.is_primitive() ? node.kappa + smooth_[kPerNode * i + 2] / node.length
                                   : circles[place_of[i]].kappa;
  }
  return kappa;
}

Layout RunSearch::smooth_layout() const {
  const std::size_t n = tube_.nodes.size(), links = tube_.links();
  const std::vector<double> kappa = smooth_curvatures();
  Layout layout(links);
  for (std::size_t i = 0; i < links; ++i) {
    layout[i] = course(kappa[(i + 1) % n] >= kappa[i] ? 1 : -1);
  }
  if (tube_.closed || links < 3) return layout;
  // the circles at the ends are their neighbours'
  if (!tube_.nodes.front().is_primitive() && !tube_.nodes[1].is_primitive()) layout[0] = layout[1];
  if (!tube_.nodes.back().is_primitive() && !tube_.nodes[n - 2].is_primitive()) {
    layout[links - 1] = layout[links - 2];
  }
  return layout;
}

std::vector<RunSearch::Run> RunSearch::runs_of(const Layout& layout) const {
  std::vector<Run> out;
  const std::size_t n = tube_.nodes.size();
  const auto kappa = [&](std::size_t i) {
    return tube_.nodes[i % n].kappa + smooth_[kPerNode * (i % n) + 2] / tube_.nodes[i % n].length;
  };
  for (std::size_t i = 0; i < layout.size();) {
    std::size_t j = i;
    double reach = 0.0;
    while (j < layout.size() && layout[j] == layout[i]) {
      reach = std::max(reach, tube_.nodes[j++].reach);
    }
    const Vec2 span = tube_.nodes[j % n].point - tube_.nodes[i].point;
    const double bump = std::abs(kappa(j) - kappa(i)) * dot(span, span);
    out.push_back({i, j, reach > 0.0 ? bump / reach : std::numeric_limits<double>::infinity()});
    i = j;
  }
  return out;
}

/// The links around a change, with whole runs on both sides.
Window RunSearch::neighbourhood(const Layout& layout, std::size_t from, std::size_t to) const {
  std::size_t lo = from > kContext ? from - kContext : 0;
  std::size_t hi = std::min(layout.size(), to + kContext);
  for (int left = kRunsBeside; lo > 0 && (layout[lo - 1] == layout[lo] || --left > 0);) --lo;
  for (int right = kRunsBeside;
       hi < layout.size() && (layout[hi] == layout[hi - 1] || --right > 0);) {
    ++hi;
  }
  return {lo, hi};
}

/// Slack that a window needs; 0 when it is feasible.
double RunSearch::slack_of(Window window, const Layout& layout) {
  LaidTube laid = lay_out(tube_, smooth_, window, layout);
  TubeModel model(laid.tube, laid.direction, kSearchCone, kFairEnergy);
  TubeSolver solver(model, watch_);
  const Feasibility f = solver.find_inside(laid.start);
  steps_ += solver.steps();
  ++solves_;
  return f.feasible ? 0.0 : f.slack;
}

bool RunSearch::accept(Layout& layout, const Layout& trial, std::size_t from, std::size_t to) {
  if (slack_of(neighbourhood(trial, from, to), trial) > 0.0) return false;
  layout = trial;
  return true;
}

/// One pass over all runs, weakest first: each takes the direction of its neighbours if it can.
bool RunSearch::drop_weakest(Layout& layout, int enough) {
  std::vector<Run> runs = runs_of(layout);
  std::sort(runs.begin(), runs.end(),
            [](const Run& a, const Run& b) { return a.strength < b.strength; });
  int vertices = count_vertices(layout, tube_.closed);
  bool changed = false;
  for (const Run& run : runs) {
    if (vertices <= enough || run.strength > kHopeless || !watch_.may_go_on()) break;
    const bool begins = run.first == 0 || layout[run.first - 1] != layout[run.first];
    const bool ends = run.last == layout.size() || layout[run.last] != layout[run.last - 1];
    if (!begins || !ends) continue;  // it has grown together with a neighbour
    Layout trial = layout;
    fill(trial, run.first, run.last, static_cast<std::int8_t>(-first_direction(layout[run.first])));
    if (!accept(layout, trial, run.first, run.last)) continue;
    vertices = count_vertices(layout, tube_.closed);
    changed = true;
  }
  return changed;
}

/// Every run takes in several of the following ones at once: what cannot vanish alone can together.
bool RunSearch::swallow(Layout& layout, int enough) {
  bool changed = false;
  for (std::size_t k = 0; count_vertices(layout, tube_.closed) > enough && watch_.may_go_on();
       ++k) {
    const std::vector<Run> runs = runs_of(layout);
    if (k >= runs.size()) break;
    for (int many = 2; many <= kMostAtOnce; ++many) {
      const std::size_t last = k + 2 * static_cast<std::size_t>(many);
      if (last >= runs.size()) break;
      Layout trial = layout;
      fill(trial, runs[k].last, runs[last].last, first_direction(layout[runs[k].first]));
      if (!accept(layout, trial, runs[k].last, runs[last].last)) continue;
      changed = true;
      break;
    }
  }
  return changed;
}

void RunSearch::solve_whole(Runs& runs) {
  LaidTube laid = lay_out(tube_, smooth_, {0, tube_.links()}, runs.layout);
  TubeModel model(laid.tube, laid.direction, kSearchCone, kFairEnergy);
  TubeSolver solver(model, watch_);
  const Feasibility f = solver.find_inside(laid.start);
  steps_ += solver.steps();
  ++solves_;
  runs.vertices = count_vertices(runs.layout, tube_.closed);
  runs.feasible = f.feasible;
  runs.slack = f.slack;
  if (f.feasible) return;
  const std::vector<double> force = model.link_forces(laid.start, f.slack);
  const auto worst =
      static_cast<std::size_t>(std::max_element(force.begin(), force.end()) - force.begin());
  for (std::size_t i = 0; i <= worst; ++i) runs.trouble = laid.node[i].value_or(runs.trouble);
}

/// Changes the courses around the link that keeps the whole from being feasible: moves a switch,
/// puts a vertex inside a link, or turns a link; the change that needs the fewest vertices, then
/// the least slack. False when none of them helps the neighbourhood.
bool RunSearch::mend(Runs& runs) {
  constexpr std::size_t kAround = 4;  // links on each side of the trouble
  const std::size_t links = tube_.links();
  const std::size_t first = runs.trouble > kAround ? runs.trouble - kAround : 0;
  const std::size_t last = std::min(links, runs.trouble + kAround + 1);
  const Window window = neighbourhood(runs.layout, first, last);
  double least = slack_of(window, runs.layout);
  int fewest = count_vertices(runs.layout, tube_.closed);
  const double needed = least;
  Layout best;
  for (std::size_t i = first; i < last; ++i) {
    for (const Course c :
         {Course::kFalls, Course::kRises, Course::kFallsThenRises, Course::kRisesThenFalls}) {
      if (c == runs.layout[i]) continue;
      Layout trial = runs.layout;
      trial[i] = c;
      const int vertices = count_vertices(trial, tube_.closed);
      const bool solved = !best.empty() && least == 0.0;
      if (solved && vertices >= fewest) continue;
      const double slack = slack_of(window, trial);
      const bool better = slack == 0.0 || (!solved && slack < least);
      if (!better) continue;
      least = slack;
      fewest = vertices;
      best = trial;
    }
  }
  if (best.empty() || (needed > 0.0 && least >= needed)) return false;
  runs.layout = best;
  return true;
}

Runs RunSearch::search(int enough) {
  const auto work = [&](double steps) {
    return kSpareWork + steps * static_cast<double>(tube_.nodes.size());
  };
  Runs runs;
  runs.layout = smooth_layout();
  {
    const Allowance allowance(watch_, work(kSearchSteps));
    while (count_vertices(runs.layout, tube_.closed) > enough && watch_.may_go_on()) {
      if (drop_weakest(runs.layout, enough)) continue;
      if (!swallow(runs.layout, enough)) break;
    }
  }
  solve_whole(runs);
  for (int k = 0; k < kMostMends && !runs.feasible; ++k) {
    const Allowance allowance(watch_, work(kMendSteps));
    if (!mend(runs)) break;
    solve_whole(runs);
  }
  return runs;
}

}  // namespace obvid::fairing_detail
