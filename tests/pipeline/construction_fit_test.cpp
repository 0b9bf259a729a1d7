// SPDX-License-Identifier: Apache-2.0
// The papers' constructions as contours: through the points, at the given tangents, and what their
// files say is so.
#include "obvid/pipeline/construction_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "../common/ten_points.h"
#include "obvid/contour/clothoids.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/io/contour_json.h"
#include "obvid/io/read_points.h"

namespace obvid {
namespace {

constexpr Construction kAllConstructions[] = {Construction::kArcs, Construction::kEllipses,
                                              Construction::kClothoids, Construction::kSpline,
                                              Construction::kParabolas};

struct Shape {
  std::string name;
  PointSeries series;
};

PointSeries series_of_shape(std::vector<Vec2> points) {
  PointSeries out;
  out.points = std::move(points);
  return out;
}

/// y = x^3 / 6 at eleven or ten places: an inflection at a point, or between two.
PointSeries cubic_wave(int points, double from) {
  std::vector<Vec2> out;
  for (int i = 0; i < points; ++i) {
    const double t = 0.3 * i + from;
    out.push_back({t, t * t * t / 6.0});
  }
  return series_of_shape(out);
}

/// The reference series, an involute, two points, closed outlines (an ellipse, and one that is
/// blunt at one end and sharp at the other) and waves.
std::vector<Shape> shapes() {
  std::vector<Shape> out{{"reference", series_of_shape(kTenPoints)}};
  std::vector<Vec2> involute, ellipse, outline;
  for (int i = 1; i <= 8; ++i) {
    const double t = 0.25 * i;
    involute.push_back({std::cos(t) + t * std::sin(t), std::sin(t) - t * std::cos(t)});
  }
  for (int i = 0; i < 12; ++i) {
    const double t = std::numbers::pi * i / 6.0;
    ellipse.push_back({3.0 * std::cos(t), 2.0 * std::sin(t)});
  }
  for (int i = 0; i < 24; ++i) {
    const double t = std::numbers::pi * i / 12.0 + 0.1;
    outline.push_back({10.0 * std::cos(t), 3.5 * std::sin(t) * (1.0 - 0.35 * std::cos(t))});
  }
  out.push_back({"involute", series_of_shape(involute)});
  out.push_back({"closed", series_of_shape(ellipse)});
  out.push_back({"closed outline", series_of_shape(outline)});
  out.push_back({"wave", cubic_wave(11, -1.5)});
  out.push_back({"wave between points", cubic_wave(10, -1.4)});
  PointSeries two = series_of_shape({{0.0, 0.0}, {10.0, 2.0}});
  two.fixed.resize(2);
  two.fixed[0].theta = -5.0 * kOneDegree;
  two.fixed[1].theta = 40.0 * kOneDegree;
  out.push_back({"two", two});
  return out;
}

bool is_closed(const Shape& shape) { return shape.name.starts_with("closed"); }

RegionJob job_of(const Shape& shape, Construction which) {
  RegionJob job;
  job.construction = which;
  if (is_closed(shape)) job.job.closing = Closing::kClosed;
  job.job.find_corners = false;
  return job;
}

TEST(ConstructionFit, IsMadeOnEveryShapeAndWhatItsFileSaysIsSo) {
  for (const Shape& shape : shapes()) {
    const auto proved = fit(shape.series, job_of(shape, Construction::kArcs).job);
    ASSERT_TRUE(proved) << to_line(proved.error());
    EXPECT_TRUE(proved->certificate.proved) << proved->certificate.reason;
    for (const Construction which : kAllConstructions) {
      SCOPED_TRACE(shape.name + ", construction " + std::to_string(static_cast<int>(which)));
      const auto table = region_table(shape.series, job_of(shape, which));
      EXPECT_TRUE(table) << to_line(table.error());
      const auto f = fit_construction(shape.series, job_of(shape, which));
      ASSERT_TRUE(f) << to_line(f.error());
      EXPECT_TRUE(f->certificate.through_points);
      const StoredContour stored{f->contour, f->report, f->certificate};
      const auto again = contour_from_json(contour_to_json(stored), "f");
      ASSERT_TRUE(again) << to_line(again.error());
      const Verification found = verify(*again);
      EXPECT_FALSE(found.false_claim) << to_line(*found.false_claim);
    }
  }
}

TEST(ConstructionFit, ParabolasAndSplinesOfLoopsHaveNoSeam) {
  std::size_t loops = 0;
  for (const Shape& shape : shapes()) {
    if (!is_closed(shape)) continue;
    ++loops;
    for (const Construction which : {Construction::kSpline, Construction::kParabolas}) {
      SCOPED_TRACE(shape.name + ", construction " + std::to_string(static_cast<int>(which)));
      const auto f = fit_construction(shape.series, job_of(shape, which));
      ASSERT_TRUE(f) << to_line(f.error());
      EXPECT_EQ(f->certificate.curvature_steps, 0);
      const Jet end = evaluate(f->contour.pieces.back(), 1.0);
      const Jet start = evaluate(f->contour.pieces.front(), 0.0);
      EXPECT_LT(std::abs(curvature(end) - curvature(start)), 1e-7 * std::abs(curvature(start)));
      EXPECT_LT(norm(end.point - start.point), 1e-12);
    }
  }
  EXPECT_EQ(loops, 2U);
}

/// Points of a parabola at uneven steps: of the spiral between points 7 and 8 the curvature leaps
/// in the last 1e-4 of it, and its end has it to 1e-5 only.
TEST(ConstructionFit, ParabolasMeetTheRadiusOfAPointOnBothSides) {
  const PointSeries series = series_of_shape({
      {0.97652412538273758, -2.6832964003194748},  {0.86807078639064772, -2.0054562502282276},
      {0.82401516573425226, -1.8139718989707441},  {0.6255417681977008, -1.1720685730631837},
      {0.40727093335189246, -0.67241788447582873}, {0.36358210182083722, -0.58735244205902426},
      {0.07119475695145569, -0.10132511150517974}, {-0.0054012239659908317, 0.0074670222765850468},
      {-0.36484071973020288, 0.44691766453322646}, {-0.61172623258465786, 0.6971038450415038},
      {-0.88272270991129476, 0.93594077319948032}, {-1.1765501990835492, 1.1612654330375483},
      {-1.4573728834740975, 1.3500420197774996},   {-2.0479121349200216, 1.6803982430700519},
      {-2.2896676720911766, 1.7943875751251366},   {-2.9606871538812629, 2.0596847340378468},
      {-3.2574897470813333, 2.1567315326401197},   {-3.8808470844866192, 2.3271992830581723},
      {-4.1473906470245723, 2.3879791647952735},   {-4.4137856271182327, 2.4422847635577871},
      {-4.7447413882482401, 2.5014823348513273},
  });
  RegionJob job;
  job.construction = Construction::kParabolas;
  job.fixation = 2;
  const auto f = fit_construction(series, job);
  ASSERT_TRUE(f) << to_line(f.error());
  std::size_t points = 0;
  for (std::size_t k = 1; k < f->contour.pieces.size(); ++k) {
    if (!f->contour.joints[k].source) continue;
    ++points;
    const double before = curvature(evaluate(f->contour.pieces[k - 1], 1.0));
    const double behind = curvature(evaluate(f->contour.pieces[k], 0.0));
    EXPECT_NEAR(before / behind, 1.0, 1e-6) << "point " << *f->contour.joints[k].source + 1;
  }
  EXPECT_EQ(points, series.points.size() - 2);
}

/// On both sides the curvature at the inflection is half of what a biarc from the point beside it
/// would end with ([Kurnosenko 2013]: there (A)(B) = -sin^2(sigma/2), half-chord units).
TEST(ConstructionFit, ParabolasStepOnceAtAnInflection) {
  for (const PointSeries& series : {cubic_wave(11, -1.5), cubic_wave(10, -1.4)}) {
    RegionJob job;
    job.job.find_corners = false;
    job.construction = Construction::kParabolas;
    const auto f = fit_construction(series, job);
    ASSERT_TRUE(f) << to_line(f.error());
    EXPECT_TRUE(f->certificate.proved) << f->certificate.reason;
    EXPECT_EQ(f->certificate.curvature_steps, 1);
    const auto& joints = f->contour.joints;
    const auto step = std::find_if(joints.begin(), joints.end(),
                                   [](const Joint& j) { return j.leaving.has_value(); });
    ASSERT_NE(step, joints.end());
    const Element before = step->element, behind = *step->leaving;
    EXPECT_LT(before.kappa, 0.0);
    EXPECT_GT(behind.kappa, 0.0);
    EXPECT_NEAR(before.theta, behind.theta, 1e-12);
    const auto beside = std::find_if(std::reverse_iterator(step), joints.rend(),
                                     [](const Joint& j) { return j.source.has_value(); });
    const Vec2 chord = before.point - beside->element.point;
    const double alpha = turning(chord, unit_at(beside->element.theta));
    const double beta = turning(chord, unit_at(before.theta)), half = 0.5 * norm(chord);
    const double A = beside->element.kappa * half + std::sin(alpha);
    const double B = 2.0 * before.kappa * half - std::sin(beta);
    const double sine = std::sin(0.5 * (alpha + beta));
    EXPECT_NEAR(A * B, -sine * sine, 1e-6 * sine * sine);
  }
}

/// What a table has in the columns of its name; NaN where nothing stands.
double figure(const ConstructionTable& table, const ConstructionRow& row,
              const std::string& column) {
  const auto at = std::find(table.columns.begin(), table.columns.end(), column);
  EXPECT_NE(at, table.columns.end()) << column;
  return row.values[static_cast<std::size_t>(at - table.columns.begin())];
}

Vec2 meeting(Vec2 p, double theta, Vec2 q, double phi) {
  const Vec2 u = unit_at(theta), v = unit_at(phi);
  return p + cross(q - p, v) / cross(u, v) * u;
}

/// Radii of [001] at both ends of a triangle: a^3/S and b^3/S.
struct TriangleRadii {
  double start, end;
};
TriangleRadii triangle_radii(Vec2 p, Vec2 apex, Vec2 q) {
  const double a = norm(apex - p), b = norm(q - apex);
  const double area = 0.5 * std::abs(cross(apex - p, q - p));
  return {a * a * a / area, b * b * b / area};
}

/// Everything that [001] says of its steps, from the printed points and the tangents alone.
TEST(ConstructionFit, StepsOfACondensationAreThoseOfThePaper) {
  PointSeries two = series_of_shape({{0.0, 0.0}, {10.0, 2.0}});
  two.fixed.resize(2);
  const double theta = -5.0 * kOneDegree, phi = 40.0 * kOneDegree;
  two.fixed[0].theta = theta;
  two.fixed[0].kappa = 1.0 / 40.0;
  two.fixed[1].theta = phi;
  two.fixed[1].kappa = 1.0 / 7.0;
  RegionJob job;
  job.construction = Construction::kParabolas;
  const auto table = region_table(two, job);
  ASSERT_TRUE(table) << to_line(table.error());
  const ConstructionTable& made = *table->construction;
  ASSERT_EQ(made.rows.size(), 4U);
  const Vec2 p = two.points[0], q = two.points[1];
  const double along = heading(q - p);
  const auto at = [&](std::size_t row) {
    return Vec2{figure(made, made.rows[row], "x"), figure(made, made.rows[row], "y")};
  };
  // first step: the tangent at A is parallel to the chord
  const Vec2 contact = at(1);
  const Vec2 t1 = meeting(p, theta, contact, along), t2 = meeting(q, phi, contact, along);
  const double l = 0.5 * norm(t2 - t1), h = std::abs(cross(q - p, contact - p)) / norm(q - p);
  const double d = figure(made, made.rows[1], "d");
  EXPECT_NEAR(norm(contact - t1), l + d, 1e-12);
  EXPECT_NEAR(figure(made, made.rows[1], "R"), 2.0 * (l + d) * (l + d) / h, 1e-9);
  EXPECT_NEAR(figure(made, made.rows[1], "R'"), 2.0 * (l - d) * (l - d) / h, 1e-9);
  // the second step changes both radii of a triangle by k1, or k2, and they agree at A
  const double k1 = figure(made, made.rows[2], "k1"), k2 = figure(made, made.rows[3], "k2");
  EXPECT_NEAR(k1 * triangle_radii(p, t1, contact).start, 40.0, 1e-9);
  EXPECT_NEAR(k2 * triangle_radii(contact, t2, q).end, 7.0, 1e-9);
  EXPECT_NEAR(k1 * figure(made, made.rows[1], "R"), k2 * figure(made, made.rows[1], "R'"), 1e-9);
  // its points lie in the middle of tangents parallel to |i, A| and |A, i+1|
  const Vec2 z1 = at(2), u1 = meeting(p, theta, z1, heading(contact - p));
  EXPECT_NEAR(norm(z1 - u1), 0.5 * norm(meeting(contact, along, z1, heading(contact - p)) - u1),
              1e-12);
  EXPECT_NEAR(figure(made, made.rows[2], "R"), triangle_radii(p, u1, z1).end, 1e-9);
  EXPECT_NEAR(triangle_radii(p, u1, z1).start, 40.0, 1e-9);
  // margins of [001]: c < l + d, l - d < f where radii fall
  EXPECT_GT(norm(t1 - p), l + d);
  EXPECT_GT(l - d, norm(q - t2));
}

TEST(ConstructionFit, OrderOneMeetsTangentsAndOrderTwoRadiiToo) {
  PointSeries series = series_of_shape(kTenPoints);
  RegionJob job;
  job.construction = Construction::kParabolas;
  job.fixation = 1;
  const auto first = fit_construction(series, job);
  ASSERT_TRUE(first) << to_line(first.error());
  EXPECT_TRUE(first->certificate.proved) << first->certificate.reason;
  series.fixed.resize(kTenPoints.size());
  series.fixed[9].kappa = -1.0 / 1000.0;
  const auto refused = fit_construction(series, job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kBadOption);
  EXPECT_EQ(refused.error().index, 9);
  job.fixation = 2;
  const auto second = fit_construction(series, job);
  ASSERT_TRUE(second) << to_line(second.error());
  EXPECT_TRUE(second->certificate.proved) << second->certificate.reason;
  EXPECT_NEAR(second->contour.joints.back().element.kappa, -1.0 / 1000.0, 1e-12);
}

TEST(ConstructionFit, EllipsesBeginAnewWhereTheyWouldBeHyperbolas) {
  const auto series =
      read_points(std::string(OBVID_TEST_DATA) + "/../../examples/paper_series10.csv");
  ASSERT_TRUE(series);
  RegionJob job;
  job.construction = Construction::kEllipses;
  const auto f = fit_construction(*series, job);
  ASSERT_TRUE(f) << to_line(f.error());
  ASSERT_EQ(f->contour.pieces.size(), 9U);
  for (std::size_t k = 0; k < 9; ++k) {
    const auto* conic = std::get_if<RationalBezier>(&f->contour.pieces[k]);
    ASSERT_NE(conic, nullptr);
    EXPECT_LT(conic->weight[1] * conic->weight[1], conic->weight[0] * conic->weight[2]);
    EXPECT_EQ(f->contour.joints[k].leaving.has_value(), k == 7) << k;
  }
}

/// Two curves that meet at a right angle: constructions end there and begin anew.
TEST(ConstructionFit, CornersPartConstructions) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 5; ++i) points.push_back({0.6 * i, 0.1 * 0.36 * i * i});
  const Vec2 corner = points.back();
  for (int i = 1; i <= 5; ++i) {
    points.push_back(corner + Vec2{-0.5 * i - 0.02 * i * i, 0.8 * i - 0.03 * i * i});
  }
  for (const Construction which : kAllConstructions) {
    SCOPED_TRACE(static_cast<int>(which));
    RegionJob job;
    job.construction = which;
    const auto f = fit_construction(series_of_shape(points), job);
    ASSERT_TRUE(f) << to_line(f.error());
    EXPECT_TRUE(f->certificate.through_points);
    EXPECT_EQ(f->certificate.corners, 1);
  }
}

