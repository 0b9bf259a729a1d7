// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>
#include <vector>

#include "commands.h"
#include "obvid/io/contour_json.h"
#include "outputs.h"
#include "terminal.h"
#include "text.h"

namespace obvid {

int run(const ConvertOptions& options) {
  Result<std::vector<Output>> outputs = outputs_of(options.outputs, options.input);
  if (!outputs) return report(outputs.error());
  const Result<std::string> text = read_text(options.input);
  if (!text) return report(text.error());
  const std::string name = options.input == "-" ? "standard input" : options.input;
  const Result<StoredContour> stored = contour_from_json(*text, name);
  if (!stored) return report(stored.error());
  std::vector<std::string> remarks;
  const Result<std::vector<Output>> texts = exported(*outputs, *stored, options.formats, remarks);
  if (!texts) return report(texts.error());
  const Result<std::vector<std::string>> written = write_files(*texts);
  if (!written) return report(written.error());
  std::string shown;
  if (!options.quiet) {
    if (!options.profile.empty()) shown += options.profile + "\n";
    for (const std::string& remark : remarks) shown += remark + "\n";
    shown += "written  " + listed(*written) + "\n";
  }
  if (auto done = put(shown); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
