// SPDX-License-Identifier: Apache-2.0
// C2 splines of degree 5 by points and two derivatives at each break: docs/methods/skin.md.
#include "hermite_spline.h"

namespace obvid {

std::vector<double> quintic_knots(const std::vector<double>& breaks) {
  std::vector<double> knots(6, breaks.front());
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) knots.insert(knots.end(), 3, breaks[i]);
  knots.insert(knots.end(), 6, breaks.back());
  return knots;
}

std::vector<Vec3> quintic_points(const std::vector<double>& breaks,
                                 const std::vector<Hermite>& data) {
  std::vector<Vec3> points;
  std::array<Vec3, 6> before{};
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double length = breaks[i + 1] - breaks[i];
    const std::array<Vec3, 6> here = quintic(data[i], data[i + 1], length);
    if (i == 0) {
      points.insert(points.end(), here.begin(), here.begin() + 3);
    } else {
      // Blossom at (previous break, this one three times, next one): on the lines b1 b2 of the
      // piece here and b4 b3 of the piece before. The longer piece reaches it with the shorter
      // step.
      const double last = breaks[i] - breaks[i - 1];
      points.push_back(length >= last ? here[1] + (-last / length) * (here[2] - here[1])
                                      : before[4] + (-length / last) * (before[3] - before[4]));
      points.push_back(here[2]);
    }
    points.push_back(here[3]);
    before = here;
  }
  points.push_back(before[4]);
  points.push_back(before[5]);
  return points;
}

}  // namespace obvid
