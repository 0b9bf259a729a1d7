// SPDX-License-Identifier: Apache-2.0
#include "hdf5_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>

#include "whole_file.h"

namespace obvid::batch {
namespace {

/// Rows of a block in the file. Fixed: another number gives other bytes.
constexpr std::size_t kBlockRows = 4096;
constexpr unsigned kDeflate = 1;  // the fastest; columns are mostly repetition

Hdf5Id type_of(const Column& column, std::size_t width) {
  switch (column.type) {
    case Column::Type::kText: {
      Hdf5Id type(H5Tcopy(H5T_C_S1), &H5Tclose);
      H5Tset_size(type.get(), width);
      H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
      H5Tset_cset(type.get(), H5T_CSET_UTF8);
      return type;
    }
    case Column::Type::kSmall:
      return {H5Tcopy(H5T_STD_I8LE), &H5Tclose};
    case Column::Type::kCount:
      return {H5Tcopy(H5T_STD_I32LE), &H5Tclose};
    case Column::Type::kNumber:
      break;
  }
  return {H5Tcopy(H5T_IEEE_F64LE), &H5Tclose};
}

/// No time of day in the file, and blocks that do not depend on how rows come.
Hdf5Id creation_of(std::size_t rows) {
  Hdf5Id list(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
  H5Pset_obj_track_times(list.get(), false);
  const hsize_t chunk = std::clamp<hsize_t>(rows, 1, kBlockRows);
  H5Pset_chunk(list.get(), 1, &chunk);
  H5Pset_shuffle(list.get());
  H5Pset_deflate(list.get(), kDeflate);
  return list;
}

bool put_text(hid_t object, const std::string& name, const std::string& value) {
  const Hdf5Id type(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(type.get(), std::max<std::size_t>(value.size(), 1));
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  const Hdf5Id space(H5Screate(H5S_SCALAR), &H5Sclose);
  const Hdf5Id at(
      H5Acreate2(object, name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
      &H5Aclose);
  const std::string text = value.empty() ? std::string(1, '\0') : value;
  return at && H5Awrite(at.get(), type.get(), text.data()) >= 0;
}

std::string text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const Hdf5Id at(H5Aopen(object, name, H5P_DEFAULT), &H5Aclose);
  const Hdf5Id type(H5Aget_type(at.get()), &H5Tclose);
  std::string out(H5Tget_size(type.get()), '\0');
  if (H5Tget_class(type.get()) != H5T_STRING || H5Aread(at.get(), type.get(), out.data()) < 0) {
    return {};
  }
  while (!out.empty() && out.back() == '\0') out.pop_back();
  return out;
}

/// Texts side by side, each as wide as the longest may be.
std::vector<char> packed_texts(const std::vector<std::string>& texts, std::size_t rows,
                               std::size_t width) {
  std::vector<char> out(rows * width, '\0');
  for (std::size_t i = 0; i < rows; ++i) {
    std::memcpy(out.data() + i * width, texts[i].data(), std::min(width, texts[i].size()));
  }
  return out;
}

template <class Number>
std::vector<Number> as_numbers(const std::vector<double>& values, std::size_t rows) {
  std::vector<Number> out(rows);
  std::transform(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rows), out.begin(),
                 [](double value) { return static_cast<Number>(value); });
  return out;
}

bool write_rows(hid_t set, const Column& column, std::size_t first, std::size_t rows, hid_t type) {
  const hsize_t start = first, count = rows;
  const Hdf5Id in_file(H5Dget_space(set), &H5Sclose);
  const Hdf5Id in_memory(H5Screate_simple(1, &count, nullptr), &H5Sclose);
  H5Sselect_hyperslab(in_file.get(), H5S_SELECT_SET, &start, nullptr, &count, nullptr);
  const auto put = [&](hid_t memory_type, const void* data) {
    return H5Dwrite(set, memory_type, in_memory.get(), in_file.get(), H5P_DEFAULT, data) >= 0;
  };
  switch (column.type) {
    case Column::Type::kText: {
      const auto packed = packed_texts(column.texts, rows, H5Tget_size(type));
      return put(type, packed.data());
    }
    case Column::Type::kSmall:
      return put(H5T_NATIVE_INT8, as_numbers<std::int8_t>(column.numbers, rows).data());
    case Column::Type::kCount:
      return put(H5T_NATIVE_INT32, as_numbers<std::int32_t>(column.numbers, rows).data());
    case Column::Type::kNumber:
      break;
  }
  return put(H5T_NATIVE_DOUBLE, column.numbers.data());
}

bool read_column(hid_t file, const std::string& name, Column& out) {
  const Hdf5Id set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), &H5Dclose);
  if (!set) return false;
  const std::vector<hsize_t> sizes = sizes_of(set.get());
  if (sizes.size() != 1) return false;
  const Hdf5Id type(H5Dget_type(set.get()), &H5Tclose);
  out.name = name;
  out.meaning = text_attribute(set.get(), "meaning");
  const std::size_t width = H5Tget_size(type.get());
  if (H5Tget_class(type.get()) == H5T_STRING) {
    out.type = Column::Type::kText;
    std::vector<char> packed(sizes[0] * width);
    if (H5Dread(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, packed.data()) < 0) {
      return false;
    }
    for (std::size_t i = 0; i < sizes[0]; ++i) {
      const char* const text = packed.data() + i * width;
      out.texts.emplace_back(text, ::strnlen(text, width));
    }
    return true;
  }
  const bool whole = H5Tget_class(type.get()) == H5T_INTEGER;
  out.type = !whole       ? Column::Type::kNumber
             : width == 1 ? Column::Type::kSmall
                          : Column::Type::kCount;
  out.numbers.resize(sizes[0]);
  return H5Dread(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.numbers.data()) >=
         0;
}

}  // namespace

