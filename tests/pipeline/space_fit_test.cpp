// SPDX-License-Identifier: Apache-2.0
// Points of space: planes are found, other curves have the curvature and torsion of known ones.
#include "obvid/pipeline/space_fit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "obvid/exchange/internal/dxf/space.h"
#include "obvid/exchange/internal/step/write.h"

namespace obvid {
namespace {

SpaceSeries series_on(const std::function<Vec3(double)>& curve, int count) {
  SpaceSeries out;
  out.name = "curve";
  for (int i = 0; i < count; ++i) out.points.push_back(curve(static_cast<double>(i) / (count - 1)));
  return out;
}

/// On a cone: projection a logarithmic spiral, heights in proportion to its length.
Vec3 conical(double u) {
  const double r = 50.0 * std::exp(0.5 * u);
  return {r * std::cos(2.0 * u), r * std::sin(2.0 * u), 0.8 * r};
}

/// Curvature and torsion of `conical`, by its derivatives: r e^(zu) with z = 0.5 + 2i.
std::pair<double, double> shape_of_conical(double u) {
  const double r = 50.0 * std::exp(0.5 * u);
  const auto turned = [&](double re, double im, double height) {
    const double c = std::cos(2.0 * u), s = std::sin(2.0 * u);
    return Vec3{r * (re * c - im * s), r * (re * s + im * c), 0.8 * r * height};
  };
  // z = 1/2 + 2i, z^2 = -15/4 + 2i, z^3 = -47/8 - 13i/2
  const Vec3 d1 = turned(0.5, 2.0, 0.5), d2 = turned(-3.75, 2.0, 0.25),
             d3 = turned(-5.875, -6.5, 0.125);
  const Vec3 b = cross(d1, d2);
  return {norm(b) / std::pow(norm(d1), 3), dot(b, d3) / dot(b, b)};
}

double farthest_point(const SpaceNurbs& nurbs, const std::vector<Vec3>& points) {
  double out = 0.0;
  const Range range = domain(nurbs.curve);
  constexpr int kSteps = 20000;
  for (const Vec3& p : points) {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= kSteps; ++k) {
      const double u = range.at(static_cast<double>(k) / kSteps);
      least = std::min(least, norm(evaluate(nurbs.curve, u).point - p));
    }
    out = std::max(out, least);
  }
  return out;
}

TEST(SpaceFitTest, PlanarPointsAreFormedInTheirPlane) {
  const Vec3 x = unit({1, 2, 2}), y = unit(cross(Vec3{0, 3, 1}, x));
  const auto made = fit_space(series_on(
                                  [&](double u) {
                                    const double t = 0.3 + 1.2 * u;
                                    const Vec2 p{35 * (std::cos(t) + t * std::sin(t)),
                                                 35 * (std::sin(t) - t * std::cos(t))};
                                    return Vec3{7, -3, 11} + p.x * x + p.y * y;
                                  },
                                  12),
                              {});
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_FALSE(made->unrolled);
  EXPECT_LT(made->flatness, 1e-12 * 100);
  EXPECT_NEAR(std::abs(dot(made->frame.normal(), cross(x, y))), 1.0, 1e-12);
  EXPECT_TRUE(made->plan.certificate.proved);
  EXPECT_EQ(made->plan.report.vertices, 0);
  const auto nurbs = space_nurbs(*made, 1e-6);
  ASSERT_TRUE(nurbs) << to_line(nurbs.error());
  EXPECT_EQ(nurbs->deviation, 0.0);
  EXPECT_LT(farthest_point(*nurbs, made->points), 5e-3);  // by steps along the curve
  for (const Vec3& p : nurbs->curve.points) {
    EXPECT_LT(std::abs(dot(p - made->points.front(), made->frame.normal())), 1e-11 * 100);
  }
}

TEST(SpaceFitTest, CurvatureAndTorsionAreThoseOfAKnownCurve) {
  constexpr int kPoints = 25;
  SpaceJob job;
  job.along = Vec3{0, 0, 1};
  job.fit.continuity = Continuity::kG3;
  job.fit.noise = 1e-9;
  const auto made = fit_space(series_on(conical, kPoints), job);
  ASSERT_TRUE(made) << to_line(made.error());
  ASSERT_TRUE(made->unrolled);
  ASSERT_EQ(made->at_points.size(), static_cast<std::size_t>(kPoints));
  double first = 0.0, last = 0.0;
  for (int i = 3; i + 3 < kPoints; ++i) {
    const auto [curvature, torsion] = shape_of_conical(static_cast<double>(i) / (kPoints - 1));
    const SpacePoint& at = made->at_points[static_cast<std::size_t>(i)];
    EXPECT_NEAR(at.curvature, curvature, 2e-3 * curvature) << i;
    ASSERT_TRUE(at.torsion);
    EXPECT_NEAR(*at.torsion, torsion, 2e-2 * torsion) << i;
    last = curvature;
    if (i == 3) first = curvature;
  }
  EXPECT_GE(made->largest_curvature, first);
  EXPECT_LE(made->least_curvature, last);
  EXPECT_LT(made->torsion_step, 1e-6 * made->largest_torsion);
}

/// The bound of the deviation holds between the places that it looked at, and is not idle.
TEST(SpaceFitTest, TheCubicIsWithinItsBound) {
  SpaceJob job;
  job.along = Vec3{0, 0, 1};
  job.fit.noise = 1e-9;
  const auto made = fit_space(series_on(conical, 9), job);
  ASSERT_TRUE(made) << to_line(made.error());
  const auto fine = space_nurbs(*made, 1e-7);
  ASSERT_TRUE(fine);
  for (const double tolerance : {1e-1, 1e-2, 1e-3}) {
    const auto rough = space_nurbs(*made, tolerance);
    ASSERT_TRUE(rough);
    EXPECT_LE(rough->deviation, tolerance);
    const Range range = domain(rough->curve);
    EXPECT_NEAR(range.to, domain(fine->curve).to, 1e-9);
    double largest = 0.0;
    for (int k = 0; k <= 10007; ++k) {
      const double u = range.at(k / 10007.0);
      largest =
          std::max(largest, norm(evaluate(rough->curve, u).point - evaluate(fine->curve, u).point));
    }
    EXPECT_LE(largest, rough->deviation + 1e-7);
    // also as a curve by arc length: its speed is 1 within what the tolerance leaves
    EXPECT_NEAR(norm(evaluate(fine->curve, range.at(0.4)).d1), 1.0, 1e-3);
  }
}

TEST(SpaceFitTest, EnclosuresHoldEverywhere) {
  SpaceJob job;
  job.fit.noise = 1e-9;
  const auto made = fit_space(
      series_on(
          [](double u) {
            const double t = 1.4 * u;
            return Vec3{100 * std::cos(t) * (1 + 0.1 * t), 80 * std::sin(t), 20 * t + 6 * t * t};
          },
          12),
      job);
  ASSERT_TRUE(made) << to_line(made.error());
  const auto nurbs = space_nurbs(*made, 1e-8);
  ASSERT_TRUE(nurbs);
  const Range range = domain(nurbs->curve);
  double least = 1.0, largest = 0.0;
  for (int k = 0; k <= 9973; ++k) {
    const double here = curvature(evaluate(nurbs->curve, range.at(k / 9973.0)));
    least = std::min(least, here);
    largest = std::max(largest, here);
  }
  EXPECT_LE(made->least_curvature, least * (1 + 1e-3));
  EXPECT_GE(made->largest_curvature, largest * (1 - 1e-3));
  EXPECT_NEAR(made->least_curvature, least, 0.02 * least);
  EXPECT_NEAR(made->largest_curvature, largest, 0.02 * largest);
}

TEST(SpaceFitTest, NoPointMovesFurtherThanToldAndNoise) {
  SpaceJob job;
  job.fit.noise = 0.01;
  int k = 0;
  const auto made = fit_space(series_on(
                                  [&](double u) {
                                    const double wave = 0.004 * ((++k % 3) - 1);
                                    return conical(u) + Vec3{wave, -wave, wave};
                                  },
                                  15),
                              job);
  ASSERT_TRUE(made) << to_line(made.error());
  ASSERT_TRUE(made->unrolled);
  EXPECT_LE(made->largest_move, std::sqrt(2.0) * 0.01 * (1 + 1e-9));
  const auto nurbs = space_nurbs(*made, 1e-5);
  ASSERT_TRUE(nurbs);
  EXPECT_LE(farthest_point(*nurbs, made->points), made->largest_move + 1e-4);
}

TEST(SpaceFitTest, WhatIsNotFormedIsRefusedByName) {
  const auto twisted = series_on(conical, 9);
  SpaceJob job;
  job.fit.carrier = Carrier::kArcs;
  auto made = fit_space(twisted, job);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kBadOption);
  job = {};
  job.fit.start_heading = 0.5;
  made = fit_space(twisted, job);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().hint.find("--along Z"), std::string::npos);
  job.along = Vec3{0, 0, 0};
  made = fit_space(twisted, job);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kBadOption);
  SpaceSeries cornered;  // closed, with corners
  cornered.points = {{0, 0, 0},  {5, 0, 1},  {10, 0, 0}, {10, 5, 1}, {10, 10, 0},
                     {5, 10, 1}, {0, 10, 0}, {0, 5, 1},  {0, 0, 0}};
  job = {};
  job.along = Vec3{0, 0, 1};
  job.fit.constraints = {{2, {}, {}, true}};
  made = fit_space(cornered, job);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kUnsupported);
}

