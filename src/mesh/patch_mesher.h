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
  struct Outline;

  void give_missing_normals();
  void collect_nodes();
  /// Those that are not on edges, from the first cell that has them on its outline.
  Result<void> sample_nodes(const RunContext& run);
  [[nodiscard]] Sample sample_in(const Cell& cell, const Node& node) const;
  void collect_border(PatchSide side, std::size_t patch, const Borders& borders);
  void add_cell(const Cell& cell);
  [[nodiscard]] std::uint64_t outline_of(const Cell& cell) const;
  void side_of(const Cell& cell, PatchSide side, std::vector<Id>& out) const;
  [[nodiscard]] Id node_at(Line u, Line v) const;
  [[nodiscard]] bool on_edge(Line u, Line v) const;

  void strip(const Cell& cell, const std::vector<Id>& low, const std::vector<Id>& high,
             bool along_u);
  [[nodiscard]] double height_of(const Cell& cell, Id a, Id b) const;
  void quad(const Cell& cell);
  void fan(const Cell& cell);
  void triangle(const Cell& cell, Id a, Id b, Id c);
  [[nodiscard]] std::uint32_t vertex_of(const Cell& cell, Id node);
  [[nodiscard]] std::uint64_t block_of(const Cell& cell) const;

  const PatchSampler& sampler_;
  const CellTree& tree_;
  std::vector<std::pair<Line, Line>> by_v_;  ///< (v, u) of the cells' corners, ascending
  std::vector<std::pair<std::pair<Line, Line>, Id>> by_u_;  ///< (u, v) and number in by_v_
  std::array<std::vector<std::pair<double, Id>>, 4>
      border_;  ///< of each `PatchSide`: parameter and node, ascending
  std::vector<Node> nodes_;
  std::vector<Vec3> normals_;  ///< of the first nodes; those in the middle of fans come later
  std::array<std::vector<Id>, 4> side_;  ///< of the cell at hand
  std::vector<std::uint32_t> vertex_;    ///< of nodes that are not on edges
  std::unordered_map<std::uint64_t, std::uint32_t> edge_vertex_;
  std::vector<std::size_t> block_u_, block_v_;  ///< numbers of the smooth parts, per span
  Mesh mesh_;
  std::vector<CellTriangles> of_cells_;
};

}  // namespace obvid::mesh