std::unique_lock<std::recursive_mutex> hdf5_lock() {
  static std::recursive_mutex mutex;
  return std::unique_lock(mutex);
}

Error hdf5_unreadable(const std::string& path, const std::string& what) {
  return {ErrorCode::kCannotOpen, what, path, ""};
}

Result<Hdf5Id> open_hdf5(const std::string& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose);
  if (!file) return fail(hdf5_unreadable(path, "cannot read the HDF5 file"));
  return file;
}

std::vector<hsize_t> sizes_of(hid_t dataset) {
  const Hdf5Id space(H5Dget_space(dataset), &H5Sclose);
  const int rank = space ? H5Sget_simple_extent_ndims(space.get()) : 0;
  if (rank <= 0) return {};
  std::vector<hsize_t> out(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.get(), out.data(), nullptr);
  return out;
}

bool has_link(hid_t file, const char* name) { return H5Lexists(file, name, H5P_DEFAULT) > 0; }

Result<TableWriter> TableWriter::create(const std::string& path, const Columns& like,
                                        const std::vector<std::size_t>& widths, std::size_t rows) {
  const auto lock = hdf5_lock();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  TableWriter out;
  out.path_ = path;
  out.temporary_ = temporary_name(path);
  out.waiting_ = like.empty();
  const Hdf5Id creation(H5Pcreate(H5P_FILE_CREATE), &H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  out.file_ = {H5Fcreate(out.temporary_.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()),
               &H5Fclose};
  if (!out.file_) return fail(out.failed());
  const hsize_t size = rows;
  const Hdf5Id space(H5Screate_simple(1, &size, nullptr), &H5Sclose);
  const Hdf5Id list = creation_of(rows);
  std::string names;
  for (std::size_t k = 0; k < like.all.size(); ++k) {
    const Column& column = like.all[k];
    Hdf5Id type = type_of(column, widths[k]);
    Hdf5Id set(H5Dcreate2(out.file_.get(), column.name.c_str(), type.get(), space.get(),
                          H5P_DEFAULT, list.get(), H5P_DEFAULT),
               &H5Dclose);
    if (!set || !put_text(set.get(), "meaning", column.meaning)) return fail(out.failed());
    out.sets_.push_back(std::move(set));
    out.types_.push_back(std::move(type));
    names += (names.empty() ? "" : " ") + column.name;
  }
  if (!put_text(out.file_.get(), "columns", names)) return fail(out.failed());
  return out;
}

TableWriter::TableWriter(TableWriter&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, {})),
      file_(std::move(other.file_)),
      sets_(std::move(other.sets_)),
      types_(std::move(other.types_)),
      waiting_(std::move(other.waiting_)),
      written_(other.written_) {}

TableWriter::~TableWriter() {
  if (temporary_.empty()) return;
  const auto lock = hdf5_lock();
  sets_.clear();
  types_.clear();
  file_ = {};
  ::unlink(temporary_.c_str());
}

Error TableWriter::failed() const {
  return {ErrorCode::kWriteFailed, "cannot write the table", path_,
          "look at the permissions of the folder and the room on the disk"};
}

Result<void> TableWriter::attribute(const std::string& name, const std::string& value) {
  const auto lock = hdf5_lock();
  if (!put_text(file_.get(), name, value)) return fail(failed());
  return {};
}

Result<void> TableWriter::append(const Columns& rows) {
  waiting_.append(rows);
  while (waiting_.rows() >= kBlockRows) {
    if (auto done = flush(kBlockRows); !done) return done;
  }
  return {};
}

Result<void> TableWriter::flush(std::size_t rows) {
  const Columns block = waiting_.take_front(rows);
  const auto lock = hdf5_lock();
  for (std::size_t k = 0; k < sets_.size(); ++k) {
    if (!write_rows(sets_[k].get(), block.all[k], written_, rows, types_[k].get())) {
      return fail(failed());
    }
  }
  written_ += rows;
  return {};
}

Result<void> TableWriter::finish() {
  if (waiting_.rows() > 0) {
    if (auto done = flush(waiting_.rows()); !done) return done;
  }
  {
    const auto lock = hdf5_lock();
    sets_.clear();
    types_.clear();
    // closing writes what is left; a full disk shows here
    const bool flushed = H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) >= 0;
    file_ = {};
    if (!flushed) return fail(failed());
  }
  if (!put_in_place(temporary_, path_)) return fail(failed());
  temporary_.clear();
  return {};
}

Result<Columns> read_table(const std::string& path) {
  const auto lock = hdf5_lock();
  const auto file = open_hdf5(path);
  OBVID_TRY(file);
  const std::string names = text_attribute(file->get(), "columns");
  Columns out;
  for (std::size_t at = 0; at < names.size();) {
    const std::size_t end = std::min(names.find(' ', at), names.size());
    Column column;
    if (!read_column(file->get(), names.substr(at, end - at), column)) {
      return fail(hdf5_unreadable(path, "this is no table of a batch, or it is damaged"));
    }
    out.all.push_back(std::move(column));
    at = end + 1;
  }
  if (out.all.empty()) return fail(hdf5_unreadable(path, "this is no table of a batch"));
  return out;
}

}  // namespace obvid::batch
