// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "offset_path.h"

namespace obvid::cutting {

/// Edges of what stays, for questions how near they are. What stays lies to the right of each.
class Edges {
 public:
  /// `name`: whatever the caller knows the path by.
  void add(const ArcPath& path, std::size_t name);
  /// After the last one.
  void finish();

  struct Nearest {
    double distance = 0.0;  ///< infinite without edges
    double room = 0.0;      ///< the same; negative inside of what stays
    std::size_t name = 0;
  };
  [[nodiscard]] Nearest nearest(Vec2 point) const;

  /// A path that a line or arc meets, if any; `but`: that one does not count.
  [[nodiscard]] std::optional<std::size_t> met_by(const Piece& piece,
                                                  std::optional<std::size_t> but = {}) const;

  /// A line or arc of one of the paths; lives as long as these edges.
  struct Named {
    const Piece* piece;
    std::size_t name;
  };
  /// Those whose boxes come as near as `within` to that of a piece, and perhaps others.
  [[nodiscard]] std::vector<Named> near_to(const Piece& piece, double within) const;

  Edges();
  ~Edges();
  Edges(Edges&&) noexcept;
  Edges& operator=(Edges&&) noexcept;

 private:
  struct Tree;
  struct Edge {
    Piece piece;
    Vec2 normal_before,
        normal_behind;  ///< to the left, at its ends: of both pieces that meet there
    std::size_t name = 0;
  };
  [[nodiscard]] double room_beside(const Edge& edge, Vec2 point, double distance) const;

  std::vector<Edge> edges_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace obvid::cutting
