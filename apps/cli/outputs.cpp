// SPDX-License-Identifier: Apache-2.0
#include "outputs.h"

#include <algorithm>
#include <filesystem>

#include "obvid/core/files.h"
#include "obvid/pipeline/internal/can_write.h"
#include "obvid/pipeline/internal/no_such_file.h"
#include "text.h"

namespace obvid {

Result<Output> output_of(const std::string& path) {
  if (const auto format = format_of(path)) return Output{path, *format, {}};
  const std::string ending = std::filesystem::path(path).extension().string();
  return error(ErrorCode::kUnknownFormat,
               ending.empty() ? "the name has no file extension that determines a format"
                              : "no format is known for the file extension " + ending)
      .where(path)
      .hint("possible are " + known_endings());
}

Error of_file(Error error, const std::string& path) {
  error.where = path;
  return error;
}

Result<FileFormat> table_format_of(const std::string& path, const std::string& what,
                                   const std::string& tables) {
  if (const auto format = table_format_of(path)) return *format;
  return no_such_file(what, ".svg (picture), .html (page), " + tables).where(path);
}

Result<void> can_write_all(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    if (auto able = can_write_curves(format_of(path)); !able) {
      return fail(of_file(able.error(), path));
    }
  }
  return {};
}

Result<std::vector<Output>> outputs_of(const std::vector<std::string>& paths,
                                       const std::string& input) {
  OBVID_TRY(check_outputs(paths, {&input, 1}));
  OBVID_TRY(can_write_all(paths));
  std::vector<Output> outputs;
  for (const std::string& path : paths) {
    Result<Output> output = output_of(path);
    OBVID_TRY(output);
    outputs.push_back(std::move(*output));
  }
  return outputs;
}

Result<std::string> path_of_part(const std::string& output, const std::string& suffix) {
  if (suffix.empty()) return output;
  if (is_standard_output(output)) {
    return error(ErrorCode::kBadOption, "this contour is several files in that format")
        .where("-o -")
        .hint("name a file");
  }
  std::filesystem::path path = output;
  path.replace_filename(path.stem().string() + suffix + path.extension().string());
  return path.string();
}

Result<std::vector<Output>> named_files(const Output& output, Result<Exported> made,
                                        FileNotes& notes) {
  if (!made) {
    Error error = made.error();
    if (error.where.empty()) error.where = output.path;
    return fail(std::move(error));
  }
  std::vector<Output> out;
  for (ExportedFile& file : made->files) {
    const auto path = path_of_part(output.path, file.suffix);
    OBVID_TRY(path);
    out.push_back({*path, output.format, std::move(file.text)});
  }
  for (const std::string& one : made->remarks) notes.remarks.push_back(output.path + ": " + one);
  for (const std::string& one : made->warnings) notes.warnings.push_back(output.path + ": " + one);
  return out;
}

Result<std::vector<Output>> exported(const std::vector<Output>& outputs,
                                     const StoredContour& stored, const ExportOptions& options,
                                     FileNotes& notes, const RunContext& run) {
  std::vector<Output> out;
  for (const Output& output : outputs) {
    auto files = named_files(output, export_contour(stored, output.format, options, run), notes);
    OBVID_TRY(files);
    for (Output& file : *files) out.push_back(std::move(file));
  }
  return out;
}

Result<std::vector<std::string>> write_files(const std::vector<Output>& outputs) {
  std::vector<std::string> names;
  for (const Output& output : outputs) {
    OBVID_TRY(write_file(output.path, output.text));
    names.push_back(output.path);
  }
  return names;
}

Result<std::vector<std::string>> write_files(const std::vector<Output>& outputs,
                                             const std::string& input) {
  std::vector<std::string> names;
  for (const Output& output : outputs) names.push_back(output.path);
  // again: formats that make several files have made names of their own
  OBVID_TRY(check_outputs(names, {&input, 1}));
  return write_files(outputs);
}

}  // namespace obvid
