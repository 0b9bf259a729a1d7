// SPDX-License-Identifier: Apache-2.0
#include "svg/read_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "obvid/core/internal/inch.h"
#include "obvid/geom/internal/angle.h"
#include "svg/path_data.h"
#include "xml_text.h"

namespace obvid::exchange {
namespace {

using std::string_view;

constexpr std::size_t kMostArguments = 6;

/// Arguments in parentheses; nothing where they have an error.
std::optional<std::vector<double>> arguments(SvgScanner& in) {
  std::vector<double> out;
  in.skip_blanks();
  if (in.peek() != '(') return std::nullopt;
  in.skip();
  in.skip_blanks();
  while (in.peek() != ')') {
    const auto value = in.number();
    if (!value || out.size() == kMostArguments) return std::nullopt;
    out.push_back(*value);
    const bool comma = in.skip_separator();
    if (comma && in.peek() == ')') return std::nullopt;
  }
  in.skip();
  return out;
}

Affine rotation(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c, s, -s, c, 0.0, 0.0};
}

std::optional<Affine> function(string_view name, const std::vector<double>& v) {
  const std::size_t count = v.size();
  if (name == "matrix" && count == 6) return Affine{v[0], v[1], v[2], v[3], v[4], v[5]};
  if (name == "translate" && (count == 1 || count == 2)) {
    return Affine{1.0, 0.0, 0.0, 1.0, v[0], count == 2 ? v[1] : 0.0};
  }
  if (name == "scale" && (count == 1 || count == 2)) {
    return Affine{v[0], 0.0, 0.0, count == 2 ? v[1] : v[0], 0.0, 0.0};
  }
  if (name == "rotate" && count == 1) return rotation(kOneDegree * v[0]);
  if (name == "rotate" && count == 3) {
    return Affine{1.0, 0.0, 0.0, 1.0, v[1], v[2]} * rotation(kOneDegree * v[0]) *
           Affine{1.0, 0.0, 0.0, 1.0, -v[1], -v[2]};
  }
  if (name == "skewX" && count == 1)
    return Affine{1.0, 0.0, std::tan(kOneDegree * v[0]), 1.0, 0, 0};
  if (name == "skewY" && count == 1)
    return Affine{1.0, std::tan(kOneDegree * v[0]), 0.0, 1.0, 0, 0};
  return std::nullopt;
}

/// Part of the free room that lies before the content: 0, 1/2 or 1.
double alignment(string_view align, string_view axis) {
  const std::size_t at = align.find(axis);
  const string_view word = at == string_view::npos ? string_view{} : align.substr(at + 1, 3);
  return word == "Min" ? 0.0 : word == "Max" ? 1.0 : 0.5;
}

}  // namespace

std::optional<double> svg_length(string_view text, SvgAxis axis, const SvgViewport& viewport) {
  static constexpr std::array<std::pair<string_view, double>, 8> kPixels = {
      {{"", 1.0},
       {"px", 1.0},
       {"mm", 96.0 / kMmPerInch},
       {"cm", 96.0 / 2.54},
       {"Q", 24.0 / kMmPerInch},
       {"in", 96.0},
       {"pt", 96.0 / 72.0},
       {"pc", 16.0}}};
  SvgScanner in(text);
  in.skip_blanks();
  const auto value = in.number();
  if (!value) return std::nullopt;
  if (in.peek() == '%') {
    in.skip();
    in.skip_blanks();
    if (!in.at_end()) return std::nullopt;
    const double diagonal = std::hypot(viewport.width, viewport.height) / std::numbers::sqrt2;
    const double whole = axis == SvgAxis::kX   ? viewport.width
                         : axis == SvgAxis::kY ? viewport.height
                                               : diagonal;
    return 0.01 * *value * whole;
  }
  const string_view unit = in.word();
  in.skip_blanks();
  if (!in.at_end()) return std::nullopt;
  for (const auto& [name, pixels] : kPixels) {
    if (unit == name) return *value * pixels;
  }
  return std::nullopt;
}

std::optional<Affine> svg_transform(string_view text) {
  Affine all;
  SvgScanner in(text);
  in.skip_blanks();
  while (!in.at_end()) {
    const string_view name = in.word();
    const auto values = arguments(in);
    const auto one = values ? function(name, *values) : std::nullopt;
    if (!one) return std::nullopt;
    all = all * *one;
    if (in.skip_separator() && in.at_end()) return std::nullopt;
  }
  return all;
}

std::optional<SvgViewBox> svg_view_box(string_view text) {
  SvgScanner in(text);
  std::array<double, 4> v{};
  in.skip_blanks();
  for (double& one : v) {
    const auto value = in.number();
    if (!value) return std::nullopt;
    one = *value;
    in.skip_separator();
  }
  if (!in.at_end() || !(v[2] > 0.0) || !(v[3] > 0.0)) return std::nullopt;
  return SvgViewBox{v[0], v[1], v[2], v[3]};
}

Affine svg_fit(const SvgViewBox& box, Vec2 corner, const SvgViewport& size, string_view preserve) {
  double x = size.width / box.width, y = size.height / box.height;
  if (preserve.find("none") == string_view::npos) {
    const bool slice = preserve.find("slice") != string_view::npos;
    x = y = slice ? std::max(x, y) : std::min(x, y);
  }
  const double right = alignment(preserve, "x") * (size.width - x * box.width);
  const double down = alignment(preserve, "Y") * (size.height - y * box.height);
  return {x, 0.0, 0.0, y, corner.x + right - x * box.x, corner.y + down - y * box.y};
}

}  // namespace obvid::exchange
