// SPDX-License-Identifier: Apache-2.0
#include "plane/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "obvid/core/internal/figures.h"

namespace obvid {
namespace {

/// A tick within this part of a step beyond the range still counts as inside (rounding only).
constexpr double kTickSlack = 1e-9;
/// Decades up to which a logarithmic axis also labels 2 and 5.
constexpr double kFewDecades = 3.2;
/// Numbers between these are written without a power of ten.
constexpr double kPlainFrom = 0.999e-4;
constexpr double kPlainTo = 1e6;
/// Steps and lowest ticks below this, a little under 0.001, are told by powers of ten.
constexpr double kPlainStep = 0.9e-3;
/// Most decades with a label each.
constexpr double kManyDecades = 7.0;

std::string raised(int number) {
  static constexpr std::array<const char*, 10> kFigures = {"⁰", "¹", "²", "³", "⁴",
                                                           "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(number))) {
    text += kFigures[static_cast<std::size_t>(c - '0')];
  }
  return text;
}

double step_for(double range, int wanted) {
  const double rough = range / wanted;
  const double base = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (rough <= factor * base * (1.0 + kTickSlack)) return factor * base;
  }
  return 10.0 * base;
}

/// Power of ten that keeps labels short: 0 while plain decimals do.
int exponent_for(double largest, double step) {
  if (largest <= 0.0) return 0;
  if (largest < kPlainTo && step > kPlainStep) return 0;
  return 3 * static_cast<int>(std::floor(std::log10(largest) / 3.0));
}

std::string tick_label(double value, double step, int exponent) {
  const double unit = std::pow(10.0, exponent);
  const int decimals =
      std::clamp(static_cast<int>(std::ceil(-std::log10(step / unit) - kTickSlack)), 0, 9);
  const double shown = value / unit;
  std::string text = fmt::format("{:.{}f}", std::fabs(value) < 0.5 * step ? 0.0 : shown, decimals);
  if (text[0] == '-') text.replace(0, 1, "−");
  return text;
}

void add_ticks(PictureAxis& axis, double step) {
  const double first = std::ceil(axis.low / step - kTickSlack);
  const double last = std::floor(axis.high / step + kTickSlack);
  axis.exponent = exponent_for(std::max(std::fabs(axis.low), std::fabs(axis.high)), step);
  for (double k = first; k <= last; k += 1.0) {
    axis.ticks.push_back({k * step, tick_label(k * step, step, axis.exponent)});
  }
}

}  // namespace

double PictureAxis::place(double value) const {
  if (logarithmic) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

PictureAxis tight_axis(double low, double high, int wanted_ticks) {
  PictureAxis axis;
  axis.low = low;
  axis.high = high > low ? high : low + 1.0;
  add_ticks(axis, step_for(axis.high - axis.low, wanted_ticks));
  return axis;
}

PictureAxis round_axis(double low, double high, int wanted_ticks) {
  const double step = step_for(high - low, wanted_ticks);
  PictureAxis axis;
  axis.low = step * std::floor(low / step + kTickSlack);
  axis.high = step * std::ceil(high / step - kTickSlack);
  add_ticks(axis, step);
  return axis;
}

PictureAxis log_axis(double low, double high) {
  PictureAxis axis;
  axis.logarithmic = true;
  axis.low = low;
  axis.high = high;
  const double decades = std::log10(high / low);
  const int every = std::max(1, static_cast<int>(std::ceil(decades / kManyDecades)));
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::floor(std::log10(high)));
  const bool plain = low >= kPlainStep && high <= kPlainTo;
  axis.exponent =
      plain ? 0
            : 3 * static_cast<int>(std::floor(std::log10(std::sqrt(low) * std::sqrt(high)) / 3.0));
  for (int d = first; d <= last; ++d) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, d);
      if (value < low * (1.0 - kTickSlack) || value > high * (1.0 + kTickSlack)) continue;
      const bool labelled = factor == 1.0 ? (d - first) % every == 0 : decades < kFewDecades;
      const double shown = value / std::pow(10.0, axis.exponent);
      axis.ticks.push_back({value, labelled ? readable_number(shown, 3) : std::string{}});
    }
  }
  return axis;
}

double round_down(double value) {
  const double base = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * base <= value * (1.0 + kTickSlack)) return factor * base;
  }
  return base;
}

std::string readable_bound(double bound, int digits) {
  constexpr double kLastDigits = 1e-12;  // what rounding may have added is no reason for a digit
  const double least = bound * (1.0 - kLastDigits);
  if (least < kPlainTo) {
    return readable_number(std::stod(significant_above(least, digits)), digits);
  }
  const double unit = std::pow(10.0, std::floor(std::log10(least)) - digits + 1);
  return readable_number(std::ceil(least / unit) * unit, digits);
}

std::string readable_number(double value, int digits) {
  if (value == 0.0) return "0";
  if (!std::isfinite(value)) return std::isnan(value) ? "–" : "∞";
  const std::string sign = value < 0.0 ? "−" : "";
  const double size = std::fabs(value);
  if (size >= kPlainFrom && size < kPlainTo) {
    const int decimals = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(size))));
    std::string text = fmt::format("{:.{}f}", size, decimals);
    if (text.find('.') != std::string::npos) {
      text.erase(text.find_last_not_of('0') + 1);
      if (text.back() == '.') text.pop_back();
    }
    return sign + text;
  }
  int exponent = static_cast<int>(std::floor(std::log10(size)));
  std::string mantissa = fmt::format("{:.{}g}", size / std::pow(10.0, exponent), digits);
  if (mantissa == "10") {
    mantissa = "1";
    ++exponent;
  }
  return sign + (mantissa == "1" ? "" : mantissa + "·") + "10" + raised(exponent);
}

std::string power_prefix(int exponent) {
  return exponent == 0 ? std::string{} : "10" + raised(exponent) + " ";
}

}  // namespace obvid
