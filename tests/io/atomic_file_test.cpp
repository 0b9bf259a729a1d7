// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace obvid {
namespace {

namespace fs = std::filesystem;

class WriteFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "obvid-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string content(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  [[nodiscard]] std::ptrdiff_t entries() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  fs::path folder_;
};

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
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const fs::path file = folder_ / "out.json";
  ASSERT_TRUE(write_file(file.string(), "old"));
  fs::permissions(folder_, fs::perms(0500));
  const auto written = write_file(file.string(), "new");
  fs::permissions(folder_, fs::perms(0700));
  ASSERT_FALSE(written.has_value());
  EXPECT_EQ(written.error().code, ErrorCode::kWriteFailed);
  EXPECT_EQ(content(file), "old");
  EXPECT_EQ(entries(), 1);
}

}  // namespace
}  // namespace obvid
