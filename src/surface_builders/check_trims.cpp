// SPDX-License-Identifier: Apache-2.0
#include "check_trims.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "check_joints.h"
#include "network_crossing.h"
#include "obvid/core/internal/parallel.h"
#include "obvid/curve/internal/basis.h"
#include "obvid/geom/internal/box.h"
#include "obvid/geom/internal/directions.h"
#include "obvid/numeric/internal/golden.h"
#include "obvid/surface/internal/trim.h"
#include "obvid/surface_builders/internal/deviation.h"

namespace obvid {
namespace {

/// Of each curve of a border; and in each of its spans.
constexpr std::size_t kLeastPlaces = 64, kPlacesInSpan = 4;
/// A border that leaves another face by more than this part of its way (30 degrees), or whose
/// nearest place goes on by less than that, does not run along it, however near it still is: at a
/// corner every border is near to the faces beside it.
constexpr double kLeaves = 0.5;
/// Angles that change by no more, rad, are those of planes along a straight border, but for
/// rounding.
constexpr double kFlatAngle = 1e-9;

/// A curve in the plane of a patch's parameters that bounds what of it is there.
struct BorderCurve {
  std::size_t patch = 0;
  std::optional<PatchSide> side{};  ///< of an untrimmed patch
  NurbsCurve curve;
  std::vector<double> t;   ///< ascending
  std::vector<Vec3> at{};  ///< the points there
  Box3 box{};

  [[nodiscard]] std::size_t steps() const { return t.size() - 1; }
  [[nodiscard]] double length(std::size_t step) const { return norm(at[step + 1] - at[step]); }
};

class Borders {
 public:
  Borders(const SurfaceModel& model, double smallest) : model_(model) {
    for (std::size_t i = 0; i < model.patches.size(); ++i) {
      const SurfacePatch& patch = model.patches[i];
      if (patch.trims.empty()) {
        for (const PatchSide side : kPatchSides) add(i, side, side_line(patch.surface, side));
      }
      for (const TrimLoop& loop : patch.trims) {
        for (const NurbsCurve& curve : loop.curves) add(i, std::nullopt, curve);
      }
    }
    // those that are a point, as at poles
    std::erase_if(all_, [&](const BorderCurve& one) { return one.box.diagonal() <= smallest; });
  }

  [[nodiscard]] const std::vector<BorderCurve>& all() const { return all_; }
  [[nodiscard]] Vec2 parameters(const BorderCurve& border, double t) const {
    const NurbsSurface& s = model_.patches[border.patch].surface;
    const Range u = domain_u(s), v = domain_v(s);
    const Vec2 p = evaluate(border.curve, t).point;
    return {std::clamp(p.x, u.from, u.to), std::clamp(p.y, v.from, v.to)};
  }
  [[nodiscard]] SurfaceJet jet(const BorderCurve& border, double t) const {
    const Vec2 p = parameters(border, t);
    return evaluate(model_.patches[border.patch].surface, p.x, p.y);
  }

 private:
  static NurbsCurve side_line(const NurbsSurface& s, PatchSide side) {
    const Range u = domain_u(s), v = domain_v(s);
    if (runs_along_u(side)) {
      const double at = is_far_end(side) ? v.to : v.from;
      return parameter_line({u.from, at}, {u.to, at});
    }
    const double at = is_far_end(side) ? u.to : u.from;
    return parameter_line({at, v.from}, {at, v.to});
  }
  void add(std::size_t patch, std::optional<PatchSide> side, NurbsCurve curve) {
    std::vector<double> ends = distinct(curve.knots);
    if (side) {
      const SpaceCurve border = border_of(model_.patches[patch].surface, *side);
      const Range range = domain(border);
      ends.clear();
      for (const double t : distinct(border.knots)) {
        ends.push_back(std::clamp((t - range.from) / range.length(), 0.0, 1.0));
      }
    }
    const std::size_t spans = ends.size() - 1;
    const std::size_t parts = std::max(kPlacesInSpan, (kLeastPlaces + spans - 1) / spans);
    BorderCurve out{patch, side, std::move(curve), {ends.front()}};
    for (std::size_t k = 0; k < spans; ++k) {
      for (std::size_t i = 1; i <= parts; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(parts);
        out.t.push_back(i == parts ? ends[k + 1] : Range{ends[k], ends[k + 1]}.at(share));
      }
    }
    for (const double t : out.t) {
      out.at.push_back(jet(out, t).point);
      out.box.add(out.at.back());
    }
    all_.push_back(std::move(out));
  }

