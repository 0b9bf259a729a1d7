// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "audit_report.h"
#include "commands.h"
#include "obvid/pipeline/analyse.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/internal/report_json.h"
#include "series_report.h"
#include "terminal.h"

namespace obvid {

int run(const AnalyseOptions& options) {
  if (is_drawing(options.input)) return audit_drawing(options);
  if (!options.outputs.empty()) {
    return report({ErrorCode::kBadOption, "points alone make no picture of a curve",
                   options.outputs.front(), "use `obvid fit POINTS -o NAME.svg`"});
  }
  Result<PointSeries> series = read_series(options.input, options.import);
  if (!series) return report(series.error());
  if (options.units) take_units(*series, *options.units);
  const Result<Analysis> analysis = analyse(series->points);
  if (!analysis) {
    warn(series->warnings);
    return report(analysis.error());
  }
  add_rounding_warning(*series, *analysis);
  warn(series->warnings);
  const std::string text = options.json ? series_report_json(*series, *analysis)
                                        : series_report_text(*series, *analysis);
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
