// SPDX-License-Identifier: Apache-2.0
// Names of views and colourings, numbers for reading, and texts that come from files.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "page/values.h"

namespace obvid {
namespace {

constexpr std::string_view kColourings[] = {"shaded",     "isolines", "gaussian", "mean",
                                            "k1",         "k2",       "zebra",    "isophotes",
                                            "reflection", "deviation"};
constexpr std::string_view kViews[] = {"iso", "front", "top", "side", "back", "bottom"};

template <class T, std::size_t n>
std::optional<T> named(const std::string_view (&names)[n], std::string_view name) {
  for (std::size_t i = 0; i < n; ++i) {
    if (names[i] == name) return static_cast<T>(i);
  }
  return std::nullopt;
}

unsigned byte_of(char c) { return static_cast<unsigned char>(c); }

/// Bytes of the UTF-8 character that begins the text; 0 where none does.
std::size_t character(std::string_view text) {
  const unsigned lead = byte_of(text[0]);
  const std::size_t length = lead < 0x80U                    ? 1
                             : lead >= 0xC2U && lead < 0xE0U ? 2
                             : lead >= 0xE0U && lead < 0xF0U ? 3
                             : lead >= 0xF0U && lead < 0xF5U ? 4
                                                             : 0;
  if (length == 0 || text.size() < length) return 0;
  std::uint32_t code = lead & (0xFFU >> (length == 1 ? 1U : length + 1U));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_of(text[i]) & 0xC0U) != 0x80U) return 0;
    code = (code << 6U) | (byte_of(text[i]) & 0x3FU);
  }
  static constexpr std::array<std::uint32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800U && code < 0xE000U;
  const bool none = code == 0xFFFEU || code == 0xFFFFU || code > 0x10FFFFU;
  return code < kLeast[length] || surrogate || none ? 0 : length;
}

}  // namespace

bool is_curvature(SurfaceColouring colouring) {
  switch (colouring) {
    case SurfaceColouring::kGaussian:
    case SurfaceColouring::kMean:
    case SurfaceColouring::kK1:
    case SurfaceColouring::kK2:
      return true;
    default:
      return false;
  }
}

const Range& CurvatureExtremes::of(SurfaceColouring colouring) const {
  switch (colouring) {
    case SurfaceColouring::kMean:
      return mean;
    case SurfaceColouring::kK1:
      return k1;
    case SurfaceColouring::kK2:
      return k2;
    default:
      return gaussian;
  }
}

std::string_view name_of(SurfaceColouring colouring) {
  return kColourings[static_cast<std::size_t>(colouring)];
}
std::string_view name_of(SurfaceView view) { return kViews[static_cast<std::size_t>(view)]; }
std::optional<SurfaceColouring> colouring_named(std::string_view name) {
  return named<SurfaceColouring>(kColourings, name);
}
std::optional<SurfaceView> surface_view_named(std::string_view name) {
  return named<SurfaceView>(kViews, name);
}

namespace picture {

std::string plain_text(std::string_view text) {
  static constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
  std::string out;
  while (!text.empty()) {
    const std::size_t length = character(text);
    if (length == 0) {
      out += kReplacement;
    } else if (length > 1 || (byte_of(text[0]) >= 0x20U && text[0] != 0x7F)) {
      out += text.substr(0, length);
    } else {
      out += ' ';
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out;
}

std::string readable(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return value == 0.0 ? "0" : "∞";
  /// Sizes between these are written without a power of ten.
  constexpr double kPlainValueFrom = 1e-3, kPlainTo = 1e6;
  const double size = std::abs(value);
  const std::string sign = value < 0.0 ? "−" : "";
  std::string rounded = fmt::format("{:.{}e}", size, digits - 1);
  const std::size_t e = rounded.find('e');
  const int power = std::stoi(rounded.substr(e + 1));
  std::string text = size >= kPlainValueFrom && size < kPlainTo
                         ? fmt::format("{:.{}f}", size, std::max(0, digits - 1 - power))
                         : rounded.substr(0, e);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  if (size >= kPlainValueFrom && size < kPlainTo) return sign + text;
  static constexpr std::array kFigures = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string raised = power < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(power))) {
    raised += kFigures[static_cast<std::size_t>(c - '0')];
  }
  return sign + text + "·10" + raised;
}

std::string size_text(Vec3 size, const std::string& units) {
  constexpr int kDigits = 4;
  constexpr double kUnseenSize = 1e-9;  // of the whole: what is smaller is rounding
  const double nothing = kUnseenSize * norm(size);
  const auto edge = [&](double a) { return readable(a > nothing ? a : 0.0, kDigits); };
  return edge(size.x) + " × " + edge(size.y) + " × " + edge(size.z) + " " + units;
}

}  // namespace picture
}  // namespace obvid
