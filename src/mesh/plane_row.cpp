// SPDX-License-Identifier: Apache-2.0
#include "obvid/mesh/plane_row.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "obvid/core/internal/typed_numbers.h"

namespace obvid {
std::size_t PlaneRow::count() const {
  constexpr double kPartOfStep = 1e-9;  // of a step: 0:0.1:1 has eleven planes
  return static_cast<std::size_t>(std::floor((to - from) / step + kPartOfStep)) + 1;
}

Result<PlaneRow> plane_row_named(const std::string& text) {
  const Error wrong{ErrorCode::kBadOption, "'" + text + "' names no planes", "--cut",
                    "write z=FROM:STEP:TO, z=0:0.5:100, or z=12 for one plane"};
  if (text.size() < 3 || text[1] != '=' || text[0] < 'x' || text[0] > 'z') return fail(wrong);
  const auto typed = typed_numbers(std::string_view(text).substr(2), ':');
  if (!typed) return fail(wrong);
  const std::vector<double>& numbers = *typed;
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
