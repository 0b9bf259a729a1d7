// SPDX-License-Identifier: Apache-2.0
#include "space/space_corners.h"

#include <algorithm>
#include <cmath>

namespace obvid::pipeline_detail {

std::vector<Vec2> developed(const std::vector<Vec3>& points) {
  std::vector<Vec2> out{{0.0, 0.0}};
  double heading = 0.0, side = 1.0;
  Vec3 before, across;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec3 chord = points[i] - points[i - 1];
    if (i > 1) {
      const Vec3 turn = cross(before, chord);
      if (dot(turn, across) < 0.0) side = -side;
      if (norm(turn) > 0.0) across = turn;
      heading += side * std::atan2(norm(turn), dot(before, chord));
    }
    out.push_back(out.back() + norm(chord) * Vec2{std::cos(heading), std::sin(heading)});
    before = chord;
  }
  return out;
}

std::vector<std::size_t> corners_in_space(const std::vector<Vec3>& points, bool closed, double blur,
                                          const std::vector<std::size_t>& marked,
                                          const CornerConstraints& constraints) {
  const std::size_t n = points.size();
  std::vector<Vec3> all = points;
  // a polygon in space does not close when it is laid into a plane: a turn before and one behind
  for (int turn = 0; closed && turn < 2; ++turn) {
    all.insert(all.end(), points.begin(), points.end());
  }
  const std::vector<Vec2> flat = developed(all);
  const std::vector<double> tolerance(flat.size(), blur);
  std::vector<FixedData> fixed(flat.size());
  for (std::size_t k = 0; k < flat.size(); ++k) {
    fixed[k].corner = std::find(marked.begin(), marked.end(), k % n) != marked.end();
  }
  std::vector<std::size_t> out;
  for (const std::size_t k : find_corners(flat, tolerance, false, fixed, constraints)) {
    if (!closed) out.push_back(k);
    if (closed && k >= n && k < 2 * n) out.push_back(k - n);
  }
  return out;
}

}  // namespace obvid::pipeline_detail
