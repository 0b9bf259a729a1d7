// SPDX-License-Identifier: Apache-2.0
// Figures of the worksheet and of its constructions where rounding, circles or seams decide.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "../common/angles.h"
#include "../common/ten_points.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/pipeline/construction_fit.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/region_table.h"

namespace obvid {
namespace {

PointSeries places(std::vector<Vec2> points, const std::vector<double>& thetas = {}) {
  PointSeries out;
  out.points = std::move(points);
  if (!thetas.empty()) out.fixed.resize(thetas.size());
  for (std::size_t i = 0; i < thetas.size(); ++i) out.fixed[i].theta = thetas[i];
  return out;
}

RegionJob table_job(Construction construction) {
  RegionJob job;
  job.construction = construction;
  return job;
}

TEST(WorksheetFigures, AnArcOfMoreThanHalfATurnStandsAsHighAsItIs) {
  constexpr double kRadius = 3.0, kTurn = 200.0 * kOneDegree;
  const auto at = [](double angle) { return kRadius * unit_at(angle); };
  const auto table = region_table(places({at(0.0), at(kTurn), at(kTurn + 0.5), at(kTurn + 1.0)}));
  ASSERT_TRUE(table) << table.error().what;
  ASSERT_TRUE(table->rows[0].lower_height);
  EXPECT_NEAR(*table->rows[0].lower_height, kRadius * (1.0 - std::cos(0.5 * kTurn)), 1e-12);
  const auto arcs = region_table(places({at(0.0), at(kTurn)}, {0.5 * kPi, 0.5 * kPi + kTurn}),
                                 table_job(Construction::kArcs));
  ASSERT_TRUE(arcs) << arcs.error().what;
  ASSERT_EQ(arcs->construction->rows[0].remark, "one arc");
  EXPECT_NEAR(arcs->construction->rows[0].values[2], kRadius * (1.0 - std::cos(0.5 * kTurn)),
              1e-12);
}

TEST(WorksheetFigures, HeadingsBesideALineByATenMillionthAreNotItsOwn) {
  constexpr double kOff = 1e-7;
  const auto table = region_table(
      places({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}}, {0.0, kOff, 0.0, kOff}));
  ASSERT_TRUE(table) << table.error().what;
  ASSERT_EQ(table->rows[0].direction, 1);
  ASSERT_EQ(table->rows[1].direction, 1);
  // the circle from any curvature before: 2 sin(beta)/h, then a biarc with A = kappa/2 + sin(alpha)
  const double first = 2.0 * std::sin(kOff), a = 0.5 * first + std::sin(kOff);
  EXPECT_GT(a, 0.0);  // no spiral goes on from there: the second chord has no range
  EXPECT_FALSE(table->rows[1].kappa_end);
}

TEST(WorksheetFigures, PointsOnOneLineHaveItsCurvature) {
  std::vector<Vec2> points;  // straight but for the last digits
  for (int i = 0; i < 12; ++i) points.push_back({-1.84036174442124 * i, 0.29220695051113 * i});
  RegionJob job;
  job.rule = TangentRule::kNeighbours;
  const auto table = region_table(places(points), job);
  ASSERT_TRUE(table) << table.error().what;
  for (const RegionRow& row : table->rows) {
    ASSERT_EQ(row.direction, 0);
    EXPECT_EQ(row.kappa_start->low, row.kappa_end->low);
  }
}

TEST(WorksheetFigures, ASeamOnAnArcHasTheArcsCurvature) {
  constexpr double kRadius = 0.5;
  std::vector<Vec2> points;  // a slot that begins where its arc ends
  for (const double side : {1.0, -1.0}) {
    points.push_back({side * 2.0, -side * kRadius});
    points.push_back({0.0, -side * kRadius});
    for (int k = 0; k < 6; ++k) {
      points.push_back(Vec2{-side * 2.0, 0.0} +
                       kRadius * unit_at(-side * 0.5 * kPi - kPi * k / 6.0));
    }
  }
  RegionJob job;
  job.job.closing = Closing::kClosed;
  const auto table = region_table(places(points), job);
  ASSERT_TRUE(table) << table.error().what;
  bool any = false;
  for (std::size_t i = 0; i < table->user.rows.size(); ++i) {
    const RegionRow& row = table->user.rows[i];
    if (row.direction != 0) continue;
    any = true;
    ASSERT_TRUE(row.kappa_start && row.kappa_end) << i;
    EXPECT_EQ(row.kappa_start->low, row.kappa_start->high) << i;
    EXPECT_EQ(row.kappa_end->low, row.kappa_end->high) << i;
  }
  EXPECT_TRUE(any);
}

/// The same short chord beside the origin and afar; its coordinates are exact in both places.
struct Afar {
  std::vector<Vec2> near, far;
  Afar() {
    const Vec2 shift{0x1p20, -0x1p21}, chord{0x1p-10, 0.0};
    near = {{0.0, 0.0}, chord};
    far = {shift, shift + chord};
  }
};

TEST(WorksheetFigures, HeightsOfTwoArcsDoNotDependOnThePlace) {
  const Afar pair;
  const std::vector<double> thetas{-0.02, 0.03};
  const auto one = region_table(places(pair.near, thetas), table_job(Construction::kArcs));
  const auto other = region_table(places(pair.far, thetas), table_job(Construction::kArcs));
  ASSERT_TRUE(one && other);
  const double height = one->construction->rows[0].values[2];
  EXPECT_GT(height, 0.0);
  EXPECT_NEAR(other->construction->rows[0].values[2], height, 1e-12 * height);
}

TEST(WorksheetFigures, RadiiOfEllipsesAreThoseOfTheirWeightAfar) {
  const Afar pair;
  const double alpha = -0.02, beta = 0.03, h = pair.near[1].x;
  const auto table =
      region_table(places(pair.far, {alpha, beta}), table_job(Construction::kEllipses));
  ASSERT_TRUE(table) << table.error().what;
  const ConstructionRow& row = table->construction->rows[0];
  const double w = row.values[0];
  // w^2 a^3 over the area of the triangle, a and b its sides along the tangents
  const double a = h * std::sin(beta) / std::sin(beta - alpha);
  const double b = -h * std::sin(alpha) / std::sin(beta - alpha);
  const double area = -0.5 * h * a * std::sin(alpha);
  EXPECT_NEAR(row.values[1], w * w * a * a * a / area, 1e-9 * row.values[1]);
  EXPECT_NEAR(row.values[2], w * w * b * b * b / area, 1e-9 * row.values[2]);
  const auto fit =
      fit_construction(places(pair.far, {alpha, beta}), table_job(Construction::kEllipses));
  ASSERT_TRUE(fit) << fit.error().what;
  EXPECT_NEAR(fit->contour.joints[0].element.kappa, 1.0 / row.values[1], 1e-9 / row.values[1]);
}

TEST(WorksheetFigures, AtAVertexTwoArcsLeaveTheCurvatureThatBothRunsReach) {
  std::vector<Vec2> points;  // around the sharp end of an ellipse
  for (int k = 0; k < 9; ++k) {
    const double t = -1.2 + 0.3 * k;
    points.push_back({3.0 * std::cos(t), 2.0 * std::sin(t)});
  }
  const auto fit = fit_construction(places(points), table_job(Construction::kArcs));
  ASSERT_TRUE(fit) << fit.error().what;
  const Contour& contour = fit->contour;
  ASSERT_EQ(contour.runs.size(), 2u);
  for (std::size_t run = 0; run < contour.runs.size(); ++run) {
    const double d = contour.runs[run].direction;
    const auto kappa = [&](std::size_t piece) {
      const auto* arc = std::get_if<ArcPiece>(&contour.pieces[piece]);
      return arc != nullptr ? arc->kappa : 0.0;
    };
    const std::size_t first = contour.runs[run].first_piece, last = contour.runs[run].last_piece;
    const double rounding = 1e-14 * std::abs(kappa(last));  // an arc's curvature comes of its ends
    EXPECT_LE(d * contour.joints[first].element.kappa, d * kappa(first) + rounding) << run;
    EXPECT_GE(d * contour.joints[last + 1].element.kappa, d * kappa(last) - rounding) << run;
  }
  // two arcs between their own curvatures are all there is
  const SegmentReport& before = fit->report.segments[contour.runs[0].last_piece / 2];
  EXPECT_LE(before.deviation, 1e-12);
}

TEST(WorksheetFigures, ErrorsOfAClosedContourDoNotDependOnItsFirstPoint) {
  constexpr std::size_t kPoints = 33, kTurned = 7;
  std::vector<Vec2> outline;  // a limacon: at the sharp end of its inner loop the ellipses step
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double t = 2.0 * kPi * static_cast<double>(i) / kPoints - 0.18;
    outline.push_back((0.48 + 1.29 * std::cos(t)) * unit_at(t));
  }
  RegionJob job = table_job(Construction::kEllipses);
  job.job.closing = Closing::kClosed;
  const auto fit = fit_construction(places(outline), job);
  std::rotate(outline.begin(), outline.begin() + kTurned, outline.end());
  const auto turned = fit_construction(places(outline), job);
  ASSERT_TRUE(fit && turned);
  int compared = 0, steps = 0;
  for (const Joint& joint : fit->contour.joints) steps += joint.leaving ? 1 : 0;
  ASSERT_GT(steps, 0);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double one = fit->report.segments[i].points_only_error;
    const double other =
        turned->report.segments[(i + kPoints - kTurned) % kPoints].points_only_error;
    if (std::isnan(one) || std::isnan(other)) continue;
    ++compared;
    EXPECT_NEAR(one, other, 1e-9 * one) << i;
  }
  EXPECT_GT(compared, 5);
}

