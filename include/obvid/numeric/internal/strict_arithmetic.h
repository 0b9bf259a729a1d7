// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cfloat>
#include <limits>

// For every source whose results are proofs or bounds: their errors are counted operation by
// operation, each rounded once to the nearest double. What can be seen while compiling is refused
// here, the rest (rounding mode, options of which compilers tell nothing) when a proof begins.

#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || defined(__ASSOCIATIVE_MATH__) || \
    defined(__RECIPROCAL_MATH__)
#error "proofs cannot be compiled with options that allow other results than those written down"
#endif
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "proofs cannot be compiled with -ffinite-math-only: they look for infinities and NaNs"
#endif
static_assert(FLT_EVAL_METHOD == 0, "doubles must be computed as doubles (no x87 arithmetic)");
static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53,
              "doubles must be those of IEEE 754");

// No product may be fused with a sum. GCC knows no pragma for it: the build's option says it.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#endif

// Internal linkage here as in all headers of exact arithmetic: what a program links beside the
// library, compiled with its own options, must not be able to take the place of this code.
namespace obvid {
namespace {

/// What is wrong with the arithmetic of this thread and of the source that includes this; null
/// when every operation is rounded once to the nearest double. Numbers below 2^-1022 may be taken
/// for 0: the bounds of errors allow for that.
[[nodiscard]] inline const char* fault_of_arithmetic() {
  volatile double given_one = 1.0;  // volatile: computed here and now, not by the compiler
  volatile double given_tiny = 0x1p-54;
  volatile double given_above = 1.0 + 0x1p-27;  // its square is 1 + 2^-26 and a quarter of an ulp
  const double one = given_one, tiny = given_tiny, above = given_above;
  const double sum = one + tiny;
  if (sum - one == tiny) return "sums are computed in wider registers or in another order";
  if (sum != one || one - 0.5 * tiny != one) {  // 2^-55: a quarter of the ulp below 1
    return "the processor does not round to the nearest number";
  }
  if (above * above - (1.0 + 0x1p-26) != 0.0) {
    return "products and sums are fused; build without contraction";
  }
  return nullptr;
}

// Those of the standard library are functions that a linker may replace.
[[nodiscard]] constexpr bool is_nan(double value) { return value != value; }
[[nodiscard]] constexpr bool is_finite(double value) {
  return value >= std::numeric_limits<double>::lowest() &&
         value <= std::numeric_limits<double>::max();
}

}  // namespace
}  // namespace obvid
