// SPDX-License-Identifier: Apache-2.0
// HDF5 without leaks. Whoever calls holds `hdf5_lock()`: the library is used by one thread at a
// time.
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "columns.h"
#include "obvid/core/result.h"

namespace obvid::batch {

[[nodiscard]] std::unique_lock<std::recursive_mutex> hdf5_lock();

/// Some identifier of HDF5, closed by the function that belongs to it.
class Hdf5Id {
 public:
  Hdf5Id() = default;
  Hdf5Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Hdf5Id(Hdf5Id&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  Hdf5Id(const Hdf5Id&) = delete;
  Hdf5Id& operator=(const Hdf5Id&) = delete;
  ~Hdf5Id() {
    if (id_ >= 0) close_(id_);
  }
  [[nodiscard]] hid_t get() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  herr_t (*close_)(hid_t) = nullptr;
};

/// E301. The lock is not needed.
[[nodiscard]] Error hdf5_unreadable(const std::string& path, const std::string& what);

/// Opens a file to read it; says nothing on standard error. Error: E301.
[[nodiscard]] Result<Hdf5Id> open_hdf5(const std::string& path);

/// Sizes of a data set; empty where it has none.
[[nodiscard]] std::vector<hsize_t> sizes_of(hid_t dataset);
[[nodiscard]] bool has_link(hid_t file, const char* name);

/// Columns become data sets of an HDF5 file, one block of rows after another. The same rows give
/// the same bytes however they are handed over: nothing in the file is a time, and blocks are of a
/// fixed number of rows. Written under a temporary name beside it, brought down to the disk, then
/// renamed. Takes the lock itself.
class TableWriter {
 public:
  /// `widths`: bytes of the longest text of each column, 0 of numbers. Error: E102.
  static Result<TableWriter> create(const std::string& path, const Columns& like,
                                    const std::vector<std::size_t>& widths, std::size_t rows);
  TableWriter(TableWriter&& other) noexcept;
  TableWriter(const TableWriter&) = delete;
  TableWriter& operator=(const TableWriter&) = delete;
  TableWriter& operator=(TableWriter&&) = delete;
  ~TableWriter();  ///< a file that was not finished is removed

  /// A text about the file as a whole.
  Result<void> attribute(const std::string& name, const std::string& value);
  Result<void> append(const Columns& rows);
  Result<void> finish();

 private:
  TableWriter() = default;
  Result<void> flush(std::size_t rows);
  [[nodiscard]] Error failed() const;

  std::string path_, temporary_;
  Hdf5Id file_;
  std::vector<Hdf5Id> sets_, types_;
  Columns waiting_;
  std::size_t written_ = 0;
};

/// All rows of a file that `TableWriter` made. Takes the lock itself. Error: E301.
[[nodiscard]] Result<Columns> read_table(const std::string& path);

}  // namespace obvid::batch
