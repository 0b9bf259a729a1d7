// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/core/units.h"
#include "obvid/io/internal/read_columns.h"
#include "obvid/surface/nurbs_surface.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// Control points as a table has them.
struct ControlTable {
  std::string name;
  std::size_t rows = 1;         ///< 1: of a curve
  std::vector<Vec3> points;     ///< row after row
  std::vector<double> weights;  ///< one per point
  bool spatial = false;         ///< the table has z
};

/// Columns x, y, and z and w where there are any; `row` and `col` (any numbers, in any order) make
/// a net of a surface. Without a header the columns are x, y, z, w, as many as there are. Errors:
/// E201 columns that are missing, E305, E307 a net with gaps.
[[nodiscard]] Result<ControlTable> control_table(const ColumnTable& table, const std::string& name);
/// The same of a file; "-" is standard input.
[[nodiscard]] Result<ControlTable> read_control_table(const std::string& path);

struct NurbsJob {
  int degree = 3, degree_v = 3;        ///< along a row; from row to row. Less with few points
  std::vector<double> knots, knots_v;  ///< empty: uniform, clamped
  std::vector<std::pair<std::size_t, double>> weights{};  ///< of a curve: point from 0, its weight
  std::vector<std::pair<std::size_t, double>> moves{};    ///< point, part b of the way from B to it
};

/// What the weight of one control point does to a curve ([004], formulas (7), (8)): at the
/// parameter where its basis function is greatest the curve passes B without the point, N with
/// weight 1, and `now` with its weight w; all lie on the line from B to the point P:
/// N = (1 - a) B + a P, now = (1 - b) B + b P, w = ((1 - a) / a) : ((1 - b) / b).
struct WeightRow {
  std::size_t point = 0;
  double weight = 1.0;
  double u = 0.0;
  Vec3 without, even, now;  ///< B, N and the curve's own
  double a = 0.0, b = 0.0;
  double swing = 0.0;  ///< distance of B from P, units: how far the weight can move the curve there
};

struct NurbsReport {
  ControlTable table;  ///< with the weights that were asked for
  std::variant<SpaceCurve, NurbsSurface> shape;
  std::vector<WeightRow> rows;  ///< of a curve, one per control point
};

/// Errors: E203 points that do not exist, weights and parts out of range, weights of a surface by
/// options; those of `check` for knots and degrees; E103, asked for each control point.
[[nodiscard]] Result<NurbsReport> nurbs_report(ControlTable table, const NurbsJob& job,
                                               const RunContext& run = {});

/// Everything as JSON: degrees, knots, points, weights and the rows.
[[nodiscard]] std::string nurbs_json(const NurbsReport& report);
/// A net as a model of one patch; of a curve nothing.
[[nodiscard]] std::optional<SurfaceModel> nurbs_surface(const NurbsReport& report,
                                                        const Units& units);
/// The curve in the format that the ending of `path` tells: .json, .csv (`samples` points), .dxf,
/// .step, .iges, .brep. Errors: E202 no such format of a curve, or a net; E103; those of the
/// formats.
[[nodiscard]] Result<std::string> nurbs_file(const NurbsReport& report, const std::string& path,
                                             const Units& units, std::size_t samples,
                                             const RunContext& run = {});
/// u, x, y, z, curvature at `count` equal steps of the parameter of a curve.
[[nodiscard]] std::string nurbs_samples_csv(const SpaceCurve& curve, std::size_t count);

}  // namespace obvid
