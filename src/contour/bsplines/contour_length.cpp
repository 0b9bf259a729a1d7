// SPDX-License-Identifier: Apache-2.0
#include "contour_length.h"

#include <algorithm>
#include <cmath>

#include "obvid/geom/internal/angle.h"

namespace obvid::bsplines {

ContourLength::Place ContourLength::split(double place) const {
  const double last = static_cast<double>(contour_.pieces.size() - 1);
  const double piece = std::clamp(std::floor(place), 0.0, last);
  return {static_cast<std::size_t>(piece), place - piece};
}

Element ContourLength::element(double place) const {
  const Place p = split(place);
  const auto joint = [&](std::size_t i) {
    return contour_.joints[i == contour_.joints.size() ? 0 : i].element;
  };
  const Element start = joint(p.piece);
  if (p.t == 0.0) return start;
  Element e = p.t == 1.0 ? joint(p.piece + 1) : element_at(contour_.pieces[p.piece], p.t);
  e.theta = nearest_angle(e.theta, start.theta);
  return e;
}

Vec2 ContourLength::point(double place) const {
  const Place p = split(place);
  return evaluate(contour_.pieces[p.piece], p.t).point;
}

}  // namespace obvid::bsplines
