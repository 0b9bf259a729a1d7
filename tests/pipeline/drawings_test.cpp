// SPDX-License-Identifier: Apache-2.0
// What `fit` makes of drawings: docs/methods/drawings.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "../common/drawn_files.h"
#include "obvid/io/contour_json.h"
#include "obvid/pipeline/audit.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/import.h"

namespace obvid {
namespace {

using namespace testing_files;

constexpr double kPi = std::numbers::pi;

Fit fit_of(const std::string& path, const FitJob& job = {}, const ImportOptions& import = {}) {
  const auto series = read_series(path, import);
  EXPECT_TRUE(series) << to_line(series.error());
  if (!series) return {};
  auto made = fit(*series, job);
  EXPECT_TRUE(made) << to_line(made.error());
  return made ? std::move(*made) : Fit{};
}

Fit fit_of_svg(const std::string& shapes) {
  return fit_of(file_with("drawing.svg", svg_of(shapes)));
}
Fit fit_of_dxf(const std::string& entities, const FitJob& job = {},
               const ImportOptions& import = {}) {
  return fit_of(file_with("drawing.dxf", dxf_of(entities)), job, import);
}

/// Proved as it stands, proved again from its file, and every piece of one of the kinds.
template <class... Kinds>
void expect_drawn(const Fit& made, int corners, int steps) {
  EXPECT_TRUE(made.certificate.proved) << made.certificate.reason;
  EXPECT_EQ(made.certificate.corners, corners);
  EXPECT_EQ(made.certificate.curvature_steps, steps);
  EXPECT_EQ(made.contour.kept.size(), made.contour.pieces.size());
  for (const Piece& piece : made.contour.pieces) {
    EXPECT_TRUE((std::holds_alternative<Kinds>(piece) || ...));
  }
  const StoredContour stored{made.contour, made.report, made.certificate};
  const auto read = contour_from_json(contour_to_json(stored), "f");
  ASSERT_TRUE(read) << to_line(read.error());
  EXPECT_EQ(read->contour.kept, made.contour.kept);
  const Verification again = verify(*read);
  EXPECT_TRUE(again.certificate.proved) << again.certificate.reason;
  EXPECT_FALSE(again.false_claim) << to_line(*again.false_claim);
}

TEST(Drawings, ARectangleStaysARectangle) {
  for (const char* shape :
       {"<rect x='10' y='20' width='40' height='30'/>",
        "<polygon points='10,20 50,20 50,50 10,50'/>",
        "<polyline points='10,20 50,20 50,50 10,50 10,20'/>", "<path d='M10 20h40v30h-40z'/>"}) {
    const Fit made = fit_of_svg(shape);
    expect_drawn<LinePiece>(made, 4, 0);
    EXPECT_EQ(made.contour.pieces.size(), 4U) << shape;
    EXPECT_TRUE(made.contour.closed);
    EXPECT_EQ(made.certificate.vertices, 0);
    const KeptPieces kept = kept_pieces(made.contour);
    EXPECT_EQ(kept.lines, 4U);
  }
}

TEST(Drawings, ARectangleOfFourLinesStaysOne) {
  const Fit made = fit_of_dxf(dxf_line(0, 0, 4, 0) + dxf_line(4, 3, 4, 0) + dxf_line(4, 3, 0, 3) +
                              dxf_line(0, 3, 0, 0));
  expect_drawn<LinePiece>(made, 4, 0);
}

TEST(Drawings, TrianglesEllsHexagonsAndGearsStayWhatTheyAre) {
  std::string gear;
  for (int tooth = 0; tooth < 12; ++tooth) {
    for (int k = 0; k < 4; ++k) {
      const double r = k == 1 || k == 2 ? 45.0 : 38.0;
      const double angle = kPi / 6.0 * (tooth + 0.25 * k);
      gear += std::to_string(50 + r * std::cos(angle)) + "," +
              std::to_string(50 + r * std::sin(angle)) + " ";
    }
  }
  const std::pair<std::string, int> shapes[] = {
      {"10,10 60,10 30,70", 3},
      {"10,10 60,10 60,30 30,30 30,70 10,70", 6},
      {"70,50 60,67.32 40,67.32 30,50 40,32.68 60,32.68", 6},
      {gear, 48}};
  for (const auto& [points, corners] : shapes) {
    const Fit made = fit_of_svg("<polygon points='" + points + "'/>");
    expect_drawn<LinePiece>(made, corners, 0);
  }
}

TEST(Drawings, ARoundedRectangleIsFourLinesAndFourArcs) {
  const Fit made = fit_of_svg("<rect x='10' y='20' width='40' height='30' rx='5'/>");
  expect_drawn<LinePiece, ArcPiece>(made, 0, 8);
  const KeptPieces kept = kept_pieces(made.contour);
  EXPECT_EQ(kept.lines, 4U);
  EXPECT_EQ(kept.arcs, 4U);
  for (const Piece& piece : made.contour.pieces) {
    if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
      EXPECT_NEAR(std::abs(arc->kappa), 0.2, 1e-12);
    }
  }
}

TEST(Drawings, ACircleIsACircle) {
  for (const Fit& made : {fit_of_dxf("0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n0.5\n"),
                          fit_of_svg("<circle cx='50' cy='40' r='0.5'/>")}) {
    expect_drawn<ArcPiece>(made, 0, 0);
    EXPECT_EQ(kept_pieces(made.contour).arcs, 1U);
    EXPECT_TRUE(made.contour.closed);
    EXPECT_EQ(made.certificate.vertices, 0);
    for (const Piece& piece : made.contour.pieces) {
      EXPECT_NEAR(std::abs(std::get<ArcPiece>(piece).kappa), 2.0, 1e-12);
    }
  }
}

TEST(Drawings, ASlotIsTwoLinesAndTwoArcs) {
  const Fit made = fit_of_dxf(dxf_line(0, 0, 3, 0) + dxf_arc(3, 1, 1, -90, 90) +
                              dxf_line(3, 2, 0, 2) + dxf_arc(0, 1, 1, 90, 270));
  expect_drawn<LinePiece, ArcPiece>(made, 0, 4);
  const KeptPieces kept = kept_pieces(made.contour);
  EXPECT_EQ(kept.lines, 2U);
  EXPECT_EQ(kept.arcs, 2U);
  // around the slot the curvature rises twice and falls twice
  EXPECT_EQ(made.certificate.vertices, 4);
}

TEST(Drawings, BulgesAreArcs) {
  const double quarter = std::tan(kPi / 8.0);
  const Fit made = fit_of_dxf(
      dxf_polyline({{{0, 0, 0}}, {{4, 0, quarter}}, {{5, 1, 0}}, {{5, 3, 1}}, {{0, 3, 0}}}, true));
  EXPECT_TRUE(made.certificate.proved) << made.certificate.reason;
  const KeptPieces kept = kept_pieces(made.contour);
  EXPECT_EQ(kept.lines, 3U);
  EXPECT_EQ(kept.arcs, 2U);
}

/// Largest distance of points of the contour from an ellipse in its own frame, by its equation.
double off_ellipse(const Contour& contour, Vec2 centre, double a, double b, double rotation) {
  double most = 0.0;
  for (const Piece& piece : contour.pieces) {
    for (int k = 0; k <= 32; ++k) {
      const Vec2 p = evaluate(piece, k / 32.0).point - centre;
      const Vec2 u = unit_at(rotation);
      most = std::max(most, std::abs(std::hypot(dot(p, u) / a, cross(u, p) / b) - 1.0));
    }
  }
  return most;
}

TEST(Drawings, AnEllipseIsAnEllipseWithFourVertices) {
  const Fit made = fit_of_svg("<ellipse cx='50' cy='40' rx='30' ry='10'/>");
  expect_drawn<RationalBezier>(made, 0, 0);
  EXPECT_EQ(made.certificate.vertices, 4);
  EXPECT_EQ(made.certificate.inflections, 0);
  EXPECT_EQ(kept_pieces(made.contour).ellipses, 1U);
  EXPECT_LE(off_ellipse(made.contour, {50.0, 60.0}, 30.0, 10.0, 0.0), 1e-11);
}

TEST(Drawings, ArcsOfAnyEllipseAreProved) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    const double a = 1.0 + 9.0 * part(random), b = a * (0.02 + 0.97 * part(random));
    const double rotation = 2.0 * kPi * part(random), from = 2.0 * kPi * part(random);
    const bool whole = k % 3 == 0;
    const double sweep = whole ? 2.0 * kPi : 0.3 + 5.5 * part(random);
    const Vec2 u = a * unit_at(rotation);
    const auto n = [](double v) {
      char text[40];
      std::snprintf(text, sizeof text, "%.17g", v);
      return std::string(text) + "\n";
    };
    const std::string entity = "0\nELLIPSE\n8\n0\n10\n" + n(3.0) + "20\n" + n(-2.0) + "11\n" +
                               n(u.x) + "21\n" + n(u.y) + "40\n" + n(b / a) + "41\n" +
                               n(whole ? 0.0 : from) + "42\n" + n(whole ? sweep : from + sweep);
    const Fit made = fit_of_dxf(entity);
    EXPECT_TRUE(made.certificate.proved) << k << " " << made.certificate.reason;
    EXPECT_EQ(made.contour.kept.size(), made.contour.pieces.size()) << k;
    EXPECT_LE(off_ellipse(made.contour, {3.0, -2.0}, a, b, rotation), 1e-9) << k;
    EXPECT_EQ(kept_pieces(made.contour).ellipses, 1U) << k;
  }
}

