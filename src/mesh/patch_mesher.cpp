// SPDX-License-Identifier: Apache-2.0
#include "patch_mesher.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "obvid/core/internal/parallel.h"

namespace obvid::mesh {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// A triangle whose height is below this part of its longest edge is none.
constexpr double kNeedle = 1e-7;
constexpr std::size_t kTogether = 1024;  // cells, and nodes, for the thread that takes them
/// From here on nodes are middles of fans, numbered in the lot of cells that has them.
constexpr std::uint32_t kCentres = std::uint32_t{1} << 31U;

std::vector<std::size_t> blocks_of(const std::vector<bool>& edges) {
  std::vector<std::size_t> blocks(edges.size(), 0);
  for (std::size_t k = 1; k < edges.size(); ++k) blocks[k] = blocks[k - 1] + (edges[k] ? 1 : 0);
  return blocks;
}

/// The cell's own side of a parameter.
Place place_in(const PatchAxis& axis, double t, Line from, Line to) {
  const Place place = axis.locate(t);
  return {std::clamp(place.span, span_of(from), span_of(to - 1)), t};
}

bool is_edge(const PatchAxis& axis, const std::vector<bool>& edges, Line line) {
  return line != 0 && line != axis.last() && line % kSpan == 0 && edges[span_of(line)];
}

/// Smaller height of the two triangles, in parts of their longest edge.
double slimness(Vec3 a, Vec3 b, Vec3 c) {
  const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
  return longest > 0.0 ? norm(cross(b - a, c - a)) / (longest * longest) : 0.0;
}

}  // namespace

PatchMesher::PatchMesher(const PatchSampler& sampler, const CellTree& tree, const Borders& borders,
                         std::size_t patch)
    : sampler_(sampler),
      tree_(tree),
      block_u_(blocks_of(tree.edges_u())),
      block_v_(blocks_of(tree.edges_v())) {
  collect_nodes();
  for (const PatchSide side : kPatchSides) collect_border(side, patch, borders);
}

// Cells are drawn side by side, vertices are numbered one cell after another, and what has numbers
// is put into the mesh side by side.
Result<void> PatchMesher::run(const RunContext& run) {
  OBVID_TRY(sample_nodes(run));
  std::vector<Drawn> lots((tree_.cells().size() + kTogether - 1) / kTogether);
  OBVID_TRY(draw_cells(lots, run));
  number_vertices(lots);
  OBVID_TRY(fill_vertices(run));
  OBVID_TRY(fill_triangles(lots, run));
  const bool all_normals =
      std::none_of(mesh_.vertices.begin(), mesh_.vertices.end(),
                   [](const MeshVertex& vertex) { return vertex.normal == Vec3{}; });
  if (!all_normals) give_missing_normals();
  return {};
}

Result<void> PatchMesher::draw_cells(std::vector<Drawn>& lots, const RunContext& run) {
  const auto& cells = tree_.cells();
  of_cells_.resize(cells.size());
  return in_parallel(lots.size(), run, [&](std::size_t k) {
    Drawn& lot = lots[k];
    const std::size_t end = std::min(cells.size(), (k + 1) * kTogether);
    for (std::size_t c = k * kTogether; c < end; ++c) {
      const std::size_t before = lot.triangles.size();
      lot.cell = static_cast<std::uint32_t>(c);
      draw_cell(cells[c], lot);
      of_cells_[c] = {static_cast<std::uint32_t>(lot.triangles.size() - before),
                      outline_of(cells[c], lot.sides)};
    }
  });
}

void PatchMesher::number_vertices(std::vector<Drawn>& lots) {
  const std::size_t plain = nodes_.size();
  for (Drawn& lot : lots) {
    lot.first_centre = static_cast<Id>(nodes_.size());
    nodes_.insert(nodes_.end(), lot.centres.begin(), lot.centres.end());
  }
  vertex_.assign(nodes_.size(), kNone);
  vertices_.reserve(nodes_.size());
  for (const Drawn& lot : lots) {
    for (Drawn::Use use : lot.uses) {
      if (use.node >= kCentres) use.node = use.node - kCentres + lot.first_centre;
      const auto number = static_cast<std::uint32_t>(vertices_.size());
      bool fresh = false;
      if (use.node < plain && nodes_[use.node].on_edge) {
        fresh =
            edge_vertex_.try_emplace(edge_key(tree_.cells()[use.cell], use.node), number).second;
      } else if (vertex_[use.node] == kNone) {
        vertex_[use.node] = number;
        fresh = true;
      }
      if (fresh) vertices_.push_back(use);
    }
  }
}

