// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/core/internal/figures.h"
#include "obvid/core/result.h"
#include "obvid/pipeline/export.h"

namespace obvid {

/// A file to write.
struct Output {
  std::string path;
  FileFormat format = FileFormat::kContour;
  std::string text;
};

/// What is to be said of files that were formed.
struct FileNotes {
  std::vector<std::string> remarks;
  std::vector<std::string> warnings;
};

/// Format by ending. Error: E202 for endings without format.
[[nodiscard]] Result<Output> output_of(const std::string& path);
/// Of what analyses and compares: picture, page or tables. `what` is called "comparison", `tables`
/// ".csv and .json (tables)". Error: E202.
[[nodiscard]] Result<FileFormat> table_format_of(const std::string& path, const std::string& what,
                                                 const std::string& tables);
/// Whether files of curves can be written here, to be asked before the work begins; names without a
/// format are passed over. Error: E310, as `can_write_curves` has it, told of the file.
[[nodiscard]] Result<void> can_write_all(const std::vector<std::string>& paths);
/// All of them. Errors: E202; E203 where the input or another output would be replaced; E310 as
/// above.
[[nodiscard]] Result<std::vector<Output>> outputs_of(const std::vector<std::string>& paths,
                                                     const std::string& input);

/// Where one of several files of an output goes. Error: E203 where that is standard output.
[[nodiscard]] Result<std::string> path_of_part(const std::string& output,
                                               const std::string& suffix);

/// The files of one output, their names by suffixes. Errors are told of the output; `notes` get
/// what is said of it.
[[nodiscard]] Result<std::vector<Output>> named_files(const Output& output, Result<Exported> made,
                                                      FileNotes& notes);

/// Texts of all outputs, in the order of the outputs; a format that makes several files gives
/// several outputs, their names by suffixes. `notes` get a sentence each for what the formats
/// cannot hold, and for what may be wrong.
[[nodiscard]] Result<std::vector<Output>> exported(const std::vector<Output>& outputs,
                                                   const StoredContour& stored,
                                                   const ExportOptions& options, FileNotes& notes,
                                                   const RunContext& run = {});

/// The error, told of the file that could not be made.
[[nodiscard]] Error of_file(Error error, const std::string& path);

/// Writes all texts, each file whole or not at all; names what was written. Errors: E102; E203, and
/// nothing is written, where the input or another output would be replaced.
[[nodiscard]] Result<std::vector<std::string>> write_files(const std::vector<Output>& outputs,
                                                           const std::string& input);
/// The same where inputs and outputs are known to differ.
[[nodiscard]] Result<std::vector<std::string>> write_files(const std::vector<Output>& outputs);

}  // namespace obvid
