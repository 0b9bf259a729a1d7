// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "obvid/curve/internal/clothoid.h"
#include "obvid/picture/picture_svg.h"
#include "picture_contours.h"
#include "plane/axis.h"
#include "plane/canvas.h"
#include "plane/region.h"
#include "plane/track.h"

namespace obvid {
namespace {

using namespace picture_test;

/// Parabola branch y = x^2 as quadratic Bezier from x = 0 to `width`, moved by `origin`.
RationalBezier parabola(double width, Vec2 origin) {
  RationalBezier piece;
  piece.origin = origin;
  piece.degree = 2;
  piece.offset[1] = {0.5 * width, 0.0};
  piece.offset[2] = {width, width * width};
  piece.weight[0] = piece.weight[1] = piece.weight[2] = 1.0;
  return piece;
}

/// Bold letters of the fonts that pictures name are 0.6 of their size wide on average, or less.
TEST(PictureCanvas, AWideVerdictIsAsLargeAsItFits) {
  constexpr double kRoom = 920.0, kWidth = 0.6, kUsual = 14.0;
  for (const std::size_t letters : {40U, 105U, 120U, 300U}) {
    PictureCanvas canvas;
    canvas.verdict({40.0, 64.0}, "good", std::string(letters, 'n'), kRoom);
    const std::string text = canvas.take();
    EXPECT_NE(text.find("class=\"verdict good\""), std::string::npos);
    const std::size_t at = text.find("font-size:");
    const double size = at == std::string::npos ? kUsual : std::stod(text.substr(at + 10));
    EXPECT_LE(size, kUsual);
    EXPECT_LE(kWidth * size * static_cast<double>(letters), kRoom) << letters;
    EXPECT_GE(size, std::min(kUsual, 0.9 * kRoom / (kWidth * static_cast<double>(letters))));
  }
}

TEST(Picture, DrawsACircleWithinOneTwentiethOfAPixel) {
  const std::string path = path_of(picture_svg(semicircle(5.0, {3.0, 2.0})), "curve even");
  const std::vector<double> n = numbers_of(path);
  ASSERT_GE(n.size(), 8U);
  const Vec2 first{n[0], n[1]};
  const Vec2 last{n[n.size() - 2], n[n.size() - 1]};
  const Vec2 centre = 0.5 * (first + last);
  const double radius = 0.5 * norm(last - first);
  double worst = 0.0;
  Vec2 p0 = first;
  for (std::size_t i = 2; i + 5 < n.size(); i += 6) {
    const Vec2 p1{n[i], n[i + 1]}, p2{n[i + 2], n[i + 3]}, p3{n[i + 4], n[i + 5]};
    for (double t = 0.0; t <= 1.0; t += 0.0625) {
      const double s = 1.0 - t;
      const Vec2 p = s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3;
      worst = std::max(worst, std::fabs(norm(p - centre) - radius));
    }
    p0 = p3;
  }
  EXPECT_GT(radius, 100.0) << "the drawing should fill the panel";
  EXPECT_LT(worst, 0.05);
}

TEST(Picture, HasTheYAxisUp) {
  // A semicircle above its ends: on the screen, smaller y.
  const std::vector<double> n =
      numbers_of(path_of(picture_svg(semicircle(5.0, {0.0, 0.0})), "curve even"));
  ASSERT_GE(n.size(), 8U);
  EXPECT_LT(n[n.size() / 2 / 2 * 2 + 1], n[1] - 50.0);
}

TEST(Picture, DoesNotChangeWhenTheContourMovesFarAway) {
  // Offsets keep all digits, so not a byte may differ even where coordinates lose 12 digits.
  StoredContour near;
  near.contour.pieces = {parabola(1.0, {1.0, 1.0})};
  near.contour.runs = {{0, 0, -1}};
  StoredContour far = near;
  far.contour.pieces = {parabola(1.0, {0x1p40, -0x1p40})};
  EXPECT_EQ(picture_svg(near), picture_svg(far));
}

TEST(Picture, DrawsTheSameShapeAtEverySize) {
  const std::string unit = path_of(picture_svg(semicircle(1.0, {0.0, 0.0})), "curve even");
  ASSERT_FALSE(unit.empty());
  for (const double size : {0x1p-30, 0x1p-300, 0x1p30, 0x1p300}) {
    const std::string svg = picture_svg(semicircle(size, {0.0, 0.0}));
    EXPECT_EQ(path_of(svg, "curve even"), unit) << size;
    EXPECT_EQ(svg.find("nan"), std::string::npos) << size;
    EXPECT_EQ(svg.find("\"inf"), std::string::npos) << size;
  }
}

TEST(Picture, CopesWithNothingALineAndAPoint) {
  StoredContour stored;
  EXPECT_NE(picture_svg(stored).find("</svg>"), std::string::npos);
  stored.contour.points = {{7.0, 7.0}};
  EXPECT_NE(picture_svg(stored).find("</svg>"), std::string::npos);
  stored.contour.pieces = {LinePiece{{0.0, 0.0}, {3.0, 0.0}}};
  stored.contour.runs = {{0, 0, 0}};
  const std::string svg = picture_svg(stored);
  EXPECT_NE(svg.find("infinite radius everywhere"), std::string::npos);
  EXPECT_EQ(svg.find("curvature comb"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Picture, ShowsTheSlopeOfTheCurvatureWhenAskedTo) {
  // a clothoid whose curvature goes from 0 to 3 over a length of 6: its slope is 1/2
  StoredContour stored;
  ClothoidPiece piece{{0.0, 0.0}, {}, 0.0, 0.0, 3.0, 6.0};
  piece.end = clothoid_step(0.0, 0.0, 3.0, 6.0);
  stored.contour.carrier = Carrier::kClothoids;
  stored.contour.pieces = {piece};
  stored.contour.runs = {{0, 0, 1}};
  const char* title = "Slope of the curvature, ";
  EXPECT_EQ(picture_svg(stored).find(title), std::string::npos);
  const std::string svg = picture_svg(stored, {}, {.slope = true});
  const std::size_t at = svg.find(title);
  ASSERT_NE(at, std::string::npos);
  EXPECT_NE(svg.find("²", at), std::string::npos);
  // its axis begins with 0 and ends at 1/2 or just above
  const std::string plot = svg.substr(at, svg.find("Radius", at) - at);
  EXPECT_NE(plot.find(">0.4"), std::string::npos) << plot;
  EXPECT_EQ(plot.find(">1.0"), std::string::npos) << plot;
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Picture, SaysWhatIsProvedAndWhatIsNot) {
  StoredContour stored = semicircle(1.0, {0.0, 0.0});
  EXPECT_NE(picture_svg(stored).find("no certificate"), std::string::npos);
  stored.certificate = Certificate{};
  stored.certificate->proved = true;
  stored.certificate->joints = 3;
  EXPECT_NE(picture_svg(stored).find("proved: monotone curvature, G2 joints"), std::string::npos);
  stored.certificate->gaps.slope = 1e-12;
  EXPECT_NE(picture_svg(stored).find("proved: monotone curvature, G3 joints"), std::string::npos);
  stored.certificate->gaps.slope.reset();
  stored.contour.carrier = Carrier::kArcs;
  EXPECT_NE(picture_svg(stored).find("proved: monotone radii, G1 joints"), std::string::npos);
  EXPECT_EQ(picture_svg(stored).find("G2"), std::string::npos);
  stored.certificate->proved = false;
  stored.certificate->reason = "gap <3> & more";
  EXPECT_NE(picture_svg(stored).find("NOT proved: gap &lt;3&gt; &amp; more"), std::string::npos);
}

TEST(Picture, StaysSmallForAHundredThousandWildPieces) {
  std::vector<double> kappas;
  for (int i = 0; i < 100000; ++i) {
    kappas.push_back((1.0 + (i * 7919) % 1000) / 500.0 * (i % 3 == 0 ? -1.0 : 1.0));
  }
  StoredContour stored = arc_chain(kappas, 0.3);
  for (std::size_t i = 0; i < kappas.size(); ++i) {
    stored.contour.runs.push_back({i, i, i % 2 == 0 ? 1 : -1});
  }
  EXPECT_LT(picture_svg(stored).size(), 3000000U);
}

TEST(PictureTrack, MeasuresTheLengthOfACircle) {
  const PictureTrack track = make_track(semicircle(5.0, {1e3, 0.0}).contour);
  EXPECT_NEAR(track.length, kPi * 5.0, 1e-6 * kPi * 5.0);
  EXPECT_NEAR(track.largest_kappa, 0.2, 1e-12);
}

TEST(PictureTrack, SpreadsTeethEvenlyOnACircle) {
  const PictureTrack track = make_track(semicircle(5.0, {0.0, 0.0}).contour);
  const std::vector<PictureTooth> teeth = comb_teeth(track, 100);
  ASSERT_GE(teeth.size(), 100U);
  for (std::size_t i = 1; i + 2 < teeth.size(); ++i) {
    EXPECT_NEAR(teeth[i].s - teeth[i - 1].s, track.length / 100.0, 1e-6 * track.length);
  }
}

TEST(PictureTrack, SpreadsTeethEvenlyOverArcsAndClothoidsWhereThatIsAsked) {
  // a clothoid between two arcs, 10 long each, from curvature 0.01 to 0.2
  const ClothoidPiece into{{0, 0}, clothoid_at({{0, 0}, 0, 0.01}, 0.019, 10).point, 0, 0.01, 0.2,
                           10};
  const Element joint = clothoid_at({{0, 0}, 0, 0.01}, 0.019, 10);
  const Element end = clothoid_at(joint, 0.0, 10);
  Contour contour;
  contour.points = {{0, 0}, joint.point, end.point};
  contour.pieces = {into, ArcPiece{joint.point, end.point, joint.theta, 0.2, 10}};
  PictureTrack track = make_track(contour);
  track.even_teeth = true;
  const std::vector<PictureTooth> teeth = comb_teeth(track, 100);
  ASSERT_GE(teeth.size(), 100U);
  for (std::size_t i = 1; i + 2 < teeth.size(); ++i) {
    EXPECT_NEAR(teeth[i].s - teeth[i - 1].s, 20.0 / 100.0, 1e-5) << i;
  }
}

TEST(PictureTrack, FindsTheInflectionBetweenOppositeArcsAndAVertexWhereRunsMeet) {
  StoredContour stored = arc_chain({-0.5, 0.25, 1.0, 0.5}, 0.4);
  stored.contour.runs = {{0, 2, 1}, {3, 3, -1}};
  const PictureTrack track = make_track(stored.contour);
  ASSERT_EQ(track.features.size(), 2U);
  EXPECT_EQ(track.features[0].kind, PictureFeature::Kind::kInflection);
  EXPECT_NEAR(track.features[0].at.s, 0.8, 1e-5);  // the first arc is 0.4 / 0.5 long
  EXPECT_EQ(track.features[1].kind, PictureFeature::Kind::kVertex);
  EXPECT_NEAR(track.features[1].at.s, 0.8 + 1.6 + 0.4, 1e-5);
}

TEST(PictureTrack, MarksOneVertexInTheMiddleOfACircleBetweenOppositeRuns) {
  StoredContour stored = arc_chain({0.5, 1.0, 0.5}, 0.4);
  stored.contour.runs = {{0, 0, 1}, {1, 1, 0}, {2, 2, -1}};
  const PictureTrack track = make_track(stored.contour);
  ASSERT_EQ(track.features.size(), 1U);
  EXPECT_NEAR(track.features[0].at.s, 0.8 + 0.2, 0.01);
}

/// Contour of chords that stands on its points; the region looks at joints and runs only.
StoredContour on_points(const std::vector<Vec2>& points, const std::vector<obvid::Run>& runs) {
  StoredContour stored;
  stored.contour.points = points;
  stored.contour.runs = runs;
  for (std::size_t i = 0; i < points.size(); ++i) {
    stored.contour.joints.push_back({{points[i], 0.0, 0.0}, i, std::nullopt});
    if (i > 0) stored.contour.pieces.emplace_back(LinePiece{points[i - 1], points[i]});
  }
  return stored;
}

/// On y = x^2 curvature falls from x = 0 on.
std::vector<Vec2> parabola_points() {
  return {{0.0, 0.0}, {0.4, 0.16}, {1.0, 1.0}, {1.5, 2.25}, {2.5, 6.25}, {3.0, 9.0}};
}

/// Centre from the perpendicular bisectors.
Vec2 circumcentre(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 p = b - a, q = c - a;
  const double d = 2.0 * cross(p, q);
  return a + Vec2{q.y * dot(p, p) - p.y * dot(q, q), p.x * dot(q, q) - q.x * dot(p, p)} / d;
}

TEST(PictureRegion, RunsBetweenTheCirclesThroughEachThreePoints) {
  const std::vector<Vec2> points = parabola_points();
  const StoredContour stored = on_points(points, {{0, 4, -1}});
  const std::vector<PictureLens> region =
      points_only_region(make_track(stored.contour), stored.contour);
  ASSERT_EQ(region.size(), 3U) << "first and last chord have no region";
  PictureView view;
  view.scale = 1e4;
  for (std::size_t k = 0; k < region.size(); ++k) {
    PicturePath path;
    add_lens(path, region[k], view);
    const std::vector<double> n = numbers_of(path.text());
    ASSERT_GE(n.size(), 14U);
    const auto at = [&](std::size_t j) { return Vec2{n[j], -n[j + 1]} / 1e4; };
    const std::size_t i = k + 1;  // first point of the chord
    const Vec2 centres[2] = {circumcentre(points[i - 1], points[i], points[i + 1]),
                             circumcentre(points[i], points[i + 1], points[i + 2])};
    EXPECT_LT(norm(at(0) - points[i]), 1e-6);
    EXPECT_LT(norm(at(n.size() - 2) - points[i]), 1e-6) << "the outline closes";
    std::size_t arc = 0;
    for (std::size_t j = 0; j + 7 < n.size(); j += 6) {
      const Vec2 end = at(j + 6);
      const Vec2 middle = (at(j) + 3.0 * at(j + 2) + 3.0 * at(j + 4) + end) / 8.0;
      const double radius = norm(points[i] - centres[arc]);
      EXPECT_NEAR(norm(middle - centres[arc]), radius, 1e-5 * radius) << i << ' ' << j;
      EXPECT_NEAR(norm(end - centres[arc]), radius, 1e-5 * radius) << i << ' ' << j;
      if (norm(end - points[i + 1]) < 1e-6) arc = 1;
    }
    EXPECT_EQ(arc, 1U);
  }
}

TEST(PictureRegion, HoldsTheCurveThatThePointsWereTakenFrom) {
  const std::vector<Vec2> points = parabola_points();
  const StoredContour stored = on_points(points, {{0, 4, -1}});
  const auto region = points_only_region(make_track(stored.contour), stored.contour);
  ASSERT_EQ(region.size(), 3U);
  for (std::size_t i = 1; i <= 3; ++i) {
    const Vec2 chord = points[i + 1] - points[i];
    const double h = norm(chord);
    // The tangent of the parabola is parallel to the chord above the middle abscissa.
    const double x = 0.5 * (points[i].x + points[i + 1].x);
    const double height = -cross(chord, Vec2{x, x * x} - points[i]) / h;
    const auto sag = [h](double e) { return 0.5 * h * std::tan(0.5 * e); };
    const PictureLens& lens = region[i - 1];
    EXPECT_GT(height, std::min(sag(lens.half_turn[0]), sag(lens.half_turn[1])));
    EXPECT_LT(height, std::max(sag(lens.half_turn[0]), sag(lens.half_turn[1])));
    EXPECT_NEAR(lens.width, std::fabs(sag(lens.half_turn[0]) - sag(lens.half_turn[1])), 1e-12);
  }
}

TEST(PictureRegion, EndsWhereTheContourHasAVertexOrTurnsTheOtherWay) {
  const auto count = [](const std::vector<obvid::Run>& runs) {
    const StoredContour stored = on_points(parabola_points(), runs);
    return points_only_region(make_track(stored.contour), stored.contour).size();
  };
  EXPECT_EQ(count({{0, 4, -1}}), 3U);
  EXPECT_EQ(count({{0, 0, 0}, {1, 4, -1}}), 3U) << "a circle is monotone either way";
  EXPECT_EQ(count({{0, 3, -1}, {4, 4, 1}}), 2U);
  EXPECT_EQ(count({{0, 1, -1}, {2, 4, 1}}), 0U);
  EXPECT_EQ(count({{0, 4, 1}}), 0U) << "not what the circles say";
  EXPECT_EQ(count({}), 0U);
}

TEST(PictureRegion, SaysNoMoreThanTheReport) {
  StoredContour stored = on_points(parabola_points(), {{0, 4, -1}});
  FitReport& report = stored.report.emplace();
  for (std::size_t i = 0; i < 5; ++i) {
    SegmentReport& segment = report.segments.emplace_back();
    segment.from = i;
    segment.to = i + 1;
    segment.points_only_error = i == 2 ? 0.01 : std::numeric_limits<double>::quiet_NaN();
  }
  const auto region = points_only_region(make_track(stored.contour), stored.contour, &report);
  ASSERT_EQ(region.size(), 1U);
  EXPECT_EQ(region[0].start, stored.contour.points[2]);
}

TEST(PictureRegion, IsSilentlyMissingWherePointsCannotBeAnalysed) {
  StoredContour twice = on_points({{0, 0}, {1, 0}, {1, 0}, {2, 1}, {2, 2}}, {{0, 3, 1}});
  EXPECT_TRUE(points_only_region(make_track(twice.contour), twice.contour).empty());
  StoredContour back = on_points({{0, 0}, {1, 0}, {0, 0}, {2, 1}, {2, 2}}, {{0, 3, 1}});
  EXPECT_TRUE(points_only_region(make_track(back.contour), back.contour).empty());
  StoredContour bare = on_points(parabola_points(), {{0, 4, -1}});
  bare.contour.joints.clear();
  EXPECT_TRUE(points_only_region(make_track(bare.contour), bare.contour).empty());
  EXPECT_NE(picture_svg(back).find("</svg>"), std::string::npos);
}

TEST(PictureRegion, IsDrawnWhereItCanBeSeenAndThenStandsInTheLegend) {
  const std::string wide = picture_svg(on_points(parabola_points(), {{0, 4, -1}}));
  EXPECT_NE(wide.find("<path class=\"region\""), std::string::npos);
  EXPECT_NE(wide.find("region: every monotone curve through the points, widest "),
            std::string::npos);
  std::vector<Vec2> dense;
  for (int i = 0; i <= 200; ++i) dense.push_back({0.01 * i, 1e-4 * i * i});
  const StoredContour fine = on_points(dense, {{0, 199, -1}});
  EXPECT_EQ(points_only_region(make_track(fine.contour), fine.contour).size(), 198U);
  EXPECT_EQ(picture_svg(fine).find("<path class=\"region\""), std::string::npos);
  EXPECT_EQ(picture_svg(fine).find("every monotone curve"), std::string::npos);
}

TEST(PictureAxis, HasRoundTicks) {
  const PictureAxis axis = round_axis(-0.165, 0.0, 5);
  EXPECT_DOUBLE_EQ(axis.low, -0.2);
  EXPECT_DOUBLE_EQ(axis.high, 0.0);
  ASSERT_EQ(axis.ticks.size(), 5U);
  EXPECT_EQ(axis.ticks.front().label, "−0.20");
  EXPECT_EQ(axis.ticks.back().label, "0.00");
}

TEST(PictureAxis, TakesAPowerOfTenOutOfLabelsThatWouldBeLong) {
  const PictureAxis axis = tight_axis(0.0, 5e-9, 8);
  EXPECT_EQ(axis.exponent, -9);
  EXPECT_EQ(axis.ticks.back().label, "5");
  EXPECT_EQ(power_prefix(axis.exponent), "10⁻⁹ ");
}

TEST(PictureAxis, LabelsOneTwoAndFiveOfAFewDecades) {
  const PictureAxis axis = log_axis(6.0, 520.0);
  std::string labels;
  for (const PictureTick& tick : axis.ticks) labels += tick.label + " ";
  EXPECT_EQ(labels, "10 20 50 100 200 500 ");
  EXPECT_NEAR(axis.place(6.0), 0.0, 1e-12);
  EXPECT_NEAR(axis.place(520.0), 1.0, 1e-12);
}

TEST(PictureAxis, RoundsScaleBarsDownToOneTwoFive) {
  EXPECT_DOUBLE_EQ(round_down(0.99), 0.5);
  EXPECT_DOUBLE_EQ(round_down(1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_down(499.0), 200.0);
  EXPECT_DOUBLE_EQ(round_down(5e-10), 5e-10);
}

TEST(PictureAxis, WritesNumbersForReading) {
  EXPECT_EQ(readable_number(0.00087, 2), "0.00087");
  EXPECT_EQ(readable_number(1500.0, 3), "1500");
  EXPECT_EQ(readable_number(-0.5, 3), "−0.5");
  EXPECT_EQ(readable_number(2e9, 3), "2·10⁹");
  EXPECT_EQ(readable_bound(2003305.0, 2), "2.1·10⁶");
  EXPECT_EQ(readable_bound(2e6, 2), "2·10⁶");
  EXPECT_EQ(readable_bound(9.99e6, 2), "10⁷");
  EXPECT_EQ(readable_bound(0.0001231, 2), "0.00013");
  EXPECT_EQ(readable_number(1e-9, 3), "10⁻⁹");
  EXPECT_EQ(readable_number(0.0, 3), "0");
}

TEST(PictureCanvas, WritesPixelsShortly) {
  EXPECT_EQ(px(1.5), "1.5");
  EXPECT_EQ(px(-0.004), "0");
  EXPECT_EQ(px(12.0), "12");
  EXPECT_EQ(px(-3.456), "-3.46");
  EXPECT_EQ(px(std::nan("")), "0");
}

}  // namespace
}  // namespace obvid
