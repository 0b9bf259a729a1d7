// SPDX-License-Identifier: Apache-2.0
#include "meeting_ends.h"

#include <algorithm>
#include <set>

namespace obvid {

std::vector<std::pair<std::size_t, std::size_t>> meeting_ends(
    std::vector<std::size_t> ends, double near, const std::function<Vec3(std::size_t)>& place,
    const std::function<bool(std::size_t, std::size_t)>& may_meet) {
  std::sort(ends.begin(), ends.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(place(a).x, a) < std::pair(place(b).x, b);
  });
  std::vector<std::pair<double, std::pair<std::size_t, std::size_t>>> pairs;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t k = i + 1; k < ends.size(); ++k) {
      const Vec3 a = place(ends[i]), b = place(ends[k]);
      if (b.x - a.x > near) break;
      const double far = norm(a - b);
      const auto both = std::minmax(ends[i], ends[k]);
      if (far <= near && may_meet(both.first, both.second)) pairs.push_back({far, both});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::set<std::size_t> taken;
  std::vector<std::pair<std::size_t, std::size_t>> out;
  for (const auto& [far, both] : pairs) {
    if (taken.count(both.first) > 0 || taken.count(both.second) > 0) continue;
    taken.insert({both.first, both.second});
    out.push_back(both);
  }
  return out;
}

}  // namespace obvid
