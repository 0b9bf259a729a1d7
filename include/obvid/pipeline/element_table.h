// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <vector>

#include "obvid/alignment/alignment.h"
#include "obvid/alignment/profile.h"
#include "obvid/core/internal/data_table.h"
#include "obvid/curve/contour.h"
#include "obvid/io/internal/json_text.h"
#include "obvid/pipeline/audit.h"

namespace obvid {

/// The elements of a contour as surveyors list them, stations counted from `first_station`
/// (units). Clothoids that stand for a transition are that. Cubics over a parameter
/// have the curvatures of their ends, NaN where there is none (`is_singular_end`). Nothing where a
/// piece is none of these.
[[nodiscard]] std::optional<std::vector<AlignmentElement>> elements_of(
    const Contour& contour, double first_station,
    const std::vector<PlacedTransition>& transitions = {});

/// The same of a curve whose file counts stations; nothing where it does not.
[[nodiscard]] std::optional<std::vector<AlignmentElement>> elements_of(const CurveAudit& audit);

/// What limits the speed along an alignment: the acceleration to the side, v^2 / radius.
struct SpeedLimit {
  double acceleration = 0.0;  ///< m/s^2
  double metres = 1.0;        ///< of one unit of the alignment
};

/// Speed at the sharpest end of an element, km/h; nothing on a line.
[[nodiscard]] std::optional<double> speed_kmh(const AlignmentElement& element,
                                              const SpeedLimit& limit);

/// The table of elements: kind, station, length, radii, clothoid parameter, azimuth, coordinates,
/// and speeds where there is a limit. Radii are positive to the left, empty where it is straight.
[[nodiscard]] DataTable element_rows(const std::vector<AlignmentElement>& elements,
                                     const std::optional<SpeedLimit>& limit = {});
/// An array of objects; angles in rad, lengths in units, curvatures in 1/unit, speeds in km/h.
void add_elements(JsonText& json, const std::vector<AlignmentElement>& elements,
                  const std::optional<SpeedLimit>& limit = {});

/// An object with the elements of a profile; lengths in units, grades as heights over stations.
void add_profile(JsonText& json, const VerticalProfile& profile);
/// "grade", "crest", "sag".
[[nodiscard]] const char* to_string(ProfileKind kind);

/// "line", "arc", "clothoid", "bloss", "sine", "cosine", "helmert", "cubic", "cubic curve".
[[nodiscard]] const char* to_string(AlignmentKind kind);
/// Parameter of a clothoid, sqrt(length / |change of curvature|), units; 0 of other elements.
[[nodiscard]] double clothoid_parameter(const AlignmentElement& element);
/// Clockwise from the direction of y, degrees in [0, 360): what surveyors call the azimuth.
[[nodiscard]] double azimuth_deg(double theta);
/// How often the curvature steps from one element to the next.
[[nodiscard]] std::size_t curvature_steps(const std::vector<AlignmentElement>& elements);

}  // namespace obvid
