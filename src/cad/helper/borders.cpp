// SPDX-License-Identifier: Apache-2.0
#include "borders.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

namespace obvid::cad {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Corners in cells as wide as the tolerance, so that each finds the others in constant time.
class Vertices {
 public:
  Vertices(std::vector<JointVertex>& vertices, double tolerance)
      : vertices_(vertices), tolerance_(tolerance) {}

  std::size_t at(Vec3 p) {
    const Cell cell = cell_of(p);
    for (std::int64_t k = 0; k < 27; ++k) {  // the cell and all around it
      const Cell near = {cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1};
      const auto found = cells_.find(near);
      if (found == cells_.end()) continue;
      for (const std::size_t i : found->second) {
        const double distance = norm(vertices_[i].point - p);
        if (distance > tolerance_) continue;
        vertices_[i].gap = std::max(vertices_[i].gap, distance);
        return i;
      }
    }
    vertices_.push_back({p, 0.0});
    cells_[cell].push_back(vertices_.size() - 1);
    return vertices_.size() - 1;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t out = 0;
      for (const std::int64_t c : cell) {
        out = (out ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ULL;  // golden ratio
        out ^= out >> 32;
      }
      return static_cast<std::size_t>(out);
    }
  };
  [[nodiscard]] Cell cell_of(Vec3 p) const {
    // far from the origin a double has no digits for smaller cells anyway
    constexpr double kFar = 4e18;
    const auto index = [&](double x) {
      return static_cast<std::int64_t>(std::clamp(std::floor(x / tolerance_), -kFar, kFar));
    };
    return {index(p.x), index(p.y), index(p.z)};
  }

  std::vector<JointVertex>& vertices_;
  double tolerance_;
  std::unordered_map<Cell, std::vector<std::size_t>, Hash> cells_;
};

/// Parts of the parameter at which two curves are compared: the knots and points between.
void add_samples(const SpaceCurve& curve, std::vector<double>& parts) {
  constexpr int kInSpan = 4;
  const Range range = domain(curve);
  for (std::size_t k = 1; k < curve.knots.size(); ++k) {
    const double a = curve.knots[k - 1], b = curve.knots[k];
    for (int i = 0; i < kInSpan && a < b; ++i) {
      parts.push_back((a + (b - a) * i / kInSpan - range.from) / range.length());
    }
  }
}

/// Largest distance of two curves at the same parts of their parameters; nothing when it is more
/// than the tolerance.
std::optional<double> distance(const SpaceCurve& a, const SpaceCurve& b, bool along,
                               double tolerance) {
  const Range range_a = domain(a), range_b = domain(b);
  const auto apart = [&](double part) {
    return norm(evaluate(a, range_a.at(part)).point -
                evaluate(b, range_b.at(along ? part : 1.0 - part)).point);
  };
  // most borders that differ do so in the middle: no list for them
  if (apart(0.375) > tolerance) return std::nullopt;
  std::vector<double> parts = {1.0};
  add_samples(a, parts);
  const std::size_t own = parts.size();
  add_samples(b, parts);
  for (std::size_t i = own; i < parts.size() && !along; ++i) parts[i] = 1.0 - parts[i];
  double worst = 0.0;
  for (const double part : parts) {
    worst = std::max(worst, apart(part));
    if (worst > tolerance) return std::nullopt;
  }
  return worst;
}

bool is_point(const SpaceCurve& curve, double tolerance) {
  return std::all_of(curve.points.begin(), curve.points.end(),
                     [&](Vec3 p) { return norm(p - curve.points.front()) <= tolerance; });
}

class Joiner {
 public:
  Joiner(const std::vector<NurbsSurface>& patches, double tolerance, bool neighbours)
      : patches_(patches),
        tolerance_(tolerance),
        neighbours_(neighbours),
        vertices_(out_.vertices, tolerance) {}

  Joints join() {
    out_.sides.resize(patches_.size());
    out_.turned.assign(patches_.size(), false);
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      for (const Side side : kSides) place(i, side);
    }
    group();
    return std::move(out_);
  }

 private:
  struct Owner {
    std::size_t patch = kNone;
    Side side = kBottom;
  };

  void place(std::size_t patch, Side side) {
    SpaceCurve curve = border_of(patches_[patch], side);
    JointEdge edge;
    edge.point = is_point(curve, tolerance_);
    edge.from = vertices_.at(curve.points.front());
    edge.to = edge.point ? edge.from : vertices_.at(curve.points.back());
    edge.curve = std::move(curve);
    if (!edge.point && joined_to_another(edge, patch, side)) return;
    add(std::move(edge), patch, side);
  }

  void add(JointEdge edge, std::size_t patch, Side side) {
    const std::size_t number = out_.edges.size();
    if (!edge.point) between_[std::minmax(edge.from, edge.to)].push_back(number);
    out_.sides[patch][side] = {number, true};
    out_.edges.push_back(std::move(edge));
    owners_.push_back({patch, side});
  }

