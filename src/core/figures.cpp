// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obvid {

std::string significant(double value, int digits) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value < 0.0 ? "-inf" : "inf";
  if (value == 0.0) return "0";
  constexpr double kPlainFrom = 1e-4;  // smaller and larger sizes get an exponent
  constexpr double kPlainTo = 1e7;
  const double size = std::fabs(value);
  if (size < kPlainFrom || size >= kPlainTo) return fmt::format("{:.{}e}", value, digits - 1);
  const int before = static_cast<int>(std::floor(std::log10(size))) + 1;
  return fmt::format("{:.{}f}", value, std::clamp(digits - before, 0, digits + 3));
}

namespace {

/// A number as `significant` shows it, and so many units of its last digit beside it. The last
/// digit is the last one that is shown: more of them than asked for may be.
std::string units_beside(const std::string& text, double units, int digits) {
  const std::size_t power = text.find('e'), point = text.find('.');
  const std::size_t end = std::min(power, text.size());
  const auto decimals = point < end ? static_cast<int>(end - point) - 1 : 0;
  const int exponent = power < text.size() ? std::stoi(text.substr(power + 1)) : 0;
  return significant(std::stod(text) + units * std::pow(10.0, exponent - decimals), digits);
}

}  // namespace

std::string significant_above(double bound, int digits) {
  const std::string text = significant(bound, digits);
  if (!(bound > 0.0) || !std::isfinite(bound) || std::stod(text) >= bound) return text;
  return units_beside(text, 1.0, digits);
}

std::string significant_below(double limit, int digits) {
  const std::string text = significant(limit, digits);
  if (!(limit > 0.0) || !std::isfinite(limit) || std::stod(text) < limit) return text;
  return units_beside(text, -1.0, digits);
}

std::string tolerance_text(double tolerance) {
  constexpr int kTypedDigits = 6;
  std::string text = fmt::format("{:.{}g}", tolerance, kTypedDigits);
  return std::stod(text) >= tolerance ? text : significant_above(tolerance, kTypedDigits);
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string and_more(std::size_t all, std::size_t named) {
  return all > named ? fmt::format(" and {} more", all - named) : std::string();
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace obvid
