// SPDX-License-Identifier: Apache-2.0
#include "small_program.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace obvid::alignment {
namespace {

constexpr double kBox = 10.0;

/// Best corner of the rows and the box: all combinations of four, each solved by elimination.
std::optional<double> by_corners(const Unknowns& goal, std::vector<HalfSpace> rows) {
  for (std::size_t k = 0; k < kUnknowns; ++k) {
    HalfSpace side;
    side.a[k] = 1.0;
    side.b = kBox;
    rows.push_back(side);
    side.a[k] = -1.0;
    rows.push_back(side);
  }
  std::optional<double> best;
  const std::size_t n = rows.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k)
        for (std::size_t l = k + 1; l < n; ++l) {
          const std::size_t pick[4] = {i, j, k, l};
          double m[4][5];
          for (int r = 0; r < 4; ++r) {
            for (int c = 0; c < 4; ++c) m[r][c] = rows[pick[r]].a[static_cast<std::size_t>(c)];
            m[r][4] = rows[pick[r]].b;
          }
          bool singular = false;
          for (int c = 0; c < 4 && !singular; ++c) {
            int top = c;
            for (int r = c; r < 4; ++r)
              if (std::abs(m[r][c]) > std::abs(m[top][c])) top = r;
            std::swap(m[c], m[top]);
            singular = std::abs(m[c][c]) < 1e-9;
            for (int r = 0; r < 4 && !singular; ++r) {
              if (r == c) continue;
              const double share = m[r][c] / m[c][c];
              for (int q = c; q < 5; ++q) m[r][q] -= share * m[c][q];
            }
          }
          if (singular) continue;
          Unknowns x{};
          for (int c = 0; c < 4; ++c) x[static_cast<std::size_t>(c)] = m[c][4] / m[c][c];
          bool inside = true;
          for (const HalfSpace& row : rows) {
            double sum = -row.b;
            for (std::size_t c = 0; c < 4; ++c) sum += row.a[c] * x[c];
            inside = inside && sum <= 1e-7;
          }
          if (!inside) continue;
          double value = 0.0;
          for (std::size_t c = 0; c < 4; ++c) value += goal[c] * x[c];
          if (!best || value > *best) best = value;
        }
  return best;
}

TEST(SmallProgram, FindsTheMaximumThatTheCornersHave) {
  std::uint64_t state = 11;
  const auto random = [&] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 11) * 0x1p-52 - 1.0;
  };
  SmallProgram program;
  int possible = 0, impossible = 0;
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<HalfSpace> rows;
    for (int i = 0; i < 9; ++i) {
      HalfSpace row;
      for (double& a : row.a) a = random();
      row.b = 3.0 * random() + (trial % 2 == 0 ? 3.0 : -4.0);
      rows.push_back(row);
    }
    const Unknowns goal = {random(), random(), random(), random()};
    program.clear();
    program.add(rows);
    program.shuffle();
    const auto found = program.maximum(goal, kBox);
    const auto truth = by_corners(goal, rows);
    ASSERT_EQ(found.has_value(), truth.has_value()) << trial;
    if (!found) {
      ++impossible;
      continue;
    }
    ++possible;
    double value = 0.0;
    for (std::size_t c = 0; c < 4; ++c) value += goal[c] * (*found)[c];
    EXPECT_NEAR(value, *truth, 1e-7) << trial;
  }
  EXPECT_GT(possible, 10);
  EXPECT_GT(impossible, 3);
}

}  // namespace
}  // namespace obvid::alignment
