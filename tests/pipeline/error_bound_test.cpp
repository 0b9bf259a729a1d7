// SPDX-License-Identifier: Apache-2.0
// The error bound of a report against what another construction of the region says: arcs laid out
// by their turning, polylines and brute force instead of closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "../common/oracle_curves.h"
#include "../common/ten_points.h"
#include "../common/text.h"
#include "obvid/io/contour_json.h"
#include "obvid/pipeline/compare.h"
#include "obvid/pipeline/fit.h"
#include "verify/report.h"

namespace obvid {
namespace {

using namespace test;

/// Point at arc length s of an arc, by the angle that it turns.
Vec2 along_arc(Vec2 from, double theta, double kappa, double s) {
  const double half = 0.5 * kappa * s;
  const double chord = half == 0.0 ? s : s * std::sin(half) / half;
  return from + chord * unit_at(theta + half);
}

/// How far the direction from a point of the first arc to the end is from that in which an arc with
/// these end tangents would leave: half way between both.
double turn_missing(const Element& a, const Element& b, double s) {
  const Vec2 joint = along_arc(a.point, a.theta, a.kappa, s);
  const double middle = 0.5 * (a.theta + a.kappa * s + b.theta);
  return std::remainder(heading(b.point - joint) - middle, 2.0 * std::numbers::pi);
}

/// The osculating circle of `a`, left for the arc that ends in the tangent of `b`: as a polyline.
std::vector<Vec2> circle_then_arc(const Element& a, const Element& b) {
  const double h = norm(b.point - a.point);
  constexpr int kSteps = 400;
  double low = 0.0, high = 0.0;
  for (int i = 1; i <= kSteps; ++i) {  // the first place where the missing turn changes its sign
    const double s = 1.5 * h * i / kSteps;
    if (turn_missing(a, b, s) * turn_missing(a, b, 0.0) <= 0.0) {
      high = s;
      break;
    }
    low = s;
  }
  EXPECT_GT(high, 0.0);
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (turn_missing(a, b, middle) * turn_missing(a, b, 0.0) > 0.0 ? low : high) = middle;
  }
  const Vec2 joint = along_arc(a.point, a.theta, a.kappa, low);
  const double theta = a.theta + a.kappa * low, turn = b.theta - theta;
  const double chord = norm(b.point - joint);
  const double length = turn == 0.0 ? chord : chord * 0.5 * turn / std::sin(0.5 * turn);
  std::vector<Vec2> out;
  constexpr int kPoints = 3000;
  for (int i = 0; i <= kPoints; ++i) {
    out.push_back(along_arc(a.point, a.theta, a.kappa, low * i / kPoints));
  }
  for (int i = 1; i <= kPoints; ++i) {
    out.push_back(along_arc(joint, theta, turn / length, length * i / kPoints));
  }
  return out;
}

/// The other boundary is the same seen from the other end.
std::vector<Vec2> arc_then_circle(const Element& a, const Element& b) {
  return circle_then_arc({b.point, b.theta + std::numbers::pi, -b.kappa},
                         {a.point, a.theta + std::numbers::pi, -a.kappa});
}

double distance(const std::vector<Vec2>& polyline, Vec2 p) {
  double least = HUGE_VAL;
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    const Vec2 a = polyline[i - 1], d = polyline[i] - a;
    const double square = dot(d, d);
    const double part = square > 0.0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0.0;
    least = std::min(least, norm(a + part * d - p));
  }
  return least;
}

Element element_of(const Piece& piece, double t, double theta) {
  const Jet jet = evaluate(piece, t);
  const double here = theta + std::remainder(heading(jet.d1) - theta, 2.0 * std::numbers::pi);
  return {jet.point, here, curvature(jet)};
}

