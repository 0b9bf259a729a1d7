// SPDX-License-Identifier: Apache-2.0
// One-dimensional splines: conditions met, polynomials reproduced, continuity, published equations.
#include "obvid/idspline/internal/id_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "obvid/contour/bsplines.h"
#include "polynomial.h"

namespace obvid {
namespace {

constexpr IdSmoothing kNone = IdSmoothing::kNone;
constexpr IdSmoothing kKept = IdSmoothing::kValuesKept;
constexpr IdSmoothing kFree = IdSmoothing::kValuesFree;

struct Kind {
  int degree;
  IdSmoothing smoothing;
  int continuous;  ///< derivatives that are continuous
};
const std::vector<Kind> kKinds = {{2, kNone, 0}, {2, kFree, 1}, {4, kNone, 1}, {4, kKept, 2},
                                  {4, kFree, 3}, {6, kNone, 2}, {6, kKept, 4}, {6, kFree, 5}};

/// Steps between `low` and 1.
std::vector<double> random_nodes(std::size_t count, double low, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> nodes = {-1.0};
  while (nodes.size() < count) {
    nodes.push_back(nodes.back() + low + (1.0 - low) * double(random()) / double(random.max()));
  }
  return nodes;
}

std::vector<double> random_numbers(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> out(count);
  for (double& x : out) x = 2.0 * double(random()) / double(random.max()) - 1.0;
  return out;
}

/// Independent values, integrals, slopes and second derivatives, as far as the degree has them.
IdSplineData random_data(std::size_t count, int degree, unsigned seed) {
  IdSplineData data{random_nodes(count, 0.2, seed), random_numbers(count, seed + 1),
                    random_numbers(count - 1, seed + 2)};
  if (degree >= 4) data.slopes = random_numbers(count, seed + 3);
  if (degree >= 6) data.seconds = random_numbers(count, seed + 4);
  return data;
}

IdSpline made(const IdSplineData& data, int degree, IdSmoothing smoothing) {
  auto spline = id_spline(data, {degree, smoothing});
  if (!spline) {
    ADD_FAILURE() << to_line(spline.error());
    return {2, {0.0, 1.0}, {0.0, 0.0}, {}, {}, {0.0}};
  }
  return std::move(*spline);
}

/// Derivatives 0 to 6 of a cell at its ends, by its powers.
double derivative(const CellPolynomial& c, int order, double x) {
  const auto power = power_coefficients(c);
  return Polynomial{{power.begin(), power.end()}}.at(x - c.from, order);
}

TEST(IdSpline, KeepsTheGivenDataAtNodesAndEnds) {
  for (const Kind& kind : kKinds) {
    const IdSplineData data = random_data(9, kind.degree, 5);
    const IdSpline s = made(data, kind.degree, kind.smoothing);
    for (std::size_t i = 0; i < data.nodes.size(); ++i) {
      const bool end = i == 0 || i + 1 == data.nodes.size();
      const ScalarJet jet = evaluate(s, data.nodes[i]);
      if (end || kind.smoothing != kFree) {
        EXPECT_EQ(jet.value, data.values[i]) << kind.degree << ' ' << i;
      }
      if (!end && kind.smoothing != kNone) continue;
      if (kind.degree >= 4) {
        EXPECT_NEAR(jet.d1, data.slopes[i], 1e-13);
      }
      if (kind.degree >= 6) {
        EXPECT_NEAR(jet.d2, data.seconds[i], 1e-11);
      }
    }
  }
}

TEST(IdSpline, DerivativesAreContinuousAsFarAsPromised) {
  for (const Kind& kind : kKinds) {
    const IdSpline s = made(random_data(12, kind.degree, 31), kind.degree, kind.smoothing);
    for (int order = 0; order <= kind.degree; ++order) {
      double jump = 0.0, size = 0.0;
      for (std::size_t i = 1; i + 1 < s.nodes.size(); ++i) {
        const double left = derivative(cell(s, i - 1), order, s.nodes[i]);
        const double right = derivative(cell(s, i), order, s.nodes[i]);
        jump = std::max(jump, std::abs(right - left));
        size = std::max(size, std::abs(right));
      }
      if (order <= kind.continuous) {
        EXPECT_LT(jump, 1e-10 * size) << kind.degree << ' ' << int(kind.smoothing) << ' ' << order;
      } else {
        EXPECT_GT(jump, 1e-3 * size) << kind.degree << ' ' << int(kind.smoothing) << ' ' << order;
      }
    }
  }
}

/// Integral of the polynomial that is really stored, in wider numbers: sum of (k!)^2/(2k+1)! times
/// the mean of both ends.
long double stored_integral(const CellPolynomial& c) {
  const long double moment[] = {1.0L, 1.0L / 6.0L, 1.0L / 30.0L, 1.0L / 140.0L};
  long double sum = 0.0L;
  for (std::size_t k = 0; k < std::size_t(c.terms); ++k) {
    sum += moment[k] * 0.5L * (static_cast<long double>(c.left[k]) + c.right[k]);
  }
  return sum * c.length;
}

TEST(IdSpline, IntegralOverEveryCellIsMetToRounding) {
  constexpr double kRounding = 1e-15;  // of the largest of what enters a cell
  for (const Kind& kind : kKinds) {
    for (unsigned seed = 0; seed < 40; ++seed) {
      const IdSplineData data = random_data(30, kind.degree, seed);
      const IdSpline s = made(data, kind.degree, kind.smoothing);
      for (std::size_t i = 0; i < data.integrals.size(); ++i) {
        const CellPolynomial c = cell(s, i);
        double size = std::abs(data.integrals[i]);
        for (std::size_t k = 0; k < std::size_t(c.terms); ++k) {
          size = std::max(size, c.length * std::max(std::abs(c.left[k]), std::abs(c.right[k])) /
                                    std::pow(4.0, double(k)));
        }
        EXPECT_LE(std::abs(double(stored_integral(c) - data.integrals[i])), kRounding * size)
            << kind.degree << ' ' << int(kind.smoothing) << ' ' << seed << ' ' << i;
        EXPECT_EQ(integral(s, s.nodes[i], s.nodes[i + 1]), data.integrals[i]);
      }
    }
  }
}

TEST(IdSpline, SmoothDataMeetTheirIntegralsTo1e15) {
  // f = 2 + sin x: no cancellation, so relative to the integral itself
  for (const Kind& kind : kKinds) {
    IdSplineData data{random_nodes(200, 0.1, 3), {}, {}};
    for (const double x : data.nodes) data.values.push_back(2.0 + std::sin(x));
    const IdSpline s = made(data, kind.degree, kind.smoothing);
    for (std::size_t i = 0; i < s.integrals.size(); ++i) {
      const double stored = double(stored_integral(cell(s, i)) / s.integrals[i] - 1.0L);
      EXPECT_LE(std::abs(stored), 1e-15) << kind.degree << ' ' << i;
      EXPECT_EQ(integral(s, s.nodes[i], s.nodes[i + 1]), s.integrals[i]);
    }
  }
}

TEST(IdSpline, ReproducesPolynomialsOfItsDegreeFromValuesAlone) {
  const Polynomial p{{0.3, -0.2, 0.17, -0.11, 0.05, -0.012, 0.003}};
  for (const Kind& kind : kKinds) {
    const Polynomial q = p.cut(kind.degree);
    IdSplineData data{random_nodes(11, 0.3, 17), {}, {}};
    for (const double x : data.nodes) data.values.push_back(q.at(x));
    const IdSpline s = made(data, kind.degree, kind.smoothing);
    double size = 0.0;
    for (const double v : data.values) size = std::max(size, std::abs(v));
    for (double x = s.nodes.front(); x < s.nodes.back(); x += 0.0625) {
      const ScalarJet jet = evaluate(s, x);
      EXPECT_NEAR(jet.value, q.at(x), 1e-12 * size) << kind.degree << ' ' << int(kind.smoothing);
      EXPECT_NEAR(jet.d1, q.at(x, 1), 1e-11 * size);
    }
    EXPECT_NEAR(integral(s, -0.3, 4.1), q.integral(-0.3, 4.1), 1e-12 * size);
  }
}

TEST(IdSpline, FreeValuesSolveThePublishedEquations) {
  // [004], system (21)
  const IdSplineData data = random_data(15, 2, 8);
  const IdSpline s = made(data, 2, kFree);
  const auto& f = s.values;
  for (std::size_t i = 1; i + 1 < f.size(); ++i) {
    const double a = s.nodes[i] - s.nodes[i - 1], b = s.nodes[i + 1] - s.nodes[i];
    EXPECT_NEAR(f[i - 1] / a + 2.0 * (1.0 / a + 1.0 / b) * f[i] + f[i + 1] / b,
                3.0 * (data.integrals[i - 1] / (a * a) + data.integrals[i] / (b * b)), 1e-12);
  }
}

TEST(IdSpline, FreeValuesAreTheSlopesOfTheCubicSplineThroughTheSums) {
  // An independent solver parametrises by chord length: let chords be as long as the steps and
  // rise in x by the integrals.
  IdSplineData data = random_data(20, 2, 77);
  std::vector<Vec2> sums = {{0.0, 0.0}};
  for (std::size_t i = 0; i < data.integrals.size(); ++i) {
    const double h = data.nodes[i + 1] - data.nodes[i];
    data.integrals[i] *= h;
    const double x = data.integrals[i];
    sums.push_back(sums.back() + Vec2{x, std::sqrt(h * h - x * x)});
  }
  const CubicSplineOptions options{SplineParameter::kChord,
                                   SplineEnd::kTangents,
                                   {data.values.front(), 0.0},
                                   {data.values.back(), 0.0}};
  const auto cubic = cubic_spline(sums, options);
  ASSERT_TRUE(cubic);
  const IdSpline s = made(data, 2, kFree);
  for (std::size_t i = 0; i < s.values.size(); ++i) {
    EXPECT_NEAR(s.values[i], cubic->slopes[i].x, 1e-12) << i;
  }
}

TEST(IdSpline, IntegralsAddUpOverAnyLimits) {
  for (const Kind& kind : kKinds) {
    const IdSpline s = made(random_data(12, kind.degree, 4), kind.degree, kind.smoothing);
    const double a = 0.5 * (s.nodes[0] + s.nodes[1]), b = s.nodes[7] + 0.01, c = s.nodes[9];
    EXPECT_NEAR(integral(s, a, b) + integral(s, b, c), integral(s, a, c), 1e-13);
    EXPECT_EQ(integral(s, c, a), -integral(s, a, c));
    // against Simpson's rule with fine steps
    const int steps = 20000;
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
      const double x0 = a + (c - a) * k / steps, x1 = a + (c - a) * (k + 1) / steps;
      sum += (x1 - x0) / 6.0 *
             (evaluate(s, x0).value + 4.0 * evaluate(s, 0.5 * (x0 + x1)).value +
              evaluate(s, x1).value);
    }
    EXPECT_NEAR(integral(s, a, c), sum, 1e-7);
  }
}

TEST(IdSpline, SortedPlacesGiveTheSameValuesInAnyOrder) {
  const IdSpline s = made(random_data(12, 4, 4), 4, kFree);
  std::vector<double> x = {-3.0, -1.0, -0.9, 0.4, 0.41, 2.0, 9.0, 30.0, 1.0, -2.0};
  x.insert(x.end(), s.nodes.begin(), s.nodes.end());
  std::vector<double> out(x.size());
  evaluate_sorted(s, x, out);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(out[i], evaluate(s, x[i]).value) << x[i];
}

TEST(IdSpline, UnitsDoNotMatter) {
  // x in thousandths: powers of two keep every rounding
  constexpr double kUnit = 1.0 / 1024.0;
  for (const Kind& kind : kKinds) {
    const IdSplineData data = random_data(12, kind.degree, 9);
    IdSplineData small = data;
    for (double& x : small.nodes) x *= kUnit;
    for (double& x : small.integrals) x *= kUnit;
    for (double& x : small.slopes) x /= kUnit;
    for (double& x : small.seconds) x /= kUnit * kUnit;
    const IdSpline a = made(data, kind.degree, kind.smoothing);
    const IdSpline b = made(small, kind.degree, kind.smoothing);
    EXPECT_EQ(a.values, b.values);
    for (const double x : {-0.5, 0.7, 3.1}) {
      EXPECT_EQ(evaluate(a, x).value, evaluate(b, x * kUnit).value);
      EXPECT_EQ(evaluate(a, x).d1, evaluate(b, x * kUnit).d1 * kUnit);
    }
  }
}

/// Error of a polynomial of the spline's own degree where two steps are `ratio` times shorter than
/// their neighbours.
double loss(const Kind& kind, double ratio) {
  const Polynomial q = Polynomial{{0.3, -0.2, 0.17, -0.11, 0.05, -0.012, 0.003}}.cut(kind.degree);
  const double h = 0.5 / ratio;
  IdSplineData data{{-1.0, -0.5, -0.5 + h, 0.0, 0.3, 0.3 + h, 0.3 + 2.5 * h, 1.0, 2.0}, {}, {}};
  for (std::size_t i = 0; i < data.nodes.size(); ++i) {
    const double x = data.nodes[i];
    data.values.push_back(q.at(x));
    if (kind.degree >= 4) data.slopes.push_back(q.at(x, 1));
    if (kind.degree >= 6) data.seconds.push_back(q.at(x, 2));
    if (i > 0) data.integrals.push_back(q.integral(data.nodes[i - 1], x));
  }
  const IdSpline s = made(data, kind.degree, kind.smoothing);
  double worst = 0.0;
  for (double x = -1.0; x < 2.0; x += 0.01) {
    worst = std::max(worst, std::abs(evaluate(s, x).value - q.at(x)));
  }
  return worst;
}

TEST(IdSpline, StepsOfDifferentLengthLoseLittle) {
  for (const Kind& kind : kKinds) {
    // kept values bring the rounding of their own
    const bool sextic_kept = kind.degree == 6 && kind.smoothing == kKept;
    EXPECT_LT(loss(kind, 10.0), 1e-14) << kind.degree << ' ' << int(kind.smoothing);
    EXPECT_LT(loss(kind, 150.0), sextic_kept ? 1e-11 : 1e-13) << kind.degree;
    EXPECT_LT(loss(kind, 5000.0), sextic_kept ? 1e-8 : 1e-11) << kind.degree;
    EXPECT_LT(loss(kind, 50'000.0), sextic_kept ? 1e-5 : 1e-8) << kind.degree;
  }
}

TEST(IdSpline, TwoNodesAreEnough) {
  for (const Kind& kind : kKinds) {
    const IdSpline s = made({{1.0, 3.0}, {5.0, 9.0}}, kind.degree, kind.smoothing);
    EXPECT_DOUBLE_EQ(evaluate(s, 2.5).value, 8.0);
    EXPECT_DOUBLE_EQ(integral(s, 1.0, 3.0), 14.0);
  }
}

ErrorCode refused(const IdSplineData& data, const IdSplineOptions& options = {}) {
  const auto s = id_spline(data, options);
  return s ? ErrorCode::kInternal : s.error().code;
}

TEST(IdSpline, RefusesWhatIsNoSpline) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const double nan = std::nan("");
  EXPECT_EQ(refused({{}, {}}), ErrorCode::kTooFewPoints);
  EXPECT_EQ(refused({{1.0}, {1.0}}), ErrorCode::kTooFewPoints);
  EXPECT_EQ(refused({{0.0, nan, 2.0}, {1.0, 1.0, 1.0}}), ErrorCode::kNotFinite);
  EXPECT_EQ(refused({{0.0, 1.0, kInf}, {1.0, 1.0, 1.0}}), ErrorCode::kNotFinite);
  EXPECT_EQ(refused({{0.0, 1.0}, {1.0, nan}}), ErrorCode::kNotFinite);
  EXPECT_EQ(refused({{0.0, 1.0}, {1.0, 1.0}, {nan}}), ErrorCode::kNotFinite);
  EXPECT_EQ(refused({{0.0, 1.0, 1.0}, {1.0, 1.0, 1.0}}), ErrorCode::kChordReversal);
  EXPECT_EQ(refused({{0.0, 2.0, 1.0}, {1.0, 1.0, 1.0}}), ErrorCode::kChordReversal);
  EXPECT_EQ(refused({{-1e308, 1e308}, {1.0, 1.0}}), ErrorCode::kSizeOutOfRange);
  EXPECT_EQ(refused({{0.0, 1e-310}, {1.0, 1.0}}), ErrorCode::kSizeOutOfRange);
  EXPECT_EQ(refused({{0.0, 1.0, 2.0}, {1e308, -1e308, 1e308}}), ErrorCode::kSizeOutOfRange);
  EXPECT_EQ(refused({{0.0, 1.0}, {1.0}}), ErrorCode::kUsage);
  EXPECT_EQ(refused({{0.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}}), ErrorCode::kUsage);
  EXPECT_EQ(refused({{0.0, 1.0}, {1.0, 1.0}, {}, {1.0, 1.0}}), ErrorCode::kUsage);
  EXPECT_EQ(refused({{0.0, 1.0}, {1.0, 1.0}}, {3, kNone}), ErrorCode::kBadOption);
  EXPECT_EQ(refused({{0.0, 1.0}, {1.0, 1.0}}, {2, kKept}), ErrorCode::kBadOption);
  EXPECT_EQ(refused({{0.0, 1.0, 1.0000099}, {1.0, 1.0, 1.0}}, {6, kFree}),
            ErrorCode::kRoundingDecides);
  const auto error = id_spline({{0.0, 2.0, 1.0}, {1.0, 1.0, 1.0}}).error();
  EXPECT_EQ(error.index, 2);
  EXPECT_EQ(error.where, "node 3");
}

TEST(IdSpline, NoNumberInNoNumberOut) {
  const IdSpline s = made({{0.0, 1.0, 2.0}, {1.0, 2.0, 0.0}}, 2, kNone);
  EXPECT_TRUE(std::isnan(evaluate(s, std::nan("")).value));
  EXPECT_TRUE(std::isnan(integral(s, std::nan(""), 1.0)));
  EXPECT_TRUE(std::isnan(integral(s, 0.0, std::nan(""))));
}

}  // namespace
}  // namespace obvid
