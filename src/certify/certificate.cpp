// SPDX-License-Identifier: Apache-2.0
#include "obvid/certify/certificate.h"

namespace obvid {

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::kIncreasing:
      return "increasing";
    case Verdict::kDecreasing:
      return "decreasing";
    case Verdict::kConstant:
      return "constant";
    case Verdict::kHasVertex:
      return "has-vertex";
    case Verdict::kUndecided:
      return "undecided";
  }
  return "undecided";
}

}  // namespace obvid
