// SPDX-License-Identifier: Apache-2.0
#include "obvid/alignment/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "obvid/alignment/internal/borne_grades.h"

namespace obvid {
namespace {

/// Grades between points of intersection, rounded by parabolas of given lengths.
struct Corner {
  double station, height, length;
};
const std::vector<Corner> kCorners = {{0, 100, 0},      {300, 106, 120},   {560, 95.6, 160},
                                      {820, 100.8, 80}, {1100, 90.4, 200}, {1400, 97, 0}};

/// Height by the textbook: y = y0 + g0 x + (g1 - g0) x^2 / 2L from the start of the curve on.
double height_by_corners(const std::vector<Corner>& road, double s) {
  for (std::size_t k = 1; k + 1 < road.size(); ++k) {
    const Corner &a = road[k - 1], &b = road[k], &c = road[k + 1];
    const double g0 = (b.height - a.height) / (b.station - a.station);
    const double g1 = (c.height - b.height) / (c.station - b.station);
    const double x = s - (b.station - 0.5 * b.length);
    if (x < 0.0) return b.height + g0 * (s - b.station);
    if (x >= b.length) continue;
    return b.height - 0.5 * b.length * g0 + g0 * x + (g1 - g0) * x * x / (2.0 * b.length);
  }
  const Corner &a = road[road.size() - 2], &b = road.back();
  return b.height + (b.height - a.height) / (b.station - a.station) * (s - b.station);
}

std::vector<Vec2> levelled(double step, double sigma) {
  std::vector<Vec2> out;
  std::uint64_t state = 11;
  for (int i = 0; i * step <= 1400.0; ++i) {
    double noise = -6.0;  // of twelve numbers in [0, 1): nearly normal
    for (int k = 0; k < 12; ++k) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      noise += static_cast<double>(state >> 11) * 0x1p-53;
    }
    out.push_back({i * step, height_by_corners(kCorners, i * step) + sigma * noise});
  }
  return out;
}

void expect_road(const VerticalProfile& found, double least_length_off, double grade_off) {
  ASSERT_EQ(found.elements.size(), 9U);
  for (std::size_t k = 0; k < 9; ++k) {
    const ProfileElement& e = found.elements[k];
    const Corner &a = kCorners[k / 2], &b = kCorners[k / 2 + 1];
    const double grade = (b.height - a.height) / (b.station - a.station);
    if (k % 2 == 0) {
      EXPECT_EQ(e.kind, ProfileKind::kGrade) << k;
      EXPECT_EQ(e.grade0, e.grade1);
      EXPECT_NEAR(e.grade0, grade, grade_off) << k;
      continue;
    }
    const Corner& c = kCorners[k / 2 + 2];
    const double next = (c.height - b.height) / (c.station - b.station);
    EXPECT_EQ(e.kind, next > grade ? ProfileKind::kSag : ProfileKind::kCrest) << k;
    EXPECT_NEAR(e.length, b.length, least_length_off) << k;
    EXPECT_NEAR(e.radius, b.length / (next - grade), std::abs(e.radius) * least_length_off / 50.0);
    const Vec2 meeting = grades_meet(e, found.curves);
    EXPECT_NEAR(meeting.x, b.station, least_length_off);
    EXPECT_NEAR(meeting.y, b.height, 0.05 * least_length_off);
  }
}

TEST(Profile, FindsGradesAndParabolasOfARoadWithoutNoise) {
  const auto points = levelled(10.0, 0.0);
  const auto found = fit_profile(points, std::vector<double>(points.size(), 1e-4));
  ASSERT_TRUE(found) << found.error().what;
  expect_road(*found, 0.2, 1e-6);
  EXPECT_LE(found->largest_share, 1.0);
}

TEST(Profile, FindsGradesAndParabolasThroughThreeMillimetresOfNoise) {
  const auto points = levelled(5.0, 0.003);
  const auto found = fit_profile(points, std::vector<double>(points.size(), 0.012));
  ASSERT_TRUE(found) << found.error().what;
  expect_road(*found, 8.0, 2e-4);
  EXPECT_LE(found->largest_share, 1.0);
  EXPECT_NEAR(found->rms, 0.003, 0.0006);
}

TEST(Profile, OffsetsAreThoseOfTheHeightsByItsOwnElements) {
  const auto points = levelled(5.0, 0.003);
  const auto found = fit_profile(points, std::vector<double>(points.size(), 0.012));
  ASSERT_TRUE(found);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points[i].y - profile_at(*found, points[i].x).height, found->offsets[i], 1e-10);
  }
}