TEST(ConstructionFit, TwoArcsPerSegmentGoOneWayAndMeetTheTangents) {
  PointSeries series = series_of_shape(kTenPoints);
  series.fixed.resize(kTenPoints.size());
  series.fixed[4].theta = 79.0 * kOneDegree;
  RegionJob job;
  job.construction = Construction::kArcs;
  const auto f = fit_construction(series, job);
  ASSERT_TRUE(f) << to_line(f.error());
  ASSERT_EQ(f->contour.pieces.size(), 18U);
  double before = -HUGE_VAL;
  for (const Piece& piece : f->contour.pieces) {
    const auto* arc = std::get_if<ArcPiece>(&piece);
    ASSERT_NE(arc, nullptr);
    EXPECT_GE(arc->kappa, before);
    before = arc->kappa;
  }
  for (std::size_t j = 0; j < f->contour.joints.size(); ++j) {
    if (f->contour.joints[j].source != 4U) continue;
    EXPECT_NEAR(std::remainder(f->contour.joints[j].element.theta - 79.0 * kOneDegree,
                               2.0 * std::numbers::pi),
                0.0, 1e-9);
  }
  EXPECT_TRUE(f->certificate.proved) << f->certificate.reason;
}

/// By the neighbours' rule an end has the heading of the circle through it that is tangent to the
/// heading of its neighbour: one arc, of curvature 2 sin(angle to the chord) / chord.
TEST(ConstructionFit, HeadingsOfACircleMakeOneArc) {
  RegionJob job;
  job.construction = Construction::kArcs;
  job.rule = TangentRule::kNeighbours;
  const std::vector<Vec2> points{{0.0, 0.29552}, {0.5, 0.71736}, {1.0, 0.96356}, {1.5, 0.97385}};
  const auto f = fit_construction(series_of_shape(points), job);
  ASSERT_TRUE(f) << to_line(f.error());
  EXPECT_TRUE(f->certificate.proved) << f->certificate.reason;
  ASSERT_EQ(f->contour.pieces.size(), 4U);
  const auto twice_sine = [](Vec2 from, Vec2 to) { return 2.0 * std::sin(turning(from, to)); };
  const Vec2 first = points[1] - points[0], last = points[3] - points[2];
  EXPECT_NEAR(std::get<ArcPiece>(f->contour.pieces.front()).kappa,
              twice_sine(first, points[2] - points[0]) / norm(first), 1e-12);
  EXPECT_NEAR(std::get<ArcPiece>(f->contour.pieces.back()).kappa,
              twice_sine(points[3] - points[1], last) / norm(last), 1e-12);
}

