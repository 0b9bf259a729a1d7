// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/progress.h"
#include "obvid/core/result.h"
#include "obvid/surface/surface.h"

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
};

/// Lengths in units of the model; feeds in mm/min, for models in inches in in/min.
struct ToolpathOptions {
  Cutter cutter;
  ToolpathStrategy strategy = ToolpathStrategy::kZigzag;
  std::optional<double> scallop;    ///< greatest height of what stays between passes
  std::optional<double> step_over;  ///< greatest distance of passes seen from above (zigzag,
                                    ///< constant scallop) or along the surface (isoparametric)
  double angle_deg = 0.0;           ///< of the passes against X; not for isoparametric ones
  bool along_v = false;             ///< isoparametric: passes run along v, else along u
  bool one_way = false;             ///< all passes in the same direction
  double tolerance = 0.01;          ///< gouges and chords together
  double feed = 1000.0;
  double plunge_feed = 300.0;
  double rapid_feed = 5000.0;      ///< for the estimate of time only
  std::optional<double> safe_z{};  ///< [half a diameter above the highest point]
  std::size_t most_points = 20'000'000;
};

enum class ToolMove {
  kRapid,   ///< at or up to the safe height
  kPlunge,  ///< straight down from it
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

struct ToolpathReport {
  std::size_t passes = 0;       ///< stretches that cut
  double cutting_length = 0.0;  ///< passes and links, units
  double plunge_length = 0.0;
  double rapid_length = 0.0;
  double minutes = 0.0;  ///< at the stated feeds, without acceleration
  /// Greatest height that the passes leave, measured along the normal over the whole surface where
  /// the cutter can reach it at all (within the tolerance), units; and where.
  double scallop = 0.0;
  Vec3 scallop_place;
  double scallop_raster = 0.0;   ///< it was measured at places so far apart, seen from above
  std::size_t added_passes = 0;  ///< between others that left too much
  /// Points of passes where the cutter rests on two places (all strategies) or is held up by
  /// another place than it was meant to touch (isoparametric): gouges that were avoided.
  std::size_t lifted_points = 0;
  double surface_area = 0.0;  ///< of the model
  double hidden_area = 0.0;   ///< not seen from above: not cut
  double unreached_area =
      0.0;  ///< seen, but where the cutter cannot touch without cutting elsewhere
  double unreached_depth = 0.0;  ///< how far from the surface it stays there at most, units
  double safe_z = 0.0;
};

struct Toolpath {
  std::string name;
  std::string units;
  Cutter cutter;
  double tolerance = 0.0;
  double feed = 0.0;
  double plunge_feed = 0.0;
  std::vector<ToolpathMove> moves;
  ToolpathReport report;
  std::vector<std::string> warnings;
};

/// Tool paths of three axes over all patches. Wherever the cutter goes at feed, it is at the height
/// where it touches the whole surface from above: nothing is cut deeper than the tolerance
/// (triangles, the way between points and printing share it; the shares are proved, see
/// docs/methods/toolpath.md). Both sides of patches count. Passes of zigzag and constant scallop
/// run over open borders by about a step, rolling over the edge.
///
/// The scallop is kept by all cutters as far as `scallop_raster` shows it: heights between its
/// places and at places that hold the cutter up within the tolerance can be somewhat greater
/// (docs/methods/toolpath.md has figures).
/// Where the scallop needs passes nearer than a tenth of what a level place needs (walls), it is
/// not always kept; a warning says what is left and where. Errors: E203 sizes, feeds, heights or
/// options that do not go together; E304 no patches; E310 a unit that machines do not know; E502
/// more triangles or points than allowed; those of `tessellate`.
[[nodiscard]] Result<Toolpath> plan(const SurfaceModel& model, const ToolpathOptions& options,
                                    const Progress& progress = {});

/// For pictures: moves at feed (passes and links) or rapid moves (with plunges), thinned out within
/// `within` units.
[[nodiscard]] std::vector<std::vector<Vec3>> cutting_lines(const Toolpath& path, double within);
[[nodiscard]] std::vector<std::vector<Vec3>> rapid_lines(const Toolpath& path);

}  // namespace obvid