TEST(Profile, GradesAndHeightsAreContinuous) {
  const auto points = levelled(5.0, 0.003);
  for (const auto curves : {ProfileCurves::kParabolas, ProfileCurves::kArcs}) {
    const auto found =
        fit_profile(points, std::vector<double>(points.size(), 0.012), {curves, 0.0});
    ASSERT_TRUE(found);
    for (std::size_t k = 0; k + 1 < found->elements.size(); ++k) {
      const ProfileElement &e = found->elements[k], &next = found->elements[k + 1];
      EXPECT_NEAR(e.station + e.length, next.station, 1e-9);
      EXPECT_NEAR(e.grade1, next.grade0, 1e-12);
      EXPECT_NEAR(profile_at(*found, next.station - 1e-9).height, next.height, 1e-9);
    }
  }
}

TEST(Profile, BeginsAndEndsAtTheStationsOfTheFirstAndTheLastHeight) {
  auto points = levelled(5.0, 0.003);
  for (const double first : {0.0, 12000.0, -90.3}) {
    auto there = points;
    for (Vec2& p : there) p.x += first;
    for (const auto curves : {ProfileCurves::kParabolas, ProfileCurves::kArcs}) {
      const auto found =
          fit_profile(there, std::vector<double>(there.size(), 0.012), {curves, 0.0});
      ASSERT_TRUE(found);
      EXPECT_EQ(found->elements.front().station, there.front().x);
      EXPECT_EQ(found->end_station, there.back().x);
      const ProfileElement& last = found->elements.back();
      EXPECT_NEAR(last.station + last.length, found->end_station, 1e-9);
      EXPECT_NEAR(profile_at(*found, there.back().x).height, found->end_height, 1e-9);
      // straight there: the height is that of the line which the elements say
      EXPECT_NEAR(last.height + last.length * last.grade0, found->end_height, 1e-9);
    }
  }
}

TEST(Profile, FindsArcsWhereTheyAreAsked) {
  // a grade of 4 % into a crest of radius 1000 m and on with -4 %; over so wide an arc a parabola
  // would be 1.6e-4 m off
  const double theta = std::atan(0.04), half = 1000.0 * std::sin(theta);
  std::vector<Vec2> points;
  for (int i = -30; i <= 30; ++i) {
    const double s = 5.0 * i;
    const double top = std::sqrt(1e6 - std::min(s * s, half * half)) - 1000.0;
    points.push_back({s, top - 0.04 * std::max(std::abs(s) - half, 0.0)});
  }
  const auto found =
      fit_profile(points, std::vector<double>(points.size(), 1e-4), {ProfileCurves::kArcs, 0.0});
  ASSERT_TRUE(found) << found.error().what;
  ASSERT_EQ(found->elements.size(), 3U);
  const ProfileElement& arc = found->elements[1];
  EXPECT_EQ(arc.kind, ProfileKind::kCrest);
  EXPECT_NEAR(arc.radius, -1000.0, 0.1);
  EXPECT_NEAR(arc.station, -half, 0.05);
  EXPECT_NEAR(arc.length, 2.0 * half, 0.05);
  EXPECT_NEAR(found->elements[2].grade0, -0.04, 1e-6);
  EXPECT_NEAR(profile_at(*found, 3.0).height, std::sqrt(1e6 - 9.0) - 1000.0, 2e-6);
  EXPECT_NEAR(grades_meet(arc, found->curves).y, 0.04 * half + std::sqrt(1e6 - half * half) - 1000,
              1e-4);
}

TEST(Profile, KeepsLeastLengths) {
  const auto points = levelled(5.0, 0.003);
  const std::vector<double> all(points.size(), 0.5);
  const auto made = fit_profile(points, all, {ProfileCurves::kParabolas, 130.0});
  ASSERT_TRUE(made) << made.error().what;
  for (const ProfileElement& e : made->elements) EXPECT_GE(e.length, 130.0 * (1 - 1e-9));
}