/// Largest distance of a row's part from the farther boundary, by brute force. Pieces of the part
/// begin at the joint of its first point.
double deviation_by_force(const Contour& contour, const SegmentReport& row) {
  std::size_t first = 0;
  while (contour.joints[first].source != row.from) ++first;
  std::size_t last = first;
  while (contour.joints[last + 1].source != row.to) ++last;
  Element a = element_of(contour.pieces[first], 0.0, contour.joints[first].element.theta);
  Element b = element_of(contour.pieces[last], 1.0, contour.joints[last + 1].element.theta);
  if (contour.carrier == Carrier::kArcs) {  // a joint of arcs has its curvature between theirs
    a.kappa = contour.joints[first].element.kappa;
    b.kappa = contour.joints[last + 1].element.kappa;
  }
  const std::vector<Vec2> low = circle_then_arc(a, b), high = arc_then_circle(a, b);
  double most = 0.0;
  const int samples = std::max(4, 200 / static_cast<int>(last - first + 1));
  for (std::size_t k = first; k <= last; ++k) {
    for (int i = 0; i <= samples; ++i) {
      const Vec2 p = evaluate(contour.pieces[k], static_cast<double>(i) / samples).point;
      most = std::max({most, distance(low, p), distance(high, p)});
    }
  }
  return most;
}

Result<Fit> fit_carrier(const std::vector<Vec2>& points, Carrier carrier,
                        std::optional<Continuity> continuity = {}) {
  PointSeries series;
  series.points = points;
  FitJob job;
  job.carrier = carrier;
  job.continuity = continuity;
  return fit(series, job);
}

// The step of the polylines is 1/3000 of an arc: its sagitta is below 1e-5 of the distance between
// two boundaries that are three thousandths of the chord apart.
constexpr double kBruteForce = 1e-3;

TEST(ErrorBound, IsTheDistanceFromTheFartherBoundaryForEveryCarrierWithJointsAtThePoints) {
  for (const Carrier carrier : {Carrier::kSpiral, Carrier::kArcs, Carrier::kConics,
                                Carrier::kBeziers, Carrier::kClothoids}) {
    const auto f = fit_carrier(kTenPoints, carrier);
    ASSERT_TRUE(f) << to_string(carrier);
    ASSERT_EQ(f->report.segments.size(), 9U);
    double largest = 0.0;
    for (const SegmentReport& row : f->report.segments) {
      const double found = deviation_by_force(f->contour, row);
      EXPECT_GE(row.deviation, found * (1.0 - 1e-5)) << to_string(carrier) << " at " << *row.from;
      EXPECT_LE(row.deviation, found * (1.0 + kBruteForce))
          << to_string(carrier) << " at " << *row.from;
      largest = std::max(largest, row.deviation);
    }
    EXPECT_EQ(f->report.largest_deviation, largest);
  }
}

TEST(ErrorBound, HoldsOnRandomSpirals) {
  std::mt19937_64 rng(2024);
  int looked_at = 0;
  for (int i = 0; i < 40; ++i) {
    const Sampled s = random_series(static_cast<Oracle>(i % kOracleCount), rng, 1.2);
    if (s.uneven || s.offset_sizes > 10.0 || s.points.size() > 40) continue;
    const auto f = fit_carrier(s.points, Carrier::kSpiral);
    ASSERT_TRUE(f) << to_line(f.error());
    for (const SegmentReport& row : f->report.segments) {
      if (!(row.width_unrefined > 1e-4 * row.chord)) continue;  // too thin for polylines
      const double found = deviation_by_force(f->contour, row);
      EXPECT_GE(row.deviation, found * (1.0 - 1e-2));
      EXPECT_LE(row.deviation, found * (1.0 + 3e-2));
      ++looked_at;
    }
  }
  EXPECT_GT(looked_at, 50);
}

/// Four arcs through the last two points of the reference series, with the contour's own points,
/// headings and curvatures at the ends and strictly rising curvature: a curve that the bound speaks
/// of, and farther away than the height over the middle of the chord says (0.5912).
TEST(ErrorBound, NoMonotoneCurveWithTheSameElementsIsFartherAway) {
  const auto f = fit_carrier(kTenPoints, Carrier::kSpiral, Continuity::kG2);
  ASSERT_TRUE(f);
  const SegmentReport& row = f->report.segments.back();
  const Contour& contour = f->contour;
  const std::size_t last = contour.pieces.size() - 1;
  const Element a = contour.joints[last].element, b = contour.joints[last + 1].element;
  // near the boundaries: their arcs are the limits of monotone chains
  double farthest = 0.0;
  for (const auto& other : {circle_then_arc(a, b), arc_then_circle(a, b)}) {
    double most = 0.0;
    for (int i = 0; i <= 400; ++i) {
      most = std::max(most, distance(other, evaluate(contour.pieces[last], i / 400.0).point));
    }
    farthest = std::max(farthest, most);
  }
  EXPECT_GT(farthest, 0.604);
  EXPECT_GE(row.deviation, farthest);
  EXPECT_LT(row.deviation, 0.6050);
}

