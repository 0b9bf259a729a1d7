// SPDX-License-Identifier: Apache-2.0
#include "obvid/mesh/plane_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>
#include <vector>

namespace obvid {
namespace {

/// Finite numbers between colons; empty when one is none.
std::vector<double> numbers_of(std::string_view text) {
  std::vector<double> out;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(':', at), text.size());
    double value = 0.0;
    const auto read = std::from_chars(text.data() + at, text.data() + end, value);
    if (read.ec != std::errc{} || read.ptr != text.data() + end || !std::isfinite(value)) return {};
    out.push_back(value);
    at = end + 1;
  }
  return out;
}

}  // namespace

std::size_t PlaneRow::count() const {
  constexpr double kPartOfStep = 1e-9;  // of a step: 0:0.1:1 has eleven planes
  return static_cast<std::size_t>(std::floor((to - from) / step + kPartOfStep)) + 1;
}

Result<PlaneRow> plane_row_named(const std::string& text) {
  const Error wrong{ErrorCode::kBadOption, "'" + text + "' names no planes", "--cut",
                    "write z=FROM:STEP:TO, z=0:0.5:100, or z=12 for one plane"};
  if (text.size() < 3 || text[1] != '=' || text[0] < 'x' || text[0] > 'z') return fail(wrong);
  const std::vector<double> numbers = numbers_of(std::string_view(text).substr(2));
  PlaneRow out;
  out.axis = text[0];
  constexpr double kMostPlanes = 1e7;
  if (numbers.size() == 1) {
    out.from = out.to = numbers[0];
    return out;
  }
  if (numbers.size() != 3) return fail(wrong);
  out.from = numbers[0];
  out.step = numbers[1];
  out.to = numbers[2];
  if (!(out.step > 0.0) || out.to < out.from || !((out.to - out.from) / out.step <= kMostPlanes)) {
    return fail(wrong);
  }
  return out;
}

std::string plane_name(char axis, double at) { return fmt::format("{}={:.12g}", axis, at); }

Frame plane_across(char axis, double at) {
  switch (axis) {
    case 'x':
      return {{at, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    case 'y':
      return {{0, at, 0}, {0, 0, 1}, {1, 0, 0}};
    default:
      return {{0, 0, at}, {1, 0, 0}, {0, 1, 0}};
  }
}

}  // namespace obvid
