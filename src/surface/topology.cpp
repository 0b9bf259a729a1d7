// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/internal/topology.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

namespace obvid {
namespace {

/// Places of each span at which two curves are compared, and where the nearest point is looked for.
constexpr int kPlacesPerSpan = 4;
constexpr int kMostFootSteps = 20;

/// Corners in cells as wide as the tolerance, so that each finds the others in constant time.
class VertexGrid {
 public:
  VertexGrid(std::vector<TopologyVertex>& vertices, double tolerance)
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
    const double width = tolerance_ > 0.0 ? tolerance_ : 1.0;
    const auto index = [&](double x) {
      return static_cast<std::int64_t>(std::clamp(std::floor(x / width), -kFar, kFar));
    };
    return {index(p.x), index(p.y), index(p.z)};
  }

  std::vector<TopologyVertex>& vertices_;
  double tolerance_;
  std::unordered_map<Cell, std::vector<std::size_t>, Hash> cells_;
};

/// Parts of the parameter in (0, 1): the knots and places between.
std::vector<double> places_of(const SpaceCurve& curve) {
  const Range range = domain(curve);
  std::vector<double> parts;
  for (std::size_t k = 1; k < curve.knots.size(); ++k) {
    const double a = curve.knots[k - 1], b = curve.knots[k];
    for (int i = 0; i < kPlacesPerSpan && a < b; ++i) {
      const double part = (a + (b - a) * i / kPlacesPerSpan - range.from) / range.length();
      if (part > 0.0 && part < 1.0) parts.push_back(part);
    }
  }
  return parts;
}

Vec3 place_at_part(const SpaceCurve& curve, double part) {
  return evaluate(curve, domain(curve).at(part)).point;
}

/// The foot of the perpendicular of a point, from a place near it.
double foot_near(const SpaceCurve& curve, Vec3 of, double t) {
  const Range range = domain(curve);
  SpaceJet here = evaluate(curve, t);
  double least = norm(here.point - of);
  for (int k = 0; k < kMostFootSteps; ++k) {
    const double speed2 = dot(here.d1, here.d1);
    if (!(speed2 > 0.0)) break;
    const double next =
        std::clamp(t + dot(of - here.point, here.d1) / speed2, range.from, range.to);
    const SpaceJet there = evaluate(curve, next);
    const double far = norm(there.point - of);
    if (far >= least) break;
    least = far;
    t = next;
    here = there;
  }
  return t;
}

/// Whether two curves between the same vertices are one, and how far they are apart at most.
class BorderPair {
 public:
  BorderPair(const SpaceCurve& a, const SpaceCurve& b, bool along, double tolerance)
      : a_(a), b_(b), along_(along), tolerance_(tolerance) {}

  /// Point for point.
  [[nodiscard]] std::optional<double> at_same_parameters() const {
    const auto apart = [&](double part) {
      return norm(place_at_part(a_, part) - place_at_part(b_, along_ ? part : 1.0 - part));
    };
    double worst = apart(0.375);  // most borders that differ do so in the middle: no list for them
    if (worst > tolerance_) return std::nullopt;
    std::vector<double> parts = places_of(a_);
    for (const double part : places_of(b_)) parts.push_back(along_ ? part : 1.0 - part);
    parts.push_back(0.0);
    parts.push_back(1.0);
    for (const double part : parts) {
      worst = std::max(worst, apart(part));
      if (worst > tolerance_) return std::nullopt;
    }
    return worst;
  }

  /// Each point on the other curve, in order.
  [[nodiscard]] std::optional<double> at_other_parameters() const {
    const Vec3 middle = place_at_part(b_, 0.375);
    if (norm(evaluate(a_, nearest_parameter(a_, middle)).point - middle) > tolerance_) {
      return std::nullopt;
    }
    const auto to_a = covered(b_, a_);
    if (!to_a) return std::nullopt;
    const auto to_b = covered(a_, b_);
    if (!to_b) return std::nullopt;
    return std::max(*to_a, *to_b);
  }

