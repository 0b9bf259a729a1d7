// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "../common/output_folder.h"

namespace obvid {

/// A folder of its own for each test, and programs in it.
class TestFolder : public OutputFolder {
 protected:
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
};

}  // namespace obvid
