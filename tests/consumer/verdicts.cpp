// SPDX-License-Identifier: Apache-2.0
// Prints one line about COUNT verdicts; the line must not depend on the options of this file.
// usage: verdicts COUNT
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "hostile_conics.h"
#include "installed_headers.h"

namespace {

/// Addresses of what does the library's plane geometry, so that this program has copies of its own.
double use_geometry(double x) {
  double (*volatile crossed)(obvid::Vec2, obvid::Vec2) = &obvid::cross;
  double (*volatile dotted)(obvid::Vec2, obvid::Vec2) = &obvid::dot;
  double (*volatile length)(obvid::Vec2) = &obvid::norm;
  double (*volatile turned)(obvid::Vec2, obvid::Vec2) = &obvid::turning;
  const obvid::Vec2 a{x, 1.0}, b{1.0, x};
  return crossed(a, b) + dotted(a, b) + length(a - b) + turned(a, b);
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 200000;
  std::uint64_t mark = 14695981039346656037ull;  // FNV-1a over all verdicts
  long counts[5] = {};
  long exact = 0;
  for (const obvid::RationalBezier& conic : hostile_conics(count)) {
    const obvid::PieceProof proof = obvid::prove_piece(conic);
    const auto verdict = static_cast<unsigned>(proof.verdict);
    ++counts[verdict];
    exact += proof.exact_arithmetic ? 1 : 0;
    mark = (mark ^ (2 * verdict + (proof.exact_arithmetic ? 1u : 0u))) * 1099511628211ull;
  }
  const bool used = use_geometry(static_cast<double>(counts[0])) != 0.5;
  std::printf(
      "%ld increasing, %ld decreasing, %ld with a vertex, %ld others, %ld beyond doubles, "
      "mark %016llx%s\n",
      counts[0], counts[1], counts[3], counts[2] + counts[4], exact,
      static_cast<unsigned long long>(mark), used ? "" : ".");
  return counts[3] > count / 10 && counts[0] + counts[1] > count / 10 ? 0 : 1;
}
