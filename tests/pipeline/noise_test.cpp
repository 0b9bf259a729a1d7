// SPDX-License-Identifier: Apache-2.0
// Spirals with noise of a known size: told that size, the engine finds one run again, near the
// truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "../common/angles.h"
#include "../common/long_runs.h"
#include "../common/oracle_curves.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

using namespace test;

const int kNoisySeries = test::cases_of(500, 4);
constexpr double kLeastNoise = 1e-6, kMostNoise = 1e-3;  // of the diagonal of all points

double diagonal(const std::vector<Vec2>& points) {
  Vec2 low = points.front(), high = low;
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return norm(high - low);
}

Vec2 in_disc(std::mt19937_64& rng, double radius) {
  const double r = radius * std::sqrt(uniform(rng, 0.0, 1.0));
  return r * unit_at(uniform(rng, 0.0, 2.0 * std::numbers::pi));
}

struct NoisySeries {
  Sampled sampled;  ///< points moved already
  double noise = 0.0;
};

double sagitta(double kappa, double chord) {
  const double half = 0.5 * kappa * chord;
  return 0.5 * half * chord / (1.0 + std::sqrt(1.0 - half * half));
}

/// What exact points would leave open: largest width between the circles through neighbouring
/// triples ([000]: every spiral through the points lies between them).
double largest_gap(const std::vector<Vec2>& p) {
  std::vector<double> kappa(p.size());
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const Vec2 u = p[i] - p[i - 1], v = p[i + 1] - p[i];
    kappa[i] = 2.0 * cross(u, v) / (norm(u) * norm(v) * norm(u + v));
  }
  double largest = 0.0;
  for (std::size_t i = 1; i + 2 < p.size(); ++i) {
    const double h = norm(p[i + 1] - p[i]);
    largest = std::max(largest, std::abs(sagitta(kappa[i], h) - sagitta(kappa[i + 1], h)));
  }
  return largest;
}

enum class Sampling {
  kAny,
  kNoiseRules,    ///< noise at least as large as what exact points would leave open
  kEvenAndDense,  ///< and at the ends of the series too, where one cannot look at neighbours
};
constexpr std::size_t kDense = 20;  ///< points

/// Points with noise between the least and the most.
NoisySeries noisy_spiral(int i, std::mt19937_64& rng, Sampling sampling) {
  for (;;) {
    NoisySeries out;
    out.sampled = random_series(static_cast<Oracle>(i % kOracleCount), rng, kRightAngle);
    std::vector<Vec2>& points = out.sampled.points;
    const double size = diagonal(points);
    const double open = sampling == Sampling::kAny ? 0.0 : largest_gap(points) / size;
    const double least = std::max(kLeastNoise, open);
    if (!(least < kMostNoise)) continue;
    const bool even = points.size() >= kDense && !out.sampled.uneven;
    if (sampling == Sampling::kEvenAndDense && !even) continue;
    out.noise = size * std::pow(10.0, uniform(rng, std::log10(least), std::log10(kMostNoise)));
    for (Vec2& p : points) p = p + in_disc(rng, out.noise);
    const auto same = std::adjacent_find(points.begin(), points.end());
    if (same == points.end()) return out;
  }
}

Result<Fit> fit_noisy(const NoisySeries& s) {
  PointSeries series;
  series.points = s.sampled.points;
  FitJob job;
  job.noise = s.noise;
  job.closing = Closing::kOpen;
  return fit(series, job);
}

/// Distance of a point from the truth, by Newton's method for the foot of the perpendicular from
/// the nearest of many samples. The truth goes on beyond its ends.
class Truth {
 public:
  explicit Truth(const Sampled& s) : s_(s) {
    constexpr int kSamples = 500;
    const long double step = (s.curve.t1 - s.curve.t0) / kSamples;
    for (int k = 0; k <= kSamples; ++k) {
      t_.push_back(s.curve.t0 + step * k);
      at_.push_back(s.truth(t_.back()));
    }
  }

  [[nodiscard]] double distance(Vec2 p) const {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < at_.size(); ++k) {
      if (square(at_[k], p) < square(at_[nearest], p)) nearest = k;
    }
    long double t = t_[nearest];
    constexpr int kSteps = 8;
    for (int k = 0; k < kSteps; ++k) {
      const long double h = 1e-5L * (s_.curve.t1 - s_.curve.t0);
      const LongVec2 z = s_.truth(t), a = s_.truth(t - h), b = s_.truth(t + h);
      const long double dx = (b.x - a.x) / (2 * h), dy = (b.y - a.y) / (2 * h);
      t += ((p.x - z.x) * dx + (p.y - z.y) * dy) / (dx * dx + dy * dy);
    }
    return static_cast<double>(std::sqrt(square(s_.truth(t), p)));
  }

 private:
  static long double square(LongVec2 a, Vec2 p) {
    return (a.x - p.x) * (a.x - p.x) + (a.y - p.y) * (a.y - p.y);
  }

  const Sampled& s_;
  std::vector<long double> t_;
  std::vector<LongVec2> at_;
};

double largest_distance(const NoisySeries& s, const Contour& contour) {
  const Truth truth(s.sampled);
  double largest = 0.0;
  for (const Piece& piece : contour.pieces) {
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      largest = std::max(largest, truth.distance(evaluate(piece, t).point));
    }
  }
  return largest;
}

