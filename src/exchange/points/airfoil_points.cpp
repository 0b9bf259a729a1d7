// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "obvid/exchange/internal/points/airfoil.h"
#include "obvid/geom/vec2.h"

namespace obvid {
namespace {

constexpr double kMostOfChord = 0.9;  // a side that ends before is none

/// Points of a side from the foremost one on while x rises; in chords.
using SideOfPoints = std::vector<Vec2>;

SideOfPoints side_of(const std::vector<Vec2>& points, std::size_t nose, std::size_t step,
                     bool closed) {
  const std::size_t n = points.size();
  SideOfPoints out{points[nose]};
  for (std::size_t k = 1, i = nose; k < n; ++k) {
    if (!closed && ((step == 1 && i + 1 == n) || (step != 1 && i == 0))) break;
    i = (i + step) % n;
    const Vec2 step_to = points[i] - out.back();
    if (!(step_to.x > 0.0)) break;
    // across the base of a blunt edge
    if (out.back().x > kMostOfChord && std::abs(step_to.y) > step_to.x) break;
    out.push_back(points[i]);
  }
  return out;
}

/// Height of the lines between the points; beyond the last one that of the last one.
double height_at(const SideOfPoints& side, double x) {
  const auto after = std::upper_bound(side.begin(), side.end(), x,
                                      [](double value, Vec2 p) { return value < p.x; });
  if (after == side.begin()) return side.front().y;
  if (after == side.end()) return side.back().y;
  const Vec2 a = *(after - 1), b = *after;
  return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
}

double radius_through(Vec2 a, Vec2 b, Vec2 c) {
  const double area = std::abs(cross(b - a, c - a));
  if (area == 0.0) return std::numeric_limits<double>::infinity();
  return norm(b - a) * norm(c - b) * norm(a - c) / (2.0 * area);
}

bool ends_where_it_begins(const std::vector<Vec2>& local) {
  constexpr double kListEndsAgain = 1e-6;  // chords
  return norm(local.front() - local.back()) <= kListEndsAgain;
}

/// Of a round edge: the list begins and ends at one point, and two points on each side lie on one
/// circle with it. 0 where they do not.
double edge_radius(const std::vector<Vec2>& local) {
  constexpr double kLargestRadius = 0.05;  // chords
  constexpr double kSameCircle = 0.01;     // of its radius: printed digits
  const std::size_t n = local.size();
  const Vec2 end = local.front();
  if (!ends_where_it_begins(local) || end.x < kMostOfChord) return 0.0;
  const double near = radius_through(local[1], end, local[n - 2]);
  const double far = radius_through(local[2], end, local[n - 3]);
  const bool is_circle = near < kLargestRadius && std::abs(far - near) <= kSameCircle * near;
  // around the edge, not along one side of it
  return is_circle && dot(local[1] - end, local[n - 2] - end) < 0.0 ? near : 0.0;
}

}  // namespace

std::optional<AirfoilPointFigures> airfoil_point_figures(std::span<const Vec2> points,
                                                         const AirfoilFigures& contour) {
  constexpr std::size_t kFewest = 5;
  if (points.size() < kFewest) return std::nullopt;
  const Vec2 along{std::cos(contour.turn), std::sin(contour.turn)};
  std::vector<Vec2> local;
  for (const Vec2 p : points) {
    const Vec2 d = p - contour.leading_edge;
    local.push_back({dot(along, d) / contour.chord, cross(along, d) / contour.chord});
  }
  const auto farther = [](Vec2 a, Vec2 b) {
    const Vec2 edge{1.0, 0.0};
    return norm(a - edge) < norm(b - edge);
  };
  const auto nose = static_cast<std::size_t>(std::max_element(local.begin(), local.end(), farther) -
                                             local.begin());
  const std::size_t n = local.size();
  // an open list begins and ends at the trailing edge; one that does not goes on at its other end
  const bool open = local.front().x > kMostOfChord && local.back().x > kMostOfChord;
  SideOfPoints one = side_of(local, nose, n - 1, !open), other = side_of(local, nose, 1, !open);
  if (one.size() < 2 || other.size() < 2) return std::nullopt;
  if (one.back().x < kMostOfChord || other.back().x < kMostOfChord) return std::nullopt;
  const double middle = 0.5;
  if (height_at(one, middle) < height_at(other, middle)) std::swap(one, other);
  AirfoilPointFigures out;
  const double end = std::min(one.back().x, other.back().x);
  double camber = -1.0;
  for (const SideOfPoints* side : {&one, &other}) {
    for (const Vec2 p : *side) {
      if (p.x > end) continue;
      const double up = height_at(one, p.x), low = height_at(other, p.x);
      if (up - low > out.thickness) out.thickness = up - low, out.thickness_at = p.x;
      if (std::abs(0.5 * (up + low)) > camber) {
        camber = std::abs(0.5 * (up + low));
        out.camber = 0.5 * (up + low);
        out.camber_at = p.x;
      }
    }
  }
  out.nose_radius = radius_through(one[1], one[0], other[1]);
  out.nose_gap = std::max(norm(one[1] - one[0]), norm(other[1] - other[0]));
  // sides end where they bend back; a list that ends apart has its edge between its ends
  const bool apart = open && !ends_where_it_begins(local);
  const double above = apart ? local.front().y : one.back().y;
  out.trailing_thickness = std::abs(above - (apart ? local.back().y : other.back().y));
  if (const double radius = edge_radius(local); radius > 0.0) {
    out.trailing_round = true;
    out.trailing_thickness = 2.0 * radius;
  }
  return out;
}

}  // namespace obvid
