// SPDX-License-Identifier: Apache-2.0
#include "contour_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace obvid {
namespace {

constexpr int kSamplesPerSpan = 16;
constexpr double kContourCorner = 1e-5;  // rad

std::vector<double> breaks_of(const NurbsCurve& curve) {
  std::vector<double> out = curve.knots;
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// Parts between knots at which the direction jumps.
std::vector<NurbsCurve> smooth_parts_of(const NurbsCurve& curve) {
  std::vector<NurbsCurve> out;
  NurbsCurve left = curve;
  const std::vector<double> breaks = breaks_of(curve);
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
    const auto times = std::count(curve.knots.begin(), curve.knots.end(), breaks[i]);
    if (times < curve.degree) continue;
    auto parts = split(left, breaks[i]);
    const Vec2 before = evaluate(parts[0], breaks[i]).d1, after = evaluate(parts[1], breaks[i]).d1;
    if (std::abs(turning(before, after)) <= kContourCorner) continue;
    out.push_back(std::move(parts[0]));
    left = std::move(parts[1]);
  }
  out.push_back(std::move(left));
  return out;
}

}  // namespace

Result<ContourField> ContourField::of(const ProjectedContour& contour, double small) {
  ContourField out;
  out.frame_ = contour.frame;
  for (const NurbsCurve& curve : contour.curves) {
    OBVID_TRY(check(curve));
    for (NurbsCurve& part : smooth_parts_of(curve)) out.curves_.push_back(std::move(part));
  }
  const auto open = [](double gap) {
    return error(ErrorCode::kBadOption, "the contour is not closed")
        .hint("give a contour that returns to its first point")
        .value(gap);
  };
  if (out.curves_.empty()) return open(0.0);
  double area = 0.0;
  for (std::size_t c = 0; c < out.curves_.size(); ++c) {
    const NurbsCurve& curve = out.curves_[c];
    const Vec2 next = out.curves_[(c + 1) % out.curves_.size()].points.front();
    const double gap = norm(curve.points.back() - next);
    if (gap > small) return open(gap);
  }
  const auto sample = [&] {
    out.samples_.clear();
    for (std::size_t c = 0; c < out.curves_.size(); ++c) {
      const std::vector<double> breaks = breaks_of(out.curves_[c]);
      for (std::size_t i = 1; i < breaks.size(); ++i) {
        for (int k = 0; k < kSamplesPerSpan; ++k) {
          const double t =
              Range{breaks[i - 1], breaks[i]}.at(static_cast<double>(k) / kSamplesPerSpan);
          out.samples_.push_back({c, t, evaluate(out.curves_[c], t).point});
        }
      }
    }
  };
  sample();
  const Vec2 origin = out.samples_.front().point;
  for (std::size_t i = 0; i < out.samples_.size(); ++i) {
    out.box_.add(out.samples_[i].point);
    area += cross(out.samples_[i].point - origin,
                  out.samples_[(i + 1) % out.samples_.size()].point - origin);
  }
  if (area < 0.0) {
    std::reverse(out.curves_.begin(), out.curves_.end());
    for (NurbsCurve& curve : out.curves_) curve = reversed(curve);
    sample();
  }
  for (const NurbsCurve& curve : out.curves_) {
    for (const Vec2 p : curve.points) out.box_.add(p);  // the curve lies in their hull
  }
  for (std::size_t c = 0; c < out.curves_.size(); ++c) {
    const std::size_t before = (c + out.curves_.size() - 1) % out.curves_.size();
    const double t = domain(out.curves_[c]).from;
    const Vec2 ends = evaluate(out.curves_[before], domain(out.curves_[before]).to).d1;
    if (std::abs(turning(ends, evaluate(out.curves_[c], t).d1)) <= kContourCorner) continue;
    const Vec2 p = evaluate(out.curves_[c], t).point;
    out.corners_.push_back(
        {out.frame_.origin + p.x * out.frame_.x + p.y * out.frame_.y, out.frame_.x, out.frame_.y});
  }
  return out;
}

