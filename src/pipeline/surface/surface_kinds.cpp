// SPDX-License-Identifier: Apache-2.0
// Surfaces of curves and of surfaces; those of points are in surface_points.cpp.
#include "surface/surface_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "obvid/core/internal/figures.h"
#include "obvid/core/units.h"
#include "obvid/geom/internal/box.h"
#include "obvid/surface/internal/collocation.h"
#include "obvid/surface/internal/enclosed.h"
#include "obvid/surface_builders/internal/network.h"
#include "obvid/surface_builders/internal/offset.h"

namespace obvid::pipeline_detail {
namespace {

Result<std::vector<ReadCurve>> read_curves(const std::vector<SurfaceInput>& inputs,
                                           const CurveReading& how, const RunContext& run) {
  std::vector<ReadCurve> curves;
  for (const SurfaceInput& input : inputs) {
    auto curve = read_space_curve(input, how, run);
    OBVID_TRY(curve);
    curves.push_back(std::move(*curve));
  }
  return curves;
}

Result<void> need(const SurfaceJob& job, std::size_t least, std::size_t most, const char* what) {
  if (job.inputs.size() >= least && job.inputs.size() <= most) return {};
  return error(ErrorCode::kUsage,
               fmt::format("{} were given where {} are needed", job.inputs.size(), what))
      .value(static_cast<double>(job.inputs.size()));
}

double size_of_all(const std::vector<ReadCurve>& curves) {
  return bounding_diagonal(curves, [](const ReadCurve& c) { return std::cref(c.curve.points); });
}

double deviation_of(const std::vector<ReadCurve>& curves) {
  double most = 0.0;
  for (const ReadCurve& curve : curves) most = std::max(most, curve.deviation);
  return most;
}

/// What the curves bring to the surface that is made of them: their own distance from what they
/// stand for moves it by as much, times `spread`. Error E310 where their units differ.
Result<void> take_over(std::vector<ReadCurve>& curves, MadeSurface& made, double spread = 1.0) {
  made.deviation += spread * deviation_of(curves);
  std::vector<Units> all{made.model.units};
  for (const ReadCurve& curve : curves) all.push_back(curve.units);
  auto units = common_units(all, curves.empty() ? "" : curves.front().name);
  OBVID_TRY(units);
  made.model.units = std::move(*units);
  for (ReadCurve& curve : curves) {
    made.lines.push_back(drawn(curve.curve));
    made.warnings.insert(made.warnings.end(), curve.warnings.begin(), curve.warnings.end());
  }
  return {};
}

std::vector<SpaceCurve> geometry(const std::vector<ReadCurve>& curves) {
  std::vector<SpaceCurve> out;
  for (const ReadCurve& c : curves) out.push_back(c.curve);
  return out;
}

SpaceCurve moved_curve(SpaceCurve curve, Vec3 by) {
  for (Vec3& p : curve.points) p = p + by;
  return curve;
}

SpaceCurve shrunk_to(SpaceCurve curve, Vec3 point) {
  std::fill(curve.points.begin(), curve.points.end(), point);
  return curve;
}

/// Both inputs lists of points: rulings join places that belong together, as in a skin.
bool are_points(const SurfaceJob& job) {
  return std::none_of(job.inputs.begin(), job.inputs.end(), [](const SurfaceInput& input) {
    return input.text ? is_drawing_text(*input.text, input.name)
                      : input.is_file() && is_drawing(input.name);
  });
}

std::string degrees(double rad) { return fmt::format("{:.6g} degrees", rad / kOneDegree); }

std::string folded_at(const SurfacePatch& patch, const FoldedRegion& fold) {
  return fmt::format("{}, u {:.4g} to {:.4g}, v {:.4g} to {:.4g}", patch.name, fold.u.from,
                     fold.u.to, fold.v.from, fold.v.to);
}

/// Whether a profile lies on both sides of the axis: the surface then runs through itself.
bool crosses_axis(const SpaceCurve& profile, Vec3 point, Vec3 direction) {
  const Vec3 axis = unit(direction);
  const ScenePolyline line = drawn(profile);
  Vec3 farthest;
  std::vector<Vec3> arms;
  for (const Vec3& p : line.points) {
    const Vec3 arm = (p - point) - dot(p - point, axis) * axis;
    arms.push_back(arm);
    if (norm(arm) > norm(farthest)) farthest = arm;
  }
  constexpr double kRounding = 1e-9;  // of the largest radius
  return std::any_of(arms.begin(), arms.end(), [&](const Vec3& arm) {
    return dot(arm, farthest) < -kRounding * dot(farthest, farthest);
  });
}

/// Whether normals point into what a profile encloses in a whole turn, level ends closed, whatever
/// part of the turn is made. What is no surface is told where it is made.
bool is_inward(RevolutionSurface surface) {
  surface.angle = std::copysign(kFullTurn, surface.angle);
  const auto whole = to_nurbs(surface, 0.0);
  if (!whole) return false;
  const auto volume = enclosed_volume({{"", whole->surface}});
  return volume && volume->sign() < 0;
}

Error folds(const SurfacePatch& patch, const OffsetCheck& found, double distance) {
  const double largest = distance < 0.0 ? found.largest_inwards : found.largest_outwards;
  const std::size_t places = found.folds.size();
  return error(ErrorCode::kSurfaceFolds,
               fmt::format("the offset by {} folds back on itself in {} {}, first at {}", distance,
                           places, places == 1 ? "place" : "places",
                           folded_at(patch, found.folds.front())))
      .hint(fmt::format("up to {} on this side it does not; near that it may need a larger "
                        "--tolerance",
                        significant_below(largest, 6)))
      .value(largest);
}

}  // namespace

ScenePolyline drawn(const SpaceCurve& curve, const char* role) {
  constexpr int kFewestChordsOfSpan = 2, kMostChordsOfSpan = 256;  // of a span
  /// Of the size: a tenth of a px, which pictures round to, on a sheet of 1000 px.
  constexpr double kDrawnWithin = 1e-4;
  const double within = kDrawnWithin * bounding_diagonal(curve.points);
  std::vector<double> knots = curve.knots;
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  ScenePolyline line{{}, role};
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const auto place = [&](double part) {
      return evaluate(curve, knots[i] + (knots[i + 1] - knots[i]) * part).point;
    };
    const auto bulge = [&](int chords) {
      double most = 0.0;
      for (int k = 0; k < chords; ++k) {
        const Vec3 chord = 0.5 * (place(1.0 * k / chords) + place((k + 1.0) / chords));
        most = std::max(most, norm(place((k + 0.5) / chords) - chord));
      }
      return most;
    };
    int chords = kFewestChordsOfSpan;
    while (chords < kMostChordsOfSpan && bulge(chords) > within) chords *= 2;
    for (int k = 0; k < chords; ++k) line.points.push_back(place(1.0 * k / chords));
  }
  line.points.push_back(evaluate(curve, knots.back()).point);
  return line;
}

