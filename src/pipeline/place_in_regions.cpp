// SPDX-License-Identifier: Apache-2.0
#include "place_in_regions.h"

#include <algorithm>
#include <cmath>

#include "form.h"
#include "obvid/region/boundary_distance.h"
#include "obvid/region/segment_region.h"

namespace obvid::pipeline_detail {
namespace {

/// What coordinates cannot tell, of the contour's extent from the origin: inside all the same.
constexpr double kRounding = 0x1p-48;

class Regions {
 public:
  explicit Regions(const Contour& spirals)
      : spirals_(spirals), direction_(piece_directions(spirals)) {
    for (const Joint& joint : spirals.joints) {
      const Vec2 p = joint.element.point;
      rounding_ = std::max(rounding_, kRounding * (std::abs(p.x) + std::abs(p.y)));
    }
    enter(0);
  }

  void add(Vec2 p) {
    while (link_ + 1 < spirals_.pieces.size() && beyond(p)) enter(link_ + 1);
    if (!region_) return;
    const Vec2 v = p - start_.point;
    const Vec2 local = {dot(along_, v), cross(along_, v)};
    const double near_start = boundary_distance(frame_, region_->from_start, local);
    const double near_end = boundary_distance(frame_, region_->to_end, local);
    out_.farther = std::max({out_.farther, near_start, near_end});
    const double nearer = std::min(near_start, near_end);
    if (nearer > rounding_ && !between(local)) out_.outside = std::max(out_.outside, nearer);
  }

  [[nodiscard]] RegionDistances distances() const { return out_; }

 private:
  void enter(std::size_t link) {
    link_ = link;
    const Joint& from = spirals_.joints[link];
    start_ = from.leaving ? *from.leaving : from.element;
    end_ = spirals_.joints[(link + 1) % spirals_.joints.size()].element;
    region_.reset();
    if (direction_[link] == 0) return;
    frame_ = chord_frame(start_, end_);
    along_ = (end_.point - start_.point) / frame_.h;
    region_ = segment_region(frame_, direction_[link]);
  }

  /// Past the normal at the end of the link, and not still beside its start.
  [[nodiscard]] bool beyond(Vec2 p) const {
    const Vec2 v = p - end_.point;
    return dot(v, unit_at(end_.theta)) > 0.0 && norm(v) < norm(p - start_.point);
  }

  [[nodiscard]] bool between(Vec2 local) const {
    const double x = std::clamp(local.x, 0.0, frame_.h);
    const auto a = ordinate_over_chord(frame_, region_->from_start, x);
    const auto b = ordinate_over_chord(frame_, region_->to_end, x);
    // headings a right angle or more from the chord: no ordinates tell
    if (!a || !b) return true;
    return local.x >= 0.0 && local.x <= frame_.h && local.y >= std::min(*a, *b) &&
           local.y <= std::max(*a, *b);
  }

  const Contour& spirals_;
  std::vector<int> direction_;
  double rounding_ = 0.0;
  std::size_t link_ = 0;
  Element start_, end_;
  ChordFrame frame_;
  Vec2 along_;
  std::optional<SegmentRegion> region_;
  RegionDistances out_;
};

}  // namespace

RegionDistances place_in_regions(const Contour& spirals, const std::vector<Vec2>& points) {
  if (spirals.pieces.empty()) return {};
  Regions regions(spirals);
  for (const Vec2 p : points) regions.add(p);
  return regions.distances();
}

}  // namespace obvid::pipeline_detail
