// SPDX-License-Identifier: Apache-2.0
#include "slope_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace obvid::chain_detail {
namespace {

constexpr std::size_t kNodeUnknowns = SlopeSystem::kBlock;
/// The steps end with one of Newton's own that changes the unknowns by no more, in units of the
/// local turning: behind it slopes differ by its square, and the chain is the fairest to a part of
/// it.
constexpr double kSettled = 1e-6;
/// The same where the step is larger and this is left behind it, if it shrinks like the one before.
constexpr double kForetold = 1e-9;
constexpr double kMeritRounding = 1e-14;  ///< of the energy, what sums of it are rounded by
/// The price of a gap in the merit function, against the largest multiplier (must exceed 1).
constexpr double kGapPrice = 1.5;
constexpr int kMostHalvings = 30;
/// Unknowns this near to the solution, in their units, have it to rounding as soon as steps do not
/// get shorter; the merit is rounded more coarsely than that.
constexpr double kNear = 1e-3, kShorter = 0.7;
constexpr double kAsNearAsRounding = 1e-5;
/// Steps that shrink to less than this part of the one before need no help.
constexpr double kQuickly = 0.1;
/// Steps of which the next one is foretold. One counts if so much of its square is new.
constexpr std::size_t kRemembered = 2;
constexpr double kOfItsOwn = 1e-8;
/// So many steps of at most this part each, in which the gaps hardly close, lead nowhere.
constexpr int kMostShortSteps = 10;
constexpr double kShortPart = 0.02, kHardlyClosed = 0.98;

/// A number with its derivatives by heading and curvature at both ends of a link, in units.
struct NodeGradient {
  double value = 0.0;
  std::array<double, 4> by{};
};

NodeGradient by_unknowns(const LinkGradient& g, const LinkModel::LinkJet& l, double d,
                         double unit_a, double unit_b) {
  return {g.value,
          {d * (g.by_A * l.A_by_phi + g.by_sigma) * unit_a, d * g.by_A * l.A_by_p * unit_a,
           d * (g.by_B * l.B_by_phi + g.by_sigma) * unit_b, d * g.by_B * l.B_by_p * unit_b}};
}

/// Places of the unknowns of a link in the system.
std::array<std::size_t, 4> places(std::size_t link) {
  const std::size_t a = kNodeUnknowns * link, b = a + kNodeUnknowns;
  return {a, a + 1, b, b + 1};
}

/// Place in the system of a heading or curvature.
std::size_t unknown(std::size_t i) { return kNodeUnknowns * (i / 2) + i % 2; }

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}
void add(double share, const std::vector<double>& a, std::vector<double>& to) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += share * a[i];
}

/// Logarithm of the units of slope, (h/2)^2, of a link over that of the link before: of a ratio, so
/// that it is the same at any size.
double slope_units(const LinkState& link, const LinkState& before) {
  return 2.0 * std::log(link.h / before.h);
}

}  // namespace

SlopeSolver::SlopeSolver(const SlopeProblem& problem, const SlopeWeights& weights)
    : problem_(problem), model_(problem.chain), weights_(weights) {}

void SlopeSolver::evaluate(Place& place) const {
  const auto outside = [&] { place.energy = place.gaps = std::numeric_limits<double>::infinity(); };
  const std::size_t n = problem_.equal_slope.size();
  place.energy = place.gaps = 0.0;
  place.gap.assign(n, 0.0);
  place.jet.resize(n);
  place.slopes.resize(n);
  double end_before = 0.0;
  LinkState before;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (problem_.chain.cone[i] == Cone::kNone) continue;
    place.jet[i] = model_.jet(i, place.x);
    const LinkState& link = place.jet[i].state;
    const SpiralSlopes& s = place.slopes[i] =
        spiral_slopes(link, problem_.chain.direction[i], problem_.form[i]);
    place.energy += 0.5 * (weights_.change * s.change.value * s.change.value +
                           weights_.bend * s.bend.value * s.bend.value);
    if (!std::isfinite(place.energy) || std::isnan(s.start.value + s.end.value)) return outside();
    if (problem_.equal_slope[i]) {
      const double c = end_before - s.start.value + slope_units(link, before);
      place.gaps += std::abs(c);
      place.gap[i] = c;
    }
    end_before = s.end.value;
    before = link;
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (model_.wanted_sign(i) == 0.0) continue;
    const double room = model_.curvature_room(i, place.x);
    if (!(room > 0.0)) return outside();
    place.energy -= weights_.sign * std::log(room);
  }
}

