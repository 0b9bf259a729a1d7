// SPDX-License-Identifier: Apache-2.0
// Proves a contour file again from its numbers. Without a file: forms a contour, stores it as text,
// proves what was read back, and shows that a claim which is not true is refused.
// usage: verify_file [CONTOUR.json]
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "obvid/io/contour_json.h"
#include "obvid/io/read_points.h"
#include "obvid/pipeline/fit.h"

namespace {

bool holds(const obvid::StoredContour& stored) {
  const obvid::Verification found = obvid::verify(stored);
  if (found.false_claim) {
    std::printf("refused: %s\n", obvid::to_line(*found.false_claim).c_str());
    return false;
  }
  std::printf("%s\n", found.certificate.proved ? "proved" : found.certificate.reason.c_str());
  return found.certificate.proved;
}

int check_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto stored = obvid::contour_from_json(text, path);
  if (!stored) {
    std::fprintf(stderr, "%s\n", obvid::to_line(stored.error()).c_str());
    return 1;
  }
  return holds(*stored) ? 0 : 1;
}

int check_own() {
  const auto series = obvid::parse_points("0 0\n1 0.1\n2 0.5\n3 1.3\n4 2.7\n", "inline");
  const auto fit = series ? obvid::fit(*series, {}) : tl::unexpected(series.error());
  if (!fit) return 1;
  const std::string text = obvid::contour_to_json({fit->contour, fit->report, fit->certificate});
  auto stored = obvid::contour_from_json(text, "inline");
  if (!stored || !holds(*stored)) return 1;

  stored->report->largest_width *= 0.5;  // a better error than the contour has
  return holds(*stored) ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) { return argc > 1 ? check_file(argv[1]) : check_own(); }
