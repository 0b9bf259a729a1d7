// SPDX-License-Identifier: Apache-2.0
#include "temporary_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

namespace obvid {
namespace {

/// Names tried for one target; each taken one belongs to a writer at work.
constexpr int kMostWriters = 100;

/// Links from link to link, as in the kernel.
constexpr int kMostLinks = 40;

constexpr mode_t kNewFileMode = 0666;  ///< before the user's mask
constexpr mode_t kOwnersMode = 0600;
constexpr mode_t kPermissionBits = 07777;

/// FNV-1a, 64 bits: names of targets may be as long as names can be, those beside them not longer.
std::uint64_t digest(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

std::string name_beside(const std::string& target, int number) {
  const std::string folder = folder_of(target);
  std::array<char, 48> name{};
  std::snprintf(name.data(), name.size(), ".obvid-%016llx-%d.tmp",
                static_cast<unsigned long long>(digest(target.substr(folder.size()))), number);
  return folder + name.data();
}

/// What lies there under the name is this open file.
bool is_still(const std::string& name, int file) {
  struct stat by_name {
  }, open{};
  return ::lstat(name.c_str(), &by_name) == 0 && ::fstat(file, &open) == 0 &&
         by_name.st_dev == open.st_dev && by_name.st_ino == open.st_ino;
}

bool locked(int file) {
  while (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EINTR) return false;
  }
  return true;
}

/// Removes what a writer that is no more left under this name. Who holds the lock is at work.
void remove_stale(const std::string& name) {
  const int file = ::open(name.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return;
  if (locked(file) && is_still(name, file)) ::unlink(name.c_str());
  ::close(file);
}

/// Down to the disk, where the file system can.
int flushed(int file) {
  while (::fsync(file) != 0) {
    if (errno == EINVAL || errno == ENOTSUP || errno == EROFS) return 0;  // nothing to flush to
    if (errno != EINTR) return errno;
  }
  return 0;
}

int flushed_folder(const std::string& folder) {
  const int file =
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return 0;  // a folder that may be written to but not read
  const int reason = flushed(file);
  ::close(file);
  return reason;
}

/// The access list of the old file, or none, whatever the folder gives to new files. 0 or errno.
int copy_access_list(int file, const std::string& old) {
  constexpr const char* kList = "system.posix_acl_access";
  constexpr std::size_t kLongest = 1 << 16;  // of any such attribute
  std::vector<char> list(kLongest);
  const ssize_t size = ::getxattr(old.c_str(), kList, list.data(), list.size());
  if (size > 0) {
    return ::fsetxattr(file, kList, list.data(), static_cast<std::size_t>(size), 0) == 0 ? 0
                                                                                         : errno;
  }
  if (::fremovexattr(file, kList) == 0 || errno == ENODATA || errno == ENOTSUP) return 0;
  return errno;
}

/// Owner, group and permissions of the old file. Where the system keeps the group or the list from
/// us, the new group gets no more than everybody had.
int dress(int file, const std::string& target, const struct stat& old) {
  struct stat now {};
  if (::fstat(file, &now) != 0) return errno;
  mode_t mode = old.st_mode & kPermissionBits;
  constexpr auto kSame = static_cast<uid_t>(-1);
  const bool group_kept = ::fchown(file, old.st_uid, old.st_gid) == 0 ||
                          ::fchown(file, kSame, old.st_gid) == 0 || now.st_gid == old.st_gid;
  if (::fstat(file, &now) != 0) return errno;
  if (now.st_uid != old.st_uid) mode &= ~mode_t{S_ISUID};
  if (copy_access_list(file, target) != 0 || !group_kept) {
    mode = (mode & ~mode_t{S_ISGID | S_IRWXG}) | (mode & (mode << 3) & S_IRWXG);
  }
  return ::fchmod(file, mode) == 0 ? 0 : errno;
}

}  // namespace

int write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash + 1);
}

std::string behind_links(std::string path) {
  for (int links = 0; links < kMostLinks; ++links) {
    std::array<char, PATH_MAX> content{};
    const ssize_t size = ::readlink(path.c_str(), content.data(), content.size());
    if (size < 0) return path;  // no link
    const std::string next(content.data(), static_cast<std::size_t>(size));
    path = next.starts_with('/') ? next : folder_of(path) + next;
  }
  errno = ELOOP;
  return {};
}

TemporaryFile::TemporaryFile(std::string target, const struct stat* old)
    : target_(std::move(target)), reason_(EEXIST) {
  if (old != nullptr) old_ = *old;
  for (int number = 0; number < kMostWriters && reason_ == EEXIST; ++number) {
    name_ = name_beside(target_, number);
    reason_ = create();
    if (reason_ != EEXIST) break;
    remove_stale(name_);
    reason_ = create();
  }
  if (reason_ != 0) name_.clear();
}

TemporaryFile::~TemporaryFile() {
  if (!name_.empty()) ::unlink(name_.c_str());
  if (file_ >= 0) ::close(file_);  // and with it the lock
}

/// Made and locked. Between the two another writer may take it for a stale one and remove it.
int TemporaryFile::create() {
  constexpr int kFlags = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  const int file = ::open(name_.c_str(), kFlags, old_ ? kOwnersMode : kNewFileMode);
  if (file < 0) return errno;
  const bool ours = locked(file) || errno != EWOULDBLOCK;  // some file systems have no locks
  if (ours && is_still(name_, file)) {
    file_ = file;
    return 0;
  }
  ::close(file);
  return EEXIST;
}

int TemporaryFile::take_place() {
  int reason = old_ ? dress(file_, target_, *old_) : 0;
  if (reason == 0) reason = flushed(file_);
  if (reason != 0) return reason;
  if (::rename(name_.c_str(), target_.c_str()) != 0) return errno;
  name_.clear();
  return flushed_folder(folder_of(target_));
}

}  // namespace obvid
