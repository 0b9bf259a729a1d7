// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "obvid/cad/internal/cad.h"
#include "obvid/core/result.h"
#include "obvid/io/internal/private_copy.h"

namespace obvid::pipeline_detail {

/// The helper of the CAD kernel reads files alone: `read` gets the path of a private copy of the
/// text. Errors name what the user named. Errors: E310 without the helper; E103.
template <class Value>
[[nodiscard]] Result<Value> cad_of_text(const std::string& text, const std::string& name,
                                        Result<Value> (*read)(const std::string& path,
                                                              const CadRun& run),
                                        const CadRun& run) {
  OBVID_TRY(check_cad());
  const auto file = PrivateCopy::of(text, name);
  OBVID_TRY(file);
  auto made = read(file->path(), run);
  if (made) return made;
  Error error = made.error();
  for (std::string* part : {&error.what, &error.where, &error.hint}) {
    for (std::size_t at; (at = part->find(file->path())) != std::string::npos;) {
      part->replace(at, file->path().size(), name);
    }
  }
  return fail(std::move(error));
}

}  // namespace obvid::pipeline_detail