/// On a cylinder of radius 50, heights 10 cos(2t + phase).
Vec3 saddle(double t, double phase) {
  return {50 * std::cos(t), 50 * std::sin(t), 10 * std::cos(2 * t + phase)};
}

/// Curvature and torsion of `saddle`, by its derivatives.
std::pair<double, double> shape_of_saddle(double t, double phase) {
  const double c = std::cos(t), s = std::sin(t), w = 2 * t + phase;
  const Vec3 d1{-50 * s, 50 * c, -20 * std::sin(w)}, d2{-50 * c, -50 * s, -40 * std::cos(w)},
      d3{50 * s, -50 * c, 80 * std::sin(w)};
  const Vec3 b = cross(d1, d2);
  return {norm(b) / std::pow(norm(d1), 3), dot(b, d3) / dot(b, b)};
}

/// `repeated`: the first point comes again at the end.
SpaceSeries saddle_series(int count, double phase, bool repeated) {
  SpaceSeries out;
  out.name = "saddle";
  for (int i = 0; i < count; ++i) {
    out.points.push_back(saddle(2.0 * std::numbers::pi * i / count, phase));
  }
  if (repeated) out.points.push_back(out.points.front());
  return out;
}

/// Curvature at the seam, torsion away from it as at every joint.
TEST(SpaceFitTest, AClosedCurveHasTheCurvatureAndTorsionOfAKnownOneAllRound) {
  constexpr int kPoints = 64;
  for (const double phase : {0.0, 0.7}) {
    for (const bool repeated : {true, false}) {
      SpaceJob job;
      job.along = Vec3{0, 0, 1};
      job.fit.closing = repeated ? Closing::kAutomatic : Closing::kClosed;
      const auto made = fit_space(saddle_series(kPoints, phase, repeated), job);
      ASSERT_TRUE(made) << to_line(made.error());
      ASSERT_TRUE(made->seam);
      EXPECT_TRUE(made->plan.certificate.proved && made->unrolled->certificate.proved);
      ASSERT_EQ(made->at_points.size(), made->points.size());
      for (std::size_t i = 0; i < made->points.size(); ++i) {
        const auto [curvature, torsion] =
            shape_of_saddle(2.0 * std::numbers::pi * static_cast<double>(i) / kPoints, phase);
        const SpacePoint& at = made->at_points[i];
        EXPECT_NEAR(at.curvature, curvature, 3e-3 * 0.026) << i;
        ASSERT_TRUE(at.torsion && at.torsion_after);
        EXPECT_NEAR(*at.torsion, torsion, 0.15 * 0.022) << i;
        EXPECT_NEAR(*at.torsion_after, torsion, 0.15 * 0.022) << i;
      }
      // the seam's own step is among those that are told
      const SpacePoint& first = made->at_points.front();
      EXPECT_GE(made->torsion_step, std::abs(*first.torsion_after - *first.torsion) * (1 - 1e-9));
    }
  }
}

