// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/curve/contour.h"
#include "obvid/exchange/internal/gcode/gcode.h"

namespace obvid {

// Cutting in two dimensions: all outlines of a drawing in one program for a mill, a laser or a
// plasma torch.

enum class CutProcess { kMill, kLaser, kPlasma };

/// Where the tool runs.
enum class CutSide {
  kAuto,     ///< around parts and inside of their holes, as outlines lie in each other; open ones
             ///< are followed
  kOutside,  ///< around every closed outline
  kInside,   ///< inside of every closed outline
  kOn,       ///< along the outlines, without compensation
};

/// Climb: what stays lies to the right of the tool, as is right for a spindle that turns clockwise.
enum class CutDirection { kClimb, kConventional };

/// Bridges that hold a part: on every closed outline that is compensated.
struct CutTabs {
  int count = 0;
  double width = 0.0;   ///< of a bridge, along the outline
  double height = 0.0;  ///< above the bottom
};

/// Lengths in units of the drawing, feeds in mm/min (in/min for inches); nothing given: what is
/// said in brackets.
struct CutOptions {
  CutProcess process = CutProcess::kMill;
  double diameter = 0.0;  ///< of the cutter, or width of the kerf; 0: along the outlines
  CutSide side = CutSide::kAuto;
  CutDirection direction = CutDirection::kClimb;
  double tolerance = 0.01;             ///< of the printed program, to both sides of the outlines
  double depth = 0.0;                  ///< of mills: bottom of the cut below Z0
  std::optional<double> pass_depth{};  ///< most a pass goes down [the whole depth]
  int passes = 1;                      ///< of lasers, one over the other
  std::optional<double> ramp_deg{};    ///< goes down along the outline [straight down]
  CutTabs tabs{};
  double lead_in = 0.0;            ///< radius of the arcs that lead to an outline and away; 0: none
  std::optional<Vec2> start{};     ///< closed outlines begin nearest to it [to where the tool is]
  std::optional<double> safe_z{};  ///< of rapid moves of mills [5 mm; 0.2 in]
  std::optional<double> feed{}, plunge_feed{}, rapid_feed{};  ///< [1000, 300, 3000; 40, 12, 120]
  std::optional<double> spindle{};      ///< revolutions a minute, or power of a laser: the word S
  double pierce_seconds = 0.0;          ///< dwell of a torch or laser before it moves
  std::optional<double> centripetal{};  ///< most acceleration across the path, mm/s^2: slows arcs
  std::optional<double>
      acceleration{};  ///< along it, mm/s^2, for the estimate of time [500 mm/s^2]
  GcodeController controller = GcodeController::kGrbl;
  GcodeMotion motion = GcodeMotion::kArcs;  ///< or splines: G5 where one block stands for several
  std::optional<int> decimals{};  ///< 1 to 6 [the fewest, at least 3, that cost no more than a
                                  ///< tenth of the tolerance]
  std::string name = "drawing";   ///< stands in a remark
};

/// outside, inside or on.
[[nodiscard]] const char* to_string(CutSide side);

/// A curve to cut.
struct CutOutline {
  std::string name;
  Contour contour;              ///< all of one unit
  bool is_cut = true;           ///< else it only says what lies in what
  bool edges_of_curve = false;  ///< lines that are chords of a curve: arcs may stand for several
};

/// What became of an outline, in the order of cutting. Lengths in units of the drawing.
struct CutStep {
  std::size_t outline = 0;  ///< of those given; of several that are one curve the first
  std::string name;         ///< its name, with those of others that belong to it
  bool closed = false;
  std::size_t around = 0;  ///< how many other outlines lie around it
  CutSide side = CutSide::kOn;
  Vec2 start;                    ///< where the tool comes to the path
  double length = 0.0;           ///< of the path of the tool's axis, once around
  double left_in_corners = 0.0;  ///< what the round tool leaves in inner corners, from the corner
};

enum class CutMoveKind { kRapid, kCut, kTab };  ///< kTab: over a bridge, which stays

/// A stretch of the tool's axis seen from above, as printed.
struct CutMove {
  CutMoveKind kind = CutMoveKind::kCut;
  Piece piece;
};

struct CutReport {
  std::size_t blocks = 0;         ///< that cut
  std::size_t arc_blocks = 0;     ///< of them G2 and G3
  std::size_t spline_blocks = 0;  ///< of them G5
  double cut_length = 0.0;        ///< units, all passes, seen from above
  double rapid_length = 0.0;      ///< units, seen from above
  double minutes = 0.0;           ///< with acceleration
  int levels = 0;                 ///< passes over each other
  /// Of the program as printed, read back: how far the edge of the tool comes beyond an outline,
  /// and how far from an outline it stays, inner corners apart. Found at places `spacing` apart;
  /// not bounded between them.
  double beyond = 0.0, short_of = 0.0, spacing = 0.0;
  double blending = 0.0;  ///< how far the controller may leave that, as the program tells it
  double left_in_corners = 0.0;
};

struct CutProgram {
  std::string text;
  std::vector<CutStep> steps;
  std::vector<CutMove> moves;  ///< one pass of each outline, for pictures
  CutReport report;
  std::vector<std::string> warnings;
};

/// The parallel of a line or arc at `by` to its left; nothing where it vanishes, and for other
/// pieces.
[[nodiscard]] std::optional<Piece> parallel_piece(const Piece& piece, double by);

/// The program. Each outline becomes arcs and lines within the tolerance (`arcs_along`; in place of
/// chords of curves the longest arcs, one after another, that stay within it of the chords); the
/// tool's path is their exact parallel at half the diameter (arcs of other radii, arcs around outer
/// corners, cut off at inner ones). Outlines inside others are cut before them, the nearest first,
/// improved by exchanges: short, not proved to be shortest. With splines, neighbouring lines and
/// arcs at one height become cubics (G5) as far as one stays within what is left of the tolerance;
/// arcs are nearer to the outline then. Not on ramps, as G5 has no height. The text is read back
/// before it is handed out; for LinuxCNC a quarter of the tolerance is left to its blending (G64
/// P). Errors: E203 sizes, feeds or options that do not go together, splines for another controller
/// than LinuxCNC; E311 no outline; E409 the tool does not fit: it would cut into this outline or
/// another one there or does not enter a slot or notch of it (`where`; the hint names one that
/// does where the outline's own shape decides); E502 decimals too few for the tolerance, or the
/// printed program leaves it; E103.
[[nodiscard]] Result<CutProgram> cut(const std::vector<CutOutline>& outlines,
                                     const CutOptions& options, const RunContext& run = {});

}  // namespace obvid
