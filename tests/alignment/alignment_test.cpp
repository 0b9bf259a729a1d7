// SPDX-License-Identifier: Apache-2.0
#include "obvid/alignment/alignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace obvid {
namespace {

struct RoadPart {
  double length, kappa0, kappa1;
};

/// Places every `step` along parts of linear curvature, by Simpson's rule on steps of a centimetre.
std::vector<Vec2> road_points(const std::vector<RoadPart>& parts, double step) {
  constexpr double kSlice = 0.01;
  std::vector<Vec2> out;
  Vec2 at{};
  double theta = 0.0, s = 0.0, next = 0.0;
  for (const RoadPart& part : parts) {
    const int slices = static_cast<int>(std::lround(part.length / kSlice));
    for (int i = 0; i < slices; ++i) {
      if (s >= next - 0.5 * kSlice) {
        out.push_back(at);
        next += step;
      }
      const auto kappa = [&](double t) {
        return part.kappa0 + (part.kappa1 - part.kappa0) * (i + t) / slices;
      };
      const double middle = theta + 0.5 * kSlice * 0.5 * (kappa(0.0) + kappa(0.5));
      const double end = theta + 0.5 * kSlice * (kappa(0.0) + kappa(1.0));
      const auto weighed = [&](auto f) {
        return kSlice / 6.0 * (f(theta) + 4.0 * f(middle) + f(end));
      };
      at = at + Vec2{weighed([](double a) { return std::cos(a); }),
                     weighed([](double a) { return std::sin(a); })};
      theta = end;
      s += kSlice;
    }
  }
  out.push_back(at);
  return out;
}

/// Sums of twelve evenly distributed numbers are nearly normal; the same on every machine.
class Noise {
 public:
  double operator()() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) {
      state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
      sum += static_cast<double>(state_ >> 11) * 0x1p-53;
    }
    return sum;
  }

 private:
  std::uint64_t state_ = 7;
};

std::vector<Vec2> disturbed(std::vector<Vec2> points, double sigma) {
  Noise noise;
  for (Vec2& p : points) p = p + sigma * Vec2{noise(), noise()};
  return points;
}

const std::vector<RoadPart> kRoad = {{120, 0, 0},
                                     {60, 0, 1 / 300.0},
                                     {150, 1 / 300.0, 1 / 300.0},
                                     {60, 1 / 300.0, 0},
                                     {90, 0, 0},
                                     {80, 0, -1 / 200.0},
                                     {100, -1 / 200.0, -1 / 200.0},
                                     {70, -1 / 200.0, 0},
                                     {50, 0, 0},
                                     {80, 1 / 150.0, 1 / 150.0},
                                     {60, 0, 0}};

AlignmentKind kind_of_part(const RoadPart& part) {
  if (part.kappa0 != part.kappa1) return AlignmentKind::kClothoid;
  return part.kappa0 == 0.0 ? AlignmentKind::kLine : AlignmentKind::kArc;
}

/// Distance of a point from a segment.
double distance_from_chord(Vec2 p, Vec2 a, Vec2 b) {
  const double t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return norm(p - (a + t * (b - a)));
}

/// Distance of a point from the elements, each cut into chords of a centimetre.
double distance_from(const Alignment& alignment, Vec2 p) {
  double best = norm(p - alignment.end.point);
  for (const AlignmentElement& e : alignment.elements) {
    if (norm(p - e.start.point) > e.length + 1.0) continue;
    const int slices = 200 + static_cast<int>(e.length / 0.01);
    const double h = e.length / slices;
    Vec2 at = e.start.point;
    for (int i = 0; i < slices; ++i) {
      const double u = (i + 0.5) * h;
      const double theta =
          e.start.theta + e.start.kappa * u + (e.kappa1 - e.start.kappa) * u * u / (2.0 * e.length);
      const Vec2 next = at + h * Vec2{std::cos(theta), std::sin(theta)};
      best = std::min(best, distance_from_chord(p, at, next));
      at = next;
    }
  }
  return best;
}

