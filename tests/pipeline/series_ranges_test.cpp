// SPDX-License-Identifier: Apache-2.0
// Ranges of headings and radii are exact: a hundredth inside a contour of the same runs exists and
// is proved, a hundredth outside there is none.
#include "fit/series_ranges.h"

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

/// Points of known curves in steps of 1:1000, and nearly straight ones: close to the ends of ranges
/// curvature leaps there. The heading lies a hundredth inside.
struct UnevenSeries {
  std::string name;
  std::vector<Vec2> points;
  std::size_t point;
  double heading_deg;
};
/// On a parabola, four groups of points close together.
const std::vector<Vec2> kParabola = {
    {0.62408184480688222, -0.72729166372835041},  {0.62381317868049291, -0.72663104700042014},
    {0.62354439871066381, -0.72597070516213025},  {0.29778578730611621, -0.20321113191324186},
    {0.29740305005313622, -0.20282595460503397},  {0.2970201989567165, -0.20244105218646652},
    {0.2966372340168571, -0.20205642465753948},   {0.29625415523355791, -0.20167207201825291},
    {0.29587096260681911, -0.20128799426860677},  {0.29548765613664052, -0.20090419140860108},
    {-0.14479745561737972, 0.045316403556105174}, {-0.1452947193707092, 0.045425041886028895},
    {-0.69953711427564602, 0.016481106768760679}, {-0.7001483353121265, 0.016314580568602424},
    {-0.70075967019204655, 0.016147779478803727}, {-0.70137111891540638, 0.01598070349936459},
    {-1.3697984838506823, -0.28867754098076115},  {-1.370523889857193, -0.28911978149028228},
    {-1.3712494097071435, -0.28956229688944385},  {-1.3719750434005338, -0.29000508717824586},
    {-1.3727007909373636, -0.29044815235668825},  {-1.3734266523176331, -0.29089149242477114},
    {-1.3741526275413425, -0.29133510738249446}};

/// On a logarithmic spiral.
const std::vector<Vec2> kLogarithmic = {
    {0.029633425051708257, -0.039280105163102479}, {0.029647422481534715, -0.039272533614285079},
    {0.029694529777195489, -0.039247009613253829}, {0.029852963018488228, -0.039160683951643745},
    {0.030384622191798206, -0.038865518874647856}, {0.032154283480989913, -0.037820403624892154},
    {0.037844695461840695, -0.033729310800654354}, {0.052538599676801884, -0.014124174420461356},
    {0.018202251484724402, 0.066562520077588755},  {0.1470440455776954, 0.044521569585087149},
    {1.5776775979383568, -1.6366477735261971}};

/// A zigzag of some 1e-4 of its steps.
const std::vector<Vec2> kZigzag = {
    {3141325.2729622815, 2088518.4463188951}, {3141324.9870817498, 2088518.3692141469},
    {3141324.7012066157, 2088518.2920893908}, {3141324.4153260845, 2088518.2149846426},
    {3141324.1294509503, 2088518.1378598865}, {3141323.8435704187, 2088518.0607551385},
    {3141323.5576952845, 2088517.9836303822}, {3141323.2718147533, 2088517.9065256342},
    {3141322.9859396191, 2088517.8294008782}, {3141322.7000590879, 2088517.7522961299},
    {3141322.4141839533, 2088517.6751713739}, {3141322.1283034221, 2088517.5980666257},
    {3141321.842428288, 2088517.5209418696}};

TEST(SeriesRanges, OfUnevenPointsAreUsedByFit) {
  const UnevenSeries all[] = {{"parabola", kParabola, 10, 166.60243238194005},
                              {"logarithmic", kLogarithmic, 9, -12.166311890260006},
                              {"zigzag", kZigzag, 9, -164.93560373765663}};
  for (const UnevenSeries& one : all) {
    PointSeries series;
    series.points = one.points;
    const auto free = fit(series, {});
    ASSERT_TRUE(free) << one.name;
    FitJob job;
    PointWish wish;
    wish.index = one.point;
    wish.theta = one.heading_deg / kDegreesOfRadian;
    job.wishes.push_back(wish);
    const auto made = fit(series, job);
    ASSERT_TRUE(made) << one.name << ": " << made.error().what;
    EXPECT_TRUE(made->certificate.proved) << one.name << ": " << made->certificate.reason;
    EXPECT_LE(made->certificate.vertices, free->certificate.vertices) << one.name;
    EXPECT_LE(made->certificate.inflections, free->certificate.inflections) << one.name;
  }
}

}  // namespace
}  // namespace obvid