ContourField::Foot ContourField::foot(Vec2 p) const {
  constexpr int kMostFootSteps = 30;
  // Newton's method from the nearest few samples, each the nearest of its neighbours
  const std::size_t n = samples_.size();
  const auto far = [&](std::size_t i) { return norm(samples_[i % n].point - p); };
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i < n; ++i) nearest = std::min(nearest, far(i));
  Foot best{0, 0.0, {HUGE_VAL, HUGE_VAL}};
  for (std::size_t i = 0; i < n; ++i) {
    const double here = far(i);
    const double step = std::max(norm(samples_[(i + 1) % n].point - samples_[i].point),
                                 norm(samples_[(i + n - 1) % n].point - samples_[i].point));
    if (here > nearest + step || here > far(i + n - 1) || here > far(i + 1)) continue;
    // the sample may be where two curves meet: both are looked at
    const Sample& here_at = samples_[i];
    const std::size_t before = samples_[(i + n - 1) % n].curve;
    std::vector<std::pair<std::size_t, double>> starts{{here_at.curve, here_at.t}};
    if (here_at.t == domain(curves_[here_at.curve]).from) {
      starts.emplace_back(before, domain(curves_[before]).to);
    }
    for (const auto& [c, start] : starts) {
      const NurbsCurve& curve = curves_[c];
      const Range all = domain(curve);
      double t = start;
      Jet jet = evaluate(curve, t);
      for (int k = 0; k < kMostFootSteps; ++k) {
        const Vec2 off = p - jet.point;
        const double slope = dot(jet.d1, jet.d1) - dot(off, jet.d2);
        const double full =
            slope > 0.0 ? dot(off, jet.d1) / slope : dot(off, jet.d1) / dot(jet.d1, jet.d1);
        double moved = full;
        bool nearer = false;
        for (int half = 0; half < 8 && !nearer; ++half, moved *= 0.5) {
          const double next = std::clamp(t + moved, all.from, all.to);
          const Jet there = evaluate(curve, next);
          if (!(norm(p - there.point) < norm(off))) continue;
          t = next;
          jet = there;
          nearer = true;
        }
        if (!nearer) break;
      }
      if (norm(p - jet.point) < norm(best.off)) best = {c, t, p - jet.point};
    }
  }
  return best;
}

/// Direction of the contour at the end of a curve, on this curve or on its neighbour.
Vec2 ContourField::along(std::size_t curve, double t, bool after) const {
  const std::size_t n = curves_.size();
  const Range all = domain(curves_[curve]);
  if (after && t >= all.to) {
    const NurbsCurve& next = curves_[(curve + 1) % n];
    return evaluate(next, domain(next).from).d1;
  }
  if (!after && t <= all.from) {
    const NurbsCurve& before = curves_[(curve + n - 1) % n];
    return evaluate(before, domain(before).to).d1;
  }
  return evaluate(curves_[curve], t).d1;
}

double ContourField::value(Vec3 p) const {
  const Foot there = foot(frame_.in_plane(p));
  const Vec2 before = along(there.curve, there.t, false), after = along(there.curve, there.t, true);
  const bool left_before = cross(before, there.off) > 0.0,
             left_after = cross(after, there.off) > 0.0;
  // where it turns to the left inside is left of both, else of one
  const bool inside =
      cross(before, after) >= 0.0 ? left_before && left_after : left_before || left_after;
  return inside ? norm(there.off) : -norm(there.off);
}

Vec3 ContourField::rise(Vec3 p) const {
  const Foot there = foot(frame_.in_plane(p));
  const Vec2 d = evaluate(curves_[there.curve], there.t).d1;
  const Vec2 inwards = (1.0 / norm(d)) * left_normal(d);
  return inwards.x * frame_.x + inwards.y * frame_.y;
}

bool ContourField::is_beside(const std::vector<Vec3>& points) const {
  Box2 box;
  for (const Vec3 p : points) box.add(frame_.in_plane(p));
  return box.high.x < box_.low.x || box.low.x > box_.high.x || box.high.y < box_.low.y ||
         box.low.y > box_.high.y;
}

}  // namespace obvid