/// Where it begins it ends, with one tangent and one curvature: also as the NURBS curve.
TEST(SpaceFitTest, TheCubicOfAClosedCurveIsSmoothAtItsSeam) {
  SpaceJob job;
  const auto made = fit_space(saddle_series(24, 0.7, true), job);
  ASSERT_TRUE(made) << to_line(made.error());
  const auto nurbs = space_nurbs(*made, 1e-3);
  ASSERT_TRUE(nurbs) << to_line(nurbs.error());
  ASSERT_TRUE(check(nurbs->curve));
  EXPECT_EQ(nurbs->curve.points.front(), nurbs->curve.points.back());
  const Range range = domain(nurbs->curve);
  const SpaceJet begin = evaluate(nurbs->curve, range.from), end = evaluate(nurbs->curve, range.to);
  EXPECT_LT(norm(end.d1 - begin.d1), 1e-9);
  EXPECT_LT(norm(end.d2 - begin.d2), 1e-9);
  const std::string dxf = space_dxf({nurbs->curve}, made->points, made->units);
  EXPECT_NE(dxf.find(" 70\n1\n"), std::string::npos);  // closed
}

/// A projection with noise begins where the search for it began: heights follow.
TEST(SpaceFitTest, ANoisyClosedCurveKeepsItsTolerance) {
  SpaceSeries series = saddle_series(40, 0.7, true);
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    const double wave = 0.004 * (static_cast<double>(i % 3) - 1.0);
    series.points[i] = series.points[i] + Vec3{wave, -wave, wave};
  }
  SpaceJob job;
  job.along = Vec3{0, 0, 1};
  job.fit.noise = 0.01;
  const auto made = fit_space(series, job);
  ASSERT_TRUE(made) << to_line(made.error());
  ASSERT_TRUE(made->seam);
  const auto nurbs = space_nurbs(*made, 1e-5);
  ASSERT_TRUE(nurbs);
  EXPECT_LE(farthest_point(*nurbs, made->points), made->largest_move + 1e-3);
  const auto stored = space_from_json(space_fit_json(*made, *nurbs), "curve.json");
  ASSERT_TRUE(stored) << to_line(stored.error());
  const auto broken = broken_promise(*stored, verify(*stored));
  EXPECT_FALSE(broken) << to_line(*broken);
}

