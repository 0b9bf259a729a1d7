// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/pipeline/surface_job.h"

namespace obvid::pipeline_detail {

/// What surfaces are made within when nobody says otherwise, of the size.
inline constexpr double kSurfaceTolerance = 1e-5;

/// What helps where points have no fair contour.
[[nodiscard]] inline std::string without_fair_contour(const FitJob& job) {
  return std::string("--noise EPS lets points move that far") +
         (job.noise_from_rounding
              ? ""
              : ", --noise rounding as far as their printed digits leave open") +
         "; --plain takes the C2 cubic where no fair contour exists";
}

/// One function for each kind of surface; errors as `make_surface`.
#define OBVID_SURFACE_KIND(kind, ...)                                                 \
  [[nodiscard]] Result<MadeSurface> make_kind(const kind& how, const SurfaceJob& job, \
                                              const RunContext& run);
#include "obvid/pipeline/surface_kinds.inc"
#undef OBVID_SURFACE_KIND

/// Points along a curve, to be drawn with the surface.
[[nodiscard]] ScenePolyline drawn(const SpaceCurve& curve, const char* role = "section");

/// Near points in any order; without `up` heights along the normal of their best plane.
[[nodiscard]] Result<MadeSurface> made_near_points(ScatterOptions options,
                                                   const std::optional<Vec3>& up,
                                                   const SurfaceJob& job, const RunContext& run);

/// The job's surface as it was read, trims kept, to be changed.
[[nodiscard]] Result<MadeSurface> as_read(const SurfaceJob& job, const RunContext& run);

/// What a surface is trimmed by.
struct TrimmedBy {
  const std::vector<CutPlane>& planes;
  const std::optional<SurfaceInput>& contour;
  std::size_t along;
  bool keep_positive;
};
/// The part of the job's surface on that side.
[[nodiscard]] Result<MadeSurface> made_trimmed(const TrimmedBy& by, const SurfaceJob& job,
                                               const RunContext& run);

/// A ball that rolls between two faces.
struct RolledBall {
  const std::array<std::string, 2>& faces;
  double radius, radius_end;
  std::array<BallSide, 2> sides;
  bool whole;
};
/// A model with a blend of two of its faces.
[[nodiscard]] Result<MadeSurface> made_fillet(const RolledBall& by, const SurfaceJob& job,
                                              const RunContext& run);
/// The face with a name, else with a number from 1. Error: E203 with the option.
[[nodiscard]] Result<std::size_t> face_named(const SurfaceModel& model, const std::string& name,
                                             const char* option);

/// Whose border becomes whose, up to which derivative.
struct MatchedBorders {
  const FaceBorder& border;
  const FaceBorder& to;
  int order;
  std::optional<double> within;
};
/// A model with a patch that was matched to another.
[[nodiscard]] Result<MadeSurface> made_matched(const MatchedBorders& by, const SurfaceJob& job,
                                               const RunContext& run);

/// A surface of one patch as NURBS within the job's tolerance, or 1e-5 of `size`.
[[nodiscard]] Result<MadeSurface> made_of(const Surface& surface, const std::string& name,
                                          double size, const SurfaceJob& job);

}  // namespace obvid::pipeline_detail
