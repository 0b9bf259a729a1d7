// SPDX-License-Identifier: Apache-2.0
#include "several.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "obvid/core/files.h"
#include "obvid/core/internal/name_pattern.h"
#include "obvid/pipeline/internal/export_together.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

std::string id_of(const std::string& input) {
  return input == "-" ? "standard-input" : std::filesystem::path(input).stem().string();
}

std::string as_text(const std::string& name, std::size_t width, const Summary& summary) {
  std::string out = name + std::string(width - std::min(width, name.size()), ' ') + "  ";
  for (const SummaryCell& cell : summary.cells) {
    if (!cell.text.empty()) out += cell.text + ", ";
  }
  if (!summary.error) return out + good(summary.verdict) + "\n";
  return out + bad(fmt::format("{}: {}", code_text(*summary.error), summary.error->what)) + "\n";
}

}  // namespace

std::string OneOf::shown() const {
  return curve ? fmt::format("{} curve {}", input, *curve + 1) : input;
}

SummaryForm summary_form(bool csv, bool json, bool quiet) {
  if (json) return SummaryForm::kJson;
  if (csv) return SummaryForm::kCsv;
  return quiet ? SummaryForm::kNothing : SummaryForm::kText;
}

bool are_several(const std::vector<std::string>& inputs, const CurveChoice& curve) {
  return !inputs.empty() || curve.all;
}

Result<std::vector<OneOf>> all_of_them(const std::vector<std::string>& inputs,
                                       const std::string& input, const ImportOptions& import,
                                       bool points) {
  const std::vector<std::string> names = inputs.empty() ? std::vector{input} : inputs;
  std::vector<OneOf> out;
  for (const std::string& name : names) {
    if (!import.curve.all || !is_drawing(name)) {
      out.push_back({name, std::nullopt, id_of(name)});
      continue;
    }
    const auto drawing = read_drawing(name, import.planes);
    OBVID_TRY(drawing);
    const std::size_t curves = drawing->curves.size();
    std::size_t left = 0;
    for (std::size_t i = 0; i < curves + drawing->series.size(); ++i) {
      const bool drawn = i < curves || drawing->series[i - curves].kind != SeriesKind::kWaypoints;
      const bool taken = i < curves || (points && drawn);
      if (drawn && !taken) ++left;
      if (taken) out.push_back({name, i, fmt::format("{}-{}", id_of(name), i + 1)});
    }
    if (left > 0) {
      warn(
          {fmt::format("{}: {} no curve and left out: --drawing exact takes edges, `obvid fit` "
                       "forms contours",
                       name, counted(left, "series of points is", "series of points are"))});
    }
  }
  return out;
}

Result<std::vector<std::string>> outputs_for(const std::vector<std::string>& outputs,
                                             const OneOf& one) {
  std::vector<std::string> out;
  for (const std::string& name : outputs) {
    if (!has_place(name, kPlaceOfId)) {
      return error(ErrorCode::kBadOption, "several contours cannot go to one file")
          .where(name)
          .hint("put {id} into its name, which becomes the name of each input: -o 'fair/{id}.svg'");
    }
    out.push_back(filled(name, {{kPlaceOfId, one.id}}));
  }
  return out;
}

Result<SeveralOutputs> several_outputs(const std::vector<std::string>& outputs,
                                       const ExportOptions& options) {
  SeveralOutputs out;
  for (const std::string& name : outputs) {
    if (has_place(name, kPlaceOfId)) {
      out.each.push_back(name);
      continue;
    }
    auto output = output_of(name);
    OBVID_TRY(output);
    if (auto able = can_export_together(output->format, options); !able) {
      Error error = able.error();
      if (error.where.empty()) error.where = name;
      return fail(std::move(error));
    }
    out.together.push_back(std::move(*output));
  }
  return out;
}