void SlopeSolver::assemble() {
  const std::size_t n = problem_.equal_slope.size();
  system_.reset(n);
  NodeGradient before;
  LinkState link_before;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (problem_.chain.cone[i] == Cone::kNone) continue;
    const LinkModel::LinkJet& l = here_.jet[i];
    const SpiralSlopes& s = here_.slopes[i];
    const auto graded = [&](const LinkGradient& g) {
      return by_unknowns(g, l, problem_.chain.direction[i], unit_[i], unit_[i + 1]);
    };
    const NodeGradient change = graded(s.change), bend = graded(s.bend), start = graded(s.start);
    const std::array<std::size_t, 4> at = places(i);
    for (std::size_t a = 0; a < 4; ++a) {
      const double by_change = weights_.change * change.by[a], by_bend = weights_.bend * bend.by[a];
      system_.right(at[a]) -= by_change * change.value + by_bend * bend.value;
      for (std::size_t b = 0; b < 4; ++b) {
        system_.at(at[a], at[b]) += by_change * change.by[b] + by_bend * bend.by[b];
      }
    }
    if (problem_.equal_slope[i]) {
      const std::size_t row = kNodeUnknowns * i + 2;
      const std::array<std::size_t, 4> was = places(i - 1);
      system_.right(row) = start.value - before.value - slope_units(l.state, link_before);
      for (std::size_t a = 0; a < 4; ++a) {
        system_.at(row, was[a]) += before.by[a];
        system_.at(was[a], row) += before.by[a];
        system_.at(row, at[a]) -= start.by[a];
        system_.at(at[a], row) -= start.by[a];
      }
    }
    before = graded(s.end);
    link_before = l.state;
  }
  for (std::size_t i = 0; i < n; ++i) add_sign_and_fixed(i);
}

void SlopeSolver::add_sign_and_fixed(std::size_t node) {
  const std::size_t heading = kNodeUnknowns * node, curvature = heading + 1,
                    multiplier = heading + 2;
  if (const double sign = model_.wanted_sign(node); sign != 0.0) {
    const double slope = sign * unit_[node] / model_.curvature_room(node, here_.x);
    system_.right(curvature) += weights_.sign * slope;
    system_.at(curvature, curvature) += weights_.sign * slope * slope;
  }
  // a node between links without spirals takes part in nothing: keep its rows regular
  const bool idle = system_.at(heading, heading) == 0.0;
  if (idle || model_.heading_fixed(node)) system_.fix(heading);
  if (idle || model_.curvature_fixed(node)) system_.fix(curvature);
  if (!problem_.equal_slope[node]) system_.fix(multiplier);
}

/// The local turning: without it the equations of dense and of coarse parts would not be
/// comparable.
void SlopeSolver::set_units() {
  const std::size_t n = problem_.equal_slope.size();
  unit_.assign(n, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (problem_.chain.cone[i] == Cone::kNone) continue;
    const double sigma = std::abs(model_.jet(i, here_.x).state.sigma);
    unit_[i] = std::min(unit_[i], sigma);
    unit_[i + 1] = std::min(unit_[i + 1], sigma);
  }
  for (double& unit : unit_) {
    if (!std::isfinite(unit)) unit = 1.0;
  }
}

void SlopeSolver::move_trial(double part) {
  const std::vector<double>& y = system_.solution();
  const std::vector<double>& x = here_.x;
  trial_.x.resize(x.size());
  for (std::size_t i = 0; i < unit_.size(); ++i) {
    trial_.x[2 * i] = x[2 * i] + part * unit_[i] * y[kNodeUnknowns * i];
    trial_.x[2 * i + 1] = x[2 * i + 1] + part * unit_[i] * y[kNodeUnknowns * i + 1];
  }
}

