// SPDX-License-Identifier: Apache-2.0
#include "slope_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace obvid::chain_detail {
namespace {

constexpr std::size_t kNodeUnknowns = SlopeSystem::kBlock;
/// The steps end when the unknowns change by no more, in units of the local turning, and the merit
/// falls no more than its rounding.
constexpr double kSettled = 1e-9;
constexpr double kMeritRounding = 1e-14;
/// The price of a gap in the merit function, against the largest multiplier (must exceed 1).
constexpr double kGapPrice = 1.5;
constexpr int kMostHalvings = 30;
/// Unknowns this near to the solution, in their units, have it to rounding as soon as steps do not
/// get shorter; the merit is rounded more coarsely than that.
constexpr double kNear = 1e-3, kShorter = 0.7;
constexpr double kAsNearAsRounding = 1e-5;
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

/// Logarithm of the units of slope, (h/2)^2, of a link over that of the link before: of a ratio, so
/// that it is the same at any size.
double slope_units(const LinkState& link, const LinkState& before) {
  return 2.0 * std::log(link.h / before.h);
}

}  // namespace

SlopeSolver::SlopeSolver(const SlopeProblem& problem, const SlopeWeights& weights)
    : problem_(problem), model_(problem.chain), weights_(weights) {}

SlopeSolver::Value SlopeSolver::evaluate(const std::vector<double>& x,
                                         std::vector<double>* gap) const {
  constexpr Value kOutside = {std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::infinity()};
  const std::size_t n = problem_.equal_slope.size();
  Value out;
  if (gap != nullptr) gap->assign(n, 0.0);
  double end_before = 0.0;
  LinkState before;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (problem_.chain.cone[i] == Cone::kNone) continue;
    const LinkState link = model_.jet(i, x).state;
    const SpiralSlopes s = spiral_slopes(link, problem_.chain.direction[i], problem_.form[i]);
    out.energy += 0.5 * (weights_.change * s.change.value * s.change.value +
                         weights_.bend * s.bend.value * s.bend.value);
    if (!std::isfinite(out.energy) || std::isnan(s.start.value + s.end.value)) return kOutside;
    if (problem_.equal_slope[i]) {
      const double c = end_before - s.start.value + slope_units(link, before);
      out.gaps += std::abs(c);
      if (gap != nullptr) (*gap)[i] = c;
    }
    end_before = s.end.value;
    before = link;
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (model_.wanted_sign(i) == 0.0) continue;
    const double room = model_.curvature_room(i, x);
    if (!(room > 0.0)) return kOutside;
    out.energy -= weights_.sign * std::log(room);
  }
  return out;
}

void SlopeSolver::assemble() {
  const std::size_t n = problem_.equal_slope.size();
  system_.reset(n);
  NodeGradient before;
  LinkState link_before;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (problem_.chain.cone[i] == Cone::kNone) continue;
    const LinkModel::LinkJet l = model_.jet(i, x_);
    const SpiralSlopes s = spiral_slopes(l.state, problem_.chain.direction[i], problem_.form[i]);
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
    const double slope = sign * unit_[node] / model_.curvature_room(node, x_);
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
    const double sigma = std::abs(model_.jet(i, x_).state.sigma);
    unit_[i] = std::min(unit_[i], sigma);
    unit_[i + 1] = std::min(unit_[i + 1], sigma);
  }
  for (double& unit : unit_) {
    if (!std::isfinite(unit)) unit = 1.0;
  }
}

void SlopeSolver::move_trial(double part) {
  const std::vector<double>& y = system_.solution();
  trial_.resize(x_.size());
  for (std::size_t i = 0; i < unit_.size(); ++i) {
    trial_[2 * i] = x_[2 * i] + part * unit_[i] * y[kNodeUnknowns * i];
    trial_[2 * i + 1] = x_[2 * i + 1] + part * unit_[i] * y[kNodeUnknowns * i + 1];
  }
}

SlopeSolver::Outcome SlopeSolver::run(const std::vector<Element>& start, int most_steps,
                                      Watch& watch) {
  Outcome out;
  x_ = model_.from_elements(start);
  set_units();
  Value value = evaluate(x_, &gap_);
  if (!std::isfinite(value.energy)) return out;
  out.valid = true;
  double price = 1.0, before = std::numeric_limits<double>::infinity();
  double gaps_before = value.gaps;
  int short_steps = 0;
  while (out.steps < most_steps && watch.spend(static_cast<double>(start.size()))) {
    assemble();
    ++out.steps;
    if (!system_.solve()) break;
    double largest = 0.0;
    for (std::size_t i = 0; i < unit_.size(); ++i) {
      const double* y = system_.solution().data() + kNodeUnknowns * i;
      largest = std::max({largest, std::abs(y[0]), std::abs(y[1])});
      if (problem_.equal_slope[i]) price = std::max(price, kGapPrice * std::abs(y[2]));
    }
    if (!std::isfinite(largest)) break;
    const bool near = std::max(largest, before) < kNear;
    if (near && !(largest < kShorter * before)) {
      out.converged = largest < kAsNearAsRounding;
      break;
    }
    before = largest;
    double part = 1.0;
    bool taken = false;
    for (int k = 0; k < kMostHalvings && !taken; ++k, part *= taken ? 1.0 : 0.5) {
      move_trial(part);
      const Value there = evaluate(trial_, nullptr);
      taken = near ? std::isfinite(there.energy)
                   : there.energy + price * there.gaps <=
                         value.energy + price * value.gaps +
                             kMeritRounding * (1.0 + std::abs(value.energy));
    }
    if (!taken) break;
    x_.swap(trial_);
    value = evaluate(x_, &gap_);
    out.converged = largest < kSettled;
    if (out.converged) break;
    if (part > kShortPart) {
      short_steps = 0;
      gaps_before = value.gaps;
    } else if (++short_steps == kMostShortSteps) {
      if (value.gaps > kHardlyClosed * gaps_before) break;
      short_steps = 0;
      gaps_before = value.gaps;
    }
  }
  for (const double gap : gap_) out.largest_gap = std::max(out.largest_gap, std::abs(gap));
  return out;
}

}  // namespace obvid::chain_detail