TEST(SpaceFitTest, AHelixOfAWholeTurnIsOpenAlthoughItsProjectionReturns) {
  const double r = 40.0, b = 5.0;
  const auto helix = series_on(
      [&](double u) {
        const double t = 2.0 * std::numbers::pi * u;
        return Vec3{r * std::cos(t), r * std::sin(t), b * t};
      },
      17);
  SpaceSeries whole = helix;
  whole.points.back().x = r;  // cos and sin of a whole turn, without their rounding
  whole.points.back().y = 0.0;
  SpaceJob job;
  job.along = Vec3{0, 0, 1};
  const auto made = fit_space(whole, job);
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_FALSE(made->plan.contour.closed);
  const double curvature = r / (r * r + b * b), torsion = b / (r * r + b * b);
  EXPECT_LE(made->least_curvature, curvature * (1 + 1e-9));
  EXPECT_GE(made->largest_curvature, curvature * (1 - 1e-9));
  EXPECT_NEAR(made->least_torsion, torsion, 1e-6 * torsion);
  EXPECT_NEAR(made->largest_torsion, torsion, 1e-6 * torsion);
}

/// A curve of a known cone, as its file has it.
StoredSpace stored_conical() {
  const auto made = fit_space(series_on(conical, 9), {});
  EXPECT_TRUE(made);
  const auto nurbs = space_nurbs(*made, 1e-4);
  EXPECT_TRUE(nurbs);
  auto stored = space_from_json(space_fit_json(*made, *nurbs), "curve.json");
  EXPECT_TRUE(stored) << to_line(stored.error());
  return std::move(*stored);
}

std::string false_claim(const StoredSpace& stored) {
  const auto found = verify(stored);
  return found.false_claim ? found.false_claim->where : "";
}

TEST(SpaceFitTest, AFileIsProvedAgainAndEveryFalseFigureIsFound) {
  const StoredSpace sound = stored_conical();
  const auto found = verify(sound);
  EXPECT_FALSE(broken_promise(sound, found));
  EXPECT_TRUE(found.plan.certificate.proved);
  ASSERT_TRUE(found.heights);
  EXPECT_TRUE(found.heights->certificate.proved);
  const auto doctored = [&](auto change) {
    StoredSpace one = sound;
    change(one);
    return false_claim(one);
  };
  using Stored = StoredSpace;
  EXPECT_EQ(doctored([](Stored& s) { s.normal.x += 1e-6; }), "/frame");
  EXPECT_EQ(doctored([](Stored& s) { s.frame.x = 1.001 * s.frame.x; }), "/frame");
  EXPECT_EQ(doctored([](Stored& s) { s.points[3].x += 1e-6; }).substr(0, 1), "/");
  EXPECT_EQ(doctored([](Stored& s) { s.flatness = 1e-3; }), "/flatness");
  EXPECT_EQ(doctored([](Stored& s) { s.figures.least_curvature *= 1.001; }), "/least_curvature");
  EXPECT_EQ(doctored([](Stored& s) { s.figures.largest_curvature *= 0.999; }),
            "/largest_curvature");
  EXPECT_EQ(doctored([](Stored& s) { s.figures.torsion_places += 1; }), "/torsion_places");
  EXPECT_EQ(doctored([](Stored& s) { s.figures.least_torsion *= 0.999; }), "/least_torsion");
  EXPECT_EQ(doctored([](Stored& s) { s.figures.largest_torsion *= 1.001; }), "/largest_torsion");
  EXPECT_EQ(doctored([](Stored& s) { s.figures.torsion_step += 1e-3; }), "/torsion_step");
  EXPECT_EQ(doctored([](Stored& s) { s.deviation *= 0.05; }), "/curve/deviation");
  EXPECT_EQ(doctored([](Stored& s) { s.deviation = 0.0; }), "/curve/deviation");
  EXPECT_EQ(doctored([](Stored& s) { s.curve.points[2].z += 1e-2; }), "/curve/deviation");
  // a contour that is none is found by its own proof
  Stored bent = sound;
  std::get<RationalBezier>(bent.heights->contour.pieces.front()).offset[1].y += 1.0;
  EXPECT_TRUE(broken_promise(bent, verify(bent)));
}

