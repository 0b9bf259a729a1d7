// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/core/units.h"
#include "obvid/surface/surface.h"
#include "obvid/toolpath/internal/toolpath_gcode.h"

namespace obvid {

enum class CutterKind { kBall, kFlat, kBullNose };

/// A mill that turns about Z; its place is the tip: the lowest point of the axis.
struct Cutter {
  CutterKind kind = CutterKind::kBall;
  double diameter = 6.0;       ///< model units
  double corner_radius = 0.0;  ///< of bull noses: greater than 0, less than half the diameter
};

enum class ToolpathStrategy {
  kZigzag,           ///< passes in parallel planes upright on XY
  kIsoparametric,    ///< passes touch along lines of the patches' parameters
  kConstantScallop,  ///< each pass lies as far from the last as the scallop allows, place by place
  kZLevel,           ///< passes at constant height around the walls of the part
  kRough,  ///< a box of stock is taken off level by level, down to the part and its allowance
};

/// How the tip goes down into what stands over the passes.
enum class ToolpathEntry {
  kRamp,   ///< back and forth over the beginning of the pass
  kHelix,  ///< around a circle beside it; where there is no room for one, on a ramp
};

/// Feeds, unless others are given: mm/min, and in/min for models in inches.
struct ToolpathFeeds {
  double pass = 0.0, plunge = 0.0;
  double rapid = 0.0;  ///< for the estimate of time only
};
[[nodiscard]] ToolpathFeeds default_feeds(const Units& units);

/// Lengths in units of the model.
struct ToolpathOptions {
  Cutter cutter;
  ToolpathStrategy strategy = ToolpathStrategy::kZigzag;
  std::optional<double> scallop;    ///< greatest height of what stays between passes
  std::optional<double> step_over;  ///< greatest distance of passes seen from above (zigzag,
                                    ///< constant scallop) or along the surface (isoparametric)
  double angle_deg = 0.0;           ///< of the passes against X; not for isoparametric ones
  bool along_v = false;             ///< isoparametric: passes run along v, else along u
  bool one_way = false;             ///< all passes in the same direction
  double allowance = 0.0;           ///< along normals, what stays everywhere for later passes
  /// Not roughing: passes only where this larger cutter, resting on every place of the part with
  /// the same allowance, came no nearer to it than the tolerance [none: everywhere]. Scallop and
  /// what is not reached are told of these places alone.
  std::optional<Cutter> earlier{};
  /// Roughing: most of a level [half the diameter]; levels of walls: likewise [by the scallop].
  std::optional<double> step_down{};
  /// Walls that lean from the level by at least so many degrees are cut on levels. With zigzag
  /// (passes only where it is flatter) [none], with levels: for these the scallop is kept [45].
  std::optional<double> steep_deg{};
  /// Roughing: low and high corner of the stock [the box of the part, wider by the allowance on its
  /// sides and on top].
  std::optional<std::array<Vec3, 2>> stock{};
  /// Roughing: where a pass does not begin beside the stock [ramp]; other strategies [straight
  /// down, a ramp where its angle is given].
  std::optional<ToolpathEntry> entry{};
  /// Of ramps and helices, how steeply they go down at most over the pass, and where they go beside
  /// it over level ground and the part [5].
  std::optional<double> ramp_deg{};
  /// Not roughing: what is thought to stand over the passes. Ramps and helices begin that much
  /// higher, or at the safe height where that is lower; on their way they rise with the pass, or
  /// with what the tip rests on beside it, at most to the safe height [half a diameter].
  std::optional<double> ramp_height{};
  std::optional<double> spindle{};                            ///< revolutions a minute [no M3]
  double tolerance = 0.01;                                    ///< of the printed program: gouges
  std::optional<double> feed{}, plunge_feed{}, rapid_feed{};  ///< [default_feeds]
  std::optional<double> acceleration{};  ///< along the way, for the estimate of time [500 mm/s^2]
  std::optional<double> safe_z{};        ///< [half a diameter above the highest point]
  std::size_t most_points = 20'000'000;
  std::size_t threads = 0;  ///< [all of the machine]; the result does not depend on it
  ToolpathGcodeOptions gcode{};
};

enum class ToolMove {
  kRapid,   ///< at or up to the safe height
  kPlunge,  ///< down from it, straight or on ramps
  kLink,    ///< from pass to pass, on the surface
  kPass,
};

/// The plane upright on X or Y in which a pass lies, if any: there controllers know arcs.
enum class PassPlane { kNone, kXz, kYz };

/// Points of the tip, each move begins where the last ended.
struct ToolpathMove {
  ToolMove kind = ToolMove::kPass;
  PassPlane plane = PassPlane::kNone;
  std::vector<Vec3> points;
};

/// Ways down from rapid moves to passes.
struct ToolpathEntries {
  std::size_t helical = 0, ramped = 0;
  std::size_t straight = 0;   ///< roughing: beside the stock
  double steepest_deg = 0.0;  ///< of helices and ramps against the level, anywhere on their way
  Vec3 steepest_place;        ///< of the tip, where they go down so
  double asked_deg = 0.0;     ///< how steep they may be; 0: all go straight down
};

struct ToolpathReport {
  std::size_t passes = 0;       ///< stretches that cut
  double cutting_length = 0.0;  ///< passes and links, units
  double plunge_length = 0.0;   ///< ways down to passes, straight, as ramps or helices
  double rapid_length = 0.0;
  double minutes = 0.0;  ///< of the printed program from its first place on, with acceleration:
                         ///< an estimate (docs/methods/toolpath.md)
  /// Of the printed program, read as a controller reads it and simulated against the surface
  /// itself. `found`: at a place that was looked at; `most`: nowhere more, by the bends of cutter
  /// and surface around those places.
  struct Measured {
    double found = 0.0, most = 0.0;  ///< units; `most` is infinite where no bound is known
    Vec3 place;                      ///< where it was found
  };
  Measured gouge;  ///< depth of a point of the surface in the cutter's body
  /// What stays, along the normal, where the cutter can reach the surface at all (within the
  /// tolerance). Roughing: stock over the allowance, at the middles of places `spacing` apart; no
  /// bound is known.
  Measured scallop;
  double spacing = 0.0;  ///< of the places looked at first; closer ones where they do not decide
  std::size_t added_passes = 0;  ///< between others that left too much
  /// Points of passes where the cutter rests on two places (all strategies) or is held up by
  /// another place than it was meant to touch (isoparametric): gouges that were avoided.
  std::size_t lifted_points = 0;
  double surface_area = 0.0;  ///< of the model
  /// Not seen from above: not cut. Roughing does not look for this, nor for what is not reached:
  /// the three figures are not numbers (NaN) then.
  double hidden_area = 0.0;
  std::size_t hidden_places = 0;  ///< of places `spacing` apart
  Vec3 hidden_place;              ///< the lowest of them
  /// Seen, but no place of the cutter comes within the tolerance without cutting elsewhere. Told by
  /// the middles of places `spacing` apart, as is the hidden area.
  double unreached_area = 0.0;
  std::size_t unreached_places = 0;
  double unreached_depth = 0.0;  ///< how far from the surface the cutter stays there at most, units
  Vec3 unreached_place;
  /// After an earlier cutter: what it did not come to within the tolerance, by the middles of
  /// places `spacing` apart, and the most that it left there along normals (infinite: more than its
  /// diameter).
  double leftover_area = 0.0, leftover_depth = 0.0;
  Vec3 leftover_place;
  /// With levels alone: the most that stays where the part is flatter than they are for, over the
  /// middles of places `spacing` apart, and the area of those places where that is more than the
  /// scallop (the tolerance, where none is given). The scallop is that of the walls then.
  double flat_left = 0.0, flat_area = 0.0;
  Vec3 flat_place;
  ToolpathEntries entries;
  double safe_z = 0.0;
  std::size_t levels = 0;            ///< of roughing and of walls
  std::size_t narrow_stretches = 0;  ///< too short for the ramp: left out
};

struct Toolpath {
  std::string name;
  Units units;
  Cutter cutter;
  double tolerance = 0.0;
  double print_within = 0.0;  ///< units: of printed blocks from the points of the moves
  ToolpathFeeds feeds;
  std::optional<double> spindle{};       ///< revolutions a minute
  std::optional<double> acceleration{};  ///< mm/s^2; as in the options
  std::vector<ToolpathMove> moves;
  ToolpathGcode program;  ///< what the report is about
  ToolpathReport report;
  /// Short lines on places that are hidden from above, and that the cutter does not reach (on some
  /// of many): for pictures.
  std::vector<std::array<Vec3, 2>> hidden_strokes, unreached_strokes;
  std::vector<std::string> warnings;
  /// What was asked for and is not so (E502): gouges, more left than the scallop, places that the
  /// cutter does not reach.
  std::vector<Error> not_kept;
};

/// Tool paths of three axes over all patches, and the program for them. Wherever the cutter goes at
/// feed, it is at the height where it touches the whole surface from above. Both sides of patches
/// count; of trimmed ones what is there. Passes of zigzag and constant scallop end at open borders,
/// where the cutter still touches the surface with its side or stands over it; those that run along
/// a border do so up to a step outside of it, no lower than that. Where passes leave too much,
/// others are put between them. At last the printed text is read back and simulated against the
/// surface: the report's figures for gouges, scallops and what is not reached come from that alone,
/// and `not_kept` says what does not hold (docs/methods/toolpath.md). Roughing takes straight
/// stretches on levels, from the top of the stock to its bottom, where the cutter stays clear of
/// part and allowance; it goes down outside the stock or along ramps, and rapid moves stay at the
/// safe height. With an allowance, gouges are cuts into part and allowance, and heights of what
/// stays count from the allowance. Errors: E203 sizes, feeds, heights or options that do not go
/// together, and a unit without a length in metres; E311 no patches; E502 more triangles or points
/// than allowed, or decimals too few for the tolerance; those of `tessellate`.
[[nodiscard]] Result<Toolpath> plan(const SurfaceModel& model, const ToolpathOptions& options,
                                    const RunContext& run = {});

/// For pictures: moves at feed (passes and links) or rapid moves (with plunges), thinned out within
/// `within` units.
[[nodiscard]] std::vector<std::vector<Vec3>> cutting_lines(const Toolpath& path, double within);
[[nodiscard]] std::vector<std::vector<Vec3>> rapid_lines(const Toolpath& path);

}  // namespace obvid
