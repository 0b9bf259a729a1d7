// SPDX-License-Identifier: Apache-2.0
// Splines of two variables from tables: given integrals are kept, those that are not are taken
// from values.
#include "obvid/pipeline/spline_grid.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace obvid {
namespace {

/// exp(x) sin(y) over [0, 1] x [0, 2], with integrals in closed form, rows in reverse order.
std::string grid_rows(int nx, int ny, bool cells, bool lines) {
  std::string out = "x,y,f";
  if (cells) out += ",integral";
  if (lines) out += ",integral_x,integral_y";
  out += "\n";
  for (int j = ny; j >= 0; --j) {
    for (int i = nx; i >= 0; --i) {
      const double x = 1.0 * i / nx, y = 2.0 * j / ny, u = 1.0 * (i + 1) / nx,
                   v = 2.0 * (j + 1) / ny;
      const double ex = std::exp(u) - std::exp(x), sy = std::cos(y) - std::cos(v);
      out += fmt::format("{},{},{}", x, y, std::exp(x) * std::sin(y));
      if (cells) out += fmt::format(",{}", ex * sy);
      if (lines) out += fmt::format(",{},{}", ex * std::sin(y), std::exp(x) * sy);
      out += "\n";
    }
  }
  return out;
}

GridSplineInput grid_of(const std::string& text) {
  const auto table = parse_columns(text, "g");
  EXPECT_TRUE(table) << (table ? "" : to_line(table.error()));
  EXPECT_TRUE(is_grid_table(*table));
  auto out = grid_spline_input(*table, "g");
  EXPECT_TRUE(out) << (out ? "" : to_line(out.error()));
  return std::move(*out);
}

double error_of(const GridSplineReport& made) {
  double largest = 0.0;
  for (int j = 0; j <= 57; ++j) {
    for (int i = 0; i <= 57; ++i) {
      const double x = i / 57.0, y = 2.0 * j / 57.0;
      largest = std::max(largest,
                         std::abs(evaluate(made.spline, x, y).value - std::exp(x) * std::sin(y)));
    }
  }
  return largest;
}

TEST(SplineGridTest, GivenIntegralsAreKept) {
  const double exact = (std::exp(1.0) - 1.0) * (1.0 - std::cos(2.0));
  for (const bool lines : {false, true}) {
    for (const bool smooth : {false, true}) {
      const auto made =
          grid_spline_report(grid_of(grid_rows(3, 4, true, lines)), smooth, std::nullopt);
      ASSERT_TRUE(made) << to_line(made.error());
      for (const GridSplineRow& row : made->rows) {
        EXPECT_LT(row.integral_error, 1e-14) << row.name;
        EXPECT_NEAR(row.integral, exact, 1e-14) << row.name;
      }
      EXPECT_EQ(made->rows[smooth ? 1 : 0].largest_move, 0.0);
      EXPECT_GT(made->rows[smooth ? 0 : 1].largest_move, 0.0);
    }
  }
}

/// With and without integrals the order is three: halved steps leave an eighth of the error.
TEST(SplineGridTest, TheOrderIsThree) {
  for (const bool cells : {false, true}) {
    for (const bool lines : {false, true}) {
      const auto rough =
          grid_spline_report(grid_of(grid_rows(4, 8, cells, lines)), false, std::nullopt);
      const auto fine =
          grid_spline_report(grid_of(grid_rows(8, 16, cells, lines)), false, std::nullopt);
      ASSERT_TRUE(rough && fine);
      EXPECT_GT(error_of(*rough) / error_of(*fine), 6.0) << cells << lines;
      // third derivatives are at most e: e h^3 is a generous scale of the error
      EXPECT_LT(error_of(*fine), std::exp(1.0) / (8.0 * 8.0 * 8.0));
    }
  }
}

TEST(SplineGridTest, ErrorsAreMeasuredAndTheGraphIsExact) {
  const auto table = parse_columns("x,y,f\n0.5,0.5,0\n0.25,1,1\n", "fine");
  const auto places = grid_places(*table, "fine");
  ASSERT_TRUE(places);
  const auto made = grid_spline_report(grid_of(grid_rows(3, 3, true, false)), false, *places);
  ASSERT_TRUE(made);
  const double at = std::abs(evaluate(made->spline, 0.5, 0.5).value);
  EXPECT_EQ(made->rows[0].largest_error, at);
  EXPECT_EQ(made->rows[0].largest_x, 0.5);
  const auto model = graph_of(*made);
  ASSERT_TRUE(model) << to_line(model.error());
  const NurbsSurface& graph = model->patches[0].surface;
  for (const double u : {0.1, 0.6, 0.95}) {
    const Range du = domain_u(graph), dv = domain_v(graph);
    const Vec3 p = evaluate(graph, du.at(u), dv.at(1.0 - u)).point;
    EXPECT_NEAR(p.z, evaluate(made->spline, p.x, p.y).value, 1e-13);
  }
}

TEST(SplineGridTest, GapsAreRefused) {
  const auto table = parse_columns("x,y,f\n0,0,0\n1,0,1\n0,1,1\n", "g");
  EXPECT_EQ(grid_spline_input(*table, "g").error().code, ErrorCode::kBadCount);
  const auto twice = parse_columns("x,y,f\n0,0,0\n1,0,1\n0,1,1\n0,1,1\n", "g");
  EXPECT_EQ(grid_spline_input(*twice, "g").error().code, ErrorCode::kBadCount);
}

}  // namespace
}  // namespace obvid
