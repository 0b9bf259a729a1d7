// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "columns.h"
#include "obvid/core/result.h"

namespace obvid::batch {

/// What a batch is, so that one that goes on is the one that began. Items are counted through all
/// sources; shard k has those from k * shard_size on.
struct Manifest {
  std::string job, options, formats;
  std::vector<std::string> each;
  std::string reports;
  double most_seconds = 0.0;
  std::string program;  ///< version
  std::string sources;  ///< mark
  std::string remark;   ///< what the sources left out
  std::size_t items = 0;
  std::size_t shard_size = 1000;

  [[nodiscard]] std::size_t shards() const { return items == 0 ? 0 : (items - 1) / shard_size + 1; }
  [[nodiscard]] std::size_t begin_of(std::size_t shard) const { return shard * shard_size; }
  [[nodiscard]] std::size_t size_of_shard(std::size_t shard) const {
    return shard + 1 < shards() ? shard_size : items - begin_of(shard);
  }
};

[[nodiscard]] std::string manifest_text(const Manifest& manifest);
/// Error: E308.
[[nodiscard]] Result<Manifest> manifest_of(const std::string& text, const std::string& name);

/// Names beside the result out.h5.
struct Names {
  std::string table;    ///< out.h5
  std::string seconds;  ///< out.seconds.h5
  std::string index;    ///< out.sqlite
  std::string picture;  ///< out.svg
  std::string folder;   ///< out.h5.parts
};
[[nodiscard]] Names names_of(const std::string& out);
/// The table is HDF5: a name that says otherwise would lie. Error: E202.
[[nodiscard]] Result<void> check_table_name(const std::string& out);

/// The folder of the shards while a batch is at work. Several processes, also of several machines,
/// may fill it: a shard appears whole or not at all.
class Store {
 public:
  /// Opens it for this batch, or begins it. Errors: E203 it holds another batch; E102.
  static Result<Store> open(const Names& names, const Manifest& manifest);
  /// Opens what is there. Error: E301.
  static Result<Store> existing(const Names& names);

  [[nodiscard]] const Manifest& manifest() const { return manifest_; }
  [[nodiscard]] std::string path_of(std::size_t shard) const;
  [[nodiscard]] bool has(std::size_t shard) const;
  [[nodiscard]] std::vector<std::size_t> missing() const;
  /// Error: E102.
  [[nodiscard]] Result<void> put(std::size_t shard, const Columns& rows) const;
  /// Error: E301 damaged, or of another number of rows.
  [[nodiscard]] Result<Columns> get(std::size_t shard) const;
  /// Keeps others from the same part of the work until this object ends. Error: E203 somebody has
  /// it.
  [[nodiscard]] Result<void> lock_part(std::size_t part, std::size_t parts);
  /// The folder and what is in it; the manifest first, so that what is left is no batch.
  void remove();

  Store(Store&& other) noexcept;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;
  ~Store();

 private:
  Store() = default;
  std::string folder_;
  Manifest manifest_;
  int lock_ = -1;
};

}  // namespace obvid::batch
