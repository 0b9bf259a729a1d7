// SPDX-License-Identifier: Apache-2.0
#include "obvid/mesh/mesh_cut.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "obvid/numeric/internal/wide.h"

namespace obvid {
namespace {

using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;  // smaller corner first

/// A triangle's part of the section: from the edge that goes down to the one that goes up, so that
/// the body lies to the left.
struct CutEdge {
  EdgeKey from, to;
};

/// One end of a cut edge on an edge of the mesh.
struct EdgeEnd {
  EdgeKey key;
  std::size_t cut = 0;
  bool is_start = false;
};

constexpr std::size_t kNoPartner = static_cast<std::size_t>(-1);

EdgeKey key_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

Error cut_error(ErrorCode code, const char* what, std::size_t place) {
  return {code, what, "triangle " + std::to_string(place), "", static_cast<std::ptrdiff_t>(place)};
}

Result<std::vector<double>> heights_over(const TriangleMesh& mesh, const Frame& plane) {
  std::vector<double> out;
  out.reserve(mesh.points.size());
  for (const Vec3& p : mesh.points) {
    const double height = plane.height(p);
    if (!std::isfinite(height)) {
      return error(ErrorCode::kNotFinite, "a point of the mesh, or the plane, is not finite")
          .where("point " + std::to_string(out.size()))
          .point(out.size());
    }
    out.push_back(height);
  }
  return out;
}

Result<std::vector<CutEdge>> cut_edges(const TriangleMesh& mesh,
                                       const std::vector<double>& heights) {
  std::vector<CutEdge> out;
  const bool lowest =
      std::none_of(heights.begin(), heights.end(), [](double height) { return height < 0.0; });
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    if (std::max({t[0], t[1], t[2]}) >= heights.size()) {
      return fail(cut_error(ErrorCode::kBadCount, "a triangle has a corner without a point", i));
    }
    const auto is_above = [&](std::uint32_t corner) {
      return heights[corner] > 0.0 || (heights[corner] == 0.0 && !lowest);
    };
    const std::array<bool, 3> above{is_above(t[0]), is_above(t[1]), is_above(t[2])};
    if (above[0] == above[1] && above[1] == above[2]) continue;
    CutEdge cut;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (above[k] == above[next]) continue;
      (above[k] ? cut.from : cut.to) = key_of(t[k], t[next]);
    }
    out.push_back(cut);
  }
  return out;
}

/// For both ends of each cut (start: 2 i, end: 2 i + 1) the end of another one on the same edge of
/// the mesh; none where it is not exactly one.
std::vector<std::size_t> partners_of(const std::vector<CutEdge>& cuts) {
  std::vector<EdgeEnd> ends;
  ends.reserve(2 * cuts.size());
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    ends.push_back({cuts[i].from, i, true});
    ends.push_back({cuts[i].to, i, false});
  }
  std::sort(ends.begin(), ends.end(), [](const EdgeEnd& a, const EdgeEnd& b) {
    return std::tie(a.key, a.cut, a.is_start) < std::tie(b.key, b.cut, b.is_start);
  });
  const auto place = [](const EdgeEnd& end) { return 2 * end.cut + (end.is_start ? 0U : 1U); };
  std::vector<std::size_t> out(2 * cuts.size(), kNoPartner);
  for (std::size_t i = 0; i < ends.size();) {
    std::size_t next = i + 1;
    while (next < ends.size() && ends[next].key == ends[i].key) ++next;
    if (next - i == 2) {
      out[place(ends[i])] = place(ends[i + 1]);
      out[place(ends[i + 1])] = place(ends[i]);
    }
    i = next;
  }
  return out;
}

/// Where an edge of the mesh crosses the plane; a corner in the plane gives itself.
Vec2 crossing_of(const TriangleMesh& mesh, const std::vector<double>& heights, const Frame& plane,
                 EdgeKey edge) {
  const double below = heights[edge.first], over = heights[edge.second];
  const Vec2 a = plane.in_plane(mesh.points[edge.first]),
             b = plane.in_plane(mesh.points[edge.second]);
  if (below == 0.0) return a;
  if (over == 0.0) return b;
  return a + (below / (below - over)) * (b - a);
}

class Chains {
 public:
  Chains(const TriangleMesh& mesh, const Frame& plane, std::vector<double> heights,
         std::vector<CutEdge> cuts)
      : mesh_(mesh),
        plane_(plane),
        heights_(std::move(heights)),
        cuts_(std::move(cuts)),
        partners_(partners_of(cuts_)),
        used_(cuts_.size(), false) {
    constexpr double kRoundings = 32.0;
    double farthest = 0.0;
    for (const Vec3 p : mesh.points) farthest = std::max(farthest, norm(p));
    rounding_ = kRoundings * numeric::kUnitRoundoff * (farthest + norm(plane.origin));
  }

