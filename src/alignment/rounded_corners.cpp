// SPDX-License-Identifier: Apache-2.0
#include "rounded_corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

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

/// Of the tolerance, to both sides: the heights at which grades may meet. What is left is for what
/// rounds them.
constexpr std::array kMeetAt = {0.0, 0.3, -0.3, 0.6, -0.6, 0.9, -0.9};
constexpr double kRoundedWithin = 0.98;  ///< of the tolerance: arcs are no parabolas
constexpr int kRoundedHalvings = 60;     ///< of what rounds a corner, until it passes the heights

/// Where chords meet.
struct Corner {
  double place = 0.0;
  Vec2 point;
  double room = 0.0;  ///< how far an arc may be away from it
};

/// Points, with the ends of a chord across in place of those where chords go nearly back.
std::vector<Corner> corners_of(const std::vector<Vec2>& points,
                               const std::vector<double>& tolerance) {
  std::vector<Corner> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto place = static_cast<double>(i);
    const bool inside = i > 0 && i + 1 < points.size();
    const Vec2 before = inside ? points[i] - points[i - 1] : Vec2{1.0, 0.0};
    const double turn = inside ? turning(before, points[i + 1] - points[i]) : 0.0;
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

/// Of a loop: joints from the middle of the chord around place `from` once around to it, `places`
/// and a lap on, of nodes that go farther at both ends.
std::vector<Node> once_around(const std::vector<Node>& all, double from, double places, Vec2 lap) {
  const auto behind =
      std::find_if(all.begin(), all.end(), [&](const Node& n) { return n.place > from; });
  const Node &a = *std::prev(behind), &b = *behind;
  const Vec2 middle = 0.5 * (a.point + b.point);
  std::vector<Node> out = {{from, middle, a.theta}};
  for (const Node& node : all) {
    if (node.place > from && node.place < from + places) out.push_back(node);
  }
  out.push_back({from + places, middle + lap, out.back().theta});
  return out;
}

/// Corners of few grades: at which height they meet, and how far from it in parts of its tolerance.
struct Meeting {
  std::size_t height = 0;
  std::size_t at = 0;  ///< of `kMeetAt`
};

/// The fewest grades from height to height, of those that meet at some places within their
/// tolerances; of as many those that keep nearest to the heights there. A loop begins and ends at
/// the height itself.
std::vector<Meeting> fewest_grades(const std::vector<Vec2>& heights,
                                   const std::vector<double>& tolerance, bool around) {
  struct Arrival {
    double off = std::numeric_limits<double>::infinity();
    Meeting from;
    bool reached = false;  ///< by fewer grades, or by as many as now
  };
  const std::size_t n = heights.size(), each = kMeetAt.size();
  std::vector<Arrival> ways(n * each);
  std::vector<Meeting> now;
  for (std::size_t c = 0; c < (around ? 1 : each); ++c) {
    ways[c].off = kMeetAt[c] * kMeetAt[c];
    ways[c].reached = true;
    now.push_back({0, c});
  }
  const auto at = [&](const Meeting& m) {
    return heights[m.height] + Vec2{0.0, kMeetAt[m.at] * tolerance[m.height]};
  };
  const auto is_end = [&](const Meeting& m) { return m.height + 1 == n && (!around || m.at == 0); };
  while (std::none_of(now.begin(), now.end(), is_end)) {
    std::vector<Meeting> next;
    for (const Meeting& from : now) {
      const Vec2 start = at(from);
      double low = -HUGE_VAL, high = HUGE_VAL;  // grades that pass the heights on the way
      for (std::size_t j = from.height + 1; j < n && low <= high; ++j) {
        const double run = heights[j].x - start.x;
        for (std::size_t c = 0; c < each; ++c) {
          const double grade = (at({j, c}).y - start.y) / run;
          Arrival& way = ways[j * each + c];
          if (way.reached || !(low <= grade && grade <= high)) continue;
          const double off = ways[from.height * each + from.at].off + kMeetAt[c] * kMeetAt[c];
          if (way.off == HUGE_VAL) next.push_back({j, c});
          if (off < way.off) way = {off, from, false};
        }
        const double within = kRoundedWithin * tolerance[j], rise = heights[j].y - start.y;
        low = std::max(low, (rise - within) / run);
        high = std::min(high, (rise + within) / run);
      }
    }
    for (const Meeting& m : next) ways[m.height * each + m.at].reached = true;
    now = std::move(next);
  }
  Meeting last = *std::min_element(now.begin(), now.end(), [&](const Meeting& a, const Meeting& b) {
    const auto off = [&](const Meeting& m) {
      return is_end(m) ? ways[m.height * each + m.at].off : HUGE_VAL;
    };
    return off(a) < off(b);
  });
  std::vector<Meeting> out = {last};
  while (last.height > 0) {
    last = ways[last.height * each + last.at].from;
    out.push_back(last);
  }
  std::reverse(out.begin(), out.end());
  return out;
}

/// A station in intervals of heights.
double place_of_station(const std::vector<Vec2>& heights, double station) {
  const auto behind = std::upper_bound(heights.begin() + 1, heights.end() - 1, station,
                                       [](double x, Vec2 p) { return x < p.x; });
  const Vec2 a = *std::prev(behind), b = *behind;
  return static_cast<double>(behind - heights.begin() - 1) + (station - a.x) / (b.x - a.x);
}

/// How far before and behind a corner what rounds it begins and ends: as far as the heights around
/// it allow, and no farther than `most`.
double half_that_passes(const std::vector<Vec2>& heights, const std::vector<double>& tolerance,
                        Vec2 corner, std::array<double, 2> grades, double most) {
  const auto passes = [&](double half) {
    auto p = std::lower_bound(heights.begin(), heights.end(), corner.x - half,
                              [](Vec2 a, double x) { return a.x < x; });
    for (; p != heights.end() && p->x <= corner.x + half; ++p) {
      const double way = p->x - corner.x, along = half + way;
      const double height =
          corner.y + grades[0] * way + (grades[1] - grades[0]) * along * along / (4.0 * half);
      const double within =
          kRoundedWithin * tolerance[static_cast<std::size_t>(p - heights.begin())];
      if (std::abs(p->y - height) > within) return false;
    }
    return true;
  };
  double half = most;
  for (int i = 0; i < kRoundedHalvings && !passes(half); ++i) half *= 0.5;
  return half;
}

}  // namespace