  const SurfaceModel& model_;
  std::vector<BorderCurve> all_;
};

/// Whether a trim leads along u rather than v, as parts of the domain.
bool leads_along_u(const NurbsCurve& trim, const NurbsSurface& s) {
  const Vec2 way = trim.points.back() - trim.points.front();
  return std::abs(way.x) * domain_v(s).length() >= std::abs(way.y) * domain_u(s).length();
}

/// What is measured at a place of a border; the angle is not a number where there is no plane.
struct AtTrim {
  double gap = std::numeric_limits<double>::infinity();
  double angle = std::nan("");
  double area = 0.0;  ///< of du x dv, on the side where it is less
  Vec3 point{}, foot{};
};

/// Another face, or what a closed one meets at its own seam.
class Beside {
 public:
  Beside(const SurfaceModel& model, std::size_t patch, const NearestOnModel* nearest)
      : surface_(model.patches[patch].surface), patch_(patch), nearest_(nearest) {}

  [[nodiscard]] std::size_t patch() const { return patch_; }
  [[nodiscard]] AtTrim measured(const Borders& borders, const BorderCurve& border, double t) const {
    const SurfaceJet here = borders.jet(border, t);
    const SurfaceJet there = nearest_ != nullptr ? foot(here.point) : across(borders, border, t);
    AtTrim out;
    out.point = here.point;
    out.foot = there.point;
    out.gap = norm(there.point - here.point);
    out.area = std::min(norm(cross(here.du, here.dv)), norm(cross(there.du, there.dv)));
    const Vec3 a = curvature(here).normal, b = curvature(there).normal;
    if (a != Vec3{} && b != Vec3{}) out.angle = angle_between_lines(a, b);
    return out;
  }

 private:
  [[nodiscard]] SurfaceJet foot(Vec3 point) const {
    const NearestPlace place = nearest_->at(point);
    return evaluate(surface_, place.u, place.v);
  }
  /// Of a trim along a side: the same place of the opposite one.
  [[nodiscard]] SurfaceJet across(const Borders& borders, const BorderCurve& border,
                                  double t) const {
    const Range u = domain_u(surface_), v = domain_v(surface_);
    Vec2 p = borders.parameters(border, t);
    if (leads_along_u(border.curve, surface_)) {
      p.y = p.y < v.at(0.5) ? v.to : v.from;
    } else {
      p.x = p.x < u.at(0.5) ? u.to : u.from;
    }
    return evaluate(surface_, p.x, p.y);
  }

