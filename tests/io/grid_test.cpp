// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "../common/output_folder.h"
#include "../common/shared_data.h"
#include "obvid/io/internal/read_grid.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

void expect_two_by_three(const Result<PointGrid>& grid) {
  ASSERT_TRUE(grid) << to_line(grid.error());
  ASSERT_EQ(grid->count_u, 3u);
  ASSERT_EQ(grid->count_v, 2u);
  EXPECT_EQ(grid->at(0, 0), (Vec3{0, 0, 5}));
  EXPECT_EQ(grid->at(2, 0), (Vec3{2, 0, 7}));
  EXPECT_EQ(grid->at(1, 1), (Vec3{1, 4, 9}));
}

TEST(ReadGrid, EveryFormOfAListGivesTheSameGrid) {
  expect_two_by_three(parse_grid("0 0 5\n1 0 6\n2 0 7\n\n0 4 8\n1 4 9\n2 4 10\n", "blank lines"));
  expect_two_by_three(parse_grid("3 2\n0 0 5\n1 0 6\n2 0 7\n0 4 8\n1 4 9\n2 4 10\n", "counts"));
  expect_two_by_three(parse_grid("0,0,5\n1,0,6\n2,0,7\n0,4,8\n1,4,9\n2,4,10\n", "scan lines"));
  expect_two_by_three(parse_grid(
      "z;col;row;x;y\n10;2;1;2;4\n8;0;1;0;4\n9;1;1;1;4\n5;0;0;0;0\n6;1;0;1;0\n7;2;0;2;0\n",
      "places in any order"));
}

TEST(ReadGrid, AMatrixOfHeightsStandsOnItsSpacing) {
  const auto grid = parse_grid("a,b,c,d,e\n1,2,3,4,0\n5,6,7,8,0\n", "heights", {2.5});
  ASSERT_TRUE(grid) << to_line(grid.error());
  EXPECT_EQ(grid->count_u, 5u);
  EXPECT_EQ(grid->count_v, 2u);
  EXPECT_EQ(grid->at(3, 1), (Vec3{7.5, 2.5, 8}));
  // four columns are more likely a number and x y z, which is no grid of heights
  EXPECT_FALSE(parse_grid("7,1,2,3\n8,5,6,7\n9,1,6,3\n", "points"));
}

TEST(ReadGrid, HalfBreadthsStandOverStationsAndWaterlines) {
  const auto grid = parse_grid("wl,0,10,25\n0,0.1,0.2,0.3\n4,0.4,0.5,0.6\n", "table");
  ASSERT_TRUE(grid) << to_line(grid.error());
  EXPECT_EQ(grid->at(2, 1), (Vec3{25, 0.6, 4}));
  EXPECT_EQ(grid->at(1, 0), (Vec3{10, 0.2, 0}));
}

void expect_grid_refused(std::string_view text, ErrorCode code, std::string_view place) {
  const auto grid = parse_grid(text, "f");
  ASSERT_FALSE(grid) << text;
  EXPECT_EQ(grid.error().code, code) << to_line(grid.error());
  EXPECT_EQ(grid.error().where, place) << to_line(grid.error());
  EXPECT_FALSE(grid.error().what.empty());
}

TEST(ReadGrid, FaultsAreNamedWithTheirPlace) {
  expect_grid_refused("", ErrorCode::kNothingThere, "f");
  expect_grid_refused("wl,0,10,25\n0,0.1,,0.3\n", ErrorCode::kBadNumber, "f:2:7");
  expect_grid_refused("wl,0,10,25\n0,0.1,0.2,0.3\n4,,,\n", ErrorCode::kBadNumber, "f:3:3");
  expect_grid_refused("wl,0,10,5\n0,0.1,0.2,0.3\n4,1,1,1\n", ErrorCode::kBadNumber, "f");
  expect_grid_refused("0 0 5\n1 0 x6\n2 0 7\n", ErrorCode::kBadNumber, "f:2:5");
  expect_grid_refused("0 0 nan\n1 0 6\n", ErrorCode::kNotFinite, "f:1");
  expect_grid_refused("0 0 5\n1 0 6\n\n0 4 8\n", ErrorCode::kBadCount, "f");
  expect_grid_refused("0 0 5\n1 0 6\n\n0 4\n", ErrorCode::kTooFewColumns, "f:4");
  expect_grid_refused("row,col,x,y,z\n0,0,1,1,1\n0,1,1,1,1\n1,0,1,1,1\n1,2,1,1,1\n",
                      ErrorCode::kBadCount, "f");
  expect_grid_refused("row,col,x,y,z\n0,0,1,1,1\n0,0,1,1,1\n", ErrorCode::kBadCount, "f:3");
  expect_grid_refused("row,col,x,y\n0,0,1,1\n", ErrorCode::kTooFewColumns, "f");
}

TEST(ReadGrid, CountsMustBeWholeAndTrue) {
  // products that are right by accident
  for (const char* counts : {"0.5 8", "-2 -2", "2 3", "1e300 1e300"}) {
    expect_grid_refused(fmt::format("{}\n0 0 5\n1 0 6\n0 4 8\n1 4 9\n", counts),
                        ErrorCode::kBadCount, "f:1");
  }
}

