// SPDX-License-Identifier: Apache-2.0
// Who may read what is written: never more people than before, not for an instant.
#include <grp.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "../common/output_folder.h"
#include "obvid/core/files.h"
#include "temporary_file.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

class OutputRights : public OutputFolder {
 protected:
  void SetUp() override {
    OutputFolder::SetUp();
    mask_ = ::umask(0);  // whatever is not asked for is granted
    file_ = (folder_ / "out.json").string();
  }
  void TearDown() override {
    ::umask(mask_);
    OutputFolder::TearDown();
  }

  void make_old(mode_t mode) {
    ASSERT_TRUE(write_file(file_, "old"));
    ASSERT_EQ(::chmod(file_.c_str(), mode), 0);
  }
  static struct stat state(const std::string& file) {
    struct stat out {};
    EXPECT_EQ(::stat(file.c_str(), &out), 0) << file;
    return out;
  }
  static mode_t mode(const std::string& file) { return state(file).st_mode & 07777; }

  std::string file_;
  mode_t mask_ = 0;
};

TEST_F(OutputRights, AReplacementBelongsToTheUserAloneUntilItIsComplete) {
  for (const mode_t old_mode : {0600U, 0640U, 0644U, 0666U}) {
    make_old(old_mode);
    const struct stat old = state(file_);
    TemporaryFile beside(file_, &old);
    ASSERT_EQ(beside.reason(), 0);
    EXPECT_EQ(mode(beside.name()), 0600U);
    ASSERT_EQ(beside.write("new"), 0);
    EXPECT_EQ(mode(beside.name()), 0600U);
    ASSERT_EQ(beside.take_place(), 0);
    EXPECT_EQ(mode(file_), old_mode);
    EXPECT_EQ(content(file_), "new");
  }
}

TEST_F(OutputRights, ANewFileHasThePermissionsOfNewFilesFromTheStart) {
  ::umask(027);
  TemporaryFile beside(file_, nullptr);
  EXPECT_EQ(mode(beside.name()), 0640U);
}

TEST_F(OutputRights, RootGivesAFileBackToItsOwner) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root may write files of others";
  make_old(0640);
  ASSERT_EQ(::chown(file_.c_str(), 1234, 4321), 0);
  ASSERT_TRUE(write_file(file_, "new"));
  const struct stat now = state(file_);
  EXPECT_EQ(now.st_uid, 1234U);
  EXPECT_EQ(now.st_gid, 4321U);
  EXPECT_EQ(now.st_mode & 07777, 0640U);
}

TEST_F(OutputRights, AnotherGroupGetsNoMoreThanEverybodyHad) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can become a user who is not in the group";
  make_old(0664);
  ASSERT_EQ(::chown(file_.c_str(), 1234, 4321), 0);
  ASSERT_EQ(::chmod(folder_.c_str(), 0777), 0);
  const pid_t child = ::fork();
  if (child == 0) {  // the owner, but not in the file's group
    const bool other = ::setgroups(0, nullptr) == 0 && ::setresgid(999, 999, 999) == 0 &&
                       ::setresuid(1234, 1234, 1234) == 0;
    ::_exit(other && write_file(file_, "new") ? 0 : 1);
  }
  int status = 1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_EQ(status, 0);
  EXPECT_EQ(state(file_).st_gid, 999U);
  EXPECT_EQ(mode(file_), 0644U);
}

/// An access list as Linux stores it (acl(5), linux/posix_acl_xattr.h).
std::vector<char> access_list(std::uint16_t group) {
  struct Entry {
    std::uint16_t tag, permissions;
    std::uint32_t id;
  };
  constexpr std::uint32_t kNobody = 0xFFFFFFFF;
  const std::array<Entry, 5> entries = {{{0x01, 6, kNobody},  // the owner
                                         {0x02, 4, 1234},     // a user with a name
                                         {0x04, group, kNobody},
                                         {0x10, 4, kNobody},    // at most, for the two before
                                         {0x20, 0, kNobody}}};  // others
  constexpr std::uint32_t kVersion = 2;
  std::vector<char> out(sizeof kVersion + sizeof entries);
  std::memcpy(out.data(), &kVersion, sizeof kVersion);
  std::memcpy(out.data() + sizeof kVersion, entries.data(), sizeof entries);
  return out;
}

std::vector<char> attribute(const std::string& file, const char* name) {
  std::vector<char> out(4096);
  const ssize_t size = ::getxattr(file.c_str(), name, out.data(), out.size());
  out.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return out;
}

constexpr const char* kList = "system.posix_acl_access";
constexpr const char* kListOfNewFiles = "system.posix_acl_default";

TEST_F(OutputRights, AnAccessListIsKept) {
  make_old(0600);
  const auto list = access_list(0);
  if (::setxattr(file_.c_str(), kList, list.data(), list.size(), 0) != 0) {
    GTEST_SKIP() << "this file system has no access lists: " << std::strerror(errno);
  }
  ASSERT_TRUE(write_file(file_, "new"));
  EXPECT_EQ(attribute(file_, kList), list);
}

TEST_F(OutputRights, TheListOfNewFilesInTheFolderDoesNotOpenAReplacedOne) {
  make_old(0640);
  const auto list = access_list(4);
  if (::setxattr(folder_.c_str(), kListOfNewFiles, list.data(), list.size(), 0) != 0) {
    GTEST_SKIP() << "this file system has no access lists: " << std::strerror(errno);
  }
  ASSERT_TRUE(write_file(file_, "new"));
  EXPECT_TRUE(attribute(file_, kList).empty());
  EXPECT_EQ(mode(file_), 0640U);
}

}  // namespace
}  // namespace obvid