TEST(SpaceFitTest, AClosedFileIsProvedAgainAndAFalseSeamIsFound) {
  const auto made = fit_space(saddle_series(24, 0.7, true), {});
  ASSERT_TRUE(made) << to_line(made.error());
  const auto nurbs = space_nurbs(*made, 1e-4);
  ASSERT_TRUE(nurbs);
  const auto sound = space_from_json(space_fit_json(*made, *nurbs), "curve.json");
  ASSERT_TRUE(sound) << to_line(sound.error());
  const SpaceVerification verified = verify(*sound);
  EXPECT_FALSE(broken_promise(*sound, verified));
  // gaps at the seam are rounding: those of the file are held against their bounds alone
  const char* told = "/seam (only that its gaps are within bounds)";
  EXPECT_EQ(std::count(verified.not_checked.begin(), verified.not_checked.end(), told), 1);
  const auto doctored = [&](auto change) {
    StoredSpace one = *sound;
    change(one);
    return false_claim(one);
  };
  using Stored = StoredSpace;
  EXPECT_EQ(doctored([](Stored& s) { s.seam->position = 1e-3; }), "/seam/position");
  EXPECT_EQ(doctored([](Stored& s) { s.seam->heading = 1e-3; }), "/seam/heading");
  EXPECT_EQ(doctored([](Stored& s) { s.seam->curvature = 1e-3; }), "/seam/curvature");
  EXPECT_EQ(doctored([](Stored& s) { s.curve.points.back().z += 1e-6; }), "/curve/points");
  EXPECT_EQ(doctored([](Stored& s) { s.heights->contour.points.back().y += 1e-6; }),
            fmt::format("/heights/points/{}", sound->heights->contour.points.size() - 1));
  EXPECT_EQ(doctored([](Stored& s) { s.heights->contour.points.pop_back(); }), "/heights/points");
}

/// Numbers in the files are those of the curve.
TEST(SpaceFitTest, StepAndDxfHoldTheCurve) {
  SpaceJob job;
  job.fit.noise = 1e-9;
  const auto made = fit_space(series_on(conical, 9), job);
  ASSERT_TRUE(made) << to_line(made.error());
  const auto nurbs = space_nurbs(*made, 1e-3);
  ASSERT_TRUE(nurbs);
  StepOptions options;
  options.units = "in";
  const auto step = step_text({{"rail", nurbs->curve}}, options);
  ASSERT_TRUE(step) << to_line(step.error());
  const std::string dxf = space_dxf({nurbs->curve}, made->points, made->units);
  std::size_t found = 0;
  for (const Vec3& p : nurbs->curve.points) {
    const std::string place = fmt::format("CARTESIAN_POINT('',({},{},{}))", p.x, p.y, p.z);
    found += step->find(place) != std::string::npos ? 1U : 0U;
    EXPECT_NE(dxf.find(fmt::format(" 10\n{}\n 20\n{}\n 30\n{}\n", p.x, p.y, p.z)),
              std::string::npos);
  }
  EXPECT_GT(found + 2, nurbs->curve.points.size());  // integers have a point in STEP
  EXPECT_NE(step->find("B_SPLINE_CURVE_WITH_KNOTS('',3,"), std::string::npos);
  const std::string text = space_fit_json(*made, *nurbs);
  EXPECT_NE(text.find("\"planar\": false"), std::string::npos);
}

}  // namespace
}  // namespace obvid
