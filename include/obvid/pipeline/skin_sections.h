// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/pipeline/fit.h"
#include "obvid/surface/point_grid.h"
#include "obvid/surface_builders/internal/skin.h"

namespace obvid {

/// Contours of surfaces are G2 unless more is asked for: the surface between them is C2.
[[nodiscard]] inline FitJob section_job() {
  FitJob job;
  job.continuity = Continuity::kG2;
  return job;
}

/// How sections become a skin.
struct SkinJob {
  FitJob sections = section_job();  ///< how the contour of each section is formed
  Units units;
  std::optional<double> tolerance;  ///< units: of the surface from the contours [1e-5 of the size]
  SkinMatching matching = SkinMatching::kAutomatic;
  bool straight_across = false;
  std::optional<double> light;        ///< units: `SkinOptions::light`
  std::optional<double> fair_across;  ///< units: `SkinOptions::fair_across`
  bool plain_when_refused = false;  ///< a section without a fair contour takes the C2 cubic through
                                    ///< its points, which a warning tells; else it is an error
};

/// Sections whose curvature goes against its run by more than 0.1 % of the largest there, and the
/// worst, as a sentence; nothing: there are none.
[[nodiscard]] std::optional<std::string> runs_lost(const Skin& skin);

/// What there is to say of a skin that was to be fair across: that no section moved, and why; that
/// sections may not move as far as the tolerance. Nothing: they moved, and might that far.
[[nodiscard]] std::optional<std::string> fair_remark(const Skin& skin, const std::string& units);

struct FittedSkin {
  Skin skin;
  std::size_t proved = 0;  ///< sections whose contour is proved
  std::size_t smooth = 0;  ///< those of them whose slope of curvature is continuous at every joint
  std::size_t plain = 0;   ///< sections with the C2 cubic
  std::size_t points = 0;  ///< sections that are a point
  double tolerance = 0.0;  ///< that was used, units
  std::vector<std::string> warnings;
};

/// The plane of a section: the one in which all points have one coordinate the same if there is
/// one, else the plane of least squares through them.
[[nodiscard]] Frame plane_of(const std::vector<Vec3>& points);

/// How far places in the plane are known that were printed in space: along its axes, and across it.
struct PlaneRounding {
  Vec2 within;
  double across = 0.0;
};
[[nodiscard]] PlaneRounding rounding_in(const Frame& plane, Vec3 rounding);

/// Forms a fair contour through each section in its plane and a skin through the contours.
/// Consecutive points that are the same are one point of the contour. Sections whose first and last
/// point are the same, or nearer than the tolerance (a warning tells), are closed (with
/// `Closing::kAutomatic`).
/// Where the rounding of the coordinates decides (E405: circles in full precision), points may move
/// by 1e-12 of the largest coordinate. Sections that run against the one before are turned round,
/// and a warning tells; others tell of closed sections that begin elsewhere and of sections out of
/// order. Errors: of `fit`, with the section's name in front (`index`: the point), and of `skin`.
[[nodiscard]] Result<FittedSkin> fit_skin(const std::vector<SpaceSeries>& sections,
                                          const SkinJob& job, const RunContext& run = {});

}  // namespace obvid
