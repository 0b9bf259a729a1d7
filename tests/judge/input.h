// SPDX-License-Identifier: Apache-2.0
// What the user gave: points, options, and (for made series) the curve behind them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "real_curve.h"

namespace judge {

/// Least and greatest value that do; infinite where there is no end.
struct Ends {
  double least = 0.0, greatest = 0.0;
};

/// Where a range is given twice for one point, what both hold is meant.
void narrow(std::optional<Ends>& range, const std::optional<Ends>& more);

struct GivenPoint {
  Point point;
  std::optional<double> heading, kappa, tolerance;  // rad, 1/unit, unit
  bool corner = false;
  std::optional<Ends> headings, kappas;  // rad, 1/unit
};

/// The curve that the points were taken from.
struct Truth {
  std::function<Vec(Real)> at;
  std::vector<Real> parameters;  ///< of each point, before merging
  int vertices = 0;              ///< of the curve between its ends (around, when closed)
  bool monotone = false;         ///< no vertex at all
  Real largest_turn = 0.0L;      ///< between neighbouring points, rad
};

struct Input {
  std::vector<GivenPoint> points;  ///< repeats merged
  std::string units = "mm", carrier = "spiral";
  std::string construction;  ///< of the papers; empty: none. `carrier` is that of its pieces
  bool units_given = false, units_in_file = false;
  /// What stands behind lengths in texts.
  [[nodiscard]] std::string printed_unit() const {
    return units_given || units_in_file ? units : "units";
  }
  std::string continuity;              ///< asked for; empty: neither
  std::optional<double> corner_angle;  ///< degrees
  bool searches_corners = true;
  std::optional<double> tolerance, noise;
  bool automatic = false;  ///< `noise` is the largest that the scatter of the points allows
  bool placed = false;     ///< scaled, turned, moved or mirrored: to some ulps
  bool rounding = false, closed = false, open = false, convex = false, primitives = false;
  std::optional<Truth> truth;
  std::string fault;  ///< of the reading
};

/// Simple text: x and y, or named columns x, y (x_mm or "x [mm]" with a unit), heading_deg, radius,
/// kappa, tol, corner, and heading_min, heading_max, radius_min, radius_max, kappa_min, kappa_max.
Input read_input(const std::string& text, const std::vector<std::string>& options);

/// How far points may move that scatter as these do (docs/methods/series.md): from and to, because
/// an even number has two medians. `rounding` of each point. None where it cannot be told.
std::optional<Ends> reach_of_scatter(const std::vector<Vec>& points, double rounding);

/// Half a unit of the last decimal that any coordinate of the points shows; 0 where it is behind
/// `most_decimals`.
double rounding_of(const std::vector<GivenPoint>& points, int most_decimals = 15);
/// What points that were scaled, turned or moved may be off: they are rounded a few times.
double rounding_of_places(const Input& input);

/// Options of fit but for those that place the points (`--scale` and its like).
std::vector<std::string> without_placement(const std::vector<std::string>& options);

/// A closed series that names its first point at its end again: both have what is given at either.
void share_closing_point(Input& input);

/// The same points, none with a smaller tolerance of its own (column tol) than this one.
std::string with_tolerances_from(const std::string& text, double tolerance);

/// Options of fit but for those that give a heading (or a bend) at one point, from 1; `points`: how
/// many there are, repeats merged.
std::vector<std::string> without_datum(const std::vector<std::string>& options, bool heading,
                                       std::size_t point, std::size_t points);

}  // namespace judge
