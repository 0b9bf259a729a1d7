// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>

#include "../common/shared_data.h"
#include "obvid/io/read_sections.h"
#include "read_blade_table.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

TEST(ReadSections, BlankLinesAndAColumnPartSections) {
  for (const char* text :
       {"0 0 1\n1 2 1\n2 0 1\n\n0 0 3\n1 4 3\n2 0 3\n",
        "section,x,y,z\n7,0,0,1\n7,1,2,1\n7,2,0,1\n9,0,0,3\n9,1,4,3\n9,2,0,3\n"}) {
    const auto parsed = parse_sections(text, "f");
    ASSERT_TRUE(parsed) << to_line(parsed.error());
    ASSERT_EQ(parsed->sections.size(), 2u);
    EXPECT_FALSE(parsed->flat);
    EXPECT_EQ(parsed->sections[0].points[1], (Vec3{1, 2, 1}));
    EXPECT_EQ(parsed->sections[1].points[1], (Vec3{1, 4, 3}));
  }
}

TEST(ReadSections, SectionsWithoutHeightStandAtTheirSpacing) {
  const auto parsed = parse_sections("0 0\n1 2\n2 0\n\n0 0\n1 4\n2 0\n", "f", {2.5});
  ASSERT_TRUE(parsed) << to_line(parsed.error());
  ASSERT_EQ(parsed->sections.size(), 2u);
  EXPECT_TRUE(parsed->flat);
  EXPECT_EQ(parsed->sections[0].points[1], (Vec3{1, 2, 0}));
  EXPECT_EQ(parsed->sections[1].points[1], (Vec3{1, 4, 2.5}));
}

TEST(ReadSections, FaultsAreNamedWithTheirLine) {
  const auto broken = parse_sections("0 0 1\n1 2 1\n\n0 0 3\n1 x 3\n", "f");
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().where, "f:5:3");
  const auto narrow = parse_sections("0 0 1\n1 2 1\n\n0 0 3\n1 3\n", "f");
  ASSERT_FALSE(narrow);
  EXPECT_EQ(narrow.error().code, ErrorCode::kTooFewColumns);
  EXPECT_EQ(narrow.error().where, "f:5");
}

TEST(ReadSections, RotorBladesComeFromCylindersAroundTheirAxis) {
  constexpr std::string_view kText =
      " SURFACE NUMBER 1 FROM THE HUB\n J Z R THETA 1 THETA 2\n"
      " 1 0.0 2.0 0.0 0.0\n 2 1.0 2.0 0.5 -0.5\n 3 2.0 2.0 0.25 -0.25\n";
  const auto parsed = parse_sections(kText, "f");
  ASSERT_TRUE(parsed) << to_line(parsed.error());
  ASSERT_EQ(parsed->sections.size(), 1u);
  const auto& p = parsed->sections[0].points;
  ASSERT_EQ(p.size(), 5u);  // the edge that the sides share once
  EXPECT_EQ(p[2], (Vec3{0, 0, 2}));
  EXPECT_NEAR(p[1].y, 2.0 * std::sin(0.5), 1e-15);
  EXPECT_NEAR(p[3].y, -2.0 * std::sin(0.5), 1e-15);
  EXPECT_NEAR(p[4].z, 2.0 * std::cos(0.25), 1e-15);
}

// The layout in which NASA published rotor 67: prose, counts, and blocks of places for each
// surface.
constexpr std::string_view kOnStreamsurfaces = R"(
 A rotor, told from hub to casing in 2 streamsurfaces.  Clearance is 0.024.
 THE DIMENSIONS ARE IN FEET.
        JM      NS      NB      JLE     JTE
        110     14      22      16      85
 re-run with 6 digits
   JM   NS   NB  JLE  JTE
    5    2   22    2    4
 Surface number  1 from hub (surface 1 is the hub)
 Axial Distance
  1.000000
 -1.000000  0.000000
  0.100000  0.200000  1.000000
 Radius*Theta Distance
  1.000000
  0.000000  0.100000  0.250000  0.300000  0.300000
 Delta (Radius*Theta) = Tangential thickness
  1.000000
  0.000000  0.000000  0.050000  0.000000  0.000000
 Radius
  1.000000
  0.500000  0.500000  0.500000  0.600000  0.600000
 Surface number  2 from hub
 Axial Distance
  2.000000
 -0.500000  0.000000  0.050000  0.100000  0.500000
 Radius*Theta Distance
  1.000000
  0.000000  0.100000  0.250000  0.300000  0.300000
 Delta (Radius*Theta) = Tangential thickness
  1.000000
  0.000000  0.000000  0.050000  0.000000  0.000000
 Radius
  1.000000
  1.000000  1.000000  1.000000  1.000000  1.000000
)";

