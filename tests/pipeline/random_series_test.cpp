// SPDX-License-Identifier: Apache-2.0
// 2,000 random series on exact curves: every one is proved, and no further from its curve than the
// points themselves allow.
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
#include "rounding_words.h"

namespace obvid {
namespace {

using namespace test;

const int kRandomSeries = test::cases_of(2000, 5);
const int kSmoothSeries = test::cases_of(2000, 20);
constexpr double kCoarseTurning = 170.0 * std::numbers::pi / 180.0;
constexpr unsigned kSeed = 20260131;

PointSeries series_of(const Sampled& s) {
  PointSeries series;
  series.points = s.points;
  return series;
}

/// Largest relative blur that rounding to doubles brought into the differences of the adjacent
/// curvatures, computed from the unrounded points: near 1 the doubles no longer hold the curve.
double rounding_blur(const Sampled& s) {
  const auto exact_kappa = [&](std::size_t i) {
    const LongVec2 p = s.truth(s.parameters[i - 1]), q = s.truth(s.parameters[i]),
                   r = s.truth(s.parameters[i + 1]);
    const long double ax = q.x - p.x, ay = q.y - p.y, bx = r.x - q.x, by = r.y - q.y;
    return 2.0L * (ax * by - ay * bx) /
           (std::hypot(ax, ay) * std::hypot(bx, by) * std::hypot(ax + bx, ay + by));
  };
  double blur = 0.0;
  for (std::size_t i = 1; i + 2 < s.points.size(); ++i) {
    const auto change = static_cast<double>(exact_kappa(i + 1) - exact_kappa(i));
    const Vec2 p = s.points[i], q = s.points[i + 1];
    const double rounding = 0x1p-53 * (std::abs(p.x) + std::abs(p.y));
    const double before = norm(p - s.points[i - 1]), here = norm(q - p);
    const double after = norm(s.points[i + 2] - q);
    const double noise = 2.0 * rounding * (1.0 / (before * here) + 1.0 / (here * after));
    blur = std::max(blur, noise / std::abs(change));
  }
  return blur;
}

/// A point of the contour relative to an anchor, without rounding to the anchor's coordinates.
Vec2 relative_point(const Piece& piece, double t, Vec2 anchor) {
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) {
    RationalBezier local = *bezier;
    local.origin = bezier->origin - anchor;
    if (bezier->origin == Vec2{}) {
      for (int j = 0; j <= local.degree; ++j) {
        const auto k = static_cast<std::size_t>(j);
        local.offset[k] = local.offset[k] - anchor;
      }
      local.origin = {};
    }
    return evaluate(local, t).point;
  }
  return evaluate(piece, t).point - anchor;
}

/// Distance of the truth from a contour point, across the chord from point i to i + 1.
double distance_across_chord(const Sampled& s, std::size_t i, Vec2 on_contour) {
  const Vec2 p = s.points[i], chord = s.points[i + 1] - p;
  const Vec2 u = chord / norm(chord);
  const double x = dot(u, on_contour);
  // the method of false position with halved weights (Illinois): the truth is dear
  long double low = s.parameters[i], high = s.parameters[i + 1];
  double below = -x, above = norm(chord) - x, last = 0.0;
  Vec2 v = below * below < above * above ? Vec2{} : chord;
  constexpr int kMost = 45;
  const double enough = 0x1p-53 * norm(chord);
  for (int k = 0; k < kMost && above > 0.0 && below < 0.0; ++k) {
    const long double at = low + (high - low) * (-below / (above - below));
    const LongVec2 z = s.truth(at);
    v = {static_cast<double>(z.x - p.x), static_cast<double>(z.y - p.y)};
    const double off = dot(u, v) - x;
    if (std::abs(off) <= enough) break;
    (off < 0.0 ? low : high) = at;
    (off < 0.0 ? below : above) = off;
    if (off * last > 0.0) (off < 0.0 ? above : below) *= 0.5;
    last = off;
  }
  return std::abs(cross(u, v) - cross(u, on_contour));
}

struct Deviation {
  double of_chord = 0.0;        ///< largest, relative to the chord
  double of_points_only = 0.0;  ///< largest, relative to the points-only error
};

Deviation deviation_from_truth(const Sampled& s, const Fit& f) {
  Deviation worst;
  std::size_t segment = 0;
  for (std::size_t k = 0; k < f.contour.pieces.size(); ++k) {
    if (k > 0 && f.contour.joints[k].source) ++segment;
    const double h = f.report.segments[segment].chord;
    const double bound = f.report.segments[segment].points_only_error;
    const Vec2 anchor = s.points[segment];
    const double rounding = 8.0 * 0x1p-53 * (std::abs(anchor.x) + std::abs(anchor.y) + h);
    for (const double t : {0.3, 0.7}) {
      const double d =
          distance_across_chord(s, segment, relative_point(f.contour.pieces[k], t, anchor));
      worst.of_chord = std::max(worst.of_chord, d / h);
      if (std::isnan(bound)) continue;
      worst.of_points_only = std::max(worst.of_points_only, std::max(0.0, d - rounding) / bound);
    }
  }
  return worst;
}

double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

TEST(RandomSeries, EveryOneGetsAProvedMonotoneContourNearerToTheTruthThanThePointsOnlyError) {
  std::mt19937_64 rng(kSeed);
  std::vector<double> deviations, ratios;
  int proved = 0, decided_by_rounding = 0;
  for (int i = 0; i < kRandomSeries; ++i) {
    const Sampled s = random_series(static_cast<Oracle>(i % kOracleCount), rng, kRightAngle);
    const auto f = fit(series_of(s), FitJob{});
    const std::string what = std::to_string(i) + ": " + name_of(s.curve.kind) + ", " +
                             std::to_string(s.points.size()) + " points";
    if (f) {
      EXPECT_EQ(f->certificate.corners, 0) << what;
    }
    if (!f || !f->certificate.proved || f->certificate.vertices != 0) {
      // the only excuse: doubles do not hold this curve, and the engine says so
      EXPECT_TRUE(speaks_of_rounding(f))
          << what << ": " << (f ? f->certificate.reason : f.error().what);
      EXPECT_GT(rounding_blur(s), 0.01) << what;
      ++decided_by_rounding;
      continue;
    }
    ++proved;
    EXPECT_LE(f->report.inflections, s.curve.kind == Oracle::kInflectedClothoid ? 1 : 0) << what;
    EXPECT_LE(f->report.largest_width, f->report.tolerance) << what;
    const Deviation d = deviation_from_truth(s, *f);
    deviations.push_back(d.of_chord);
    ratios.push_back(d.of_points_only);
    EXPECT_LE(d.of_points_only, 1.0) << what;
  }
  std::printf("%d series: %d proved, %d decided by the rounding of their coordinates\n",
              kRandomSeries, proved, decided_by_rounding);
  std::printf("distance from the truth over the chord: median %.2e, 95 %% %.2e, largest %.2e\n",
              quantile(deviations, 0.5), quantile(deviations, 0.95), quantile(deviations, 1.0));
  std::printf("over the points-only error: median %.3f, 95 %% %.3f, largest %.3f\n",
              quantile(ratios, 0.5), quantile(ratios, 0.95), quantile(ratios, 1.0));
  EXPECT_GE(proved, kRandomSeries * 99 / 100);
}

/// Largest distance of places of one contour from another through the same points, of the longest
/// chord.
double distance_of_contours(const Contour& one, const Contour& other) {
  std::size_t k = 0;
  double far = 0.0, chord = 0.0;
  for (std::size_t i = 1; i < one.points.size(); ++i) {
    chord = std::max(chord, norm(one.points[i] - one.points[i - 1]));
  }
  for (std::size_t i = 0; i < one.pieces.size(); ++i) {
    const auto source = one.joints[i].source;
    while (source && other.joints[k].source != source) ++k;
    const Vec2 p = evaluate(one.pieces[i], 0.5).point;
    double least = INFINITY;
    for (std::size_t j = k; j < other.pieces.size() && (j == k || !other.joints[j].source); ++j) {
      double u = 0.5;
      for (int step = 0; step < 12; ++step) {
        const Jet jet = evaluate(other.pieces[j], u);
        u = std::clamp(u - dot(jet.point - p, jet.d1) / dot(jet.d1, jet.d1), 0.0, 1.0);
      }
      least = std::min(least, norm(evaluate(other.pieces[j], u).point - p));
    }
    far = std::max(far, least);
  }
  return far / chord;
}

void print_both(const char* what, const std::vector<double>& flat,
                const std::vector<double>& smooth) {
  std::printf("%s: G2 median %.3g, 95 %% %.3g, largest %.3g; G3 %.3g, %.3g, %.3g\n", what,
              quantile(flat, 0.5), quantile(flat, 0.95), quantile(flat, 1.0), quantile(smooth, 0.5),
              quantile(smooth, 0.95), quantile(smooth, 1.0));
}

TEST(RandomSeries, WithContinuousSlopesHaveNoVertexMoreAndAreNearerToTheTruth) {
  std::mt19937_64 rng(kSeed);
  std::vector<double> flat_far, smooth_far, flat_waves, smooth_waves, between, gaps, ratios;
  int both = 0, lost = 0;
  std::size_t joints = 0, steps = 0;
  for (int i = 0; i < kSmoothSeries; ++i) {
    const Sampled s = random_series(static_cast<Oracle>(i % kOracleCount), rng, kRightAngle);
    FitJob job;
    job.continuity = Continuity::kG2;
    const auto flat = fit(series_of(s), job);
    if (!flat || !flat->certificate.proved || flat->certificate.vertices != 0) continue;
    job.continuity = Continuity::kG3;
    const auto smooth = fit(series_of(s), job);
    const std::string what = std::to_string(i) + ": " + name_of(s.curve.kind) + ", " +
                             std::to_string(s.points.size()) + " points";
    ASSERT_TRUE(smooth) << what;
    EXPECT_TRUE(smooth->certificate.proved) << what << ": " << smooth->certificate.reason;
    EXPECT_EQ(smooth->certificate.vertices, flat->certificate.vertices) << what;
    EXPECT_EQ(smooth->certificate.inflections, flat->certificate.inflections) << what;
    joints += smooth->contour.joints.size() - 2;
    if (smooth->contour.continuity != Continuity::kG3) {
      ++lost;
      steps += smooth->contour.joints.size() - 2;
      continue;
    }
    ++both;
    steps += static_cast<std::size_t>(smooth->certificate.slope_steps);
    gaps.push_back(*smooth->certificate.gaps.slope);
    flat_far.push_back(deviation_from_truth(s, *flat).of_chord);
    smooth_far.push_back(deviation_from_truth(s, *smooth).of_chord);
    ratios.push_back(smooth_far.back() / flat_far.back());
    between.push_back(distance_of_contours(smooth->contour, flat->contour));
    if (!flat->report.waviness || !smooth->report.waviness) continue;
    flat_waves.push_back(*flat->report.waviness);
    smooth_waves.push_back(*smooth->report.waviness);
  }
  std::printf("%d series in both, %d gave way to G2; %zu of %zu joints step\n", both, lost, steps,
              joints);
  std::printf("gap of the slope: median %.2g, 99 %% %.2g, largest %.2g\n", quantile(gaps, 0.5),
              quantile(gaps, 0.99), quantile(gaps, 1.0));
  print_both("distance from the truth over the chord", flat_far, smooth_far);
  print_both("waviness", flat_waves, smooth_waves);
  std::printf("distance, G3 over G2: median %.2g, 95 %% %.2g\n", quantile(ratios, 0.5),
              quantile(ratios, 0.95));
  std::printf("G3 from G2, of the longest chord: median %.2g, 95 %% %.2g, largest %.2g\n",
              quantile(between, 0.5), quantile(between, 0.95), quantile(between, 1.0));
  EXPECT_LE(static_cast<double>(steps), 0.01 * static_cast<double>(joints));
  EXPECT_LE(quantile(gaps, 0.99), 1e-6);
  EXPECT_LT(quantile(smooth_far, 0.5), quantile(flat_far, 0.5));
  EXPECT_LT(quantile(smooth_waves, 0.5), quantile(flat_waves, 0.5));
}

TEST(RandomSeries, ArcsAreProvedWithMonotoneRadiiAndKeepTheTolerance) {
  std::mt19937_64 rng(kSeed + 1);
  int proved = 0;
  FitJob job;
  job.carrier = Carrier::kArcs;
  for (int i = 0; i < kRandomSeries / 2; ++i) {
    const Sampled s = random_series(static_cast<Oracle>(i % kOracleCount), rng, kRightAngle);
    const auto f = fit(series_of(s), job);
    const std::string what = std::to_string(i) + ": " + name_of(s.curve.kind);
    if (f) {
      EXPECT_EQ(f->certificate.corners, 0) << what;
    }
    if (!f || !f->certificate.proved || f->certificate.vertices != 0) {
      EXPECT_TRUE(speaks_of_rounding(f))
          << what << ": " << (f ? f->certificate.reason : f.error().what);
      continue;
    }
    ++proved;
    EXPECT_LE(f->report.largest_width, f->report.tolerance) << what;
  }
  std::printf("%d of %d arc contours proved\n", proved, kRandomSeries / 2);
  EXPECT_GE(proved, kRandomSeries / 2 * 99 / 100);
}

TEST(RandomSeries, CoarseOnesAreProvedOrRefusedWithTheReason) {
  std::mt19937_64 rng(kSeed + 2);
  int proved = 0, refused = 0;
  for (int i = 0; i < kRandomSeries / 4; ++i) {
    const Sampled s = random_series(static_cast<Oracle>(i % kOracleCount), rng, kCoarseTurning);
    const auto f = fit(series_of(s), FitJob{});
    if (f) {
      proved += f->certificate.proved ? 1 : 0;
      EXPECT_TRUE(f->certificate.proved || !f->certificate.reason.empty());
    } else {
      ++refused;
      EXPECT_EQ(exit_code(f.error().code), 4) << f.error().what;
      EXPECT_FALSE(f.error().what.empty());
    }
  }
  std::printf("coarse: %d proved, %d refused of %d\n", proved, refused, kRandomSeries / 4);
  EXPECT_GE(proved, kRandomSeries / 4 * 95 / 100);
}

}  // namespace
}  // namespace obvid
