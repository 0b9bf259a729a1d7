// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_cut/internal/trim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "contour_field.h"
#include "field_lines.h"
#include "lines_along.h"
#include "obvid/core/internal/parallel.h"
#include "obvid/surface/internal/topology.h"
#include "trim_patch.h"

namespace obvid {
namespace {

constexpr double kTrimSmall = 1e-9;   // of the size: places nearer to each other are one
constexpr double kLineChords = 1e-4;  // of the size: of the places along a cut

using LinesOf = std::function<Result<std::vector<CutLine>>(const SurfacePatch&, const RunContext&)>;
/// Which side a patch is on as a whole, where that is plain: 1, -1, or 0.
using SideOf = std::function<int(const NurbsSurface&)>;

/// Patches without seams, named after the whole.
std::vector<SurfacePatch> unseamed_halves(const SurfacePatch& patch, double size) {
  std::vector<SurfacePatch> out{patch};
  const Topology topology = topology_of({&patch.surface}, kSameBorder * size);
  const auto closed = [&](PatchSide side) {
    const std::size_t edge = topology.edge_of[0][side];
    return edge == topology.edge_of[0][opposite(side)] && !topology.edges[edge].point;
  };
  const auto divide = [&](bool along_u) {
    std::vector<SurfacePatch> parts;
    for (const SurfacePatch& one : out) {
      const Range all = along_u ? domain_u(one.surface) : domain_v(one.surface);
      auto halves = along_u ? split_u(one.surface, all.at(0.5)) : split_v(one.surface, all.at(0.5));
      const char* name = along_u ? "u" : "v";
      for (std::size_t k = 0; k < 2; ++k) {
        parts.push_back({one.name + ", half " + std::to_string(k + 1) + " along " + name,
                         std::move(halves[k])});
      }
    }
    out = std::move(parts);
  };
  if (closed(kUStart)) divide(true);
  if (closed(kVStart)) divide(false);
  return out;
}

/// What becomes of one patch of the model.
struct PatchDone {
  std::optional<Error> error;
  std::vector<SurfacePatch> left;
  std::size_t whole = 0, cut = 0, dropped = 0;  // of its halves, where it was halved
  double deviation = 0.0;
};

class Trimmer {
 public:
  Trimmer(const SurfaceModel& model, const CuttingField& field, const TrimOptions& options,
          LinesOf lines, SideOf side)
      : model_(model),
        field_(field),
        options_(options),
        lines_(std::move(lines)),
        side_(std::move(side)),
        size_(size_of(model)) {}

  Result<TrimmedModel> made(const RunContext& run) {
    const std::size_t count = model_.patches.size();
    std::vector<PatchDone> done(count);
    OBVID_TRY(in_parallel(count, run, [&](std::size_t i, const RunContext& asked) {
      if (auto fine = trim(model_.patches[i], asked, done[i]); !fine) done[i].error = fine.error();
    }));
    TrimmedModel out;
    out.model.name = model_.name;
    out.model.units = model_.units;
    for (PatchDone& one : done) {
      if (one.error) return fail(std::move(*one.error));
      out.cut += one.cut;
      out.deviation = std::max(out.deviation, one.deviation);
      out.whole += one.whole;
      out.dropped += one.dropped;
      for (SurfacePatch& patch : one.left) out.model.patches.push_back(std::move(patch));
    }
    if (out.model.patches.empty()) {
      return error(ErrorCode::kNothingThere, "nothing of the surface lies on that side")
          .where(model_.name)
          .hint("look where the surface lies, and what is to be kept");
    }
    return out;
  }

 private:
  Result<void> trim(const SurfacePatch& patch, const RunContext& run, PatchDone& out) const {
    OBVID_TRY(check(patch));
    if (const int side = side_(patch.surface); side != 0) {
      const bool kept = (side > 0) == options_.keep_positive;
      ++(kept ? out.whole : out.dropped);
      if (kept) out.left.push_back(patch);
      return {};
    }
    const std::vector<SurfacePatch> halves = unseamed_halves(patch, size_);
    if (halves.size() > 1 && !patch.trims.empty()) {
      return error(ErrorCode::kUnsupported,
                   "a trimmed patch that closes on itself is not trimmed again")
          .where(patch.name)
          .hint("divide it at its seam first, or trim it in another system");
    }
    for (const SurfacePatch& half : halves) {
      auto lines = lines_(half, run);
      OBVID_TRY(lines);
      auto made = trimmed_patch(half, field_, *lines, options_.keep_positive, options_.tolerance,
                                kTrimSmall * size_);
      OBVID_TRY(made);
      out.deviation = std::max(out.deviation, made->deviation);
      if (!made->there) {
        ++out.dropped;
        continue;
      }
      ++(made->cut ? out.cut : out.whole);
      SurfacePatch left = half;
      left.trims = std::move(made->trims);
      left.trims_within = std::max(patch.trims_within, made->deviation);
      out.left.push_back(std::move(left));
    }
    if (out.whole == halves.size()) {  // on one side: no need to halve it
      out.left = {patch};
      out.whole = 1;
    }
    if (out.dropped == halves.size()) out.dropped = 1;
    return {};
  }

