// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <utility>

#include "obvid/core/internal/watch.h"
#include "obvid/pipeline/internal/job_files.h"
#include "obvid/pipeline/internal/no_such_file.h"
#include "obvid/pipeline/internal/report_json.h"

namespace obvid {
namespace {

constexpr const char* kAnalysisFiles = ".svg (picture of a curve), .csv and .json (tables)";

Error no_picture_of_points() {
  return error(ErrorCode::kBadOption, "points alone make no picture of a curve")
      .hint("use `obvid fit POINTS -o NAME.svg`; analyse writes .csv, .json and .html of points");
}

Result<std::string> json_of_points(const AnalysedSeries& points, const RunContext& run) {
  Watch watch(run);
  std::string text = series_report_json(points.series, points.analysis, &watch);
  if (watch.was_cancelled()) return fail(cancelled_error());
  return text;
}

Result<std::string> json_of_drawing(const AnalysedDrawing& analysed, const RunContext& run) {
  std::string points;
  if (analysed.points) {
    auto text = json_of_points(*analysed.points, run);
    OBVID_TRY(text);
    points = std::move(*text);
  }
  return audit_json(analysed.drawing, analysed.audits, points);
}

}  // namespace

Result<std::string> analysis_file(FileFormat format, const AnalysedSeries& points,
                                  const RunContext& run) {
  switch (format) {
    case FileFormat::kPicture:
      return fail(no_picture_of_points());
    case FileFormat::kContour:
      return json_of_points(points, run);
    case FileFormat::kSamples:
      return csv_text(series_rows(points.series, points.analysis));
    default:
      return no_such_file("an analysis", kAnalysisFiles);
  }
}

const CurveAudit* pictured_curve(const AnalysedDrawing& analysed) {
  const std::vector<CurveAudit>& audits = analysed.audits;
  if (audits.empty()) return nullptr;
  if (analysed.asked && *analysed.asked < audits.size()) return &audits[*analysed.asked];
  return &*std::max_element(
      audits.begin(), audits.end(),
      [](const CurveAudit& a, const CurveAudit& b) { return a.length < b.length; });
}

Result<std::string> analysis_file(FileFormat format, const AnalysedDrawing& analysed,
                                  const PicturePlots& plots, const RunContext& run) {
  switch (format) {
    case FileFormat::kContour:
      return json_of_drawing(analysed, run);
    case FileFormat::kSamples:
      return csv_text(drawing_rows(analysed.drawing, analysed.audits));
    case FileFormat::kPicture:
      break;
    default:
      return no_such_file("an analysis", kAnalysisFiles);
  }
  const CurveAudit* curve = pictured_curve(analysed);
  if (curve == nullptr) return fail(no_picture_of_points());
  ExportOptions titled;
  titled.picture = {analysed.drawing.name + ": " + curve->label, as_drawn(*curve)};
  titled.plots = plots;
  auto drawn = export_contour({curve->contour, std::nullopt, curve->certificate},
                              FileFormat::kPicture, titled, run);
  OBVID_TRY(drawn);
  return std::move(drawn->files.front().text);
}

}  // namespace obvid
