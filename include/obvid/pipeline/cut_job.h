// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/internal/data_table.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/cutting/cutting.h"
#include "obvid/exchange/drawing.h"
#include "obvid/exchange/internal/sketch.h"
#include "obvid/pipeline/import.h"

namespace obvid {

/// Cutting as it is asked for. What is not given in `plan` is so many millimetres of the drawing.
struct CutJob {
  CutOptions plan;                  ///< but for what follows
  std::optional<double> tolerance;  ///< [0.01 mm]
  std::optional<Units> units;       ///< [as the drawings say]
};

struct MadeCut {
  CutProgram program;
  std::vector<CutOutline> outlines;
  std::vector<std::size_t> curves;  ///< of each outline: number in its drawing, from 0
  Units units;
  std::size_t left_out = 0;  ///< entities of the drawings that would be curves, not read as drawn,
                             ///< where no curves were chosen
  double tolerance = 0.0;    ///< of the program, units; curves are drawn within it
  std::vector<std::string> remarks;  ///< what was taken from the drawings
  std::vector<std::string> warnings;
};

/// Curves of drawings as outlines: all of them, or those that `options` choose. Polylines are cut
/// along their edges, whatever their vertices look like, splines of points alone as
/// `spline_through` has them, with a warning that names them; points that nothing joins only where
/// `options.use` is exact. Errors: those of `drawn_contour` and `spline_through`; E310 drawings of
/// different units, points that were chosen; E311 no curve at all.
[[nodiscard]] Result<MadeCut> make_cut(std::vector<Drawing> drawings, const ImportOptions& options,
                                       const CutJob& job, const RunContext& run = {});

/// Of its lengths: that of the drawings, or the one that is assumed for them.
[[nodiscard]] std::string unit_of_program(const MadeCut& made);

/// E504 where a curve of the drawings is not in the program.
[[nodiscard]] std::optional<Error> not_cut(const MadeCut& made);

/// Outlines, the way of the tool with its width, rapid moves, and the order: for .svg and .dxf.
[[nodiscard]] Sketch cut_sketch(const MadeCut& made, const CutJob& job);

/// {"outlines": [...], "report": {...}, "left_out", "warnings"}: docs/schema/cut.schema.json.
[[nodiscard]] std::string cut_json(const MadeCut& made);

/// A row for each outline that is cut, in the order of the program, with all digits.
[[nodiscard]] DataTable cut_rows(const MadeCut& made);

/// Names as they are typed. Errors: E203.
struct CutValues {
  std::optional<std::string> side, direction, controller, motion, start;
  std::optional<double> laser, plasma;  ///< power; seconds to pierce
  std::optional<long> passes, tabs, decimals;
};
[[nodiscard]] Result<void> set_cut(const CutValues& typed, CutJob& job);

}  // namespace obvid