 private:
  /// Largest distance of the points of one from the other.
  [[nodiscard]] std::optional<double> covered(const SpaceCurve& of, const SpaceCurve& by) const {
    double worst = 0.0, before = along_ ? domain(by).from : domain(by).to;
    for (const double part : places_of(of)) {
      const Vec3 point = place_at_part(of, part);
      double t = foot_near(by, point, before);
      double far = norm(evaluate(by, t).point - point);
      if (far > tolerance_) {
        t = nearest_parameter(by, point);
        far = norm(evaluate(by, t).point - point);
      }
      if (far > tolerance_) return std::nullopt;
      const bool back = along_ ? t <= before : t >= before;
      if (back && norm(evaluate(by, t).point - evaluate(by, before).point) > tolerance_) {
        return std::nullopt;
      }
      worst = std::max(worst, far);
      before = t;
    }
    return worst;
  }

  const SpaceCurve& a_;
  const SpaceCurve& b_;
  bool along_;
  double tolerance_;
};

bool is_point(const SpaceCurve& curve, double tolerance) {
  return std::all_of(curve.points.begin(), curve.points.end(),
                     [&](Vec3 p) { return norm(p - curve.points.front()) <= tolerance; });
}

class TopologyBuilder {
 public:
  TopologyBuilder(const std::vector<const NurbsSurface*>& patches, double tolerance)
      : patches_(patches), tolerance_(tolerance), grid_(out_.vertices, tolerance) {}

  Topology build() {
    out_.edge_of.resize(patches_.size());
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      for (const PatchSide side : kPatchSides) place(i, side);
    }
    return std::move(out_);
  }

 private:
  void place(std::size_t patch, PatchSide side) {
    TopologyEdge edge;
    edge.curve = border_of(*patches_[patch], side);
    edge.point = is_point(edge.curve, tolerance_);
    edge.from = grid_.at(edge.curve.points.front());
    edge.to = edge.point ? edge.from : grid_.at(edge.curve.points.back());
    if (!edge.point && joined_to_another(edge, patch, side)) return;
    const std::size_t number = out_.edges.size();
    if (!edge.point) between_[std::minmax(edge.from, edge.to)].push_back(number);
    edge.uses.push_back({patch, side, true, false, 0.0});
    out_.edge_of[patch][side] = number;
    out_.edges.push_back(std::move(edge));
  }

  bool joined_to_another(const TopologyEdge& edge, std::size_t patch, PatchSide side) {
    const auto found = between_.find(std::minmax(edge.from, edge.to));
    if (found == between_.end()) return false;
    for (const bool other_parameters : {false, true}) {
      for (const std::size_t number : found->second) {
        TopologyEdge& other = out_.edges[number];
        for (const bool along : {true, false}) {
          if ((along ? other.from : other.to) != edge.from) continue;
          const BorderPair pair(other.curve, edge.curve, along, tolerance_);
          const auto gap =
              other_parameters ? pair.at_other_parameters() : pair.at_same_parameters();
          if (!gap) continue;
          other.uses.push_back({patch, side, along, other_parameters, *gap});
          out_.edge_of[patch][side] = number;
          return true;
        }
      }
    }
    return false;
  }

  const std::vector<const NurbsSurface*>& patches_;
  double tolerance_;
  Topology out_;
  VertexGrid grid_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> between_;
};

}  // namespace

SpaceCurve border_of(const NurbsSurface& surface, PatchSide side) {
  const bool along_u = runs_along_u(side);
  const std::size_t n = surface.count_u(), m = surface.count_v();
  const std::size_t first = side == kVEnd ? (m - 1) * n : side == kUEnd ? n - 1 : 0;
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

const EdgeUse& Topology::use(std::size_t patch, PatchSide side) const {
  const std::vector<EdgeUse>& uses = edges[edge_of[patch][side]].uses;
  return *std::find_if(uses.begin(), uses.end(),
                       [&](const EdgeUse& use) { return use.patch == patch && use.side == side; });
}

Topology topology_of(const std::vector<const NurbsSurface*>& patches, double tolerance) {
  return TopologyBuilder(patches, tolerance).build();
}

Topology topology_of(const SurfaceModel& model) {
  return topology_of(surfaces_of(model), kSameBorder * size_of(model));
}

double nearest_parameter(const SpaceCurve& curve, Vec3 point) {
  const Range range = domain(curve);
  double t = range.from, least = norm(evaluate(curve, t).point - point);
  const auto look_at = [&](double next) {
    const double far = norm(evaluate(curve, next).point - point);
    if (far >= least) return;
    least = far;
    t = next;
  };
  for (const double part : places_of(curve)) look_at(range.at(part));
  look_at(range.to);
  return foot_near(curve, point, t);
}

}  // namespace obvid
