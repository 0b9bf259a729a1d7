// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/certify/certificate.h"
#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/curve/contour.h"
#include "obvid/report/stored_contour.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// Whether the contour returns to its first point.
enum class Closing {
  kAutomatic,  ///< when the last point is the first one again (within its tolerance)
  kClosed,     ///< always; the last point is followed by the first one
  kOpen,
};

/// What is given at one point beyond what the series itself fixes.
struct PointConstraint {
  std::size_t index = 0;               ///< of the point as it was read, from 0
  std::optional<double> theta;         ///< heading, rad
  std::optional<double> kappa;         ///< signed curvature, 1/unit
  bool corner = false;                 ///< the contour may turn here at once (G0)
  std::optional<ValueRange> thetas{};  ///< headings that do, rad, at most half a turn apart
  std::optional<ValueRange> kappas{};  ///< signed curvatures that do, 1/unit
};

/// By what the headings and curvatures are chosen that the data leave open.
enum class Prefer {
  kFair,           ///< the fairest chain: change of curvature in units of what the points show
  kCentre,         ///< each in the middle of what is left to it, point after point ([003])
  kLeastChange,    ///< least integral of (d kappa / d s)^2 along the contour
  kLeastCurvature  ///< least largest curvature, within a hundredth of the possible (`above_least`)
};

/// What to form. Unset values take the defaults named here.
struct FitJob {
  Carrier carrier = Carrier::kSpiral;
  /// Of the spirals only. Unset: G3 as far as it costs no vertex and no inflection, G2 at the
  /// joints where it would, and G2 where `prefer` chooses headings. G3: the same, with a warning
  /// that names such joints; E203 with `prefer`.
  std::optional<Continuity> continuity{};
  Continuity followed = Continuity::kG2;  ///< other carriers: of the spirals that they follow and
                                          ///< are measured against
  std::optional<double> tolerance;        ///< largest region width, units; default 3e-6 of the size
  bool convex = false;                    ///< refuse inflections
  std::optional<double> start_heading;    ///< rad
  std::optional<double> end_heading;      ///< rad
  std::optional<double> start_kappa;      ///< 1/unit
  std::optional<double> end_kappa;        ///< 1/unit
  std::optional<ValueRange> start_thetas, end_thetas;  ///< ranges of the same
  std::optional<ValueRange> start_kappas, end_kappas;
  Prefer prefer = Prefer::kFair;  ///< others: open series of points that are met, one section
  /// Of kLeastCurvature: the largest curvature is at most so many times the least possible one,
  /// > 1. Unset: 1.005; of parabolas that follow no such contour more, up to 2, with a warning.
  std::optional<double> above_least{};
  std::optional<double> noise;       ///< how far every point may move, units; default: not at all
  bool noise_from_rounding = false;  ///< as far as half a unit of the last printed digit
  bool noise_from_scatter = false;   ///< as far as the points scatter about a smooth curve, which a
                                     ///< warning tells: docs/methods/series.md; plane series only
  Closing closing = Closing::kAutomatic;
  /// Of open series of one section: it goes on beyond both ends moved by this, as heights over a
  /// closed curve do; its last point is its first one so moved, and the contour is looked for with
  /// what lies beyond.
  std::optional<Vec2> period{};
  bool find_corners = true;            ///< where the series turns at once; else only marked ones
  std::optional<double> corner_angle;  ///< rad, what counts as a corner at least
  bool primitives = false;             ///< exact lines and arcs where the points allow them
  bool corners_between = true;         ///< and with them corners where two of them meet between
                                       ///< two points
  std::vector<PointConstraint>
      constraints;                      ///< ascending, at most one per point; range not checked
  bool measure_against_spirals = true;  ///< other carriers: how far they are from the spirals
};

/// What `fit` tries to make of the contour's own joints.
[[nodiscard]] Continuity wanted_continuity(const FitJob& job);

/// A contour with its report and its proof.
struct Fit {
  Contour contour;
  FitReport report;
  Certificate certificate;
  std::vector<std::string> warnings;
};

/// Forms and proves a contour through the points: analyse, choose headings and curvatures, bound
/// the region, form the pieces, prove them. Same input, same result, bit for bit (apart from
/// `seconds`). Cost O(n): every search ends after a number of steps per point.
/// Errors: E203 for a tolerance below 1e-12 of the size; E304, E309, E402 for the data; E401, E403,
/// E404, E405 when no such contour exists, E406 when the carrier cannot keep what was given, E407
/// when it would swing out between two points. A contour that was formed but not proved is returned
/// with `certificate.proved == false` and its reason: never hidden.
[[nodiscard]] Result<Fit> fit(const PointSeries& series, const FitJob& job,
                              const RunContext& run = {});
/// The same as part of some longer work.
[[nodiscard]] Result<Fit> fit(const PointSeries& series, const FitJob& job, Watch& watch);

/// What `verify` found: the new proof, the first claim of the file that is false (if any), and
/// which fields it took as they stand.
struct Verification {
  Certificate certificate;
  std::optional<Error> false_claim;
  std::vector<std::string> not_checked;  ///< "/units", "/report/seconds", ...
};

/// Proves a stored contour again from its own numbers and compares every claim of its report.
[[nodiscard]] Verification verify(const StoredContour& stored);
/// The same; error E103 when it was cancelled.
[[nodiscard]] Result<Verification> verify(const StoredContour& stored, const RunContext& run);

}  // namespace obvid
