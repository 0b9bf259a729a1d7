// SPDX-License-Identifier: Apache-2.0
#include "refusal.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/files.h"
#include "obvid/pipeline/internal/job_files.h"
#include "obvid/pipeline/internal/refusal.h"
#include "obvid/pipeline/internal/report_json.h"
#include "outputs.h"
#include "table.h"
#include "text.h"

namespace obvid {
namespace {

constexpr std::size_t kMostRows = 12;

std::string moves_table(const WhyNot& why) {
  Table table;
  table.column("point");
  table.column("x");
  table.column("y");
  table.column("move");
  const std::size_t shown = std::min(why.moved.size(), kMostRows);
  for (std::size_t k = 0; k < shown; ++k) {
    const std::size_t i = why.moved[k];
    const Vec2 p = why.fit.contour.points[i];
    table.row({std::to_string(i + 1), significant(p.x), significant(p.y),
               significant(why.fit.report.moves[i], 4)});
  }
  std::string text = table.text();
  if (why.moved.size() > shown) text += fmt::format("... {} more\n", why.moved.size() - shown);
  return text;
}

/// `cubic` and `baseline` promise no proof.
std::string exists_text(const WhyNot& why) {
  return why.fit.certificate.proved ? "exists and is proved" : "exists";
}

std::string points_in_the_way_text(const PointSeries& series, const WhyNot& why) {
  std::string text = fmt::format(
      "points that would have to move, the farthest first; lengths in {}\n\n", series.units.text());
  text += moves_table(why);
  text += fmt::format("\nWithin {} for every point such a contour {}: {}.\n",
                      room_within(why, series.units.text()), exists_text(why),
                      advised_option(why, series));
  if (why.refused > 0.0) {
    text += fmt::format("Within {} {} none was found.\n", significant(why.refused, kAdvisedDigits),
                        series.units.text());
  }
  return text;
}

std::string refusal_text(const PointSeries& series, const WhyNot& why,
                         const std::vector<std::string>& written) {
  std::string text;
  if (!series.name.empty()) text += bold(series.name) + "\n";
  if (why.next_to_nothing) {
    text += fmt::format("No point is in the way. A contour with {} {}: {} {}.\n",
                        counts_of_fit(why.fit), exists_text(why), advised_option(why, series),
                        what_option_does(why.fit));
  } else {
    text += points_in_the_way_text(series, why);
  }
  if (why.stopped) {
    text += "The search ended at its limit of work: a tolerance between them may do as well.\n";
  }
  if (!written.empty()) {
    text +=
        fmt::format("picture of that contour: {}; no other file was written\n", listed(written));
  }
  return text;
}

/// NAME.why-not.svg for each picture: what failed must not look like a success.
Result<std::vector<std::string>> write_refusal_pictures(const FitOptions& options,
                                                        const std::string& name,
                                                        const Refusal& refusal) {
  const Result<std::vector<Output>> asked = outputs_of(options.outputs, options.input);
  OBVID_TRY(asked);
  std::vector<Output> pictures;
  for (const Output& output : *asked) {
    if (output.format != FileFormat::kPicture || is_standard_output(output.path)) continue;
    const auto path = std::filesystem::path(output.path).replace_extension(".why-not.svg");
    Result<Output> picture = output_of(path.string());
    OBVID_TRY(picture);
    auto drawn = refusal_file(FileFormat::kPicture, refusal, name);
    OBVID_TRY(drawn);
    picture->text = std::move(*drawn);
    pictures.push_back(std::move(*picture));
  }
  return write_files(pictures, options.input);
}

}  // namespace

int tell_refusal(const FitOptions& options, const PointSeries& series, const Error& refusal,
                 ProgressBar& bar) {
  const Result<Refusal> explained = explain_refusal(series, options.job, refusal, bar.progress());
  if (!explained) return report(explained.error());
  const auto& [told, why, range] = *explained;
  Result<std::vector<std::string>> written;
  if (why && why->found) written = write_refusal_pictures(options, series.name, *explained);
  bar.clear();
  warn(series.warnings);  // a formed contour carries them itself
  const int code = report(told);
  const std::vector<std::string> names = written ? *written : std::vector<std::string>{};
  if (!written) warn({written.error().what + " (" + written.error().where + ")"});
  std::string text;
  if (options.json) {
    text = refusal_json(told, series, why, range, names);
  } else if (why && why->found && !options.quiet) {
    text = refusal_text(series, *why, names);
  }
  if (auto done = put(text); !done) warn({done.error().what});
  return code;
}

}  // namespace obvid
