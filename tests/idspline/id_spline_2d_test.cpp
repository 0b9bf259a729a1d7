// SPDX-License-Identifier: Apache-2.0
// Two variables: conditions met, biquadratics reproduced, C1, sections, the domain of [004]
#include "obvid/idspline/internal/id_spline_2d.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "polynomial.h"

namespace obvid {
namespace {

/// p(x) q(y) + r(x) t(y), biquadratic.
struct Biquadratic {
  Polynomial p{{0.4, -0.8, 0.3}}, q{{1.1, 0.5, -0.6}}, r{{-0.2, 0.9, 0.7}}, t{{0.3, -0.4, 0.8}};

  [[nodiscard]] double at(double x, double y, int dx = 0, int dy = 0) const {
    return p.at(x, dx) * q.at(y, dy) + r.at(x, dx) * t.at(y, dy);
  }
  [[nodiscard]] double integral(double x0, double x1, double y0, double y1) const {
    return p.integral(x0, x1) * q.integral(y0, y1) + r.integral(x0, x1) * t.integral(y0, y1);
  }
};

const std::vector<double> kX = {-2.0, -1.3, -0.4, 0.0, 0.5, 1.4, 2.0};
const std::vector<double> kY = {-2.0, -1.1, -0.5, 0.3, 2.0};

template <class Function>
IdSpline2dData values_on(const std::vector<double>& x, const std::vector<double>& y,
                         const Function& f) {
  IdSpline2dData data{x, y, {}, {}, {}, {}};
  for (const double v : y) {
    for (const double u : x) data.values.push_back(f(u, v));
  }
  return data;
}

IdSpline2dData random_table() {
  std::mt19937 random(4);
  const auto number = [&](double, double) { return double(random()) / double(random.max()); };
  IdSpline2dData data = values_on(kX, kY, number);
  const std::size_t nx = kX.size(), ny = kY.size();
  for (std::size_t k = 0; k < (nx - 1) * ny; ++k) data.along_x.push_back(number(0, 0));
  for (std::size_t k = 0; k < nx * (ny - 1); ++k) data.along_y.push_back(number(0, 0));
  for (std::size_t k = 0; k < (nx - 1) * (ny - 1); ++k) data.cells.push_back(number(0, 0));
  return data;
}

TEST(IdSpline2d, ReproducesBiquadraticsFromValuesAlone) {
  const Biquadratic f;
  for (const bool smooth : {false, true}) {
    const auto s =
        id_spline_2d(values_on(kX, kY, [&](double x, double y) { return f.at(x, y); }), smooth);
    ASSERT_TRUE(s);
    for (double x = -2.0; x <= 2.0; x += 0.25) {
      for (double y = -2.0; y <= 2.0; y += 0.25) {
        const GridJet jet = evaluate(*s, x, y);
        EXPECT_NEAR(jet.value, f.at(x, y), 1e-13);
        EXPECT_NEAR(jet.dx, f.at(x, y, 1, 0), 1e-12);
        EXPECT_NEAR(jet.dy, f.at(x, y, 0, 1), 1e-12);
        EXPECT_NEAR(jet.dxx, f.at(x, y, 2, 0), 1e-11);
        EXPECT_NEAR(jet.dxy, f.at(x, y, 1, 1), 1e-11);
        EXPECT_NEAR(jet.dyy, f.at(x, y, 0, 2), 1e-11);
      }
    }
    EXPECT_NEAR(integral(*s, -1.7, 1.2, -0.3, 1.9), f.integral(-1.7, 1.2, -0.3, 1.9), 1e-12);
    EXPECT_NEAR(integral(*s, -2.0, 2.0, -2.0, 2.0), f.integral(-2.0, 2.0, -2.0, 2.0), 1e-12);
  }
}

TEST(IdSpline2d, MeetsValuesLineIntegralsAndCellIntegrals) {
  const IdSpline2dData data = random_table();
  const auto s = id_spline_2d(data);
  ASSERT_TRUE(s);
  const std::size_t nx = kX.size();
  for (std::size_t j = 0; j < kY.size(); ++j) {
    const IdSpline line = section_along_x(*s, kY[j]);
    for (std::size_t i = 0; i < nx; ++i) {
      EXPECT_NEAR(evaluate(*s, kX[i], kY[j]).value, data.values[j * nx + i], 1e-15);
      if (i + 1 < nx) {
        EXPECT_NEAR(integral(line, kX[i], kX[i + 1]), data.along_x[j * (nx - 1) + i], 1e-15);
      }
    }
  }
  for (std::size_t i = 0; i < nx; ++i) {
    const IdSpline line = section_along_y(*s, kX[i]);
    for (std::size_t j = 0; j + 1 < kY.size(); ++j) {
      EXPECT_NEAR(integral(line, kY[j], kY[j + 1]), data.along_y[j * nx + i], 1e-15);
    }
  }
}

/// Integral of a cell from values of the spline: 3 x 3 Gauss points, exact for degree 5.
double by_points(const IdSpline2d& s, std::size_t i, std::size_t j) {
  const double hx = s.x[i + 1] - s.x[i], hy = s.y[j + 1] - s.y[j];
  const double place[] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
  const double weight[] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  double sum = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      sum +=
          weight[a] * weight[b] * evaluate(s, s.x[i] + place[a] * hx, s.y[j] + place[b] * hy).value;
    }
  }
  return hx * hy * sum;
}

