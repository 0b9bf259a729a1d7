// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/alignment/alignment.h"
#include "obvid/alignment/profile.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/pipeline/element_table.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/internal/titled_contour.h"
#include "obvid/report/stored_contour.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// Heights along an alignment, of a file of their own.
struct StationHeights {
  std::vector<Vec2> points;  ///< station, height; units of the alignment, ascending
  double rounding = 0.0;     ///< half a unit of the last printed digit of heights
  std::vector<std::string> warnings;
};

/// Reads stations and heights, the first two columns of a list. Errors: those of `parse_points`;
/// E402 stations that do not ascend.
[[nodiscard]] Result<StationHeights> parse_heights(std::string_view text, std::string_view name);
/// The same of a file. Error: E301.
[[nodiscard]] Result<StationHeights> read_heights(const std::string& path);

/// What an alignment of points is to be.
struct AlignmentJob {
  std::optional<double> noise{};  ///< how far the alignment may pass a point, units; nothing: half
                                  ///< the diagonal of the cell of the last printed digits, as far
                                  ///< as rounding x and y may have moved it. Points with a
                                  ///< tolerance of their own keep that
  bool noise_from_scatter = false;  ///< estimated from the points, in place of `noise`
  bool noise_of_digits = false;     ///< that of nothing was asked for: heights have theirs, too
  double least_length = 0.0;  ///< of each element, units; 0: a quarter of the points' distance
  double least_radius = 0.0;  ///< of each place, units; 0: any
  Closing closing = Closing::kAutomatic;  ///< whether it goes around a loop
  std::optional<double> first_station{};  ///< of the first point, units; nothing: as `road` says
  DrawnRoad road{};  ///< what the file of the points says: station, and a profile that stays
  Transition transitions = Transition::kClothoid;  ///< wanted between lines and arcs
  bool without_transitions = false;         ///< lines and arcs alone; no `without_steps` then
  bool without_steps = false;               ///< of the curvature: G2 joints
  std::optional<double> acceleration{};     ///< to the side, m/s^2: what limits the speed
  std::optional<StationHeights> heights{};  ///< in place of those of the points
  std::optional<double>
      profile_noise{};  ///< how far the profile may pass a height, units; nothing: `noise` of
                        ///< heights of the points, where it is given; else estimated from the
                        ///< heights, and where that cannot be, as `profile_noise_of_digits`
  bool profile_noise_from_scatter = false;  ///< estimated from the heights or an error
  bool profile_noise_of_digits = false;     ///< half a unit of the last printed digit of heights
  ProfileOptions profile{};                 ///< curves, least length of its elements
};

/// The profile of an alignment, stations counted from `AlignmentJob::first_station`.
struct ProfileReport {
  VerticalProfile profile;
  std::vector<Vec2> heights;  ///< station, height: what it passes
  double tolerance = 0.0;     ///< units
  bool of_points = false;     ///< heights are those of the points, one each, in their order
  bool of_file = false;       ///< the profile of the file as it is: no heights, no tolerance
};

/// Lines, arcs and clothoids through points, with what is to be said of them.
struct AlignmentReport {
  std::string name;
  Units units;
  double tolerance = 0.0;  ///< largest of all points, units
  Alignment alignment;
  std::optional<SpeedLimit> limit;         ///< where an acceleration was given
  std::optional<ProfileReport> profile{};  ///< where there are heights
  std::vector<Vec2> points{};  ///< that it passes, one for each deviation: those of the series, and
                               ///< of pieces of a drawing more
  std::vector<std::string> remarks{};   ///< how tolerances were estimated
  std::vector<std::string> warnings{};  ///< what makes it doubtful: crossings, a detour
  StoredContour stored;  ///< the same as a contour with its certificate: each element a piece, or
                         ///< as many clothoids as keep to a transition of another kind
  std::vector<PlacedTransition> transitions{};  ///< these
};

/// Few lines, arcs and clothoids found (`fit_alignment`) within the tolerances of a series.
/// With heights, of the points or of a file, also their profile (`fit_profile`). Lines, arcs and
/// clothoids of a drawing (`PointSeries::kept`) are passed at points along them, not at joints
/// alone. What the file says of its own alignment (`AlignmentJob::road`) is kept: the first station
/// where none is given, and the profile where there are no heights and it is no loop; remarks tell.
/// Reentrant. Errors: those of `fit_alignment` and `fit_profile`; E302, E304 where a tolerance
/// cannot be estimated; E203 a tolerance that is not a positive length, or
/// none where the points have no printed digits, an acceleration that is not positive, or one
/// beside a unit that is no length.
[[nodiscard]] Result<AlignmentReport> alignment_report(const PointSeries& series,
                                                       const AlignmentJob& job,
                                                       const RunContext& run = {});

/// What is read of the points of an alignment: heights too.
[[nodiscard]] ImportOptions with_heights(ImportOptions import);

/// What reading warned of: of the heights of a file, then of the points.
[[nodiscard]] std::vector<std::string> warnings_of_reading(const PointSeries& series,
                                                           const AlignmentJob& job);

/// The alignment as formats of contours write it, with all that there is to warn of. `input`: what
/// its points were read from.
[[nodiscard]] TitledContour titled_contour(const AlignmentReport& made, const PointSeries& series,
                                           const AlignmentJob& job, const std::string& input);

/// What formats of contours do not write for it: .csv (elements) and .svg (over the stations).
/// Nothing of others.
[[nodiscard]] std::optional<std::string> alignment_file(FileFormat format,
                                                        const AlignmentReport& made);

/// Station, offset (to the left positive) and coordinates of each point; with a profile also height
/// and its offset (upwards positive), those of a file in rows of their own.
[[nodiscard]] DataTable deviation_rows(const AlignmentReport& report);
/// Grades and vertical curves: station, length, height, grades in percent, radius, and where the
/// grades meet.
[[nodiscard]] DataTable profile_rows(const VerticalProfile& profile);

/// Curve, curvature, speed and heights over the station as one SVG file.
[[nodiscard]] std::string alignment_picture(const AlignmentReport& report);

/// "4 lines, 3 arcs, 4 clothoids".
[[nodiscard]] std::string kinds_text(const Alignment& alignment);
/// The kinds, and how far points are off: below the title of pictures.
[[nodiscard]] std::string alignment_verdict(const AlignmentReport& report);

/// All figures; angles in rad, lengths in units, curvatures in 1/unit.
[[nodiscard]] std::string alignment_json(const AlignmentReport& report);

}  // namespace obvid
