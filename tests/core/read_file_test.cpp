// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <thread>

#include "../common/output_folder.h"

namespace obvid {
namespace {

class ReadFile : public OutputFolder {
 protected:
  [[nodiscard]] std::string made(const std::string& text) const {
    const std::string path = (folder_ / "file").string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
};

TEST_F(ReadFile, TheWholeContentComesBackWhateverItIs) {
  for (const std::string& text :
       {std::string(), std::string("a\0\r\n\xFF", 5), std::string(3'000'001, 'x')}) {
    const auto read = read_file(made(text));
    ASSERT_TRUE(read);
    EXPECT_TRUE(*read == text);
  }
}

TEST_F(ReadFile, EndlessAndLargeInputsEndAtTheLimit) {
  constexpr std::size_t kLimit = 5'000'000;
  for (const std::string& path : {std::string("/dev/zero"), made(std::string(kLimit + 1, 'x'))}) {
    const auto read = read_file(path, kLimit);
    ASSERT_FALSE(read) << path;
    EXPECT_EQ(read.error().code, ErrorCode::kUnsupported);
    EXPECT_EQ(read.error().where, path);
    EXPECT_EQ(read.error().value, static_cast<double>(kLimit));
  }
  EXPECT_TRUE(read_file(made(std::string(kLimit, 'x')), kLimit));
}

TEST_F(ReadFile, WhatCannotBeReadSaysWhy) {
  const auto none = read_file((folder_ / "none").string());
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kCannotOpen);
  EXPECT_NE(none.error().what.find("No such file"), std::string::npos);
  const auto folder = read_file(folder_.string());
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().code, ErrorCode::kCannotOpen);
  EXPECT_NE(folder.error().what.find("folder"), std::string::npos);
}

TEST_F(ReadFile, LookingAtItsHeadTakesNothingOutOfAPipe) {
  const std::string path = (folder_ / "pipe").string();
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(path) << "0 0\n1 0\n2 1\n"; });
  EXPECT_EQ(head_of_file(path, 100), "");
  const auto read = read_file(path);
  writer.join();
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, "0 0\n1 0\n2 1\n");
  EXPECT_EQ(head_of_file(made("abcdef"), 3), "abc");
  EXPECT_EQ(head_of_file(made("ab"), 3), "ab");
  EXPECT_EQ(head_of_file((folder_ / "none").string(), 3), "");
}

}  // namespace
}  // namespace obvid