Result<void> PatchMesher::fill_vertices(const RunContext& run) {
  mesh_.vertices.resize(vertices_.size());
  return in_lots(vertices_.size(), kTogether, run, [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) {
      const auto [id, cell] = vertices_[k];
      Node& node = nodes_[id];
      const bool centre = id >= normals_.size();
      const Sample s = !centre && !node.on_edge ? Sample{node.point, normals_[id]}
                                                : sample_in(tree_.cells()[cell], node);
      mesh_.vertices[k] = {centre ? s.point : node.point, s.normal, node.u, node.v};
    }
  });
}

Result<void> PatchMesher::fill_triangles(const std::vector<Drawn>& lots, const RunContext& run) {
  std::vector<std::size_t> first{0};
  for (const Drawn& lot : lots) first.push_back(first.back() + lot.triangles.size());
  mesh_.triangles.resize(first.back());
  return in_parallel(lots.size(), run, [&](std::size_t k) {
    const Drawn& lot = lots[k];
    const auto vertex_of = [&](Id id, std::size_t cell) {
      if (id >= kCentres) return vertex_[id - kCentres + lot.first_centre];
      if (!nodes_[id].on_edge) return vertex_[id];
      return edge_vertex_.find(edge_key(tree_.cells()[cell], id))->second;
    };
    std::size_t cell = k * kTogether, of_cell = 0;
    for (std::size_t t = 0; t < lot.triangles.size(); ++t, ++of_cell) {
      for (; of_cell == of_cells_[cell].count; ++cell) of_cell = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        mesh_.triangles[first[k] + t][c] = vertex_of(lot.triangles[t][c], cell);
      }
    }
  });
}

/// Where the surface has none (a line instead of an area around the point): those of triangles.
void PatchMesher::give_missing_normals() {
  std::unordered_map<std::uint32_t, Vec3> sums;
  for (const auto& t : mesh_.triangles) {
    const auto at = [&](std::size_t k) { return mesh_.vertices[t[k]]; };
    for (std::size_t k = 0; k < 3; ++k) {
      if (at(k).normal != Vec3{}) continue;
      Vec3& sum = sums[t[k]];
      sum = sum + cross(at(1).point - at(0).point, at(2).point - at(0).point);
    }
  }
  for (const auto& [vertex, sum] : sums) {
    const Vec3 up{0.0, 0.0, 1.0};  // triangles without area: anything but nothing
    mesh_.vertices[vertex].normal = sum == Vec3{} ? up : unit(sum);
  }
}

void PatchMesher::collect_nodes() {
  for (const Cell& c : tree_.cells()) {
    for (const auto& [u, v] : {std::pair{c.u0, c.v0}, std::pair{c.u1, c.v0}, std::pair{c.u0, c.v1},
                               std::pair{c.u1, c.v1}}) {
      by_v_.emplace_back(v, u);
    }
  }
  std::sort(by_v_.begin(), by_v_.end());
  by_v_.erase(std::unique(by_v_.begin(), by_v_.end()), by_v_.end());
  by_v_.shrink_to_fit();
  by_u_.reserve(by_v_.size());
  nodes_.reserve(by_v_.size());
  for (const auto& [v, u] : by_v_) {
    by_u_.push_back({{u, v}, static_cast<Id>(nodes_.size())});
    nodes_.push_back({sampler_.u().at(u), sampler_.v().at(v), {}, false, on_edge(u, v)});
  }
  std::sort(by_u_.begin(), by_u_.end());
}

bool PatchMesher::on_edge(Line u, Line v) const {
  return is_edge(sampler_.u(), tree_.edges_u(), u) || is_edge(sampler_.v(), tree_.edges_v(), v);
}

PatchMesher::Id PatchMesher::node_at(Line u, Line v) const {
  const auto at = std::lower_bound(by_v_.begin(), by_v_.end(), std::pair{v, u});
  return static_cast<Id>(at - by_v_.begin());
}

/// Points of the border: those of cells get the border's point, others are new nodes.
void PatchMesher::collect_border(PatchSide side, std::size_t patch, const Borders& borders) {
  const bool along_u = runs_along_u(side);
  const PatchAxis& across = along_u ? sampler_.v() : sampler_.u();
  const Line end = is_far_end(side) ? across.last() : 0;
  std::vector<std::pair<double, Id>> own;
  for (Id id = 0; id < by_v_.size(); ++id) {
    const auto& [v, u] = by_v_[id];
    if ((along_u ? v : u) == end) own.emplace_back(along_u ? nodes_[id].u : nodes_[id].v, id);
  }
  auto next = own.begin();
  for (const BorderNode& b : borders.nodes(patch, side)) {
    if (next != own.end() && next->first == b.t) {
      nodes_[next->second].point = b.point;
      nodes_[next->second].known = true;
      border_[side].push_back(*next++);
      continue;
    }
    const double other = across.at(end);
    border_[side].emplace_back(b.t, static_cast<Id>(nodes_.size()));
    nodes_.push_back({along_u ? b.t : other, along_u ? other : b.t, b.point, true, false});
  }
}

