// SPDX-License-Identifier: Apache-2.0
#include "matrix_names.h"

#include <cctype>
#include <filesystem>
#include <string_view>
#include <vector>

namespace obvid {
namespace {

constexpr std::string_view kAxisLetters = "xyz", kSeparators = "_-. ";

bool parts(char c) { return kSeparators.find(c) != std::string_view::npos; }

/// All letters x, y, z that stand by themselves in the name without its ending.
std::vector<MatrixName> candidates(const std::string& path) {
  const std::filesystem::path file(path);
  const std::string stem = file.stem().string(), ending = file.extension().string();
  const std::string folder = path.substr(0, path.size() - file.filename().string().size());
  std::vector<MatrixName> out;
  for (std::size_t i = 0; i < stem.size(); ++i) {
    const char small = static_cast<char>(std::tolower(static_cast<unsigned char>(stem[i])));
    const std::size_t axis = kAxisLetters.find(small);
    const bool alone =
        (i == 0 || parts(stem[i - 1])) && (i + 1 == stem.size() || parts(stem[i + 1]));
    if (axis == std::string_view::npos || !alone) continue;
    out.push_back(
        {folder + stem.substr(0, i), stem.substr(i + 1) + ending, axis, small != stem[i]});
  }
  return out;
}

std::size_t others_there(const MatrixName& name) {
  std::size_t count = 0;
  for (std::size_t axis = 0; axis < kAxisLetters.size(); ++axis) {
    std::error_code ignored;
    count += axis != name.axis && std::filesystem::exists(name.path(axis), ignored) ? 1 : 0;
  }
  return count;
}

}  // namespace

std::string MatrixName::path(std::size_t of_axis) const {
  const char small = kAxisLetters[of_axis];
  const auto capital = static_cast<char>(std::toupper(static_cast<unsigned char>(small)));
  return before + (upper ? capital : small) + after;
}

std::string MatrixName::common_name() const {
  std::string left = std::filesystem::path(before + "x").stem().string();
  left.pop_back();
  while (!left.empty() && parts(left.back())) left.pop_back();
  std::string right = std::filesystem::path("x" + after).stem().string().substr(1);
  if (left.empty()) {
    while (!right.empty() && parts(right.front())) right.erase(0, 1);
  }
  return left + right;
}

std::optional<MatrixName> matrix_with_siblings(const std::string& path) {
  std::optional<MatrixName> best;
  std::size_t most = 0;
  const auto by_ending = matrix_by_ending(path);
  for (const MatrixName& name : candidates(path)) {
    const std::size_t there = others_there(name);
    const bool ends = by_ending && by_ending->same_grid(name);
    if (there < (ends ? 1U : 2U) || there < most) continue;
    most = there;
    best = name;
  }
  return best;
}

std::optional<MatrixName> matrix_by_ending(const std::string& path) {
  const auto all = candidates(path);
  if (all.empty()) return std::nullopt;
  const MatrixName& last = all.back();
  const std::string ending = std::filesystem::path(path).extension().string();
  const bool ends = last.after == ending && last.before.ends_with('_');
  return ends ? std::optional(last) : std::nullopt;
}

std::optional<MatrixName> lonely_matrix(const std::string& path) {
  if (matrix_with_siblings(path)) return std::nullopt;
  constexpr std::size_t kZ = 2;  // heights may well be called z
  for (const MatrixName& name : candidates(path)) {
    const bool inside = name.before.ends_with('_') && name.after.starts_with('_');
    if (inside && name.axis != kZ) return name;
  }
  return matrix_by_ending(path);
}

}  // namespace obvid
