// SPDX-License-Identifier: Apache-2.0
// Measures of a contour that several checks need.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>

#include "checks.h"

namespace judge {

namespace {

/// Points that are met exactly: a joint stands on each, in order.
std::string missed_exactly(const Course& course) {
  const ContourFile& file = course.file;
  for (const Part& part : course.parts) {
    for (const auto& [order, index] :
         {std::pair{part.from, part.from_point}, std::pair{part.to, part.to_point}}) {
      const FileElement* element =
          order == std::floor(order) ? file.joint(static_cast<std::size_t>(order)) : nullptr;
      if (element == nullptr || element->source != index ||
          !(element->point == file.points[index])) {
        return fmt::format("no joint stands on point {}", index + 1);
      }
    }
    if (!(part.to > part.from)) return "points are met out of order";
  }
  return "";
}

/// The first place between two orders, counted on around a closed path, that is at most so far from
/// a point. Pieces are looked at by parts, so that a place that is left again is not passed over
/// for a nearer one.
std::optional<Real> first_within(const Path& path, Vec p, Real from, Real to, Real reach) {
  constexpr Real kParts = 8.0L;
  constexpr int kHalvings = 40;
  const auto away = [&](Real order) {
    return norm(path.at(order > path.end() ? order - path.end() : order) - p);
  };
  if (away(from) <= reach) return from;
  while (from < to) {
    const Real end = std::min(to, (std::floor(from * kParts) + 1.0L) / kParts);
    const Real rounds = from >= path.end() ? path.end() : 0.0L;
    const Place near = path.nearest(p, from - rounds, end - rounds);
    if (near.distance <= reach) {
      Real inside = near.order() + rounds;
      for (int k = 0; k < kHalvings; ++k) {
        const Real middle = 0.5L * (from + inside);
        (away(middle) <= reach ? inside : from) = middle;
      }
      return inside;
    }
    from = end;
  }
  return std::nullopt;
}

std::size_t first_point(const Course& course) {
  return course.file.closed ? course.parts.front().from_point : 0;
}

/// How near the contour must come to a point.
Real needed_nearness(const Course& course, std::size_t point, Doubt doubt) {
  const Real sign = doubt == Doubt::kHelpsTheClaim ? 1.0L : -1.0L;
  return course.file.tolerance[point] * (1.0L + sign * 1e-6L) + sign * course.resolution();
}

/// How many points from the first one on are met in order behind an order: each at the first place
/// that is near enough, behind that of the one before.
std::size_t met_in_order(const Course& course, Real start, Doubt doubt) {
  const std::size_t n = course.file.points.size();
  const Real last = start + course.path.end();
  Real at = start;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (first_point(course) + k) % n;
    const Vec p = seen(course.file.points[i], course.origin);
    const auto met = first_within(course.path, p, at, last, needed_nearness(course, i, doubt));
    if (!met) return k;
    at = *met;
  }
  return n;
}

/// The next part of the contour, an eighth of a piece, behind an order that comes near enough to
/// the first point.
std::optional<Real> next_visit(const Course& course, Real start, Doubt doubt) {
  const std::size_t i = first_point(course);
  const Vec p = seen(course.file.points[i], course.origin);
  constexpr Real kParts = 8.0L;
  for (Real from = (std::floor(start * kParts) + 1.0L) / kParts; from < course.path.end();
       from += 1.0L / kParts) {
    const Real to = from + 1.0L / kParts;
    const Real needed = needed_nearness(course, i, doubt);
    if (course.path.nearest(p, from, to).distance <= needed) return from;
  }
  return std::nullopt;
}

}  // namespace

std::string missed_point(const Course& course, Doubt doubt) {
  const ContourFile& file = course.file;
  if (file.points.size() < 2) return "there are no points";
  if (file.tolerance.empty()) return missed_exactly(course);
  if (file.tolerance.size() != file.points.size()) return "a point has no tolerance";
  const std::vector<Real>& away = course.away;
  for (std::size_t i = 0; i < away.size(); ++i) {
    if (away[i] > needed_nearness(course, i, doubt)) {
      return fmt::format("point {} is {:.6Lg} away", i + 1, away[i]);
    }
  }
  // around a closed contour the first point may be met anywhere
  std::size_t furthest = 0;
  for (std::optional<Real> start = 0.0L; start; start = next_visit(course, *start, doubt)) {
    const std::size_t met = met_in_order(course, *start, doubt);
    if (met == file.points.size()) return "";
    furthest = std::max(furthest, met);
    if (!file.closed) break;
  }
  return fmt::format("the contour does not pass the points in their order: point {}",
                     (first_point(course) + furthest) % file.points.size() + 1);
}

