// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dxf/entities.h"
#include "obvid/core/result.h"

namespace obvid::dxf {

struct Block {
  Point3 base;
  std::vector<Entity> entities;
};

/// How a layer is shown.
enum class LayerState {
  kOff,    ///< not what is on it
  kFrozen  ///< nor what inserts on it bring about
};

/// What is of use in a DXF file. Texts point into the bytes that it was read from.
struct Document {
  int units = 0;                   ///< $INSUNITS; 0: none
  std::optional<int> measurement;  ///< $MEASUREMENT
  std::string_view units_remark;   ///< what a comment of our own R12 files says instead
  std::vector<Entity> entities;
  std::map<std::string_view, Block> blocks;
  std::map<std::string_view, LayerState> hidden_layers;
  std::vector<std::string> warnings;
};

/// Errors: E306 no DXF file; E302 a wrong group code.
[[nodiscard]] Result<Document> read_document(std::string_view bytes, std::string_view name);

}  // namespace obvid::dxf