Result<MadeSurface> as_read(const SurfaceJob& job, const RunContext& run) {
  MadeSurface made;
  auto model = read_surface(job.inputs.front(), made.warnings, run);
  OBVID_TRY(model);
  made.model = std::move(*model);
  return made;
}

Result<MadeSurface> made_of(const Surface& surface, const std::string& name, double size,
                            const SurfaceJob& job) {
  auto form = to_nurbs(surface, job.tolerance.value_or(kSurfaceTolerance * size));
  OBVID_TRY(form);
  MadeSurface made;
  made.kind = kind_of(surface);
  made.deviation = form->deviation;
  made.model.name = name;
  made.model.patches.push_back({name, std::move(form->surface)});
  turn_outward(made.model.patches);
  return made;
}

Result<MadeSurface> make_kind(const RuledKind& kind, const SurfaceJob& job, const RunContext& run) {
  const bool from_one = kind.direction || kind.apex;
  OBVID_TRY(from_one ? need(job, 1, 1, "one curve with --direction or --apex")
                     : need(job, 2, 2, "two curves"));
  if (!from_one && are_points(job)) {
    auto made = make_kind(kind.strips, job, run);
    if (made) made->kind = "ruled surface between two fair contours";
    return made;
  }
  auto curves = read_curves(job.inputs, job.curves, run);
  OBVID_TRY(curves);
  const SpaceCurve& first = curves->front().curve;
  RuledSurface ruled{first, kind.direction ? moved_curve(first, *kind.direction)
                            : kind.apex    ? shrunk_to(first, *kind.apex)
                                           : curves->back().curve};
  auto made = made_of(ruled, "ruled surface", size_of_all(*curves), job);
  if (!made) return made;
  if (kind.direction) made->kind = "cylinder over a curve";
  if (kind.apex) made->kind = "cone over a curve";
  OBVID_TRY(take_over(*curves, *made));
  return made;
}

Result<MadeSurface> make_kind(const RevolveKind& kind, const SurfaceJob& job,
                              const RunContext& run) {
  OBVID_TRY(need(job, 1, 1, "one profile"));
  auto curves = read_curves(job.inputs, job.curves, run);
  OBVID_TRY(curves);
  RevolutionSurface surface{curves->front().curve, kind.axis_point, kind.axis_direction,
                            kind.angle};
  if (is_inward(surface)) surface.profile = reversed(surface.profile);
  const std::string stem = std::filesystem::path(job.inputs.front().name).stem().string();
  auto made = made_of(surface, stem, size_of_all(*curves), job);
  if (!made) return made;
  made->facts.emplace_back("angle", degrees(kind.angle));
  if (crosses_axis(curves->front().curve, kind.axis_point, kind.axis_direction)) {
    made->warnings.push_back(
        fmt::format("{}: the profile lies on both sides of the axis, the surface runs "
                    "through itself; is it half an outline, and --axis right?",
                    job.inputs.front().name));
  }
  OBVID_TRY(take_over(*curves, *made));
  return made;
}

