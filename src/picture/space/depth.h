// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "obvid/geom/vec2.h"
#include "obvid/geom/vec3.h"

namespace obvid::picture {

/// What stands in front, on a raster finer than the sheet. Places are in px with z towards the
/// viewer (`PictureCamera::project`).
class DepthBuffer {
 public:
  using Quad = std::array<Vec3, 4>;

  DepthBuffer(double width, double height);
  /// The next facet; its number is how many came before.
  void add(const Quad& facet);

  enum class Seen { kWhole, kPartly, kHidden };
  /// After all facets are there.
  [[nodiscard]] std::vector<Seen> judge(const std::vector<Quad>& facets) const;
  /// Facets are drawn over each other in this order.
  void draw(const std::vector<Quad>& facets, const std::vector<std::size_t>& order);
  /// Whether this facet should be seen at a place, and another one was drawn over it: where facets
  /// cross each other no order is right.
  [[nodiscard]] bool wronged(std::size_t facet, Vec2 at) const;
  /// Whether all between two places lies beside the sheet.
  [[nodiscard]] bool beside(Vec3 a, Vec3 b) const;
  /// Whether a point on or before a facet can be seen.
  [[nodiscard]] bool sees(Vec3 p) const;

 private:
  template <class Visit>
  void pixels(const std::array<Vec3, 3>& triangle, Visit&& visit) const;

  std::size_t width_ = 0, height_ = 0;  ///< in pixels of the raster
  std::uint32_t facets_ = 0;
  std::vector<double> depth_;
  std::vector<std::uint32_t> owner_;
  std::vector<std::uint32_t> drawn_;
};

}  // namespace obvid::picture
