// SPDX-License-Identifier: Apache-2.0
// Contours that follow a dragged point: the same as formed anew, whatever the way it was found.
#include "obvid/pipeline/live_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "obvid/certify/certify.h"

namespace obvid {
namespace {

struct Dragged {
  std::string name;
  PointSeries series;
  FitJob job;
};

PointSeries series_along(std::size_t n, const std::function<Vec2(double)>& curve) {
  PointSeries out;
  for (std::size_t i = 0; i < n; ++i) {
    out.points.push_back(curve(static_cast<double>(i) / static_cast<double>(n - 1)));
  }
  return out;
}

PointSeries ring(std::size_t n) {
  PointSeries out;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    out.points.push_back({3.0 * std::cos(t), 2.0 * std::sin(t) + 0.3 * std::sin(2.0 * t)});
  }
  return out;
}

std::vector<Dragged> dragged_contours() {
  const auto spiral = [](double t) {
    const double r = std::exp(1.5 * t);
    return Vec2{r * std::cos(6.0 * t), r * std::sin(6.0 * t)};
  };
  const auto wave = [](double t) { return Vec2{20.0 * t, std::sin(20.0 * t) + 0.2 * t * t}; };
  std::vector<Dragged> out;
  for (const Continuity continuity : {Continuity::kG2, Continuity::kG3}) {
    FitJob job;
    job.continuity = continuity;
    const std::string name = to_string(continuity);
    out.push_back({name + " spiral", series_along(160, spiral), job});
    out.push_back({name + " wave", series_along(180, wave), job});
    job.closing = Closing::kClosed;
    out.push_back({name + " ring", ring(160), job});
  }
  return out;
}

/// Largest distance of two contours with the same pieces, in chords of these.
double apart(const Contour& a, const Contour& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    const double chord = norm(end_point(a.pieces[i]) - start_point(a.pieces[i]));
    for (const double t : {0.25, 0.5, 0.75}) {
      const Vec2 p = evaluate(a.pieces[i], t).point;
      // beside the nearest place of the other one: its parameter may run otherwise
      double u = t;
      for (int k = 0; k < 4; ++k) {
        const Jet jet = evaluate(b.pieces[i], u);
        u -= dot(jet.point - p, jet.d1) / dot(jet.d1, jet.d1);
      }
      most = std::max(most, norm(evaluate(b.pieces[i], u).point - p) / chord);
    }
  }
  return most;
}

TEST(LiveFit, FollowsADraggedPointLikeAContourFormedAnew) {
  std::mt19937_64 random(20261123);
  const auto between = [&](double low, double high) {
    return low + (high - low) * std::generate_canonical<double, 53>(random);
  };
  for (Dragged& one : dragged_contours()) {
    Watch watch;
    auto live = LiveFit::form(one.series, one.job, watch);
    ASSERT_TRUE(live.has_value()) << one.name;
    int parts = 0, given_up = 0;
    double worst = 0.0;
    constexpr int kMoves = 20;
    std::size_t i = 0;
    for (int k = 0; k < kMoves; ++k) {
      // mostly moves that leave the directions as they are; every fifth makes vertices, and the
      // next one takes it back
      const std::size_t n = one.series.points.size();
      const bool back = k % 5 == 4;
      if (!back) i = static_cast<std::size_t>(between(0.0, static_cast<double>(n)));
      const Vec2 was = one.series.points[i];
      const double chord = norm(one.series.points[(i + 1) % n] - was);
      const double exponent = k % 5 == 3 ? between(-2.5, -1.5) : between(-7.0, -5.0);
      const double size = back ? 0.0 : std::pow(10.0, exponent) * chord;
      const auto change = live->move_point(i, was + size * unit_at(between(0.0, 6.3)), watch);
      ASSERT_TRUE(change.has_value()) << one.name << " " << i;
      parts += change->whole ? 0 : 1;
      const auto anew = fit(live->series(), one.job);
      ASSERT_TRUE(anew.has_value());
      const Certificate &here = live->certificate(), &there = anew->certificate;
      EXPECT_EQ(here.proved, there.proved);
      EXPECT_LE(here.vertices, there.vertices) << one.name << " " << i;
      EXPECT_LE(here.inflections, there.inflections) << one.name << " " << i;
      if (live->contour().pieces.size() != anew->contour.pieces.size()) {
        // the search for one piece to a link gave up, although there is one
        EXPECT_LT(live->contour().pieces.size(), anew->contour.pieces.size());
        ++given_up;
        continue;
      }
      worst = std::max(worst, apart(live->contour(), anew->contour));
      const Certificate again = certify(live->contour());
      EXPECT_EQ(again.proved, live->certificate().proved);
    }
    EXPECT_LE(worst, 1e-9) << one.name;
    EXPECT_GE(parts, kMoves / 4) << one.name;
    EXPECT_LE(given_up, kMoves / 4) << one.name;
    std::printf("%s: %d of %d moves in part, %d searches given up, %.2g chords apart\n",
                one.name.c_str(), parts, kMoves, given_up, worst);
  }
}

TEST(LiveFit, KeepsTheContourWhenAMoveHasNone) {
  for (Dragged& one : dragged_contours()) {
    Watch watch;
    auto live = LiveFit::form(one.series, one.job, watch);
    ASSERT_TRUE(live.has_value());
    const Vec2 was = live->series().points[50];
    const Contour before = live->contour();
    EXPECT_FALSE(live->move_point(50, {std::nan(""), 0.0}, watch).has_value());
    EXPECT_FALSE(live->move_point(one.series.points.size(), was, watch).has_value());
    EXPECT_EQ(live->series().points[50], was);
    EXPECT_EQ(apart(live->contour(), before), 0.0);
    EXPECT_TRUE(live->move_point(50, was, watch).has_value());
  }
}

TEST(LiveFit, FormsTheWholeAnewWhereANeighbourhoodDoesNotDo) {
  Dragged one = dragged_contours().front();
  one.job.carrier = Carrier::kArcs;
  Watch watch;
  auto live = LiveFit::form(one.series, one.job, watch);
  ASSERT_TRUE(live.has_value());
  const auto change = live->move_point(50, 1.0001 * one.series.points[50], watch);
  ASSERT_TRUE(change.has_value());
  EXPECT_TRUE(change->whole);
  const auto anew = fit(live->series(), one.job);
  ASSERT_TRUE(anew.has_value());
  ASSERT_EQ(live->contour().pieces.size(), anew->contour.pieces.size());
  EXPECT_EQ(apart(live->contour(), anew->contour), 0.0);
}

}  // namespace
}  // namespace obvid