TEST(Profile, TheSameElementsWhereverTheyLieAndInWhateverUnit) {
  const auto points = levelled(5.0, 0.003);
  for (const double scale : {1e-9, 1e9}) {
    std::vector<Vec2> moved;
    for (const Vec2 p : points) moved.push_back(scale * (p + Vec2{1e4, 500.0}));
    const auto found = fit_profile(moved, std::vector<double>(points.size(), scale * 0.012));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->elements.size(), 9U);
  }
}

TEST(Profile, ALevelLineIsOneGrade) {
  const auto found = fit_profile({{0, 5}, {1, 5}, {2, 5}}, {1e-3, 1e-3, 1e-3});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->elements.size(), 1U);
  EXPECT_EQ(found->elements[0].kind, ProfileKind::kGrade);
  EXPECT_NEAR(found->elements[0].grade0, 0.0, 1e-9);
}

TEST(Profile, RefusesStationsThatDoNotAscend) {
  const auto found = fit_profile({{0, 1}, {2, 1}, {2, 3}}, {0.1, 0.1, 0.1});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kChordReversal);
  EXPECT_EQ(found.error().index, 2);
}

/// Numbers in [0, 1), the same ones each time.
class Numbers {
 public:
  double next() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }
  double between(double low, double high) { return low + (high - low) * next(); }

 private:
  std::uint64_t state_ = 5;
};

/// Heights of a road, with how far noise moves them.
std::vector<Vec2> sampled(const std::vector<Corner>& road, double step, double noise,
                          Numbers& numbers) {
  std::vector<Vec2> out;
  for (int i = 0; i * step <= road.back().station; ++i) {
    out.push_back(
        {i * step, height_by_corners(road, i * step) + noise * numbers.between(-1.0, 1.0)});
  }
  return out;
}

/// No grade is beyond those of the chords, each end of them moved by the tolerance.
void expect_borne(const VerticalProfile& found, const std::vector<Vec2>& heights,
                  double tolerance) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    const double run = heights[i].x - heights[i - 1].x, rise = heights[i].y - heights[i - 1].y;
    low = std::min(low, (rise - 2.0 * tolerance) / run);
    high = std::max(high, (rise + 2.0 * tolerance) / run);
  }
  for (const ProfileElement& e : found.elements) {
    for (const double grade : {e.grade0, e.grade1}) {
      EXPECT_GE(grade, low - 1e-9) << "at " << e.station;
      EXPECT_LE(grade, high + 1e-9) << "at " << e.station;
    }
  }
}

TEST(Profile, RoundsASharpKinkWithoutSwingingPastIt) {
  // 2 % and then -1 %, a height each 5 m: at a height and between two
  for (const double kink : {200.0, 201.3, 202.5}) {
    for (const ProfileCurves curves : {ProfileCurves::kParabolas, ProfileCurves::kArcs}) {
      Numbers numbers;
      const std::vector<Corner> road = {
          {0, 0, 0}, {kink, 0.02 * kink, 0}, {400, 0.03 * kink - 4, 0}};
      const auto heights = sampled(road, 5.0, 0.0, numbers);
      const auto found = fit_profile(heights, std::vector<double>(heights.size(), 1e-3), {curves});
      ASSERT_TRUE(found) << found.error().what;
      ASSERT_EQ(found->elements.size(), 3U) << kink;
      EXPECT_EQ(found->elements[1].kind, ProfileKind::kCrest);
      EXPECT_NEAR(found->elements[0].grade0, 0.02, 1e-4);
      EXPECT_NEAR(found->elements[2].grade0, -0.01, 1e-4);
      EXPECT_NEAR(grades_meet(found->elements[1], curves).x, kink, 0.2);
      EXPECT_LE(found->largest_share, 1.0);
      expect_borne(*found, heights, 1e-3);
    }
  }
}

