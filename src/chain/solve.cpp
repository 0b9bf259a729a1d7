// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "link_model.h"
#include "obvid/chain/internal/chain.h"

namespace obvid {
namespace {

using namespace chain_detail;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/// Newton stops after a step whose predicted decrease is below this part of the barrier's own
/// scale, or that of the next one is if it only shrinks like this one: convergence is quadratic, so
/// what is left is less.
constexpr double kConverged = 1e-13;
/// Sufficient-decrease constant of the line search (Nocedal & Wright 2006, eq. 3.4).
constexpr double kArmijo = 1e-4;
constexpr double kSmallestStep = 1e-9;   ///< of a step of Newton: shorter ones gain nothing
constexpr double kStartingSlack = 1e-3;  ///< in units of each link's own size
constexpr double kStartingSlackGrowth = 2.0;
constexpr double kLargestStartingSlack = 1e12;
constexpr double kSlackBarrier = 0.02;  ///< starting barrier of phase 1, relative to the slack
constexpr double kSlackBarrierFall = 0.2;
constexpr double kPhaseOneEnergy = 0.05;  ///< damper of phase 1
constexpr int kPhaseOneRounds = 16;
constexpr int kPhaseOneSteps = 40;
constexpr double kSlackPull = 0.3;  ///< cost of the slack against the sum of all barriers
constexpr double kCentred = 0.1;    ///< Newton's decrement at which a round of phase 1 ends
/// Gap between the slack on the central path and the least one, in units of mu: barriers per link
/// (cone 2, sigma 1/2, sign 1/2) over kSlackPull (Boyd & Vandenberghe 2004, section 11.2.2).
constexpr double kDualityGap = 3.0 / kSlackPull;
constexpr double kNegligibleBarrier = 0.02;  ///< mu against the slack: the energy no longer counts

class Solver {
 public:
  Solver(const std::vector<Vec2>& points, const ChainProblem& problem, const ChainOptions& options)
      : points_(points), problem_(problem), options_(options), model_(problem) {}

  ChainSolution run(const std::vector<Element>* start) {
    x_ = start != nullptr ? model_.from_elements(*start) : model_.starting_guess();
    ChainSolution out;
    if (!phase_one()) {
      out.newton_steps = steps_;
      describe_infeasibility(out);
      return out;
    }
    phase_two();
    out.feasible = true;
    out.converged = converged_;
    out.newton_steps = steps_;
    fill(out);
    return out;
  }

  ChainSolution judge(const std::vector<Element>& elements) {
    x_ = model_.from_elements(elements);
    ChainSolution out;
    fill(out);
    out.feasible = out.smallest_margin > 0.0;
    out.converged = true;
    return out;
  }

 private:
  /// One damped Newton step for weight `barrier` and energy weight `energy`; the slack takes part
  /// when `slack_cost` > 0. Returns Newton's decrement, or a negative number when no step helps.
  double step(double energy, double barrier, double slack_cost) {
    const bool with_slack = slack_cost > 0.0;
    const double value =
        assembled_ ? *assembled_
                   : model_.assemble(x_, slack_, energy, barrier, system_) + slack_cost * slack_;
    assembled_.reset();
    system_.slack_gradient = with_slack ? system_.slack_gradient + slack_cost : 0.0;
    ++steps_;
    if (options_.watch != nullptr) options_.watch->spend(static_cast<double>(points_.size()));
    if (cancelled()) return -1.0;
    system_.solve(direction_, slack_direction_, with_slack);
    const double decrement = system_.decrement(direction_, slack_direction_);
    if (!(decrement > 0.0)) return -1.0;
    double t = 1.0;
    trial_.resize(x_.size());
    while (t > kSmallestStep) {
      if (is_to_end(options_.watch)) return -1.0;
      for (std::size_t i = 0; i < x_.size(); ++i) trial_[i] = x_[i] + t * direction_[i];
      const double s = slack_ + t * slack_direction_;
      // a whole step is taken mostly, and begins the next one
      const bool begins_next = t == 1.0 && !with_slack;
      const double v = (begins_next ? model_.assemble(trial_, s, energy, barrier, system_)
                                    : model_.merit(trial_, s, energy, barrier)) +
                       slack_cost * s;
      // the comparison is written so that NaN counts as too large
      if (v <= value - kArmijo * t * decrement + rounding_of(value)) {
        x_.swap(trial_);
        slack_ = s;
        if (begins_next) assembled_ = v;
        return decrement;
      }
      t *= t == 1.0 ? 0.5 : 0.4;
    }
    return -1.0;
  }