TEST(Alignment, FindsTheElementsOfARoadThroughPointsWithTwoMillimetresOfNoise) {
  const auto points = disturbed(road_points(kRoad, 5.0), 0.002);
  const std::vector<double> tolerance(points.size(), 0.008);
  const auto found = fit_alignment(points, tolerance);
  ASSERT_TRUE(found) << found.error().what;
  ASSERT_EQ(found->elements.size(), kRoad.size());
  for (std::size_t k = 0; k < kRoad.size(); ++k) {
    const AlignmentElement& e = found->elements[k];
    EXPECT_EQ(e.kind, kind_of_part(kRoad[k])) << k;
    if (e.kind == AlignmentKind::kArc) {
      EXPECT_NEAR(1.0 / e.start.kappa, 1.0 / kRoad[k].kappa0, 0.01 / std::abs(kRoad[k].kappa0));
    }
    EXPECT_NEAR(e.length, kRoad[k].length, 2.0) << k;
  }
  EXPECT_LE(found->largest_share, 1.0);
}

TEST(Alignment, StatedOffsetsAreTheDistancesOfThePoints) {
  const auto points = disturbed(road_points(kRoad, 5.0), 0.002);
  const auto found = fit_alignment(points, std::vector<double>(points.size(), 0.008));
  ASSERT_TRUE(found);
  ASSERT_EQ(found->deviations.size(), points.size());
  for (std::size_t i = 0; i < points.size(); i += 7) {
    // chords of a centimetre over radii of 150 m err by less than a micrometre
    EXPECT_NEAR(std::abs(found->deviations[i].offset), distance_from(*found, points[i]), 2e-6) << i;
  }
}

TEST(Alignment, ElementsJoinWithCommonTangents) {
  const auto points = disturbed(road_points(kRoad, 5.0), 0.002);
  const auto found = fit_alignment(points, std::vector<double>(points.size(), 0.008));
  ASSERT_TRUE(found);
  double station = 0.0;
  for (std::size_t k = 0; k + 1 < found->elements.size(); ++k) {
    const AlignmentElement &e = found->elements[k], &next = found->elements[k + 1];
    EXPECT_NEAR(next.start.theta, e.start.theta + 0.5 * (e.start.kappa + e.kappa1) * e.length,
                1e-12);
    EXPECT_EQ(next.step, e.kappa1 != next.start.kappa) << k;
    station += e.length;
    EXPECT_NEAR(next.station, station, 1e-9);
  }
}

const std::vector<RoadPart> kPipe = {
    {10, 0, 0}, {2.36, 1 / 1.5, 1 / 1.5},   {8, 0, 0}, {1.18, -1 / 1.5, -1 / 1.5},
    {7, 0, 0},  {2.36, -1 / 1.5, -1 / 1.5}, {9, 0, 0}};

TEST(Alignment, WithoutTransitionsAPipeIsItsLinesAndElbows) {
  const auto points = disturbed(road_points(kPipe, 0.25), 0.003);
  AlignmentOptions options;
  options.without_transitions = true;
  const auto found = fit_alignment(points, std::vector<double>(points.size(), 0.012), options);
  ASSERT_TRUE(found) << found.error().what;
  ASSERT_EQ(found->elements.size(), kPipe.size());
  for (std::size_t k = 0; k < kPipe.size(); ++k) {
    const AlignmentElement& e = found->elements[k];
    EXPECT_EQ(e.kind, kind_of_part(kPipe[k])) << k;
    if (e.kind == AlignmentKind::kArc) {
      EXPECT_NEAR(1.0 / e.start.kappa, 1.0 / kPipe[k].kappa0, 0.1) << k;
    }
  }
  EXPECT_LE(found->largest_share, 1.0);
}