TEST(Profile, HeightsThatStandOutAreReachedByGradesThatTheyBear) {
  // 10 %, and each seventh height 0.3 m above that. Straight from height to height there are 24
  // corners, so that 25 grades and 24 curves do.
  std::vector<Vec2> heights;
  for (int i = 0; i < 60; ++i) {
    heights.push_back({5.0 * i, 100.0 + 0.5 * i + (i % 7 == 0 && i > 0 ? 0.3 : 0.0)});
  }
  for (const ProfileCurves curves : {ProfileCurves::kParabolas, ProfileCurves::kArcs}) {
    const auto found = fit_profile(heights, std::vector<double>(heights.size(), 0.008), {curves});
    ASSERT_TRUE(found) << found.error().what;
    EXPECT_LE(found->largest_share, 1.0);
    EXPECT_LE(found->elements.size(), 49U);
    expect_borne(*found, heights, 0.008);
  }
}

TEST(Profile, AnyHeightsHaveAProfileThatTheyBear) {
  for (int made = 0; made < 12; ++made) {
    Numbers numbers;
    for (int k = 0; k < made; ++k) (void)numbers.next();
    std::vector<Vec2> heights;
    double station = 0.0;
    for (int i = 0; i < 40; ++i) {
      heights.push_back({station, numbers.between(0.0, made % 2 == 0 ? 3.0 : 30.0)});
      station += numbers.between(0.5, 20.0);
    }
    const double tolerance = made % 3 == 0 ? 0.05 : 0.5;
    ProfileOptions options;
    if (made % 4 == 3) options.lap = station;
    const auto found =
        fit_profile(heights, std::vector<double>(heights.size(), tolerance), options);
    ASSERT_TRUE(found) << made << ": " << found.error().what;
    EXPECT_LE(found->largest_share, 1.0);
    if (options.lap > 0.0) heights.push_back({station, heights.front().y});
    expect_borne(*found, heights, tolerance);
    EXPECT_LE(found->elements.size(), 2 * heights.size());
  }
}

TEST(Profile, HasNoMoreElementsThanWhatWasMadeAndNoGradeThatNoHeightBears) {
  Numbers numbers;
  for (int made = 0; made < 16; ++made) {
    const double step = made % 2 == 0 ? 5.0 : 2.0, tolerance = made % 3 == 0 ? 0.01 : 0.002;
    std::vector<Corner> road = {{0, 50, 0}};
    const std::size_t corners = 1 + static_cast<std::size_t>(numbers.between(0.0, 4.0));
    for (std::size_t k = 0; k <= corners; ++k) {
      const double way = 10.0 * step * numbers.between(1.0, 3.0), from = road.back().station;
      double station = from + way;
      if (made % 4 == 0) station = step * std::round(station / step);  // kinks at heights
      const double height = road.back().height + numbers.between(-0.06, 0.06) * (station - from);
      road.push_back({station, height, 0.0});
    }
    for (std::size_t k = 1; k + 1 < road.size(); ++k) {
      const double room =
          std::min(road[k].station - road[k - 1].station, road[k + 1].station - road[k].station);
      const double kind = numbers.next(), share = numbers.next();
      if (kind > 0.4) road[k].length = kind < 0.6 ? share * step : 0.9 * share * room;
    }
    const auto heights = sampled(road, step, made % 5 == 0 ? 0.0 : 0.5 * tolerance, numbers);
    const auto found = fit_profile(heights, std::vector<double>(heights.size(), tolerance));
    ASSERT_TRUE(found) << made << ' ' << found.error().what;
    EXPECT_LE(found->elements.size(), 2 * corners + 1) << made;
    EXPECT_LE(found->largest_share, 1.0);
    expect_borne(*found, heights, tolerance);
  }
}

TEST(Profile, TellsGradesThatNoHeightBears) {
  // chords of 10 and 20 %; moved by 0.1 m at both ends they bear -10 to 40 %
  const std::vector<Vec2> heights = {{0, 0}, {1, 0.1}, {2, 0.3}};
  const std::vector<double> tolerance(3, 0.1);
  const BorneGrades grades(heights, tolerance, 0.0);
  const ValueRange borne = grades.at(1.2);
  EXPECT_NEAR(borne.low, -0.1, 1e-15);
  EXPECT_NEAR(borne.high, 0.4, 1e-15);
  VerticalProfile profile;
  profile.elements = {{ProfileKind::kSag, 0.0, 1.0, 0.0, -0.2, 0.4, 1.0 / 0.6},
                      {ProfileKind::kSag, 1.0, 1.0, 0.1, 0.4, 0.5, 10.0}};
  profile.end_station = 2.0;
  const auto told = unborne_grades(profile, grades);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].station, 0.0);
  EXPECT_EQ(told[0].grade, -0.2);
  EXPECT_EQ(told[1].station, 2.0);
  EXPECT_EQ(told[1].grade, 0.5);
  // a loop of 3 m: across the seam it falls by 0.3 m, so that -50 % are borne everywhere
  EXPECT_EQ(unborne_grades(profile, BorneGrades(heights, tolerance, 3.0)).size(), 1U);
}