  /// Then whatever was found is thrown away.
  [[nodiscard]] bool cancelled() const {
    return options_.watch != nullptr && options_.watch->was_cancelled();
  }

  /// Changes of the merit function below its own rounding are no reason to refuse a step.
  static double rounding_of(double value) { return 8.0 * kEpsilon * std::abs(value); }

  bool phase_one() {
    slack_ = 0.0;
    if (model_.inside(x_, 0.0)) return true;
    slack_ = kStartingSlack;
    while (!model_.inside(x_, slack_)) {
      slack_ *= kStartingSlackGrowth;
      if (slack_ > kLargestStartingSlack) return false;
    }
    double mu = kSlackBarrier * slack_;
    for (int round = 0; round < kPhaseOneRounds; ++round) {
      bool centred = false;
      for (int k = 0; k < kPhaseOneSteps && !centred; ++k) {
        const double decrement =
            step(kPhaseOneEnergy, 1.0, kSlackPull * model_.total_weight() / mu);
        if (slack_ <= 0.0) {
          slack_ = 0.0;
          return model_.inside(x_, 0.0);
        }
        centred = decrement < kCentred;
        if (steps_ >= options_.largest_steps || cancelled()) return false;
      }
      // the least slack cannot be below this by more than the barrier's duality gap
      if (centred && slack_ > kDualityGap * mu && mu < kNegligibleBarrier * slack_) return false;
      mu *= kSlackBarrierFall;
    }
    return false;
  }

  void phase_two() {
    const double done = kConverged * model_.total_weight();
    double before = 0.0;  // none: its ratio tells nothing
    converged_ = true;
    while (steps_ < options_.largest_steps) {
      const double decrease = step(1.0, kFinalBarrier, 0.0);
      // negative: no step helps any more
      if (decrease < done || decrease * (decrease / before) < done) return;
      before = decrease;
    }
    converged_ = false;
  }

  void fill(ChainSolution& out) const {
    out.elements = model_.elements(points_, x_);
    out.links = model_.links(x_);
    out.smallest_margin = 1.0;
    for (std::size_t i = 0; i < out.links.size(); ++i) {
      if (problem_.cone[i] == Cone::kNone) continue;
      out.smallest_margin = std::min(
          out.smallest_margin, cone_margin(out.links[i], problem_.direction[i], problem_.cone[i]));
    }
  }

  void describe_infeasibility(ChainSolution& out) const {
    const std::vector<double> force = model_.link_forces(x_, slack_);
    double largest = 0.0;
    std::size_t worst = 0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      if (force[i] > largest) {
        largest = force[i];
        worst = i;
      }
    }
    constexpr double kShare = 0.1;  // links that carry at least this part of the largest force
    std::size_t first = worst, last = worst;
    while (first > 0 && force[first - 1] >= kShare * largest) --first;
    while (last + 1 < force.size() && force[last + 1] >= kShare * largest) ++last;
    out.infeasibility = {first, last + 1, slack_, slack_ * model_.point_move(worst)};
  }

  const std::vector<Vec2>& points_;
  const ChainProblem& problem_;
  const ChainOptions& options_;
  LinkModel model_;
  NewtonSystem system_;
  std::optional<double> assembled_;  ///< value at x_ of which the system is already made
  std::vector<double> x_, trial_, direction_;
  double slack_ = 0.0, slack_direction_ = 0.0;
  int steps_ = 0;
  bool converged_ = true;
};

}  // namespace

double cone_margin(const LinkState& link, int direction, Cone cone) {
  if (cone == Cone::kNone) return 1.0;
  const double d = direction;
  const double product = -link.A * link.B;
  const bool signs = d * link.A < 0.0 && d * link.B > 0.0 && d * link.sigma > 0.0;
  if (!signs) return -std::numeric_limits<double>::infinity();
  const double half = std::sin(0.5 * link.sigma);
  if (cone == Cone::kSpiral) return 1.0 - half * half / product;
  if (std::abs(link.sigma) >= 0.5 * std::numbers::pi) {
    return -std::numeric_limits<double>::infinity();
  }
  const double s = std::sin(link.sigma);
  return 1.0 - s * s / (2.0 * std::cos(link.sigma) * product);
}

ChainSolution judge_chain(const std::vector<Vec2>& points, const ChainProblem& problem,
                          const std::vector<Element>& elements) {
  return Solver(points, problem, {}).judge(elements);
}

ChainSolution solve_chain(const std::vector<Vec2>& points, const ChainProblem& problem,
                          const ChainOptions& options, const std::vector<Element>* start) {
  return Solver(points, problem, options).run(start);
}

}  // namespace obvid