// Two half ellipses of the axes 4, 2 and 4, 3 about one centre, meeting at the vertices that they
// share with a common tangent, are two ellipses: not what is smooth is one, but what lies on it.
TEST(Drawings, HalvesOfTwoEllipsesAreTwo) {
  const auto half = [](double b, bool upper) {
    const std::string minor = std::to_string(b / 4.0);
    return "0\nELLIPSE\n8\n0\n10\n0\n20\n0\n11\n4\n21\n0\n40\n" + minor + "\n41\n" +
           (upper ? "0\n42\n3.14159265358979312\n"
                  : "3.14159265358979312\n42\n6.28318530717958623\n");
  };
  EXPECT_EQ(kept_pieces(fit_of_dxf(half(2.0, true) + half(3.0, false)).contour).ellipses, 2U);
  EXPECT_EQ(kept_pieces(fit_of_dxf(half(2.0, true) + half(2.0, false)).contour).ellipses, 1U);
}

// A closed outline of two lines, an arc, and a spline that is tangent to both its neighbours.
TEST(Drawings, LinesAndArcsStayBesideASpline) {
  const Fit made = fit_of_svg("<path d='M10 10 H60 C80 10 90 20 90 40 V80 H10 Z'/>");
  EXPECT_TRUE(made.certificate.proved) << made.certificate.reason;
  const KeptPieces kept = kept_pieces(made.contour);
  EXPECT_EQ(kept.lines, 4U);
  EXPECT_EQ(made.certificate.corners, 3);
  EXPECT_LT(made.contour.kept.size(), made.contour.pieces.size());
  // the curve leaves the lines in their directions
  for (const std::size_t i : made.contour.kept) {
    const auto& line = std::get<LinePiece>(made.contour.pieces[i]);
    const std::size_t next = (i + 1) % made.contour.pieces.size();
    if (std::holds_alternative<LinePiece>(made.contour.pieces[next])) continue;
    const Vec2 along = evaluate(made.contour.pieces[next], 0.0).d1;
    EXPECT_NEAR(turning(line.end - line.start, along), 0.0, 1e-9);
  }
}