TEST(Alignment, WithoutTransitionsARoadThatHasThemIsArcsAndLinesWithCommonTangents) {
  const auto points = disturbed(road_points(kRoad, 5.0), 0.002);
  for (const bool closed : {false, true}) {
    AlignmentOptions options;
    options.without_transitions = true;
    options.closed = closed;
    options.without_steps = true;  // says nothing then
    std::vector<Vec2> some = points;
    if (closed) {  // two half circles and their tangents, with transitions between
      some = disturbed(road_points({{60, 0, 0},
                                    {20, 0, 0.04},
                                    {25.0 * std::numbers::pi - 20.0, 0.04, 0.04},
                                    {20, 0.04, 0},
                                    {60, 0, 0},
                                    {20, 0, 0.04},
                                    {25.0 * std::numbers::pi - 20.0, 0.04, 0.04},
                                    {20, 0.04, 0}},
                                   3.0),
                       0.002);
      some.pop_back();
    }
    const auto found = fit_alignment(some, std::vector<double>(some.size(), 0.03), options);
    ASSERT_TRUE(found) << found.error().what;
    EXPECT_EQ(found->closed, closed);
    EXPECT_LE(found->largest_share, 1.0);
    Element at = found->elements.front().start;
    for (const AlignmentElement& e : found->elements) {
      EXPECT_LE(e.kind, AlignmentKind::kArc);
      EXPECT_EQ(e.kappa1, e.start.kappa);
      EXPECT_NEAR(norm(e.start.point - at.point), 0.0, 1e-9);
      EXPECT_NEAR(e.start.theta, at.theta, 1e-9);
      const double end = e.start.theta + e.kappa1 * e.length;
      const Vec2 along = {std::sin(end) - std::sin(e.start.theta),
                          std::cos(e.start.theta) - std::cos(end)};
      const Vec2 straight = {std::cos(end), std::sin(end)};
      at.point = e.start.point + (e.kappa1 == 0.0 ? e.length * straight : along / e.kappa1);
      at.theta = end;
    }
    EXPECT_NEAR(norm(found->end.point - at.point), 0.0, 1e-9);
  }
}

TEST(Alignment, ATransitionIsOneClothoid) {
  const auto points = road_points({{100, 1 / 300.0, 0}}, 1.0);
  const auto found = fit_alignment(points, std::vector<double>(points.size(), 0.05));
  ASSERT_TRUE(found);
  ASSERT_EQ(found->elements.size(), 1U);
  EXPECT_EQ(found->elements[0].kind, AlignmentKind::kClothoid);
  EXPECT_NEAR(found->elements[0].length, 100.0, 1e-6);
  EXPECT_NEAR(found->elements[0].start.kappa, 1 / 300.0, 1e-9);
}

std::vector<AlignmentKind> kinds_of(const Alignment& made) {
  std::vector<AlignmentKind> out;
  for (const AlignmentElement& e : made.elements) out.push_back(e.kind);
  return out;
}

std::vector<AlignmentKind> kinds_of(const std::vector<RoadPart>& parts) {
  std::vector<AlignmentKind> out;
  for (const RoadPart& part : parts) out.push_back(kind_of_part(part));
  return out;
}

/// As they are printed with so many digits.
std::vector<Vec2> rounded(std::vector<Vec2> points, double unit) {
  for (Vec2& p : points) p = {unit * std::round(p.x / unit), unit * std::round(p.y / unit)};
  return points;
}

// A tolerance far above the errors and far below the elements: what is within it of a line is one.
TEST(Alignment, LinesAreLinesHoweverSmallTheTolerance) {
  const std::vector<RoadPart> road = {
      {140.12, 0, 0},         {52.5, 0, -1 / 146.72},  {91.6, -1 / 146.72, -1 / 146.72},
      {52.5, -1 / 146.72, 0}, {170.38, 0, 0},          {82.88, -1 / 225.87, -1 / 225.87},
      {145.04, 0, 0},         {70.09, 0, -1 / 296.58}, {87.29, -1 / 296.58, -1 / 296.58},
      {70.09, -1 / 296.58, 0}};
  for (const double unit : {1e-4, 1e-7}) {
    const auto points = rounded(road_points(road, 5.0), unit);
    for (const double tolerance : {2e-4, 5e-4, 1e-2}) {
      const auto found = fit_alignment(points, std::vector<double>(points.size(), tolerance));
      ASSERT_TRUE(found) << found.error().what;
      EXPECT_EQ(kinds_of(*found), kinds_of(road)) << unit << " " << tolerance;
    }
  }
}

TEST(Alignment, KeepsLeastLengthsAndRadii) {
  const auto points = disturbed(road_points(kRoad, 10.0), 0.002);
  for (const double tolerance : {0.5, 2.0, 8.0}) {
    const std::vector<double> all(points.size(), tolerance);
    const auto free = fit_alignment(points, all);
    ASSERT_TRUE(free);
    int found = 0;
    for (const AlignmentOptions& limits :
         {AlignmentOptions{2, 90.0, 0.0}, AlignmentOptions{2, 0.0, 170.0},
          AlignmentOptions{2, 60.0, 160.0}}) {
      const auto made = fit_alignment(points, all, limits);
      if (!made) continue;  // said, not broken
      ++found;
      EXPECT_GE(made->elements.size(), free->elements.size());
      EXPECT_LE(made->largest_share, 1.0);
      for (const AlignmentElement& e : made->elements) {
        EXPECT_GE(e.length, limits.least_length * (1 - 1e-9));
        if (limits.least_radius == 0.0) continue;
        EXPECT_LE(std::abs(e.start.kappa) * limits.least_radius, 1 + 1e-9);
        EXPECT_LE(std::abs(e.kappa1) * limits.least_radius, 1 + 1e-9);
      }
    }
    EXPECT_GE(found, tolerance < 1.0 ? 1 : 3) << tolerance;
  }
}

