// SPDX-License-Identifier: Apache-2.0
// page_judge.py and other programs from tests.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "../common/programs.h"

namespace obvid {

/// A folder of its own and the judge.
class Judged : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "obvid-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
    return file(name);
  }

  /// What the judge prints; arguments in order, quoted here.
  static std::string judge(const std::vector<std::string>& arguments) {
    std::string command =
        std::string("/usr/bin/python3 -B '") + OBVID_SOURCE_DIR + "/tests/picture/page_judge.py'";
    for (const std::string& a : arguments) command += " '" + a + "'";
    return judged_by(command);
  }

  struct Spot {
    double count = 0, left = 0, top = 0, right = 0, bottom = 0;
    double width() const { return right - left; }
    double height() const { return bottom - top; }
  };
  /// Pixels of a kind (see the judge) within "left,top,right,bottom".
  static Spot spot(const std::string& png, const std::string& kind, const std::string& box) {
    const std::string answer = judge({"pixels", png, kind + "," + box});
    std::istringstream in(answer);
    Spot s;
    in >> s.count >> s.left >> s.top >> s.right >> s.bottom;
    EXPECT_TRUE(in) << answer;
    return s;
  }
  /// Part of the pixels that differ in those two pictures that are most alike.
  static double difference(std::vector<std::string> pictures) {
    pictures.insert(pictures.begin(), "difference");
    const std::string answer = judge(pictures);
    std::istringstream in(answer);
    double part = -1.0;
    in >> part;
    EXPECT_TRUE(in) << answer;
    return part;
  }

  std::filesystem::path folder_;
};

}  // namespace obvid