TEST(Drawings, APolylineOfManyChordsIsPointsOfACurve) {
  std::vector<std::array<double, 3>> vertices;
  for (int k = 0; k < 60; ++k) {
    const double t = 2.0 * kPi * k / 60.0;
    vertices.push_back({20.0 * std::cos(t), 10.0 * std::sin(t), 0.0});
  }
  const std::string path = file_with("ellipse.dxf", dxf_of(dxf_polyline(vertices, true)));
  const auto series = read_series(path);
  ASSERT_TRUE(series);
  EXPECT_TRUE(series->kept.empty());
  EXPECT_EQ(series->points.size(), 61U);
  const Fit made = fit_of(path);
  EXPECT_EQ(made.certificate.corners, 0);
  EXPECT_EQ(made.certificate.vertices, 4);
  ImportOptions exact;
  exact.use = DrawnUse::kExact;
  const Fit edges = fit_of(path, {}, exact);
  expect_drawn<LinePiece>(edges, 60, 0);
}

TEST(Drawings, FlanksOfChordsBetweenArcsBecomeCurvesWithTheirCorners) {
  // a tooth: root arc, a flank of ten chords of a parabola, tip arc, and the mirror image of the
  // flank
  std::string entities;
  const auto flank = [](double t) { return Vec2{1.0 - 0.4 * t * t, 2.0 * t}; };
  for (int k = 0; k < 10; ++k) {
    const Vec2 a = flank(k / 10.0), b = flank((k + 1) / 10.0);
    entities += dxf_line(a.x, a.y, b.x, b.y) + dxf_line(-a.x, a.y, -b.x, b.y);
  }
  entities += dxf_line(1.0, 0.0, -1.0, 0.0) + dxf_line(0.6, 2.0, -0.6, 2.0);
  const Fit made = fit_of_dxf(entities);
  EXPECT_TRUE(made.certificate.proved) << made.certificate.reason;
  EXPECT_EQ(made.certificate.corners, 4);
}

