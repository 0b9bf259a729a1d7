// SPDX-License-Identifier: Apache-2.0
#include "rounded_corners.h"

#include <algorithm>
#include <cmath>

namespace obvid::alignment {
namespace {

constexpr double kOfChord = 0.4;      ///< that an arc takes of a chord at the most
constexpr double kOfTolerance = 0.9;  ///< that it is away from its point
constexpr double kNoCorner = 1e-9;    ///< rad: a turn that is rounding

}  // namespace

std::vector<Node> rounded_corners(const std::vector<Vec2>& points,
                                  const std::vector<double>& tolerance) {
  double theta = heading(points[1] - points[0]);
  std::vector<Node> out = {{0.0, points.front(), theta}};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec2 before = points[i] - points[i - 1], behind = points[i + 1] - points[i];
    const double turn = std::atan2(cross(before, behind), dot(before, behind));
    if (std::abs(turn) < kNoCorner) continue;
    // an arc between tangents of length t is t tan(turn / 4) away from where they meet
    const double tangent = std::min(kOfChord * std::min(norm(before), norm(behind)),
                                    kOfTolerance * tolerance[i] / std::tan(0.25 * std::abs(turn)));
    const double in = tangent / norm(before), out_of = tangent / norm(behind);
    const auto place = static_cast<double>(i);
    out.push_back({place - in, points[i] - in * before, theta});
    theta += turn;
    out.push_back({place + out_of, points[i] + out_of * behind, theta});
  }
  out.push_back({static_cast<double>(points.size() - 1), points.back(), theta});
  return out;
}

}  // namespace obvid::alignment
