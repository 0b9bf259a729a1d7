// SPDX-License-Identifier: Apache-2.0
// Ranges of headings and radii are exact: a hundredth inside a contour of the same runs exists and
// is proved, a hundredth outside there is none.
#include "../../src/pipeline/series_ranges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "../common/long_runs.h"
#include "../common/ten_points.h"
#include "obvid/pipeline/fit.h"
#include "oracle_curves.h"

namespace obvid {
namespace {

using namespace test;
using pipeline_detail::series_ranges;

constexpr double kDegreesOfRadian = 180.0 / std::numbers::pi;
constexpr double kProbe = 0.01;  // of the range, inside and outside of its ends

/// Whether a contour with the wish exists, is proved and has no more vertices and inflections
/// than the adjacent circles show.
bool exists(const std::vector<Vec2>& points, const PointWish& wish, const Analysis& analysis) {
  PointSeries series;
  series.points = points;
  FitJob job;
  job.closing = Closing::kOpen;
  job.find_corners = false;
  job.measure_against_spirals = false;
  job.wishes.push_back(wish);
  const auto made = fit(series, job);
  return made && made->certificate.proved && made->certificate.vertices <= analysis.vertices &&
         made->certificate.inflections <= analysis.inflections;
}

struct Probes {
  int inside_good = 0, inside_bad = 0, outside_good = 0, outside_bad = 0;
  std::string first_bad;
};

template <class Wish>
void probe(const std::vector<Vec2>& points, const Analysis& analysis, double low, double high,
           bool low_open, bool high_open, const Wish& wish, const std::string& what, Probes& p) {
  const double step = kProbe * (high - low);
  const auto look = [&](double value, bool inside) {
    const bool is = exists(points, wish(value), analysis);
    (inside ? (is ? p.inside_good : p.inside_bad) : (is ? p.outside_bad : p.outside_good))++;
    if (is != inside && p.first_bad.empty()) {
      p.first_bad = what + (inside ? " inside " : " outside ") + std::to_string(value) + " of " +
                    std::to_string(low) + " " + std::to_string(high);
    }
  };
  if (!low_open) {
    look(low + step, true);
    look(low - step, false);
  }
  if (!high_open) {
    look(high - step, true);
    look(high + step, false);
  }
}

void probe_point(const std::vector<Vec2>& points, std::size_t i, Probes& p) {
  const auto analysis = analyse(points);
  ASSERT_TRUE(analysis);
  const auto ranges = series_ranges(*analysis, {});
  ASSERT_TRUE(ranges);
  const FeasibleData& here = (*ranges)[i];
  if (!here.heading || !here.kappa) return;
  probe(
      points, *analysis, here.heading->low, here.heading->high, here.heading->low_is_open,
      here.heading->high_is_open,
      [i](double theta) {
        return PointWish{i, theta, {}, false};
      },
      "heading " + std::to_string(i + 1), p);
  if (std::isinf(here.kappa->low) || std::isinf(here.kappa->high)) return;
  probe(
      points, *analysis, here.kappa->low, here.kappa->high, here.kappa->low == 0.0,
      here.kappa->high == 0.0,
      [i](double kappa) {
        return PointWish{i, {}, kappa, false};
      },
      "curvature " + std::to_string(i + 1), p);
}

TEST(SeriesRanges, OfTheTenPointsAreExact) {
  Probes p;
  for (std::size_t i = 0; i < kTenPoints.size(); ++i) probe_point(kTenPoints, i, p);
  EXPECT_EQ(p.inside_bad, 0) << p.first_bad;
  EXPECT_EQ(p.outside_bad, 0) << p.first_bad;
  EXPECT_GT(p.inside_good + p.outside_good, 60);
}

/// Points on a curve of monotone curvature in similar steps (1:3), whose neighbouring chords turn
/// by less than 80 degrees.
std::vector<Vec2> random_points(int k, std::mt19937_64& rng) {
  for (;;) {
    const auto kind = static_cast<Oracle>(k % kOracleCount);
    const OracleCurve curve = random_curve(kind, rng);
    const int n = 4 + static_cast<int>(rng() % 9U);
    std::vector<Vec2> points;
    for (const long double t : random_parameters(curve, n, false, rng)) {
      const LongVec2 p = curve.at(t);
      points.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
    }
    if (largest_turning(points) < 80.0 / kDegreesOfRadian) return points;
  }
}

TEST(SeriesRanges, OfRandomSpiralsAreExact) {
  std::mt19937_64 rng(20261101);
  Probes p;
  const int cases = test::cases_of(500, 5);
  for (int k = 0; k < cases; ++k) {
    const std::vector<Vec2> points = random_points(k, rng);
    probe_point(points, rng() % points.size(), p);
  }
  EXPECT_EQ(p.inside_bad, 0) << p.first_bad;
  EXPECT_EQ(p.outside_bad, 0) << p.first_bad;
  EXPECT_GT(p.inside_good, 3 * cases / 2);
  EXPECT_GT(p.outside_good, 3 * cases / 2);
}

}  // namespace
}  // namespace obvid
