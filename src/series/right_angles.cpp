// SPDX-License-Identifier: Apache-2.0
#include "right_angles.h"
#include "obvid/core/units.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>

namespace obvid::series_detail {
namespace {

/// Right angles are tried at this many directions: headings that keep within 79 degrees are found
/// to keep within one of them.
constexpr std::size_t kDirections = 32;
constexpr std::size_t kQuarter = kDirections / 4;

/// One more than the last point before j from which j lies backwards along `along`, whatever the
/// reaches; 0 where there is none.
class BackwardSteps {
 public:
  BackwardSteps(const std::vector<Disc>& discs, Vec2 along) : after_(discs.size(), 0) {
    std::vector<std::uint32_t> high;  // earlier points, each farther along than all that follow it
    std::vector<double> least(discs.size());
    for (std::size_t j = 0; j < discs.size(); ++j) {
      const double at = dot(along, discs[j].centre);
      least[j] = at - discs[j].reach;
      const auto beyond = std::partition_point(high.begin(), high.end(), [&](std::uint32_t i) {
        return least[i] >= at + discs[j].reach;
      });
      if (beyond != high.begin()) after_[j] = *(beyond - 1) + 1;
      while (!high.empty() && least[high.back()] <= least[j]) high.pop_back();
      high.push_back(static_cast<std::uint32_t>(j));
    }
  }

  [[nodiscard]] std::size_t after(std::size_t j) const { return after_[j]; }

 private:
  std::vector<std::uint32_t> after_;
};

}  // namespace

std::vector<std::size_t> right_angle_stretches(const std::vector<Disc>& discs) {
  const std::size_t n = discs.size();
  std::vector<std::size_t> last(n, 0);
  const Vec2 whole = discs.back().centre - discs.front().centre;
  const double zero = heading(whole);
  const auto direction = [&](std::size_t k) {
    return unit_at(zero + kFullTurn * static_cast<double>(k) / kDirections);
  };
  for (std::size_t k = 0; k < kQuarter; ++k) {
    const std::array<BackwardSteps, 4> steps = {BackwardSteps(discs, direction(k)),
                                                BackwardSteps(discs, direction(k + kQuarter)),
                                                BackwardSteps(discs, direction(k + 2 * kQuarter)),
                                                BackwardSteps(discs, direction(k + 3 * kQuarter))};
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const BackwardSteps &one = steps[s], &other = steps[(s + 1) % steps.size()];
      std::size_t end = 0;  // the first point that lies backwards from one of `from` ... end - 1
      for (std::size_t from = 0; from < n; ++from) {
        while (end < n && one.after(end) <= from && other.after(end) <= from) ++end;
        last[from] = std::max(last[from], end - 1);
      }
    }
  }
  return last;
}

}  // namespace obvid::series_detail