TEST(WorksheetFigures, OneClothoidHasNoSteps) {
  const auto table = region_table(places({{0.0, 0.0}, {1.0, 0.0}}, {-0.2, 0.5}),
                                  table_job(Construction::kClothoids));
  ASSERT_TRUE(table) << table.error().what;
  EXPECT_EQ(table->construction->remarks.front(),
            "common tangents; the curvature goes on at every point");
}

TEST(WorksheetFigures, AHeadingInItsRangeHasAContourWhereAdjacentCirclesMislead) {
  const std::vector<Vec2> points{{0, 0},
                                 {-193.4595820216723, -159.67704941317547},
                                 {-193.80961493587031, -159.24280419107231},
                                 {-194.15868153577995, -158.80778182017019},
                                 {-194.50678167002059, -158.37198570807752},
                                 {-194.85391520035736, -157.93541925574252},
                                 {-195.20008200164952, -157.49808585742272},
                                 {-285.34368967668058, 384.05945644550394},
                                 {-285.49045502795082, 384.59755677331867},
                                 {-630.34210491351496, 407.94395145993855},
                                 {-630.15583155256672, 407.4182199087706}};
  // headings of the other points with which spirals exist over every chord were found by the judge
  FitJob job;
  job.continuity = Continuity::kG2;
  job.constraints.push_back({9, 247.33649875950192 * kOneDegree, {}, false});
  const auto made = fit(places(points), job);
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_TRUE(made->certificate.proved);
}

}  // namespace
}  // namespace obvid
