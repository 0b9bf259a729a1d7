// SPDX-License-Identifier: Apache-2.0
#include "store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "hdf5_file.h"
#include "obvid/core/files.h"
#include "obvid/core/internal/file_ending.h"

namespace obvid::batch {
namespace {

namespace fs = std::filesystem;
using ManifestJson = nlohmann::json;

constexpr const char* kManifestName = "batch.json";
constexpr int kManifestVersion = 2;  // with the columns of tables: they go by their places

std::string manifest_path(const std::string& folder) { return folder + "/" + kManifestName; }

/// The manifest first: what is left when this is interrupted is no batch.
void remove_files(const std::string& folder) {
  std::error_code ignored;
  fs::remove(manifest_path(folder), ignored);
  fs::remove_all(folder, ignored);
}

/// Shards without a manifest are what an interrupted removal left.
void remove_shards(const std::string& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    std::error_code ignored;
    if (entry.path().extension() == ".h5") fs::remove(entry.path(), ignored);
  }
}

/// Held by the process that looks whether a batch has begun: of several that start at once one
/// begins it and the others find it. -1: the file system has no locks.
class BeginLock {
 public:
  explicit BeginLock(const std::string& folder)
      : file_(::open((folder + "/begin.lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    while (file_ >= 0 && ::flock(file_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  BeginLock(const BeginLock&) = delete;
  BeginLock& operator=(const BeginLock&) = delete;
  ~BeginLock() {
    if (file_ >= 0) ::close(file_);
  }

 private:
  int file_;
};

/// The first thing in which two batches differ.
std::string difference(const Manifest& a, const Manifest& b) {
  const auto differs = [](const char* what, const auto& x, const auto& y) {
    return x == y ? std::string() : std::string(what);
  };
  for (const std::string& one :
       {differs("another --job", a.job, b.job), differs("other options", a.options, b.options),
        differs("other options of files", a.formats, b.formats),
        differs("another --each", a.each, b.each),
        differs("another --reports", a.reports, b.reports),
        differs("another --item-timeout", a.most_seconds, b.most_seconds),
        differs("another --shard-size", a.shard_size, b.shard_size),
        differs("another version of the program", a.program, b.program),
        differs("other sources, or changed ones", a.sources, b.sources)}) {
    if (!one.empty()) return one;
  }
  return {};
}

}  // namespace

std::string manifest_text(const Manifest& m) {
  const ManifestJson out{{"format", "obvid-batch"},
                         {"version", kManifestVersion},
                         {"program", m.program},
                         {"job", m.job},
                         {"options", m.options},
                         {"formats", m.formats},
                         {"each", m.each},
                         {"reports", m.reports},
                         {"item_timeout", m.most_seconds},
                         {"items", m.items},
                         {"shard_size", m.shard_size},
                         {"sources", m.sources},
                         {"remark", m.remark}};
  return out.dump(1, ' ', false, ManifestJson::error_handler_t::replace) + "\n";
}

Result<Manifest> manifest_of(const std::string& text, const std::string& name) {
  const ManifestJson in = ManifestJson::parse(text, nullptr, false);
  const Error wrong{ErrorCode::kBadJson, "this does not describe a batch", name,
                    "remove the folder to begin again"};
  if (!in.is_object() || in.value("format", "") != "obvid-batch" ||
      in.value("version", 0) != kManifestVersion) {
    return fail(wrong);
  }
  try {
    Manifest out;
    in.at("program").get_to(out.program);
    in.at("job").get_to(out.job);
    in.at("options").get_to(out.options);
    in.at("formats").get_to(out.formats);
    in.at("each").get_to(out.each);
    in.at("reports").get_to(out.reports);
    in.at("item_timeout").get_to(out.most_seconds);
    in.at("items").get_to(out.items);
    in.at("shard_size").get_to(out.shard_size);
    in.at("sources").get_to(out.sources);
    in.at("remark").get_to(out.remark);
    if (out.shard_size == 0) return fail(wrong);
    return out;
  } catch (const ManifestJson::exception&) {
    return fail(wrong);
  }
}

Names names_of(const std::string& out) {
  const fs::path path(out);
  const std::string stem = (path.parent_path() / path.stem()).string();
  return {out, stem + ".seconds.h5", stem + ".sqlite", stem + ".svg", out + ".parts"};
}

Result<void> check_table_name(const std::string& out) {
  if (has_ending(out, ".h5 .hdf5") || fs::path(out).extension().empty()) return {};
  return error(ErrorCode::kUnknownFormat,
               "the table of a batch is HDF5: its name ends with .h5 or .hdf5")
      .where(out)
      .hint(
          "`obvid batch query OUT.h5 --csv` prints the table of a batch as CSV; --each writes "
          "files of every item");
}

Result<Store> Store::open(const Names& names, const Manifest& manifest) {
  Store out;
  out.folder_ = names.folder;
  out.manifest_ = manifest;
  const std::string path = manifest_path(names.folder);
  std::error_code error;
  fs::create_directories(names.folder, error);
  if (error) {
    return fail(
        {ErrorCode::kWriteFailed, "cannot make the folder: " + error.message(), names.folder, ""});
  }
  const BeginLock lock(names.folder);
  if (fs::exists(path, error)) {
    const auto text = read_file(path);
    OBVID_TRY(text);
    // what is stored went through JSON: so does what it is compared with
    const auto there = manifest_of(*text, path), here = manifest_of(manifest_text(manifest), path);
    OBVID_TRY(there);
    const std::string why = difference(*there, *here);
    if (why.empty()) return out;
    return fail({ErrorCode::kBadOption, "another batch has begun here: " + why, names.folder,
                 "go on with it as it began, remove that folder, or choose another -o"});
  }
  remove_shards(names.folder);
  OBVID_TRY(write_file(path, manifest_text(manifest)));
  return out;
}

Result<Store> Store::existing(const Names& names) {
  const std::string path = manifest_path(names.folder);
  const auto text = read_file(path);
  OBVID_TRY(text);
  auto manifest = manifest_of(*text, path);
  OBVID_TRY(manifest);
  Store out;
  out.folder_ = names.folder;
  out.manifest_ = std::move(*manifest);
  return out;
}

Store::Store(Store&& other) noexcept
    : folder_(std::move(other.folder_)),
      manifest_(std::move(other.manifest_)),
      lock_(std::exchange(other.lock_, -1)) {}

Store::~Store() {
  if (lock_ >= 0) ::close(lock_);
}

std::string Store::path_of(std::size_t shard) const {
  return fmt::format("{}/shard-{:07}.h5", folder_, shard);
}

bool Store::has(std::size_t shard) const {
  std::error_code error;
  return fs::exists(path_of(shard), error);
}

std::vector<std::size_t> Store::missing() const {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < manifest_.shards(); ++k) {
    if (!has(k)) out.push_back(k);
  }
  return out;
}

Result<void> Store::put(std::size_t shard, const Columns& rows) const {
  auto table = TableWriter::create(path_of(shard), rows, rows.widths(), rows.rows());
  OBVID_TRY(table);
  if (auto done = table->append(rows); !done) return done;
  return table->finish();
}

Result<Columns> Store::get(std::size_t shard) const {
  auto rows = read_table(path_of(shard));
  if (!rows) return rows;
  if (rows->rows() != manifest_.size_of_shard(shard)) {
    return fail({ErrorCode::kCannotOpen, "a shard has another number of rows", path_of(shard),
                 "remove it: the batch makes it again"});
  }
  return rows;
}

Result<void> Store::lock_part(std::size_t part, std::size_t parts) {
  const std::string path = fmt::format("{}/part-{}-of-{}.lock", folder_, part, parts);
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) {
    return fail({ErrorCode::kWriteFailed, "cannot write into the folder of the shards", path, ""});
  }
  if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(file);
    return fail({ErrorCode::kBadOption, "another process is at work on this batch", path,
                 "wait for it, or give each process its own --shard i/n"});
  }
  lock_ = file;  // file systems without locks: shards are whole anyway, work may be done twice
  return {};
}

void Store::remove() { remove_files(folder_); }

}  // namespace obvid::batch