  std::vector<MeshSection> all() {
    std::vector<MeshSection> out;
    for (const bool open : {true, false}) {
      for (std::size_t i = 0; i < cuts_.size(); ++i) {
        if (used_[i] || (open && partners_[2 * i] != kNoPartner)) continue;
        add(walk(2 * i), out);
      }
      if (!open) continue;
      // triangles that look the other way may begin with the far end
      for (std::size_t i = 0; i < cuts_.size(); ++i) {
        if (!used_[i] && partners_[2 * i + 1] == kNoPartner) add(walk(2 * i + 1), out);
      }
    }
    return out;
  }

 private:
  EdgeKey edge_at(std::size_t end) const {
    const CutEdge& cut = cuts_[end / 2];
    return end % 2 == 0 ? cut.from : cut.to;
  }

  void put(MeshSection& chain, std::size_t end) const {
    const Vec2 p = crossing_of(mesh_, heights_, plane_, edge_at(end));
    if (chain.points.empty() || !is_same_place(chain.points.back(), p)) chain.points.push_back(p);
  }

  /// Edges that meet in a corner which lies in the plane but for rounding are cut in one place.
  [[nodiscard]] bool is_same_place(Vec2 a, Vec2 b) const { return norm(a - b) <= rounding_; }

  /// From one end of a cut to wherever the chain ends.
  MeshSection walk(std::size_t start) {
    MeshSection chain;
    std::size_t against = 0, along = 0, end = start;
    put(chain, end);
    while (true) {
      used_[end / 2] = true;
      ++(end % 2 == 0 ? along : against);
      const std::size_t far = end ^ 1U;
      const std::size_t next = partners_[far];
      put(chain, far);
      if (next == kNoPartner) break;
      if (next / 2 == start / 2) {
        chain.closed = true;
        break;
      }
      end = next;
    }
    if (chain.closed && chain.points.size() > 1 &&
        is_same_place(chain.points.front(), chain.points.back())) {
      chain.points.pop_back();
    }
    if (!chain.closed) close_seam(chain);
    if (against > along) std::reverse(chain.points.begin(), chain.points.end());
    chain.turned = std::min(against, along);
    return chain;
  }

  /// A seam of a mesh, along which its corners are two but for rounding, opens no section.
  static void close_seam(MeshSection& chain) {
    constexpr std::size_t kFewest = 4;
    constexpr double kOfSeam = 1e-9;  // of the section: single precision of files is coarser, but
                                      // there corners of a seam are the same
    if (chain.points.size() < kFewest) return;
    double size = 0.0;
    for (const Vec2 p : chain.points) size = std::max(size, norm(p - chain.points.front()));
    if (norm(chain.points.back() - chain.points.front()) > kOfSeam * size) return;
    chain.closed = true;
    chain.points.pop_back();
  }

  static void add(MeshSection chain, std::vector<MeshSection>& out) {
    if (chain.points.size() < 2) return;  // touched only
    if (chain.closed) {
      const auto rightmost = std::max_element(
          chain.points.begin(), chain.points.end(),
          [](Vec2 a, Vec2 b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
      std::rotate(chain.points.begin(), rightmost, chain.points.end());
    }
    out.push_back(std::move(chain));
  }

  const TriangleMesh& mesh_;
  const Frame& plane_;
  std::vector<double> heights_;
  std::vector<CutEdge> cuts_;
  std::vector<std::size_t> partners_;
  std::vector<bool> used_;
  double rounding_ = 0.0;  ///< of places of cuts, units
};

double chain_length(const MeshSection& chain) {
  double out = 0.0;
  for (std::size_t i = 1; i < chain.points.size(); ++i) {
    out += norm(chain.points[i] - chain.points[i - 1]);
  }
  if (chain.closed) out += norm(chain.points.front() - chain.points.back());
  return out;
}

}  // namespace

Result<Box3> bounds_of(const TriangleMesh& mesh) {
  if (mesh.points.empty()) {
    return fail({ErrorCode::kTooFewPoints, "a mesh without points", "", ""});
  }
  Box3 out;
  out.add_all(mesh.points);
  return out;
}

Result<std::vector<MeshSection>> cut_mesh(const TriangleMesh& mesh, const Frame& plane) {
  auto heights = heights_over(mesh, plane);
  OBVID_TRY(heights);
  auto cuts = cut_edges(mesh, *heights);
  OBVID_TRY(cuts);
  std::vector<MeshSection> chains =
      Chains(mesh, plane, std::move(*heights), std::move(*cuts)).all();
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < chains.size(); ++i) order.emplace_back(-chain_length(chains[i]), i);
  std::sort(order.begin(), order.end());
  std::vector<MeshSection> out;
  for (const auto& [length, i] : order) out.push_back(std::move(chains[i]));
  return out;
}

}  // namespace obvid
