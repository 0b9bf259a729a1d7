// SPDX-License-Identifier: Apache-2.0
#include "text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obvid {

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
  constexpr double kPlainTo = 1e5;  // beyond, whole numbers would say more digits than are known
  if (kappa == 0.0) return "straight";
  const double radius = 1.0 / kappa;
  const bool large = std::isfinite(radius) && std::abs(radius) >= kPlainTo;
  return large ? fmt::format("{:.4e}", radius) : significant(radius);
}

std::string radius_over(double kappa, double length, double within) {
  const double sagitta = std::abs(kappa) * length * length / 8.0;
  const bool straight = length > 0.0 && sagitta <= within;  // from a point around to it no line is
  return radius_text(straight ? 0.0 : kappa);
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
