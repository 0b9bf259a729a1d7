// SPDX-License-Identifier: Apache-2.0
// Checks of what other commands than `fit` of plane points print and write.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "json_text.h"
#include "sheet.h"
#include "space_course.h"

namespace judge {

/// All claims of a curve in space itself. `part`: of a chain; its plane goes through both ends.
void check_space(const SpaceCourse& curve, const Json& json, Sheet& sheet, bool part = false);

/// Curves in space from corner to corner.
struct SpaceChainFile {
  struct Corner {
    std::size_t point = 0;
    Real turn = 0.0L;
  };
  bool closed = false;
  std::vector<Vec3> points;
  std::vector<Corner> corners;
  std::vector<std::unique_ptr<SpaceCourse>> parts;
};
struct ReadChain {
  std::unique_ptr<SpaceChainFile> chain;
  std::string fault;  ///< empty: it could be read
};
ReadChain read_chain(const Json& json);
/// Its parts, their points, and how they meet.
void check_chain(const SpaceChainFile& chain, const Json& json, Sheet& sheet);
/// The points that were given.
void check_chain_input(const SpaceChainFile& chain, const std::vector<Vec3>& points, Sheet& sheet);

/// The direction that was asked for; the points that were given.
void check_space_input(const SpaceCourse& curve, const std::vector<Vec3>& points,
                       const std::optional<Vec3>& along, Sheet& sheet);
/// The printed report of `fit`.
void check_space_text(const SpaceCourse& curve, const Json& json, const std::string& text,
                      Sheet& sheet);
/// `.csv`: s, x, y, z, curvature, torsion at equal steps; `.sldcrv`: x y z.
void check_space_samples(const SpaceCourse& curve, const std::string& text, std::size_t count,
                         bool points_only, Sheet& sheet);
/// Splines of a file in the order in which they stand there; of STEP in its own unit.
std::vector<SpaceNurbs> dxf_curves(const std::string& text);
std::vector<SpaceNurbs> step_curves(const std::string& text);
/// They are these curves, number for number as far as places say.
void check_space_curves(const std::vector<const SpaceNurbs*>& curves,
                        const std::vector<SpaceNurbs>& found, const std::string& name,
                        const std::string& claim, Sheet& sheet);
/// The splines of a DXF file: one, the NURBS curve.
void check_space_spline(const SpaceNurbs& nurbs, const std::string& name, const std::string& text,
                        const std::string& claim, Sheet& sheet);

/// What was given to `nurbs`.
struct NurbsInput {
  std::vector<Vec3> points;  ///< row after row
  std::vector<Real> weights;
  std::size_t rows = 1;
  int degree = 3, degree_v = 3;
  std::vector<Real> knots, knots_v;                    ///< empty: uniform
  std::vector<std::pair<std::size_t, Real>> at, move;  ///< from 0: its weight, part of the way
};
void check_nurbs(const Json& json, const NurbsInput& input, Sheet& sheet);
void check_nurbs_samples(const Json& json, const std::string& text, std::size_t count,
                         Sheet& sheet);

/// What was given to `spline` of two variables: places of a grid, in any order.
struct GridInput {
  struct Place {
    Real x = 0.0L, y = 0.0L, f = 0.0L, cell = 0.0L, along_x = 0.0L, along_y = 0.0L;
  };
  std::vector<Place> places;
  bool cells = false, lines = false, smooth = false;
  std::vector<Place> finer;  ///< x, y, f
};
void check_grid_spline(const Json& json, const GridInput& input, Sheet& sheet);
void check_grid_samples(const Json& json, const std::string& text, std::size_t count, Sheet& sheet);

/// Rows of a table with one line of names, cells parted by commas; an empty cell is none.
std::vector<std::vector<std::optional<Real>>> csv_rows(const std::string& text, std::string& names);

}  // namespace judge
