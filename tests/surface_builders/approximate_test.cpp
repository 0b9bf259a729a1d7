// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/approximate.h"
#include "../common/shared_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

#include "approximate_line.h"
#include "franke.h"
#include "obvid/surface_builders/internal/grid.h"
#include "sampled.h"

namespace obvid {
namespace {

Vec3 franke_point(double x, double y) { return {x, y, franke(x, y)}; }

/// Distance of a point from the surface by a raster of triangles' corners and finer rasters around
/// the nearest: needs nothing but points of the surface.
double searched_distance(const NurbsSurface& surface, Vec3 point) {
  double best = 1e300, u0 = 0.5, v0 = 0.5, half = 0.5;
  for (int level = 0; level < 14; ++level) {
    double next_u = u0, next_v = v0;
    const int steps = level == 0 ? 60 : 6;
    for (int i = -steps; i <= steps; ++i) {
      for (int j = -steps; j <= steps; ++j) {
        const double u = std::clamp(u0 + half * i / steps, 0.0, 1.0);
        const double v = std::clamp(v0 + half * j / steps, 0.0, 1.0);
        const double distance = norm(evaluate(surface, u, v).point - point);
        if (distance < best) {
          best = distance;
          next_u = u;
          next_v = v;
        }
      }
    }
    u0 = next_u;
    v0 = next_v;
    half *= level == 0 ? 2.0 / 60 : 0.4;
  }
  return best;
}

/// Every knot span has its data: Schoenberg and Whitney by a matching of B-splines to parameters.
void expect_determined(const std::vector<double>& knots, int degree,
                       const std::vector<double>& parameters) {
  const auto order = static_cast<std::size_t>(degree) + 1;
  std::size_t next = 0;
  for (std::size_t k = 0; k + order < knots.size(); ++k) {
    const bool first = k == 0, last = k + order + 1 == knots.size();
    while (next < parameters.size() && !first && parameters[next] <= knots[k]) ++next;
    ASSERT_LT(next, parameters.size()) << "B-spline " << k << " has no parameter of its own";
    ASSERT_TRUE(last || parameters[next] < knots[k + order]) << "B-spline " << k;
    ++next;
  }
}

void expect_sound(const PointGrid& grid, const ApproximatedSurface& made, double tolerance) {
  ASSERT_TRUE(check(made.surface)) << check(made.surface).error().what;
  EXPECT_LE(made.deviation, tolerance);
  EXPECT_LE(made.deviation, made.parametric_deviation * (1.0 + 1e-12));
  EXPECT_LE(made.root_mean_square, made.deviation);
  const std::vector<double> u = *grid_parameters(grid, true, Spread::kChord);
  const std::vector<double> v = *grid_parameters(grid, false, Spread::kChord);
  expect_determined(made.surface.knots_u, made.surface.degree_u, u);
  expect_determined(made.surface.knots_v, made.surface.degree_v, v);
  double parametric = 0.0;
  for (std::size_t j = 0; j < v.size(); ++j) {
    for (std::size_t i = 0; i < u.size(); ++i) {
      parametric =
          std::max(parametric, norm(evaluate(made.surface, u[i], v[j]).point - grid.at(i, j)));
    }
  }
  EXPECT_NEAR(parametric, made.parametric_deviation, 1e-12 * size_of(made.surface));
}

std::size_t controls(const ApproximatedSurface& made) { return made.surface.points.size(); }

TEST(Approximation, OfABicubicPolynomialNeedsNoInnerKnots) {
  // x and y are linear and z is flat enough for averaged chords to be uniform but for 1e-10
  const PointGrid grid = sampled(21, 17, [](double x, double y) {
    return Vec3{x, y, 1e-5 * (x * x * x * y * y - y * y * y + x * y)};
  });
  const Result<ApproximatedSurface> made = approximated(grid, 1e-9);
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_EQ(controls(*made), 16u);
  expect_sound(grid, *made, 1e-9);
}

TEST(Approximation, StaysWithinEveryToleranceAndKnotsGrowWithIt) {
  const PointGrid grid = sampled(61, 51, franke_point);
  std::size_t last = 0;
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    const Result<ApproximatedSurface> made = approximated(grid, tolerance);
    ASSERT_TRUE(made) << made.error().what;
    expect_sound(grid, *made, tolerance);
    EXPECT_GT(controls(*made), last);
    last = controls(*made);
    if (tolerance >= 1e-3) {
      EXPECT_LT(last * 6, grid.points.size()) << tolerance;
    }
  }
}

TEST(Approximation, StatesTheDistanceThatASearchFinds) {
  const PointGrid grid = sampled(31, 31, franke_point);
  const ApproximatedSurface made = *approximated(grid, 5e-3);
  double worst = 0.0, squares = 0.0;
  std::size_t counted = 0;
  for (std::size_t k = 0; k < grid.points.size(); k += 7) {
    const double distance = searched_distance(made.surface, grid.points[k]);
    worst = std::max(worst, distance);
    squares += distance * distance;
    ++counted;
  }
  EXPECT_LE(worst, made.deviation * (1.0 + 1e-6));
  EXPECT_GT(worst, 0.5 * made.deviation);  // a seventh of the points comes near the worst one
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(counted)), made.root_mean_square,
              0.3 * made.root_mean_square);
}

