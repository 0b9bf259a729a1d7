// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

namespace obvid::test {

/// How many of the cases of a sweep run: all of them when OBVID_LONG_TESTS is set, else one in
/// `every`, so that a usual run of the tests stays short.
inline int cases_of(int all, int every) {
  return std::getenv("OBVID_LONG_TESTS") != nullptr ? all : all / every;
}

}  // namespace obvid::test
