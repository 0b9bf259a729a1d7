// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "obvid/core/files.h"
#include "obvid/core/internal/name_pattern.h"
#include "obvid/pipeline/file_formats.h"
#include "obvid/pipeline/surface_cut_job.h"
#include "obvid/pipeline/surface_job.h"
#include "outputs.h"
#include "surface_options.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

bool is_of_branches(const std::string& path) { return has_place(path, kPlaceOfId); }

Result<void> check_outputs_of(const SurfaceCutOptions& options) {
  OBVID_TRY(check_outputs(options.outputs, {&options.input, 1}));
  for (const std::string& path : options.outputs) {
    if (!is_of_branches(path)) {
      if (!sections_format_of(path)) return fail(of_file(no_such_sections(), path));
    } else if (options.job.fair) {
      const auto of_contour = output_of(path);
      OBVID_TRY(of_contour);
      OBVID_TRY(can_write_all({path}));
    } else {
      OBVID_TRY(branch_format_of(path, false));
    }
  }
  return {};
}

/// Files of single branches: their points, or their contours.
Result<void> add_branches(const MadeSurfaceCut& made, const std::string& path,
                          std::vector<Output>& files, FileNotes& notes) {
  for (const BranchPlace& place : branches_of(made)) {
    const std::string name = filled(path, {{kPlaceOfId, place.id}});
    const auto format = format_of(name).value_or(FileFormat::kSamples);
    auto texts = named_files({name, format, {}}, branch_file(made, place, format), notes);
    OBVID_TRY(texts);
    files.insert(files.end(), texts->begin(), texts->end());
  }
  return {};
}

Result<std::vector<Output>> files_of(const SurfaceCutOptions& options, const MadeSurfaceCut& made,
                                     FileNotes& notes) {
  std::vector<Output> files;
  const std::string title = std::filesystem::path(options.input).stem().string();
  for (const std::string& path : options.outputs) {
    if (is_of_branches(path)) {
      OBVID_TRY(add_branches(made, path, files, notes));
      continue;
    }
    auto text = sections_file(*sections_format_of(path), made, title);
    OBVID_TRY(text);
    files.push_back({path, {}, std::move(*text)});
  }
  return files;
}

std::string faired_text(const MadeSection& section) {
  std::size_t proved = 0;
  for (const FairBranch& branch : section.fair) proved += branch.proved ? 1 : 0;
  return fmt::format("{} of {}", proved, section.fair.size());
}

/// "12.5 m^3, last step 3e-12"
std::string figure_text(const MeasuredFigure& figure, const std::string& unit, int power,
                        bool trimmed) {
  if (std::isnan(figure.value)) return "none";
  return fmt::format("{} {}{}, last step{} {}", significant(figure.value, 8), unit,
                     power == 1 ? std::string() : fmt::format("^{}", power),
                     trimmed ? " and trims" : "", significant_above(figure.error, 2));
}

void add_displaced(Facts& facts, const MadeSurfaceCut& made) {
  if (!made.displaced) return;
  const Displaced& d = *made.displaced;
  const std::string unit = made.units.text();
  facts.add("volume", figure_text(d.volume, unit, 3, d.trimmed));
  if (made.displacement) facts.add("displacement", significant(*made.displacement, 8));
  facts.add("centre x", figure_text(d.centre_x, unit, 1, d.trimmed));
  facts.add("centre y", figure_text(d.centre_y, unit, 1, d.trimmed));
  facts.add("centre z", figure_text(d.centre_z, unit, 1, d.trimmed));
  facts.add("wetted", figure_text(d.wetted, unit, 2, d.trimmed));
  facts.add("waterplane", figure_text(d.waterplane, unit, 2, d.trimmed));
  facts.add("its centre x", figure_text(d.plane_x, unit, 1, d.trimmed));
  facts.add("its inertia", figure_text(d.inertia_x, unit, 4, d.trimmed));
}

std::string sections_text(const SurfaceCutOptions& options, const MadeSurfaceCut& made,
                          const Written& written) {
  Table table;
  table.column("section", Table::Align::kLeft);
  table.column("branches");
  table.column("closed");
  table.column("points");
  table.column("off the\nplane");
  table.column("chords\noff");
  if (options.job.fair) table.column("contours\nproved");
  for (const MadeSection& section : made.sections) {
    std::size_t closed = 0, points = 0;
    double off = 0.0;
    for (const SectionBranch& branch : section.section.branches) {
      closed += branch.closed ? 1 : 0;
      points += branch.points.size();
      off = std::max(off, branch.deviation);
    }
    std::vector<std::string> row = {section.name,
                                    std::to_string(section.section.branches.size()),
                                    std::to_string(closed),
                                    std::to_string(points),
                                    significant_above(section.section.residual, 2),
                                    significant_above(off, 2)};
    if (options.job.fair) row.push_back(faired_text(section));
    table.row(row);
  }
  Facts facts;
  if (!made.sections.empty())
    facts.add("tolerance", fmt::format("{} {} of chords, as measured",
                                       significant(made.tolerance, 3), made.units.text()));
  add_displaced(facts, made);
  for (const std::string& remark : written.remarks) facts.add("note", remark);
  if (!written.files.empty()) facts.add("written", listed(written.files));
  return (made.sections.empty() ? std::string() : table.text() + "\n") + facts.text();
}

struct CutDone {
  MadeSurfaceCut made;
  Written written;
};

Result<CutDone> cut_done(const SurfaceCutOptions& options, ProgressBar& bar) {
  OBVID_TRY(check_outputs_of(options));
  bar.tell("reading", 0.0);
  std::vector<std::string> warnings;
  const auto model = read_surface(options.input, warnings);
  OBVID_TRY(model);
  auto made = cut_surface(*model, options.job, bar.progress());
  OBVID_TRY(made);
  made->warnings.insert(made->warnings.begin(), warnings.begin(), warnings.end());
  bar.tell("writing", 1.0);
  FileNotes notes;
  const auto files = files_of(options, *made, notes);
  OBVID_TRY(files);
  auto names = write_files(*files, options.input);
  OBVID_TRY(names);
  made->warnings.insert(made->warnings.end(), notes.warnings.begin(), notes.warnings.end());
  return CutDone{std::move(*made), {std::move(*names), std::move(notes.remarks)}};
}

}  // namespace

int run(const SurfaceCutOptions& options) {
  ProgressBar bar(options.progress);
  const auto done = cut_done(options, bar);
  bar.clear();
  if (!done) return report(done.error());
  warn(done->made.warnings);
  std::string text;
  if (options.json) {
    text = surface_cut_json(done->made, done->written, false);
  } else if (options.csv) {
    text = sections_csv(done->made);
  } else if (!options.quiet) {
    text = sections_text(options, done->made, done->written);
  }
  if (auto put_out = put(text); !put_out) return report(put_out.error());
  if (auto failed = not_proved(done->made)) {
    if (!done->written.files.empty()) failed->hint = "the other files were written";
    return report(*failed);
  }
  return 0;
}

}  // namespace obvid
