// SPDX-License-Identifier: Apache-2.0
#include "tube_solver.h"

#include <cmath>
#include <limits>

namespace obvid::fairing_detail {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/// Sufficient-decrease constant of the line search (Nocedal & Wright 2006, eq. 3.4).
constexpr double kArmijo = 1e-4;
constexpr double kSmallestStep = 1e-7;   ///< of a step of Newton: shorter ones gain nothing
constexpr double kStartingRoom = 1.2;    ///< slack at the start over the needed one
constexpr double kSmallestStart = 1e-3;  ///< of the slack at the start, in link sizes
constexpr double kSlackBarrier = 0.1;    ///< starting barrier weight over the slack
constexpr double kStartingWidth = 1.15;  ///< of a widened tube over what it must hold
constexpr double kWidthBarrier = 1.0;    ///< starting barrier weight over the tube's width
constexpr double kWidthBarrierFall = 0.3;
constexpr int kWidthRounds = 16;
constexpr int kStepsPerWidth = 25;
constexpr double kSlackBarrierFall = 0.15;
constexpr double kPhaseOneEnergy = 1e-4;  ///< damper, against the barriers
constexpr int kRounds = 8;
constexpr int kStepsPerRound = 16;
constexpr double kCentred = 0.5;             ///< Newton's decrement at which a round ends
constexpr double kNegligibleBarrier = 0.05;  ///< mu over the slack: the energy no longer counts

}  // namespace

double TubeSolver::step(State& x, const Weights& w, double slack_cost) {
  const bool with_slack = slack_cost > 0.0;
  const double value = model_.merit(x, slack_, w) + slack_cost * slack_;
  if (watch_.cancelled()) return -1.0;
  model_.assemble(x, slack_, w, with_slack, system_);
  if (with_slack) system_.add_slack(slack_cost, 0.0);
  ++steps_;
  if (!watch_.spend(model_.step_work())) return -1.0;
  const double ds = system_.solve(direction_);
  const double decrement = system_.decrement(direction_, ds);
  if (!(decrement > 0.0)) return -1.0;
  trial_.resize(x.size());
  for (double t = 1.0; t > kSmallestStep && !watch_.cancelled(); t *= 0.5) {
    for (std::size_t i = 0; i < x.size(); ++i) trial_[i] = x[i] + t * direction_[i];
    const double s = slack_ + t * ds;
    const double v = model_.merit(trial_, s, w) + slack_cost * s;
    // written so that NaN counts as too large
    if (v <= value - kArmijo * t * decrement + 8.0 * kEpsilon * std::abs(value)) {
      x.swap(trial_);
      slack_ = s;
      return decrement;
    }
  }
  return -1.0;
}

Feasibility TubeSolver::find_inside(State& x) {
  const double needed = model_.needed_slack(x);
  slack_ = 0.0;
  if (needed == 0.0 && std::isfinite(model_.merit(x, 0.0, {0.0, 1.0, 0.0}))) return {true, 0.0};
  slack_ = kStartingRoom * needed + kSmallestStart;
  if (!std::isfinite(model_.merit(x, slack_, {0.0, 1.0, 1.0}))) return {false, slack_};
  const double links = static_cast<double>(model_.link_count());
  const double gap = model_.barrier_parameter() / links;
  double mu = kSlackBarrier * slack_;
  for (int round = 0; round < kRounds && watch_.may_go_on(); ++round) {
    bool centred = false;
    for (int k = 0; k < kStepsPerRound && !centred; ++k) {
      const double decrement = step(x, {kPhaseOneEnergy, 1.0, 1.0}, links / mu);
      if (slack_ <= 0.0) {
        slack_ = 0.0;
        return {std::isfinite(model_.merit(x, 0.0, {0.0, 1.0, 1.0})), 0.0};
      }
      centred = decrement < kCentred;
    }
    if (centred && slack_ > gap * mu && mu < kNegligibleBarrier * slack_) break;
    mu *= kSlackBarrierFall;
  }
  return {false, slack_};
}

bool TubeSolver::enter_tube(State& x, double energy) {
  model_.let_slack_widen_the_tube();
  slack_ = kStartingWidth * model_.tube_use(x) - 1.0;
  if (slack_ <= 0.0) return true;
  const double links = static_cast<double>(model_.link_count());
  const double gap = model_.barrier_parameter() / links;
  double mu = kWidthBarrier;
  for (int round = 0; round < kWidthRounds && watch_.may_go_on(); ++round) {
    bool centred = false;
    for (int k = 0; k < kStepsPerWidth && !centred; ++k) {
      const double decrement = step(x, {energy, 0.0, 1.0}, links / mu);
      if (slack_ < 0.0) return true;
      centred = decrement < kCentred;
    }
    if (centred && slack_ > gap * mu && mu < kNegligibleBarrier * slack_) return false;
    mu *= kWidthBarrierFall;
  }
  return false;
}

bool TubeSolver::descend(State& x, const Weights& w, double done, int most) {
  slack_ = 0.0;
  for (int k = 0; k < most; ++k) {
    if (step(x, w, 0.0) < done) return true;
  }
  return false;
}

}  // namespace obvid::fairing_detail
