// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "built_cad.h"
#include "faces_models.h"
#include "obvid/cad/internal/cad.h"

namespace obvid {

constexpr CadFormat kAllCadFormats[] = {CadFormat::kStepAp214, CadFormat::kStepAp242,
                                        CadFormat::kIges, CadFormat::kBrep};

/// Files of faces in a folder of their own; skipped where the helper is not built.
class FaceFiles : public testing::Test {
 protected:
  void SetUp() override {
    if (kCadIsMissing) GTEST_SKIP() << kCadMissing;
    std::string pattern = (std::filesystem::temp_directory_path() / "obvid-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  std::filesystem::path written(const SurfaceModel& model, CadFormat format) {
    CadWriteOptions options;
    options.format = format;
    const auto text = cad_surface_text(model, options);
    EXPECT_TRUE(text) << model.name << to_line(text.error());
    const char* ending = format == CadFormat::kBrep   ? ".brep"
                         : format == CadFormat::kIges ? ".igs"
                                                      : ".step";
    std::filesystem::path file = folder_ / (model.name + ending);
    std::ofstream(file, std::ios::binary) << (text ? *text : std::string{});
    return file;
  }

  std::filesystem::path folder_;
};

inline std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

}  // namespace obvid
