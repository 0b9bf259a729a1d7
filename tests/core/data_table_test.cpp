// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/data_table.h"

#include <gtest/gtest.h>

#include <limits>

namespace obvid {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(DataTable, CellsOfCsvAreQuotedAsRfc4180Says) {
  EXPECT_EQ(csv_cell("plain; text"), "plain; text");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("1/2\" hole"), "\"1/2\"\" hole\"");
  EXPECT_EQ(csv_cell("two\nlines"), "\"two\nlines\"");
}

TEST(DataTable, RowsAreLinesWithAllDigitsAndEmptyCellsWhereNothingIsKnown) {
  const DataTable table{heads_of("name,x,count,note"),
                        {{"a,b", 1.0 / 3.0, 2, {}},
                         {"c", std::numeric_limits<double>::quiet_NaN()},
                         {"d", finite_cell(kInfinite), std::size_t{7}, -kInfinite}}};
  EXPECT_EQ(csv_text(table), "name,x,count,note\n\"a,b\",0.3333333333333333,2,\nc,,,\nd,,7,-inf\n");
}

TEST(DataTable, TextsKeepTheirDigitsWhereFiguresAreShortened) {
  EXPECT_EQ(DataCell("9.1000000000").text(3), "9.1000000000");
  EXPECT_EQ(DataCell(9.12345).text(3), "9.12");
  EXPECT_EQ(DataCell().text(3), "");
}

}  // namespace
}  // namespace obvid
