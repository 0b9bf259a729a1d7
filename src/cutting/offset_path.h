// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/internal/box.h"

namespace obvid::cutting {

/// Lines and arcs, each beginning where the one before ends.
struct ArcPath {
  std::vector<Piece> pieces;
  bool closed = false;
};

/// Of lines, arcs and cubics: headings at the ends, length, and the same piece larger.
[[nodiscard]] double heading_at_start(const Piece& piece);
[[nodiscard]] double heading_at_end(const Piece& piece);
[[nodiscard]] Piece scaled(const Piece& piece, double factor);
/// Whether the second piece goes on with the heading of the first, to rounding.
[[nodiscard]] bool is_smooth(const Piece& before, const Piece& behind);
/// Of lines and arcs.
[[nodiscard]] double curvature_of(const Piece& piece);
[[nodiscard]] double length_of(const Piece& piece);
[[nodiscard]] double length_of(const ArcPath& path);
/// The part of a line or arc between two places of it, 0 <= from < to <= 1.
[[nodiscard]] Piece part_of(const Piece& piece, double from, double to);
[[nodiscard]] ArcPath reversed(const ArcPath& path);
/// A closed path that begins at a place of one of its pieces.
[[nodiscard]] ArcPath begun_at(const ArcPath& path, std::size_t piece, double place);

/// A box that a line or arc does not leave.
[[nodiscard]] Box2 box_of(const Piece& piece);

/// Area to the left of a closed path: positive where it runs counterclockwise.
[[nodiscard]] double area_of(const ArcPath& path);

/// Nearest distance of a point from a line or arc.
[[nodiscard]] double distance_from(const Piece& piece, Vec2 point);

/// The place of a line or arc, 0 to 1, that is nearest to a point; of several the first.
[[nodiscard]] double nearest_place(const Piece& piece, Vec2 point);

/// Where the whole lines and circles of two pieces cross.
[[nodiscard]] std::vector<Vec2> crossings_of(const Piece& first, const Piece& second);

/// Where two pieces meet, as places of both; nothing: they do not. Of two meetings the one that is
/// later on the first and earlier on the second.
struct Meeting {
  double on_first = 0.0, on_second = 0.0;
};
[[nodiscard]] std::optional<Meeting> meeting_of(const Piece& first, const Piece& second);

/// The parallel of a path, at `by` to its left (a negative one lies to the right): exact arcs of
/// other radii, arcs around corners that turn away, cut off where corners turn towards it.
struct Parallel {
  ArcPath path;
  /// Corners that were cut off: a round tool of radius |by| touches the outline no nearer to them
  /// than `reach`, and stays `left` away from them.
  struct InnerCorner {
    Vec2 at;
    double reach = 0.0, left = 0.0;
  };
  std::vector<InnerCorner> corners;
  /// Whole edges of the outline that the tool does not touch, between two places that it does.
  struct Untouched {
    Vec2 at;              ///< the inner corner there that is farthest from the tool
    double length = 0.0;  ///< of the pieces that it does not touch at all
    double left = 0.0;    ///< how far the tool stays from that corner
    /// A slot or notch that the tool does not enter: it lies on both corners of its mouth, its
    /// walls turn back by half a turn, or more than one feature is in it. Else an inner corner with
    /// a chamfer or a step that is too short for the tool.
    bool slot = false;
  };
  std::vector<Untouched> untouched;
};
/// Errors: E409 a hollow narrower than the tool (`value`: its radius), or neighbours of a corner
/// that do not meet. What meets itself elsewhere is not looked for.
[[nodiscard]] Result<Parallel> parallel_of(const ArcPath& path, double by);

}  // namespace obvid::cutting