TEST(ConstructionFit, OneClothoidPerSegmentIsTheClothoidBetweenItsTangents) {
  RegionJob job;
  job.construction = Construction::kClothoids;
  job.rule = TangentRule::kNeighbours;
  const auto f = fit_construction(series_of_shape(kTenPoints), job);
  ASSERT_TRUE(f) << to_line(f.error());
  ASSERT_EQ(f->contour.pieces.size(), 9U);
  for (std::size_t k = 1; k < 8; ++k) {  // 002: along the chord between both neighbours
    const double from = heading(kTenPoints[k + 1] - kTenPoints[k - 1]);
    const double to = heading(kTenPoints[k + 2] - kTenPoints[k]);
    const auto one = clothoid_between(kTenPoints[k], from, kTenPoints[k + 1], to);
    ASSERT_TRUE(one);
    const Jet a = evaluate(Piece{*one}, 0.5), b = evaluate(f->contour.pieces[k], 0.5);
    EXPECT_LT(norm(a.point - b.point), 1e-9);
  }
  EXPECT_GT(f->certificate.vertices, 0);
}

TEST(ConstructionFit, PointsAreInsertedUntilTheRegionIsNarrow) {
  RegionJob job;
  job.construction = Construction::kArcs;
  job.job.tolerance = 0.05;
  const auto f = fit_construction(series_of_shape(kTenPoints), job);
  ASSERT_TRUE(f) << to_line(f.error());
  EXPECT_GT(f->contour.pieces.size(), 30U);
  std::size_t sources = 0;
  for (const Joint& joint : f->contour.joints) sources += joint.source ? 1 : 0;
  EXPECT_EQ(sources, kTenPoints.size());
}

}  // namespace
}  // namespace obvid
