// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/alignment_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "commands.h"
#include "element_table.h"
#include "obvid/core/files.h"
#include "obvid/pipeline/element_table.h"
#include "obvid/pipeline/import.h"
#include "outputs.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr int kOffsetDigits = 3;

/// "4 lines, 3 arcs, 4 clothoids".
std::string kinds_text(const Alignment& alignment) {
  std::array<std::size_t, 3> count{};
  for (const auto& e : alignment.elements) ++count[static_cast<std::size_t>(e.kind)];
  return fmt::format("{}, {}, {}", counted(count[0], "line", "lines"),
                     counted(count[1], "arc", "arcs"), counted(count[2], "clothoid", "clothoids"));
}

/// Below the title of its picture.
std::string picture_verdict(const AlignmentReport& report) {
  return fmt::format("{}; all points within {} {}", kinds_text(report.alignment),
                     significant(report.tolerance, kOffsetDigits), report.units.text());
}

std::string alignment_text(const AlignmentReport& report, const std::vector<std::string>& remarks,
                           const std::vector<std::string>& files) {
  const Alignment& alignment = report.alignment;
  double largest = 0.0;
  for (const auto& d : alignment.deviations) largest = std::max(largest, std::abs(d.offset));
  Facts facts;
  facts.add("alignment",
            fmt::format("{}: {}", counted(alignment.elements.size(), "element", "elements"),
                        kinds_text(alignment)));
  facts.add("length", known_length(alignment.length, report.units.text()));
  facts.add("curvature", fmt::format("steps at {} of {}", curvature_steps(alignment.elements),
                                     counted(alignment.elements.size() - 1, "joint", "joints")));
  facts.add("points", fmt::format("{}, at most {} {} off (tolerance {}), root mean square {}",
                                  counted(alignment.deviations.size(), "point", "points"),
                                  significant(largest, kOffsetDigits), report.units.text(),
                                  significant(report.tolerance, kOffsetDigits),
                                  significant(alignment.rms, kOffsetDigits)));
  for (const std::string& remark : remarks) facts.add("note", remark);
  if (!files.empty()) facts.add("written", listed(files));
  return bold(report.name) + "\n" +
         elements_text(alignment.elements, std::max(alignment.length, report.tolerance),
                       report.limit) +
         "\n" + facts.text();
}

bool is_element_table(const std::string& path) { return format_of(path) == FileFormat::kSamples; }

}  // namespace

int run(const AlignmentCommand& command) {
  std::vector<std::string> names = command.outputs;
  if (!command.deviations.empty()) names.push_back(command.deviations);
  if (auto free = check_outputs(names, {&command.input, 1}); !free) return report(free.error());
  Result<std::vector<Output>> outputs = outputs_of(command.outputs, command.input);
  if (!outputs) return report(outputs.error());
  Result<PointSeries> series = read_series(command.input, command.import);
  if (!series) return report(series.error());
  if (command.units) take_units(*series, *command.units);
  ProgressBar bar(!command.quiet);
  const auto made = alignment_report(*series, command.job, bar.progress());
  bar.clear();
  warn(series->warnings);
  if (!made) return report(made.error());
  std::vector<Output> drawn;
  for (const Output& output : *outputs) {
    if (!is_element_table(output.path)) drawn.push_back(output);
  }
  ExportOptions formats;
  formats.name = series->label.empty() ? series->name : series->label;
  formats.picture = {series->name, picture_verdict(*made)};
  formats.first_station = command.job.first_station;
  FileNotes notes;
  auto texts = exported(drawn, made->stored, formats, notes);
  if (!texts) return report(texts.error());
  for (Output& output : *outputs) {
    if (!is_element_table(output.path)) continue;
    output.text = elements_csv(made->alignment.elements, made->limit);
    texts->push_back(std::move(output));
  }
  if (!command.deviations.empty()) {
    texts->push_back(
        {command.deviations, FileFormat::kSamples, deviations_csv(*made, series->points)});
  }
  warn(notes.warnings);
  const auto written = write_files(*texts, command.input);
  if (!written) return report(written.error());
  std::string text;
  if (command.json) {
    text = alignment_json(*made) + "\n";
  } else if (!command.quiet) {
    text = alignment_text(*made, notes.remarks, *written);
  }
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
