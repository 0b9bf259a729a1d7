// SPDX-License-Identifier: Apache-2.0
#include "rounded_corners.h"

#include <algorithm>
#include <cmath>

#include "obvid/core/units.h"

namespace obvid::alignment {
namespace {

constexpr double kOfChord = 0.4;      ///< that an arc takes of a chord at the most
constexpr double kOfTolerance = 0.9;  ///< that it is away from its point
constexpr double kNoCorner = 1e-9;    ///< rad: a turn that is rounding
/// rad: chords that turn by more nearly go straight back. One arc there would be smaller than its
/// tangents by the tangent of half of it; two, with a chord across between them, are not.
constexpr double kHairpin = 179.0 * kOneDegree;
/// Of the tolerance, and of the chords beside it: half of that chord across.
constexpr double kAcrossOfTolerance = 0.4, kAcrossOfChord = 0.25;
/// Intervals of points: where the ends of a chord across stand for, that passes its point in the
/// middle.
constexpr double kAcrossPlace = 0.1;

/// Where chords meet.
struct Corner {
  double place = 0.0;
  Vec2 point;
  double room = 0.0;  ///< how far an arc may be away from it
};

double turn_of(Vec2 before, Vec2 behind) {
  return std::atan2(cross(before, behind), dot(before, behind));
}

/// Points, with the ends of a chord across in place of those where chords go nearly back.
std::vector<Corner> corners_of(const std::vector<Vec2>& points,
                               const std::vector<double>& tolerance) {
  std::vector<Corner> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto place = static_cast<double>(i);
    const bool inside = i > 0 && i + 1 < points.size();
    const Vec2 before = inside ? points[i] - points[i - 1] : Vec2{1.0, 0.0};
    const double turn = inside ? turn_of(before, points[i + 1] - points[i]) : 0.0;
    if (std::abs(turn) <= kHairpin) {
      out.push_back({place, points[i], tolerance[i]});
      continue;
    }
    const double shorter = std::min(norm(before), norm(points[i + 1] - points[i]));
    const double half = std::min(kAcrossOfTolerance * tolerance[i], kAcrossOfChord * shorter);
    const Vec2 across = half * unit_at(heading(before) + 0.5 * turn);
    out.push_back({place - kAcrossPlace, points[i] - across, half});
    out.push_back({place + kAcrossPlace, points[i] + across, half});
  }
  return out;
}

}  // namespace

std::vector<Node> rounded_corners(const std::vector<Vec2>& points,
                                  const std::vector<double>& tolerance) {
  const std::vector<Corner> corners = corners_of(points, tolerance);
  double theta = heading(corners[1].point - corners[0].point);
  std::vector<Node> out = {{0.0, points.front(), theta}};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Corner& at = corners[i];
    const Vec2 before = at.point - corners[i - 1].point, behind = corners[i + 1].point - at.point;
    const double turn = turn_of(before, behind);
    if (std::abs(turn) < kNoCorner) continue;
    // an arc between tangents of length t is t tan(turn / 4) away from where they meet
    const double tangent = std::min(kOfChord * std::min(norm(before), norm(behind)),
                                    kOfTolerance * at.room / std::tan(0.25 * std::abs(turn)));
    const double in = tangent / norm(before), out_of = tangent / norm(behind);
    // as far before the corner as behind it: its point's foot is in the middle of the arc
    const double way =
        kOfChord * std::min(at.place - corners[i - 1].place, corners[i + 1].place - at.place);
    out.push_back({at.place - way, at.point - in * before, theta});
    theta += turn;
    out.push_back({at.place + way, at.point + out_of * behind, theta});
  }
  out.push_back({static_cast<double>(points.size() - 1), points.back(), theta});
  return out;
}

}  // namespace obvid::alignment