// What a smaller limit leads to keeps larger ones too: 31 m is the shortest element of the road.
TEST(Alignment, NoLimitRefusesWhatASmallerOneLeadsTo) {
  const std::vector<RoadPart> road = {
      {102.46, 0, 0},         {30.99, 0, 1 / 222.82}, {83.95, 1 / 222.82, 1 / 222.82},
      {30.99, 1 / 222.82, 0}, {100.51, 0, 0},         {70.44, -1 / 135.46, -1 / 135.46}};
  const auto points = disturbed(road_points(road, 5.0), 0.002);
  const std::vector<double> tolerance(points.size(), 0.008);
  const auto free = fit_alignment(points, tolerance);
  ASSERT_TRUE(free);
  double shortest = free->length, smallest = free->length;
  for (const AlignmentElement& e : free->elements) {
    shortest = std::min(shortest, e.length);
    for (const double kappa : {e.start.kappa, e.kappa1}) {
      if (kappa != 0.0) smallest = std::min(smallest, 1.0 / std::abs(kappa));
    }
  }
  ASSERT_GT(shortest, 29.0);
  for (const double share : {0.7, 0.8, 0.85, 0.9, 0.95, 0.99, 0.999}) {
    for (const AlignmentOptions& limits :
         {AlignmentOptions{2, share * shortest, 0.0}, AlignmentOptions{2, 0.0, share * smallest},
          AlignmentOptions{2, share * shortest, share * smallest}}) {
      const auto made = fit_alignment(points, tolerance, limits);
      ASSERT_TRUE(made) << share << made.error().what;
      for (const AlignmentElement& e : made->elements) {
        EXPECT_GE(e.length, limits.least_length * (1 - 1e-9));
        EXPECT_LE(std::abs(e.start.kappa) * limits.least_radius, 1 + 1e-9);
      }
    }
  }
  const auto refused = fit_alignment(points, tolerance, AlignmentOptions{2, 60.0, 0.0});
  ASSERT_FALSE(refused);
}

TEST(Alignment, RefusesLimitsThatAreNone) {
  for (const AlignmentOptions& limits :
       {AlignmentOptions{2, -1.0, 0.0}, AlignmentOptions{2, 0.0, std::nan("")}}) {
    const auto made = fit_alignment({{0, 0}, {3, 4}}, {0.1, 0.1}, limits);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::kBadOption);
  }
}

TEST(Alignment, TheSameElementsWhereverTheyLieAndInWhateverUnit) {
  const auto points = disturbed(road_points(kRoad, 5.0), 0.002);
  const auto found = fit_alignment(points, std::vector<double>(points.size(), 0.008));
  ASSERT_TRUE(found);
  const auto compare = [&](double scale, Vec2 offset) {
    std::vector<Vec2> moved;
    for (const Vec2 p : points) moved.push_back(scale * p + offset);
    const auto again = fit_alignment(moved, std::vector<double>(points.size(), scale * 0.008));
    ASSERT_TRUE(again);
    ASSERT_EQ(again->elements.size(), found->elements.size());
    for (std::size_t k = 0; k < found->elements.size(); ++k) {
      EXPECT_EQ(again->elements[k].kind, found->elements[k].kind);
      EXPECT_NEAR(again->elements[k].length, scale * found->elements[k].length, 0.05 * scale);
    }
  };
  compare(1e-9, {});
  compare(1e9, {});
  compare(1.0, {3.5e6, 5.4e6});
}

TEST(Alignment, TwoPointsAreALine) {
  const auto found = fit_alignment({{0, 0}, {3, 4}}, {0.1, 0.1});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->elements.size(), 1U);
  EXPECT_EQ(found->elements[0].kind, AlignmentKind::kLine);
  EXPECT_NEAR(found->length, 5.0, 0.01);
}

