// SPDX-License-Identifier: Apache-2.0
#include "suggest.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "interrupt.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/internal/job_files.h"
#include "obvid/pipeline/internal/report_json.h"
#include "obvid/pipeline/trade_off.h"
#include "outputs.h"
#include "series_of.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr int kSuggestedDigits = 3;
constexpr double kMilli = 1e3;  // s to ms

Result<std::vector<Output>> charts_of(const FitOptions& options) {
  Result<std::vector<Output>> outputs = outputs_of(options.outputs, options.input);
  if (!outputs) return outputs;
  for (const Output& output : *outputs) {
    if (output.format == FileFormat::kPicture) continue;
    return error(ErrorCode::kBadOption, "--suggest forms no contour to be stored")
        .where(output.path)
        .hint("name an .svg for the chart, or use --json");
  }
  return outputs;
}

std::string rows_text(const TradeOff& t) {
  Table table;
  table.column("tolerance");
  table.column("vertices");
  table.column("lower\nbound");
  table.column("inflections");
  table.column("pieces");
  table.column("largest\nmove");
  table.column("time\nms");
  table.column("option of fit", Table::Align::kLeft);
  table.column("proved", Table::Align::kLeft);
  for (std::size_t i = 0; i < t.rows.size(); ++i) {
    const TradeOffRow& row = t.rows[i];
    const std::string tolerance = significant(row.tolerance, kSuggestedDigits);
    if (!row.formed) {
      table.row({tolerance, "-", "-", "-", "-", "-", "-", "-", "no: " + row.refusal});
      continue;
    }
    table.row({tolerance, std::to_string(row.vertices), std::to_string(row.vertices_lower_bound),
               std::to_string(row.inflections), std::to_string(row.pieces),
               significant(row.largest_move, kSuggestedDigits),
               fmt::format("{:.1f}", kMilli * row.seconds), row.option,
               row.carried && row.proved ? "yes, as the row before"
               : row.proved              ? "yes"
               : row.kept                ? "no, nor promised"
                                         : "no: " + row.refusal});
  }
  return table.text();
}

std::string recommendation(const TradeOff& t) {
  if (!t.recommended) return fmt::format("No tolerance gave a {}.\n", kept_contour(t));
  const TradeOffRow& row = t.rows[*t.recommended];
  return fmt::format("Recommended: {} ({}, moves up to {} {})\nRule: {}.\n", row.option,
                     counted(static_cast<std::size_t>(row.vertices), "vertex", "vertices"),
                     significant(row.largest_move, kSuggestedDigits), t.units.text(),
                     trade_off_rule(t));
}

std::string suggestion_text(const TradeOff& t, const std::vector<std::string>& written) {
  std::string text;
  if (!t.name.empty()) text += bold(t.name) + "\n";
  text += fmt::format("one tolerance for every point; lengths in {}\n\n", t.units.text());
  text += rows_text(t) +
          "lower bound: vertices of every curve that does not wind between the points\n\n";
  text += recommendation(t);
  if (!written.empty()) text += fmt::format("written  {}\n", listed(written));
  return text;
}

}  // namespace

int suggest(const FitOptions& options) {
  Result<std::vector<Output>> charts = charts_of(options);
  if (!charts) return report(charts.error());
  ProgressBar bar(options.progress && !options.quiet);
  bar.tell("reading", 0.0);
  const Result<PointSeries> series = series_of(options);
  TradeOff finished;
  const Result<TradeOff> found = series.and_then([&](const PointSeries& s) {
    const Interrupt interrupt;
    const RunContext context(bar.progress(), [&interrupt] { return interrupt.asked(); });
    return trade_off(s, options.job, context, &finished);
  });
  if (!found) {
    bar.clear();
    if (!finished.rows.empty()) {
      if (auto done = put(rows_text(finished)); !done) return report(done.error());
    }
    return report(found.error());
  }
  for (Output& chart : *charts) {
    auto text = suggestion_file(chart.format, *found, series->warnings);
    if (!text) return report(text.error());
    chart.text = std::move(*text);
  }
  const Result<std::vector<std::string>> written = write_files(*charts, options.input);
  bar.clear();
  if (!written) return report(written.error());
  warn(series->warnings);
  std::string text;
  if (options.json) {
    text = trade_off_json(*found, series->warnings, *written);
  } else if (!options.quiet) {
    text = suggestion_text(*found, *written);
  }
  if (auto done = put(text); !done) return report(done.error());
  if (const auto failed = not_kept(*found)) return report(*failed);
  return 0;
}

}  // namespace obvid