TEST(ErrorBound, FitAndCompareSayTheSame) {
  PointSeries series;
  series.points = kTenPoints;
  const auto compared = compare_carriers(series, {});
  ASSERT_TRUE(compared);
  for (const ComparedCarrier& row : compared->carriers) {
    const auto alone = fit_carrier(kTenPoints, row.carrier);
    ASSERT_TRUE(alone);
    const FitReport &a = row.fit.report, &b = alone->report;
    EXPECT_TRUE(a.largest_deviation == b.largest_deviation ||
                (std::isnan(a.largest_deviation) && std::isnan(b.largest_deviation)));
    EXPECT_EQ(a.carrier_deviation, b.carrier_deviation);
    EXPECT_EQ(a.outside_spirals_region, b.outside_spirals_region);
    EXPECT_EQ(std::isnan(b.largest_deviation), !promises_monotone(row.carrier));
  }
}

TEST(ErrorBound, ACarrierPassingPointsBetweenItsJointsHasARowForEachChord) {
  for (const Carrier carrier : {Carrier::kBspline, Carrier::kCubic}) {
    const auto f = fit_carrier(kTenPoints, carrier);
    ASSERT_TRUE(f);
    ASSERT_EQ(f->report.segments.size(), 9U) << to_string(carrier);
    for (std::size_t i = 0; i < 9; ++i) {
      const SegmentReport& row = f->report.segments[i];
      EXPECT_EQ(row.from, i);
      EXPECT_EQ(row.to, i + 1);
      EXPECT_NEAR(row.chord, norm(kTenPoints[i + 1] - kTenPoints[i]), 2.0 * f->report.tolerance);
    }
  }
  // as wide open as the spirals leave it
  const auto spline = fit_carrier(kTenPoints, Carrier::kBspline);
  const auto spirals = fit_carrier(kTenPoints, Carrier::kSpiral, Continuity::kG2);
  for (std::size_t i = 0; i < 9; ++i) {
    // a tolerance of 0.002 of the bound changes headings and curvatures at the feet a little
    EXPECT_NEAR(spline->report.segments[i].deviation, spirals->report.segments[i].deviation,
                0.1 * spirals->report.segments[i].deviation + spline->report.tolerance);
  }
}

TEST(ErrorBound, ShortPiecesAtTheOriginAreSeenWithAllTheirDigits) {
  // the last part ends with a piece of 0.0003 at the origin, 4 from the start of the part, where a
  // coordinate as exact as its own would need 13 bits more. The width by 50 digits from the
  // coordinates in the file
  const std::string text = text_of_file(OBVID_TEST_DATA "/contours/bspline_polygon.json");
  const auto stored = contour_from_json(text, "bspline_polygon.json");
  ASSERT_TRUE(stored) << to_line(stored.error());
  Watch watch;
  const auto report = pipeline_detail::measure(stored->contour, 6.402e-6, watch);
  ASSERT_TRUE(report);
  EXPECT_NEAR(report->segments.back().width_unrefined, 0.000389737829385, 1e-12);
}

bool all_unknown(const FitReport& report) {
  return std::all_of(report.segments.begin(), report.segments.end(),
                     [](const SegmentReport& row) { return std::isnan(row.points_only_error); });
}

TEST(PointsOnlyError, IsUnknownBesideAKink) {
  // far from the origin, two points 0.0001 apart: coordinates of 3e-8 leave the conic between them
  // another heading than those beside it
  const std::vector<Vec2> points = {
      {276387635.72123647, 132915439.38776717}, {276387618.06345326, 132915540.64540584},
      {276387570.86265743, 132915619.00660035}, {276387494.11884892, 132915674.47135065},
      {276387494.11875218, 132915674.47139718}, {276387387.83189982, 132915707.0396791},
      {276387252.00203484, 132915716.71151683}};
  const auto f = fit_carrier(points, Carrier::kConics);
  ASSERT_TRUE(f) << to_line(f.error());
  ASSERT_FALSE(f->certificate.gaps_within_bounds);
  EXPECT_TRUE(all_unknown(f->report));
}