std::string describe(int i, const NoisySeries& s) {
  return std::to_string(i) + ": " + name_of(s.sampled.curve.kind) + ", " +
         std::to_string(s.sampled.points.size()) + " points, noise " +
         std::to_string(std::log10(s.noise / diagonal(s.sampled.points))) +
         (s.sampled.uneven ? ", uneven" : "");
}

struct Outcome {
  int one_run = 0, proved = 0;
  double farthest = 0.0;  ///< from the truth over the noise, where measured
};

Outcome run(unsigned seed, Sampling sampling) {
  std::mt19937_64 rng(seed);
  Outcome out;
  for (int i = 0; i < kNoisySeries; ++i) {
    const NoisySeries s = noisy_spiral(i, rng, sampling);
    const auto f = fit_noisy(s);
    if (!f || !f->certificate.proved) {
      std::printf("%s: %s\n", describe(i, s).c_str(),
                  f ? f->certificate.reason.c_str() : f.error().what.c_str());
      continue;
    }
    ++out.proved;
    const bool one = f->certificate.vertices == 0 && f->certificate.corners == 0;
    if (one) ++out.one_run;
    EXPECT_EQ(f->report.vertices_lower_bound, 0) << describe(i, s);  // the truth is one curve
    if (!one) std::printf("%s: %d vertices\n", describe(i, s).c_str(), f->certificate.vertices);
    if (sampling != Sampling::kEvenAndDense) continue;
    const double d = largest_distance(s, f->contour) / s.noise;
    out.farthest = std::max(out.farthest, d);
    EXPECT_LE(d, 2.0) << describe(i, s);
  }
  std::printf("of %d: %d proved, %d of one run, farthest %.2f\n", kNoisySeries, out.proved,
              out.one_run, out.farthest);
  return out;
}

TEST(Noise, DenseSpiralsComeBackAsOneRunWithinTwiceTheNoise) {
  const Outcome out = run(20260211, Sampling::kEvenAndDense);
  EXPECT_EQ(out.proved, kNoisySeries);
  EXPECT_GE(out.one_run, kNoisySeries * 99 / 100);
}

TEST(Noise, PointsCloserThanTheirNoiseComeBackAsOneRunToo) {
  const Outcome out = run(20260212, Sampling::kNoiseRules);
  EXPECT_GE(out.one_run, kNoisySeries * 99 / 100);
}

TEST(Noise, FewOrUnevenPointsComeBackAsOneRunToo) {
  const Outcome out = run(20260213, Sampling::kAny);
  EXPECT_GE(out.one_run, kNoisySeries * 99 / 100);
}

/// Nearly a circle of radius 1, with points that lie close together.
const std::vector<Vec2> kNearCircle = {
    {0.99323074, 0.08856864},  {0.99166208, 0.12885689},  {0.87269698, 0.48853201},
    {0.42952111, 0.90166977},  {0.38016299, 0.92399598},  {0.38003360, 0.92616107},
    {0.25129504, 0.96790882},  {0.10192947, 0.99301932},  {0.04674127, 0.99788720},
    {0.00842008, 0.99884137},  {-0.20821844, 0.97789343}, {-0.51168257, 0.85874038},
    {-0.69280316, 0.72142241}, {-0.98277032, 0.19081732}};

std::vector<Vec2> uneven_ellipse() {
  std::vector<Vec2> points;
  for (const double t : {0.13, 0.37, 0.72, 2.203, 2.204, 2.54, 3.403, 3.73, 3.78}) {
    points.push_back({std::cos(t), 0.47 * std::sin(t)});
  }
  return points;
}

// The points themselves are within every tolerance.
TEST(Noise, ToleranceNeverRefusesWhatThePointsThemselvesHave) {
  for (const auto& points : {kNearCircle, uneven_ellipse()}) {
    PointSeries series;
    series.points = points;
    for (const Carrier carrier : {Carrier::kSpiral, Carrier::kArcs, Carrier::kConics,
                                  Carrier::kBeziers, Carrier::kBspline, Carrier::kClothoids}) {
      FitJob job;
      job.carrier = carrier;
      const auto exact = fit(series, job);
      if (!exact || !exact->certificate.proved) continue;
      for (const double noise : {1e-9, 1e-6, 1e-4}) {
        job.noise = noise;
        const auto made = fit(series, job);
        ASSERT_TRUE(made) << to_string(carrier) << ' ' << noise << ' ' << to_line(made.error());
        EXPECT_TRUE(made->certificate.proved)
            << to_string(carrier) << ' ' << noise << ' ' << made->certificate.reason;
        EXPECT_LE(made->certificate.largest_move, noise);
        EXPECT_LE(made->certificate.vertices, exact->certificate.vertices);
      }
    }
  }
}

TEST(Noise, PointsThatTurnOneWayGetNoInflection) {
  PointSeries series;  // the ten points of the papers
  series.points = {{0, 0},          {0.21, -5.28},   {-5.11, -10.13}, {-20.48, -7.65},
                   {-28.68, 16.23}, {-13.87, 40.95}, {17.95, 55.28},  {54.24, 53.04},
                   {100.94, 36.19}, {230.38, -50.82}};
  for (const double noise : {1e-5, 1e-3, 1e-2}) {
    FitJob job;
    job.noise = noise;
    const auto made = fit(series, job);
    ASSERT_TRUE(made) << to_line(made.error());
    EXPECT_TRUE(made->certificate.proved) << made->certificate.reason;
    EXPECT_EQ(made->certificate.inflections, 0) << noise;
  }
}

}  // namespace
}  // namespace obvid
