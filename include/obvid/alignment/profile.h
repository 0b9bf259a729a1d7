// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/geom/vec2.h"

namespace obvid {

/// Elements of a vertical profile: straight, rounding a summit, rounding a valley.
enum class ProfileKind { kGrade, kCrest, kSag };

/// What rounds the corners between grades.
enum class ProfileCurves {
  kParabolas,  ///< the grade is linear in the station, as most roads have it
  kArcs,       ///< arcs of circles over the station
};

inline constexpr std::array<std::string_view, 3> kProfileKindNames = {"grade", "crest", "sag"};
inline constexpr std::array<std::string_view, 2> kProfileCurveNames = {"parabolas", "arcs"};
/// "grade", "crest", "sag".
[[nodiscard]] inline std::string_view name_of(ProfileKind kind) {
  return kProfileKindNames[static_cast<std::size_t>(kind)];
}
/// "parabolas", "arcs".
[[nodiscard]] inline std::string_view name_of(ProfileCurves curves) {
  return kProfileCurveNames[static_cast<std::size_t>(curves)];
}

/// One element over [station, station + length].
struct ProfileElement {
  ProfileKind kind = ProfileKind::kGrade;
  double station = 0.0;  ///< of its start, units
  double length = 0.0;   ///< along the station, units
  double height = 0.0;   ///< at its start, units
  double grade0 = 0.0;   ///< slope at its start: heights over stations, 1 is 100 %
  double grade1 = 0.0;   ///< at its end
  double radius = 0.0;   ///< of arcs, of parabolas that at their vertex, units; positive in sags,
                         ///< negative on crests, 0 of grades
};

/// A vertical alignment: elements meet; grades do too but at corners of profiles that are read.
struct VerticalProfile {
  ProfileCurves curves = ProfileCurves::kParabolas;
  std::vector<ProfileElement> elements;  ///< ascending, each from where the last one ends
  double end_station = 0.0;              ///< units
  double end_height = 0.0;               ///< units
  std::vector<double> offsets;           ///< of the given heights, upwards positive, units; across
                                         ///< the profile where it has arcs
  double largest_share = 0.0;            ///< largest |offset| over its tolerance: 1 or less
  double rms = 0.0;                      ///< root of the mean square of the offsets, units
};

struct ProfileOptions {
  ProfileCurves curves = ProfileCurves::kParabolas;
  double least_length = 0.0;  ///< of each element, units (of arcs along the curve); 0: a quarter of
                              ///< the mean distance of heights, but what rounds a sharp kink of
                              ///< them is shorter. A profile of one may be shorter
  double lap = 0.0;           ///< of a loop: its length, units; 0: not closed
  double begin = 0.0;         ///< of a loop: the station at which the profile begins
};

/// Few grades and vertical curves, each beginning with the grade of the one before, within
/// `tolerance[i]` of height `points[i].y` at station `points[i].x`. Found as horizontal alignments
/// are (`fit_alignment`), in the plane of stations and heights: among profiles of as many elements
/// grades are preferred wherever the tolerance allows them.
///
/// Guaranteed: every offset is at most its tolerance (else an error), grades are continuous but for
/// rounding, elements are as long as asked for. Not guaranteed: that no fewer elements exist, nor
/// that heights bear every grade between them (`unborne_grades`), where elements have to be long.
/// The profile begins at the station of the first height and ends at that of the last one; its
/// first and last arc may be shorter than the least length by what lies beyond them. Around a loop
/// (`lap`; heights within one lap) height and grade at the end are those at the start; the element
/// that passes `begin` is cut there. Deterministic; reentrant.
///
/// Errors: E203 a least length or a lap that is negative or no number, E304 fewer than two heights
/// (around a loop three), E402 stations that do not ascend or are a lap apart (`index`), E401 none
/// found, E502 not within the tolerance with such lengths, E103 cancelled.
[[nodiscard]] Result<VerticalProfile> fit_profile(const std::vector<Vec2>& points,
                                                  const std::vector<double>& tolerance,
                                                  const ProfileOptions& options = {},
                                                  const RunContext& run = {});

/// Height and grade of a profile; beyond its ends those of the grades there.
struct ProfilePlace {
  double height = 0.0;  ///< units
  double grade = 0.0;   ///< heights over stations
};
[[nodiscard]] ProfilePlace profile_at(const VerticalProfile& profile, double station);

/// Where the grades at both ends of an element meet (the PVI): station and height. The middle of a
/// grade.
[[nodiscard]] Vec2 grades_meet(const ProfileElement& element, ProfileCurves curves);

}  // namespace obvid
