// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "../common/output_folder.h"
#include "obvid/core/files.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

class OutputNames : public OutputFolder {
 protected:
  void SetUp() override {
    OutputFolder::SetUp();
    fs::create_directory(folder_ / "sub");
    fs::create_directory_symlink("sub", folder_ / "way");
    ASSERT_TRUE(write_file(at("there"), "a"));
    fs::create_symlink("there", folder_ / "link");
    fs::create_symlink("sub/missing", folder_ / "dangling");
    fs::create_hard_link(folder_ / "there", folder_ / "twin");
  }
  [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }
};

TEST_F(OutputNames, OneFileIsFoundThroughEverySpellingAndLink) {
  const std::pair<const char*, const char*> same[] = {{"there", "there"},
                                                      {"there", "./there"},
                                                      {"there", "sub/../there"},
                                                      {"there", "link"},
                                                      {"there", "twin"},
                                                      {"link", "twin"},
                                                      {"new", "new"},
                                                      {"new", "way/../new"},
                                                      {"sub/new", "way/new"},
                                                      {"dangling", "sub/missing"},
                                                      {"dangling", "way/missing"}};
  for (const auto& [a, b] : same) {
    EXPECT_TRUE(same_file(at(a), at(b))) << a << ' ' << b;
    EXPECT_TRUE(same_file(at(b), at(a))) << a << ' ' << b;
  }
}

TEST_F(OutputNames, DifferentFilesAndDevicesAreNotTheSame) {
  const std::pair<const char*, const char*> different[] = {
      {"there", "new"}, {"new", "New"}, {"new", "sub/new"}, {"there", "dangling"}};
  for (const auto& [a, b] : different) EXPECT_FALSE(same_file(at(a), at(b))) << a << ' ' << b;
  EXPECT_FALSE(same_file("/dev/null", "/dev/null"));
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  EXPECT_FALSE(same_file(at("pipe"), at("pipe")));
}

TEST_F(OutputNames, RelativeNamesMeanTheWorkingFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  EXPECT_TRUE(same_file("new", at("new")));
  EXPECT_TRUE(same_file("./new", "new"));
  fs::current_path(before);
}

TEST_F(OutputNames, AnOutputTwiceOrOnAnInputIsRefused) {
  const std::vector<std::string> fine = {at("a.json"), at("b.svg")};
  EXPECT_TRUE(check_outputs(fine, std::vector{at("there")}));
  const std::vector<std::string> twice = {at("a.json"), at("b.svg"), at("way/../a.json")};
  const auto refused = check_outputs(twice, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kBadOption);
  EXPECT_EQ(refused.error().where, twice[2]);
  const auto onto = check_outputs(fine, std::vector{at("there"), at("sub/../b.svg")});
  ASSERT_FALSE(onto);
  EXPECT_EQ(onto.error().code, ErrorCode::kBadOption);
  EXPECT_EQ(onto.error().where, fine[1]);
}

TEST_F(OutputNames, TheFileThatStandardInputComesFromIsAnInput) {
  const int before = ::dup(STDIN_FILENO);
  const int file = ::open(at("there").c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_GE(file, 0);
  ASSERT_EQ(::dup2(file, STDIN_FILENO), STDIN_FILENO);
  const auto refused = check_outputs(std::vector{at("twin")}, std::vector<std::string>{"-"});
  const auto fine = check_outputs(std::vector{at("new")}, std::vector<std::string>{"-"});
  ::dup2(before, STDIN_FILENO);
  ::close(before);
  ::close(file);
  EXPECT_FALSE(refused);
  EXPECT_TRUE(fine);
}

}  // namespace
}  // namespace obvid
