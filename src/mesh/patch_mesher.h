// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "borders.h"
#include "measure.h"

namespace obvid::mesh {

/// Triangles of a patch's cells; cells with finer neighbours take their points over.
class PatchMesher {
 public:
  PatchMesher(const PatchSampler& sampler, const CellTree& tree, const Borders& borders,
              std::size_t patch);

  /// Makes the triangles. Error: E103.
  Result<void> run(const RunContext& run);
  [[nodiscard]] Mesh take() { return std::move(mesh_); }
  [[nodiscard]] const std::vector<CellTriangles>& triangles_of_cells() const { return of_cells_; }

 private:
  using Id = std::uint32_t;
  struct Node {
    double u, v;
    Vec3 point;
    bool known;    ///< the point comes from a border
    bool on_edge;  ///< of the surface: a vertex for each side of it
  };
  /// Of a cell, both corners included, ascending along each side.
  using Sides = std::array<std::vector<Id>, 4>;
  /// What a lot of neighbouring cells is drawn with, before vertices have numbers.
  struct Drawn {
    struct Use {
      Id node;
      std::uint32_t cell;
    };
    std::vector<Use> uses;  ///< nodes in the order in which they become vertices
    std::vector<Node> centres;
    std::vector<std::array<Id, 3>> triangles;
    Sides sides;  ///< of the cell at hand
    std::uint32_t cell = 0;
    Id first_centre = 0;  ///< the number that its first centre gets among all nodes
  };

  void give_missing_normals();
  void collect_nodes();
  /// From the first cell that has them on its outline: points, and normals of those that are not
  /// on edges.
  Result<void> sample_nodes(const RunContext& run);
  [[nodiscard]] Sample sample_in(const Cell& cell, const Node& node) const;
  void collect_border(PatchSide side, std::size_t patch, const Borders& borders);
  Result<void> draw_cells(std::vector<Drawn>& lots, const RunContext& run);
  void draw_cell(const Cell& cell, Drawn& out) const;
  /// Vertices have the numbers that they get when one cell is drawn after another.
  void number_vertices(std::vector<Drawn>& lots);
  Result<void> fill_vertices(const RunContext& run);
  Result<void> fill_triangles(const std::vector<Drawn>& lots, const RunContext& run);
  [[nodiscard]] std::uint64_t outline_of(const Cell& cell, const Sides& sides) const;
  void side_of(const Cell& cell, PatchSide side, std::vector<Id>& out) const;
  [[nodiscard]] Id node_at(Line u, Line v) const;
  [[nodiscard]] bool on_edge(Line u, Line v) const;

  void strip(const Cell& cell, const std::vector<Id>& low, const std::vector<Id>& high,
             bool along_u, Drawn& out) const;
  [[nodiscard]] double height_of(const Cell& cell, Id a, Id b) const;
  void quad(const Cell& cell, Drawn& out) const;
  void fan(const Cell& cell, Drawn& out) const;
  void triangle(Id a, Id b, Id c, Drawn& out) const;
  [[nodiscard]] std::uint64_t block_of(const Cell& cell) const;
  [[nodiscard]] std::uint64_t edge_key(const Cell& cell, Id node) const {
    return block_of(cell) << 32U | node;
  }

  const PatchSampler& sampler_;
  const CellTree& tree_;
  std::vector<std::pair<Line, Line>> by_v_;  ///< (v, u) of the cells' corners, ascending
  std::vector<std::pair<std::pair<Line, Line>, Id>> by_u_;  ///< (u, v) and number in by_v_
  std::array<std::vector<std::pair<double, Id>>, 4>
      border_;  ///< of each `PatchSide`: parameter and node, ascending
  std::vector<Node> nodes_;
  std::vector<Vec3> normals_;  ///< of the first nodes; those in the middle of fans come later
  std::vector<std::uint32_t> vertex_;  ///< of nodes that are not on edges
  std::vector<Drawn::Use> vertices_;   ///< node of each vertex, and the first cell that has it
  std::unordered_map<std::uint64_t, std::uint32_t> edge_vertex_;
  std::vector<std::size_t> block_u_, block_v_;  ///< numbers of the smooth parts, per span
  Mesh mesh_;
  std::vector<CellTriangles> of_cells_;
};

}  // namespace obvid::mesh