TEST(Alignment, OneLineOrOneArcIsFoundToTheEdgeOfTheTolerance) {
  // to both sides of the line y = 0, and of a circle of radius 100: no curve of either kind is
  // nearer
  std::vector<Vec2> line, circle;
  for (int i = 0; i <= 40; ++i) {
    const double side = i % 2 == 0 ? 0.012345 : -0.012345;
    line.push_back({10.0 * i, side});
    circle.push_back((100.0 + side) * Vec2{std::cos(0.06 * i), std::sin(0.06 * i)});
  }
  for (const double tolerance : {0.012355, 0.0123451}) {
    const std::vector<double> all(line.size(), tolerance);
    const auto straight = fit_alignment(line, all);
    ASSERT_TRUE(straight);
    ASSERT_EQ(straight->elements.size(), 1U) << tolerance;
    EXPECT_EQ(straight->elements[0].kind, AlignmentKind::kLine);
    EXPECT_LE(straight->largest_share, 1.0);
    const auto round = fit_alignment(circle, all);
    ASSERT_TRUE(round);
    ASSERT_EQ(round->elements.size(), 1U) << tolerance;
    EXPECT_EQ(round->elements[0].kind, AlignmentKind::kArc);
    EXPECT_NEAR(1.0 / round->elements[0].start.kappa, 100.0, 0.02);
    EXPECT_LE(round->largest_share, 1.0);
  }
}

TEST(Alignment, RefusesWhatIsNoPointSequence) {
  EXPECT_EQ(fit_alignment({{0, 0}}, {0.1}).error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(fit_alignment({{0, 0}, {0, 0}, {1, 0}}, {0.1, 0.1, 0.1}).error().code,
            ErrorCode::kChordReversal);
}

TEST(Alignment, EndsWhenItIsAskedTo) {
  const auto points = road_points(kRoad, 5.0);
  RunContext run;
  run.cancelled = [] { return true; };
  const auto found = fit_alignment(points, std::vector<double>(points.size(), 0.01), {}, run);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kCancelled);
}

/// Two straight lines and two half circles, with clothoids between them or without; heading and
/// place come back after both halves, as each turns by pi.
std::vector<RoadPart> oval(double straight, double arc, double transition) {
  const double kappa = std::numbers::pi / (arc + transition);
  std::vector<RoadPart> half = {{straight, 0, 0}};
  if (transition > 0.0) half.push_back({transition, 0, kappa});
  half.push_back({arc, kappa, kappa});
  if (transition > 0.0) half.push_back({transition, kappa, 0});
  std::vector<RoadPart> out = half;
  out.insert(out.end(), half.begin(), half.end());
  return out;
}

/// Points of a closed road without the last one, which is the first; begun somewhere on it.
std::vector<Vec2> loop_points(const std::vector<RoadPart>& parts, double step, std::size_t from) {
  std::vector<Vec2> out = road_points(parts, step);
  out.pop_back();
  std::rotate(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(from), out.end());
  return out;
}

/// The end of the last element by Simpson's rule is the start of the first.
void expect_closed(const Alignment& made, double tolerance) {
  ASSERT_TRUE(made.closed);
  Vec2 at = made.elements.front().start.point;
  double theta = made.elements.front().start.theta;
  for (const AlignmentElement& e : made.elements) {
    constexpr int kSlices = 2000;
    const double h = e.length / kSlices;
    for (int i = 0; i < kSlices; ++i) {
      const auto turned = [&](double t) {
        const double u = (i + t) * h;
        return theta + e.start.kappa * u + 0.5 * (e.kappa1 - e.start.kappa) * u * u / e.length;
      };
      const double a = turned(0.0), b = turned(0.5), c = turned(1.0);
      at = at + h / 6.0 *
                    Vec2{std::cos(a) + 4.0 * std::cos(b) + std::cos(c),
                         std::sin(a) + 4.0 * std::sin(b) + std::sin(c)};
    }
    theta += 0.5 * (e.start.kappa + e.kappa1) * e.length;
  }
  EXPECT_LT(norm(at - made.elements.front().start.point), 1e-6 * tolerance + 1e-10 * made.length);
  EXPECT_NEAR(
      std::abs(std::remainder(theta - made.elements.front().start.theta, 2.0 * std::numbers::pi)),
      0.0, 1e-9);
}