/// Nodes of a side of a cell, both corners included, ascending.
void PatchMesher::side_of(const Cell& c, PatchSide side, std::vector<Id>& out) const {
  out.clear();
  const bool along_u = runs_along_u(side), far = is_far_end(side);
  const PatchAxis& axis = along_u ? sampler_.u() : sampler_.v();
  const PatchAxis& across = along_u ? sampler_.v() : sampler_.u();
  const Line line = along_u ? (far ? c.v1 : c.v0) : (far ? c.u1 : c.u0);
  const Line from = along_u ? c.u0 : c.v0, to = along_u ? c.u1 : c.v1;
  if (line == (far ? across.last() : 0)) {
    const double last = axis.at(to);
    auto at = std::lower_bound(border_[side].begin(), border_[side].end(),
                               std::pair{axis.at(from), Id{0}});
    for (; at != border_[side].end() && at->first <= last; ++at) out.push_back(at->second);
  } else if (along_u) {
    for (Id id = node_at(from, line); id < by_v_.size() && by_v_[id] <= std::pair{line, to}; ++id) {
      out.push_back(id);
    }
  } else {
    auto at = std::lower_bound(by_u_.begin(), by_u_.end(), std::pair{std::pair{line, from}, Id{0}});
    for (; at != by_u_.end() && at->first <= std::pair{line, to}; ++at) out.push_back(at->second);
  }
}

void PatchMesher::draw_cell(const Cell& cell, Drawn& out) const {
  Sides& sides = out.sides;
  for (const PatchSide side : kPatchSides) side_of(cell, side, sides[side]);
  const bool more_along_u = sides[kVStart].size() > 2 || sides[kVEnd].size() > 2;
  const bool more_along_v = sides[kUStart].size() > 2 || sides[kUEnd].size() > 2;
  if (cell.fan || (more_along_u && more_along_v)) {
    fan(cell, out);
  } else if (more_along_u) {
    strip(cell, sides[kVStart], sides[kVEnd], true, out);
  } else if (more_along_v) {
    strip(cell, sides[kUStart], sides[kUEnd], false, out);
  } else {
    quad(cell, out);
  }
}

/// Parameters of the outline and the kind of drawing, mixed into one number (FNV, 64 bits).
std::uint64_t PatchMesher::outline_of(const Cell& cell, const Sides& sides) const {
  std::uint64_t mixed = 0xCBF29CE484222325U;
  const auto mix = [&](double t) {
    mixed = (mixed ^ std::bit_cast<std::uint64_t>(t)) * 0x100000001B3U;
    mixed ^= mixed >> 32U;
  };
  mix(cell.fan ? 1.0 : 0.0);
  for (const auto& side : sides) {
    for (const Id id : side) {
      mix(nodes_[id].u);
      mix(nodes_[id].v);
    }
  }
  return mixed;
}

void PatchMesher::quad(const Cell& cell, Drawn& out) const {
  const Sides& sides = out.sides;
  const Id a = sides[kVStart][0], b = sides[kVStart][1], c = sides[kVEnd][0], d = sides[kVEnd][1];
  for (const Id id : {a, b, c, d}) out.uses.push_back({id, out.cell});
  const auto at = [&](Id id) { return nodes_[id].point; };
  const auto slim = [&](bool rising) {
    return rising ? std::min(slimness(at(a), at(b), at(d)), slimness(at(a), at(d), at(c)))
                  : std::min(slimness(at(a), at(b), at(c)), slimness(at(b), at(d), at(c)));
  };
  const bool rising =
      slim(cell.rising) > kNeedle || slim(!cell.rising) <= kNeedle ? cell.rising : !cell.rising;
  triangle(a, b, rising ? d : c, out);
  triangle(rising ? a : b, d, c, out);
}

/// How far the middle of an inner edge is off the surface, along the normal.
double PatchMesher::height_of(const Cell& cell, Id a, Id b) const {
  const Node &from = nodes_[a], &to = nodes_[b];
  const SurfacePoint s =
      sampler_.at(place_in(sampler_.u(), 0.5 * (from.u + to.u), cell.u0, cell.u1),
                  place_in(sampler_.v(), 0.5 * (from.v + to.v), cell.v0, cell.v1));
  const Vec3 gap = 0.5 * (from.point + to.point) - s.point, n = cross(s.du, s.dv);
  const double length = norm(n);
  return length > 0.0 ? std::fabs(dot(gap, n)) / length : norm(gap);
}