TEST(PointsOnlyError, IsUnknownWhereThreePointsAreAll) {
  const std::vector<Vec2> bent = {{0, 0}, {1, 0.1}, {2, 0.5}}, straight = {{0, 0}, {1, 1}, {3, 3}};
  for (const auto& points : {bent, straight}) {
    const auto f = fit_carrier(points, Carrier::kSpiral);
    ASSERT_TRUE(f);
    EXPECT_TRUE(f->certificate.proved);
    EXPECT_TRUE(all_unknown(f->report)) << points.size();
  }
  // two proved fair curves through the same three points, far apart
  PointSeries series;
  series.points = bent;
  FitJob job;
  job.start_heading = 0.0;
  const auto other = fit(series, job);
  ASSERT_TRUE(other);
  EXPECT_TRUE(other->certificate.proved);
  EXPECT_TRUE(all_unknown(other->report));
}

TEST(PointsOnlyError, IsUnknownBetweenCornersThreePointsApart) {
  PointSeries series;
  series.points = {{0, 0}, {1, 0.2}, {2, 0}, {2.2, -1}, {2, -2}};
  FitJob job;
  job.constraints.push_back({2, {}, {}, true});
  const auto f = fit(series, job);
  ASSERT_TRUE(f) << to_line(f.error());
  EXPECT_EQ(f->certificate.corners, 1);
  EXPECT_TRUE(all_unknown(f->report));
}

/// Known rows of the spiral r = exp(t / 10) through points so far apart, and that it keeps to them.
std::size_t known_rows_of_spiral(double step) {
  const auto spiral = [](double t) { return std::exp(0.1 * t) * unit_at(t); };
  std::vector<Vec2> points;
  for (int i = 0; i < 8; ++i) points.push_back(spiral(step * i));
  const auto f = fit_carrier(points, Carrier::kSpiral);
  EXPECT_TRUE(f && f->certificate.proved);
  std::size_t known = 0;
  for (std::size_t i = 0; f && i < f->report.segments.size(); ++i) {
    const double bound = f->report.segments[i].points_only_error;
    if (std::isnan(bound)) continue;
    ++known;
    for (int k = 1; k < 20; ++k) {
      const Vec2 p = spiral(step * (static_cast<double>(i) + k / 20.0));
      double away = 1e300;
      for (int j = 0; j <= 4000; ++j) {
        away = std::min(away, norm(evaluate(f->contour.pieces[i], j / 4000.0).point - p));
      }
      EXPECT_LE(away, bound + 1e-3 * step) << step << ' ' << i;  // places are so far apart
    }
  }
  return known;
}

TEST(PointsOnlyError, IsUnknownWhereTheContourTurnsByHalfATurnOverThreeChords) {
  EXPECT_EQ(known_rows_of_spiral(0.9), 5U);  // 155 degrees
  EXPECT_EQ(known_rows_of_spiral(1.1), 0U);  // 189 degrees
}

TEST(PointsOnlyError, IsNothingOnFourPointsOfOneCircle) {
  const std::vector<Vec2> circle = {{5, 0}, {4, 3}, {3, 4}, {0, 5}, {-3, 4}};
  const auto f = fit_carrier(circle, Carrier::kSpiral);
  ASSERT_TRUE(f) << to_line(f.error());
  for (const SegmentReport& row : f->report.segments) EXPECT_EQ(row.points_only_error, 0.0);
}

TEST(PointsOnlyError, IsUnknownWhereTheContourIsNotMonotone) {
  std::vector<Vec2> wave;
  for (int i = 0; i <= 24; ++i) wave.push_back({0.25 * i, std::sin(0.25 * i)});
  const auto f = fit_carrier(wave, Carrier::kSpiral);
  ASSERT_TRUE(f) << to_line(f.error());
  ASSERT_GT(f->certificate.vertices, 0);
  std::size_t known = 0;
  for (std::size_t i = 0; i < f->report.segments.size(); ++i) {
    if (std::isnan(f->report.segments[i].points_only_error)) continue;
    ++known;
    // pieces i - 1 to i + 1 carry the three chords around
    const auto& verdict = f->certificate.pieces;
    ASSERT_EQ(verdict.size(), wave.size() - 1);
    EXPECT_EQ(verdict[i - 1].verdict, verdict[i].verdict);
    EXPECT_EQ(verdict[i].verdict, verdict[i + 1].verdict);
  }
  EXPECT_GT(known, 8U);
}

