// SPDX-License-Identifier: Apache-2.0
// Series of an HDF5 file: `points` with `start`, one array of equally long series, or an array
// each.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "hdf5_file.h"
#include "source.h"

namespace obvid::batch {
namespace {

/// Texts of a data set, of fixed or variable length.
bool read_texts(hid_t set, hsize_t first, hsize_t count, std::vector<std::string>& out) {
  const Hdf5Id stored(H5Dget_type(set), &H5Tclose);
  const Hdf5Id in_file(H5Dget_space(set), &H5Sclose);
  const Hdf5Id in_memory(H5Screate_simple(1, &count, nullptr), &H5Sclose);
  H5Sselect_hyperslab(in_file.get(), H5S_SELECT_SET, &first, nullptr, &count, nullptr);
  const H5T_class_t kind = H5Tget_class(stored.get());
  if (kind == H5T_INTEGER) {
    std::vector<std::int64_t> numbers(count);
    if (H5Dread(set, H5T_NATIVE_INT64, in_memory.get(), in_file.get(), H5P_DEFAULT,
                numbers.data()) < 0) {
      return false;
    }
    for (const std::int64_t number : numbers) out.push_back(std::to_string(number));
    return true;
  }
  if (kind != H5T_STRING) return false;
  if (H5Tis_variable_str(stored.get()) > 0) {
    std::vector<char*> texts(count, nullptr);
    const bool good =
        H5Dread(set, stored.get(), in_memory.get(), in_file.get(), H5P_DEFAULT, texts.data()) >= 0;
    for (const char* const text : texts) out.emplace_back(text == nullptr ? "" : text);
    H5Dvlen_reclaim(stored.get(), in_memory.get(), H5P_DEFAULT, texts.data());
    return good;
  }
  const std::size_t width = H5Tget_size(stored.get());
  std::vector<char> packed(count * width);
  if (H5Dread(set, stored.get(), in_memory.get(), in_file.get(), H5P_DEFAULT, packed.data()) < 0) {
    return false;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const char* const text = packed.data() + i * width;
    out.emplace_back(text, ::strnlen(text, width));
  }
  return true;
}

/// Rows of an array of two dimensions, or series of one of three, as doubles.
bool read_rows(hid_t set, hsize_t first, hsize_t count, const std::vector<hsize_t>& sizes,
               std::vector<double>& out) {
  std::vector<hsize_t> start(sizes.size(), 0), extent = sizes;
  start[0] = first;
  extent[0] = count;
  hsize_t all = 1;
  for (const hsize_t one : extent) all *= one;
  out.resize(all);
  if (all == 0) return true;
  const Hdf5Id in_file(H5Dget_space(set), &H5Sclose);
  const Hdf5Id in_memory(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                         &H5Sclose);
  H5Sselect_hyperslab(in_file.get(), H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr);
  return H5Dread(set, H5T_NATIVE_DOUBLE, in_memory.get(), in_file.get(), H5P_DEFAULT, out.data()) >=
         0;
}

bool is_point_size(hsize_t size) { return size == 2 || size == 3; }

bool is_numeric(hid_t set) {
  const Hdf5Id type(H5Dget_type(set), &H5Tclose);
  const H5T_class_t kind = H5Tget_class(type.get());
  return kind == H5T_FLOAT || kind == H5T_INTEGER;
}

/// What the ways to store series have in common: the file and the ids of its items.
class Hdf5Source : public Source {
 public:
  Hdf5Source(std::string path, Hdf5Id file, Hdf5Id ids)
      : path_(std::move(path)), file_(std::move(file)), ids_(std::move(ids)) {}
  ~Hdf5Source() override {
    const auto lock = hdf5_lock();
    file_ = {};
    ids_ = {};
  }

  std::string mark() const override { return path_ + " " + mark_of_file(path_); }

  Result<std::vector<Item>> load(std::size_t first, std::size_t count) const override {
    const auto lock = hdf5_lock();
    std::vector<Item> out(count);
    std::vector<std::string> ids;
    if (ids_ && !read_texts(ids_.get(), first, count, ids)) return fail(damaged());
    for (std::size_t i = 0; i < count; ++i) {
      out[i].id = ids_ ? ids[i] : std::to_string(first + i);
      out[i].name = path_ + "[" + out[i].id + "]";
    }
    if (!read_points(first, out)) return fail(damaged());
    return out;
  }

