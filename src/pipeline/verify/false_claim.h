// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/core/error.h"
#include "obvid/io/internal/json_text.h"

namespace obvid::pipeline_detail {

/// E503 of a figure in the file of a curve in space; `name`: its path in there.
[[nodiscard]] Error false_claim_in_space(const std::string& name, double claimed, double found);

/// "false_claim" of a report: code, what and where; null for nullptr.
void add_false_claim(JsonText& json, const Error* claim);

}  // namespace obvid::pipeline_detail
