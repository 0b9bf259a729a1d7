// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/stat.h>

#include <optional>
#include <string>
#include <string_view>

namespace obvid {

/// All of the text to an open file; 0 or errno.
[[nodiscard]] int write_all(int file, std::string_view text);

/// A file beside `target` that takes its place when it is complete. Errors are errno values.
///
/// Its name follows from that of the target and is locked while it is written to: what a killed
/// writer left behind is found by the next one for the same target and removed, what another
/// writer is working on is left alone.
class TemporaryFile {
 public:
  /// `old`: the file to be replaced, or null. A replacement belongs to the user alone until it is
  /// complete; a new file has the permissions of new files from the start.
  TemporaryFile(std::string target, const struct stat* old);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();  ///< removes it unless it has taken its place

  /// Why it could not be made; 0 when it is there.
  [[nodiscard]] int reason() const { return reason_; }
  [[nodiscard]] const std::string& name() const { return name_; }

  [[nodiscard]] int write(std::string_view text) const { return write_all(file_, text); }
  /// Gives it the owner, group, permissions and access list of the old file, as far as the system
  /// lets the user (never more access), brings it down to the disk and renames it.
  [[nodiscard]] int take_place();

 private:
  [[nodiscard]] int create();

  std::string target_;
  std::optional<struct stat> old_;
  std::string name_;  ///< empty: there is none, or it has taken its place
  int file_ = -1;
  int reason_ = 0;
};

/// Where a path leads in the end: behind all links, also one to a file that is not there yet.
/// Sets errno and returns an empty string for loops.
[[nodiscard]] std::string behind_links(std::string path);

/// "folder/" or nothing.
[[nodiscard]] std::string folder_of(const std::string& path);

}  // namespace obvid