std::vector<Node> rounded_grades(const std::vector<Vec2>& given,
                                 const std::vector<double>& of_given, bool arcs, double lap) {
  std::vector<Vec2> heights = given;
  std::vector<double> tolerance = of_given;
  std::vector<Vec2> corners;
  for (const Meeting& m : fewest_grades(given, of_given, lap > 0.0)) {
    corners.push_back(given[m.height] + Vec2{0.0, kMeetAt[m.at] * of_given[m.height]});
  }
  double before = 0.0;  // heights that are put before the given ones
  if (lap > 0.0) {      // a lap more on either side: the corner at the seam is one of the others
    const std::size_t n = given.size() - 1;
    before = static_cast<double>(n);
    heights.clear();
    tolerance.clear();
    for (const double laps : {-1.0, 0.0, 1.0}) {
      for (std::size_t i = 0; i < n; ++i) heights.push_back(given[i] + Vec2{laps * lap, 0.0});
      tolerance.insert(tolerance.end(), of_given.begin(), of_given.end() - 1);
    }
    heights.push_back(given.back() + Vec2{lap, 0.0});
    tolerance.push_back(of_given.back());
    const Vec2 last = corners[corners.size() - 2] - Vec2{lap, 0.0};
    corners.push_back(corners[1] + Vec2{lap, 0.0});
    corners.insert(corners.begin(), last);
  }
  const auto grade_behind = [&](std::size_t k) {
    const Vec2 link = corners[k + 1] - corners[k];
    return link.y / link.x;
  };
  const auto node = [&](Vec2 at, double grade) {
    return Node{place_of_station(heights, at.x) - before, at, grade};
  };
  std::vector<Node> out = {node(corners.front(), grade_behind(0))};
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const std::array grades = {grade_behind(k - 1), grade_behind(k)};
    if (grades[0] == grades[1]) continue;
    const Vec2 at = corners[k];
    const double room = std::min(at.x - corners[k - 1].x, corners[k + 1].x - at.x);
    const double half = half_that_passes(heights, tolerance, at, grades, kOfChord * room);
    std::array stretch = {1.0, 1.0};
    if (arcs) {  // the tangents of an arc are as long along the slope
      const std::array slant = {std::hypot(1.0, grades[0]), std::hypot(1.0, grades[1])};
      const double longer = std::min(slant[0], slant[1]);
      stretch = {longer / slant[0], longer / slant[1]};
    }
    out.push_back(node(at - half * stretch[0] * Vec2{1.0, grades[0]}, grades[0]));
    out.push_back(node(at + half * stretch[1] * Vec2{1.0, grades[1]}, grades[1]));
  }
  out.push_back(node(corners.back(), grade_behind(corners.size() - 2)));
  if (!(lap > 0.0)) return out;
  const double begin = 0.5 * (corners[1].x + corners[2].x);
  const double from = node({begin, 0.0}, 0.0).place;
  return once_around(out, from, before, {lap, 0.0});
}

std::vector<Node> rounded_corners_around(const std::vector<Vec2>& points,
                                         const std::vector<double>& tolerance) {
  std::vector<Vec2> more = points;
  std::vector<double> of_more = tolerance;
  more.insert(more.begin(), points[points.size() - 2]);
  of_more.insert(of_more.begin(), tolerance[points.size() - 2]);
  more.push_back(points[1]);
  of_more.push_back(tolerance[1]);
  std::vector<Node> all = rounded_corners(more, of_more);
  for (Node& node : all) node.place -= 1.0;
  constexpr double kMiddle = 0.5;
  return once_around(all, kMiddle, static_cast<double>(points.size() - 1), {});
}

std::vector<Node> rounded_corners(const std::vector<Vec2>& points,
                                  const std::vector<double>& tolerance) {
  const std::vector<Corner> corners = corners_of(points, tolerance);
  double theta = heading(corners[1].point - corners[0].point);
  std::vector<Node> out = {{0.0, points.front(), theta}};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Corner& at = corners[i];
    const Vec2 before = at.point - corners[i - 1].point, behind = corners[i + 1].point - at.point;
    const double turn = turning(before, behind);
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
