// SPDX-License-Identifier: Apache-2.0
#include <fnmatch.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "digest.h"
#include "obvid/core/files.h"
#include "source.h"

namespace obvid::batch {
namespace {

namespace fs = std::filesystem;

class FileSource : public Source {
 public:
  explicit FileSource(std::vector<std::string> paths) : paths_(std::move(paths)) {}

  std::size_t size() const override { return paths_.size(); }

  Result<std::vector<Item>> load(std::size_t first, std::size_t count) const override {
    std::vector<Item> out;
    for (std::size_t i = first; i < first + count; ++i) {
      Item item;
      item.id = item.name = paths_[i];
      item.kind = Item::Kind::kFile;
      out.push_back(std::move(item));
    }
    return out;
  }

  std::string mark() const override {
    Digest digest;
    for (const std::string& path : paths_) digest.add(path + " " + mark_of_file(path));
    return std::to_string(paths_.size()) + " files " + digest.text();
  }

 private:
  std::vector<std::string> paths_;
};

/// Several sources one after another.
class JoinedSource : public Source {
 public:
  explicit JoinedSource(std::vector<std::unique_ptr<Source>> parts) : parts_(std::move(parts)) {
    for (const auto& part : parts_) ends_.push_back(size() + part->size());
  }

  std::size_t size() const override { return ends_.empty() ? 0 : ends_.back(); }

  Result<std::vector<Item>> load(std::size_t first, std::size_t count) const override {
    std::vector<Item> out;
    while (count > 0) {
      const auto part = static_cast<std::size_t>(
          std::upper_bound(ends_.begin(), ends_.end(), first) - ends_.begin());
      const std::size_t begin = part == 0 ? 0 : ends_[part - 1];
      const std::size_t here = std::min(count, ends_[part] - first);
      auto items = parts_[part]->load(first - begin, here);
      if (!items) return items;
      std::move(items->begin(), items->end(), std::back_inserter(out));
      first += here;
      count -= here;
    }
    return out;
  }

  std::string mark() const override {
    std::string out;
    for (const auto& part : parts_) out += (out.empty() ? "" : "; ") + part->mark();
    return out;
  }

  std::string remark() const override {
    std::string out;
    for (const auto& part : parts_) {
      const std::string one = part->remark();
      if (!one.empty()) out += (out.empty() ? "" : "; ") + one;
    }
    return out;
  }

 private:
  std::vector<std::unique_ptr<Source>> parts_;
  std::vector<std::size_t> ends_;
};

Error cannot_read(const std::string& path, const std::string& why) {
  return {ErrorCode::kCannotOpen, why, path, "check the path and the permissions"};
}

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

/// Plain files below a folder, by name.
Result<std::vector<std::string>> files_below(const std::string& folder,
                                             const std::string& pattern) {
  std::vector<std::string> out;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    if (is_hidden(at->path())) {
      at.disable_recursion_pending();
      continue;
    }
    std::error_code unknown;
    if (!at->is_regular_file(unknown)) continue;
    const std::string name = at->path().filename().string();
    if (pattern.empty() || ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0) {
      out.push_back(at->path().string());
    }
  }
  if (error) return fail(cannot_read(folder, "cannot read the folder: " + error.message()));
  std::sort(out.begin(), out.end());
  return out;
}

constexpr std::size_t kHead = std::size_t{1} << 16U;  // bytes to tell the kind of a file by

Result<std::unique_ptr<Source>> source_of(const std::string& path, const SourceOptions& options) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return fail(cannot_read(path, "there is no such file or folder"));
  if (fs::is_directory(status)) {
    auto files = files_below(path, options.pattern);
    OBVID_TRY(files);
    return file_source(std::move(*files));
  }
  if (!fs::is_regular_file(status)) {
    return fail(cannot_read(path, "a source is a file or a folder"));
  }
  if (!options.cuts.empty()) {
    return mesh_source(path, options.cuts, options.paths.size() > 1 || !options.list.empty(),
                       options.threads);
  }
  const std::string head = head_of_file(path, kHead);
  constexpr std::string_view kHdf5 = "\x89HDF\r\n\x1a\n", kZip = "PK\x03\x04",
                             kNoMember = "PK\x05\x06";
  if (head.starts_with(kHdf5)) return hdf5_source(path);
  if (head.starts_with(kZip) || head.starts_with(kNoMember)) {
    return zip_source(path, options.pattern);
  }
  if (has_id_column(head, options.id_column)) return table_source(path, options.id_column);
  return file_source({path});
}

Result<std::vector<std::string>> paths_of_list(const std::string& list) {
  const auto text = read_file(list);
  OBVID_TRY(text);
  std::vector<std::string> out;
  for (std::size_t at = 0; at < text->size();) {
    const std::size_t end = std::min(text->find('\n', at), text->size());
    std::string line = text->substr(at, end - at);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.empty()) out.push_back(std::move(line));
    at = end + 1;
  }
  return out;
}

}  // namespace

std::unique_ptr<Source> file_source(std::vector<std::string> paths) {
  return std::make_unique<FileSource>(std::move(paths));
}

std::string mark_of_file(const std::string& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return "missing";
  return std::to_string(found.st_size) + " " + std::to_string(found.st_mtim.tv_sec) + "." +
         std::to_string(found.st_mtim.tv_nsec);
}

Result<std::unique_ptr<Source>> open_sources(const SourceOptions& options) {
  std::vector<std::unique_ptr<Source>> parts;
  std::vector<std::string> single;  // neighbouring files are one source
  const auto close_single = [&] {
    if (!single.empty()) parts.push_back(file_source(std::exchange(single, {})));
  };
  for (const std::string& path : options.paths) {
    auto part = source_of(path, options);
    OBVID_TRY(part);
    if (dynamic_cast<const FileSource*>(part->get()) != nullptr && !fs::is_directory(path)) {
      single.push_back(path);
      continue;
    }
    close_single();
    parts.push_back(std::move(*part));
  }
  close_single();
  if (!options.list.empty()) {
    auto paths = paths_of_list(options.list);
    OBVID_TRY(paths);
    if (options.cuts.empty()) {
      parts.push_back(file_source(std::move(*paths)));  // each of them is one item
    } else {
      for (const std::string& path : *paths) {
        auto part = mesh_source(path, options.cuts, true, options.threads);
        OBVID_TRY(part);
        parts.push_back(std::move(*part));
      }
    }
  }
  if (parts.empty()) {
    return fail({ErrorCode::kUsage, "a batch needs a source", "obvid batch",
                 "name files, folders, archives or tables, or --list FILE"});
  }
  auto all = std::make_unique<JoinedSource>(std::move(parts));
  if (all->size() == 0) {
    return fail({ErrorCode::kTooFewPoints, "there is nothing in the sources", "",
                 options.pattern.empty() ? "" : "no name fits --pattern " + options.pattern});
  }
  return all;
}

}  // namespace obvid::batch