TEST(IdSpline2d, IntegralOverEveryCellIsMetSmoothOrNot) {
  const IdSpline2dData data = random_table();
  for (const bool smooth : {false, true}) {
    const auto s = id_spline_2d(data, smooth);
    ASSERT_TRUE(s);
    for (std::size_t j = 0; j + 1 < kY.size(); ++j) {
      for (std::size_t i = 0; i + 1 < kX.size(); ++i) {
        const double given = data.cells[j * (kX.size() - 1) + i];
        EXPECT_EQ(integral(*s, kX[i], kX[i + 1], kY[j], kY[j + 1]), given);
        EXPECT_NEAR(by_points(*s, i, j), given, 2e-14) << smooth;
      }
    }
  }
}

TEST(IdSpline2d, SmoothingMakesBothDerivativesContinuous) {
  for (const bool smooth : {false, true}) {
    const auto s = id_spline_2d(random_table(), smooth);
    ASSERT_TRUE(s);
    double jump = 0.0;
    for (const double at : {-1.9, -0.7, 0.1, 1.6}) {
      for (std::size_t i = 1; i + 1 < kX.size(); ++i) {
        const IdSpline line = section_along_x(*s, at);
        jump = std::max(jump, std::abs(evaluate(cell(line, i - 1), kX[i]).d1 -
                                       evaluate(cell(line, i), kX[i]).d1));
      }
      for (std::size_t j = 1; j + 1 < kY.size(); ++j) {
        const IdSpline line = section_along_y(*s, at);
        jump = std::max(jump, std::abs(evaluate(cell(line, j - 1), kY[j]).d1 -
                                       evaluate(cell(line, j), kY[j]).d1));
      }
    }
    EXPECT_EQ(jump < 1e-12, smooth) << jump;
    EXPECT_EQ(jump > 1.0, !smooth) << jump;
  }
}

TEST(IdSpline2d, SectionsAreTheSurfaceAndTransposedDataTheTransposedSurface) {
  const auto s = id_spline_2d(random_table(), true);
  IdSpline2dData turned{kY, kX, {}, {}, {}, {}};
  const IdSpline2dData data = random_table();
  const auto transpose = [](const std::vector<double>& in, std::size_t width,
                            std::vector<double>& out) {
    for (std::size_t i = 0; i < width; ++i) {
      for (std::size_t j = 0; j < in.size() / width; ++j) out.push_back(in[j * width + i]);
    }
  };
  transpose(data.values, kX.size(), turned.values);
  transpose(data.along_x, kX.size() - 1, turned.along_y);
  transpose(data.along_y, kX.size(), turned.along_x);
  transpose(data.cells, kX.size() - 1, turned.cells);
  const auto t = id_spline_2d(turned, true);  // columns first, seen from the original
  ASSERT_TRUE(s && t);
  for (double x = -2.0; x <= 2.0; x += 0.3) {
    for (double y = -2.0; y <= 2.0; y += 0.3) {
      const GridJet jet = evaluate(*s, x, y), other = evaluate(*t, y, x);
      EXPECT_NEAR(evaluate(section_along_x(*s, y), x).value, jet.value, 1e-14);
      EXPECT_NEAR(evaluate(section_along_x(*s, y), x).d1, jet.dx, 1e-12);
      EXPECT_NEAR(evaluate(section_along_y(*s, x), y).d1, jet.dy, 1e-12);
      EXPECT_NEAR(other.value, jet.value, 1e-13);
      EXPECT_NEAR(other.dxy, jet.dxy, 1e-11);
    }
  }
}

