// SPDX-License-Identifier: Apache-2.0
#include "text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obvid {

std::string significant(double value, int digits) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value < 0.0 ? "-inf" : "inf";
  if (value == 0.0) return "0";
  constexpr double kPlainFrom = 1e-4;
  constexpr double kPlainTo = 1e7;
  const double size = std::fabs(value);
  if (size < kPlainFrom || size >= kPlainTo) return fmt::format("{:.{}e}", value, digits - 1);
  const int before = static_cast<int>(std::floor(std::log10(size))) + 1;
  return fmt::format("{:.{}f}", value, std::clamp(digits - before, 0, digits + 3));
}

std::string coordinate(double value, double size) {
  constexpr double kResolution = 1e-6;  // of the size
  constexpr int kMostDecimals = 15;
  if (!(size > 0.0) || !std::isfinite(value)) return significant(value);
  const double digits = std::ceil(-std::log10(kResolution * size));
  const int decimals = static_cast<int>(std::clamp<double>(digits, 0.0, kMostDecimals));
  const bool nothing = std::abs(value) < 0.5 * std::pow(10.0, -decimals);
  return fmt::format("{:.{}f}", nothing ? 0.0 : value, decimals);
}

std::string radius_text(double kappa) {
  return kappa == 0.0 ? "straight" : significant(1.0 / kappa);
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

const char* direction_text(int direction) {
  return direction > 0 ? "increasing" : direction < 0 ? "decreasing" : "constant";
}

void Facts::add(std::string label, std::string value) {
  lines_.emplace_back(std::move(label), std::move(value));
}

std::string Facts::text() const {
  std::size_t width = 0;
  for (const auto& [label, value] : lines_) width = std::max(width, label.size());
  std::string out;
  for (const auto& [label, value] : lines_) {
    out += fmt::format("{:<{}}  {}\n", label, width, value);
  }
  return out;
}

}  // namespace obvid