TEST(Approximation, PutsKnotsWhereTheShapeIs) {
  // a step at x = 0.7, nothing along y
  const PointGrid grid = sampled(101, 21, [](double x, double y) {
    return Vec3{x, y, 0.05 * std::tanh(40 * (x - 0.7))};
  });
  const ApproximatedSurface made = *approximated(grid, 1e-4);
  EXPECT_EQ(made.surface.count_v(), 4u);
  const auto near_step = std::count_if(made.surface.knots_u.begin(), made.surface.knots_u.end(),
                                       [](double t) { return std::abs(t - 0.7) < 0.2; });
  const auto far_away = static_cast<std::ptrdiff_t>(made.surface.knots_u.size()) - 8 - near_step;
  EXPECT_GE(near_step, 8);
  EXPECT_LT(2 * far_away, near_step);
}

TEST(Approximation, TakesNoiseAwayThatInterpolationKeeps) {
  constexpr double kSigma = 0.01;
  std::mt19937_64 random(20);
  std::normal_distribution<double> noise(0.0, kSigma);
  PointGrid grid = sampled(81, 81, franke_point);
  for (Vec3& p : grid.points) p.z += noise(random);
  const Result<ApproximatedSurface> made = approximated(grid, 4.5 * kSigma);
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_LT(controls(*made) * 10, grid.points.size());
  const auto error = [](const NurbsSurface& surface) {
    double sum = 0.0;
    int count = 0;
    for (double u = 0.0; u <= 1.0; u += 0.0173) {
      for (double v = 0.0; v <= 1.0; v += 0.0173) {
        const Vec3 p = evaluate(surface, u, v).point;
        sum += std::pow(p.z - franke(p.x, p.y), 2);
        ++count;
      }
    }
    return std::sqrt(sum / count);
  };
  EXPECT_LT(error(made->surface), 0.7 * error(*interpolated(grid)));
  // what is left at the points is the noise, not more and not much less
  EXPECT_NEAR(made->root_mean_square, kSigma, 0.4 * kSigma);
}

TEST(Approximation, BecomesInterpolationWhereTheDataCarryNoMore) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> rough(-0.2, 0.2);
  PointGrid grid = sampled(13, 11, [](double x, double y) { return Vec3{x, y, 0}; });
  for (Vec3& p : grid.points) p.z = rough(random);
  const Result<ApproximatedSurface> made = approximated(grid, 1e-12);
  ASSERT_TRUE(made) << made.error().what;
  expect_sound(grid, *made, 1e-12);
  EXPECT_EQ(controls(*made), grid.points.size());
}

TEST(Approximation, DoesNotSwingBetweenThePointsOfRoughUnevenGrids) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> rough(-1.0, 1.0);
  for (const std::size_t n : {12u, 30u}) {
    for (const double part : {0.9, 0.5, 0.05, 0.01}) {
      std::vector<double> at;
      for (std::size_t i = 0; i < n; ++i) {
        at.push_back((static_cast<double>(i) + 0.4 * rough(random)) / static_cast<double>(n));
      }
      PointGrid grid{n, n, {}, "rough"};
      for (std::size_t k = 0; k < n * n; ++k) {
        grid.points.push_back({at[k % n], at[k / n], 0.1 * rough(random)});
      }
      const Result<ApproximatedSurface> made = approximated(grid, part * 0.1);
      ASSERT_TRUE(made) << made.error().what;
      double swing = 0.0;
      for (double u = 0.0; u <= 1.0; u += 0.004) {
        for (double v = 0.0; v <= 1.0; v += 0.004) {
          swing = std::max(swing, std::abs(evaluate(made->surface, u, v).point.z));
        }
      }
      EXPECT_LT(swing, 10 * 0.1) << n << ' ' << part;
    }
  }
}

