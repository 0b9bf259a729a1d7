// SPDX-License-Identifier: Apache-2.0
#include "bulge_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "obvid/core/internal/parallel.h"

namespace obvid::toolpath {
namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();
constexpr double kMapCellOfRadius = 0.5, kLongestOfRadius = 0.5;
constexpr double kMostMapCells = 4e6;
constexpr std::size_t kVerticesTogether = 512;  // for the thread that takes them
constexpr double kBulgeMargin = 1.5;            // for what lies between the vertices of a triangle
constexpr double kUprightBulge = 0.02;          // z of normals: beyond, heights say nothing

/// How the height bends, seen from above: second derivatives by x and y.
struct HeightBend {
  double xx = 0.0, xy = 0.0, yy = 0.0;
};

/// Greatest bulge of a height whose normal stands up by nz: along one direction or all.
double bulge_of(const HeightBend& b, double nz, const std::optional<Vec2>& d) {
  double hollow = 0.0;  // least second derivative
  if (d) {
    hollow = b.xx * d->x * d->x + 2.0 * b.xy * d->x * d->y + b.yy * d->y * d->y;
  } else {
    const double half = 0.5 * (b.xx - b.yy);
    hollow = 0.5 * (b.xx + b.yy) - std::sqrt(half * half + b.xy * b.xy);
  }
  return std::max(0.0, -hollow) * nz;
}

double bulge_at(const NurbsSurface& surface, double u, double v, const std::optional<Vec2>& d) {
  const SurfaceJet jet = evaluate(surface, u, v);
  const Vec3 across = cross(jet.du, jet.dv);
  const double size = norm(across);
  if (!(std::abs(across.z) > kUprightBulge * size)) return kEndless;
  const Vec3 n = (across.z < 0.0 ? -1.0 : 1.0) / size * across;
  // heights bend as the surface does along the ways of u and v that lie straight seen from above
  const double l = dot(n, jet.duu) / n.z, m = dot(n, jet.duv) / n.z, k = dot(n, jet.dvv) / n.z;
  const double det = jet.du.x * jet.dv.y - jet.du.y * jet.dv.x;
  const Vec2 by_x{jet.dv.y / det, -jet.du.y / det}, by_y{-jet.dv.x / det, jet.du.x / det};
  const auto bend = [&](Vec2 p, Vec2 q) {
    return l * p.x * q.x + m * (p.x * q.y + p.y * q.x) + k * p.y * q.y;
  };
  return bulge_of({bend(by_x, by_x), bend(by_x, by_y), bend(by_y, by_y)}, n.z, d);
}

/// Of each triangle of the field.
std::vector<double> bulges(const Part& part, const std::optional<Vec2>& direction,
                           std::size_t threads) {
  const auto& triangles = part.field().triangles();
  const auto& meshes = part.meshes();
  std::vector<std::vector<double>> of_vertex(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const auto& vertices = meshes[m].vertices;
    of_vertex[m].resize(vertices.size());
    in_lots(vertices.size(), kVerticesTogether, threads, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) {
        of_vertex[m][i] =
            bulge_at(part.model().patches[m].surface, vertices[i].u, vertices[i].v, direction);
      }
    });
  }
  std::vector<double> out;
  out.reserve(triangles.size());
  for (const FieldTriangle& t : triangles) {
    double most = t.rough ? kEndless : 0.0;
    for (const std::uint32_t k : meshes[t.mesh].triangles[t.number]) {
      most = std::max(most, kBulgeMargin * of_vertex[t.mesh][k]);
    }
    out.push_back(most);
  }
  return out;
}

}  // namespace

BulgeMap::BulgeMap(const Part& part, std::optional<Vec2> direction, std::size_t threads)
    : longest_(kLongestOfRadius * part.cutter().radius) {
  const double r = part.cutter().radius + part.allowance();  // of what rests on the part
  const Vec3 low = part.field().low(), high = part.field().high();
  const double over = 2.0 * r + longest_;
  const double dx = high.x - low.x + 2.0 * over, dy = high.y - low.y + 2.0 * over;
  size_ = std::max(kMapCellOfRadius * r, std::sqrt(dx * dy / kMostMapCells));
  low_ = {low.x - over, low.y - over};
  nx_ = static_cast<std::size_t>(dx / size_) + 1;
  ny_ = static_cast<std::size_t>(dy / size_) + 1;
  cells_.assign(nx_ * ny_, 0.0F);
  take(part, bulges(part, direction, threads));
  // from anywhere in a cell to all that lies under the cutter on its way
  widen(static_cast<std::size_t>(std::ceil((r + 0.5 * longest_) / size_)));
}

void BulgeMap::take(const Part& part, const std::vector<double>& of_triangle) {
  const auto& triangles = part.field().triangles();
  const auto cell = [&](double value, double low, std::size_t count) {
    return static_cast<std::size_t>(
        std::clamp((value - low) / size_, 0.0, static_cast<double>(count - 1)));
  };
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i].corners;
    const auto most = static_cast<float>(of_triangle[i]);
    const std::size_t x1 = cell(std::max({t[0].x, t[1].x, t[2].x}), low_.x, nx_);
    const std::size_t y1 = cell(std::max({t[0].y, t[1].y, t[2].y}), low_.y, ny_);
    const std::size_t x0 = cell(std::min({t[0].x, t[1].x, t[2].x}), low_.x, nx_);
    for (std::size_t y = cell(std::min({t[0].y, t[1].y, t[2].y}), low_.y, ny_); y <= y1; ++y) {
      for (std::size_t x = x0; x <= x1; ++x) {
        cells_[y * nx_ + x] = std::max(cells_[y * nx_ + x], most);
      }
    }
  }
}

/// Each cell gets the greatest of those up to `by` cells away, in x and then in y.
void BulgeMap::widen(std::size_t by) {
  const auto pass = [&](std::size_t lines, std::size_t length, std::size_t line_step,
                        std::size_t step) {
    std::vector<float> line(length);
    for (std::size_t k = 0; k < lines; ++k) {
      for (std::size_t i = 0; i < length; ++i) line[i] = cells_[k * line_step + i * step];
      for (std::size_t i = 0; i < length; ++i) {
        float most = 0.0F;
        const std::size_t end = std::min(length - 1, i + by);
        for (std::size_t j = i > by ? i - by : 0; j <= end; ++j) most = std::max(most, line[j]);
        cells_[k * line_step + i * step] = most;
      }
    }
  };
  pass(ny_, nx_, nx_, 1);
  pass(nx_, ny_, 1, nx_);
}

double BulgeMap::at(Vec2 middle) const {
  const double x = (middle.x - low_.x) / size_, y = (middle.y - low_.y) / size_;
  const bool inside =
      x >= 0.0 && y >= 0.0 && x < static_cast<double>(nx_) && y < static_cast<double>(ny_);
  if (!inside) return static_cast<double>(kEndless);
  return static_cast<double>(
      cells_[static_cast<std::size_t>(y) * nx_ + static_cast<std::size_t>(x)]);
}

}  // namespace obvid::toolpath
