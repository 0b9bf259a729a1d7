// SPDX-License-Identifier: Apache-2.0
#include "fit/outside_regions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/form.h"
#include "fit/parts.h"
#include "obvid/core/units.h"
#include "obvid/curve/internal/runs.h"
#include "obvid/geom/internal/chord.h"
#include "obvid/region/internal/boundary_distance.h"
#include "obvid/region/internal/segment_region.h"

namespace obvid::pipeline_detail {
namespace {

/// What coordinates cannot tell, of the contour's extent from the origin: inside all the same.
constexpr double kCoordinateRounding = 0x1p-48;

double distance_from(const LinePiece& line, Vec2 p) {
  return distance_from_chord(p, line.start, line.end);
}

double distance_from(const ArcPiece& arc, Vec2 p) {
  const Vec2 v = p - arc.start, ahead = unit_at(arc.theta0);
  // seen from the start: the angle at the centre, the way the arc turns, a whole turn at most
  const double side = std::copysign(1.0, arc.kappa);
  const Vec2 radius = arc.kappa * v - left_normal(ahead);
  double angle = side * turning(-left_normal(ahead), radius);
  if (angle < 0.0) angle += kFullTurn;
  if (angle > std::abs(arc.kappa * arc.length)) return std::min(norm(v), norm(p - arc.end));
  // | |p - centre| - R | without the cancellation of a large circle
  return std::abs(dot(v, v) * arc.kappa - 2.0 * dot(v, left_normal(ahead))) / (norm(radius) + 1.0);
}

class Regions {
 public:
  explicit Regions(const Contour& spirals)
      : spirals_(spirals), direction_(piece_directions(spirals)) {
    for (const Joint& joint : spirals.joints) {
      const Vec2 p = joint.element.point;
      rounding_ = std::max(rounding_, kCoordinateRounding * (std::abs(p.x) + std::abs(p.y)));
    }
    enter(0);
  }

  /// Goes on to the link in which p lies, before the link `end`, and measures p there.
  void add(Vec2 p, std::size_t end) {
    while (link_ + 1 < end && beyond(p)) enter(link_ + 1);
    if (direction_[link_] == 0) return add_beside_arc(p);
    if (!region_) return;
    const Vec2 v = p - start_.point;
    const Vec2 local = {dot(along_, v), cross(along_, v)};
    const double near_start = boundary_distance(frame_, region_->from_start, local);
    const double near_end = boundary_distance(frame_, region_->to_end, local);
    const double nearer = std::min(near_start, near_end);
    if (nearer > rounding_ && !between(local)) outside_ = std::max(outside_, nearer);
  }

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

  [[nodiscard]] double outside() const { return outside_; }

 private:
  void add_beside_arc(Vec2 p) {
    const Piece& piece = spirals_.pieces[link_];
    const auto* line = std::get_if<LinePiece>(&piece);
    const auto* arc = std::get_if<ArcPiece>(&piece);
    if (line == nullptr && arc == nullptr) return;
    const double away = line != nullptr ? distance_from(*line, p) : distance_from(*arc, p);
    if (away > rounding_) outside_ = std::max(outside_, away);
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
  double outside_ = 0.0;
};

}  // namespace

std::optional<std::size_t> station_of(const Contour& contour, std::size_t joint) {
  const Joint& one = contour.joints[joint];
  if (one.source || !one.after) return one.source;
  return contour.points.size() + *one.after;
}

double distance_outside_regions(const Contour& spirals, const std::vector<CurvePoint>& points,
                                Watch& watch) {
  if (spirals.pieces.empty()) return 0.0;
  const std::size_t links = spirals.pieces.size();
  // that starts at an input point, or at a corner between two
  std::vector<std::size_t> link_of(2 * spirals.points.size(), links);
  for (std::size_t j = 0; j < links; ++j) {
    const auto source = station_of(spirals, j);
    if (source && *source < link_of.size()) link_of[*source] = j;
  }
  const auto link_at = [&](const CurvePoint& p) {
    return p.source && *p.source < link_of.size() ? link_of[*p.source] : links;
  };
  std::vector<std::size_t> end(points.size(),
                               links);  // link of the next input point, seen from each
  for (std::size_t i = points.size(); i-- > 1;) {
    const std::size_t link = link_at(points[i]);
    end[i - 1] = link < links ? link : end[i];
  }
  Regions regions(spirals);
  for (std::size_t i = 0; i < points.size() && !watch.cancelled(); ++i) {
    if (const std::size_t link = link_at(points[i]); link < links) regions.enter(link);
    regions.add(points[i].point, end[i]);
  }
  return regions.outside();
}

}  // namespace obvid::pipeline_detail