TEST(Approximation, TakesGridsOfAnyCounts) {
  for (const std::size_t nu : {2u, 3u, 4u, 5u, 23u}) {
    for (const std::size_t nv : {2u, 3u, 4u, 9u}) {
      const PointGrid grid = sampled(nu, nv, [](double x, double y) {
        return Vec3{x * x + x, 2 * y, std::sin(5 * x + y)};
      });
      for (const double tolerance : {1.0, 1e-3, 1e-9}) {
        const Result<ApproximatedSurface> made = approximated(grid, tolerance);
        ASSERT_TRUE(made) << made.error().what;
        expect_sound(grid, *made, tolerance);
      }
    }
  }
}

TEST(Approximation, IsTheSameAtAnySizeAndPlace) {
  const ApproximatedSurface plain = *approximated(sampled(31, 27, franke_point), 1e-3);
  for (const double scale : {1e-9, 1e9}) {
    const ApproximatedSurface scaled =
        *approximated(sampled(31, 27,
                              [&](double x, double y) {
                                return scale * (franke_point(x, y) + Vec3{5, 5, 5});
                              }),
                      1e-3 * scale);
    ASSERT_EQ(controls(scaled), controls(plain));
    for (std::size_t i = 0; i < controls(plain); ++i) {
      EXPECT_LT(norm(scaled.surface.points[i] / scale - plain.surface.points[i] - Vec3{5, 5, 5}),
                1e-11);
    }
  }
}

PointGrid egg_grid(std::size_t around, std::size_t up) {
  PointGrid egg = sampled(around, up, [&](double x, double y) {
    const double a = 2 * std::numbers::pi * x, b = std::numbers::pi * (y - 0.5);
    const double r = std::cos(b) * (1.0 + 0.1 * std::cos(3 * a));
    return Vec3{r * std::cos(a), r * std::sin(a), 2 * std::sin(b)};
  });
  for (std::size_t i = 0; i < around; ++i) {
    egg.points[i] = {0, 0, -2};
    egg.points[(up - 1) * around + i] = {0, 0, 2};
  }
  for (std::size_t j = 0; j < up; ++j) {
    egg.points[j * around + around - 1] = egg.points[j * around];
  }
  return egg;
}

PointGrid turned(const PointGrid& grid) {
  PointGrid out{grid.count_v, grid.count_u, {}, grid.name};
  for (std::size_t i = 0; i < grid.count_u; ++i) {
    for (std::size_t j = 0; j < grid.count_v; ++j) out.points.push_back(grid.at(i, j));
  }
  return out;
}

void expect_closed_egg(const NurbsSurface& s) {
  const std::size_t nu = s.count_u(), nv = s.count_v();
  for (std::size_t i = 0; i < nu; ++i) {
    EXPECT_LT(norm(s.points[i] - Vec3{0, 0, -2}), 1e-14);
    EXPECT_LT(norm(s.points[(nv - 1) * nu + i] - Vec3{0, 0, 2}), 1e-14);
  }
  for (std::size_t j = 0; j < nv; ++j) {
    EXPECT_LT(norm(s.points[j * nu] - s.points[j * nu + nu - 1]), 1e-14);
  }
}

TEST(Approximation, KeepsPolesAndSeamsExactly) {
  const PointGrid egg = egg_grid(61, 31);
  const Result<ApproximatedSurface> made = approximated(egg, 1e-3);
  ASSERT_TRUE(made) << made.error().what;
  expect_sound(egg, *made, 1e-3);
  EXPECT_LT(controls(*made) * 2, egg.points.size());
  expect_closed_egg(made->surface);
  const Result<ApproximatedSurface> other = approximated(turned(egg), 1e-3);
  ASSERT_TRUE(other) << other.error().what;
  expect_sound(turned(egg), *other, 1e-3);
  expect_closed_egg(transposed(other->surface));
}

TEST(Approximation, ReportsProgressThatAscendsToTheEnd) {
  double last = -1.0;
  bool ascends = true;
  const auto listen = [&](std::string_view, double part) {
    ascends = ascends && part >= last && part <= 1.0;
    last = part;
  };
  ASSERT_TRUE(approximated(sampled(41, 41, franke_point), 1e-4, listen));
  EXPECT_TRUE(ascends);
  EXPECT_EQ(last, 1.0);
}

TEST(Approximation, RefusesWhatItCannotUse) {
  const PointGrid good = sampled(5, 5, franke_point);
  for (const double tolerance : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_EQ(approximated(good, tolerance).error().code, ErrorCode::kBadOption);
  }
  PointGrid bad = good;
  bad.points.pop_back();
  EXPECT_EQ(approximated(bad, 1.0).error().code, ErrorCode::kUsage);
  bad = good;
  bad.points[7].y = std::nan("");
  EXPECT_EQ(approximated(bad, 1.0).error().code, ErrorCode::kNotFinite);
  bad = sampled(4, 4, [](double, double) { return Vec3{1, 2, 3}; });
  EXPECT_EQ(approximated(bad, 1.0).error().code, ErrorCode::kOutOfOrder);
  // below rounding nothing can be promised
  EXPECT_EQ(approximated(sampled(9, 9, franke_point), 1e-30).error().code,
            ErrorCode::kToleranceNotReached);
}

