// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/result.h"

int main() {
  const obvid::Result<int> refused = obvid::fail({obvid::ErrorCode::kUsage, "told so", "", ""});
  return refused.has_value() ? 1 : 0;
}
