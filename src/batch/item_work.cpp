// SPDX-License-Identifier: Apache-2.0
#include "item_work.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "obvid/core/internal/file_ending.h"
#include "source.h"

namespace obvid::batch {
namespace {

bool z_changes(const Item& item) {
  for (std::size_t i = 5; i < item.numbers.size(); i += 3) {
    if (item.numbers[i] != item.numbers[2]) return true;
  }
  return false;
}

/// Points of the plane of an item; of three coordinates the first two.
std::vector<double> plane_points(const Item& item) {
  if (item.dimension == 2) return item.numbers;
  std::vector<double> out;
  for (std::size_t i = 0; i + 2 < item.numbers.size(); i += 3) {
    out.push_back(item.numbers[i]);
    out.push_back(item.numbers[i + 1]);
  }
  return out;
}

std::vector<double> space_points(const Item& item) {
  if (item.dimension == 3) return item.numbers;
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < item.numbers.size(); i += 2) {
    out.insert(out.end(), {item.numbers[i], item.numbers[i + 1], 0.0});
  }
  return out;
}

/// Whether an option is set, in any way.
bool has_option(const JobSpec& spec, const char* name) {
  return nlohmann::json::parse(spec.options, nullptr, false).contains(name);
}

Trouble read_points_of(const Item& item, Work& work) {
  const bool heights = work.kind.name == "alignment" && item.dimension == 3;
  if (work.kind.table || heights) {
    const std::string text = table_of_points(item, work.kind, has_option(work.spec, "curve"));
    obvid_read_text(text.data(), text.size(), item.name.c_str(), Out(work.input), Out(work.error));
    return {};
  }
  if (work.spec.job == "space") {
    const std::vector<double> xyz = space_points(item);
    obvid_space_points(xyz.data(), xyz.size() / 3, Out(work.input), Out(work.error));
    return {};
  }
  if (item.dimension == 3 && z_changes(item)) {
    return {static_cast<int>(ErrorCode::kBadOption),
            "z changes: the job `space` forms curves in space"};
  }
  const std::vector<double> xy = plane_points(item);
  obvid_points(xy.data(), xy.size() / 2, Out(work.input), Out(work.error));
  return {};
}

using ReportJob = int (*)(const obvid_input*, const char*, const obvid_run*, char**, obvid_error**);

ReportJob report_job(std::string_view job) {
  if (job == "analyse") return &obvid_analyse;
  if (job == "region") return &obvid_region;
  if (job == "compare") return &obvid_compare;
  return &obvid_suggest;
}

/// A spline of a table or a curve or net of control points; `report` may be NULL.
void make_by_ending(Work& work, const char* ending, char** report) {
  const obvid_input* const table = work.input.get();
  const char* const options = work.spec.options.c_str();
  Out<obvid_files> files(work.files);
  obvid_files** const to_files = ending == nullptr ? nullptr : static_cast<obvid_files**>(files);
  if (work.kind.name == "spline") {
    obvid_spline(table, work.against, options, ending, &work.run, Out(work.surface), to_files,
                 report, Out(work.error));
  } else {
    obvid_nurbs_make(table, options, ending, &work.run, Out(work.surface), to_files, report,
                     Out(work.error));
  }
}

/// "name.step" with "-2" between name and ending.
std::string with_suffix(const std::string& path, const std::string& suffix) {
  const std::filesystem::path name(path);
  return (name.parent_path() / (name.stem().string() + suffix + name.extension().string()))
      .string();
}

/// Of the texts of a job the one whose suffix the path ends with, the longest; a program has none
/// and the endings of G-code. -1: there is none.
std::ptrdiff_t text_for(const obvid_files* files, const std::string& path) {
  std::ptrdiff_t found = -1;
  std::size_t longest = 0;
  for (std::size_t k = 0; k < obvid_files_count(files); ++k) {
    const std::string_view suffix = obvid_files_suffix(files, k);
    const bool fits = suffix.empty() ? is_program_file(path) : has_ending(path, suffix);
    if (!fits || (found >= 0 && suffix.size() < longest)) continue;
    found = static_cast<std::ptrdiff_t>(k);
    longest = suffix.size();
  }
  return found;
}

std::string data_of(const obvid_files* files, std::size_t k) {
  std::size_t size = 0;
  const char* const data = obvid_files_data(files, k, &size);
  return {data, size};
}

Trouble too_large() {
  return {static_cast<int>(ErrorCode::kUnsupported),
          "larger than an item of a batch may be (64 MB)"};
}

Trouble read_file_of(const std::string& path, Owned<obvid_input>& input,
                     Owned<obvid_error>& error) {
  struct stat found {};
  if (::stat(path.c_str(), &found) == 0) {
    if (!S_ISREG(found.st_mode)) {  // a pipe would be waited for
      return {static_cast<int>(ErrorCode::kCannotOpen), "this is no plain file"};
    }
    if (static_cast<std::size_t>(found.st_size) > kMostItemBytes) return too_large();
  }
  obvid_read_file(path.c_str(), Out(input), Out(error));
  return {};
}

}  // namespace

