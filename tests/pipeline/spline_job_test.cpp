// SPDX-License-Identifier: Apache-2.0
// Splines of tables: what is given is kept, errors are those of the finer data.
#include "obvid/pipeline/spline_job.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace obvid {
namespace {

SplineInput table_of(const std::string& text, bool curve = false) {
  const auto table = parse_columns(text, "f");
  EXPECT_TRUE(table) << (table ? "" : to_line(table.error()));
  auto input = spline_input(*table, "f", curve);
  EXPECT_TRUE(input) << (input ? "" : to_line(input.error()));
  return std::move(*input);
}

/// sin over [0, 2]: values, and integrals over the cells in closed form.
std::string sine_table(int cells, bool integrals) {
  std::string out = integrals ? "x,f,integral\n" : "x,f\n";
  for (int i = 0; i <= cells; ++i) {
    const double x = 2.0 * i / cells, next = 2.0 * (i + 1) / cells;
    out += std::to_string(x) + "," + std::to_string(std::sin(x));
    if (integrals) out += i < cells ? "," + std::to_string(std::cos(x) - std::cos(next)) : ",";
    out += "\n";
  }
  return out;
}

TEST(SplineJob, TheIntegralsOfATableAreKept) {
  SplineJob job;
  job.compare = true;
  const auto made = spline_report(table_of(sine_table(4, true)), job, std::nullopt);
  ASSERT_TRUE(made) << to_line(made.error());
  ASSERT_EQ(made->input.integrals.size(), 4U);
  std::size_t cubics = 0;
  for (const SplineRow& row : made->rows) {
    const bool cubic = row.name.starts_with("cubic");
    cubics += cubic ? 1 : 0;
    if (cubic) {
      EXPECT_GT(row.integral_error, 1e-5) << row.name;
    } else {
      EXPECT_LT(row.integral_error, 1e-15) << row.name;
      EXPECT_NEAR(row.integral, 1.0 - std::cos(2.0), 4e-6) << row.name;  // six printed decimals
    }
    EXPECT_TRUE(std::isnan(row.largest_error)) << row.name;
  }
  EXPECT_EQ(cubics, 3U);
  EXPECT_EQ(made->rows.size(), 11U);
}

TEST(SplineJob, ErrorsAreThoseAtTheFinerPlaces) {
  SplineJob job;
  const SplineInput coarse = table_of("0 0\n1 1\n2 0\n");
  // a parabola through three values is the spline itself
  const auto made = spline_report(coarse, job, table_of("0.5 0.75\n1.5 0.5\n"));
  ASSERT_TRUE(made);
  EXPECT_NEAR(made->rows[0].largest_error, 0.25, 1e-15);
  EXPECT_EQ(made->rows[0].largest_at, 1.5);
  EXPECT_NEAR(made->rows[0].rms_error, 0.25 / std::sqrt(2.0), 1e-15);
}

TEST(SplineJob, MovesStayWithinTheirTolerance) {
  SplineJob job;
  job.options.degree = 4;
  const auto at = [&](double tolerance) {
    job.tolerance = tolerance;
    const auto made =
        spline_report(table_of(sine_table(8, false)), job, table_of(sine_table(400, false)));
    EXPECT_TRUE(made);
    return made->rows[0];
  };
  const SplineRow coarse = at(1e-2), fine = at(1e-4);
  EXPECT_LT(fine.path_deviation, 1e-4 + fine.largest_error + 1e-5);
  EXPECT_LT(coarse.path_deviation, 1e-2 + coarse.largest_error + 1e-3);
  EXPECT_GT(fine.blocks, 4 * coarse.blocks);
  // length of the graph of the sine over [0, 2] by Simpson's rule
  double length = 0.0;
  constexpr int kSteps = 2000;
  for (int k = 0; k <= kSteps; ++k) {
    const double weight = k == 0 || k == kSteps ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
    length += weight * std::hypot(1.0, std::cos(2.0 * k / kSteps)) * 2.0 / kSteps / 3.0;
  }
  EXPECT_NEAR(fine.path_length, length, 1e-3);
}

TEST(SplineJob, ACurveInSpacePassesItsPoints) {
  std::string helix = "x,y,z\n", finer = helix;
  for (int i = 0; i <= 24; ++i) {
    const double t = 0.25 * i;
    helix += std::to_string(std::cos(t)) + "," + std::to_string(std::sin(t)) + "," +
             std::to_string(0.3 * t) + "\n";
  }
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.06 * i;
    finer += std::to_string(std::cos(t)) + "," + std::to_string(std::sin(t)) + "," +
             std::to_string(0.3 * t) + "\n";
  }
  SplineJob job;
  job.curve = true;
  job.options = {4, IdSmoothing::kValuesKept};
  const auto made = spline_report(table_of(helix, true), job, table_of(finer, true));
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_EQ(made->parts.size(), 3U);
  EXPECT_LT(made->rows[0].largest_move, 1e-12);
  EXPECT_LT(made->rows[0].largest_error, 1e-4);
  EXPECT_LT(made->largest_jump, 1e-9);
}

TEST(SplineJob, TablesThatLackAColumnAreRefused) {
  const auto refused = [](const std::string& text, bool curve, ErrorCode code) {
    const auto table = parse_columns(text, "f");
    ASSERT_TRUE(table);
    const auto input = spline_input(*table, "f", curve);
    ASSERT_FALSE(input) << text;
    EXPECT_EQ(input.error().code, code);
  };
  refused("x,g\n0,1\n1,2\n", false, ErrorCode::kUsage);
  refused("0 1 2\n1 2 3\n", false, ErrorCode::kUsage);
  refused("x,f\n0,1\n", false, ErrorCode::kTooFewPoints);
  refused("x,f,slope\n0,1,1\n1,2\n", false, ErrorCode::kTooFewColumns);
  refused("x,z\n0,1\n1,2\n", true, ErrorCode::kUsage);
}

}  // namespace
}  // namespace obvid