  const SurfaceModel& model_;
  const CuttingField& field_;
  TrimOptions options_;
  LinesOf lines_;
  SideOf side_;
  double size_;
};

/// Branches of a section as lines of one patch, divided where they pass a side that is a point:
/// from there they go on at another parameter.
std::vector<CutLine> lines_of(const PlaneSection& section, const NurbsSurface& s, double small) {
  std::array<std::optional<Vec3>, 4> pole{};
  for (const PatchSide side : kPatchSides) pole[side] = pole_of(s, side, small);
  // sections are decided a little beside the plane: they need not end in the pole to the last bit
  const auto at_pole = [&](const SectionPoint& p) -> std::optional<PatchSide> {
    for (const PatchSide side : kPatchSides) {
      if (pole[side] && norm(p.point - *pole[side]) <= small) return side;
    }
    return std::nullopt;
  };
  const Range u = domain_u(s), v = domain_v(s);
  // the pole at the parameter of another place
  const auto pole_beside = [&](PatchSide side, const SectionPoint& p) {
    const bool far = is_far_end(side);
    return runs_along_u(side) ? Vec2{p.u, far ? v.to : v.from} : Vec2{far ? u.to : u.from, p.v};
  };
  std::vector<CutLine> out;
  // but for what begins and ends in a pole and hardly leaves it: sections end there within 1e-6 of
  // the size, and by more than one way
  const auto keep = [&](CutLine line) {
    constexpr double kAtPole = 4e3;  // times `small`: smaller loops count as touching, too
    const auto point = [&](Vec2 at) { return evaluate(s, at.x, at.y).point; };
    if (line.places.empty()) return;
    const Vec3 first = point(line.places.front());
    const bool returns = norm(point(line.places.back()) - first) <= small;
    const bool leaves = std::any_of(line.places.begin(), line.places.end(), [&](Vec2 at) {
      return norm(point(at) - first) > (returns && !line.closed ? kAtPole : 1.0) * small;
    });
    if (leaves) out.push_back(std::move(line));
  };
  for (const SectionBranch& branch : section.branches) {
    std::vector<SectionPoint> points = branch.points;
    bool closed = branch.closed;
    if (closed) {
      const auto first = std::find_if(points.begin(), points.end(), [&](const SectionPoint& p) {
        return at_pole(p).has_value();
      });
      if (first != points.end()) {
        std::rotate(points.begin(), first, points.end());
        points.push_back(points.front());
        closed = false;
      }
    }
    CutLine line;
    line.closed = closed;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto side = at_pole(points[i]);
      if (!side || closed) {
        line.places.push_back({points[i].u, points[i].v});
        continue;
      }
      if (i > 0) {
        line.places.push_back(pole_beside(*side, points[i - 1]));
        keep(std::exchange(line, {}));
      }
      if (i + 1 < points.size()) line.places.push_back(pole_beside(*side, points[i + 1]));
    }
    keep(std::move(line));
  }
  return out;
}

Result<void> check_tolerance(const TrimOptions& options, double size) {
  if (!(options.tolerance > 0.0 && std::isfinite(options.tolerance))) {
    return error(ErrorCode::kBadOption, "the tolerance of a trim has to be greater than 0");
  }
  if (!(size > 0.0)) return error(ErrorCode::kTooFewPoints, "the surface has no size");
  return {};
}

}  // namespace

Result<TrimmedModel> trimmed(const SurfaceModel& model, const CutPlane& plane,
                             const TrimOptions& options, const RunContext& run) {
  const double size = size_of(model);
  OBVID_TRY(check_tolerance(options, size));
  const CuttingField field{[&](Vec3 p) { return dot(plane.normal, p) - plane.offset; },
                           [&](Vec3) { return plane.normal; }};
  const LinesOf lines = [&](const SurfacePatch& patch,
                            const RunContext& asked) -> Result<std::vector<CutLine>> {
    SurfaceModel alone;
    alone.patches.push_back({patch.name, patch.surface});
    auto section = ModelCutter(alone).section(plane, {kLineChords * size_of(patch.surface)}, asked);
    OBVID_TRY(section);
    return lines_of(*section, patch.surface, kTrimSmall * size);
  };
  const SideOf side = [&](const NurbsSurface& s) {  // by the hull of the control points
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Vec3 p : s.points) {
      low = std::min(low, field.value(p));
      high = std::max(high, field.value(p));
    }
    const double room = kTrimSmall * size;
    return low >= -room && high > room ? 1 : high <= room && low < -room ? -1 : 0;
  };
  return Trimmer(model, field, options, lines, side).made(run);
}

Result<TrimmedModel> trimmed(const SurfaceModel& model, const ProjectedContour& contour,
                             const TrimOptions& options, const RunContext& run) {
  const double size = size_of(model);
  OBVID_TRY(check_tolerance(options, size));
  const auto outline = ContourField::of(contour, kTrimSmall * size);
  OBVID_TRY(outline);
  const CuttingField field{[&](Vec3 p) { return outline->value(p); },
                           [&](Vec3 p) { return outline->rise(p); }};
  const LinesOf lines = [&](const SurfacePatch& patch, const RunContext& asked) {
    return field_lines(patch.surface, field, outline->corners(), asked);
  };
  const SideOf side = [&](const NurbsSurface& s) { return outline->is_beside(s.points) ? -1 : 0; };
  return Trimmer(model, field, options, lines, side).made(run);
}

Result<TrimmedModel> trimmed(const SurfacePatch& patch, const std::vector<LineAlong>& lines,
                             const TrimOptions& options, const RunContext& run) {
  SurfaceModel alone;
  alone.patches.push_back(patch);
  const double size = size_of(alone);
  OBVID_TRY(check_tolerance(options, size));
  const FieldBesideLines beside(lines);
  const CuttingField field{[&](Vec3 p) { return beside.value(p); },
                           [&](Vec3 p) { return beside.rise(p); }};
  const LinesOf on_part = [&](const SurfacePatch& part, const RunContext&) {
    return lines_on(part.surface, patch.surface, field, lines);
  };
  const TrimOptions keep{options.tolerance, true};
  return Trimmer(alone, field, keep, on_part, [](const NurbsSurface&) { return 0; }).made(run);
}

}  // namespace obvid