TEST(IdSpline2d, BezierOrdinatesGiveTheSamePatch) {
  const auto s = id_spline_2d(random_table());
  ASSERT_TRUE(s);
  const auto b = bezier_ordinates(*s, 2, 1);
  for (const double u : {0.0, 0.3, 0.5, 1.0}) {
    for (const double v : {0.0, 0.25, 0.9, 1.0}) {
      const double bu[] = {(1 - u) * (1 - u), 2 * u * (1 - u), u * u};
      const double bv[] = {(1 - v) * (1 - v), 2 * v * (1 - v), v * v};
      double sum = 0.0;
      for (std::size_t l = 0; l < 3; ++l) {
        for (std::size_t k = 0; k < 3; ++k) sum += bv[l] * bu[k] * b[l][k];
      }
      const double x = kX[2] + u * (kX[3] - kX[2]), y = kY[1] + v * (kY[2] - kY[1]);
      // ends belong to neighbours that have the same values there
      EXPECT_NEAR(evaluate(*s, x, y).value, sum, 2e-14);
    }
  }
}

/// Largest error on the section y = 0 of [-2, 2] x [-2, 2] with n equal steps (n odd: no node on
/// the section).
double section_error(std::size_t n, bool smooth) {
  const auto f = [](double x, double y) { return std::exp(-x * x - y * y); };
  std::vector<double> nodes;
  for (std::size_t i = 0; i <= n; ++i) nodes.push_back(-2.0 + 4.0 * double(i) / double(n));
  const auto s = id_spline_2d(values_on(nodes, nodes, f), smooth);
  if (!s) return -1.0;
  const IdSpline line = section_along_x(*s, 0.0);
  double worst = 0.0;
  for (double x = -2.0; x <= 2.0; x += 0.001) {
    worst = std::max(worst, std::abs(evaluate(line, x).value - f(x, 0.0)));
  }
  return worst;
}

TEST(IdSpline2d, SectionAtZeroIsApproachedWithThirdOrder) {
  for (const bool smooth : {false, true}) {
    const double coarse = section_error(21, smooth), fine = section_error(63, smooth);
    ASSERT_GT(fine, 0.0);
    EXPECT_GT(std::log(coarse / fine) / std::log(3.0), 2.8) << smooth;
  }
}

TEST(IdSpline2d, RefusesWhatIsNoGrid) {
  const auto code = [](const IdSpline2dData& d) {
    const auto s = id_spline_2d(d);
    return s ? ErrorCode::kInternal : s.error().code;
  };
  const std::vector<double> two = {0.0, 1.0};
  EXPECT_EQ(code({{}, two, {}, {}, {}, {}}), ErrorCode::kTooFewPoints);
  EXPECT_EQ(code({two, {1.0, 0.0}, {1, 2, 3, 4}, {}, {}, {}}), ErrorCode::kChordReversal);
  EXPECT_EQ(code({two, two, {1, 2, 3}, {}, {}, {}}), ErrorCode::kUsage);
  EXPECT_EQ(code({two, two, {1, 2, 3, std::nan("")}, {}, {}, {}}), ErrorCode::kNotFinite);
  EXPECT_EQ(code({two, two, {1, 2, 3, 4}, {1, 2}, {}, {}}), ErrorCode::kUsage);
  EXPECT_EQ(code({two, two, {1, 2, 3, 4}, {1, 2}, {1, 2}, {std::nan("")}}), ErrorCode::kNotFinite);
}

}  // namespace
}  // namespace obvid