 protected:
  [[nodiscard]] virtual bool read_points(std::size_t first, std::vector<Item>& items) const = 0;
  [[nodiscard]] Error damaged() const {
    return hdf5_unreadable(path_, "an array of the HDF5 file cannot be read");
  }
  [[nodiscard]] hid_t file() const { return file_.get(); }

 private:
  std::string path_;
  Hdf5Id file_, ids_;
};

/// `points` (N, 2 or 3) and `start`: series i has the rows from start[i] to start[i + 1].
class RaggedSource : public Hdf5Source {
 public:
  RaggedSource(std::string path, Hdf5Id file, Hdf5Id ids, Hdf5Id points,
               std::vector<std::uint64_t> starts)
      : Hdf5Source(std::move(path), std::move(file), std::move(ids)),
        points_(std::move(points)),
        sizes_(sizes_of(points_.get())),
        starts_(std::move(starts)) {}
  ~RaggedSource() override {
    const auto lock = hdf5_lock();
    points_ = {};
  }
  std::size_t size() const override { return starts_.size() - 1; }

 protected:
  bool read_points(std::size_t first, std::vector<Item>& items) const override {
    constexpr std::uint64_t kMostAtOnce = kMostItemBytes / (3 * sizeof(double));
    for (std::size_t i = 0; i < items.size(); ++i) {
      const std::uint64_t from = starts_[first + i], to = starts_[first + i + 1];
      items[i].dimension = sizes_[1];
      if (to - from > kMostAtOnce) {  // fails by itself, as a file that is too large
        items[i].kind = Item::Kind::kText;
        items[i].text.assign(kMostItemBytes + 1, ' ');
        continue;
      }
      if (!read_rows(points_.get(), from, to - from, sizes_, items[i].numbers)) return false;
    }
    return true;
  }

 private:
  Hdf5Id points_;
  std::vector<hsize_t> sizes_;
  std::vector<std::uint64_t> starts_;
};

/// One array (n, m, 2 or 3); rows of NaN at the end of a series are no points.
class EvenSource : public Hdf5Source {
 public:
  EvenSource(std::string path, Hdf5Id file, Hdf5Id ids, Hdf5Id points)
      : Hdf5Source(std::move(path), std::move(file), std::move(ids)),
        points_(std::move(points)),
        sizes_(sizes_of(points_.get())) {}
  ~EvenSource() override {
    const auto lock = hdf5_lock();
    points_ = {};
  }
  std::size_t size() const override { return sizes_[0]; }

 protected:
  bool read_points(std::size_t first, std::vector<Item>& items) const override {
    std::vector<double> all;
    if (!read_rows(points_.get(), first, items.size(), sizes_, all)) return false;
    const std::size_t each = sizes_[1] * sizes_[2];
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto from = all.begin() + static_cast<std::ptrdiff_t>(i * each);
      auto to = from + static_cast<std::ptrdiff_t>(each);
      const auto row = static_cast<std::ptrdiff_t>(sizes_[2]);
      const auto empty = [](double value) { return std::isnan(value); };
      while (to != from && std::all_of(to - row, to, empty)) to -= row;
      items[i].dimension = sizes_[2];
      items[i].numbers.assign(from, to);
    }
    return true;
  }

 private:
  Hdf5Id points_;
  std::vector<hsize_t> sizes_;
};

/// Every array (m, 2 or 3) of the file, by its name.
class NamedSource : public Source {
 public:
  NamedSource(std::string path, Hdf5Id file, std::vector<std::string> names)
      : path_(std::move(path)), file_(std::move(file)), names_(std::move(names)) {}
  ~NamedSource() override {
    const auto lock = hdf5_lock();
    file_ = {};
  }
  std::size_t size() const override { return names_.size(); }
  std::string mark() const override { return path_ + " " + mark_of_file(path_); }
  Result<std::vector<Item>> load(std::size_t first, std::size_t count) const override {
    const auto lock = hdf5_lock();
    std::vector<Item> out(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string& name = names_[first + i];
      out[i].id = name;
      out[i].name = path_ + "[" + name + "]";
      const Hdf5Id set(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), &H5Dclose);
      const auto sizes = set ? sizes_of(set.get()) : std::vector<hsize_t>{};
      if (sizes.size() != 2 || !read_rows(set.get(), 0, sizes[0], sizes, out[i].numbers)) {
        return fail(hdf5_unreadable(path_, "the array " + name + " cannot be read"));
      }
      out[i].dimension = sizes[1];
    }
    return out;
  }

