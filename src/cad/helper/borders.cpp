// SPDX-License-Identifier: Apache-2.0
#include "borders.h"

#include <algorithm>
#include <utility>

namespace obvid::cad {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

class Joiner {
 public:
  Joiner(const std::vector<NurbsSurface>& patches, const Topology& topology, JoinedWith joined)
      : patches_(patches), topology_(topology), joined_(joined) {}

  Joints join() {
    out_.vertices = topology_.vertices;
    out_.sides.resize(patches_.size());
    out_.turned.assign(patches_.size(), false);
    for (const TopologyEdge& edge : topology_.edges) place(edge);
    group();
    return std::move(out_);
  }

 private:
  void place(const TopologyEdge& edge) {
    std::vector<bool> placed(edge.uses.size(), false);
    for (std::size_t i = 0; i < edge.uses.size(); ++i) {
      if (placed[i]) continue;
      const EdgeUse& first = edge.uses[i];
      const std::size_t number = add(edge, first);
      for (std::size_t k = i + 1; k < edge.uses.size(); ++k) {
        const EdgeUse& second = edge.uses[k];
        if (placed[k] || !may_join(first, second)) continue;
        JointEdge& joint = out_.edges[number];
        joint.gap = first.gap + second.gap;
        joint.uses = 2;
        out_.sides[second.patch][second.side] = {number, first.along == second.along,
                                                 first.other_parameters || second.other_parameters};
        partners_[number] = second;
        placed[k] = true;
        break;
      }
    }
  }

  /// An edge that runs as this side does.
  std::size_t add(const TopologyEdge& edge, const EdgeUse& use) {
    JointEdge joint;
    joint.curve = border_of(patches_[use.patch], use.side);
    joint.from = use.along ? edge.from : edge.to;
    joint.to = use.along ? edge.to : edge.from;
    joint.point = edge.point;
    const std::size_t number = out_.edges.size();
    out_.sides[use.patch][use.side] = {number, true, false};
    out_.edges.push_back(std::move(joint));
    owners_.push_back(use);
    partners_.push_back(kNobody);
    return number;
  }

  [[nodiscard]] bool may_join(const EdgeUse& a, const EdgeUse& b) const {
    if (a.patch != b.patch) return joined_ == JoinedWith::kAll;
    return a.along == b.along && opposite(a.side) == b.side;
  }

  void group() {
    std::vector<bool> seen(patches_.size(), false);
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      if (seen[i]) continue;
      Joined group{{i}, true};
      seen[i] = true;
      for (std::size_t k = 0; k < group.patches.size(); ++k) {
        for (const PatchSide side : kPatchSides) visit(group.patches[k], side, seen, group);
      }
      std::sort(group.patches.begin(), group.patches.end());
      for (const std::size_t p : group.patches) {
        for (const JointUse& use : out_.sides[p]) {
          const JointEdge& edge = out_.edges[use.edge];
          if (!edge.point && edge.uses < 2) group.closed = false;
        }
      }
      out_.groups.push_back(std::move(group));
    }
  }

  /// The neighbour at this side joins the group, turned round when its normal is on the other side.
  void visit(std::size_t patch, PatchSide side, std::vector<bool>& seen, Joined& group) {
    const std::size_t edge = out_.sides[patch][side].edge;
    const EdgeUse first = owners_[edge], second = partners_[edge];
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

  [[nodiscard]] const JointUse& use(const EdgeUse& at) const {
    return out_.sides[at.patch][at.side];
  }

  /// The second patch of an edge gets one of its own.
  void separate(std::size_t number) {
    const EdgeUse second = partners_[number];
    JointEdge own = out_.edges[number];
    own.curve = border_of(patches_[second.patch], second.side);
    if (!use(second).along) std::swap(own.from, own.to);
    own.uses = out_.edges[number].uses = 1;
    partners_[number] = kNobody;
    out_.sides[second.patch][second.side] = {out_.edges.size(), true, false};
    out_.edges.push_back(std::move(own));
    owners_.push_back(second);
    partners_.push_back(kNobody);
  }

  static constexpr EdgeUse kNobody{kNone, kUStart, true, false, 0.0};

  const std::vector<NurbsSurface>& patches_;
  const Topology& topology_;
  JoinedWith joined_;
  Joints out_;
  std::vector<EdgeUse> owners_, partners_;  ///< first and second side of each edge
};

}  // namespace

Joints joints_of(const std::vector<NurbsSurface>& patches, const Topology& topology,
                 JoinedWith joined) {
  return Joiner(patches, topology, joined).join();
}

}  // namespace obvid::cad
