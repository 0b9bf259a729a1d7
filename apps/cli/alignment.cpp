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
#include "obvid/core/internal/figures.h"
#include "obvid/pipeline/element_table.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/internal/fit_figures.h"
#include "obvid/pipeline/internal/job_values.h"
#include "obvid/pipeline/internal/page_text.h"
#include "obvid/pipeline/internal/summary.h"
#include "outputs.h"
#include "several.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr int kOffsetDigits = 3;

/// The largest offset, never less than it is, beside its tolerance: with the digits that it takes
/// to see on which side of that it lies.
std::string offset_of_tolerance(double offset, double tolerance, const std::string& unit) {
  constexpr int kMostDigits = 9;
  const std::string limit = tolerance_text(tolerance);
  std::string text = "0";
  for (int digits = kOffsetDigits; offset > 0.0 && digits <= kMostDigits; ++digits) {
    text = significant_above(offset, digits);
    if (std::stod(text) <= std::stod(limit)) break;
  }
  return fmt::format("at most {} {} off (tolerance {})", text, unit, limit);
}

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
  facts.add("heights", fmt::format("{}, {}, root mean square {}",
                                   counted(profile.offsets.size(), "height", "heights"),
                                   offset_of_tolerance(largest, report.tolerance, units.text()),
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
  facts.add("points",
            fmt::format("{}, {}, root mean square {}",
                        counted(alignment.deviations.size(), "point", "points"),
                        offset_of_tolerance(largest, report.tolerance, report.units.text()),
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

/// What was formed and written.
struct AlignmentDone {
  AlignmentReport made;
  std::vector<std::string> remarks;
  std::vector<std::string> files;
};

/// The files of an alignment: those of contours, those of alignments alone, and tables.
Result<std::vector<Output>> alignment_outputs(const AlignmentCommand& command,
                                              const AlignmentReport& made,
                                              const TitledContour& contour, FileNotes& notes) {
  Result<std::vector<Output>> outputs = outputs_of(command.outputs, command.input);
  OBVID_TRY(outputs);
  if (!command.profile_table.empty() && !made.profile) {
    return fail(bad_option("there is no profile to be written", "--profile-table",
                           "give heights in a column z, or a file of them by --profile"));
  }
  ExportOptions formats;
  set_titles(contour, {}, formats);
  std::vector<Output> drawn, own;
  for (Output& output : *outputs) {
    auto text = own_text(output.path, made, {command.asked, contour.warnings});
    if (text) output.text = std::move(*text);
    (text ? own : drawn).push_back(std::move(output));
  }
  auto texts = exported(drawn, contour.stored, formats, notes);
  OBVID_TRY(texts);
  for (Output& output : own) texts->push_back(std::move(output));
  if (!command.deviations.empty()) {
    texts->push_back({command.deviations, FileFormat::kSamples, csv_text(deviation_rows(made))});
  }
  if (!command.profile_table.empty()) {
    texts->push_back({command.profile_table, FileFormat::kSamples,
                      csv_text(profile_rows(made.profile->profile))});
  }
  return texts;
}

/// Reads, forms and writes; what there is to warn of is in `warnings` whatever comes of it.
Result<AlignmentDone> aligned(const AlignmentCommand& command, const Progress& progress,
                              std::vector<std::string>& warnings) {
  Result<RoadSeries> read =
      read_road(command.input, in_units(with_heights(command.import), command.units));
  OBVID_TRY(read);
  PointSeries& series = read->points;
  AlignmentJob job = command.job;
  job.road = std::move(read->road);
  if (!command.heights.empty()) {
    auto heights = read_heights(command.heights);
    OBVID_TRY(heights);
    job.heights = std::move(*heights);
  }
  auto made = alignment_report(series, job, progress);
  if (!made) warnings = warnings_of_reading(series, job);
  OBVID_TRY(made);
  const TitledContour contour = titled_contour(*made, series, job, command.input);
  warnings = contour.warnings;
  FileNotes notes;
  const auto texts = alignment_outputs(command, *made, contour, notes);
  OBVID_TRY(texts);
  warnings.insert(warnings.end(), notes.warnings.begin(), notes.warnings.end());
  auto files = write_files(*texts, command.input);
  OBVID_TRY(files);
  return AlignmentDone{std::move(*made), std::move(notes.remarks), std::move(*files)};
}

/// The command of one of several; `names` are its files, in the order of `alignment_files`.
AlignmentCommand command_of_one(const AlignmentCommand& all, const OneOf& one,
                                std::vector<std::string> names) {
  AlignmentCommand out = options_of_one(all, one);
  const auto take_last = [&](std::string& table) {
    if (table.empty()) return;
    table = std::move(names.back());
    names.pop_back();
  };
  take_last(out.profile_table);
  take_last(out.deviations);
  out.outputs = std::move(names);
  return out;
}

/// All files that are to be written.
std::vector<std::string> alignment_files(const AlignmentCommand& command) {
  std::vector<std::string> names = command.outputs;
  for (const std::string& table : {command.deviations, command.profile_table}) {
    if (!table.empty()) names.push_back(table);
  }
  return names;
}

Summary summary_of_alignment(const AlignmentCommand& command) {
  Summary out;
  const auto done = aligned(command, {}, out.warnings);
  if (!done) {
    out.error = done.error();
    return out;
  }
  out.cells = summary_cells(done->made);
  out.verdict = "aligned";
  return out;
}

int align_several(const AlignmentCommand& command) {
  return run_each(command, command.import, true, alignment_files(command),
                  [&](const OneOf& one, const std::vector<std::string>& names) {
                    return summary_of_alignment(command_of_one(command, one, names));
                  });
}

}  // namespace

int run(const AlignmentCommand& command) {
  if (are_several(command.inputs, command.import.curve)) return align_several(command);
  std::vector<std::string> inputs = {command.input};
  if (!command.heights.empty()) inputs.push_back(command.heights);
  if (auto free = check_outputs(alignment_files(command), inputs); !free) {
    return report(free.error());
  }
  if (auto known = outputs_of(command.outputs, command.input); !known) {
    return report(known.error());
  }
  ProgressBar bar(command.progress);
  std::vector<std::string> warnings;
  const auto done = aligned(command, bar.progress(), warnings);
  bar.clear();
  warn(warnings);
  if (!done) return report(done.error());
  std::string text;
  if (command.json) {
    text = alignment_json(done->made);
  } else if (command.csv) {
    text = csv_text(element_rows(done->made.alignment.elements, done->made.limit));
  } else if (!command.quiet) {
    text = alignment_text(done->made, done->remarks, done->files);
  }
  if (auto shown = put(text); !shown) return report(shown.error());
  return 0;
}

}  // namespace obvid