/// A loop of 1000 m: 3 % up to the crest between 200 and 400, 3 % down to the sag between 700 and
/// 900, by the textbook.
double height_around(double s) {
  s -= 1000.0 * std::floor(s / 1000.0);
  const double bend = 0.06 / 200.0;  // of both curves
  if (s < 200.0) return 0.03 * s;
  if (s < 400.0) return 6.0 + 0.03 * (s - 200.0) - 0.5 * bend * (s - 200.0) * (s - 200.0);
  if (s < 700.0) return 6.0 - 0.03 * (s - 400.0);
  if (s < 900.0) return -3.0 - 0.03 * (s - 700.0) + 0.5 * bend * (s - 700.0) * (s - 700.0);
  return -3.0 + 0.03 * (s - 900.0);
}

TEST(Profile, GoesOnFromItsEndToItsStartAroundALoop) {
  for (const ProfileCurves curves : {ProfileCurves::kParabolas, ProfileCurves::kArcs}) {
    const bool arcs = curves == ProfileCurves::kArcs;
    for (const double first : {5.0, 305.0, 850.0}) {  // where the heights begin
      std::vector<Vec2> points;
      for (int i = 0; i < 100; ++i) {
        points.push_back({first + 10.0 * i, height_around(first + 10.0 * i)});
      }
      for (const double begin : {0.0, 300.0, 2000.0}) {  // where the profile does
        ProfileOptions options;
        options.curves = curves;
        options.lap = 1000.0;
        options.begin = begin;
        const auto found =
            fit_profile(points, std::vector<double>(points.size(), arcs ? 0.02 : 1e-3), options);
        ASSERT_TRUE(found) << first << ' ' << begin << ' ' << found.error().what;
        EXPECT_EQ(found->elements.size(), 5U) << first << ' ' << begin;  // one is cut
        EXPECT_NEAR(found->elements.front().station, begin, 1e-6);
        EXPECT_NEAR(found->end_station, begin + 1000.0, 1e-6);
        EXPECT_EQ(found->end_height, found->elements.front().height);
        EXPECT_NEAR(found->elements.front().grade0, found->elements.back().grade1, 1e-9);
        double at = found->elements.front().station;
        for (const ProfileElement& e : found->elements) {
          EXPECT_NEAR(e.station, at, 1e-6);
          at = e.station + e.length;
          EXPECT_NEAR(e.height, height_around(e.station), arcs ? 0.04 : 2e-3);
          if (e.kind != ProfileKind::kGrade) {
            EXPECT_NEAR(std::abs(e.radius), 200.0 / 0.06, arcs ? 60.0 : 20.0);
          }
        }
        EXPECT_NEAR(at, found->end_station, 1e-6);
        ASSERT_EQ(found->offsets.size(), points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
          double station = points[i].x;
          while (station >= begin + 1000.0) station -= 1000.0;
          while (station < begin) station += 1000.0;
          const double offset = points[i].y - profile_at(*found, station).height;
          EXPECT_NEAR(found->offsets[i], offset, arcs ? 1e-4 : 1e-9);
          EXPECT_LE(std::abs(offset), arcs ? 0.0201 : 1e-3 * (1 + 1e-9));
        }
      }
    }
  }
}

TEST(Profile, HeightsOfALoopAreThoseOfOneLap) {
  ProfileOptions options;
  options.lap = 30.0;
  const std::vector<Vec2> points = {{0, 1}, {10, 2}, {20, 2}, {30, 1}};
  const auto made = fit_profile(points, {0.1, 0.1, 0.1, 0.1}, options);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kChordReversal);
  EXPECT_EQ(made.error().index, 3);
}

}  // namespace
}  // namespace obvid
