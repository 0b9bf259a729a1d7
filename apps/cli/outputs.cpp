// SPDX-License-Identifier: Apache-2.0
#include "outputs.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "obvid/io/atomic_file.h"
#include "text.h"

namespace obvid {

Result<Output> output_of(const std::string& path, const std::string& input, FormatSet formats) {
  namespace fs = std::filesystem;
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::error_code ignored;
  if (path == input || fs::equivalent(path, input, ignored)) {
    return fail(
        {ErrorCode::kBadOption, "the output would replace the input", path, "choose another name"});
  }
  if (ending == ".json") return Output{path, Format::kJson, {}};
  if (ending == ".svg") return Output{path, Format::kSvg, {}};
  const bool tables = formats == FormatSet::kTables;
  if (tables && ending == ".csv") return Output{path, Format::kCsv, {}};
  return fail({ErrorCode::kUnknownFormat,
               ending.empty() ? "the name has no ending that tells a format"
                              : "no format is known for the ending " + ending,
               path,
               tables ? "possible are .svg (picture), .csv and .json (tables)"
                      : "possible are .json (contour) and .svg (picture)"});
}

Result<std::vector<Output>> outputs_of(const std::vector<std::string>& paths,
                                       const std::string& input, FormatSet formats) {
  std::vector<Output> outputs;
  for (const std::string& path : paths) {
    Result<Output> output = output_of(path, input, formats);
    if (!output) return fail(output.error());
    outputs.push_back(std::move(*output));
  }
  return outputs;
}

Result<std::vector<std::string>> write_files(const std::vector<Output>& outputs) {
  std::vector<std::string> written;
  for (const Output& output : outputs) {
    if (auto done = write_file(output.path, output.text); !done) return fail(done.error());
    written.push_back(output.path);
  }
  return written;
}

std::string noise_option(double tolerance, bool closed, const std::vector<Vec2>& points) {
  constexpr int kDigits = 3;  // of tolerances that the library names
  const bool returns = points.size() > 2 && norm(points.back() - points.front()) <= 2.0 * tolerance;
  return "--noise " + significant(tolerance, kDigits) + (returns && !closed ? " --open" : "");
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace obvid