TEST(PointsOnlyError, IsUnknownOnACircleWhereTheContourIsNotMonotone) {
  // a circle but for the last digits: the four points around the chord from 17 to 18 are one
  // circle to these, the contour beside it falls and grows
  const std::vector<Vec2> points = {
      {-0.30350780214016454, -7.4953949217453726}, {-1.4716460193306484, -7.3557678057888705},
      {-2.6035889283572984, -7.0352247093484106},  {-3.6714962592924745, -6.5416494278500084},
      {-4.6491027048369293, -5.8871815038069535},  {-5.5123639186638069, -5.0879176533336237},
      {-6.2400478889642272, -4.1635158655058984},  {-6.8142571422945108, -3.1367119117926334},
      {-7.2208689340518148, -2.0327601570609053},  {-7.4498825990550603, -0.87881242548332172},
      {-7.4956655190863701, 0.29674980179545601},  {-7.3570916578042844, 1.4650134325486064},
      {-7.037569255742314, 2.5972448843956859},    {-6.5449570042257115, 3.6655967906639515},
      {-5.8913707599312968, 4.6437929096709478},   {-5.0928855539564317, 5.5077743920017284},
      {-4.1691402245230149, 6.2362915107582131},   {-3.1428543974272065, 6.8114263011104983},
      {-2.0392696941516135, 7.2190332547648133},   {-0.88552891119429322, 7.4490872304145217},
      {0.28999156022590122, 7.4959300232783557},   {1.4583796548725285, 7.3584095293171448},
      {2.5908987291606049, 7.0399080813690533},    {3.6596943423094204, 6.5482592602730421},
      {4.6384793396140624, 5.8955552270216938},    {5.5031803881269541, 5.0978493146253809},
      {6.2325300631348588, 4.1747611944888483},    {6.8085899229886344, 3.1489943282680097}};
  const auto f = fit_carrier(points, Carrier::kSpiral);
  ASSERT_TRUE(f) << to_line(f.error());
  std::vector<std::size_t> first;  // piece of each chord
  for (std::size_t i = 0; i < f->contour.joints.size(); ++i) {
    if (f->contour.joints[i].source) first.push_back(i);
  }
  ASSERT_EQ(first.size(), points.size());
  std::size_t known = 0;
  for (std::size_t k = 1; k + 2 < points.size(); ++k) {
    if (std::isnan(f->report.segments[k].points_only_error)) continue;
    ++known;
    bool grows = false, falls = false, neither = false;
    for (std::size_t i = first[k - 1]; i < first[k + 2]; ++i) {
      const Verdict verdict = f->certificate.pieces[i].verdict;
      grows = grows || verdict == Verdict::kIncreasing;
      falls = falls || verdict == Verdict::kDecreasing;
      neither = neither || verdict == Verdict::kHasVertex;
    }
    EXPECT_FALSE(grows && falls) << k;
    EXPECT_FALSE(neither) << k;
  }
  EXPECT_GT(known, 0U);
}

TEST(ErrorBound, ArcsAroundASeamAtAVertexHaveItsCurvature) {
  std::vector<Vec2> points;
  constexpr int kPoints = 14;
  for (int i = 0; i < kPoints; ++i) {
    const double t = 0.02 + 2.0 * std::numbers::pi * i / kPoints;  // curvature is largest at 0
    points.push_back({3.0 * std::cos(t), 2.0 * std::sin(t)});
  }
  FitJob job;
  job.carrier = Carrier::kArcs;
  job.tolerance = 0.02;
  PointSeries series;
  series.points = points;
  job.closing = Closing::kClosed;
  const Contour contour = fit(series, job).value().contour;
  const auto kappa_of = [](const Piece& piece) { return std::get<ArcPiece>(piece).kappa; };
  const double seam = contour.joints.front().element.kappa;
  ASSERT_EQ(contour.runs.back().direction, 1);
  EXPECT_GE(seam, kappa_of(contour.pieces.back()));
  EXPECT_GE(seam, kappa_of(contour.pieces.front()));
}

}  // namespace
}  // namespace obvid
