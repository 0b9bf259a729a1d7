// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace obvid::batch {

/// One input of a batch: points, a text with the name of a file, or the path of a file.
struct Item {
  enum class Kind { kPoints, kText, kFile };
  std::string id;
  Kind kind = Kind::kPoints;
  std::vector<double> numbers;  ///< of points: x, y or x, y, z one after the other
  std::size_t dimension = 2;
  std::string name;  ///< of a text or file
  std::string text;
};

}  // namespace obvid::batch
