// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace obvid {

/// A folder of its own for each test.
class TestFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "obvid-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// A file that can be run.
  std::string program(const std::string& name, const std::string& content) {
    const std::filesystem::path file = folder_ / name;
    std::ofstream(file, std::ios::binary) << content;
    std::filesystem::permissions(file, std::filesystem::perms(0755));
    return file.string();
  }
  std::string script(const std::string& lines) {
    return program("script", "#!/bin/sh\n" + lines + "\n");
  }

  std::filesystem::path folder_;
};

}  // namespace obvid
