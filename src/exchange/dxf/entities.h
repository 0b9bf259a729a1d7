// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dxf/tags.h"

namespace obvid::dxf {

struct Point3 {
  double x = 0.0, y = 0.0, z = 0.0;
};

enum class Kind {
  kLine,
  kArc,
  kCircle,
  kEllipse,
  kSpline,
  kPolyline,  ///< LWPOLYLINE or POLYLINE
  kPoint,
  kInsert,
  kVertex,  ///< belongs to the POLYLINE before it
  kEnd,     ///< SEQEND
  kOther,
};

/// Why something is not drawn, or not as it stands: `reason` is one of a few, `detail` the figures.
struct Fault {
  const char* reason = nullptr;  ///< nullptr: none
  std::string detail;
};

/// One entity with what the group codes say; texts point into the file.
struct Entity {
  Kind kind = Kind::kOther;
  std::string_view type, handle, layer = "0", block;
  std::size_t line = 0;
  bool paper = false;  ///< lies in the paper space
  bool invisible = false;
  Point3 normal{0.0, 0.0, 1.0};  ///< of the plane whose coordinates plane entities are given in
  Point3 at;      ///< start of a line, centre, insertion point, elevation of a polyline, the point
  Point3 second;  ///< end of a line, major axis of an ellipse
  Point3 scale{1.0, 1.0, 1.0};  ///< of an insert
  double size = 0.0;            ///< radius; minor over major axis
  double from = 0.0, to = 0.0;  ///< angles: of arcs in degrees; of ellipses the eccentric one, rad;
                                ///< `from` of an insert its rotation in degrees
  int flags = 0, degree = 0;
  int columns = 1, rows = 1;  ///< of an array of inserts
  double column_step = 0.0, row_step = 0.0;
  std::vector<Point3> points;        ///< vertices, control points
  std::vector<Point3> fit;           ///< points that a spline was drawn through
  std::optional<Point3> start, end;  ///< directions of that spline at its ends
  std::vector<double> bulges, knots, weights;
  Fault fault;
};

inline constexpr int kClosedFlag = 1;      ///< of polylines and splines
inline constexpr int kPolyline3dFlag = 8;  ///< and of vertices that a spline frame brought about
inline constexpr int kFrameVertexFlag = 16;
inline constexpr int kMeshFlags = 16 | 64;

/// The entity that these tags describe, the first one being its 0 tag. Numbers that cannot be read
/// and counts that contradict the lists are its fault.
[[nodiscard]] Entity entity_of(std::span<const Tag> tags);

/// Adds a VERTEX to its POLYLINE.
void add_vertex(Entity& polyline, const Entity& vertex);

}  // namespace obvid::dxf
