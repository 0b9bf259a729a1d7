// SPDX-License-Identifier: Apache-2.0
#include "alignment_options.h"
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
#include "obvid/pipeline/internal/fit_figures.h"
#include "obvid/pipeline/internal/page_text.h"
#include "outputs.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr int kOffsetDigits = 3;

void add_profile_facts(const ProfileReport& report, const Units& units, Facts& facts) {
  const VerticalProfile& profile = report.profile;
  std::array<std::size_t, 3> count{};
  for (const auto& e : profile.elements) ++count[static_cast<std::size_t>(e.kind)];
  facts.add("profile",
            fmt::format("{}: {}, {}, {}", counted(profile.elements.size(), "element", "elements"),
                        counted(count[0], "grade", "grades"), counted(count[1], "crest", "crests"),
                        counted(count[2], "sag", "sags")));
  if (report.of_file) return;
  double largest = 0.0;
  for (const double offset : profile.offsets) largest = std::max(largest, std::abs(offset));
  facts.add("heights", fmt::format("{}, at most {} {} off (tolerance {}), root mean square {}",
                                   counted(profile.offsets.size(), "height", "heights"),
                                   significant(largest, kOffsetDigits), units.text(),
                                   significant(report.tolerance, kOffsetDigits),
                                   significant(profile.rms, kOffsetDigits)));
}

Facts alignment_facts(const AlignmentReport& report) {
  const Alignment& alignment = report.alignment;
  double largest = 0.0;
  for (const auto& d : alignment.deviations) largest = std::max(largest, std::abs(d.offset));
  Facts facts;
  facts.add("alignment",
            fmt::format("{}: {}", counted(alignment.elements.size(), "element", "elements"),
                        kinds_text(alignment)));
  facts.add("length", known_length(alignment.length, report.units.text()) +
                          (alignment.closed ? ", closed" : ""));
  const std::size_t joints = alignment.elements.size() - (alignment.closed ? 0 : 1);
  facts.add("curvature", fmt::format("steps at {} of {}", curvature_steps(alignment.elements),
                                     counted(joints, "joint", "joints")));
  facts.add("points", fmt::format("{}, at most {} {} off (tolerance {}), root mean square {}",
                                  counted(alignment.deviations.size(), "point", "points"),
                                  significant(largest, kOffsetDigits), report.units.text(),
                                  significant(report.tolerance, kOffsetDigits),
                                  significant(alignment.rms, kOffsetDigits)));
  if (report.profile) add_profile_facts(*report.profile, report.units, facts);
  for (const std::string& remark : report.remarks) facts.add("note", remark);
  return facts;
}

std::string alignment_text(const AlignmentReport& report, const std::vector<std::string>& remarks,
                           const std::vector<std::string>& files) {
  const Alignment& alignment = report.alignment;
  Facts facts = alignment_facts(report);
  for (const std::string& remark : remarks) facts.add("note", remark);
  if (!files.empty()) facts.add("written", listed(files));
  return bold(report.name) + "\n" +
         elements_text(alignment.elements, std::max(alignment.length, report.tolerance),
                       report.limit) +
         "\n" +
         (report.profile ? profile_text(report.profile->profile,
                                        std::max(alignment.length, report.profile->tolerance)) +
                               "\n"
                         : "") +
         facts.text();
}

/// What a page says besides: what was asked for, and what reading warned of.
struct AlignmentTold {
  std::string asked;
  std::vector<std::string> warnings;
};

std::string alignment_page(const AlignmentReport& report, const AlignmentTold& told) {
  ReportPage page;
  page.title = report.name;
  page.verdict = alignment_verdict(report);
  page.pictures.push_back(alignment_picture(report));
  page.figures = {{"asked for", told.asked}, {"lengths in", report.units.text()}};
  const Facts facts = alignment_facts(report);
  page.figures.insert(page.figures.end(), facts.lines().begin(), facts.lines().end());
  page.warnings = told.warnings;
  page.tables.push_back(
      table_of_page("elements", "Elements", element_rows(report.alignment.elements, report.limit)));
  if (report.profile) {
    page.tables.push_back(
        table_of_page("profile", "Profile", profile_rows(report.profile->profile)));
  }
  page.tables.push_back(table_of_page("deviations", "Points", deviation_rows(report)));
  return page_text(page);
}

/// What the formats of contours do not write for it.
std::optional<std::string> own_text(const std::string& path, const AlignmentReport& report,
                                    const AlignmentTold& told) {
  const FileFormat format = format_of(path).value_or(FileFormat::kContour);
  if (format == FileFormat::kPage) return alignment_page(report, told);
  return alignment_file(format, report);
}

}  // namespace

int run(const AlignmentCommand& command) {
  std::vector<std::string> names = command.outputs;
  for (const std::string& table : {command.deviations, command.profile_table}) {
    if (!table.empty()) names.push_back(table);
  }
  std::vector<std::string> inputs = {command.input};
  if (!command.heights.empty()) inputs.push_back(command.heights);
  if (auto free = check_outputs(names, inputs); !free) return report(free.error());
  Result<std::vector<Output>> outputs = outputs_of(command.outputs, command.input);
  if (!outputs) return report(outputs.error());
  Result<RoadSeries> read = read_road(command.input, with_heights(command.import));
  if (!read) return report(read.error());
  PointSeries& series = read->points;
  if (command.units) take_units(series, *command.units);
  AlignmentJob job = command.job;
  job.road = std::move(read->road);
  AlignmentTold told{command.asked, {}};
  if (!command.heights.empty()) {
    auto heights = read_heights(command.heights);
    if (!heights) return report(heights.error());
    job.heights = std::move(*heights);
  }
  ProgressBar bar(command.progress);
  const auto made = alignment_report(series, job, bar.progress());
  bar.clear();
  if (!made) {
    warn(warnings_of_reading(series, job));
    return report(made.error());
  }
  const TitledContour contour = titled_contour(*made, series, job, command.input);
  told.warnings = contour.warnings;
  warn(told.warnings);
  if (!command.profile_table.empty() && !made->profile) {
    return report({ErrorCode::kBadOption, "there is no profile to be written", "--profile-table",
                   "give heights in a column z, or a file of them by --profile"});
  }
  ExportOptions formats;
  set_titles(contour, {}, formats);
  std::vector<Output> drawn, own;
  for (Output& output : *outputs) {
    auto text = own_text(output.path, *made, told);
    if (text) output.text = std::move(*text);
    (text ? own : drawn).push_back(std::move(output));
  }
  FileNotes notes;
  auto texts = exported(drawn, contour.stored, formats, notes);
  if (!texts) return report(texts.error());
  for (Output& output : own) texts->push_back(std::move(output));
  if (!command.deviations.empty()) {
    texts->push_back({command.deviations, FileFormat::kSamples, csv_text(deviation_rows(*made))});
  }
  if (!command.profile_table.empty()) {
    texts->push_back({command.profile_table, FileFormat::kSamples,
                      csv_text(profile_rows(made->profile->profile))});
  }
  warn(notes.warnings);
  const auto written = write_files(*texts, command.input);
  if (!written) return report(written.error());
  std::string text;
  if (command.json) {
    text = alignment_json(*made);
  } else if (!command.quiet) {
    text = alignment_text(*made, notes.remarks, *written);
  }
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