  bool joined_to_another(const JointEdge& edge, std::size_t patch, Side side) {
    const auto found = between_.find(std::minmax(edge.from, edge.to));
    if (found == between_.end()) return false;
    for (const std::size_t number : found->second) {
      JointEdge& other = out_.edges[number];
      if (other.uses > 1) continue;
      for (const bool along : {true, false}) {
        if (!may_join(number, patch, side, along)) continue;
        if ((along ? other.from : other.to) != edge.from) continue;
        const auto gap = distance(other.curve, edge.curve, along, tolerance_);
        if (!gap) continue;
        other.gap = std::max(other.gap, *gap);
        ++other.uses;
        out_.sides[patch][side] = {number, along};
        partners_.resize(out_.edges.size());
        partners_[number] = {patch, side};
        return true;
      }
    }
    return false;
  }

  /// A patch meets itself in a seam only: opposite sides, both in the same direction.
  [[nodiscard]] bool may_join(std::size_t edge, std::size_t patch, Side side, bool along) const {
    const Owner& owner = owners_[edge];
    if (owner.patch != patch) return neighbours_;
    return along && (owner.side + 2) % 4 == side;
  }

  void group() {
    partners_.resize(out_.edges.size());
    std::vector<bool> seen(patches_.size(), false);
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      if (seen[i]) continue;
      Joined group{{i}, true};
      seen[i] = true;
      for (std::size_t k = 0; k < group.patches.size(); ++k) {
        for (const Side side : kSides) visit(group.patches[k], side, seen, group);
      }
      std::sort(group.patches.begin(), group.patches.end());
      for (const std::size_t p : group.patches) {
        for (const EdgeUse& use : out_.sides[p]) {
          const JointEdge& edge = out_.edges[use.edge];
          if (!edge.point && edge.uses < 2) group.closed = false;
        }
      }
      out_.groups.push_back(std::move(group));
    }
  }

  /// The neighbour at this side joins the group, turned round when its normal is on the other side.
  void visit(std::size_t patch, Side side, std::vector<bool>& seen, Joined& group) {
    const std::size_t edge = out_.sides[patch][side].edge;
    const Owner first = owners_[edge], second = partners_[edge];
    if (second.patch == kNone || first.patch == second.patch) return;
    const std::size_t other = first.patch == patch ? second.patch : first.patch;
    // the edge runs as its first side does
    const bool same_way =
        runs_with_boundary(first.side) == (runs_with_boundary(second.side) == use(second).along);
    if (!seen[other]) {
      seen[other] = true;
      out_.turned[other] = out_.turned[patch] != same_way;
      group.patches.push_back(other);
    } else if ((out_.turned[other] != out_.turned[patch]) != same_way) {
      separate(edge);
    }
  }

  [[nodiscard]] const EdgeUse& use(const Owner& at) const { return out_.sides[at.patch][at.side]; }

  /// The second patch of an edge gets one of its own.
  void separate(std::size_t number) {
    const Owner second = partners_[number];
    JointEdge own = out_.edges[number];
    own.curve = border_of(patches_[second.patch], second.side);
    if (!use(second).along) std::swap(own.from, own.to);
    own.uses = out_.edges[number].uses = 1;
    partners_[number] = {};
    add(std::move(own), second.patch, second.side);
    partners_.resize(out_.edges.size());
  }

  const std::vector<NurbsSurface>& patches_;
  double tolerance_;
  bool neighbours_;
  Joints out_;
  Vertices vertices_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> between_;
  std::vector<Owner> owners_, partners_;  ///< first and second side of each edge
};

}  // namespace

SpaceCurve border_of(const NurbsSurface& surface, Side side) {
  const bool along_u = side == kBottom || side == kTop;
  const std::size_t n = surface.count_u(), m = surface.count_v();
  const std::size_t first = side == kTop ? (m - 1) * n : side == kRight ? n - 1 : 0;
  SpaceCurve out;
  out.degree = along_u ? surface.degree_u : surface.degree_v;
  out.knots = along_u ? surface.knots_u : surface.knots_v;
  for (std::size_t k = 0; k < (along_u ? n : m); ++k) {
    const std::size_t at = first + k * (along_u ? 1 : n);
    out.points.push_back(surface.points[at]);
    if (!surface.weights.empty()) out.weights.push_back(surface.weights[at]);
  }
  return out;
}

Joints joints_of(const std::vector<NurbsSurface>& patches, double tolerance) {
  return Joiner(patches, tolerance, true).join();
}

Joints joints_apart(const std::vector<NurbsSurface>& patches, double tolerance) {
  return Joiner(patches, tolerance, false).join();
}

}  // namespace obvid::cad
