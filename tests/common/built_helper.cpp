// SPDX-License-Identifier: Apache-2.0
// Test programs lie one folder below the helper `obvid-cad` that was built with them.
#include <cstdlib>

namespace {

[[maybe_unused]] const int kNamed = ::setenv("OBVID_PLUGINS", OBVID_BUILD_FOLDER, 0);

}  // namespace
