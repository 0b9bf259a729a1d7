// SPDX-License-Identifier: Apache-2.0
#include "space/depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace obvid::picture {
namespace {

/// Pixels of the raster per px of the sheet.
constexpr double kFine = 2.0;
/// A line this far behind a facet still lies on it, px.
constexpr double kOnSurface = 1.2;
constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

}  // namespace

DepthBuffer::DepthBuffer(double width, double height)
    : width_(static_cast<std::size_t>(std::ceil(kFine * width)) + 2),
      height_(static_cast<std::size_t>(std::ceil(kFine * height)) + 2),
      depth_(width_ * height_, -HUGE_VAL),
      owner_(width_ * height_, kNobody) {}

/// Every pixel whose middle lies in the triangle; on a border that of the triangle whose inner side
/// is to the right or below, so that neighbours share none.
template <class Visit>
void DepthBuffer::pixels(const std::array<Vec3, 3>& triangle, Visit&& visit) const {
  Vec3 a = kFine * triangle[0], b = kFine * triangle[1], c = kFine * triangle[2];
  double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (area < 0.0) {
    std::swap(b, c);
    area = -area;
  }
  if (!(area > 0.0)) return;
  const auto bound = [](double v, std::size_t most) {
    return static_cast<std::size_t>(std::clamp(v, 0.0, static_cast<double>(most)));
  };
  const std::size_t left = bound(std::floor(std::min({a.x, b.x, c.x})), width_);
  const std::size_t right = bound(std::ceil(std::max({a.x, b.x, c.x})), width_);
  const std::size_t top = bound(std::floor(std::min({a.y, b.y, c.y})), height_);
  const std::size_t bottom = bound(std::ceil(std::max({a.y, b.y, c.y})), height_);
  const auto inside = [](Vec3 p, Vec3 q, double x, double y, double& weight) {
    weight = (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
    const bool owns = q.y < p.y || (q.y == p.y && q.x > p.x);
    return weight > 0.0 || (weight == 0.0 && owns);
  };
  for (std::size_t j = top; j < bottom; ++j) {
    for (std::size_t i = left; i < right; ++i) {
      const double x = static_cast<double>(i) + 0.5, y = static_cast<double>(j) + 0.5;
      double wa = 0.0, wb = 0.0, wc = 0.0;
      if (!inside(b, c, x, y, wa) || !inside(c, a, x, y, wb) || !inside(a, b, x, y, wc)) continue;
      visit(j * width_ + i, (wa * a.z + wb * b.z + wc * c.z) / (area * kFine));
    }
  }
}

void DepthBuffer::add(const Quad& f) {
  const std::uint32_t number = facets_++;
  for (const auto& triangle : {std::array{f[0], f[1], f[2]}, std::array{f[0], f[2], f[3]}}) {
    pixels(triangle, [&](std::size_t pixel, double z) {
      if (z <= depth_[pixel]) return;
      depth_[pixel] = z;
      owner_[pixel] = number;
    });
  }
}

std::vector<DepthBuffer::Seen> DepthBuffer::judge(const std::vector<Quad>& facets) const {
  std::vector<Seen> seen;
  seen.reserve(facets.size());
  for (std::size_t n = 0; n < facets.size(); ++n) {
    const Quad& f = facets[n];
    std::size_t covered = 0, owned = 0;
    for (const auto& triangle : {std::array{f[0], f[1], f[2]}, std::array{f[0], f[2], f[3]}}) {
      pixels(triangle, [&](std::size_t pixel, double) {
        ++covered;
        if (owner_[pixel] == n) ++owned;
      });
    }
    if (covered == 0) {  // smaller than a pixel, or seen from its edge
      const auto [low, high] = std::minmax({f[0].x, f[1].x, f[2].x, f[3].x});
      const auto [top, bottom] = std::minmax({f[0].y, f[1].y, f[2].y, f[3].y});
      const bool there =
          !beside({low, top, 0.0}, {high, bottom, 0.0}) && sees(0.25 * (f[0] + f[1] + f[2] + f[3]));
      seen.push_back(there ? Seen::kPartly : Seen::kHidden);
    } else {
      seen.push_back(owned == covered ? Seen::kWhole : owned > 0 ? Seen::kPartly : Seen::kHidden);
    }
  }
  return seen;
}

void DepthBuffer::draw(const std::vector<Quad>& facets, const std::vector<std::size_t>& order) {
  drawn_.assign(owner_.size(), kNobody);
  for (const std::size_t n : order) {
    const Quad& f = facets[n];
    for (const auto& triangle : {std::array{f[0], f[1], f[2]}, std::array{f[0], f[2], f[3]}}) {
      pixels(triangle,
             [&](std::size_t pixel, double) { drawn_[pixel] = static_cast<std::uint32_t>(n); });
    }
  }
}

bool DepthBuffer::wronged(std::size_t facet, Vec2 at) const {
  const double x = std::floor(kFine * at.x), y = std::floor(kFine * at.y);
  if (!(x >= 0.0 && y >= 0.0 && x < static_cast<double>(width_) &&
        y < static_cast<double>(height_))) {
    return false;
  }
  const std::size_t pixel = static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
  return owner_[pixel] == facet && drawn_[pixel] != facet;
}

bool DepthBuffer::beside(Vec3 a, Vec3 b) const {
  const double width = static_cast<double>(width_) / kFine;
  const double height = static_cast<double>(height_) / kFine;
  return std::max(a.x, b.x) < 0.0 || std::min(a.x, b.x) > width || std::max(a.y, b.y) < 0.0 ||
         std::min(a.y, b.y) > height;
}

bool DepthBuffer::sees(Vec3 p) const {
  const double x = std::floor(kFine * p.x), y = std::floor(kFine * p.y);
  if (!(x >= 1.0 && y >= 1.0 && x + 1.0 < static_cast<double>(width_) &&
        y + 1.0 < static_cast<double>(height_))) {
    return true;
  }
  const std::size_t pixel = static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
  // the farthest of the neighbours: beside an outline, and where the surface is steep
  double farthest = HUGE_VAL;
  for (const std::size_t row : {pixel - width_, pixel, pixel + width_}) {
    farthest = std::min({farthest, depth_[row - 1], depth_[row], depth_[row + 1]});
  }
  return p.z >= farthest - kOnSurface;
}

}  // namespace obvid::picture