/// Triangles between two rows of nodes that run the same way; of the two edges that may come next
/// the one nearer to the surface does.
void PatchMesher::strip(const Cell& cell, const std::vector<Id>& low, const std::vector<Id>& high,
                        bool along_u, Drawn& out) const {
  for (const Id id : low) out.uses.push_back({id, out.cell});
  for (const Id id : high) out.uses.push_back({id, out.cell});
  const auto add = [&](Id a, Id b, Id c) {
    along_u ? triangle(a, b, c, out) : triangle(a, c, b, out);
  };
  std::size_t i = 0, j = 0;
  while (i + 1 < low.size() || j + 1 < high.size()) {
    const bool low_next =
        j + 1 == high.size() || (i + 1 < low.size() && height_of(cell, low[i + 1], high[j]) <=
                                                           height_of(cell, low[i], high[j + 1]));
    if (low_next) {
      add(low[i], low[i + 1], high[j]);
      ++i;
    } else {
      add(low[i], high[j + 1], high[j]);
      ++j;
    }
  }
}

void PatchMesher::fan(const Cell& cell, Drawn& out) const {
  const Range u{sampler_.u().at(cell.u0), sampler_.u().at(cell.u1)};
  const Range v{sampler_.v().at(cell.v0), sampler_.v().at(cell.v1)};
  Node middle{u.at(0.5), v.at(0.5), {}, true, false};
  middle.point = sample_in(cell, middle).point;
  const Id centre = kCentres + static_cast<Id>(out.centres.size());
  out.centres.push_back(middle);
  out.uses.push_back({centre, out.cell});
  const auto edge = [&](Id a, Id b) {
    out.uses.push_back({a, out.cell});
    out.uses.push_back({b, out.cell});
    triangle(centre, a, b, out);
  };
  const auto &low = out.sides[kVStart], &high = out.sides[kVEnd], &left = out.sides[kUStart],
             &right = out.sides[kUEnd];
  for (std::size_t k = 1; k < low.size(); ++k) edge(low[k - 1], low[k]);
  for (std::size_t k = 1; k < right.size(); ++k) edge(right[k - 1], right[k]);
  for (std::size_t k = 1; k < high.size(); ++k) edge(high[k], high[k - 1]);
  for (std::size_t k = 1; k < left.size(); ++k) edge(left[k], left[k - 1]);
}

/// Smooth parts of the surface, numbered.
std::uint64_t PatchMesher::block_of(const Cell& cell) const {
  return block_v_[span_of(cell.v0)] * (block_u_.back() + 1) + block_u_[span_of(cell.u0)];
}

Sample PatchMesher::sample_in(const Cell& cell, const Node& node) const {
  return sampler_.sample(place_in(sampler_.u(), node.u, cell.u0, cell.u1),
                         place_in(sampler_.v(), node.v, cell.v0, cell.v1));
}

Result<void> PatchMesher::sample_nodes(const RunContext& run) {
  const auto& cells = tree_.cells();
  std::vector<std::atomic<std::uint32_t>> first(nodes_.size());
  for (auto& one : first) one = kNone;
  OBVID_TRY(in_lots(cells.size(), kTogether, run, [&](std::size_t from, std::size_t to) {
    std::vector<Id> outline;
    for (std::size_t c = from; c < to; ++c) {
      for (const PatchSide side : kPatchSides) {
        side_of(cells[c], side, outline);
        for (const Id id : outline) {
          const auto own = static_cast<std::uint32_t>(c);
          std::uint32_t known = first[id].load(std::memory_order_relaxed);
          while (own < known && !first[id].compare_exchange_weak(known, own)) continue;
        }
      }
    }
  }));
  normals_.resize(nodes_.size());
  return in_lots(nodes_.size(), kTogether, run, [&](std::size_t from, std::size_t to) {
    for (std::size_t id = from; id < to; ++id) {
      Node& node = nodes_[id];
      if (first[id] == kNone || (node.on_edge && node.known)) continue;
      const Sample s = sample_in(cells[first[id]], node);
      normals_[id] = s.normal;  // of those on edges not used
      if (!node.known) node.point = s.point;
      node.known = true;
    }
  });
}

/// Collapsed edges leave triangles without area out: two of their points are the same.
void PatchMesher::triangle(Id a, Id b, Id c, Drawn& out) const {
  const auto at = [&](Id id) {
    return id >= kCentres ? out.centres[id - kCentres].point : nodes_[id].point;
  };
  const Vec3 pa = at(a), pb = at(b), pc = at(c);
  if (pa == pb || pb == pc || pc == pa) return;
  out.triangles.push_back({a, b, c});
}

}  // namespace obvid::mesh
