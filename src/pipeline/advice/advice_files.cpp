// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>
#include <vector>

#include "obvid/pipeline/internal/job_files.h"
#include "obvid/pipeline/internal/no_such_file.h"
#include "obvid/pipeline/internal/report_json.h"

namespace obvid {

Result<std::string> suggestion_file(FileFormat format, const TradeOff& found,
                                    const std::vector<std::string>& warnings) {
  if (format == FileFormat::kPicture) return trade_off_svg(found);
  if (format == FileFormat::kContour) return trade_off_json(found, warnings, {});
  return no_such_file("a suggestion", ".svg (chart) and .json (table)");
}

Result<std::string> refusal_file(FileFormat format, const Refusal& refusal, const std::string& name,
                                 const RunContext& run) {
  if (format != FileFormat::kPicture) {
    return no_such_file("a refusal", ".svg (the nearest contour that there is)");
  }
  if (!refusal.why || !refusal.why->found) return fail(refusal.error);
  const Fit& nearest = refusal.why->fit;
  ExportOptions titled;
  titled.picture = {name, ""};
  auto drawn = export_contour({nearest.contour, nearest.report, nearest.certificate},
                              FileFormat::kPicture, titled, run);
  OBVID_TRY(drawn);
  return std::move(drawn->files.front().text);
}

}  // namespace obvid
