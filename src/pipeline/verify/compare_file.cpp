// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "obvid/pipeline/internal/job_files.h"
#include "obvid/pipeline/internal/no_such_file.h"
#include "obvid/pipeline/internal/report_json.h"
#include "obvid/pipeline/internal/summary.h"

namespace obvid {

std::string carrier_verdict(const ComparedCarrier& row) {
  if (row.fit.certificate.proved) return "proved";
  return keeps_promise(row.carrier, row.fit.certificate) ? "not monotone" : "NOT proved";
}

DataTable carrier_rows(const Comparison& compared) {
  DataTable out{heads_of(
      "carrier,pieces,control_points,continuity,vertices,inflections,error_bound,deviation,"
      "outside,seconds,verdict")};
  for (const ComparedCarrier& row : compared.carriers) {
    DataRow& cells = out.rows.emplace_back(DataRow{to_string(row.carrier)});
    if (row.refusal) {
      cells.resize(out.heads.size() - 1);
      cells.emplace_back(code_text(*row.refusal));
      continue;
    }
    const Certificate& certificate = row.fit.certificate;
    const DataRow figures = {row.fit.contour.pieces.size(),
                             row.control_points == 0 ? DataCell() : DataCell(row.control_points),
                             continuity_name(row),
                             certificate.vertices,
                             certificate.inflections,
                             finite_cell(row.fit.report.largest_deviation),
                             row.fit.report.carrier_deviation,
                             row.fit.report.outside_spirals_region,
                             row.seconds,
                             carrier_verdict(row)};
    cells.insert(cells.end(), figures.begin(), figures.end());
  }
  return out;
}

Result<std::string> comparison_file(FileFormat format, const PointSeries& series,
                                    const Comparison& compared, const ShownCurvatures& shown) {
  switch (format) {
    case FileFormat::kPicture:
      return comparison_svg(series, compared, shown);
    case FileFormat::kContour:
      return comparison_json(series, compared);
    case FileFormat::kSamples:
      return csv_text(carrier_rows(compared));
    default:
      return no_such_file("a comparison", ".svg (picture), .csv and .json (tables)");
  }
}

}  // namespace obvid
