// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/read_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

namespace obvid {
namespace {

using Points = std::vector<Vec2>;

Points points_of(std::string_view text) {
  const auto series = parse_points(text, "f");
  EXPECT_TRUE(series.has_value()) << (series ? "" : to_line(series.error()));
  return series ? series->points : Points{};
}

void expect_error(std::string_view text, ErrorCode code, std::string_view where) {
  const auto series = parse_points(text, "f");
  ASSERT_FALSE(series.has_value()) << text;
  EXPECT_EQ(series.error().code, code) << to_line(series.error());
  EXPECT_EQ(series.error().where, where) << to_line(series.error());
}

const Points kThree{{1.5, 2.5}, {3, -4}, {0.5, 600}};

TEST(ReadPoints, EachSeparatorGivesTheSamePoints) {
  EXPECT_EQ(points_of("1.5 2.5\n3 -4\n0.5 600\n"), kThree);
  EXPECT_EQ(points_of("1.5,2.5\n3,-4\n0.5,600\n"), kThree);
  EXPECT_EQ(points_of("1.5;2.5\n3;-4\n0.5;600\n"), kThree);
  EXPECT_EQ(points_of("1.5\t2.5\n3\t-4\n0.5\t600\n"), kThree);
  EXPECT_EQ(points_of("  1.5 ,\t2.5 \n 3, -4\n0.5  ,600  \n"), kThree);
  EXPECT_EQ(points_of("1.5\t 2.5\t\t\n3\t-4\t\n0.5 600\n"), kThree);
}

TEST(ReadPoints, EachLineEndGivesTheSamePoints) {
  EXPECT_EQ(points_of("1.5 2.5\r\n3 -4\r\n0.5 600\r\n"), kThree);
  EXPECT_EQ(points_of("1.5 2.5\r3 -4\r0.5 600\r"), kThree);
  EXPECT_EQ(points_of("1.5 2.5\n3 -4\r\n0.5 600"), kThree);
  EXPECT_EQ(points_of("1.5 2.5\n3 -4\n0.5 600\n\x1A"), kThree);
}

TEST(ReadPoints, AByteOrderMarkIsNoPartOfTheData) {
  EXPECT_EQ(points_of("\xEF\xBB\xBFx,y\n1.5,2.5\n3,-4\n0.5,600\n"), kThree);
  expect_error(
      "\xEF\xBB\xBF"
      "1,2\n3,x\n",
      ErrorCode::kBadNumber, "f:2:3");
}

TEST(ReadPoints, CommentsMayStandAnywhere) {
  EXPECT_EQ(points_of("# a\n; b\n! c\n// d\n1.5 2.5 # e\n\n3 -4 ! f\n0.5 600 // g\n# end"), kThree);
  EXPECT_EQ(points_of("# x_m,y_m\n1.5,2.5\n3,-4\n0.5,600\n"), kThree);
}

// ---- lists of surveys --------------------------------------------------------------------------

const Points kSurvey{{512344.998, 4213456.001}, {512349.6, 4213457.949}, {512354.214, 4213459.893}};

TEST(ReadPoints, EastingAndNorthingAreXAndYWhereverTheyStand) {
  const std::string rows =
      "101,4213456.001,512344.998,45.0,CL\n102,4213457.949,512349.600,45.1,CL\n"
      "103,4213459.893,512354.214,45.2,CL left\n";
  for (const char* header :
       {"Point,Northing,Easting,Elevation,Description", "P,N,E,Z,D", "NR,NORTH,EAST,H,Code",
        "pt,northing_m,easting_m,elev_m,", "Point Number,Northing [m],Easting [m],Height [m],x",
        "# Point,Northing,Easting,Elevation,Description", "Nr;Hochwert;Rechtswert;Hoehe;Art"}) {
    std::string text = std::string(header) + "\n" + rows;
    if (text.find(';') != text.npos) std::replace(text.begin(), text.end(), ',', ';');
    const auto series = parse_points(text, "f");
    ASSERT_TRUE(series) << header << to_line(series.error());
    EXPECT_EQ(series->points, kSurvey) << header;
    PointListOptions with_heights;
    with_heights.heights = true;
    const auto road = parse_points(text, "f", with_heights);
    ASSERT_TRUE(road && road->fixed.size() == 3) << header;
    EXPECT_EQ(road->fixed[1].height, 45.1) << header;
    EXPECT_TRUE(road->warnings.empty()) << header << ": " << road->warnings.front();
  }
  EXPECT_EQ(points_of("x,easting,northing\n9,1.5,2.5\n9,3,-4\n9,0.5,600\n"), kThree);
  EXPECT_EQ(points_of("Easting Northing\n1.5 2.5\n3 -4\n0.5 600\n"), kThree);
  EXPECT_EQ(points_of("Nr;Rechtswert;Hochwert\nA1;1,5;2,5\nA2;3;-4\nA3;0,5;600\n"), kThree);
}

TEST(ReadPoints, UnitsBesideEastingAndNorthingHold) {
  const auto series = parse_points("northing_usft,easting_usft,elevation_ft\n2,1,3\n5,4,6\n7,9,8\n",
                                   "f", {.heights = true});
  ASSERT_TRUE(series) << to_line(series.error());
  EXPECT_EQ(series->units.text(), "usft");
  EXPECT_EQ(series->points, (Points{{1, 2}, {4, 5}, {9, 7}}));
  // by definition a foot is 0.3048 m, a survey foot 1200/3937 m
  EXPECT_NEAR(series->fixed[0].height.value_or(0.0), 3 * 0.3048 * 3937.0 / 1200.0, 1e-14);
  const auto mixed = parse_points("easting_m,northing_ft\n1,2\n4,5\n9,7\n", "f");
  ASSERT_FALSE(mixed);
  EXPECT_EQ(mixed.error().code, ErrorCode::kUnsupported);
}

TEST(ReadPoints, LongitudeIsXAndDegreesAreTold) {
  const auto series = parse_points("lat,lon\n10,1\n11,4\n12,9\n", "f");
  ASSERT_TRUE(series) << to_line(series.error());
  EXPECT_EQ(series->points, (Points{{1, 10}, {4, 11}, {9, 12}}));
  ASSERT_EQ(series->warnings.size(), 1u);
  EXPECT_NE(series->warnings[0].find("longitude and latitude"), std::string::npos);
}

TEST(ReadPoints, WordsOfSurveysAreNoNamesWhereXAndYOrATitleStand) {
  EXPECT_EQ(points_of("easting,northing,x,y\n9,9,1.5,2.5\n9,9,3,-4\n9,9,0.5,600\n"), kThree);
  const auto title = parse_points("From north to east\n1.5 2.5\n3 -4\n0.5 600\n", "f");
  ASSERT_TRUE(title) << to_line(title.error());
  EXPECT_EQ(title->name, "From north to east");
  EXPECT_EQ(title->points, kThree);
}

TEST(ReadPoints, NumbersOfPointsAreNoCoordinates) {
  const std::string far =
      "101 5501234.1 4213455.9 123.4 TOP\n102 5501236.1 4213456.9 123.6 TOP\n"
      "103 5501238.0 4213458.2 123.9 TOP\n104 5501239.8 4213459.7 124.1 TOP\n";
  const auto refused = parse_points(far, "f");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(refused.error().hint.find("--columns 2,3"), std::string::npos);
  PointListOptions chosen;
  chosen.columns = {2, 1};
  const auto read = parse_points(far, "f", chosen);
  ASSERT_TRUE(read) << to_line(read.error());
  EXPECT_EQ(read->points.front(), (Vec2{4213455.9, 5501234.1}));
  EXPECT_TRUE(read->warnings.empty());

  const auto warned = [](const char* text) {
    const auto series = parse_points(text, "f");
    EXPECT_TRUE(series) << text;
    if (!series) return false;
    for (const std::string& told : series->warnings) {
      if (told.find("looks like point numbers") != told.npos) return true;
    }
    return false;
  };
  EXPECT_TRUE(warned("1 10.5 20.5\n2 11.5 20.9\n3 12.6 21.5\n4 13.4 22.2\n"));
  EXPECT_TRUE(warned("Punkt,A,B\n1,10.5,20.5\n2,11.5,20.9\n3,12.6,21.5\n4,13.4,22.2\n"));
  EXPECT_FALSE(warned("1 10.5 20.5\n2 11.5 20.9\n3 12.6 21.5\n5 13.4 22.2\n"));       // a gap
  EXPECT_FALSE(warned("1.0 10.5 20.5\n2.0 11.5 20.9\n3.0 12.6 21.5\n4.0 13.4 2\n"));  // decimals
  EXPECT_FALSE(warned("1 10.5 0\n2 11.5 0\n3 12.6 0\n4 13.4 0\n"));  // x y at z = 0
  EXPECT_FALSE(warned("1 10.5\n2 11.5\n3 12.6\n4 13.4\n"));
  EXPECT_FALSE(warned("x,y,z\n1,10.5,20.5\n2,11.5,20.9\n3,12.6,21.5\n4,13.4,22.2\n"));
}

TEST(ReadPoints, ExponentsAreReadInEachNotation) {
  const Points expected{{15, 0.025}, {300, -4}, {0.5, 6}};
  EXPECT_EQ(points_of("1.5e1 2.5E-2\n3d2 -4D0\n5.0D-01 +6\n"), expected);
  EXPECT_EQ(points_of("3.2080000e-001 .5\n1. -.25\n+1.5E+0 0\n"),
            (Points{{0.3208, 0.5}, {1, -0.25}, {1.5, 0}}));
}

TEST(ReadPoints, DecimalCommasAreReadWhereTheyCannotSeparate) {
  EXPECT_EQ(points_of("1,5;2,5\n3;-4\n0,5;600\n"), kThree);
  EXPECT_EQ(points_of("1,5\t2,5\n3\t-4\n0,5\t600\n"), kThree);
  EXPECT_EQ(points_of("1,5 2,5\n3 -4\n0,5 6,0e2\n"), kThree);
  EXPECT_EQ(points_of("3 -4\n1,5 2,5\n0,5 6,0D2\n"), (Points{{3, -4}, {1.5, 2.5}, {0.5, 600}}));
  // Between two numbers without blanks the comma separates.
  EXPECT_EQ(points_of("1,5\n2,5\n3,7\n"), (Points{{1, 5}, {2, 5}, {3, 7}}));
  EXPECT_EQ(points_of("1, 5\n2 ,6\n3,7\n"), (Points{{1, 5}, {2, 6}, {3, 7}}));
}

TEST(ReadPoints, OneFileHasOneDecimalSign) {
  expect_error("1,5 2,5\n3.5 4\n1 1\n", ErrorCode::kBadNumber, "f:2:1");
  expect_error("1.5 2.5\n3 4,5\n1 1\n", ErrorCode::kBadNumber, "f:2:3");
  expect_error("1.234,5;2\n1;2\n3;4\n", ErrorCode::kBadNumber, "f:1:1");
}

TEST(ReadPoints, NumbersAreReadToTheNearestDouble) {
  const Points points = points_of("0.1 0.2\n0.30000000000000004 1e23\n4.9e-324 9007199254740993\n");
  EXPECT_EQ(points, (Points{{0.1, 0.2}, {0.1 + 0.2, 1e23}, {5e-324, 9007199254740992.0}}));
}

TEST(ReadPoints, NegativeZeroBecomesZeroSoThatHeadingsDoNotJump) {
  for (const Vec2 p : points_of("-0 -0.0\n-1 -0.0\n-2 1\n")) EXPECT_FALSE(std::signbit(p.y));
}

TEST(ReadPoints, FurtherColumnsAreAllowedAndAChangingThirdIsSaid) {
  EXPECT_EQ(points_of("1.5 2.5 0\n3 -4 0\n0.5 600 0\n"), kThree);
  EXPECT_EQ(points_of("1.5,2.5,a b\n3,-4,c\n0.5,600,d\n"), kThree);
  const auto flat = parse_points("1 2 0\n3 4 0\n5 7 0\n", "curve.sldcrv");
  ASSERT_TRUE(flat.has_value());
  EXPECT_TRUE(flat->warnings.empty());
  const auto space = parse_points("1 2 0\n3 4 1\n5 7 2\n", "curve.sldcrv");
  ASSERT_TRUE(space.has_value());
  ASSERT_EQ(space->warnings.size(), 1U);
  EXPECT_NE(space->warnings[0].find("line 2"), std::string::npos);
}

TEST(ReadPoints, ATitleNamesTheSeries) {
  const auto titled = parse_points("NACA 0012\n1 0\n0 0.1\n-1 0\n", "dir/f.dat");
  ASSERT_TRUE(titled.has_value());
  EXPECT_EQ(titled->name, "NACA 0012");
  const auto plain = parse_points("1 0\n0 0.1\n-1 0\n", "dir/f.dat");
  ASSERT_TRUE(plain.has_value());
  EXPECT_EQ(plain->name, "f.dat");
  const auto latin = parse_points("mod\xE8le\n1 0\n0 0.1\n-1 0\n", "f");
  ASSERT_TRUE(latin.has_value());
  EXPECT_EQ(latin->name, "mod\xC3\xA8le");
}

TEST(ReadPoints, AHeaderSaysWhichColumnsAreXAndY) {
  EXPECT_EQ(points_of("id;y;x\n7;2.5;1.5\n8;-4;3\n9;600;0.5\n"), kThree);
  EXPECT_EQ(points_of("X [mm]\tY [mm]\n1.5\t2.5\n3\t-4\n0.5\t600\n"), kThree);
  EXPECT_EQ(points_of("x [mm] y [mm]\n1.5 2.5\n3 -4\n0.5 600\n"), kThree);
  EXPECT_EQ(points_of("\"x\",\"y\"\n\"1.5\",\"2.5\"\n3,-4\n0.5,600\n"), kThree);
  EXPECT_EQ(points_of("some title\n[Curve Length]  [X-Coordinate]  [Y-Coordinate]\n"
                      "0\t1.5\t2.5\n1\t3\t-4\n2\t0.5\t600\n"),
            kThree);
  const auto other = parse_points("station,half\n1,2\n3,4\n5,7\n", "f");
  ASSERT_TRUE(other.has_value());
  ASSERT_EQ(other->warnings.size(), 1U);
  EXPECT_NE(other->warnings[0].find("station"), std::string::npos);
}

TEST(ReadPoints, NamedColumnsFixDataAtTheirPoints) {
  const auto series = parse_points(
      "x,y,heading_deg,radius,kappa,tol\n0,0,90,,,\n1,1,,4,,0.01\n2,1,,,-0.5\n3,0,,inf,,\n4,0\n",
      "f");
  ASSERT_TRUE(series.has_value()) << to_line(series.error());
  const auto& fixed = series->fixed;
  ASSERT_EQ(fixed.size(), 5U);
  EXPECT_DOUBLE_EQ(fixed[0].theta.value(), std::numbers::pi / 2);
  EXPECT_FALSE(fixed[0].kappa || fixed[0].tolerance);
  EXPECT_EQ(fixed[1].kappa.value(), 0.25);
  EXPECT_EQ(fixed[1].tolerance.value(), 0.01);
  EXPECT_EQ(fixed[2].kappa.value(), -0.5);
  EXPECT_EQ(fixed[3].kappa.value(), 0.0);
  EXPECT_FALSE(fixed[4].theta || fixed[4].kappa || fixed[4].tolerance);
  EXPECT_TRUE(parse_points("x,y\n0,0\n1,1\n2,1\n", "f")->fixed.empty());
}

TEST(ReadPoints, ColumnsThatMeanNothingAreNamedInAWarning) {
  const auto series = parse_points("id,x,y,heading\n1,0,0,90\n2,1,1,\n3,2,1,\n", "f");
  ASSERT_TRUE(series.has_value()) << to_line(series.error());
  ASSERT_EQ(series->warnings.size(), 1U);
  EXPECT_NE(series->warnings[0].find("\"id\", \"heading\" are not used"), std::string::npos)
      << series->warnings[0];
  EXPECT_NE(series->warnings[0].find("heading_deg"), std::string::npos);
  const auto ours = parse_points(
      "s,x,y,heading_deg,curvature_1_per_mm,normal_x,normal_y\n0,0,0,0,0,0,1\n"
      "1,1,0,0,0,0,1\n2,2,0,0,0,0,1\n",
      "f");
  ASSERT_TRUE(ours.has_value()) << to_line(ours.error());
  EXPECT_TRUE(ours->warnings.empty());
}

TEST(ReadPoints, EmptyCellsBetweenTabsAreNotFixed) {
  const auto series =
      parse_points("x\ty\theading_deg\tkappa\n0\t0\t\t2\n1\t1\t45\t\n2\t1\t\t\n", "f");
  ASSERT_TRUE(series.has_value()) << to_line(series.error());
  EXPECT_EQ(series->fixed[0].kappa.value(), 2.0);
  EXPECT_FALSE(series->fixed[0].theta);
  EXPECT_DOUBLE_EQ(series->fixed[1].theta.value(), std::numbers::pi / 4);
}

TEST(ReadPoints, RepeatedPointsWithTwoHeadingsOrRadiiAreRefused) {
  const std::string rows = "x,y,heading_deg,radius\n0,0,,\n1,1,30,7\n";
  expect_error(rows + "1,1,31,7\n2,1,,\n", ErrorCode::kFixedDataContradict, "f:4:1");
  expect_error(rows + "1,1,30,8\n2,1,,\n", ErrorCode::kFixedDataContradict, "f:4:1");
  EXPECT_TRUE(parse_points(rows + "1,1,30,7\n2,1,,\n", "f"));
}

TEST(ReadPoints, ImpossibleFixedDataAreRefused) {
  expect_error("x,y,radius\n0,0,0\n1,1,\n", ErrorCode::kNotFinite, "f:2:5");
  expect_error("x,y,kappa\n0,0,inf\n1,1,\n", ErrorCode::kNotFinite, "f:2:5");
  expect_error("x,y,radius,kappa\n0,0,2,0.5\n1,1,\n", ErrorCode::kBadNumber, "f:2:7");
  expect_error("x,y,tol\n0,0,-1\n1,1,\n", ErrorCode::kBadNumber, "f:2:5");
  expect_error("x,y,heading_deg\n0,0,north\n1,1,\n", ErrorCode::kBadNumber, "f:2:5");
}

TEST(ReadPoints, IntervalsOfMeasuredDataAreTolerances) {
  for (const std::string name : {"tol", "tolerance", "u95", "U95 [mm]", "ci95", "uncertainty",
                                 "uncertainty (95 %)", "unc", "+-", "+/-", "\xC2\xB1"}) {
    const auto series = parse_points("x,y," + name + "\n0,0,0.5\n1,1,\n2,1,0\n", "f");
    ASSERT_TRUE(series.has_value()) << name << to_line(series.error());
    ASSERT_EQ(series->fixed.size(), 3U) << name;
    EXPECT_EQ(series->fixed[0].tolerance.value(), 0.5) << name;
    EXPECT_FALSE(series->fixed[1].tolerance) << name;
    EXPECT_EQ(series->fixed[2].tolerance.value(), 0.0) << name;
  }
  // What is said outright goes before what was measured, wherever it stands.
  EXPECT_EQ(
      parse_points("x,y,u95,tol\n0,0,5,0.1\n1,1,5,\n2,1,5,\n", "f")->fixed[0].tolerance.value(),
      0.1);
}

TEST(ReadPoints, CornersAreMarkedByAColumn) {
  const auto series = parse_points(
      "x;y;Corner\n0;0;1\n1;0;0\n2;0;\n2;1;yes\n2;2;No\n1;2;TRUE\n0;2;false\n0;1\n", "f");
  ASSERT_TRUE(series.has_value()) << to_line(series.error());
  std::vector<bool> corners;
  for (const FixedData& fixed : series->fixed) corners.push_back(fixed.corner);
  EXPECT_EQ(corners, (std::vector<bool>{true, false, false, true, false, true, false, false}));
  expect_error("x,y,corner\n0,0,0\n1,1,2\n2,1,1\n", ErrorCode::kBadNumber, "f:3:5");
  expect_error("x,y,corner\n0,0,maybe\n1,1,\n", ErrorCode::kBadNumber, "f:2:5");
}

TEST(ReadPoints, AHyphenStandsForAnEmptyCellBetweenBlanks) {
  const auto series = parse_points(
      "x y heading_deg radius tol corner\n0 0 - inf - -\n1 1 45 - 0.1 1\n2 1 - - - 0\n", "f");
  ASSERT_TRUE(series.has_value()) << to_line(series.error());
  EXPECT_EQ(series->fixed[0].kappa.value(), 0.0);
  EXPECT_FALSE(series->fixed[0].theta || series->fixed[0].tolerance || series->fixed[0].corner);
  EXPECT_DOUBLE_EQ(series->fixed[1].theta.value(), std::numbers::pi / 4);
  EXPECT_FALSE(series->fixed[1].kappa);
  EXPECT_TRUE(series->fixed[1].corner);
  expect_error("x y tol\n0 - -\n1 1 -\n", ErrorCode::kBadNumber, "f:2:3");
}

TEST(ReadPoints, ACornerAtADuplicateStaysACorner) {
  const auto series = parse_points("x,y,corner\n0,0,\n1,1,\n1,1,1\n2,0,\n", "f");
  ASSERT_TRUE(series.has_value());
  EXPECT_TRUE(series->fixed[1].corner);
}

TEST(ReadPoints, ConsecutiveDuplicatesMergeWithAWarning) {
  const auto series = parse_points("x,y\n0,0\n1,1\n1,1\n1.0,1\n2,0\n0,0\n0,0\n", "f");
  ASSERT_TRUE(series.has_value());
  EXPECT_EQ(series->points, (Points{{0, 0}, {1, 1}, {2, 0}, {0, 0}}));
  ASSERT_EQ(series->warnings.size(), 1U);
  EXPECT_EQ(series->warnings[0].substr(0, 2), "3 ");
  EXPECT_NE(series->warnings[0].find("line 4"), std::string::npos);
}

TEST(ReadPoints, OfTwoTolerancesOfAPointThatRepeatsTheSmallerOneHolds) {
  for (const char* rows : {"1,1,0.5\n1,1,0.2\n", "1,1,0.2\n1,1,0.5\n"}) {
    const auto series = parse_points(std::string("x,y,tol\n0,0,0.1\n") + rows + "2,0,0.3\n", "f");
    ASSERT_TRUE(series) << rows;
    ASSERT_EQ(series->fixed.size(), 3U);
    EXPECT_EQ(series->fixed[1].tolerance, 0.2) << rows;
  }
}

TEST(ReadPoints, DataFixedAtADuplicateStayWithThePoint) {
  const auto series = parse_points("x,y,kappa\n0,0,\n1,1,\n1,1,2\n2,0,\n", "f");
  ASSERT_TRUE(series.has_value());
  ASSERT_EQ(series->fixed.size(), 3U);
  EXPECT_EQ(series->fixed[1].kappa.value(), 2.0);
}

TEST(ReadPoints, BadNumbersAreNamedWithLineAndColumn) {
  expect_error("1 2\n3 4x\n5 6\n", ErrorCode::kBadNumber, "f:2:3");
  expect_error("1,2\n3,\n5,6\n", ErrorCode::kTooFewColumns, "f:2:1");
  expect_error("1,2\n,3\n5,6\n", ErrorCode::kBadNumber, "f:2:1");
  expect_error("# c\r\n\r\n1,2\r\n  abc,4\r\n", ErrorCode::kBadNumber, "f:4:3");
  expect_error("1 2\n3 4\n5 6\nremark\n", ErrorCode::kBadNumber, "f:4:1");
  expect_error("1.0, 2.x0\n3,4\n5,6\n", ErrorCode::kBadNumber, "f:1:6");
  expect_error("title\nanother\n1 2\n3 4\n", ErrorCode::kBadNumber, "f:2:1");
  expect_error("1 0x10\n3 4\n5 6\n", ErrorCode::kBadNumber, "f:1:3");
  expect_error("1,2,3;4,5,6\n1,2,3;4,5,6\n", ErrorCode::kBadNumber, "f:1:1");
  expect_error("x y\n\xC3\xA9\xC3\xA9 1\n", ErrorCode::kBadNumber, "f:2:1");
}

TEST(ReadPoints, NumbersThatAreNotFiniteAreRefused) {
  expect_error("1 2\nnan 4\n5 6\n", ErrorCode::kNotFinite, "f:2:1");
  expect_error("nan,4\n1,2\n5,6\n", ErrorCode::kNotFinite, "f:1:1");
  expect_error("1 2\n3 -Inf\n5 6\n", ErrorCode::kNotFinite, "f:2:3");
  expect_error("1 2\n3 1e999\n5 6\n", ErrorCode::kNotFinite, "f:2:3");
}

TEST(ReadPoints, TooFewPointsOrColumnsAreRefused) {
  expect_error("", ErrorCode::kTooFewPoints, "f");
  expect_error("x,y\n", ErrorCode::kTooFewPoints, "f");
  expect_error("1 2\n3 4\n", ErrorCode::kTooFewPoints, "f");
  expect_error("1 2\n3 4\n1 2\n3 4\n3 4\n", ErrorCode::kTooFewPoints, "f");
  expect_error("1 2\n3 4\n5\n", ErrorCode::kTooFewColumns, "f:3:1");
  expect_error("1\n2\n3\n", ErrorCode::kTooFewColumns, "f:2:1");
  expect_error("1.5\n2.5\n3.5\n", ErrorCode::kTooFewColumns, "f:1:1");
  expect_error("x,y,z\n1\n2\n3\n", ErrorCode::kTooFewColumns, "f:2:1");
}

TEST(ReadPoints, RowsOfDifferentLengthAreNoPointList) {
  expect_error("1 2 3\n4 5 6\n7 8\n", ErrorCode::kTooFewColumns, "f:3:1");
  expect_error("1 2\n4 5\n7 8 9\n", ErrorCode::kBadNumber, "f:3:5");
}

TEST(ReadPoints, BinaryDataAreNotText) {
  expect_error(std::string_view("1 2\n3 4\n5\0 6\n", 13), ErrorCode::kNotText, "f");
  expect_error("\x89PNG\r\n\x1A\n\x01", ErrorCode::kNotText, "f");
  expect_error(std::string_view("\xFF\xFE"
                                "1\0 \0",
                                6),
               ErrorCode::kNotText, "f");
}

TEST(ReadPoints, KnownFormatsThatAreNotReadAreCalledByName) {
  const auto kind = [](std::string_view text) {
    const auto series = parse_points(text, "f");
    return series || series.error().code != ErrorCode::kUnsupported ? std::string()
                                                                    : series.error().what;
  };
  EXPECT_EQ(kind("  0\r\nSECTION\r\n  2\r\nHEADER\r\n"), "DXF is not read yet");
  EXPECT_EQ(kind("999\nby hand\n0\nSECTION\n"), "DXF is not read yet");
  EXPECT_EQ(kind(std::string_view("AutoCAD Binary DXF\r\n\x1A\0", 22)),
            "binary DXF is not read yet");
  EXPECT_EQ(kind("ISO-10303-21;\nHEADER;\n"), "STEP is not read yet");
  EXPECT_EQ(kind(std::string(72, ' ') + "S      1\n"), "IGES is not read yet");
  EXPECT_EQ(kind("{\"type\": \"FeatureCollection\"}"), "GeoJSON is not read yet");
  EXPECT_EQ(kind("[[1, 2], [3, 4]]"), "JSON is not read yet");
  EXPECT_EQ(kind("<?xml version='1.0'?>\n<gpx>"), "GPX is not read yet");
  EXPECT_EQ(kind("<svg/>"), "SVG is not read yet");
  EXPECT_EQ(kind("<?xml?><a/>"), "XML is not read yet");
  EXPECT_EQ(kind("{\n \"format\": \"obvid-contour\"}"),
            "this is a contour file, not a list of points");
}

TEST(ReadPoints, MissingFilesAndFoldersAreNamed) {
  for (const std::string path : {"/no/such/file.csv", "/"}) {
    const auto series = read_points(path);
    ASSERT_FALSE(series.has_value());
    EXPECT_EQ(series.error().code, ErrorCode::kCannotOpen);
    EXPECT_EQ(series.error().where, path);
  }
}

// ---- airfoils ------------------------------------------------------------------------------

const Points kFoil{{1, 0.01}, {0.5, 0.06}, {0.1, 0.05}, {0, 0}, {0.1, -0.03}, {0.5, -0.04}, {1, 0}};
constexpr std::string_view kSides =
    "0 0\n0.1 0.05\n0.5 0.06\n1 0.01\n\n0 0\n0.1 -0.03\n0.5 -0.04\n1 0\n";

TEST(ReadAirfoil, LednicerBecomesOneSeriesFromTheUpperTrailingEdge) {
  EXPECT_EQ(points_of("FOIL\n 4. 4.\n\n" + std::string(kSides)), kFoil);
  EXPECT_EQ(points_of("4 4\n\n" + std::string(kSides)), kFoil);
  EXPECT_EQ(points_of("FOIL\n4. 4.\n0 0\n0.1 0.05\n0.5 0.06\n1 0.01\n0 0\n0.1 -0.03\n"
                      "0.5 -0.04\n1 0\n"),
            kFoil);
}

TEST(ReadAirfoil, ALeadingEdgeThatDiffersOnBothSidesStaysTwoPoints) {
  const Points points =
      points_of("F\n3. 4.\n\n0 .01\n.5 .1\n1 .01\n\n0 -.01\n.2 -.1\n.5 -.1\n1 0\n");
  EXPECT_EQ(points,
            (Points{{1, .01}, {.5, .1}, {0, .01}, {0, -.01}, {.2, -.1}, {.5, -.1}, {1, 0}}));
}

TEST(ReadAirfoil, LednicerCountsMustMatch) {
  expect_error("FOIL\n 5. 4.\n\n" + std::string(kSides), ErrorCode::kBadCount, "f:2:1");
  expect_error("FOIL\n 3. 5.\n\n" + std::string(kSides), ErrorCode::kBadCount, "f:2:1");
}

TEST(ReadAirfoil, APointThatLooksLikeCountsIsAPoint) {
  const Points points = points_of("3 3\n4 5\n6 5\n9 4\n8 3\n7 2\n6 1\n");
  ASSERT_EQ(points.size(), 7U);
  EXPECT_EQ(points[0], (Vec2{3, 3}));
}

TEST(ReadAirfoil, OpenVspFilesAreReadWithAndWithoutSymmetry) {
  const std::string head = "DEMO GEOM AIRFOIL FILE\nFOIL\n";
  const std::string counts = "4\tNum Pnts Upper\n4\tNum Pnts Lower\n";
  EXPECT_EQ(points_of(head + "0\tSym Flag (0 - No, 1 - Yes)\n" + counts + std::string(kSides)),
            kFoil);
  const auto mirrored = parse_points(head +
                                         "1\tSym Flag (0 - No, 1 - Yes)\n3\tNum Pnts Upper\n"
                                         "0 0\n0.5 0.06\n1 0.01\n",
                                     "f");
  ASSERT_TRUE(mirrored.has_value()) << to_line(mirrored.error());
  EXPECT_EQ(mirrored->name, "FOIL");
  EXPECT_EQ(mirrored->points, (Points{{1, 0.01}, {0.5, 0.06}, {0, 0}, {0.5, -0.06}, {1, -0.01}}));
  expect_error(head + "0\tSym Flag (0 - No, 1 - Yes)\n5\tNum Pnts Upper\n4\tNum Pnts Lower\n" +
                   std::string(kSides),
               ErrorCode::kBadCount, "f:4:1");
}

TEST(ReadAirfoil, MsesGridBoundsAreNoPoint) {
  EXPECT_EQ(points_of("FOIL\n -2.0 3.0 -2.5 3.5\n1.5 2.5\n3 -4\n0.5 600\n"), kThree);
  expect_error("FOIL\n -2.0 3.0 2.5 -3.5\n1 2\n3 4\n", ErrorCode::kTooFewColumns, "f:3:1");
}

TEST(ReadAirfoil, OpenFastCoordinatesLoseTheirReferencePoint) {
  const std::string head = "   %d   NumCoords   ! number, with one more\n! ...\n0.25 0 \n! shape\n";
  const auto with = [&](const std::string& count) {
    return count + head.substr(5) + "1.5 2.5\n3 -4\n0.5 600\n";
  };
  EXPECT_EQ(points_of(with("4")), kThree);
  expect_error(with("5"), ErrorCode::kBadCount, "f:1:1");
}

TEST(ReadAirfoil, ACountBeforeThePointsIsChecked) {
  EXPECT_EQ(points_of("3\n1.5 2.5\n3 -4\n0.5 600\n"), kThree);
  expect_error("4\n1.5 2.5\n3 -4\n0.5 600\n", ErrorCode::kBadCount, "f:1:1");
}

std::string selig_loop() {
  std::string text = "FOIL 7%\n";
  for (int i = 0; i <= 24; ++i) {
    const double angle = 2 * std::numbers::pi * i / 24;
    char line[64];
    std::snprintf(line, sizeof line, "%.6f %.6f\n", 0.5 + 0.5 * std::cos(angle),
                  0.1 * std::sin(angle));
    text += line;
  }
  return text;
}

TEST(ReadAirfoil, RemarksBehindAWholeAirfoilArePassedOverWithAWarning) {
  for (const std::string remark :
       {"http://example.org/x.htm\n", "\n26/10/2001 http://example.org\n", "Profil:\t8.07\t%\n\n",
        "\n\"name\" <mail>\n1.35 at 10 degrees\n\n20 nov 2005\n"}) {
    const auto series = parse_points(selig_loop() + remark, "f");
    ASSERT_TRUE(series.has_value()) << remark << to_line(series.error());
    EXPECT_EQ(series->points.size(), 25U);
    ASSERT_EQ(series->warnings.size(), 1U);
    EXPECT_NE(series->warnings[0].find(remark[0] == '\n' ? "line 28" : "line 27"),
              std::string::npos);
  }
}

TEST(ReadAirfoil, DamagedRowsAreNoRemarks) {
  const std::string loop = selig_loop();
  expect_error(loop + "0.99.5 0.001\n", ErrorCode::kBadNumber, "f:27:1");
  expect_error(loop + "remark\n0.5 0.001\n", ErrorCode::kBadNumber, "f:27:1");
  expect_error(loop + "\n1.0 0.x01\n", ErrorCode::kBadNumber, "f:28:5");
  expect_error(loop + "nan 0\n", ErrorCode::kNotFinite, "f:27:1");
}

TEST(ReadAirfoil, ABlankLineInsideThePointsIsSaid) {
  const auto series = parse_points("1 2\n3 4\n\n5 7\n", "f");
  ASSERT_TRUE(series.has_value());
  ASSERT_EQ(series->warnings.size(), 1U);
  EXPECT_NE(series->warnings[0].find("line 4"), std::string::npos);
}

TEST(ReadPoints, ColumnsGiveRangesOfHeadingsAndRadii) {
  const auto series = parse_points(
      "x,y,heading_min,heading_max,radius_min,radius_max,kappa_min,kappa_max\n"
      "0,0,40,45,,,,\n1,1,,,20,40,,\n2,1,,,20,,,\n3,0,,,,-20,,\n4,-2,,,,,-0.5,0.25\n5,-3,,,,,,0\n"
      "6,-3,,,-40,-20,,\n7,-4,,,,,,\n",
      "f");
  ASSERT_TRUE(series) << to_line(series.error());
  const auto& fixed = series->fixed;
  EXPECT_DOUBLE_EQ(fixed[0].thetas->low, 40.0 * std::numbers::pi / 180.0);
  EXPECT_DOUBLE_EQ(fixed[0].thetas->high, 45.0 * std::numbers::pi / 180.0);
  EXPECT_FALSE(fixed[0].kappas);
  EXPECT_DOUBLE_EQ(fixed[1].kappas->low, 0.025);
  EXPECT_DOUBLE_EQ(fixed[1].kappas->high, 0.05);
  EXPECT_EQ(fixed[2].kappas->low, 0.0);
  EXPECT_DOUBLE_EQ(fixed[2].kappas->high, 0.05);
  EXPECT_DOUBLE_EQ(fixed[3].kappas->low, -0.05);
  EXPECT_EQ(fixed[3].kappas->high, 0.0);
  EXPECT_EQ(fixed[4].kappas->low, -0.5);
  EXPECT_EQ(fixed[4].kappas->high, 0.25);
  EXPECT_EQ(fixed[5].kappas->low, -HUGE_VAL);
  EXPECT_DOUBLE_EQ(fixed[6].kappas->low, -0.05);
  EXPECT_DOUBLE_EQ(fixed[6].kappas->high, -0.025);
  EXPECT_FALSE(fixed[7].thetas || fixed[7].kappas);
}

TEST(ReadPoints, RangesThatHoldNothingAreRefused) {
  const auto refused = [](std::string_view columns, std::string_view cells) {
    const std::string text =
        "x,y," + std::string(columns) + "\n0,0," + std::string(cells) + "\n1,0,,\n2,1,,\n";
    expect_error(text, ErrorCode::kBadNumber, "f:2:5");
  };
  refused("heading_min,heading_max", "45,40");
  refused("heading_min,heading_max", "0,181");
  refused("heading_min,heading_max", "40,");
  refused("radius_min,radius_max", "-20,30");
  refused("radius_min,radius_max", "30,20");
  refused("kappa_min,kappa_max", "1,-1");
  refused("radius_min,kappa_min", "20,0.1");
}

TEST(ReadPoints, TwoPointsDoWhenHeadingsComeFromElsewhere) {
  EXPECT_TRUE(parse_points("0 0\n1 1\n", "f", {.two = TwoPoints::kDo}));
  EXPECT_FALSE(parse_points("0 0\n1 1\n", "f"));
  EXPECT_FALSE(parse_points("0 0\n0 0\n", "f", {.two = TwoPoints::kDo}));
  EXPECT_TRUE(parse_points("x,y,heading_min,heading_max\n0,0,0,5\n1,1,60,70\n", "f"));
}

TEST(ReadPoints, ChosenColumnsAreXAndYWhateverTheyAreCalled) {
  PointListOptions options;
  options.columns = {2, 1};
  const auto bare = parse_points("9 1 2\n9 3 5\n9 4 4\n", "f", options);
  ASSERT_TRUE(bare) << to_line(bare.error());
  EXPECT_EQ(bare->points, (std::vector<Vec2>{{2, 1}, {5, 3}, {4, 4}}));
  EXPECT_TRUE(bare->warnings.empty());
  const auto named = parse_points("x_m,y_m,z_cm\n9,1,2\n9,3,5\n9,4,4\n", "f", options);
  ASSERT_FALSE(named);  // metres and centimetres
  EXPECT_EQ(named.error().code, ErrorCode::kUnsupported) << to_line(named.error());
  const auto others = parse_points("length,up,along\n9,1,2\n9,3,5\n9,4,4\n", "f", options);
  ASSERT_TRUE(others) << to_line(others.error());
  EXPECT_EQ(others->points, bare->points);
  EXPECT_TRUE(others->warnings.empty());
}

TEST(ReadPoints, OtherColumnsKeepTheirMeaningBesideChosenOnes) {
  PointListOptions options;
  options.columns = {2, 3};
  const auto read =
      parse_points("x,y,u,v,tol,radius\n0,0,1,2,0.5,\n0,0,3,5,0.5,7\n0,0,4,4,0.5,\n", "f", options);
  ASSERT_TRUE(read) << to_line(read.error());
  EXPECT_EQ(read->points, (std::vector<Vec2>{{1, 2}, {3, 5}, {4, 4}}));
  ASSERT_EQ(read->fixed.size(), 3u);
  EXPECT_EQ(read->fixed[1].tolerance, 0.5);
  EXPECT_EQ(read->fixed[1].kappa, 1.0 / 7.0);
}

TEST(ReadPoints, AChosenColumnThatARowLacksIsToldWithItsPlace) {
  PointListOptions options;
  options.columns = {1, 4};
  const auto read = parse_points("1 2 3\n4 5 6\n7 8 9\n", "f", options);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kTooFewColumns);
  EXPECT_EQ(read.error().where.substr(0, 4), "f:1:");
}

TEST(ReadPoints, SkippedLinesAreNotLookedAtButCounted) {
  PointListOptions options;
  options.skip = 2;
  const auto read = parse_points("12 13\rprose 1 2\r0 0\r1 1\r2 0\r", "f", options);
  ASSERT_TRUE(read) << to_line(read.error());
  EXPECT_EQ(read->points, (std::vector<Vec2>{{0, 0}, {1, 1}, {2, 0}}));
  const auto bad = parse_points("12 13\nprose 1 2\n0 0\n1 nan\n2 0\n", "f", options);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().where, "f:4:3");
  options.skip = 9;
  EXPECT_FALSE(parse_points("0 0\n1 1\n2 0\n", "f", options));
  EXPECT_EQ(behind_lines("a\nb\n", 1), "b\n");
}

TEST(ReadPoints, TellsWherePointsThatRepeatHaveAnotherHeight) {
  PointListOptions options;
  options.heights = true;
  const auto series =
      parse_points("x,y,z\n0,0,1\n1,0,2\n1,0,5.25\n1,0,2\n2,0,3\n2,0,3\n", "road.csv", options);
  ASSERT_TRUE(series) << series.error().what;
  ASSERT_EQ(series->fixed.size(), 3U);
  EXPECT_EQ(series->fixed[1].height, 2.0);
  ASSERT_EQ(series->warnings.size(), 2U);
  EXPECT_NE(series->warnings[1].find("1 point that repeats the point before has another height, up "
                                     "to 3.25 off: that of the point before is kept"),
            std::string::npos)
      << series->warnings[1];
}

}  // namespace
}  // namespace obvid