TEST(ReadSections, BladesOnStreamsurfacesAreTheSideThatIsToldAndTheThicknessBeside) {
  const auto parsed = parse_sections(kOnStreamsurfaces, "f");
  ASSERT_TRUE(parsed) << to_line(parsed.error());
  ASSERT_EQ(parsed->sections.size(), 2u);
  EXPECT_FALSE(parsed->flat);
  for (const SpaceSeries& section : parsed->sections) {
    EXPECT_EQ(section.units, Units("ft"));
    // places 4, 3, 2 of the side that is told, 3 and 4 of the other: the edge at 2 once
    ASSERT_EQ(section.points.size(), 5u);
    EXPECT_GE(section.rounding.y, 3 * 5e-7);
  }
  const auto& hub = parsed->sections[0].points;
  const std::array<std::array<double, 3>, 5> axial_arc_radius = {
      {{0.2, 0.3, 0.6}, {0.1, 0.25, 0.5}, {0.0, 0.1, 0.5}, {0.1, 0.2, 0.5}, {0.2, 0.3, 0.6}}};
  for (std::size_t i = 0; i < hub.size(); ++i) {
    const auto [x, arc, r] = axial_arc_radius[i];
    EXPECT_EQ(hub[i].x, x);
    EXPECT_NEAR(std::hypot(hub[i].y, hub[i].z), r, 1e-15);
    EXPECT_NEAR(r * std::atan2(hub[i].y, hub[i].z), arc, 1e-15);
  }
  EXPECT_EQ(parsed->sections[1].points[1].x, 2.0 * 0.05);  // the scale of the block
  EXPECT_DOUBLE_EQ(parsed->sections[0].rounding.x, 5e-7);
  EXPECT_DOUBLE_EQ(parsed->sections[1].rounding.x, 2.0 * 5e-7);  // and that of its rounding
}

TEST(ReadSections, BladesOnStreamsurfacesThatEndEarlyAreRefusedWithTheirLine) {
  std::string cut(kOnStreamsurfaces.substr(0, kOnStreamsurfaces.find(" Surface number  2")));
  const auto ends = parse_sections(cut, "f");
  ASSERT_FALSE(ends);
  EXPECT_EQ(ends.error().code, ErrorCode::kBadCount);
  std::string swapped(kOnStreamsurfaces);
  swapped.replace(swapped.find(" Radius\n"), 8, " Width\n ");
  const auto unknown = parse_sections(swapped, "f");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().where.substr(0, 2), "f:");
}

TEST(ReadSections, ReadingOfStreamsurfacesAsksWhetherToGoOnAndEndsWhereItIsToldTo) {
  constexpr int kPlaces = 5000, kSurfaces = 3;
  std::string text = "JM NS NB JLE JTE\n" + std::to_string(kPlaces) + " " +
                     std::to_string(kSurfaces) + " 22 1 " + std::to_string(kPlaces) + "\n";
  for (int surface = 0; surface < kSurfaces; ++surface) {
    for (const char* title : {"Axial Distance", "Theta", "Thickness", "Radius"}) {
      text += std::string(title) + "\n1.0\n";
      for (int i = 0; i < kPlaces; ++i) text += std::to_string(i + 1) + ".0\n";
    }
  }
  int asked = 0, last = 1 << 30;
  const RunContext run{Progress{}, [&] { return ++asked >= last; }};
  ASSERT_TRUE(parse_sections(text, "f", {}, run));
  const int in_all = asked;
  EXPECT_GE(in_all, 2 * kSurfaces * 4);  // while the counts are looked for, and in each block
  for (const int stop : {1, in_all / 2, in_all}) {
    asked = 0;
    last = stop;
    const auto cancelled = parse_sections(text, "f", {}, run);
    ASSERT_FALSE(cancelled) << stop;
    EXPECT_EQ(cancelled.error().code, ErrorCode::kCancelled) << stop;
    EXPECT_EQ(asked, stop);
  }
}

TEST(ReadSections, RotorThirtySevenHasThirteenSectionsAtTheirRadii) {
  SKIP_WITHOUT("turbomachinery_nasa");
  const auto sections =
      read_sections({(shared_data() / "turbomachinery_nasa" / "rotor37geometry.dat").string()});
  ASSERT_TRUE(sections) << to_line(sections.error());
  ASSERT_EQ(sections->size(), 13u);
  for (const SpaceSeries& section : *sections) {
    EXPECT_GE(section.points.size(), 198u);
    EXPECT_LE(section.points.size(), 200u);
  }
  const Vec3 edge = sections->front().points[99];  // J = 1 of the first surface
  EXPECT_EQ(edge.x, 0.0281091);
  EXPECT_NEAR(std::hypot(edge.y, edge.z), 17.7903728, 1e-12);
  EXPECT_NEAR(std::atan2(edge.y, edge.z), -0.1165276, 1e-12);
}

