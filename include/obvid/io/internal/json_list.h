// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/io/internal/json_text.h"

namespace obvid {

/// "name": [...] of numbers or texts.
template <class Values>
JsonText& add_list(JsonText& json, const char* name, const Values& values) {
  json.key(name).begin_array();
  for (const auto& value : values) json.value(value);
  return json.end_array();
}

}  // namespace obvid
