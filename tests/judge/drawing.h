// SPDX-License-Identifier: Apache-2.0
// What files of other systems draw, read independently: STEP, DXF, G-code.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "real_curve.h"

namespace judge {

struct Drawing {
  std::vector<Span> spans;       ///< contour units, seen from the origin
  std::optional<double> metres;  ///< of the file's unit
  std::string fault;             ///< empty: read

  // a worksheet in DXF
  struct Owner {
    std::string layer;
    std::size_t entity = 0;
  };
  struct Mark {
    std::string layer, text;  ///< a point has no text
    Vec at;
  };
  std::vector<Owner> owners;  ///< of the spans
  std::vector<Mark> marks;

  // G-code
  long blocks = 0, arc_blocks = 0;
  double worst_radius_mismatch = 0.0;  ///< file units
};

/// Metres of a unit of length; none for unknown names.
std::optional<double> metres_of(const std::string& unit);

Drawing read_step(const std::string& text, Point origin, const std::string& unit);
Drawing read_dxf(const std::string& text, Point origin, const std::string& unit);
/// With points and texts, and with the layers of all.
Drawing read_dxf_sheet(const std::string& text, Point origin, const std::string& unit);
Drawing read_gcode(const std::string& text, Point origin, const std::string& unit);

/// Bezier spans of a NURBS curve with any knots.
std::vector<Span> spans_of_nurbs(int degree, const std::vector<Real>& knots,
                                 const std::vector<Vec>& points, const std::vector<Real>& weights);
/// Arc around a centre from one angle by another.
Span arc_span(Vec centre, Real radius, Real from, Real turn);

}  // namespace judge