void name_for_all(const OneOf& one, TitledContour& contour) {
  if (!contour.stored.name.empty()) contour.name = contour.stored.name;
  if (contour.name == TitledContour{}.name) contour.name = one.id;
}

Result<std::vector<std::string>> write_together(const std::vector<TitledContour>& contours,
                                                const std::vector<Output>& outputs,
                                                const ExportOptions& options) {
  std::vector<std::string> lines;
  if (contours.empty()) return lines;  // each has said why
  std::vector<Output> files;
  FileNotes notes;
  for (const Output& output : outputs) {
    auto made = named_files(output, export_together(contours, output.format, options), notes);
    OBVID_TRY(made);
    std::move(made->begin(), made->end(), std::back_inserter(files));
  }
  const auto written = write_files(files);
  OBVID_TRY(written);
  warn(notes.warnings);
  lines = std::move(notes.remarks);
  lines.push_back("written  " + listed(*written));
  return lines;
}

std::optional<Error> Several::check(const SeveralOutputs& outputs) const {
  std::vector<std::string> inputs, names;
  for (const Output& output : outputs.together) names.push_back(output.path);
  for (const OneOf& one : all_) {
    inputs.push_back(one.input);
    const auto own = outputs_for(outputs.each, one);
    if (!own) return own.error();
    names.insert(names.end(), own->begin(), own->end());
  }
  std::sort(inputs.begin(), inputs.end());
  inputs.erase(std::unique(inputs.begin(), inputs.end()), inputs.end());
  if (auto done = check_outputs(names, inputs); !done) return done.error();
  return std::nullopt;
}

int Several::refused(const Error& error) { return report(error); }

int Several::tell(const OneOf& one, Summary summary) {
  const std::string name = one.shown();
  for (const std::string& warning : summary.warnings) warn({name + ": " + warning});
  if (summary.error && !first_) {
    first_ = *summary.error;
    if (first_->where.empty()) first_->where = name;
  }
  fine_ += summary.error ? 0 : 1;
  std::size_t width = 0;
  for (const OneOf& other : all_) width = std::max(width, other.shown().size());
  std::string text;
  if (form_ == SummaryForm::kText) text = as_text(name, width, summary);
  if (form_ == SummaryForm::kCsv) text = csv_lines(name, std::move(summary));
  if (form_ == SummaryForm::kJson) text = summary_json(one.input, one.curve, summary);
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

/// What could not be read has no figures, and stands in the columns of the others: it waits until
/// they are known.
std::string Several::csv_lines(const std::string& name, Summary summary) {
  const auto blank = [&](Summary& one) {
    for (SummaryCell& cell : one.cells = columns_) cell.value.clear();
  };
  if (summary.cells.empty() && columns_.empty()) {
    waiting_.emplace_back(name, std::move(summary));
    return {};
  }
  std::string out;
  if (columns_.empty()) {
    columns_ = summary.cells;
    out = summary_csv_head(columns_);
    for (auto& [before, one] : waiting_) {
      blank(one);
      out += summary_csv(before, one);
    }
    waiting_.clear();
  }
  if (summary.cells.empty()) blank(summary);
  return out + summary_csv(name, summary);
}

int Several::end(const std::vector<std::string>& lines) {
  std::string left = waiting_.empty() ? "" : summary_csv_head({});
  for (const auto& [name, one] : waiting_) left += summary_csv(name, one);
  if (auto done = put(left); !done) return report(done.error());
  if (form_ == SummaryForm::kText) {
    std::string told;
    for (const std::string& line : lines) told += line + "\n";
    const std::string all = counted(all_.size(), "input", "inputs");
    if (auto done = put(told + fmt::format("{}, {} as asked\n", all, fine_)); !done) {
      return report(done.error());
    }
  }
  if (!first_) return 0;
  first_->what = fmt::format("{} of {} failed, the first: {}", all_.size() - fine_,
                             counted(all_.size(), "input", "inputs"), first_->what);
  return report(*first_);
}

}  // namespace obvid
