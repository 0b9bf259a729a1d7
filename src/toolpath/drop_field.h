// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "drop_triangle.h"
#include "large_list.h"
#include "obvid/geom/internal/box.h"
#include "obvid/mesh/mesh.h"

namespace obvid::toolpath {

/// A triangle of a model, where it comes from and which of its sides nothing continues.
struct FieldTriangle {
  Triangle corners;
  std::uint32_t mesh = 0;
  std::uint32_t number = 0;
  std::uint8_t open = 0;  ///< bit per feature as numbered in `Rest` (edges 1..3, corners 4..6)
  /// Features that no cutter rests on, or that are those of another triangle, too.
  std::uint8_t skipped = 0;
  bool rough = false;  ///< the part ends at one of its edges, or has an edge there
};

struct FieldRest {
  Rest rest;
  std::uint32_t triangle = 0;  ///< of `DropField::triangles`

  friend bool operator<(const FieldRest& a, const FieldRest& b) {
    return a.rest.tip_z < b.rest.tip_z;
  }
};

struct FieldHeight {
  double z = 0.0;
  std::uint32_t triangle = 0;
  std::array<double, 3> weights{};
};

/// All triangles of a model in a tree of boxes with leaning lids: what a cutter coming down meets
/// first, in about O(log n) for each place. `triangles` stay in the tree's order.
class DropField {
 public:
  DropField(const std::vector<Mesh>& meshes, std::size_t threads);

  [[nodiscard]] const LargeList<FieldTriangle>& triangles() const { return triangles_; }
  /// Highest rest of the tip on this axis; nothing: the cutter meets nothing.
  [[nodiscard]] std::optional<FieldRest> drop(const CutterShape& cutter, Vec2 axis) const;
  /// Highest point over a place.
  [[nodiscard]] std::optional<FieldHeight> height(Vec2 place) const;
  [[nodiscard]] Vec3 low() const { return box_.low; }
  [[nodiscard]] Vec3 high() const { return box_.high; }

 private:
  struct Box {
    Vec2 low, high;
    double top = 0.0;
    /// All below z = lid + lean_x x + lean_y y, too; that plane's slope, and sqrt(1 + slope^2) - 1.
    double lid = 0.0, lean_x = 0.0, lean_y = 0.0, slope = 0.0, stretch = 0.0;
    std::uint32_t first = 0,
                  count = 0;  ///< leaf: triangles; else count 0, children first, next one
    [[nodiscard]] double apart2(Vec2 p) const;  ///< squared
    /// Greatest height of a tip on the axis that anything in the box can cause, at least.
    [[nodiscard]] double ceiling(const CutterShape& cutter, Vec2 axis) const;
  };
  void take(const std::vector<Mesh>& meshes, std::size_t threads);
  /// A box that is to be divided, by its place in a list, and its triangles.
  struct Undivided {
    std::uint32_t box = 0, first = 0, count = 0;
  };
  void build(std::size_t threads);
  /// Fills a box; where it is divided, its halves are new in the list and waiting.
  void divide(const Undivided& work, std::vector<Box>& boxes, std::vector<Undivided>& waiting);
  void bound(Box& box, std::uint32_t first, std::uint32_t count) const;

  LargeList<FieldTriangle> triangles_;
  std::vector<Box> boxes_;
  Box3 box_;
};

/// Sets the bits of open sides: edges that belong to one triangle only (corners at the same place
/// are one corner), and corners at their ends. Rough are the triangles at these and at edges whose
/// two sides have normals of their own. Skipped are the bottoms of valleys, where both sides
/// hold a cutter up before, and all but one of the features that triangles share.
void mark_sides(const std::vector<Mesh>& meshes, LargeList<FieldTriangle>& triangles);

}  // namespace obvid::toolpath
