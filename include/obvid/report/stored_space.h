// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/units.h"
#include "obvid/geom/vec3.h"
#include "obvid/report/stored_contour.h"
#include "obvid/surface/point_grid.h"
#include "obvid/surface/space_curve.h"

namespace obvid {

/// What the file of a curve in space says of its shape; lengths in its units.
struct SpaceFigures {
  double least_curvature = 0.0, largest_curvature = 0.0;  ///< enclose the curvature, 1/unit
  std::size_t torsion_places = 0;
  double least_torsion = 0.0, largest_torsion = 0.0;  ///< at these places, 1/unit
  double torsion_step = 0.0;                          ///< largest at a joint, 1/unit
};

/// How well the heights of a closed curve meet where they end and begin: where the
/// projection begins. The projection is closed itself, and its certificate has its gaps.
struct SpaceSeam {
  double position = 0.0;   ///< of the height, relative to the length of the projection
  double heading = 0.0;    ///< rad
  double curvature = 0.0;  ///< relative to the larger of the two, but not less than 1e-6 of the
                           ///< largest at the ends of the two pieces
};

/// A curve in space as its file has it (docs/formats.md).
struct StoredSpace {
  std::string name;
  Units units;
  Frame frame;
  Vec3 normal;  ///< as stated; `frame.normal()` follows from the other two
  double flatness = 0.0, largest_move = 0.0;
  std::vector<Vec3> points;
  StoredContour plan;                    ///< in the plane, or of the projection
  std::optional<StoredContour> heights;  ///< none: the curve is planar
  SpaceFigures figures;                  ///< of curves that are not planar
  std::optional<SpaceSeam> seam;         ///< of closed curves that are not planar
  SpaceCurve curve;
  double deviation = 0.0;           ///< of `curve`
  std::vector<std::string> unread;  ///< fields that mean nothing to this program
};

/// Where two curves of a chain meet.
struct SpaceCorner {
  std::size_t point = 0;  ///< index among the points of the chain
  double turn = 0.0;      ///< angle between both tangents, rad, 0 to pi
};

/// Curves in space from corner to corner. A closed chain does not repeat its first point. An open
/// chain has one part more than corners, the first from its first point; the parts of a closed one
/// begin at its corners in order, and the last of them ends at the first corner.
struct StoredSpaceChain {
  std::string name;
  Units units;
  bool closed = false;  ///< of a chain with corners
  double largest_move = 0.0;
  std::vector<Vec3> points;
  std::vector<SpaceCorner> corners;
  std::vector<StoredSpace> parts;   ///< one and no corners: the file of a single curve
  std::vector<std::string> unread;  ///< beside those of the parts
};

}  // namespace obvid