Real outside_region(const Course& course, Real a, Real b) {
  const Element from = course.element(a, true), to = course.element(b, false);
  const int direction = to.kappa > from.kappa ? 1 : -1;
  const auto region = Region::of(from, to, direction);
  if (!region) return 0.0L;
  constexpr int kPlaces = 64;
  Real most = 0.0L;
  for (int k = 1; k < kPlaces; ++k) {
    most = std::max(most, region->outside(course.path.at(a + (b - a) * k / kPlaces)));
  }
  return most;
}

ElementGap worst_element_gap(const Course& course) {
  ElementGap out;
  // what an element says lies between both ends that meet there: how far these are apart is what
  // `joint_gaps` tells
  const auto compare = [&](std::size_t j, const End& left, const End& right, Point point,
                           double heading, double kappa) {
    BallVec direction;
    sin_cos(Ball(heading), direction.y, direction.x);
    const auto turned = [](const BallVec& a, const BallVec& b) { return abs(angle_between(a, b)); };
    const Ball beyond = turned(direction, left.tangent) + turned(direction, right.tangent) -
                        turned(left.tangent, right.tangent);
    const double angle = (Ball(0.5) * beyond).lower();
    double bend = 0.0;
    const Ball to_left = left.kappa - Ball(kappa), to_right = right.kappa - Ball(kappa);
    if (to_left.sign() * to_right.sign() == 1) {
      const Ball scale = larger(larger(abs(left.kappa), abs(right.kappa)), Ball(std::abs(kappa)));
      bend = std::min((abs(to_left) / scale).lower(), (abs(to_right) / scale).lower());
    }
    if (angle > out.heading) out.at = j;
    for (const End* end : {&left, &right}) {
      const double far = norm(end->point - BallVec{point.x, point.y}).lower() / course.ends.size;
      out.position = std::max(out.position, far);
    }
    out.heading = std::max(out.heading, angle);
    if (course.file.carrier != "arcs") out.curvature = std::max(out.curvature, bend);
  };
  const std::size_t n = course.file.pieces.size();
  if (n == 0) return out;
  for (std::size_t j = 0; j <= n; ++j) {
    const FileElement* e = course.file.joint(j);
    if (e == nullptr || (course.file.closed && j == n)) continue;
    const bool comes = j > 0 || course.file.closed, goes = j < n;
    const End& left = comes ? course.ends.end[(j + n - 1) % n] : course.ends.start[0];
    const End& right = goes ? course.ends.start[j] : left;
    compare(j, left, e->parted() ? left : right, e->point, e->heading, e->kappa);
    if (e->parted()) compare(j, right, right, e->point, e->heading_out, e->kappa_out);
  }
  return out;
}

namespace {

struct Chord {
  Vec a, b;
  std::size_t index;
};

bool crosses(const Chord& p, const Chord& q) {
  const Vec u = p.b - p.a, v = q.b - q.a;
  const Real s0 = cross(u, q.a - p.a), s1 = cross(u, q.b - p.a);
  const Real t0 = cross(v, p.a - q.a), t1 = cross(v, p.b - q.a);
  return (s0 > 0.0L) != (s1 > 0.0L) && (t0 > 0.0L) != (t1 > 0.0L);
}

}  // namespace

std::optional<int> count_crossings(const Course& course) {
  constexpr std::size_t kMostChords = 4000;
  constexpr std::size_t kPerPiece = 24;
  const std::size_t pieces = course.file.pieces.size();
  if (pieces == 0 || pieces * kPerPiece > kMostChords) return std::nullopt;
  std::vector<Chord> chords;
  Vec before = course.path.at(0.0L);
  for (std::size_t k = 1; k <= pieces * kPerPiece; ++k) {
    const Vec now = course.path.at(static_cast<Real>(k) / kPerPiece);
    chords.push_back({before, now, k});
    before = now;
  }
  const auto low = [](const Chord& c) { return std::min(c.a.x, c.b.x); };
  const auto high = [](const Chord& c) { return std::max(c.a.x, c.b.x); };
  // a curve that returns to its start is there once, whatever rounding makes of it
  const bool returns = norm(chords.front().a - chords.back().b) <= course.resolution();
  const std::size_t all = chords.size();
  std::sort(chords.begin(), chords.end(),
            [&](const Chord& a, const Chord& b) { return low(a) < low(b); });
  int count = 0;
  for (std::size_t i = 0; i < chords.size(); ++i) {
    for (std::size_t j = i + 1; j < chords.size() && low(chords[j]) <= high(chords[i]); ++j) {
      const std::size_t apart = chords[i].index > chords[j].index
                                    ? chords[i].index - chords[j].index
                                    : chords[j].index - chords[i].index;
      const bool neighbours = apart == 1 || ((course.file.closed || returns) && apart == all - 1);
      if (!neighbours && crosses(chords[i], chords[j])) ++count;
    }
  }
  return count;
}

}  // namespace judge