TEST(Drawings, PointsMayBeTakenOfEverything) {
  ImportOptions points;
  points.use = DrawnUse::kPoints;
  const auto series = read_series(
      file_with("circle.dxf", dxf_of("0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n0.5\n")), points);
  ASSERT_TRUE(series);
  EXPECT_TRUE(series->kept.empty());
  EXPECT_GT(series->points.size(), 20U);
}

TEST(Drawings, HeadingsAreNotForcedOnLinesThatStay) {
  const auto series =
      read_series(file_with("line.dxf", dxf_of(dxf_line(0, 0, 4, 0) + dxf_line(4, 0, 4, 3))));
  ASSERT_TRUE(series);
  FitJob job;
  job.start_heading = 0.5;
  const auto made = fit(*series, job);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kFixedDataContradict);
  EXPECT_NE(made.error().hint.find("--drawing points"), std::string::npos);
}

TEST(Drawings, NoiseDoesNotMoveWhatStays) {
  FitJob job;
  job.noise = 0.1;
  const Fit made = fit_of_dxf(dxf_line(0, 0, 4, 0) + dxf_arc(4, 1, 1, -90, 0), job);
  ASSERT_EQ(made.contour.kept.size(), 2U);
  EXPECT_TRUE(std::get<LinePiece>(made.contour.pieces[0]).end == (Vec2{4, 0}));
}

TEST(Drawings, EndsThatNearlyMeetAreJoinedAndOthersAreNot) {
  const Fit near = fit_of_dxf(dxf_line(0, 0, 4, 0.000002) + dxf_arc(4, 1, 1, -90, 0));
  EXPECT_EQ(near.contour.kept.size(), 2U);
  EXPECT_TRUE(near.certificate.gaps_within_bounds) << near.certificate.reason;
  // the arc stays where it is, to the last bit
  const auto& arc = std::get<ArcPiece>(near.contour.pieces[1]);
  EXPECT_EQ(arc.kappa, 1.0);
  EXPECT_NEAR(arc.start.y, 0.0, 1e-15);
  const auto apart =
      read_series(file_with("gap.xodr",
                            "<OpenDRIVE><road id='1' length='20'><planView>"
                            "<geometry s='0' x='0' y='0' hdg='0' length='10'><line/></geometry>"
                            "<geometry s='10' x='10' y='0.5' hdg='0' length='10'><line/></geometry>"
                            "</planView></road></OpenDRIVE>"));
  ASSERT_TRUE(apart) << to_line(apart.error());
  EXPECT_TRUE(apart->kept.empty());
  const bool told = std::any_of(apart->warnings.begin(), apart->warnings.end(), [](const auto& w) {
    return w.find("0.5 apart") != std::string::npos;
  });
  EXPECT_TRUE(told);
}

TEST(Drawings, GcodeOfARectangleIsFourStraightBlocks) {
  const Fit made = fit_of_svg("<rect x='10' y='20' width='40' height='30'/>");
  const auto out =
      export_contour({made.contour, made.report, made.certificate}, FileFormat::kGcode);
  ASSERT_TRUE(out) << to_line(out.error());
  const std::string& text = out->files.front().text;
  EXPECT_EQ(text.find("G2 "), std::string::npos);
  EXPECT_EQ(text.find("G3 "), std::string::npos);
  std::size_t moves = 0;
  for (std::size_t at = text.find("G1 X"); at != std::string::npos;
       at = text.find("G1 X", at + 1)) {
    ++moves;
  }
  EXPECT_EQ(moves, 4U) << text;
}

