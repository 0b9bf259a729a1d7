// SPDX-License-Identifier: Apache-2.0
#include "inside_trims.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "meeting_ends.h"
#include "obvid/geom/internal/box.h"
#include "obvid/numeric/internal/halving.h"
#include "obvid/surface/internal/trim.h"
#include "strands.h"
#include "trim_line.h"

namespace obvid {
namespace {

class TrimClipper {
 public:
  TrimClipper(const SurfaceModel& model, const CutPlane& plane)
      : model_(model),
        field_{[plane](Vec3 p) { return dot(plane.normal, p) - plane.offset; },
               [plane](Vec3) { return plane.normal; }} {
    for (const SurfacePatch& patch : model.patches) {
      regions_.push_back(patch.trims.empty() ? nullptr : std::make_unique<TrimRegion>(patch));
    }
  }

  void clip(const SectionBranch& branch, std::vector<SectionBranch>& out) const {
    const auto take = [&](SectionBranch part) {
      once_at_borders(part);
      if (part.points.size() > 1) out.push_back(std::move(part));
    };
    std::vector<Dense> places = dense(branch);
    const auto outside =
        std::find_if(places.begin(), places.end(), [](const Dense& one) { return !one.inside; });
    if (outside == places.end()) {
      take(branch);
      return;
    }
    if (branch.closed) {
      std::rotate(places.begin(), outside, places.end());
      places.push_back(places.front());
    }
    for (std::size_t i = 0; i < places.size();) {
      if (!places[i].inside) {
        ++i;
        continue;
      }
      SectionBranch part;
      part.gap = branch.gap;
      part.deviation = branch.deviation;
      if (i > 0 && !places[i - 1].place.stands_again) {
        add_end(places[i].place, places[i - 1].place, part.points);
      }
      std::size_t end = i;
      for (; end < places.size() && places[end].inside; ++end) {
        if (places[end].given) part.points.push_back(places[end].place);
      }
      if (end < places.size() && !places[end - 1].place.stands_again) {
        add_end(places[end - 1].place, places[end].place, part.points);
      }
      take(std::move(part));
      i = end;
    }
  }

  [[nodiscard]] bool is_there(const SectionPoint& p) const {
    if (!regions_[p.patch]) return true;
    // trims run along sides of the patch but for rounding
    constexpr double kOnSide = 1e-12;  // of the domain
    const NurbsSurface& s = model_.patches[p.patch].surface;
    const auto inward = [](double at, const Range& range) {
      const double step = kOnSide * range.length();
      return std::clamp(at, range.from + step, range.to - step);
    };
    return regions_[p.patch]->contains(inward(p.u, domain_u(s)), inward(p.v, domain_v(s)));
  }

 private:
  struct Dense {
    SectionPoint place;
    bool given = true;  ///< a place of the branch, else one between
    bool inside = true;
  };
  /// The places of a branch, with others between them on patches that are trimmed.
  [[nodiscard]] std::vector<Dense> dense(const SectionBranch& branch) const {
    constexpr std::size_t kPlaces = 512, kLeast = 4;
    const std::vector<SectionPoint>& points = branch.points;
    const std::size_t parts = kLeast + kPlaces / points.size();
    std::vector<Dense> out;
    for (std::size_t i = 0; i < points.size(); ++i) {
      out.push_back({points[i], true, is_there(points[i])});
      if (i + 1 == points.size() && !branch.closed) break;
      const SectionPoint& next = points[(i + 1) % points.size()];
      if (points[i].stands_again || !regions_[next.patch]) continue;
      const NurbsSurface& s = model_.patches[next.patch].surface;
      for (std::size_t k = 1; k < parts; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(parts);
        const Vec2 p = onto_cut(s, field_,
                                Vec2{points[i].u, points[i].v} +
                                    part * Vec2{next.u - points[i].u, next.v - points[i].v});
        const SectionPoint place{evaluate(s, p.x, p.y).point, next.patch, p.x, p.y};
        out.push_back({place, false, is_there(place)});
      }
    }
    return out;
  }