Result<MadeSurface> make_kind(const CoonsKind&, const SurfaceJob& job, const RunContext& run) {
  OBVID_TRY(need(job, 4, 4, "four border curves"));
  auto curves = read_curves(job.inputs, job.curves, run);
  OBVID_TRY(curves);
  const double size = size_of_all(*curves);
  const auto patch =
      coons_from(geometry(*curves), job.tolerance.value_or(kSurfaceTolerance * size));
  OBVID_TRY(patch);
  auto made = made_of(*patch, "Coons patch", size, job);
  if (!made) return made;
  constexpr double kBordersAndCorners = 3.0;  // two ruled surfaces less that of the corners
  OBVID_TRY(take_over(*curves, *made, kBordersAndCorners));
  return made;
}

Result<MadeSurface> make_kind(const GordonKind& kind, const SurfaceJob& job,
                              const RunContext& run) {
  auto first = read_curves(job.inputs, job.curves, run);
  OBVID_TRY(first);
  auto second = read_curves(kind.across, job.curves, run);
  OBVID_TRY(second);
  const double size = std::max(size_of_all(*first), size_of_all(*second));
  const auto net = gordon_from(geometry(*first), geometry(*second),
                               job.tolerance.value_or(kSurfaceTolerance * size));
  OBVID_TRY(net);
  auto made = made_of(*net, "Gordon surface", size, job);
  if (!made) return made;
  made->facts.emplace_back("curves",
                           fmt::format("{} and {} across", first->size(), second->size()));
  // through the first ones plus through the second ones less through their crossings, which are as
  // far off as either
  const double u = largest_spread(net->u_at), v = largest_spread(net->v_at);
  const bool first_off = deviation_of(*first) > deviation_of(*second);
  OBVID_TRY(take_over(*second, *made, u + (first_off ? 0.0 : u * v)));
  OBVID_TRY(take_over(*first, *made, v + (first_off ? u * v : 0.0)));
  return made;
}

Result<MadeSurface> make_kind(const OffsetKind& kind, const SurfaceJob& job,
                              const RunContext& run) {
  OBVID_TRY(need(job, 1, 1, "one surface"));
  MadeSurface made;
  auto model = read_surface(job.inputs.front(), made.warnings, run);
  OBVID_TRY(model);
  made.model = std::move(*model);
  // points of the offset have the parameters of theirs: trims stay as they are
  for (SurfacePatch& patch : made.model.patches) {
    OBVID_TRY(may_go_on(run));
    const OffsetCheck found = check_offset(patch.surface, kind.distance);
    if (!found.folds.empty()) return fail(folds(patch, found, kind.distance));
    const double size = size_of(patch.surface);
    const OffsetSurface offset{patch.surface, kind.distance};
    auto form = to_nurbs(offset, job.tolerance.value_or(kSurfaceTolerance * size));
    if (!form) {
      Error error = form.error();
      error.where = patch.name;
      return fail(error);
    }
    patch.surface = std::move(form->surface);
    made.deviation = std::max(made.deviation, form->deviation);
  }
  made.kind = fmt::format("offset by {}", kind.distance);
  return made;
}

Result<MadeSurface> make_kind(const TrimKind& kind, const SurfaceJob& job, const RunContext& run) {
  OBVID_TRY(need(job, 1, 1, "one surface"));
  return made_trimmed({kind.planes, kind.contour, kind.along, kind.keep_positive}, job, run);
}

Result<MadeSurface> make_kind(const FilletKind& kind, const SurfaceJob& job,
                              const RunContext& run) {
  OBVID_TRY(need(job, 1, 1, "one model"));
  return made_fillet(
      {kind.faces, kind.radius, kind.radius_end.value_or(kind.radius), kind.sides, kind.whole}, job,
      run);
}

Result<MadeSurface> make_kind(const MatchKind& kind, const SurfaceJob& job, const RunContext& run) {
  OBVID_TRY(need(job, 1, 1, "one model"));
  return made_matched({kind.border, kind.to, kind.order, kind.within}, job, run);
}

Result<MadeSurface> make_kind(const ConvertKind&, const SurfaceJob& job, const RunContext& run) {
  OBVID_TRY(need(job, 1, 1, "one surface"));
  auto read = as_read(job, run);
  OBVID_TRY(read);
  MadeSurface made = std::move(*read);
  made.kind = "as stored";
  return made;
}

}  // namespace obvid::pipeline_detail

namespace obvid {

std::vector<SurfaceInput>* second_inputs(SurfaceJob& job) {
  auto* net = std::get_if<GordonKind>(&job.kind);
  return net != nullptr ? &net->across : nullptr;
}

const std::vector<SurfaceInput>* second_inputs(const SurfaceJob& job) {
  const auto* net = std::get_if<GordonKind>(&job.kind);
  return net != nullptr ? &net->across : nullptr;
}

}  // namespace obvid