TEST(Drawings, WhatStaysIsTheSameInEveryCarrier) {
  const std::string path =
      file_with("slot.dxf", dxf_of(dxf_line(0, 0, 3, 0) + dxf_arc(3, 1, 1, -90, 90) +
                                   dxf_line(3, 2, 0, 2) + dxf_arc(0, 1, 1, 90, 270)));
  for (const Carrier carrier : kAllCarriers) {
    FitJob job;
    job.carrier = carrier;
    const Fit made = fit_of(path, job);
    EXPECT_EQ(kept_pieces(made.contour).lines, 2U) << to_string(carrier);
    EXPECT_EQ(kept_pieces(made.contour).arcs, 2U) << to_string(carrier);
    EXPECT_TRUE(made.certificate.proved) << to_string(carrier) << made.certificate.reason;
  }
}

TEST(Drawings, ClothoidsOfRoadsStay) {
  const std::string road =
      "<OpenDRIVE><road id='1' length='130'><planView>"
      "<geometry s='0' x='0' y='0' hdg='0' length='50'><line/></geometry>"
      "<geometry s='50' x='50' y='0' hdg='0' length='40'>"
      "<spiral curvStart='0' curvEnd='0.01'/></geometry></planView></road></OpenDRIVE>";
  const Fit made = fit_of(file_with("road.xodr", road));
  expect_drawn<LinePiece, ClothoidPiece>(made, 0, 0);
  EXPECT_EQ(kept_pieces(made.contour).clothoids, 1U);
}

// ---- which curve ------------------------------------------------------------------------------

std::string gpx_of(const std::string& inside) { return "<gpx version='1.1'>" + inside + "</gpx>"; }
const std::string kWaypoints = "<wpt lat='46.0' lon='14.0'/><wpt lat='46.2' lon='14.3'/>";
const std::string kTrack =
    "<trk><name>walk</name><trkseg><trkpt lat='46.0' lon='14.0'/><trkpt lat='46.001' lon='14.001'/>"
    "<trkpt lat='46.002' lon='14.0'/></trkseg></trk>";
const std::string kRoute =
    "<rte><name>plan</name><rtept lat='46.0' lon='14.0'/><rtept lat='46.05' lon='14.05'/>"
    "<rtept lat='46.1' lon='14.0'/></rte>";

TEST(Drawings, ATrackIsTakenBeforeLongerRoutesAndWaypoints) {
  const auto series = read_series(file_with("a.gpx", gpx_of(kWaypoints + kRoute + kTrack)));
  ASSERT_TRUE(series) << to_line(series.error());
  EXPECT_EQ(series->label, "track walk");
  EXPECT_EQ(series->points.size(), 3U);
  bool told = false;
  for (const std::string& warning : series->warnings) {
    told = told || (warning.find("track walk") != std::string::npos &&
                    warning.find(" of 3 ") != std::string::npos &&
                    warning.find("other 2") != std::string::npos);
  }
  EXPECT_TRUE(told);
  const auto route = read_series(file_with("b.gpx", gpx_of(kWaypoints + kRoute)));
  ASSERT_TRUE(route);
  EXPECT_EQ(route->label, "route plan");
}

TEST(Drawings, WaypointsAreNoCurveUnlessAskedFor) {
  const std::string path = file_with("c.gpx", gpx_of(kWaypoints));
  const auto refused = read_series(path);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().hint.find("--curve 1"), std::string::npos);
  ImportOptions first;
  first.curve.number = 0;
  EXPECT_TRUE(read_series(path, first));
}

// ---- points alone -----------------------------------------------------------------------------

PointSeries points(std::vector<Vec2> all) {
  PointSeries out;
  out.points = std::move(all);
  return out;
}

TEST(Drawings, CoarsePolygonsOfPointsGetAWordOrCorners) {
  const std::vector<Vec2> ell{{0, 0}, {40, 0}, {40, 10}, {10, 10}, {10, 30}, {0, 30}, {0, 0}};
  const auto round = fit(points(ell), {});
  ASSERT_TRUE(round) << to_line(round.error());
  const bool told =
      std::any_of(round->warnings.begin(), round->warnings.end(), [](const std::string& w) {
        return w.find("turn by 90 degrees") != std::string::npos &&
               w.find("--corner-angle 20") != std::string::npos;
      });
  EXPECT_TRUE(told);
  FitJob job;
  job.corner_angle = 20.0 * kPi / 180.0;
  const auto sharp = fit(points(ell), job);
  ASSERT_TRUE(sharp) << to_line(sharp.error());
  EXPECT_EQ(sharp->certificate.corners, 6);
  EXPECT_EQ(sharp->contour.pieces.size(), 6U);
  EXPECT_TRUE(sharp->warnings.empty());
  FitJob none;
  none.find_corners = false;
  const auto smooth = fit(points(ell), none);
  ASSERT_TRUE(smooth);
  EXPECT_TRUE(smooth->warnings.empty());
}

