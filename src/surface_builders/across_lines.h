// SPDX-License-Identifier: Apache-2.0
// Lines u = const of a skin, and how they bend.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "obvid/curve/internal/basis.h"
#include "obvid/surface/nurbs_surface.h"
#include "obvid/surface_builders/internal/taut_string.h"

namespace obvid {

/// Isoline of a polynomial surface: control points of the line, and of the derivative by u along
/// it.
class Isoline {
 public:
  Isoline(const NurbsSurface& surface, double u);

  struct Place {
    Vec3 point, du, dv, dvv;
  };
  [[nodiscard]] Place at(const BasisValues& v) const;
  /// One derivative along the line.
  [[nodiscard]] Vec3 derivative(const BasisValues& v, std::size_t order) const;

 private:
  std::vector<Vec3> line_, slope_;
  std::size_t order_;
};

/// Where the waves along isolines are counted.
struct AcrossPlaces {
  std::vector<double> steps;  ///< between the places, by v
  std::vector<BasisValues> between, sections;
};

/// B-splines across the sections, and derivatives, at parameters that all isolines share.
[[nodiscard]] std::vector<BasisValues> bases_across(const NurbsSurface& surface,
                                                    const std::vector<double>& v, int derivatives);
/// `v`: parameters of the sections.
[[nodiscard]] AcrossPlaces places_across(const NurbsSurface& surface, const std::vector<double>& v);

/// Changes of sign of the normal curvature along a line, of bulges higher than each of two
/// tolerances.
[[nodiscard]] std::array<std::size_t, 2> waves_found(const Isoline& line,
                                                     const AcrossPlaces& places,
                                                     const std::array<double, 2>& tolerances);

/// A line developed into a plane, with a tolerance to both sides of its heights.
struct DevelopedLine {
  Tube tube;
  std::vector<std::size_t> section;  ///< of each node of the tube
};

/// The points of a line at the sections as heights over its chords: second differences are those of
/// the points along their normals, ends are 0. A shift of a point along its normal changes its
/// height by as much, to first order in the turn of normals between neighbours. Points that are the
/// same count once; without a normal the one before goes on.
[[nodiscard]] DevelopedLine developed(const Isoline& line, const AcrossPlaces& places,
                                      double tolerance);
/// With a tolerance of each section.
[[nodiscard]] DevelopedLine developed(const Isoline& line, const AcrossPlaces& places,
                                      const std::vector<double>& tolerance);

}  // namespace obvid
