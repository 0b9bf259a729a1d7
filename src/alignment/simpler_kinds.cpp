// SPDX-License-Identifier: Apache-2.0
#include "simpler_kinds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace obvid::alignment {
namespace {

/// Standard deviations of the scatter of points: what is off by more is shown by them.
constexpr double kShown = 4.0;
constexpr double kHopeless = 4.0;  ///< estimated squares over the most that there can be

/// A condition at an element or at the joint before the next one.
struct Condition {
  std::size_t element = 0;
  int a = 0, b = Chain::kStraight;
  double growth = 0.0;
  double room = 0.0;  ///< the most that squares within the tolerances can be
  bool of_joint = false;
};

class KindsTaker {
 public:
  KindsTaker(ChainOnPoints& chain, bool constant, const RunContext& run)
      : chain_(chain), constant_(constant), run_(run) {}

  Result<bool> take() {
    for (std::size_t k = 0; k < chain_.size(); ++k) add_conditions(k);
    OBVID_TRY(estimate());
    std::stable_sort(conditions_.begin(), conditions_.end(),
                     [](const Condition& a, const Condition& b) {
                       return std::tie(a.of_joint, a.growth) < std::tie(b.of_joint, b.growth);
                     });
    // What the scatter of the points leaves open goes first, and there an element that is an arc or
    // a line before a joint without a step: where both are possible, but not together, the step is
    // what was built. What the points show not to be so, though the tolerance allows it, goes by
    // what it costs: a transition is no arc because it may be one.
    const double shown = kShown * kShown * chain_.scatter();
    const auto taken = take_those_within(shown);
    OBVID_TRY(taken);
    if (*taken || !std::isfinite(shown)) return *taken;
    std::stable_sort(conditions_.begin(), conditions_.end(),
                     [](const Condition& a, const Condition& b) { return a.growth < b.growth; });
    return take_those_within(std::numeric_limits<double>::infinity());
  }

 private:
  Result<bool> take_those_within(double most) {
    bool taken = false;
    for (std::size_t i = 0; i < conditions_.size(); ++i) {
      const double done = static_cast<double>(i) / static_cast<double>(conditions_.size());
      OBVID_TRY(tell(run_, "kinds", done));
      Condition& c = conditions_[i];
      if (c.growth <= std::min(most, kHopeless * c.room)) taken = take(c, most) || taken;
    }
    return taken;
  }

  void add(std::size_t element, int a, int b, bool of_joint = false) {
    if (a == b) return;
    if (a == Chain::kStraight) std::swap(a, b);
    conditions_.push_back({element, a, b, 0.0, 0.0, of_joint});
  }

  void add_conditions(std::size_t k) {
    const auto [k0, k1] = chain_.chain().ends[k];
    add(k, k0, k1);
    if (k0 == k1 && k0 != Chain::kStraight) add(k, k0, Chain::kStraight);
    if (constant_) return;  // arcs without a step between them are one: merging tries that
    if (k0 != k1) add_straight_ends(k);
    if (k + 1 < chain_.size()) add(k, k1, chain_.chain().ends[k + 1][0], true);
  }

  /// An end behind an inflection that is nearer to it than elements are long: LandXML would have a
  /// spiral of its own there.
  void add_straight_ends(std::size_t k) {
    const Chain& chain = chain_.chain();
    const double k0 = chain.curvature(k, 0), k1 = chain.curvature(k, 1);
    if (!(k0 * k1 < 0.0)) return;
    const double least = chain_.limits().least_length;
    const double before = k0 / (k0 - k1) * chain.length[k];
    if (before < least) add(k, chain.ends[k][0], Chain::kStraight);
    if (chain.length[k] - before < least) add(k, chain.ends[k][1], Chain::kStraight);
  }

  [[nodiscard]] std::pair<std::size_t, std::size_t> around(std::size_t element) const {
    return {element - std::min(element, kBeside), std::min(element + kBeside + 2, chain_.size())};
  }

  Result<void> estimate() {
    for (Condition& c : conditions_) {
      OBVID_TRY(may_go_on(run_));
      const auto [first, last] = around(c.element);
      const ChainWindow window = chain_.cut(first, last);
      c.room = static_cast<double>(window.points.size());
      c.growth = std::numeric_limits<double>::infinity();
      if (window.points.empty()) continue;
      const auto own = [&](int number) {
        if (number == Chain::kStraight) return number;
        const auto& numbers = window.number;
        return static_cast<int>(std::find(numbers.begin(), numbers.end(), number) -
                                numbers.begin());
      };
      c.growth = growth_of(window.own.chain, window.points, window.tolerance, window.own.feet,
                           window.held, own(c.a), own(c.b));
    }
    return {};
  }

  /// With squares that grow by no more than `most`; otherwise by how much it would be is noted.
  bool take(Condition& c, double most) {
    const Chain& chain = chain_.chain();
    if (!is_used(chain, c.a) || (c.b != Chain::kStraight && !is_used(chain, c.b))) return false;
    const auto [first, last] = around(c.element);
    if (chain_.is_used_outside(chain, c.a, first, last)) return false;
    FootedChain next = chain_.now();
    if (c.b != Chain::kStraight && !chain_.is_used_outside(chain, c.b, first, last)) {
      const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
      next.chain.kappa[b] = 0.5 * (next.chain.kappa[a] + next.chain.kappa[b]);
    }
    for (auto& ends : next.chain.ends) {
      for (int& number : ends) {
        if (number == c.a) number = c.b;
      }
    }
    ChainWindow window = chain_.cut(next, first, last, chain.joints(), last);
    window.held.hopeless = kNoWayBack;
    const double before = squares_of(window);
    const Fitted fitted = chain_.fit(window);
    if (fitted.squares - before > most) {
      c.growth = std::max(c.growth, fitted.squares - before);
      return false;
    }
    return fitted.largest <= 1.0 && chain_.commit(std::move(next), window);
  }

  /// Sum of squared offsets over tolerances, as the chain is.
  [[nodiscard]] double squares_of(const ChainWindow& window) const {
    double out = 0.0;
    for (const std::size_t i : window.numbers) {
      const double share = chain_.now().feet[i].offset / chain_.tolerance()[i];
      out += share * share;
    }
    return out;
  }

  ChainOnPoints& chain_;
  bool constant_ = false;
  const RunContext& run_;
  std::vector<Condition> conditions_;
};

}  // namespace

Result<bool> take_simpler_kinds(ChainOnPoints& chain, bool constant, const RunContext& run) {
  return KindsTaker(chain, constant, run).take();
}

}  // namespace obvid::alignment
