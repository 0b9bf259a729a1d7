// SPDX-License-Identifier: Apache-2.0
// Which file is taken for the helper, before anything of it runs.
#include "helper_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "test_folder.h"

namespace obvid::cad {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMark = "the mark of this build";

class HelperFile : public TestFolder {
 protected:
  void expect_refused(const fs::path& file, const std::string& why) {
    const auto good = check_part(file, own_, helper_with(kMark));
    ASSERT_FALSE(good) << why;
    EXPECT_EQ(good.error().code, ErrorCode::kUnsupported);
    EXPECT_NE(good.error().what.find(why), std::string::npos) << good.error().what;
  }

  const fs::path own_ = own_file();
};

TEST_F(HelperFile, ThisProgramIsFound) { EXPECT_TRUE(fs::equivalent(own_, "/proc/self/exe")); }

TEST_F(HelperFile, OnlyOurFoldersAreLookedAt) {
  const char* before = std::getenv("OBVID_PLUGINS");
  const std::string kept = before != nullptr ? before : "";
  ::unsetenv("OBVID_PLUGINS");
  const auto folders = helper_folders("/opt/obvid/bin/obvid");
  ::setenv("OBVID_PLUGINS", "/named", 1);
  const auto with_named = helper_folders("/opt/obvid/bin/obvid");
  kept.empty() ? ::unsetenv("OBVID_PLUGINS") : ::setenv("OBVID_PLUGINS", kept.c_str(), 1);
  const std::vector<fs::path> expected = {"/opt/obvid/bin", "/opt/obvid/libexec/obvid"};
  EXPECT_EQ(folders, expected);
  ASSERT_EQ(with_named.size(), 3U);
  EXPECT_EQ(with_named.front(), "/named");
}

TEST_F(HelperFile, AFileWithTheMarkIsTaken) {
  const std::string file = program("obvid-cad", std::string("\0\1elf ", 6) + kMark + '\0' + "more");
  EXPECT_TRUE(check_part(file, own_, helper_with(kMark)));
}

TEST_F(HelperFile, WithoutTheWholeMarkItIsOfAnotherBuild) {
  expect_refused(program("a", "#!/bin/sh\n"), "another build");
  expect_refused(program("b", std::string(kMark).substr(1)), "another build");
  expect_refused(program("c", ""), "another build");
}

TEST_F(HelperFile, WhatEverybodyMayWriteToIsRefused) {
  const std::string file = program("obvid-cad", kMark);
  ASSERT_EQ(::chmod(file.c_str(), 0757), 0);
  expect_refused(file, "everybody may write");
}

TEST_F(HelperFile, WhatBelongsToSomebodyElseIsRefused) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a file away";
  const std::string file = program("obvid-cad", kMark);
  ASSERT_EQ(::chown(file.c_str(), 1234, 1234), 0);
  expect_refused(file, "another user");
}

TEST_F(HelperFile, WhatIsNoPlainFileIsRefused) {
  fs::create_directory(folder_ / "folder");
  expect_refused(folder_ / "folder", "no program");
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0700), 0);
  expect_refused(folder_ / "pipe", "no program");  // and nobody waits for its other end
  expect_refused(folder_ / "none", "no program");
  expect_refused("/dev/zero", "no program");
}

}  // namespace
}  // namespace obvid::cad