Trouble read_item(const Item& item, Work& work) {
  switch (item.kind) {
    case Item::Kind::kPoints:
      return read_points_of(item, work);
    case Item::Kind::kText:
      if (item.text.size() > kMostItemBytes) return too_large();
      obvid_read_text(item.text.data(), item.text.size(), item.name.c_str(), Out(work.input),
                      Out(work.error));
      return {};
    case Item::Kind::kFile:
      break;
  }
  return read_file_of(item.name, work.input, work.error);
}

Trouble read_heights(const std::string& path, Work& work) {
  return read_file_of(path, work.heights, work.error);
}

void do_job(Work& work) {
  const std::string_view job = work.kind.name;
  const char* const options = work.spec.options.c_str();
  const obvid_input* const input = work.input.get();
  const obvid_run* const run = &work.run;
  Out<char> report(work.report);
  Out<obvid_files> files(work.files);
  const bool reported = !work.spec.reports.empty() || work.kind.reports;
  char** const to_report = reported ? static_cast<char**>(report) : nullptr;
  obvid_files** const to_files =
      work.spec.each.empty() ? nullptr : static_cast<obvid_files**>(files);
  if (job == "fit") {
    obvid_fit(input, options, run, Out(work.contour), to_report, Out(work.error));
  } else if (job == "space") {
    obvid_fit_space(input, options, run, Out(work.space), to_report, Out(work.error));
  } else if (job == "verify" || job == "convert") {
    obvid_stored(input, options, run, Out(work.contour), Out(work.error));
    if (work.contour && job == "verify") {
      obvid_verify(work.contour.get(), run, to_report, Out(work.error));
    }
  } else if (job == "alignment") {
    obvid_alignment(input, work.heights.get(), options, run, Out(work.contour), to_files, to_report,
                    Out(work.error));
  } else if (job == "cut") {
    obvid_cut(&input, 1, options, run, to_files, to_report, Out(work.error));
  } else if (work.kind.draws == Draws::kByEnding) {
    make_by_ending(work, nullptr, to_report);
  } else if (work.against != nullptr) {
    const std::array<const obvid_input*, 2> both{work.against, input};
    obvid_compare_curves(both.data(), both.size(), options, run, to_files, to_report,
                         Out(work.error));
  } else {
    report_job(job)(input, options, run, to_report, Out(work.error));
  }
}

std::vector<std::pair<std::string, std::string>> files_at(Work& work, const std::string& path) {
  const std::string ending = ending_of(path);
  const std::string format = ending.empty() ? "" : ending.substr(1);
  const char* const formats = work.spec.formats.c_str();
  const bool as_table = work.kind.name == "spline" && (format == "csv" || format == "json");
  Owned<obvid_files> made;
  if (work.kind.draws == Draws::kByEnding && work.surface && !as_table) {
    obvid_surface_export(work.surface.get(), format.c_str(), formats, &work.run, Out(made),
                         Out(work.error));
  } else if (work.kind.draws == Draws::kByEnding && work.report) {
    make_by_ending(work, format.c_str(), nullptr);
    made = std::move(work.files);
  } else if (work.files) {
    const std::ptrdiff_t text = text_for(work.files.get(), path);
    if (text >= 0) return {{path, data_of(work.files.get(), static_cast<std::size_t>(text))}};
  }
  if (!made && work.contour) {
    obvid_export(work.contour.get(), format.c_str(), formats, &work.run, Out(made),
                 Out(work.error));
  } else if (!made && work.space) {
    obvid_space_export(work.space.get(), format.c_str(), formats, &work.run, Out(made),
                       Out(work.error));
  }
  std::vector<std::pair<std::string, std::string>> out;
  for (std::size_t k = 0; made && k < obvid_files_count(made.get()); ++k) {
    const char* const suffix = obvid_files_suffix(made.get(), k);
    out.emplace_back(with_suffix(path, suffix == nullptr ? "" : suffix), data_of(made.get(), k));
  }
  return out;
}

}  // namespace obvid::batch
