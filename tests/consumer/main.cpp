// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "obvid/core/error.h"
#include "obvid/core/version.h"

int main() {
  std::printf("obvid %s knows %zu errors\n", obvid::kVersion, obvid::error_texts().size());
  return obvid::error_texts().empty() ? 1 : 0;
}
