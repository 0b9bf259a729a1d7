// SPDX-License-Identifier: Apache-2.0
// Orders of approximation for a function that is no polynomial, and published series.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "../common/shared_data.h"
#include "obvid/idspline/internal/id_spline.h"
#include "obvid/io/read_points.h"

namespace obvid {
namespace {

/// exp(-x) cos 4x, its derivatives and its integral: parts of exp((4i - 1) x).
double reference(double x, int derivative) {
  const double rate = std::pow(std::sqrt(17.0), derivative),
               turn = derivative * std::atan2(4.0, -1.0);
  return rate * std::exp(-x) * std::cos(4.0 * x + turn);
}

/// Equal steps on [0, 3], or inner nodes moved by up to 0.3 of a step.
std::vector<double> nodes_of(std::size_t n, bool random_steps) {
  std::mt19937 random(12);
  std::vector<double> x;
  for (std::size_t i = 0; i <= n; ++i) {
    const double move =
        random_steps && i > 0 && i < n ? 0.6 * double(random()) / double(random.max()) - 0.3 : 0.0;
    x.push_back(3.0 * (double(i) + move) / double(n));
  }
  return x;
}

struct Errors {
  double value = 0.0, slope = 0.0, integral = 0.0;
};

Errors errors(std::size_t n, const IdSplineOptions& options, bool random_steps, bool exact) {
  IdSplineData data{nodes_of(n, random_steps), {}};
  const auto& x = data.nodes;
  for (std::size_t i = 0; i < x.size(); ++i) {
    data.values.push_back(reference(x[i], 0));
    if (!exact) continue;
    if (i > 0) data.integrals.push_back(reference(x[i], -1) - reference(x[i - 1], -1));
    if (options.degree >= 4) data.slopes.push_back(reference(x[i], 1));
    if (options.degree >= 6) data.seconds.push_back(reference(x[i], 2));
  }
  const auto s = id_spline(data, options);
  Errors e;
  if (!s) return e;
  for (int k = 0; k <= 3000; ++k) {
    const double at = 0.001 * k;
    const ScalarJet jet = evaluate(*s, at);
    e.value = std::max(e.value, std::abs(jet.value - reference(at, 0)));
    e.slope = std::max(e.slope, std::abs(jet.d1 - reference(at, 1)));
    e.integral = std::max(
        e.integral, std::abs(integral(*s, 0.0, at) - (reference(at, -1) - reference(0.0, -1))));
  }
  return e;
}

/// Measured orders may fall short of those in the limit by this much.
constexpr double kShort = 0.6;

void expect_orders(const IdSplineOptions& options, bool random_steps, bool exact) {
  const std::size_t n = options.degree == 6 ? 48 : 96;  // above rounding still
  const Errors a = errors(n, options, random_steps, exact);
  const Errors b = errors(2 * n, options, random_steps, exact);
  const double degree = options.degree;
  ASSERT_GT(b.value, 0.0);
  EXPECT_GT(std::log2(a.value / b.value), degree + 1.0 - kShort) << degree << random_steps << exact;
  EXPECT_GT(std::log2(a.slope / b.slope), degree - kShort) << degree << random_steps << exact;
  EXPECT_GT(std::log2(a.integral / b.integral), degree + 2.0 - kShort) << degree << random_steps;
}

TEST(IdSplineOrder, IsDegreePlusOneForValuesAndOneMoreOrLessForIntegralsAndSlopes) {
  for (const int degree : {2, 4, 6}) {
    for (const auto smoothing :
         {IdSmoothing::kNone, IdSmoothing::kValuesKept, IdSmoothing::kValuesFree}) {
      if (degree == 2 && smoothing == IdSmoothing::kValuesKept) continue;
      expect_orders({degree, smoothing}, false, true);
      expect_orders({degree, smoothing}, false, false);
    }
  }
}

class PublishedSeries : public testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT("published_series");
    for (const char* name :
         {"akima1970", "akima_uneven_a", "akima_uneven_b", "fritsch_carlson_rpn15a", "spaeth10",
          "titanium_heat12", "titanium_heat49", "pchip_four_points"}) {
      const auto series = read_points((kFolder / (std::string(name) + ".csv")).string());
      ASSERT_TRUE(series) << name;
      IdSplineData data;
      for (const Vec2 p : series->points) {
        data.nodes.push_back(p.x);
        data.values.push_back(p.y);
      }
      all_.push_back(data);
    }
  }

  const std::filesystem::path kFolder = shared_data() / "published_series";
  std::vector<IdSplineData> all_;
};

/// Value at x of the parabola through three nodes (Lagrange).
double parabola(const IdSplineData& d, std::size_t first, double x) {
  double sum = 0.0;
  for (std::size_t k = first; k < first + 3; ++k) {
    double term = d.values[k];
    for (std::size_t l = first; l < first + 3; ++l) {
      if (l != k) term *= (x - d.nodes[l]) / (d.nodes[k] - d.nodes[l]);
    }
    sum += term;
  }
  return sum;
}

TEST_F(PublishedSeries, ParabolasFromValuesAloneAreMeansOfTheTwoThroughThreeNodes) {
  for (const IdSplineData& data : all_) {
    const auto s = id_spline(data);
    ASSERT_TRUE(s);
    const std::size_t last = data.nodes.size() - 1;
    for (std::size_t i = 0; i < last; ++i) {
      const std::size_t a = i > 0 ? i - 1 : 0, b = std::min(i, last - 2);
      for (const double u : {0.1, 0.4, 0.9}) {
        const double x = data.nodes[i] + u * (data.nodes[i + 1] - data.nodes[i]);
        const double expected = 0.5 * (parabola(data, a, x) + parabola(data, b, x));
        EXPECT_NEAR(evaluate(*s, x).value, expected, 1e-13 * (1.0 + std::abs(expected)) * 100.0);
      }
    }
  }
}

TEST_F(PublishedSeries, CellIntegralsSurviveSmoothing) {
  for (const IdSplineData& data : all_) {
    for (const int degree : {2, 4, 6}) {
      const auto plain = id_spline(data, {degree, IdSmoothing::kNone});
      const auto free = id_spline(data, {degree, IdSmoothing::kValuesFree});
      ASSERT_TRUE(plain && free);
      EXPECT_EQ(plain->integrals, free->integrals);
      for (std::size_t i = 0; i + 1 < data.nodes.size(); ++i) {
        const CellPolynomial c = cell(*free, i);
        const double size = std::abs(c.left[0]) + std::abs(c.right[0]) + std::abs(c.left[1]) +
                            std::abs(c.right[1]) + std::abs(c.left[2]) + std::abs(c.right[2]);
        EXPECT_NEAR(mean(c) * c.length, plain->integrals[i], 1e-15 * c.length * size);
      }
    }
  }
}

}  // namespace
}  // namespace obvid
