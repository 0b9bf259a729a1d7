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

Result<void> PatchMesher::run(const RunContext& run) {
  constexpr std::size_t kCellsOfStep = 4096;  // between two questions
  OBVID_TRY(sample_nodes(run));
  vertex_.assign(nodes_.size(), kNone);
  mesh_.vertices.reserve(nodes_.size());
  mesh_.triangles.reserve(2 * tree_.cells().size());
  for (const Cell& cell : tree_.cells()) {
    if (of_cells_.size() % kCellsOfStep == 0) OBVID_TRY(may_go_on(run));
    const std::size_t before = mesh_.triangles.size();
    add_cell(cell);
    of_cells_.push_back(
        {static_cast<std::uint32_t>(mesh_.triangles.size() - before), outline_of(cell)});
  }
  give_missing_normals();
  return {};
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

void PatchMesher::add_cell(const Cell& cell) {
  for (const PatchSide side : kPatchSides) side_of(cell, side, side_[side]);
  const bool more_along_u = side_[kVStart].size() > 2 || side_[kVEnd].size() > 2;
  const bool more_along_v = side_[kUStart].size() > 2 || side_[kUEnd].size() > 2;
  if (cell.fan || (more_along_u && more_along_v)) {
    fan(cell);
  } else if (more_along_u) {
    strip(cell, side_[kVStart], side_[kVEnd], true);
  } else if (more_along_v) {
    strip(cell, side_[kUStart], side_[kUEnd], false);
  } else {
    quad(cell);
  }
}

/// Parameters of the outline and the kind of drawing, mixed into one number (FNV, 64 bits).
std::uint64_t PatchMesher::outline_of(const Cell& cell) const {
  std::uint64_t mixed = 0xCBF29CE484222325U;
  const auto mix = [&](double t) {
    mixed = (mixed ^ std::bit_cast<std::uint64_t>(t)) * 0x100000001B3U;
    mixed ^= mixed >> 32U;
  };
  mix(cell.fan ? 1.0 : 0.0);
  for (const auto& side : side_) {
    for (const Id id : side) {
      mix(nodes_[id].u);
      mix(nodes_[id].v);
    }
  }
  return mixed;
}

void PatchMesher::quad(const Cell& cell) {
  const Id a = side_[kVStart][0], b = side_[kVStart][1], c = side_[kVEnd][0], d = side_[kVEnd][1];
  for (const Id id : {a, b, c, d}) static_cast<void>(vertex_of(cell, id));  // points become known
  const auto at = [&](Id id) { return nodes_[id].point; };
  const auto slim = [&](bool rising) {
    return rising ? std::min(slimness(at(a), at(b), at(d)), slimness(at(a), at(d), at(c)))
                  : std::min(slimness(at(a), at(b), at(c)), slimness(at(b), at(d), at(c)));
  };
  const bool rising =
      slim(cell.rising) > kNeedle || slim(!cell.rising) <= kNeedle ? cell.rising : !cell.rising;
  triangle(cell, a, b, rising ? d : c);
  triangle(cell, rising ? a : b, d, c);
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
                        bool along_u) {
  for (const Id id : low) static_cast<void>(vertex_of(cell, id));  // points become known
  for (const Id id : high) static_cast<void>(vertex_of(cell, id));
  const auto add = [&](Id a, Id b, Id c) {
    along_u ? triangle(cell, a, b, c) : triangle(cell, a, c, b);
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

void PatchMesher::fan(const Cell& cell) {
  const Range u{sampler_.u().at(cell.u0), sampler_.u().at(cell.u1)};
  const Range v{sampler_.v().at(cell.v0), sampler_.v().at(cell.v1)};
  const Id centre = static_cast<Id>(nodes_.size());
  nodes_.push_back({u.at(0.5), v.at(0.5), {}, false, false});
  vertex_.push_back(kNone);
  const auto &low = side_[kVStart], &high = side_[kVEnd], &left = side_[kUStart],
             &right = side_[kUEnd];
  for (std::size_t k = 1; k < low.size(); ++k) triangle(cell, centre, low[k - 1], low[k]);
  for (std::size_t k = 1; k < right.size(); ++k) triangle(cell, centre, right[k - 1], right[k]);
  for (std::size_t k = 1; k < high.size(); ++k) triangle(cell, centre, high[k], high[k - 1]);
  for (std::size_t k = 1; k < left.size(); ++k) triangle(cell, centre, left[k], left[k - 1]);
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
      if (node.on_edge || first[id] == kNone) continue;
      const Sample s = sample_in(cells[first[id]], node);
      normals_[id] = s.normal;
      if (!node.known) node.point = s.point;
      node.known = true;
    }
  });
}

std::uint32_t PatchMesher::vertex_of(const Cell& cell, Id id) {
  Node& node = nodes_[id];
  const bool plain = !node.on_edge;
  const std::uint64_t key = plain ? 0 : block_of(cell) << 32U | id;
  if (plain && vertex_[id] != kNone) return vertex_[id];
  if (!plain) {
    if (const auto found = edge_vertex_.find(key); found != edge_vertex_.end())
      return found->second;
  }
  const bool sampled = plain && id < normals_.size();
  const Sample s = sampled ? Sample{node.point, normals_[id]} : sample_in(cell, node);
  if (!node.known) {
    node.point = s.point;
    node.known = true;
  }
  const auto number = static_cast<std::uint32_t>(mesh_.vertices.size());
  mesh_.vertices.push_back({node.point, s.normal, node.u, node.v});
  (plain ? vertex_[id] : edge_vertex_[key]) = number;
  return number;
}

/// Collapsed edges leave triangles without area out: two of their points are the same.
void PatchMesher::triangle(const Cell& cell, Id a, Id b, Id c) {
  const std::uint32_t va = vertex_of(cell, a), vb = vertex_of(cell, b), vc = vertex_of(cell, c);
  const auto &pa = mesh_.vertices[va].point, &pb = mesh_.vertices[vb].point,
             &pc = mesh_.vertices[vc].point;
  if (pa == pb || pb == pc || pc == pa) return;
  mesh_.triangles.push_back({va, vb, vc});
}

}  // namespace obvid::mesh
