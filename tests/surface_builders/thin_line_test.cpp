// SPDX-License-Identifier: Apache-2.0
#include "thin_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace obvid {
namespace {

std::vector<double> clamped_knots(int degree, std::vector<double> inner) {
  const auto order = static_cast<std::size_t>(degree) + 1;
  std::sort(inner.begin(), inner.end());
  inner.insert(inner.begin(), order, 0.0);
  inner.insert(inner.end(), order, 1.0);
  return inner;
}

/// Points of a row at a parameter.
std::vector<Vec3> row_at(const ThinLine& line, double t) {
  const BasisValues basis = basis_at(line.degree, line.knots, t, 0);
  std::vector<Vec3> out(line.coefficients.width);
  for (std::size_t k = 0; k <= static_cast<std::size_t>(line.degree); ++k) {
    const Vec3* from = line.coefficients.row(basis.first + k);
    for (std::size_t j = 0; j < out.size(); ++j) out[j] = out[j] + basis.value[0][k] * from[j];
  }
  return out;
}

std::vector<double> even_places(std::size_t count) {
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) {
    out.push_back(static_cast<double>(i) / static_cast<double>(count - 1));
  }
  return out;
}

ThinLine fitted(int degree, const std::vector<double>& inner, const std::vector<double>& at,
                const Rows& data) {
  SplineLine line(at, degree, HUGE_VAL);
  while (line.split(std::vector<double>(at.size(), 1.0), 0.0) > 0) {
  }
  // the wanted knots are some of the places
  std::vector<std::size_t> others;
  const std::vector<double>& knots = line.knots();
  for (std::size_t k = 0; k + 2 * static_cast<std::size_t>(degree) + 2 < knots.size(); ++k) {
    const double t = knots[k + static_cast<std::size_t>(degree) + 1];
    if (std::find(inner.begin(), inner.end(), t) == inner.end()) others.push_back(k);
  }
  line.remove(others);
  ThinLine out{degree, line.knots(), {}};
  EXPECT_TRUE(line.fit(data, {}, out.coefficients));
  return out;
}

TEST(ThinLine, OnlyKnotsThatMatterStay) {
  // rows of three splines with four knots, told with 27 more
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const int degree : {3, 5}) {
    const std::vector<double> matter = {0.1875, 0.375, 0.625, 0.8125};
    ThinLine simple{degree, clamped_knots(degree, matter), {3, {}}};
    const std::size_t count = simple.knots.size() - static_cast<std::size_t>(degree) - 1;
    for (std::size_t i = 0; i < 3 * count; ++i) {
      simple.coefficients.points.push_back({any(random), any(random), any(random)});
    }
    const std::vector<double> at = even_places(513);
    Rows data{3, {}};
    for (const double t : at) {
      const std::vector<Vec3> row = row_at(simple, t);
      data.points.insert(data.points.end(), row.begin(), row.end());
    }
    std::vector<double> all;
    for (int k = 1; k < 32; ++k) all.push_back(k / 32.0);
    ThinLine line = fitted(degree, all, at, data);
    RowHull hull;
    hull.add_points(3);
    const std::vector<double> strictness(at.size(), 1.0);
    Watch watch;
    const ThinData given{at, data, strictness, {}, hull};
    ASSERT_TRUE(thin_out(line, given, 1e-9, watch));
    EXPECT_EQ(line.knots, simple.knots) << degree;
    for (const double t : {0.1, 0.33, 0.77}) {
      EXPECT_LT(norm(row_at(line, t)[1] - row_at(simple, t)[1]), 1e-9);
    }
  }
}

/// The line nearest to x^2 over [0, 1] is 1/8 away at most (Chebyshev), that of least squares 1/6.
TEST(ThinLine, WeightsReachWhatLeastSquaresDoNot) {
  const std::vector<double> at = even_places(257);
  Rows data{1, {}};
  for (const double t : at) data.points.push_back({t, t * t, 0.0});
  RowHull hull;
  hull.add_points(1);
  const std::vector<double> strictness(at.size(), 1.0);
  Watch watch;
  for (const auto& [aim, knots] : {std::pair{0.14, 4u}, std::pair{0.12, 5u}}) {
    ThinLine line = fitted(1, {0.5}, at, data);
    const ThinData given{at, data, strictness, {}, hull};
    ASSERT_TRUE(thin_out(line, given, aim, watch));
    EXPECT_EQ(line.knots.size(), knots) << aim;
    for (const double t : at) EXPECT_LE(norm(row_at(line, t)[0] - Vec3{t, t * t, 0.0}), aim);
  }
}

TEST(RowHull, PiecesEnclosePlacesAndMoreOfThemMoreClosely) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const int degree : {1, 3, 5}) {
    const std::vector<double> knots = clamped_knots(degree, {0.1, 0.3, 0.3, 0.55, 0.9});
    const std::size_t count = knots.size() - static_cast<std::size_t>(degree) - 1;
    RowHull places, hull, close;
    places.add_places(degree, knots, 3);
    hull.add_pieces(degree, knots, 1);
    close.add_pieces(degree, knots, 4);
    for (int trial = 0; trial < 20; ++trial) {
      ThinLine line{degree, knots, {1, {}}};
      std::vector<double> row;
      double longest = 0.0;
      for (std::size_t i = 0; i < count; ++i) {
        line.coefficients.points.push_back({any(random), any(random), any(random)});
        const Vec3 p = line.coefficients.points.back();
        row.insert(row.end(), {p.x, p.y, p.z});
        longest = std::max(longest, norm(p));
      }
      double most = 0.0;
      for (const double t : even_places(2001)) most = std::max(most, norm(row_at(line, t)[0]));
      const double by_hull = std::sqrt(hull.longest_squared(row.data()));
      const double by_close = std::sqrt(close.longest_squared(row.data()));
      constexpr double kRounding = 1e-14;
      EXPECT_LE(std::sqrt(places.longest_squared(row.data())), most + kRounding + 1e-5);
      EXPECT_LE(most, by_close + kRounding);
      EXPECT_LE(by_close, by_hull + kRounding);
      EXPECT_LE(by_hull, longest + kRounding);
    }
  }
}

}  // namespace
}  // namespace obvid
