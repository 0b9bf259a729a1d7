// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/alignment_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "commands.h"
#include "obvid/pipeline/import.h"
#include "outputs.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr int kOffsetDigits = 3;
constexpr int kAzimuthDecimals = 4;

std::string elements_text(const AlignmentReport& report) {
  const Alignment& alignment = report.alignment;
  const double size = std::max(alignment.length, report.tolerance);
  Table table;
  table.column("element");
  table.column("kind", Table::Align::kLeft);
  for (const char* head : {"station", "length", "radius\nat start", "radius\nat end", "A",
                           "azimuth\ndegrees", "\nx", "\ny"}) {
    table.column(head);
  }
  table.column("", Table::Align::kLeft);
  for (std::size_t k = 0; k < alignment.elements.size(); ++k) {
    const AlignmentElement& e = alignment.elements[k];
    const double parameter = clothoid_parameter(e);
    table.row({std::to_string(k + 1), to_string(e.kind), coordinate(e.station, size),
               coordinate(e.length, size), radius_text(e.start.kappa), radius_text(e.kappa1),
               parameter > 0.0 ? significant(parameter, 5) : "-",
               fmt::format("{:.{}f}", azimuth_deg(e.start.theta), kAzimuthDecimals),
               coordinate(e.start.point.x, size), coordinate(e.start.point.y, size),
               e.step ? "curvature steps here" : ""});
  }
  return table.text();
}

std::string alignment_text(const AlignmentReport& report, const std::vector<std::string>& remarks,
                           const std::vector<std::string>& files) {
  const Alignment& alignment = report.alignment;
  std::array<std::size_t, 3> count{};
  double largest = 0.0;
  for (const auto& e : alignment.elements) ++count[static_cast<std::size_t>(e.kind)];
  for (const auto& d : alignment.deviations) largest = std::max(largest, std::abs(d.offset));
  Facts facts;
  facts.add("alignment",
            fmt::format("{}: {}, {}, {}", counted(alignment.elements.size(), "element", "elements"),
                        counted(count[0], "line", "lines"), counted(count[1], "arc", "arcs"),
                        counted(count[2], "clothoid", "clothoids")));
  facts.add("length", known_length(alignment.length, report.units.text()));
  facts.add("curvature", fmt::format("steps at {} of {}", curvature_steps(alignment),
                                     counted(alignment.elements.size() - 1, "joint", "joints")));
  facts.add("points", fmt::format("{}, at most {} {} off (tolerance {}), root mean square {}",
                                  counted(alignment.deviations.size(), "point", "points"),
                                  significant(largest, kOffsetDigits), report.units.text(),
                                  significant(report.tolerance, kOffsetDigits),
                                  significant(alignment.rms, kOffsetDigits)));
  for (const std::string& remark : remarks) facts.add("note", remark);
  if (!files.empty()) facts.add("written", listed(files));
  return bold(report.name) + "\n" + elements_text(report) + "\n" + facts.text();
}

bool is_element_table(const std::string& path) { return format_of(path) == FileFormat::kSamples; }

}  // namespace

int run(const AlignmentCommand& command) {
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
  formats.picture.name = series->name;
  FileNotes notes;
  auto texts = exported(drawn, made->stored, formats, notes);
  if (!texts) return report(texts.error());
  for (Output& output : *outputs) {
    if (!is_element_table(output.path)) continue;
    output.text = alignment_csv(*made);
    texts->push_back(std::move(output));
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