  const NurbsSurface& surface_;
  std::size_t patch_;
  const NearestOnModel* nearest_;  ///< null: its own seam
};

/// A border, and another face that may be near it.
struct BorderPair {
  const BorderCurve* border = nullptr;
  Beside beside;
};

/// Where two are near each other, and how they are there.
struct AlongPair {
  std::vector<bool> along;  ///< of each step of the border
  AtTrim gap, angle;        ///< where each of these is largest
  double length = 0.0;
  std::size_t places = 0;
};

/// Where a figure is largest: climbed to from the places at which it is, within the steps that run
/// along, unless it changes by no more than `flat` from place to place.
AtTrim largest_of(double AtTrim::*figure, const std::vector<AtTrim>& there,
                  const std::vector<bool>& along, const std::vector<double>& t, double flat,
                  const std::function<AtTrim(double)>& measure) {
  constexpr std::size_t kClimbs = 2;
  constexpr double kFoundTo = 1e-4;  // of what is looked through; of the rise its square
  std::vector<std::size_t> best;
  for (std::size_t i = 0; i < there.size(); ++i) {
    const bool is_along = (i > 0 && along[i - 1]) || (i < along.size() && along[i]);
    if (is_along && there[i].*figure >= 0.0) best.push_back(i);
  }
  std::stable_sort(best.begin(), best.end(), [&](std::size_t a, std::size_t b) {
    return there[a].*figure > there[b].*figure;
  });
  AtTrim out;
  out.gap = 0.0;
  if (best.empty()) return out;
  out = there[best.front()];
  if (!(out.*figure - there[best.back()].*figure > flat)) return out;  // the same all along
  best.resize(std::min(best.size(), kClimbs));
  for (const std::size_t i : best) {
    const Range around{i > 0 && along[i - 1] ? t[i - 1] : t[i],
                       i < along.size() && along[i] ? t[i + 1] : t[i]};
    const double top = highest_place(
        around.from, around.to,
        [&](double at) {
          const double value = measure(at).*figure;
          return value >= 0.0 ? value : -1.0;
        },
        kFoundTo * around.length());
    const AtTrim found = measure(top);
    if (found.*figure > out.*figure) out = found;
  }
  return out;
}

AlongPair along_pair(const Borders& borders, const BorderPair& pair, const Box3& box,
                     double nearness, double size) {
  const BorderCurve& border = *pair.border;
  std::vector<AtTrim> there(border.t.size());
  AtTrim last;
  last.gap = 0.0;
  for (std::size_t i = 0; i < there.size(); ++i) {
    if (!(distance_between({border.at[i], border.at[i]}, box) <= nearness)) continue;
    // distances do not change by more than the way: all before that is farther off
    if (norm(border.at[i] - last.point) < last.gap - nearness) continue;
    last = there[i] = pair.beside.measured(borders, border, border.t[i]);
  }
  AlongPair out;
  out.along.resize(border.steps());
  double least_area = 0.0;
  for (std::size_t i = 0; i < border.steps(); ++i) {
    const AtTrim &a = there[i], &b = there[i + 1];
    out.along[i] = a.gap <= nearness && b.gap <= nearness &&
                   std::abs(a.gap - b.gap) <= kLeaves * border.length(i) &&
                   norm(a.foot - b.foot) >= kLeaves * border.length(i);
    if (!out.along[i]) continue;
    out.length += border.length(i);
    ++out.places;
    least_area = std::max({least_area, kBesidePoint * a.area, kBesidePoint * b.area});
  }
  if (out.places == 0) return out;
  ++out.places;
  const auto no_angle_beside_points = [&](AtTrim one) {
    if (one.area < least_area) one.angle = std::nan("");
    return one;
  };
  for (AtTrim& one : there) one = no_angle_beside_points(one);
  const auto measure = [&](double t) {
    return no_angle_beside_points(pair.beside.measured(borders, border, t));
  };
  out.gap = largest_of(&AtTrim::gap, there, out.along, border.t, kSameBorder * size, measure);
  out.angle = largest_of(&AtTrim::angle, there, out.along, border.t, kFlatAngle, measure);
  return out;
}

/// Steps of a border that run along anything, and what of trimmed patches runs along nothing.
void add_border(const BorderCurve& border, const std::vector<bool>& along, TrimJoints& out) {
  // a step from one face on to the next runs along neither, and is met
  const auto is_met = [&](std::size_t i) {
    const bool before = i > 0 && along[i - 1], behind = i + 1 < along.size() && along[i + 1];
    return along[i] || (before && behind);
  };
  if (border.side) {
    bool all = true;
    for (std::size_t i = 0; i < border.steps(); ++i) all = all && is_met(i);
    out.along[border.patch][*border.side] = all;
    return;
  }
  double stretch = 0.0;
  std::size_t from = 0;
  for (std::size_t i = 0; i < border.steps(); ++i) {
    const double length = border.length(i);
    out.borders.length += length;
    if (is_met(i)) {
      stretch = 0.0;
      from = i + 1;
      continue;
    }
    out.borders.free += length;
    stretch += length;
    if (stretch <= out.borders.longest_free) continue;
    out.borders.longest_free = stretch;
    out.borders.free_at = border.at[(from + i + 1) / 2];
  }
}

/// Two faces, and how long they run along each other by the borders of either.
struct PairOfFaces {
  TrimJointReport joint;
  std::array<double, 2> length{};
};
using PairsOfFaces = std::map<std::array<std::size_t, 2>, PairOfFaces>;

void add_pair(const BorderPair& pair, const AlongPair& found, PairsOfFaces& joints) {
  if (found.places == 0) return;
  const std::size_t a = pair.border->patch, b = pair.beside.patch();
  const std::array key{std::min(a, b), std::max(a, b)};
  const auto [at, is_new] = joints.try_emplace(key);
  TrimJointReport& joint = at->second.joint;
  joint.patch = key;
  if (is_new || found.gap.gap > joint.gap) {
    joint.gap = found.gap.gap;
    joint.gap_at = found.gap.point;
  }
  if (found.angle.angle > joint.angle || (is_new && found.angle.angle >= 0.0)) {
    joint.angle = found.angle.angle;
    joint.angle_at = found.angle.point;
  }
  at->second.length[a == key[0] ? 0 : 1] += a == b ? found.length / 2.0 : found.length;
  joint.places += found.places;
  joint.order = joint.angle > kSmoothAngle ? 0 : 1;
}

/// Whether a trim lies on a side of a patch that is closed there.
bool is_seam(const SurfaceModel& model, const Topology& same, const BorderCurve& border) {
  if (border.side) return false;
  const NurbsSurface& s = model.patches[border.patch].surface;
  if (!runs_along_side(border.curve, s)) return false;
  const auto& sides = same.edge_of[border.patch];
  return leads_along_u(border.curve, s) ? sides[kVStart] == sides[kVEnd]
                                        : sides[kUStart] == sides[kUEnd];
}

}  // namespace

Result<TrimJoints> trim_joints_of(const SurfaceModel& model, const Topology& same, double nearness,
                                  double size, const RunContext& run) {
  TrimJoints out;
  out.along.resize(model.patches.size());
  if (!is_trimmed(model)) return out;
  const Borders borders(model, kSameBorder * size);
  const std::size_t count = model.patches.size();
  std::vector<SurfaceModel> alone(count);
  std::vector<std::unique_ptr<const NearestOnModel>> nearest(count);
  std::vector<Box3> boxes(count);
  OBVID_TRY(in_parallel(count, run, [&](std::size_t i) {
    alone[i].patches = {model.patches[i]};
    nearest[i] = std::make_unique<const NearestOnModel>(alone[i]);
    boxes[i].add_all(model.patches[i].surface.points);
  }));
  std::vector<BorderPair> pairs;
  for (const BorderCurve& border : borders.all()) {
    for (std::size_t i = 0; i < count; ++i) {
      const bool trimmed =
          !border.side || !model.patches[i].trims.empty();  // else `joints_of` has them
      if (!trimmed || !(distance_between(border.box, boxes[i]) <= nearness)) continue;
      if (i != border.patch) {
        pairs.push_back({&border, Beside(model, i, nearest[i].get())});
      } else if (is_seam(model, same, border)) {
        pairs.push_back({&border, Beside(model, i, nullptr)});
      }
    }
  }
  std::vector<AlongPair> found(pairs.size());
  OBVID_TRY(in_parallel(pairs.size(), run, [&](std::size_t k) {
    found[k] = along_pair(borders, pairs[k], boxes[pairs[k].beside.patch()], nearness, size);
  }));
  PairsOfFaces joints;
  std::size_t k = 0;
  for (const BorderCurve& border : borders.all()) {
    std::vector<bool> along(border.steps());
    for (; k < pairs.size() && pairs[k].border == &border; ++k) {
      add_pair(pairs[k], found[k], joints);
      for (std::size_t i = 0; i < along.size(); ++i) along[i] = along[i] || found[k].along[i];
    }
    add_border(border, along, out);
  }
  for (auto& [key, pair] : joints) {
    pair.joint.length = std::max(pair.length[0], pair.length[1]);
    out.joints.push_back(pair.joint);
  }
  return out;
}

}  // namespace obvid