  /// The place where the trim is crossed between one inside and one outside.
  void add_end(const SectionPoint& in, const SectionPoint& beyond,
               std::vector<SectionPoint>& into) const {
    const NurbsSurface& s = model_.patches[in.patch].surface;
    const auto at = [&](double part) {
      const Vec2 p =
          onto_cut(s, field_, Vec2{in.u, in.v} + part * Vec2{beyond.u - in.u, beyond.v - in.v});
      return SectionPoint{evaluate(s, p.x, p.y).point, in.patch, p.x, p.y};
    };
    constexpr int kHalvings = 60;
    const double last = end_of_condition(
                            0.0, 1.0, [&](double part) { return is_there(at(part)); }, kHalvings)
                            .holds;
    into.push_back(last > 0.0 ? at(last) : in);
  }

  static void once_at_borders(SectionBranch& part) {
    std::vector<SectionPoint> once;
    for (std::size_t i = 0; i < part.points.size(); ++i) {
      const bool goes_on = i + 1 < part.points.size() || part.closed;
      if (goes_on && part.points[i].stands_again) continue;
      once.push_back(part.points[i]);
      once.back().stands_again = false;
    }
    part.points = std::move(once);
  }

  const SurfaceModel& model_;
  CuttingField field_;
  std::vector<std::unique_ptr<TrimRegion>> regions_;
};

bool is_longer(const SectionBranch& branch, double length) {
  Box3 box;
  for (const SectionPoint& p : branch.points) box.add(p.point);
  return box.diagonal() > length;
}

/// Open branches joined where their ends meet, the nearest first.
class EndJoiner {
 public:
  EndJoiner(std::vector<SectionBranch> branches, double meet)
      : branches_(std::move(branches)), meet_(meet), mate_(2 * branches_.size(), kNoEnd) {}

  std::vector<SectionBranch> made() {
    find_mates();
    std::vector<SectionBranch> out;
    std::vector<bool> seen(branches_.size(), false);
    const auto walk_from = [&](std::size_t end) {
      if (!seen[end / 2]) out.push_back(walked(end, seen));
    };
    // open chains from their free ends first, then rings
    for (std::size_t end = 0; end < mate_.size(); ++end) {
      if (mate_[end] == kNoEnd) walk_from(end);
    }
    for (std::size_t i = 0; i < branches_.size(); ++i) walk_from(2 * i);
    return out;
  }

 private:
  /// Ends by number: 2 * branch, and 1 more for the last place.
  [[nodiscard]] Vec3 place(std::size_t end) const {
    const std::vector<SectionPoint>& points = branches_[end / 2].points;
    return (end % 2 == 0 ? points.front() : points.back()).point;
  }

  void find_mates() {
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i < branches_.size(); ++i) {
      if (!branches_[i].closed) ends.insert(ends.end(), {2 * i, 2 * i + 1});
    }
    const auto mates = meeting_ends(
        std::move(ends), meet_, [&](std::size_t end) { return place(end); },
        [&](std::size_t a, std::size_t b) {  // a branch no longer than that does not close
          return a / 2 != b / 2 || is_longer(branches_[a / 2], meet_);
        });
    for (const auto& [a, b] : mates) {
      mate_[a] = b;
      mate_[b] = a;
    }
  }

  SectionBranch walked(std::size_t start, std::vector<bool>& seen) {
    SectionBranch whole;
    whole.closed = branches_[start / 2].closed;
    for (std::size_t here = start;;) {
      seen[here / 2] = true;
      SectionBranch& branch = branches_[here / 2];
      if (here % 2 == 1) std::reverse(branch.points.begin(), branch.points.end());
      whole.points.insert(whole.points.end(), branch.points.begin(), branch.points.end());
      whole.gap = std::max(whole.gap, branch.gap);
      whole.deviation = std::max(whole.deviation, branch.deviation);
      const std::size_t next = mate_[here ^ 1U];
      if (next == kNoEnd) return whole;
      const Vec3 first = next == start ? whole.points.front().point : place(next);
      whole.gap = std::max(whole.gap, norm(whole.points.back().point - first));
      whole.points.pop_back();
      if (next == start) {
        whole.closed = true;
        return whole;
      }
      here = next;
    }
  }

  std::vector<SectionBranch> branches_;
  double meet_;
  std::vector<std::size_t> mate_;
};

}  // namespace

std::vector<SectionBranch> inside_trims(const std::vector<SectionBranch>& branches,
                                        const SurfaceModel& model, const CutPlane& plane,
                                        double meet) {
  const TrimClipper clipper(model, plane);
  std::vector<SectionBranch> inside;
  for (const SectionBranch& branch : branches) clipper.clip(branch, inside);
  return EndJoiner(std::move(inside), meet).made();
}

}  // namespace obvid