TEST(ReadSections, TheBladeHasFiftySectionsOfItsChordsAndTwists) {
  SKIP_WITHOUT("turbomachinery_nasa");
  const fs::path folder = shared_data() / "windturbine_iea15";
  std::vector<std::string> paths = {(folder / "IEA-15-240-RWT_AeroDyn15_blade.dat").string()};
  for (int i = 0; i < 50; ++i) {
    paths.push_back((folder / ("IEA-15-240-RWT_AF" + std::string(i < 10 ? "0" : "") +
                               std::to_string(i) + "_Coords.txt"))
                        .string());
  }
  const auto sections = read_sections(paths);
  ASSERT_TRUE(sections) << to_line(sections.error());
  ASSERT_EQ(sections->size(), 50u);
  for (const SpaceSeries& section : *sections) EXPECT_EQ(section.points.size(), 200u);
  // the root is a circle with the chord of the table as its diameter
  const auto& root = sections->front().points;
  double widest = 0.0;
  for (const Vec3& p : root) widest = std::max(widest, norm(p - root.front()));
  EXPECT_NEAR(widest, 5.2, 0.01);
  EXPECT_EQ(root.front().z, 0.0);
  EXPECT_EQ((*sections)[1].points.front().z, 2.387753704536792);

  const auto fewer = read_sections({paths[0], paths[1], paths[2]});
  ASSERT_FALSE(fewer);
  EXPECT_EQ(fewer.error().code, ErrorCode::kBadCount);
}

TEST(ReadSections, MatricesOfAHullAreTheirRows) {
  SKIP_WITHOUT("turbomachinery_nasa");
  const auto sections =
      read_sections({(shared_data() / "hulls_grids" / "TrawlerOffset_x.dat").string()});
  ASSERT_TRUE(sections) << to_line(sections.error());
  EXPECT_EQ(sections->size(), 21u);
  EXPECT_EQ(sections->front().points.size(), 21u);
}

TEST(ReadSections, NothingIsTakenForAThirdCoordinateSilently) {
  const auto height = parse_sections("y,x,h\n0,0,5\n1,1,5\n2,0,5\n", "s");
  ASSERT_FALSE(height);
  EXPECT_EQ(height.error().code, ErrorCode::kTooFewColumns);
  const auto named = parse_sections("y,x,z\n0,9,5\n1,8,5\n2,9,5\n", "s");
  ASSERT_TRUE(named) << to_line(named.error());
  EXPECT_EQ(named->sections[0].points[1], (Vec3{8, 1, 5}));
}

void expect_half_units(Vec3 rounding, Vec3 expected) {
  EXPECT_DOUBLE_EQ(rounding.x, expected.x);
  EXPECT_DOUBLE_EQ(rounding.y, expected.y);
  EXPECT_DOUBLE_EQ(rounding.z, expected.z);
}

TEST(ReadSections, KnowHalfAUnitOfTheirLastDigits) {
  const auto spatial = parse_sections("0.25 0.125 1.5\n1.75 2.625 1.5\n2.25 0.5 1.5\n", "s");
  ASSERT_TRUE(spatial) << to_line(spatial.error());
  expect_half_units(spatial->sections[0].rounding, {0.005, 0.0005, 0.05});
  const auto parted =
      parse_sections("section,x,y,z\n7,0.25,0.125,1.5\n7,1.75,2.625,1.5\n9,2.25,0.5,3.5\n", "s");
  ASSERT_TRUE(parted) << to_line(parted.error());
  for (const SpaceSeries& section : parted->sections) {
    expect_half_units(section.rounding, {0.005, 0.0005, 0.05});
  }
  // where sections stand without z is chosen, not printed
  const auto flat = parse_sections("0.25 0.125\n1.75 2.625\n2.25 0.5\n", "s");
  ASSERT_TRUE(flat) << to_line(flat.error());
  expect_half_units(flat->sections[0].rounding, {0.005, 0.0005, 0.0});
}

TEST(ReadSections, AirfoilsOfBladesKeepTheirDigitsWithTheirChordsAndTwists) {
  const auto airfoil = parse_airfoil_of_blade(
      "5 NumCoords\n0.25 0.000\n1.00 0.000\n0.50 0.125\n0.00 0.000\n0.50 0.075\n", "a");
  ASSERT_TRUE(airfoil) << to_line(airfoil.error());
  EXPECT_DOUBLE_EQ(airfoil->rounding.x, 0.005);
  EXPECT_DOUBLE_EQ(airfoil->rounding.y, 0.0005);
  BladeStation station;
  station.chord = 4.0;
  expect_half_units(placed(*airfoil, station, "straight").rounding, {0.002, 0.02, 0.0});
  station.twist = std::numbers::pi / 6.0;  // sine 1/2
  const double c = std::sqrt(0.75);
  const Vec3 turned = placed(*airfoil, station, "turned").rounding;
  EXPECT_NEAR(turned.x, 0.002 * c + 0.01, 1e-15);
  EXPECT_NEAR(turned.y, 0.001 + 0.02 * c, 1e-15);
}

}  // namespace
}  // namespace obvid