/// Gauss-Newton's steps shrink, or swing to and fro, by much the same parts each: the last few tell
/// them, and where they end (Anderson 1965, "Iterative procedures for nonlinear integral
/// equations").
void SlopeSolver::extrapolate_trial() {
  std::vector<double> left = step_;  // what the steps before do not explain
  std::vector<double> back(step_.size(), 0.0);
  std::vector<std::vector<double>> change, move;
  for (const Step& past : past_) {
    change.emplace_back(step_);
    move.emplace_back(past.move);
    for (std::size_t i = 0; i < step_.size(); ++i) {
      change.back()[i] -= past.step[i];
      move.back()[i] += change.back()[i];
    }
    const double whole = dot(change.back(), change.back());
    for (std::size_t k = 0; k + 1 < change.size(); ++k) {  // Gram and Schmidt
      const double share = dot(change[k], change.back()) / dot(change[k], change[k]);
      add(-share, change[k], change.back());
      add(-share, move[k], move.back());
    }
    const double square = dot(change.back(), change.back());
    if (!(square > kOfItsOwn * whole)) {
      change.pop_back();
      move.pop_back();
      continue;
    }
    const double share = dot(change.back(), left) / square;
    add(-share, change.back(), left);
    add(share, move.back(), back);
  }
  for (std::size_t i = 0; i < back.size(); ++i) trial_.x[i] -= unit_[i / 2] * back[i];
}

void SlopeSolver::remember_step() {
  Step now{step_, std::vector<double>(step_.size())};
  for (std::size_t i = 0; i < step_.size(); ++i) {
    now.move[i] = (trial_.x[i] - here_.x[i]) / unit_[i / 2];
  }
  for (Step& past : past_) add(1.0, now.move, past.move);  // up to the place where the next begins
  past_.insert(past_.begin(), std::move(now));
  if (past_.size() > kRemembered) past_.pop_back();
}

SlopeSolver::Outcome SlopeSolver::run(const std::vector<Element>& start, int most_steps,
                                      Watch& watch) {
  Outcome out;
  here_.x = model_.from_elements(start);
  set_units();
  evaluate(here_);
  if (!std::isfinite(here_.energy)) return out;
  out.valid = true;
  double price = 1.0, before = std::numeric_limits<double>::infinity();
  double gaps_before = here_.gaps;
  int short_steps = 0;
  bool extrapolates = true, plain = false;
  past_.clear();
  while (out.steps < most_steps && watch.spend(static_cast<double>(start.size()))) {
    assemble();
    ++out.steps;
    if (watch.cancelled() || !system_.solve() || watch.cancelled()) break;
    step_.resize(here_.x.size());
    for (std::size_t i = 0; i < step_.size(); ++i) step_[i] = system_.solution()[unknown(i)];
    double largest = 0.0;
    for (std::size_t i = 0; i < unit_.size(); ++i) {
      const double* y = system_.solution().data() + kNodeUnknowns * i;
      largest = std::max({largest, std::abs(y[0]), std::abs(y[1])});
      if (problem_.equal_slope[i]) price = std::max(price, kGapPrice * std::abs(y[2]));
    }
    if (!std::isfinite(largest)) break;
    const bool near = std::max(largest, before) < kNear;
    if (near && !(largest < kShorter * before)) {
      if (!extrapolates || past_.empty()) {
        out.converged = largest < kAsNearAsRounding;
        break;
      }
      extrapolates = false;
    }
    const bool creeps = !(largest < kQuickly * before);
    const bool settles =
        largest < kSettled || (plain && !creeps && largest * (largest / before) < kForetold);
    before = largest;
    const auto falls = [&] {
      evaluate(trial_);
      return near ? std::isfinite(trial_.energy)
                  : trial_.energy + price * trial_.gaps <=
                        here_.energy + price * here_.gaps +
                            kMeritRounding * (1.0 + std::abs(here_.energy));
    };
    double part = 1.0;
    bool taken = false;
    // the last step is one of Newton's own, which closes the gaps
    if (extrapolates && creeps && !past_.empty() && !settles) {
      move_trial(part);
      extrapolate_trial();
      taken = falls();
    }
    plain = !taken;
    for (int k = 0; k < kMostHalvings && !taken && !watch.cancelled();
         ++k, part *= taken ? 1.0 : 0.5) {
      move_trial(part);
      taken = falls();
    }
    if (!taken) break;
    if (extrapolates) remember_step();
    std::swap(here_, trial_);
    out.converged = settles;
    if (out.converged) break;
    if (part > kShortPart) {
      short_steps = 0;
      gaps_before = here_.gaps;
    } else if (++short_steps == kMostShortSteps) {
      if (here_.gaps > kHardlyClosed * gaps_before) break;
      short_steps = 0;
      gaps_before = here_.gaps;
    }
  }
  for (const double gap : here_.gap) out.largest_gap = std::max(out.largest_gap, std::abs(gap));
  return out;
}

}  // namespace obvid::chain_detail