TEST(SplineLine, FitsTheLineOfLeastSquares) {
  // y = a + b t through (0, 1), (1/3, 0), (2/3, 2), (1, 5) as a cubic without knots has no error;
  // with 7 points the residual is perpendicular to all B-splines
  std::vector<double> t;
  Rows data{1, {}};
  for (int i = 0; i < 7; ++i) {
    t.push_back(i / 6.0);
    data.points.push_back({t.back(), i % 3 * 1.0, i % 2 * 1.0});
  }
  const SplineLine line(t);
  Rows fitted;
  ASSERT_TRUE(line.fit(data, {}, fitted));
  const Rows values = line.values(fitted);
  for (std::size_t k = 0; k < 4; ++k) {
    Vec3 sum;
    for (std::size_t i = 0; i < t.size(); ++i) {
      sum = sum +
            basis_at(3, line.knots(), t[i], 0).value[0][k] * (values.points[i] - data.points[i]);
    }
    EXPECT_LT(norm(sum), 1e-14) << k;
  }
}

std::vector<std::vector<double>> matrix_in(const std::filesystem::path& path, bool header) {
  std::vector<std::vector<double>> rows;
  std::ifstream file(path);
  std::string text;
  if (header) std::getline(file, text);
  while (std::getline(file, text)) {
    std::replace(text.begin(), text.end(), ',', ' ');
    std::istringstream line(text);
    std::vector<double> row;
    for (double x = 0.0; line >> x;) row.push_back(x);
    if (!row.empty()) rows.push_back(std::move(row));
  }
  return rows;
}

TEST(Approximation, OfTheVolcanoHasFarFewerControlPointsThanHeights) {
  SKIP_WITHOUT("surfaces/volcano.csv");
  const auto path = shared_data() / "surfaces/volcano.csv";
  const auto heights = matrix_in(path, true);
  ASSERT_EQ(heights.size(), 87u);
  PointGrid grid{heights[0].size(), heights.size(), {}, "volcano"};
  ASSERT_EQ(grid.count_u, 61u);
  for (std::size_t j = 0; j < grid.count_v; ++j) {
    for (std::size_t i = 0; i < grid.count_u; ++i) {  // 10 m apart, heights in whole metres
      grid.points.push_back(
          {10.0 * static_cast<double>(i), 10.0 * static_cast<double>(j), heights[j][i]});
    }
  }
  std::size_t last = 0;
  for (const double tolerance : {10.0, 5.0, 2.0}) {
    const Result<ApproximatedSurface> made = approximated(grid, tolerance);
    ASSERT_TRUE(made) << made.error().what;
    expect_sound(grid, *made, tolerance);
    EXPECT_GT(controls(*made), last);
    last = controls(*made);
    if (tolerance >= 5.0) {
      EXPECT_LT(4 * last, grid.points.size()) << tolerance;
    }
  }
}

TEST(Approximation, OfPublicHullsStaysWithinTheTolerance) {
  SKIP_WITHOUT("hulls_grids");
  const auto folder = shared_data() / "hulls_grids";
  for (const std::string name : {"Series60Offset", "TrawlerOffset"}) {
    const auto x = matrix_in(folder / (name + "_x.dat"), false);
    const auto y = matrix_in(folder / (name + "_y.dat"), false);
    const auto z = matrix_in(folder / (name + "_z.dat"), false);
    ASSERT_FALSE(x.empty()) << name;
    PointGrid grid{x[0].size(), x.size(), {}, name};
    for (std::size_t j = 0; j < grid.count_v; ++j) {
      for (std::size_t i = 0; i < grid.count_u; ++i) {
        grid.points.push_back({x[j][i], y[j][i], z[j][i]});
      }
    }
    Vec3 low = grid.points[0], high = low;
    for (const Vec3& p : grid.points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    for (const double part : {1e-2, 1e-3, 1e-5}) {
      const double tolerance = part * norm(high - low);
      const Result<ApproximatedSurface> made = approximated(grid, tolerance);
      ASSERT_TRUE(made) << name << ": " << made.error().what;
      expect_sound(grid, *made, tolerance);
    }
  }
}

}  // namespace
}  // namespace obvid