/// Unit steps that turn at random; `hairpins`: straight on, but for every fifth, which turns by 150
/// degrees.
std::vector<Vec2> random_walk(int seed, std::size_t count, bool hairpins) {
  Noise noise;
  for (int i = 0; i < 100 * seed; ++i) noise();
  std::vector<Vec2> out = {{}};
  double heading = 0.0;
  while (out.size() < count) {
    const double random = noise();
    const bool turns = !hairpins || out.size() % 5 == 0;
    if (turns) heading += hairpins ? std::copysign(2.6, random) : 3.0 * random;
    out.push_back(out.back() + Vec2{std::cos(heading), std::sin(heading)});
  }
  return out;
}

Result<Alignment> within(const std::vector<Vec2>& points, double tolerance) {
  return fit_alignment(points, std::vector<double>(points.size(), tolerance));
}

bool tells_that_fewer_may_be(const Alignment& a) { return a.has_chords || a.found_within < 1.0; }

// The chords with rounded corners are within any tolerance, and what is within a smaller tolerance
// is within a larger one.
TEST(Alignment, NoPolylineIsRefusedAndALargerToleranceHasMoreElementsOnlyWhereItIsTold) {
  for (const bool hairpins : {false, true}) {
    for (int seed = 0; seed < 3; ++seed) {
      const std::vector<Vec2> points = random_walk(seed, 12, hairpins);
      std::size_t before = points.size() * 3;
      for (const double tolerance : {0.02, 0.08, 0.32, 1.28}) {
        const auto found = within(points, tolerance);
        ASSERT_TRUE(found) << hairpins << " " << seed << " " << tolerance << found.error().what;
        EXPECT_LE(found->largest_share, 1.0);
        if (!tells_that_fewer_may_be(*found)) {
          EXPECT_LE(found->elements.size(), before + 1) << hairpins << seed << " " << tolerance;
        }
        before = found->elements.size();
      }
    }
  }
}

TEST(Alignment, PointsNearerThanTheToleranceAreNoReasonToRefuse) {
  const std::vector<Vec2> points = {
      {0.34, -2.415},  {0.689, -2.051},  {9.052, -0.227},  {10.567, 0.033},
      {10.555, 0.028}, {11.349, -1.191}, {12.741, -1.035}, {13.919, -0.278},
      {14.13, 1.428},  {13.514, 1.768},  {13.579, 1.909},  {14.499, 1.879},
      {15.004, 1.996}, {15.084, 2.134},  {15.203, 2.15},   {15.131, 2.978}};
  for (const double tolerance : {0.05, 0.133, 0.266}) {
    EXPECT_TRUE(within(points, tolerance)) << tolerance;
  }
}

TEST(Alignment, ChordsThatGoStraightBackAreRoundedWithinTheTolerance) {
  const auto found = within({{0.0, 0.0}, {10.0, 0.0}, {4.0, 0.0}, {12.0, 3.0}}, 0.1);
  ASSERT_TRUE(found) << found.error().what;
  EXPECT_LE(found->largest_share, 1.0);
  EXPECT_GE(found->length,
            10.0 + 6.0 + std::hypot(8.0, 3.0) - 8 * 0.1);  // the chords, less at ends
}

TEST(Alignment, WhatIsRefusedForItsLimitsIsFoundAsTheAdviceSays) {
  const std::vector<Vec2> points = random_walk(1, 16, true);
  AlignmentOptions options;
  options.least_radius = 2.0;
  const auto refused = fit_alignment(points, std::vector<double>(points.size(), 0.01), options);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().hint.find("allow a larger tolerance, or smaller radii"),
            std::string::npos)
      << refused.error().hint;
  EXPECT_TRUE(fit_alignment(points, std::vector<double>(points.size(), 10.0), options));
  EXPECT_TRUE(within(points, 0.01));
}

// The best circle through seven points of it is two centimetres off: with as many elements, arcs
// with steps between them are within the tolerance too, and farther off.
TEST(Alignment, ATransitionThatThePointsShowIsNoArc) {
  const std::vector<RoadPart> road = {{102.46, 0, 0},
                                      {30.99, 0, 1 / 222.82},
                                      {83.95, 1 / 222.82, 1 / 222.82},
                                      {30.99, 1 / 222.82, 0},
                                      {100.51, 0, 0},
                                      {70.44, -1 / 135.46, -1 / 135.46},
                                      {84.17, 0, 0},
                                      {42.82, -1 / 148.98, -1 / 148.98}};
  std::vector<Vec2> points = road_points(road, 5.0);
  Noise noise;
  for (int sample = 0; sample < 6; ++sample) {
    std::vector<Vec2> seen = points;
    for (Vec2& p : seen) p = p + 0.002 * Vec2{noise(), noise()};
    const auto found = within(seen, 0.008);
    ASSERT_TRUE(found) << found.error().what;
    EXPECT_EQ(kinds_of(*found), kinds_of(road)) << sample;
    AlignmentOptions options;
    options.without_steps = true;
    const auto without = fit_alignment(seen, std::vector<double>(seen.size(), 0.008), options);
    ASSERT_TRUE(without) << without.error().what;
    // three of the road's joints have steps, and get a transition each
    EXPECT_EQ(without->elements.size(), road.size() + 3) << sample;
  }
}

