// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "obvid/core/internal/data_table.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/pipeline/analyse.h"
#include "obvid/pipeline/compare.h"
#include "obvid/pipeline/cut_job.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/internal/fit_figures.h"
#include "obvid/pipeline/internal/refusal.h"
#include "obvid/pipeline/trade_off.h"

namespace obvid {

// What a job found, as one of the files that are written of it; the report page, which says what
// was asked for, is its front end's. Errors: E202 for formats that hold no such thing, with those
// that do; E103.

/// "proved", "NOT proved", or "not monotone" of a carrier that does not promise to be.
[[nodiscard]] std::string carrier_verdict(const ComparedCarrier& row);
/// A row for each carrier; one that is refused has its code in place of a verdict.
[[nodiscard]] DataTable carrier_rows(const Comparison& compared);
/// .svg (carriers side by side), .csv and .json (tables).
[[nodiscard]] Result<std::string> comparison_file(FileFormat format, const PointSeries& series,
                                                  const Comparison& compared,
                                                  const ShownCurvatures& shown = {});

/// .csv and .json (tables); points alone make no picture of a curve (E203).
[[nodiscard]] Result<std::string> analysis_file(FileFormat format, const AnalysedSeries& points,
                                                const RunContext& run = {});
/// The curve that the picture of a drawing shows: the one that was asked for, else the longest.
/// Nothing where there are only points.
[[nodiscard]] const CurveAudit* pictured_curve(const AnalysedDrawing& analysed);
/// .svg (that curve), .csv and .json (tables of all). Error: E203, a picture of points alone.
[[nodiscard]] Result<std::string> analysis_file(FileFormat format, const AnalysedDrawing& analysed,
                                                const PicturePlots& plots = {},
                                                const RunContext& run = {});

/// .svg (vertices over tolerances) and .json (table).
[[nodiscard]] Result<std::string> suggestion_file(FileFormat format, const TradeOff& found,
                                                  const std::vector<std::string>& warnings);

/// .svg: the nearest contour that there is, with what would have to move. Error: E401 where none is
/// known.
[[nodiscard]] Result<std::string> refusal_file(FileFormat format, const Refusal& refusal,
                                               const std::string& name, const RunContext& run = {});

/// What pages are called, and what they say was asked for; empty: nothing.
struct ReportTitles {
  std::string title;
  std::string asked{};
};

/// "line", "arc", "bezier", "clothoid".
[[nodiscard]] const char* piece_type(const Piece& piece);
/// What is wrong with a piece, as a figure for choosing rows: the undecided come first. From 2 on
/// the parameters in question are told.
[[nodiscard]] double proof_trouble(const PieceProof& proof);
/// A row for each piece.
[[nodiscard]] DataTable proof_rows(const Contour& contour, const Certificate& certificate);
/// The claims of a file beside what was found now.
[[nodiscard]] FigureRows verification_figures(const StoredContour& stored,
                                              const Verification& found);
[[nodiscard]] std::string verification_verdict(const StoredContour& stored,
                                               const Verification& found);
/// .json, .csv (table of pieces) and .html (page). Error: E202.
[[nodiscard]] Result<std::string> verification_file(FileFormat format, const StoredContour& stored,
                                                    const Verification& found,
                                                    const ReportTitles& titles,
                                                    const RunContext& run = {});
/// E202: which files there are of it.
[[nodiscard]] Error no_such_answer();

/// .nc (the program), .svg and .dxf (drawings of the paths), .csv (table of outlines).
[[nodiscard]] Result<std::string> cut_file(FileFormat format, const MadeCut& made,
                                           const CutJob& job, const RunContext& run = {});

}  // namespace obvid
