// SPDX-License-Identifier: Apache-2.0
// What happens between the program and the disk.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "../common/output_folder.h"
#include "obvid/core/files.h"

namespace {

/// Where a test lists the calls of the system that matter to it; the functions below take the place
/// of the library's in this test program.
thread_local std::vector<std::string>* listener = nullptr;

std::string path_of(int file) {
  std::array<char, 4096> path{};
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t size = ::readlink(link.c_str(), path.data(), path.size());
  return {path.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
}

}  // namespace

extern "C" int fsync(int file) {
  if (listener != nullptr) listener->push_back("fsync " + path_of(file));
  return static_cast<int>(::syscall(SYS_fsync, file));
}

extern "C" int rename(const char* from, const char* to) noexcept {
  if (listener != nullptr) listener->push_back(std::string("rename ") + from + " " + to);
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

namespace obvid {
namespace {

namespace fs = std::filesystem;

class OutputDisk : public OutputFolder {};

TEST_F(OutputDisk, TheContentIsThereBeforeTheNameAndTheNameBeforeTheEnd) {
  const fs::path folder = fs::canonical(folder_);
  const std::string file = (folder / "out.json").string();
  for (int round = 0; round < 2; ++round) {  // a new file, a replaced one
    std::vector<std::string> calls;
    listener = &calls;
    const bool written = write_file(file, "a").has_value();
    listener = nullptr;
    ASSERT_TRUE(written);
    ASSERT_EQ(calls.size(), 3U);
    ASSERT_TRUE(calls[0].starts_with("fsync " + folder.string() + "/.obvid-")) << calls[0];
    const std::string beside = calls[0].substr(6);
    EXPECT_EQ(calls[1], "rename " + beside + " " + file);
    EXPECT_EQ(calls[2], "fsync " + folder.string());
  }
}

/// What a process of its own says of a full disk: "" when all is well.
std::string on_a_full_disk(const fs::path& folder) {
  const std::string file = (folder / "out.json").string();
  if (!write_file(file, "old")) return "the old file could not be written";
  const auto full = write_file(file, std::string(1'000'000, 'x'));
  if (full) return "it fitted";
  const Error& error = full.error();
  if (error.code != ErrorCode::kWriteFailed) return "another code";
  if (error.where != file) return "the file is not named: " + error.where;
  if (error.what.find("1000000 bytes") == std::string::npos) return error.what;
  // the one page of the old file is taken, of 16
  if (error.what.find(" 61440 are free") == std::string::npos) return error.what;
  if (error.value != 1e6) return "the value is not what is needed";
  if (std::distance(fs::directory_iterator(folder), fs::directory_iterator()) != 1) {
    return "something was left";
  }
  return fs::file_size(file) == 3 ? "" : "the old file is not as it was";
}

TEST_F(OutputDisk, AFullDiskIsNamedWithWhatIsNeededAndLeavesTheOldFile) {
  constexpr int kNoDisk = 77;
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {  // a small disk that this process alone sees
    const bool mounted =
        (::unshare(CLONE_NEWNS) == 0 || ::unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0) &&
        ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
        ::mount("none", folder_.c_str(), "tmpfs", 0, "size=64k") == 0;
    if (!mounted) ::_exit(kNoDisk);
    const std::string fault = on_a_full_disk(folder_);
    (void)!::write(pipe[1], fault.data(), fault.size());
    ::_exit(fault.empty() ? 0 : 1);
  }
  ::close(pipe[1]);
  std::array<char, 4096> fault{};
  const ssize_t size = ::read(pipe[0], fault.data(), fault.size());
  ::close(pipe[0]);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  if (WEXITSTATUS(status) == kNoDisk) GTEST_SKIP() << "no disk of its own may be made here";
  EXPECT_EQ(std::string(fault.data(), size > 0 ? static_cast<std::size_t>(size) : 0), "");
  EXPECT_EQ(status, 0);
}

TEST_F(OutputDisk, AFullDeviceSaysWhatIsNeeded) {
  const auto full = write_file("/dev/full", "abc");
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().where, "/dev/full");
  EXPECT_NE(full.error().what.find("3 bytes"), std::string::npos) << full.error().what;
  EXPECT_EQ(full.error().what.find("free"), std::string::npos) << full.error().what;
}

}  // namespace
}  // namespace obvid
