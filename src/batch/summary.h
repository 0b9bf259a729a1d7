// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "columns.h"

namespace obvid::batch {

/// Items in classes of a figure, by counts or by decades.
struct Histogram {
  std::map<int, std::size_t> classes;  ///< a count, or ten times the logarithm to base 10
  std::size_t unknown = 0;
};

/// What is to be said of a batch as a whole; its size does not grow with the batch.
struct Summary {
  std::size_t items = 0;
  std::array<std::size_t, 3> statuses{};  ///< done, not kept, failed
  std::map<int, std::size_t> codes;       ///< errors, by number
  std::map<int, std::string> first_of;    ///< the id of the first item with that error
  std::size_t proved = 0, warned = 0;
  std::string first_warned;                ///< the id of the first item with a warning
  std::size_t compared = 0, at_bound = 0;  ///< with vertices and bound known; as few as the bound
  double seconds = 0.0;                    ///< of all items, on one processor
  double longest = 0.0;
  std::string longest_id;
  std::string twice;                 ///< an id that several items have
  Histogram vertices, above, error;  ///< vertices; vertices - bound; error

  void add(const Columns& rows);
};

/// The table at the end of a batch.
[[nodiscard]] std::string summary_text(const Summary& summary);

/// Its histograms side by side. The same summary gives the same bytes.
[[nodiscard]] std::string histogram_svg(const Summary& summary);

}  // namespace obvid::batch