std::vector<Vec2> regular(int corners) {
  std::vector<Vec2> out;
  for (int i = 0; i < corners; ++i) out.push_back(10.0 * unit_at(2.0 * kPi * i / corners));
  return out;
}

/// Twelve teeth with steep flanks.
std::vector<Vec2> gear() {
  std::vector<Vec2> out;
  for (int tooth = 0; tooth < 12; ++tooth) {
    const double at = tooth * kPi / 6.0;
    for (const double side : {-0.10, -0.07, 0.07, 0.10}) {
      out.push_back((std::abs(side) < 0.09 ? 10.0 : 8.0) * unit_at(at + side));
    }
  }
  return out;
}

TEST(Drawings, NoCarrierRoundsACoarsePolygonWithoutAWordAndAllKeepItsCorners) {
  const std::vector<std::vector<Vec2>> shapes = {
      {{0, 0}, {40, 0}, {40, 20}, {0, 20}},
      {{0, 0}, {30, 0}, {10, 25}},
      {{0, 0}, {40, 0}, {40, 10}, {10, 10}, {10, 30}, {0, 30}},
      regular(6),
      gear()};
  const auto advises = [](const std::string& text) {
    return text.find("--corner-angle 20 makes corners of all of them") != std::string::npos;
  };
  for (const std::vector<Vec2>& shape : shapes) {
    std::vector<Vec2> closed = shape;
    closed.push_back(shape.front());
    for (const Carrier carrier : kAllCarriers) {
      SCOPED_TRACE(std::to_string(shape.size()) + " corners, " + to_string(carrier));
      FitJob job;
      job.carrier = carrier;
      const auto bare = fit(points(closed), job);
      EXPECT_TRUE(bare ? std::any_of(bare->warnings.begin(), bare->warnings.end(), advises)
                       : advises(to_line(bare.error())));
      job.corner_angle = 20.0 * kPi / 180.0;
      const auto sharp = fit(points(closed), job);
      ASSERT_TRUE(sharp) << to_line(sharp.error());
      EXPECT_EQ(static_cast<std::size_t>(sharp->certificate.corners), shape.size());
      EXPECT_EQ(sharp->contour.pieces.size(), shape.size());
    }
  }
}

TEST(Drawings, ACurveIsChosenByItsNameOrAWordOfIt) {
  Drawing drawing;
  const std::vector<Piece> line{LinePiece{{0.0, 0.0}, {1.0, 0.0}}};
  drawing.curves = {{"LINE 1A on layer EDGE", line, false},
                    {"LINE 2B on layer Edge", line, false},
                    {"HOLE", line, false}};
  PointSeries track;
  track.name = "track HOLE, part 2";
  track.points = {{0.0, 0.0}, {1.0, 1.0}, {2.0, 0.0}};
  drawing.series = {track};
  const auto number = [&](const char* name) {
    const auto chosen = chosen_curve(drawing, {std::nullopt, name, false}, "f");
    return chosen ? static_cast<int>(*chosen) : -static_cast<int>(chosen.error().code);
  };
  EXPECT_EQ(number("2b"), 1);
  EXPECT_EQ(number("HOLE"), 2);     // all of a name, though a word of another
  EXPECT_EQ(number("hole"), -203);  // a word of two
  EXPECT_EQ(number("edge"), -203);
  EXPECT_EQ(number("track hole"), 3);
  EXPECT_EQ(number("part"), 3);
  EXPECT_EQ(number("2"), 3);
  EXPECT_EQ(number("ED"), -203);  // no whole word
  EXPECT_EQ(number("LID"), -203);
  const auto all = chosen_curve(drawing, {std::nullopt, "", true}, "f");
  ASSERT_FALSE(all);
  EXPECT_EQ(all.error().where, "--curve");
}

}  // namespace
}  // namespace obvid
