// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/grid.h"
#include "sampled.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obvid {
namespace {

void expect_through_all(const PointGrid& grid, const NurbsSurface& surface, Spread spread) {
  ASSERT_TRUE(check(surface)) << check(surface).error().what;
  const std::vector<double> u = *grid_parameters(grid, true, spread);
  const std::vector<double> v = *grid_parameters(grid, false, spread);
  const double size = size_of(surface);
  for (std::size_t j = 0; j < v.size(); ++j) {
    for (std::size_t i = 0; i < u.size(); ++i) {
      EXPECT_LT(norm(evaluate(surface, u[i], v[j]).point - grid.at(i, j)), 1e-13 * size);
    }
  }
}

TEST(GridInterpolation, PassesThroughAllPointsWhateverTheirNumber) {
  for (const std::size_t nu : {2u, 3u, 4u, 5u, 17u}) {
    for (const std::size_t nv : {2u, 3u, 6u}) {
      const PointGrid grid = sampled(nu, nv, [](double x, double y) {
        return Vec3{x * x + x, 2 * y, std::sin(3 * x + y)};
      });
      for (const Spread spread : {Spread::kChord, Spread::kCentripetal, Spread::kUniform}) {
        const Result<NurbsSurface> surface = interpolated(grid, spread);
        ASSERT_TRUE(surface) << surface.error().what;
        expect_through_all(grid, *surface, spread);
      }
    }
  }
}

TEST(GridInterpolation, ReproducesABicubicPolynomialOverUniformParameters) {
  const auto f = [](double x, double y) {
    return Vec3{x, y, x * x * x * y * y - y * y * y + x * y};
  };
  const Result<NurbsSurface> surface = interpolated(sampled(8, 9, f), Spread::kUniform);
  ASSERT_TRUE(surface);
  for (double u = 0.0; u <= 1.0; u += 0.05) {
    for (double v = 0.0; v <= 1.0; v += 0.05) {
      EXPECT_LT(norm(evaluate(*surface, u, v).point - f(u, v)), 1e-13);
    }
  }
}

TEST(GridInterpolation, ConvergesWithTheFourthOrder) {
  const auto f = [](double x, double y) { return Vec3{x, y, std::sin(4 * x) * std::cos(3 * y)}; };
  double last = 0.0;
  for (const std::size_t n : {11u, 21u, 41u}) {
    const NurbsSurface surface = *interpolated(sampled(n, n, f), Spread::kUniform);
    double worst = 0.0;
    for (double u = 0.005; u < 1.0; u += 0.01) {
      for (double v = 0.005; v < 1.0; v += 0.01) {
        worst = std::max(worst, norm(evaluate(surface, u, v).point - f(u, v)));
      }
    }
    if (last > 0.0) {
      EXPECT_GT(last / worst, 10.0) << n;  // 16 in the limit
    }
    last = worst;
  }
}

TEST(GridInterpolation, IsTheSameAtAnySizeAndPlace) {
  const auto f = [](double x, double y) { return Vec3{x, y, std::sin(4 * x) * std::cos(3 * y)}; };
  const NurbsSurface plain = *interpolated(sampled(9, 7, f));
  for (const double scale : {1e-9, 1e9}) {
    const NurbsSurface scaled = *interpolated(sampled(9, 7, [&](double x, double y) {
      return scale * (f(x, y) + Vec3{5, 5, 5});
    }));
    for (std::size_t i = 0; i < plain.points.size(); ++i) {
      EXPECT_LT(norm(scaled.points[i] / scale - plain.points[i] - Vec3{5, 5, 5}), 1e-12);
    }
  }
}

TEST(GridInterpolation, TakesRowsThatShrinkToAPole) {
  const PointGrid dome = sampled(9, 6, [](double x, double y) {
    const double a = 3.0 * x, b = 1.5707963267948966 * y;
    const double r = y == 1.0 ? 0.0 : std::cos(b);
    return Vec3{r * std::cos(a), r * std::sin(a), std::sin(b)};
  });
  const Result<NurbsSurface> surface = interpolated(dome);
  ASSERT_TRUE(surface) << surface.error().what;
  expect_through_all(dome, *surface, Spread::kChord);
}

TEST(GridInterpolation, RefusesWhatSpansNoSurface) {
  PointGrid grid = sampled(3, 3, [](double x, double y) { return Vec3{x, y, 0}; });
  grid.points.pop_back();
  EXPECT_EQ(interpolated(grid).error().code, ErrorCode::kUsage);
  EXPECT_EQ(interpolated(sampled(1, 5,
                                 [](double, double y) {
                                   return Vec3{0, y, 0};
                                 }))
                .error()
                .code,
            ErrorCode::kTooFewPoints);
  grid = sampled(4, 4, [](double x, double y) { return Vec3{x, y, 0}; });
  for (std::size_t i = 0; i < 4; ++i) grid.points[2 * 4 + i] = grid.points[4 + i];
  const auto doubled = interpolated(grid);
  ASSERT_FALSE(doubled);
  EXPECT_EQ(doubled.error().code, ErrorCode::kSizeOutOfRange);
  EXPECT_EQ(doubled.error().index, 2);
  grid.points[5].x = std::nan("");
  EXPECT_EQ(interpolated(grid).error().code, ErrorCode::kNotFinite);
}

TEST(ControlPointSurface, StaysInsideItsNetAndKeepsItsCorners) {
  const PointGrid net = sampled(6, 5, [](double x, double y) {
    return Vec3{x, y, 0.5 + 0.5 * std::sin(20 * x * y)};
  });
  const Result<NurbsSurface> surface = from_control_points(net);
  ASSERT_TRUE(surface);
  ASSERT_TRUE(check(*surface));
  EXPECT_EQ(evaluate(*surface, 0, 0).point, net.at(0, 0));
  EXPECT_EQ(evaluate(*surface, 1, 1).point, net.at(5, 4));
  for (double u = 0.0; u <= 1.0; u += 0.1) {
    for (double v = 0.0; v <= 1.0; v += 0.1) {
      const Vec3 p = evaluate(*surface, u, v).point;
      EXPECT_GE(p.z, 0.0);
      EXPECT_LE(p.z, 1.0);
    }
  }
  EXPECT_EQ(from_control_points(sampled(2, 3,
                                        [](double x, double y) {
                                          return Vec3{x, y, 0};
                                        }))
                ->degree_u,
            1);
  EXPECT_FALSE(from_control_points(net, 0, 3));
}

}  // namespace
}  // namespace obvid
