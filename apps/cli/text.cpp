// SPDX-License-Identifier: Apache-2.0
#include "text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

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

Result<std::string> read_text(const std::string& path) {
  const auto cannot = [&path](const std::string& why) {
    return fail({ErrorCode::kCannotOpen, "cannot read the file: " + why, path,
                 "check the path and the permissions"});
  };
  std::error_code ignored;
  if (path != "-" && std::filesystem::is_directory(path, ignored)) return cannot("it is a folder");
  struct Closer {
    void operator()(std::FILE* file) const {
      if (file != stdin) std::fclose(file);
    }
  };
  const std::unique_ptr<std::FILE, Closer> file(path == "-" ? stdin
                                                            : std::fopen(path.c_str(), "rb"));
  if (!file) return cannot(std::strerror(errno));
  constexpr std::size_t kBlock = 1U << 16U;
  std::string text;
  std::size_t got = 0;
  do {
    text.resize(text.size() + kBlock);
    got = std::fread(text.data() + text.size() - kBlock, 1, kBlock, file.get());
    text.resize(text.size() - kBlock + got);
  } while (got == kBlock);
  if (std::ferror(file.get()) != 0) return cannot(std::strerror(errno));
  return text;
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
