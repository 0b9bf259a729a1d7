// SPDX-License-Identifier: Apache-2.0
#include "banded_program.h"

#include <gtest/gtest.h>

namespace obvid {
namespace {

/// Each unknown apart: near 2 within 1; near 0.3 within 1; near 0 and wished to be 0.5 at least,
/// once dearly and once cheaply. Rows in pairs see each other by shares 1 and 0.
BandedProgram apart(std::size_t rows, std::size_t columns) {
  BandedProgram program{rows, columns, {}, true};
  for (std::size_t r = 0; r < rows; ++r) {
    FormGroup g;
    g.first_row = r;
    g.share = {1.0, 0.0, 0.0, 0.0};
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t kind = (r + c) % 4;
      g.near.push_back({c, {1.0}, kind == 0 ? 2.0 : kind == 1 ? 0.3 : 0.0, 1.0});
      g.box.push_back({c, {1.0}, 1.0, 0.0});
      if (kind > 1) g.at_least.push_back({c, {1.0}, 0.5, kind == 2 ? 10.0 : 0.2});
    }
    program.groups.push_back(std::move(g));
  }
  return program;
}

/// least (x - a)^2 / 2 in a box: a, or its bound; with weight w on what is missing of b: b where w
/// is more than b, else w.
TEST(BandedProgram, MeetsTheClosedFormInBothOrders) {
  for (const auto& [rows, columns] : {std::pair{3u, 40u}, std::pair{40u, 3u}}) {
    const auto x = solved(apart(rows, columns), {}, 0.0, 1.0);
    ASSERT_TRUE(x);
    ASSERT_EQ(x->size(), std::size_t{rows} * columns);
    for (std::size_t r = 0; r < rows; ++r) {
      for (std::size_t c = 0; c < columns; ++c) {
        const std::size_t kind = (r + c) % 4;
        const double wanted = kind == 0 ? 1.0 : kind == 1 ? 0.3 : kind == 2 ? 0.5 : 0.2;
        const double found = (*x)[r * columns + c];
        EXPECT_NEAR(found, wanted, 0.03) << r << " " << c;
        EXPECT_LT(found, 1.0);
      }
    }
  }
}

/// Neighbouring rows that are seen together: x[r] + x[r + 1] near 1 in every column, and x[0] near
/// 0 dearly: 0, 1, 0, 1, ...
TEST(BandedProgram, CouplesRowsInBothOrders) {
  for (const auto& [rows, columns] : {std::pair{4u, 60u}, std::pair{8u, 6u}}) {
    BandedProgram program{rows, columns, {}, true};
    for (std::size_t r = 0; r + 1 < rows; ++r) {
      FormGroup g;
      g.first_row = r;
      g.share = {1.0, 1.0, 0.0, 0.0};
      for (std::size_t c = 0; c < columns; ++c) g.near.push_back({c, {1.0}, 1.0, 1.0});
      program.groups.push_back(g);
      FormGroup one;
      one.first_row = r;
      one.share = {1.0, 0.0, 0.0, 0.0};
      for (std::size_t c = 0; c < columns; ++c) {
        if (r == 0) one.near.push_back({c, {1.0}, 0.0, 1.0});
        one.box.push_back({c, {1.0}, 2.0, 0.0});
        // rows of the sum over three columns, as splines have
        if (c + 2 < columns) one.at_least.push_back({c, {1.0, 1.0, 1.0}, -9.0, 1.0});
      }
      program.groups.push_back(one);
    }
    const auto x = solved(program, {}, 0.0, 1.0);
    ASSERT_TRUE(x);
    for (std::size_t r = 0; r < rows; ++r) {
      for (std::size_t c = 0; c < columns; ++c) {
        EXPECT_NEAR((*x)[r * columns + c], r % 2 == 0 ? 0.0 : 1.0, 0.05) << r << " " << c;
      }
    }
  }
}

}  // namespace
}  // namespace obvid