TEST(ReadGrid, RowsThatCannotBeToldAreRefused) {
  expect_grid_refused("0 1 5\n1 2 6\n2 3 7\n3 4 8\n", ErrorCode::kBadCount, "f");
}

TEST(ReadGrid, FilesOfAHullTouchTheirMatrices) {
  SKIP_WITHOUT("hulls_grids");
  const std::string x = (shared_data() / "hulls_grids" / "Series60Offset_x.dat").string();
  const auto grid = read_grid({x});
  ASSERT_TRUE(grid) << to_line(grid.error());
  EXPECT_EQ(grid->count_u, 21u);
  EXPECT_EQ(grid->count_v, 21u);
  EXPECT_EQ(grid->name, "Series60Offset");
  EXPECT_EQ(grid->at(0, 0).x, -15.904);
  EXPECT_EQ(grid->at(1, 0).x, -15.796971);
}

/// Three matrices of coordinates, with one, two and three decimals.
class ReadGridFiles : public OutputFolder {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    const fs::path file = folder_ / name;
    std::ofstream(file) << text;
    return file.string();
  }
  std::string write_three(const std::string& before, const std::string& after) const {
    write(before + "y" + after, "0.00 0.00 0.25\n1.00 1.00 1.25\n");
    write(before + "z" + after, "5.000 6.125 7.000\n8.000 9.000 9.500\n");
    return write(before + "x" + after, "0.5 1.0 2.0\n0.5 1.0 2.0\n");
  }
};

TEST_F(ReadGridFiles, MatricesAreToldByOneLetterOfTheirNames) {
  for (const auto& [before, after, together] : {std::array<std::string, 3>{"hull_", ".dat", "hull"},
                                                {"ship_", "_in.dat", "ship_in"},
                                                {"BOAT-", "-out.txt", "BOAT-out"}}) {
    const auto grid = read_grid({write_three(before, after)});
    ASSERT_TRUE(grid) << to_line(grid.error());
    EXPECT_EQ(grid->name, together);
    EXPECT_EQ(grid->count_u, 3u);
    EXPECT_EQ(grid->count_v, 2u);
    EXPECT_EQ(grid->at(1, 0), (Vec3{1.0, 0.0, 6.125}));
    EXPECT_EQ(grid->at(2, 1), (Vec3{2.0, 1.25, 9.5}));
    EXPECT_DOUBLE_EQ(grid->rounding.x, 0.05);
    EXPECT_DOUBLE_EQ(grid->rounding.y, 0.005);
    EXPECT_DOUBLE_EQ(grid->rounding.z, 0.0005);
  }
}

TEST_F(ReadGridFiles, OneMatrixOfCoordinatesIsNotTakenForHeights) {
  const std::string rows = "0 1 2 3 4\n0 1 2 3 4\n";
  for (const char* name : {"hull_x_in.dat", "hull_y_in.dat"}) {
    const auto grid = read_grid({write(name, rows)});
    ASSERT_FALSE(grid) << name;
    EXPECT_EQ(grid.error().code, ErrorCode::kBadCount);
    fs::remove(folder_ / name);
  }
  EXPECT_TRUE(read_grid({write("depth_z_in.dat", rows)}));  // heights may well be called z
  EXPECT_TRUE(read_grid({write("relax.dat", rows)}));       // no letter that stands by itself
}

TEST(ReadGrid, FilesOfDifferentHullsAreNotMixed) {
  const auto grid = read_grid({"a_x.dat", "b_y.dat", "a_z.dat"});
  ASSERT_FALSE(grid);
  EXPECT_EQ(grid.error().code, ErrorCode::kUsage);
}

TEST(ReadGrid, TheVolcanoHasItsRowsAndColumns) {
  SKIP_WITHOUT("hulls_grids");
  const auto grid = read_grid({(shared_data() / "surfaces" / "volcano.csv").string()}, {10.0});
  ASSERT_TRUE(grid) << to_line(grid.error());
  EXPECT_EQ(grid->count_u, 61u);
  EXPECT_EQ(grid->count_v, 87u);
  EXPECT_EQ(grid->at(2, 1), (Vec3{20, 10, 102}));
}

TEST(ReadGrid, OffsetTablesWithGapsOrNamedStationsAreErrors) {
  SKIP_WITHOUT("hulls_grids");
  for (const char* name : {"PX121_offsets.csv", "series60_4214W-B4_table7.csv"}) {
    const auto grid = read_grid({(shared_data() / "hulls_offset_tables" / name).string()});
    ASSERT_FALSE(grid) << name;
    EXPECT_FALSE(grid.error().where.empty());
  }
}

TEST(ReadGrid, AQuarterOfAMillionPointsAreRead) {
  std::string text;
  constexpr int kSide = 500;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) text += fmt::format("{} {} {}\n", i, j, i * j);
  }
  const auto grid = parse_grid(text, "large");
  ASSERT_TRUE(grid) << to_line(grid.error());
  EXPECT_EQ(grid->count_v, 500u);
  EXPECT_EQ(grid->points.back(), (Vec3{499, 499, 499.0 * 499.0}));
}

}  // namespace
}  // namespace obvid
