// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "../common/output_folder.h"
#include "temporary_file.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

class WriteFile : public OutputFolder {};

TEST_F(WriteFile, CreatesAndReplacesWholeFilesAndLeavesNothingBeside) {
  const fs::path file = folder_ / "out.json";
  ASSERT_TRUE(write_file(file.string(), "first, and longer"));
  EXPECT_EQ(content(file), "first, and longer");
  ASSERT_TRUE(write_file(file.string(), std::string_view("a\0b", 3)));
  EXPECT_EQ(content(file), std::string("a\0b", 3));
  EXPECT_EQ(entries(), 1);
}

TEST_F(WriteFile, KeepsThePermissionsOfTheFileReplaced) {
  const fs::path file = folder_ / "out.json";
  ASSERT_TRUE(write_file(file.string(), "a"));
  ASSERT_EQ(::chmod(file.c_str(), 0640), 0);
  ASSERT_TRUE(write_file(file.string(), "b"));
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0640));
}

TEST_F(WriteFile, NewFilesFollowTheUsersMask) {
  const mode_t old = ::umask(027);
  const fs::path file = folder_ / "out.json";
  ASSERT_TRUE(write_file(file.string(), "a"));
  ::umask(old);
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0640));
}

TEST_F(WriteFile, ALinkStaysALink) {
  const fs::path file = folder_ / "real";
  const fs::path link = folder_ / "link";
  ASSERT_TRUE(write_file(file.string(), "a"));
  fs::create_symlink("real", link);
  ASSERT_TRUE(write_file(link.string(), "b"));
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(content(file), "b");
}

TEST_F(WriteFile, ALinkToWhatIsNotThereYetStaysALinkAndLeadsToTheFile) {
  fs::create_directory(folder_ / "sub");
  fs::create_symlink("sub/second", folder_ / "first");
  fs::create_symlink("../real", folder_ / "sub" / "second");
  ASSERT_TRUE(write_file((folder_ / "first").string(), "a"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "first"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "sub" / "second"));
  EXPECT_EQ(content(folder_ / "real"), "a");
  EXPECT_EQ(entries(), 3);
}

TEST_F(WriteFile, LinksInACircleAreRefused) {
  fs::create_symlink("b", folder_ / "a");
  fs::create_symlink("a", folder_ / "b");
  const auto written = write_file((folder_ / "a").string(), "x");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kWriteFailed);
  EXPECT_EQ(entries(), 2);
}

TEST_F(WriteFile, OfSeveralNamesOfAFileTheOneGivenGetsTheNewContent) {
  const fs::path one = folder_ / "one", other = folder_ / "other";
  ASSERT_TRUE(write_file(one.string(), "old"));
  fs::create_hard_link(one, other);
  ASSERT_TRUE(write_file(one.string(), "new"));
  EXPECT_EQ(content(one), "new");
  EXPECT_EQ(content(other), "old");
}

TEST_F(WriteFile, WhatAKilledWriterLeftIsRemovedByTheNextOne) {
  const std::string file = (folder_ / "out.json").string();
  for (int round = 0; round < 3; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      TemporaryFile half(file, nullptr);
      if (half.write("half") == 0) ::raise(SIGKILL);
      ::_exit(1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(entries(), 1);  // the third one has removed what the second one left
  }
  ASSERT_TRUE(write_file(file, "whole"));
  EXPECT_EQ(entries(), 1);
  EXPECT_EQ(content(file), "whole");
}

TEST_F(WriteFile, WhatAnotherWriterIsWorkingOnIsLeftAlone) {
  const std::string file = (folder_ / "out.json").string();
  TemporaryFile other(file, nullptr);
  ASSERT_EQ(other.write("other"), 0);
  ASSERT_TRUE(write_file(file, "mine"));
  EXPECT_EQ(content(file), "mine");
  EXPECT_EQ(content(other.name()), "other");
  EXPECT_EQ(other.take_place(), 0);
  EXPECT_EQ(content(file), "other");
  EXPECT_EQ(entries(), 1);
}

TEST_F(WriteFile, WritersOfOneFileAtOnceDoNotMix) {
  const std::string file = (folder_ / "out.json").string();
  const std::string texts[] = {std::string(100'000, 'a'), std::string(50'000, 'b')};
  bool good[] = {true, true};
  std::thread writers[2];
  for (int k = 0; k < 2; ++k) {
    writers[k] = std::thread([&, k] {
      for (int i = 0; i < 50; ++i) good[k] = write_file(file, texts[k]).has_value() && good[k];
    });
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_TRUE(good[0] && good[1]);
  EXPECT_TRUE(content(file) == texts[0] || content(file) == texts[1]);
  EXPECT_EQ(entries(), 1);
}

TEST_F(WriteFile, LongNamesAreWritten) {
  const fs::path file = folder_ / std::string(255, 'n');
  ASSERT_TRUE(write_file(file.string(), "a"));
  EXPECT_EQ(entries(), 1);
}

TEST_F(WriteFile, DevicesAreWrittenTo) { EXPECT_TRUE(write_file("/dev/null", "gone")); }

TEST_F(WriteFile, SaysWhyItCouldNotWriteAndLeavesNothing) {
  const auto missing = write_file((folder_ / "no" / "out.json").string(), "a");
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().code, ErrorCode::kWriteFailed);
  EXPECT_NE(missing.error().what.find("No such file"), std::string::npos);
  const auto folder = write_file(folder_.string(), "a");
  ASSERT_FALSE(folder.has_value());
  EXPECT_EQ(folder.error().code, ErrorCode::kWriteFailed);
  EXPECT_EQ(folder.error().where, folder_.string());
  const auto full = write_file("/dev/full", "a");
  EXPECT_FALSE(full.has_value());
  EXPECT_EQ(entries(), 0);
}

TEST_F(WriteFile, AFolderWithoutPermissionIsRefusedAndTheOldFileStays) {
  const fs::path file = folder_ / "out.json";
  ASSERT_TRUE(write_file(file.string(), "old"));
  fs::permissions(file, fs::perms(0666));
  fs::permissions(folder_, fs::perms(0555));
  constexpr uid_t kSomebody = 1234;  // for whom permissions hold, unlike for root
  const pid_t child = ::fork();
  if (child == 0) {
    if (::geteuid() == 0 && ::setresuid(kSomebody, kSomebody, kSomebody) != 0) ::_exit(2);
    const auto written = write_file(file.string(), "new");
    ::_exit(!written && written.error().code == ErrorCode::kWriteFailed ? 0 : 1);
  }
  int status = 1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  fs::permissions(folder_, fs::perms(0700));
  EXPECT_EQ(status, 0);
  EXPECT_EQ(content(file), "old");
  EXPECT_EQ(entries(), 1);
}

}  // namespace
}  // namespace obvid
