// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "large_list.h"
#include "obvid/geom/internal/box.h"
#include "part.h"

namespace obvid::toolpath {

inline constexpr std::size_t kCellsBetweenQuestions = 16;  ///< whether to go on

/// A rectangle of a patch's parameters: its middle and half its sides.
struct CellPlace {
  std::uint32_t patch = 0;
  double u = 0.0, v = 0.0, du = 0.0, dv = 0.0;
};

/// The surface over such a rectangle: every point of it lies beside `point` by at most `reach` in
/// the tangent plane and by at most `rise` out of it, and its normal differs from `normal` by at
/// most `turn`. Told from the derivatives in the middle with a margin for what changes in between.
struct Cell {
  Vec3 point;
  Vec3 normal;  ///< upwards; none where the surface has no tangent plane
  double reach = 0.0, rise = 0.0, turn = 0.0;
  double area = 0.0;
  bool there = true;  ///< its middle is not trimmed away
};

/// Takes the normal on the side of `side`.
/// `allowance`: of the surface that far out along its normals.
[[nodiscard]] Cell cell_at(const SurfaceModel& model, const CellPlace& place, Vec3 side,
                           double allowance);

/// The cells of a whole model, about `spacing` wide (more, where that would be more than
/// `most_cells`), put together in tiles as seen from above.
class SurfaceCells {
 public:
  /// An error only when cancelled.
  static Result<SurfaceCells> make(const Part& part, double spacing, double tile,
                                   std::size_t threads, const RunContext& run = {});

  struct Tile {
    std::uint32_t first = 0, count = 0;  ///< cells
  };
  [[nodiscard]] const LargeList<Cell>& cells() const { return cells_; }
  [[nodiscard]] CellPlace place(std::size_t cell) const;
  [[nodiscard]] const std::vector<Tile>& tiles() const { return tiles_; }
  /// Calls what(cell) for the cells of the same patch on all four sides.
  template <class What>
  void neighbours(std::size_t cell, const What& what) const {
    const Origin& at = origins_[cell];
    const Grid& grid = grids_[at.patch];
    if (at.i > 0) what(number_[grid.number(at.i - 1, at.j)]);
    if (at.i + 2 < grid.us.size()) what(number_[grid.number(at.i + 1, at.j)]);
    if (at.j > 0) what(number_[grid.number(at.i, at.j - 1)]);
    if (at.j + 2 < grid.vs.size()) what(number_[grid.number(at.i, at.j + 1)]);
  }
  /// Calls what(tile) for the tiles that have places within `reach` of the box low..high.
  template <class What>
  void tiles_near(Vec2 low, Vec2 high, double reach, const What& what) const {
    const std::size_t x1 = column(high.x + reach), y1 = row(high.y + reach);
    for (std::size_t y = row(low.y - reach); y <= y1; ++y) {
      for (std::size_t x = column(low.x - reach); x <= x1; ++x) what(y * nx_ + x);
    }
  }
  [[nodiscard]] double spacing() const { return spacing_; }

 private:
  explicit SurfaceCells(double spacing) : spacing_(spacing) {}
  struct Grid {  ///< of a patch: borders of its cells
    std::vector<double> us, vs;
    std::size_t first = 0;  ///< of its numbers
    [[nodiscard]] std::size_t cells() const { return (us.size() - 1) * (vs.size() - 1); }
    [[nodiscard]] std::size_t number(std::size_t i, std::size_t j) const {
      return first + j * (us.size() - 1) + i;
    }
  };
  struct Origin {
    std::uint32_t patch = 0, i = 0, j = 0;
  };
  [[nodiscard]] CellPlace place(const Origin& at) const;
  [[nodiscard]] std::size_t column(double x) const;
  [[nodiscard]] std::size_t row(double y) const;
  void divide(const SurfaceModel& model);
  struct Row {  ///< of cells side by side along u
    std::uint32_t patch = 0, j = 0;
    std::size_t first = 0, count = 0;  ///< by their place in the patches
  };
  [[nodiscard]] Cell made(const Part& part, const Origin& origin) const;
  [[nodiscard]] Result<void> fill(const Part& part, double tile, std::size_t threads,
                                  const RunContext& run);
  void sort_into_tiles(double tile, const std::vector<Row>& rows, const LargeList<Vec2>& places,
                       std::size_t threads);

  double spacing_;
  std::vector<Grid> grids_;
  LargeList<Cell> cells_;
  LargeList<Origin> origins_;
  LargeList<std::uint32_t> number_;  ///< of cells, by their place in the patches
  std::vector<Tile> tiles_;
  Box2 box_;
  double tile_ = 1.0;
  std::size_t nx_ = 1, ny_ = 1;
};

}  // namespace obvid::toolpath
