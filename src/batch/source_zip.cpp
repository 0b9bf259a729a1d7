// SPDX-License-Identifier: Apache-2.0
#include <fnmatch.h>
#include <zip.h>

#include <mutex>
#include <utility>

#include "source.h"

namespace obvid::batch {
namespace {

struct EndZip {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};

/// Members are read one at a time, into memory and never to a disk: their names are ids alone.
class ZipSource : public Source {
 public:
  ZipSource(std::string path, zip_t* archive, const std::string& pattern)
      : path_(std::move(path)), archive_(archive) {
    const auto count = zip_get_num_entries(archive, 0);
    for (zip_int64_t i = 0; i < count; ++i) {
      const auto place = static_cast<zip_uint64_t>(i);
      const char* const name = zip_get_name(archive, place, 0);
      const std::string text = name == nullptr ? "" : name;
      if (text.empty() || text.back() == '/') continue;  // a folder
      const std::size_t slash = text.find_last_of('/');
      const std::string last = slash == std::string::npos ? text : text.substr(slash + 1);
      if (last.starts_with('.')) continue;
      if (!pattern.empty() && ::fnmatch(pattern.c_str(), last.c_str(), 0) != 0) continue;
      members_.push_back(place);
    }
  }

  std::size_t size() const override { return members_.size(); }

  Result<std::vector<Item>> load(std::size_t first, std::size_t count) const override {
    std::vector<Item> out;
    const std::scoped_lock lock(mutex_);
    for (std::size_t i = first; i < first + count; ++i) {
      Item item;
      const char* const name = zip_get_name(archive_.get(), members_[i], 0);
      item.id = item.name = name == nullptr ? "" : name;
      item.kind = Item::Kind::kText;
      read_member(members_[i], item);
      out.push_back(std::move(item));
    }
    return out;
  }

  std::string mark() const override { return path_ + " " + mark_of_file(path_); }

 private:
  /// A damaged or endless member stays an empty text or is cut where it is too large: it fails by
  /// itself.
  void read_member(zip_uint64_t place, Item& item) const {
    const std::unique_ptr<zip_file_t, EndZip> file(zip_fopen_index(archive_.get(), place, 0));
    if (file == nullptr) return;
    constexpr std::size_t kPiece = std::size_t{1} << 16U;
    zip_int64_t got = 1;
    while (got > 0 && item.text.size() <= kMostItemBytes) {
      const std::size_t before = item.text.size();
      item.text.resize(before + kPiece);
      got = zip_fread(file.get(), item.text.data() + before, kPiece);
      item.text.resize(before + static_cast<std::size_t>(std::max<zip_int64_t>(got, 0)));
    }
    if (got < 0) item.text.clear();
  }

  std::string path_;
  std::unique_ptr<zip_t, EndZip> archive_;
  mutable std::mutex mutex_;  // an archive is read by one thread at a time
  std::vector<zip_uint64_t> members_;
};

}  // namespace

Result<std::unique_ptr<Source>> zip_source(const std::string& path, const std::string& pattern) {
  int code = 0;
  zip_t* const archive = zip_open(path.c_str(), ZIP_RDONLY, &code);
  if (archive == nullptr) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string why = zip_error_strerror(&error);
    zip_error_fini(&error);
    return fail({ErrorCode::kCannotOpen, "cannot read the archive: " + why, path, ""});
  }
  return std::make_unique<ZipSource>(path, archive, pattern);
}

}  // namespace obvid::batch