TEST(ClosedAlignment, HasTheElementsOfALoopWhereverItsPointsBegin) {
  // 0: in a line, 10: in a transition, 14: in an arc
  const auto parts = oval(50.0, 60.0, 15.0);
  for (const std::size_t from : {2U, 10U, 14U, 40U}) {
    const auto points = disturbed(loop_points(parts, 5.0, from), 0.002);
    const std::vector<double> tolerance(points.size(), 0.008);
    AlignmentOptions options;
    options.closed = true;
    const auto made = fit_alignment(points, tolerance, options);
    ASSERT_TRUE(made) << made.error().what;
    ASSERT_EQ(made->elements.size(), 8U) << from;
    EXPECT_NEAR(made->length, 280.0, 0.05);
    expect_closed(*made, 0.008);
    for (const AlignmentElement& e : made->elements) EXPECT_FALSE(e.step) << from;
    for (const AlignmentDeviation& d : made->deviations) EXPECT_LE(std::abs(d.offset), 0.008);
    ASSERT_EQ(made->deviations.size(), points.size());
    // the first point has station 0, and all of them lie on the elements' stations
    EXPECT_NEAR(made->deviations.front().station, 0.0, 1e-9);
    const double begin = made->elements.front().station;
    EXPECT_LE(begin, 1e-9);
    EXPECT_GT(begin + made->elements.front().length, 0.0);
    for (const AlignmentDeviation& d : made->deviations) {
      EXPECT_GE(d.station, begin - 1e-9);
      EXPECT_LE(d.station, begin + made->length);
    }
    for (const AlignmentElement& e : made->elements) {
      EXPECT_TRUE(e.kind != AlignmentKind::kArc ||
                  std::abs(1.0 / e.start.kappa - 75.0 / std::numbers::pi) < 0.02);
    }
  }
}

TEST(ClosedAlignment, HasStepsWhereTheyAreAndNoneWherePointsBegin) {
  const auto points = disturbed(loop_points(oval(50.0, 75.0, 0.0), 5.0, 13), 0.002);
  AlignmentOptions options;
  options.closed = true;
  const auto made = fit_alignment(points, std::vector<double>(points.size(), 0.008), options);
  ASSERT_TRUE(made) << made.error().what;
  ASSERT_EQ(made->elements.size(), 4U);
  expect_closed(*made, 0.008);
  for (const AlignmentElement& e : made->elements) EXPECT_TRUE(e.step);
}

/// Evenly spaced points of two straights of 200 and two half circles, the first one so far along.
std::vector<Vec2> stadium(double radius, int count, double from) {
  constexpr double kStraight = 200.0;
  const double half = kStraight + std::numbers::pi * radius;
  std::vector<Vec2> out;
  for (int i = 0; i < count; ++i) {
    double s = std::fmod(2.0 * half * i / count + from, 2.0 * half);
    const bool back = s >= half;  // the second half is the first one, turned by half a turn
    if (back) s -= half;
    const double a = std::max(0.0, s - kStraight) / radius;
    const Vec2 p{std::min(s, kStraight) + radius * std::sin(a), radius * (1.0 - std::cos(a))};
    out.push_back(back ? Vec2{kStraight, 2.0 * radius} - p : p);
  }
  return out;
}

