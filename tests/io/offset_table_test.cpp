// SPDX-License-Identifier: Apache-2.0
#include "offset_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "obvid/io/read_sections.h"

namespace obvid {
namespace {

bool tells(const std::vector<std::string>& assumed, const std::string& words) {
  return std::any_of(assumed.begin(), assumed.end(),
                     [&](const std::string& one) { return one.find(words) != std::string::npos; });
}

TEST(OffsetTables, StationsOfTheCellsThatAreThere) {
  const auto table = parse_offset_table(
      "# a boat\nwl\\st,0,2.5,5,7\n0,,0,0.25,\n1,0.5,1,1.5,\n2,0.75,1.25,,0.125\n3,2,,1,0.5\n",
      "f");
  ASSERT_TRUE(table) << to_line(table.error());
  ASSERT_EQ(table->sections.size(), 3U);
  const std::vector<std::vector<Vec3>> expected = {{{0, 0.5, 1}, {0, 0.75, 2}, {0, 2, 3}},
                                                   {{2.5, 0, 0}, {2.5, 1, 1}, {2.5, 1.25, 2}},
                                                   {{5, 0.25, 0}, {5, 1.5, 1}, {5, 1, 3}}};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(table->sections[k].points, expected[k]);
  EXPECT_EQ(table->sections[1].name, "station 2.5");
  EXPECT_TRUE(
      tells(table->assumed, "rows are waterlines, columns stations (by the corner 'wl\\st')"));
  EXPECT_TRUE(tells(table->assumed, "5 cells are empty"));
  EXPECT_TRUE(tells(table->assumed, "fewer than three cells, which make no contour: 7"));
}

TEST(OffsetTables, LabelsOfPerpendicularsAndWaterlines) {
  for (const char* text :
       {"station,tan,wl_0.5,WL 1.00,wl2,area\nFP,9,0.1,0.2,1,9\n0.5,9,0.3,0.4,2,9\n"
        "19.5,9,0.5,0.6,3,9\nA.P.,9,0.7,-,4,9\nbeam,1,1,1,1,1\n",
        // turned: stations stand over the columns, waterlines downwards
        "st;FP;0.5;19.5;A.P.\nwl2;1;2;3;4\nwl 1.00;0.2;0.4;0.6;\nwl_0.5;0.1;0.3;0.5;0.7\n"
        "beam;9;9;9;9\n"}) {
    const auto table = parse_offset_table(text, "f");
    ASSERT_TRUE(table) << to_line(table.error());
    ASSERT_EQ(table->sections.size(), 3U);
    EXPECT_EQ(table->sections[0].points,
              (std::vector<Vec3>{{0, 0.1, 0.5}, {0, 0.2, 1}, {0, 1, 2}}));
    EXPECT_EQ(table->sections[2].points,
              (std::vector<Vec3>{{19.5, 0.5, 0.5}, {19.5, 0.6, 1}, {19.5, 3, 2}}));
    EXPECT_EQ(table->sections[0].name, "station FP");
    EXPECT_TRUE(tells(table->assumed, "A.P. is taken as station 20"));
    EXPECT_TRUE(tells(table->assumed, "FP is taken as station 0"));
    EXPECT_TRUE(tells(table->assumed, "make no contour: A.P."));
    EXPECT_TRUE(tells(table->assumed, "rows that are no station and no waterline: beam"));
    if (text[2] == ';') continue;
    EXPECT_TRUE(tells(table->assumed, "columns that are no station and no waterline: tan, area"));
  }
}

TEST(OffsetTables, CountedFromAftAndDownwards) {
  const auto table = parse_offset_table(
      "half-breadth\tAP\t1\t9\tFP\n2\t1\t2\t3\t4\n1\t5\t6\t7\t8\n0\t0\t0\t0\t0\n", "f");
  ASSERT_TRUE(table) << to_line(table.error());
  ASSERT_EQ(table->sections.size(), 4U);
  EXPECT_EQ(table->sections[0].points, (std::vector<Vec3>{{0, 0, 0}, {0, 5, 1}, {0, 1, 2}}));
  EXPECT_EQ(table->sections[3].points, (std::vector<Vec3>{{10, 0, 0}, {10, 8, 1}, {10, 4, 2}}));
  EXPECT_TRUE(tells(table->assumed, "rows are waterlines, columns stations (by the label 'AP')"));
}

TEST(OffsetTables, FaultsHaveTheirCell) {
  const auto refused = [](const char* text) {
    const auto table = parse_offset_table(text, "f");
    return table ? Error{} : table.error();
  };
  EXPECT_EQ(refused("wl,0,1\n0,1,x\n1,1,1\n").where, "f:2:5");
  EXPECT_EQ(refused("wl,0,1\n0,1,x\n1,1,1\n").code, ErrorCode::kBadNumber);
  EXPECT_EQ(refused("wl,0,1\n0,1,inf\n1,1,1\n").code, ErrorCode::kNotFinite);
  EXPECT_EQ(refused("wl,0,1\n0,1,1,1\n1,1,1\n").code, ErrorCode::kBadCount);
  EXPECT_EQ(refused("wl,0,1,1\n0,1,1,1\n1,1,1,1\n").code, ErrorCode::kOutOfOrder);
  EXPECT_EQ(refused("wl,0,1\n0,1,1\n0,1,1\n").code, ErrorCode::kOutOfOrder);
  EXPECT_EQ(refused("wl,0,FP,1\n0,1,1,1\n1,1,1,1\n").code, ErrorCode::kOutOfOrder);
  EXPECT_EQ(refused("wl,0,1\n0,1,\n1,1,\n").code, ErrorCode::kTooFewPoints);
}

TEST(OffsetTables, WhatIsNone) {
  EXPECT_TRUE(is_offset_text("wl\\st,0,1\n0,1,2\n"));
  EXPECT_TRUE(is_offset_text("a,1,2\n0,1,2\n"));
  EXPECT_FALSE(is_offset_text("NACA 65 210\n1 0\n0.5 0.1\n"));
  EXPECT_FALSE(is_offset_text("section,x,y,z\n1,0,0,0\n"));
  EXPECT_FALSE(is_offset_text("0 0 1\n1 2 1\n"));
  EXPECT_FALSE(is_offset_text(""));
}

}  // namespace
}  // namespace obvid
