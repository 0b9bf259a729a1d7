// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "../common/angles.h"
#include "obvid/report/stored_contour.h"

namespace obvid::picture_test {

/// Arc that starts at `start` with heading `theta`.
inline ArcPiece arc_from(Vec2 start, double theta, double kappa, double length) {
  const double half = 0.5 * kappa * length;
  const Vec2 end = start + (2.0 / kappa) * std::sin(half) * unit_at(theta + half);
  return {start, end, theta, kappa, length};
}

inline StoredContour semicircle(double radius, Vec2 centre) {
  StoredContour stored;
  const Vec2 start = centre + Vec2{radius, 0.0};
  stored.contour.pieces = {arc_from(start, 0.5 * kPi, 1.0 / radius, kPi * radius)};
  stored.contour.points = {start, centre + Vec2{0.0, radius}, centre - Vec2{radius, 0.0}};
  stored.contour.runs = {{0, 0, 0}};
  return stored;
}

/// Arcs that follow each other with the given curvatures, each turning by `turn` one way or other.
inline StoredContour arc_chain(const std::vector<double>& kappas, double turn) {
  StoredContour stored;
  stored.contour.carrier = Carrier::kArcs;
  Vec2 at;
  double theta = 0.0;
  for (const double kappa : kappas) {
    const ArcPiece arc = arc_from(at, theta, kappa, turn / std::fabs(kappa));
    stored.contour.points.push_back(at);
    stored.contour.pieces.emplace_back(arc);
    at = arc.end;
    theta += kappa * arc.length;
  }
  stored.contour.points.push_back(at);
  return stored;
}

/// Data of all paths with this class.
inline std::vector<std::string> paths_of(const std::string& svg, const std::string& css) {
  std::vector<std::string> paths;
  const std::string mark = "<path class=\"" + css + "\" d=\"";
  for (std::size_t at = svg.find(mark); at != std::string::npos; at = svg.find(mark, at + 1)) {
    const std::size_t from = at + mark.size();
    paths.push_back(svg.substr(from, svg.find('"', from) - from));
  }
  return paths;
}

/// Data of the first of them.
inline std::string path_of(const std::string& svg, const std::string& css) {
  const std::vector<std::string> paths = paths_of(svg, css);
  return paths.empty() ? std::string() : paths.front();
}

inline std::vector<double> numbers_of(const std::string& path) {
  std::vector<double> numbers;
  const char* at = path.c_str();
  while (*at != '\0') {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at) {
      ++at;
    } else {
      numbers.push_back(value);
      at = end;
    }
  }
  return numbers;
}

}  // namespace obvid::picture_test
