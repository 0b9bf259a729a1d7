// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_cut/internal/inside_trims.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "obvid/surface/internal/trim.h"
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
    std::vector<Dense> places = dense(branch);
    const auto outside =
        std::find_if(places.begin(), places.end(), [](const Dense& one) { return !one.inside; });
    if (outside == places.end()) {
      out.push_back(branch);
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
      if (i > 0) add_end(places[i].place, places[i - 1].place, part.points);
      std::size_t end = i;
      for (; end < places.size() && places[end].inside; ++end) {
        if (places[end].given) part.points.push_back(places[end].place);
      }
      if (end < places.size()) add_end(places[end - 1].place, places[end].place, part.points);
      if (part.points.size() > 1) out.push_back(std::move(part));
      i = end;
    }
  }

  [[nodiscard]] bool is_there(const SectionPoint& p) const {
    return !regions_[p.patch] || regions_[p.patch]->contains(p.u, p.v);
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
      if (next.patch != points[i].patch || !regions_[next.patch]) continue;
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
    if (in.patch != beyond.patch) return;  // what is inside lies on the border already
    constexpr int kHalvings = 60;
    const NurbsSurface& s = model_.patches[in.patch].surface;
    const auto at = [&](double part) {
      const Vec2 p =
          onto_cut(s, field_, Vec2{in.u, in.v} + part * Vec2{beyond.u - in.u, beyond.v - in.v});
      return SectionPoint{evaluate(s, p.x, p.y).point, in.patch, p.x, p.y};
    };
    double low = 0.0, high = 1.0;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (low + high);
      (is_there(at(middle)) ? low : high) = middle;
    }
    if (low > 0.0) into.push_back(at(low));
  }

  const SurfaceModel& model_;
  CuttingField field_;
  std::vector<std::unique_ptr<TrimRegion>> regions_;
};

}  // namespace

PlaneSection inside_trims(PlaneSection section, const SurfaceModel& model, const CutPlane& plane) {
  if (!is_trimmed(model)) return section;
  const TrimClipper clipper(model, plane);
  std::vector<SectionBranch> inside;
  for (const SectionBranch& branch : section.branches) clipper.clip(branch, inside);
  section.branches = std::move(inside);
  return section;
}

}  // namespace obvid
