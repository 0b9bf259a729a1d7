// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "item.h"
#include "obvid/core/result.h"
#include "obvid/mesh/plane_row.h"

namespace obvid::batch {

/// Items in an order that is always the same, any of which can be had at any time. What it holds
/// in memory grows with the number of items by some 100 bytes at most, not with their points.
class Source {
 public:
  Source() = default;
  virtual ~Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  [[nodiscard]] virtual std::size_t size() const = 0;
  /// Items first, ... in their order. By any thread at any time. Error: of the source as a whole;
  /// an item that cannot be read is an item that fails by itself.
  [[nodiscard]] virtual Result<std::vector<Item>> load(std::size_t first,
                                                       std::size_t count) const = 0;
  /// A text that changes when the source does: names, sizes, times of change.
  [[nodiscard]] virtual std::string mark() const = 0;
  /// What was left out, in words; may be empty.
  [[nodiscard]] virtual std::string remark() const { return {}; }
};

struct SourceOptions {
  std::vector<std::string> paths;
  std::string list;              ///< file with one path per line; - standard input; may be empty
  std::string pattern;           ///< of files in folders and archives: *.dat; empty: all
  std::string id_column = "id";  ///< of tables
  std::vector<PlaneRow> cuts;    ///< then every path is a mesh
  std::size_t threads = 0;       ///< for what has to be done beforehand
};

/// All sources as one. A folder stands for its files (below it, too, names with a dot in front
/// aside), by name; an archive for its members; a text with an id column for the series in it; an
/// HDF5 file for its arrays; everything else for itself.
/// Errors: E201 none; E301; E307; E310.
[[nodiscard]] Result<std::unique_ptr<Source>> open_sources(const SourceOptions& options);

/// Larger files, members of archives and series fail with E310: nobody means them.
inline constexpr std::size_t kMostItemBytes = std::size_t{64} << 20U;

[[nodiscard]] Result<std::unique_ptr<Source>> zip_source(const std::string& path,
                                                         const std::string& pattern);
[[nodiscard]] Result<std::unique_ptr<Source>> table_source(const std::string& path,
                                                           const std::string& id_column);
[[nodiscard]] Result<std::unique_ptr<Source>> hdf5_source(const std::string& path);
[[nodiscard]] Result<std::unique_ptr<Source>> mesh_source(const std::string& path,
                                                          const std::vector<PlaneRow>& cuts,
                                                          bool name_it, std::size_t threads);
[[nodiscard]] std::unique_ptr<Source> file_source(std::vector<std::string> paths);

/// Whether the first line that is no comment has that column.
[[nodiscard]] bool has_id_column(const std::string& head, const std::string& id_column);

/// Size and time of change of a file, as they stand in marks.
[[nodiscard]] std::string mark_of_file(const std::string& path);

}  // namespace obvid::batch