 private:
  std::string path_;
  Hdf5Id file_;
  std::vector<std::string> names_;
};

herr_t add_name(hid_t file, const char* name, const H5O_info_t* info, void* names) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const Hdf5Id set(H5Dopen2(file, name, H5P_DEFAULT), &H5Dclose);
  const auto sizes = sizes_of(set.get());
  if (sizes.size() == 2 && is_point_size(sizes[1]) && is_numeric(set.get())) {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  }
  return 0;
}

/// Starts that go up within the points; the end of the last one may be left out.
std::vector<std::uint64_t> starts_of(hid_t file, hsize_t points) {
  const Hdf5Id set(H5Dopen2(file, "start", H5P_DEFAULT), &H5Dclose);
  const auto sizes = set ? sizes_of(set.get()) : std::vector<hsize_t>{};
  if (sizes.size() != 1 || sizes[0] == 0) return {};
  std::vector<std::uint64_t> out(sizes[0]);
  if (H5Dread(set.get(), H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()) < 0) {
    return {};
  }
  if (has_link(file, "id")) {
    const Hdf5Id ids(H5Dopen2(file, "id", H5P_DEFAULT), &H5Dclose);
    const auto count = sizes_of(ids.get());
    if (count.size() == 1 && count[0] == out.size()) out.push_back(points);
  } else if (out.back() != points) {
    out.push_back(points);
  }
  if (!std::is_sorted(out.begin(), out.end()) || out.back() > points || out.size() < 2) return {};
  return out;
}

/// The data set `id` where it has a name for each item.
Hdf5Id ids_of(hid_t file, std::size_t count) {
  if (!has_link(file, "id")) return {};
  Hdf5Id ids(H5Dopen2(file, "id", H5P_DEFAULT), &H5Dclose);
  const auto sizes = ids ? sizes_of(ids.get()) : std::vector<hsize_t>{};
  if (sizes.size() != 1 || sizes[0] != count) return {};
  return ids;
}

}  // namespace

Result<std::unique_ptr<Source>> hdf5_source(const std::string& path) {
  const auto lock = hdf5_lock();
  auto file = open_hdf5(path);
  OBVID_TRY(file);
  const hid_t h = file->get();
  if (has_link(h, "points")) {
    Hdf5Id points(H5Dopen2(h, "points", H5P_DEFAULT), &H5Dclose);
    const auto sizes = points ? sizes_of(points.get()) : std::vector<hsize_t>{};
    const bool good = points && is_numeric(points.get());
    if (good && sizes.size() == 2 && is_point_size(sizes[1]) && has_link(h, "start")) {
      auto starts = starts_of(h, sizes[0]);
      if (starts.empty()) {
        return fail({ErrorCode::kBadCount, "`start` does not go up within the points", path,
                     "series i has the rows from start[i] to start[i + 1]"});
      }
      Hdf5Id ids = ids_of(h, starts.size() - 1);
      return std::make_unique<RaggedSource>(path, std::move(*file), std::move(ids),
                                            std::move(points), std::move(starts));
    }
    if (good && sizes.size() == 3 && is_point_size(sizes[2])) {
      Hdf5Id ids = ids_of(h, sizes[0]);
      return std::make_unique<EvenSource>(path, std::move(*file), std::move(ids),
                                          std::move(points));
    }
  }
  std::vector<std::string> names;
  H5Ovisit(h, H5_INDEX_NAME, H5_ITER_INC, &add_name, &names);
  if (names.empty()) {
    return fail({ErrorCode::kTooFewPoints, "there are no series in this HDF5 file", path,
                 "arrays of n x 2 or n x 3 numbers, or `points` with `start`: docs/batch.md"});
  }
  return std::make_unique<NamedSource>(path, std::move(*file), std::move(names));
}

}  // namespace obvid::batch
