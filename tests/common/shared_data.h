// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace obvid {

/// Folder of the public data sets: the environment decides before the build.
inline std::filesystem::path shared_data() {
  const char* const folder = std::getenv("OBVID_SHARED_DATA");
  return folder != nullptr ? std::filesystem::path(folder)
                           : std::filesystem::path(OBVID_SHARED_DATA);
}

}  // namespace obvid

#define SKIP_WITHOUT(set)                                                   \
  if (!std::filesystem::exists(obvid::shared_data() / (set))) {             \
    GTEST_SKIP() << "the public data sets are missing (OBVID_SHARED_DATA)"; \
  }