TEST(ClosedAlignment, OfAStadiumIsTwoLinesAndTwoArcsAtEveryTolerance) {
  for (const double radius : {30.0, 80.0}) {
    for (const double from : {0.0, 37.0}) {
      for (const int count : {60, 180}) {
        const auto points = rounded(stadium(radius, count, from), 1e-4);
        for (const double tolerance : {2e-4, 1e-3, 2e-3}) {
          AlignmentOptions options;
          options.closed = true;
          const auto made =
              fit_alignment(points, std::vector<double>(points.size(), tolerance), options);
          ASSERT_TRUE(made) << made.error().what;
          EXPECT_EQ(made->elements.size(), 4U) << radius << " " << from << " " << tolerance;
          for (const AlignmentElement& e : made->elements) {
            const bool arc = e.kind == AlignmentKind::kArc;
            EXPECT_NE(e.kind, AlignmentKind::kClothoid);
            EXPECT_NEAR(e.start.kappa, arc ? 1.0 / radius : 0.0, 1e-4 / radius);
          }
        }
      }
    }
  }
}

TEST(ClosedAlignment, OfAStadiumHasFourElementsWhicheverJointTheSearchHeld) {
  const auto points = rounded(stadium(30.0, 90, 37.0), 1e-4);
  for (const double tolerance : {4.5e-4, 5e-4, 5.5e-4}) {
    AlignmentOptions options;
    options.closed = true;
    const auto made = fit_alignment(points, std::vector<double>(points.size(), tolerance), options);
    ASSERT_TRUE(made) << made.error().what;
    EXPECT_EQ(made->elements.size(), 4U) << tolerance;
    for (const AlignmentElement& e : made->elements) {
      EXPECT_NE(e.kind, AlignmentKind::kClothoid) << tolerance;
    }
  }
}

TEST(ClosedAlignment, OfACircleIsOneArcOfAnySizeAnywhere) {
  for (const double size : {1e-9, 1.0, 1e9}) {
    for (const double sense : {1.0, -1.0}) {
      std::vector<Vec2> points;
      Noise noise;
      for (int i = 0; i < 40; ++i) {
        const double a = sense * 2.0 * std::numbers::pi * i / 40.0;
        points.push_back(
            size * (Vec2{1e6, -3e6} + (20.0 + 0.01 * noise()) * Vec2{std::cos(a), std::sin(a)}));
      }
      AlignmentOptions options;
      options.closed = true;
      const auto made =
          fit_alignment(points, std::vector<double>(points.size(), 0.05 * size), options);
      ASSERT_TRUE(made) << made.error().what;
      ASSERT_EQ(made->elements.size(), 1U) << size;
      const AlignmentElement& e = made->elements.front();
      EXPECT_NEAR(sense / (e.start.kappa * size), 20.0, 0.05);
      EXPECT_NEAR(e.length * std::abs(e.start.kappa), 2.0 * std::numbers::pi, 1e-12);
      EXPECT_FALSE(e.step);
    }
  }
}

TEST(ClosedAlignment, OfAStarWhoseTipsAreRoundedWherePointsBegin) {
  for (const int tips : {5, 9, 14}) {
    std::vector<Vec2> star;
    for (int i = 0; i < 2 * tips; ++i) {
      const double turn = std::numbers::pi * i / tips;
      star.push_back((i % 2 == 0 ? 100.0 : 40.0) * Vec2{std::cos(turn), std::sin(turn)});
    }
    for (const double tolerance : {0.01, 1.0}) {
      AlignmentOptions options;
      options.closed = true;
      const auto found = fit_alignment(star, std::vector<double>(star.size(), tolerance), options);
      ASSERT_TRUE(found) << tips << " within " << tolerance << ": " << found.error().what;
      EXPECT_LE(found->largest_share, 1.0);
      EXPECT_EQ(found->end.point.x, found->elements.front().start.point.x);
      EXPECT_NEAR(std::remainder(found->end.theta - found->elements.front().start.theta,
                                 2.0 * std::numbers::pi),
                  0.0, 1e-9);
    }
  }
}

TEST(ClosedAlignment, NeedsThreePointsAndTakesTheFirstAgainAtTheEnd) {
  AlignmentOptions options;
  options.closed = true;
  const auto none = fit_alignment({{0, 0}, {1, 0}}, {0.1, 0.1}, options);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kTooFewPoints);
  std::vector<Vec2> points;
  for (int i = 0; i <= 12; ++i) {
    const double a = 2.0 * std::numbers::pi * (i % 12) / 12.0;
    points.push_back({std::cos(a), std::sin(a)});
  }
  const auto made = fit_alignment(points, std::vector<double>(points.size(), 1e-6), options);
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_EQ(made->elements.size(), 1U);
  EXPECT_EQ(made->deviations.size(), points.size());
}

}  // namespace
}  // namespace obvid
