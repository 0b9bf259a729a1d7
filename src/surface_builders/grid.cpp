// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "obvid/surface/internal/collocation.h"

namespace obvid {
namespace {

Result<void> check_grid(const PointGrid& grid) {
  if (grid.points.size() != grid.count_u * grid.count_v) {
    return error(ErrorCode::kUsage, fmt::format("{} points do not make {} rows of {}",
                                                grid.points.size(), grid.count_v, grid.count_u))
        .value(static_cast<double>(grid.points.size()));
  }
  if (grid.count_u < 2 || grid.count_v < 2) {
    return error(ErrorCode::kTooFewPoints, fmt::format("a grid of {} x {} points spans no surface",
                                                       grid.count_u, grid.count_v))
        .hint("give at least 2 x 2 points");
  }
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    if (is_finite(grid.points[i])) continue;
    return error(ErrorCode::kNotFinite, fmt::format("point {} of row {} is not finite",
                                                    i % grid.count_u + 1, i / grid.count_u + 1))
        .point(i);
  }
  return {};
}

double spread_of(double chord, Spread spread) {
  return spread == Spread::kCentripetal ? std::sqrt(chord) : chord;
}

std::vector<double> uniform(std::size_t count) {
  std::vector<double> at(count);
  for (std::size_t i = 0; i < count; ++i) {
    at[i] = static_cast<double>(i) / static_cast<double>(count - 1);
  }
  return at;
}

/// Where point i of a line stands: first + i * stride.
struct Lines {
  std::size_t count, length;  ///< lines, points in each
  std::size_t next_line, stride;
};

Lines lines_along(const PointGrid& grid, bool along_u) {
  return along_u ? Lines{grid.count_v, grid.count_u, grid.count_u, 1}
                 : Lines{grid.count_u, grid.count_v, 1, grid.count_u};
}

/// Each line's accumulated chords scaled to 1, averaged; lines that shrink to a point do not count.
Result<std::vector<double>> averaged_chords(const PointGrid& grid, bool along_u, Spread spread) {
  const Lines lines = lines_along(grid, along_u);
  std::vector<double> sum(lines.length, 0.0), at(lines.length, 0.0);
  std::size_t counted = 0;
  for (std::size_t k = 0; k < lines.count; ++k) {
    const Vec3* point = grid.points.data() + k * lines.next_line;
    for (std::size_t i = 1; i < lines.length; ++i) {
      const double chord = norm(point[i * lines.stride] - point[(i - 1) * lines.stride]);
      at[i] = at[i - 1] + spread_of(chord, spread);
    }
    if (!(at.back() > 0.0)) continue;
    ++counted;
    for (std::size_t i = 1; i < lines.length; ++i) sum[i] += at[i] / at.back();
  }
  for (std::size_t i = 1; i < lines.length; ++i) {
    sum[i] = i + 1 == lines.length
                 ? 1.0
                 : sum[i] / static_cast<double>(std::max<std::size_t>(counted, 1));
    if (counted > 0 && sum[i] > sum[i - 1]) continue;
    return error(ErrorCode::kOutOfOrder, fmt::format("{} {} and {} are the same points",
                                                     along_u ? "columns" : "rows", i, i + 1))
        .hint("leave one of them out")
        .point(i);
  }
  return sum;
}

std::vector<Vec3> transposed_points(const std::vector<Vec3>& points, std::size_t width) {
  const std::size_t rows = points.size() / width;
  constexpr std::size_t kTile = 16;  // both sides of a tile stay in the nearest cache
  std::vector<Vec3> out(points.size());
  for (std::size_t j0 = 0; j0 < rows; j0 += kTile) {
    for (std::size_t i0 = 0; i0 < width; i0 += kTile) {
      for (std::size_t j = j0; j < std::min(rows, j0 + kTile); ++j) {
        for (std::size_t i = i0; i < std::min(width, i0 + kTile); ++i) {
          out[i * rows + j] = points[j * width + i];
        }
      }
    }
  }
  return out;
}

std::vector<double> uniform_knots(std::size_t count, std::size_t degree) {
  std::vector<double> knots(degree + 1, 0.0);
  const std::size_t spans = count - degree;
  for (std::size_t i = 1; i < spans; ++i) {
    knots.push_back(static_cast<double>(i) / static_cast<double>(spans));
  }
  knots.insert(knots.end(), degree + 1, 1.0);
  return knots;
}

}  // namespace

Result<std::vector<double>> grid_parameters(const PointGrid& grid, bool along_u, Spread spread) {
  OBVID_TRY(check_grid(grid));
  if (spread == Spread::kUniform) return uniform(along_u ? grid.count_u : grid.count_v);
  return averaged_chords(grid, along_u, spread);
}

Result<NurbsSurface> interpolated(const PointGrid& grid, Spread spread) {
  const auto u = grid_parameters(grid, true, spread);
  OBVID_TRY(u);
  const auto v = grid_parameters(grid, false, spread);
  OBVID_TRY(v);
  const Result<Collocation> along_u = cubic_collocation(*u);
  OBVID_TRY(along_u);
  const Result<Collocation> along_v = cubic_collocation(*v);
  OBVID_TRY(along_v);
  std::vector<Vec3> points = grid.points;
  along_v->matrix.solve_rows(points, grid.count_u);
  points = transposed_points(points, grid.count_u);
  along_u->matrix.solve_rows(points, grid.count_v);
  points = transposed_points(points, grid.count_v);
  return NurbsSurface{along_u->degree, along_v->degree,   along_u->knots,
                      along_v->knots,  std::move(points), {}};
}

Result<NurbsSurface> from_control_points(const PointGrid& grid, int degree_u, int degree_v) {
  OBVID_TRY(check_grid(grid));
  if (std::min(degree_u, degree_v) < 1 || std::max(degree_u, degree_v) > kMaxNurbsDegree) {
    return error(ErrorCode::kBadOption, fmt::format("degrees {} and {} are not both in 1 to {}", degree_u, degree_v, kMaxNurbsDegree))
        .value(static_cast<double>(std::max(degree_u, degree_v)));
  }
  const auto degree = [](int wanted, std::size_t count) {
    return std::min(static_cast<std::size_t>(wanted), count - 1);
  };
  const std::size_t p = degree(degree_u, grid.count_u), q = degree(degree_v, grid.count_v);
  return NurbsSurface{static_cast<int>(p),
                      static_cast<int>(q),
                      uniform_knots(grid.count_u, p),
                      uniform_knots(grid.count_v, q),
                      grid.points,
                      {}};
}

}  // namespace obvid
