// SPDX-License-Identifier: Apache-2.0
#include "checks.h"

#include <fmt/format.h>

#include <cmath>

#include "obvid/core/result.h"

namespace obvid::idspline {
namespace {

std::string place(std::string_view name, std::size_t i) {
  return fmt::format("{} {}", name, i + 1);
}

std::optional<Error> refuse_infinite(std::span<const double> data, std::string_view name,
                                     const Error& error) {
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (std::isfinite(data[i])) continue;
    Error out = error;
    out.where = place(name, i);
    out.index = static_cast<std::ptrdiff_t>(i);
    out.value = data[i];
    return out;
  }
  return std::nullopt;
}

constexpr const char* kOtherUnit = "change the unit so that sizes are usual numbers";

}  // namespace

std::optional<Error> refuse_nodes(std::span<const double> nodes, std::string_view name) {
  if (nodes.size() < 2) {
    return error(ErrorCode::kTooFewPoints, fmt::format("a spline needs at least two {}s", name))
        .hint("add data")
        .value(static_cast<double>(nodes.size()));
  }
  const Error infinite =
      error(ErrorCode::kNotFinite, "a place is not a finite number").hint("remove or repair it");
  if (auto error = refuse_infinite(nodes, name, infinite)) return error;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const double h = nodes[i] - nodes[i - 1];
    const auto index = static_cast<std::ptrdiff_t>(i);
    if (!(h > 0.0)) {
      return error(ErrorCode::kOutOfOrder, fmt::format("{}s must ascend", name))
          .where(place(name, i))
          .hint("sort them, and keep one of those that coincide")
          .point(index)
          .value(h);
    }
    if (!(std::isfinite(h) && std::isfinite(1.0 / h))) {
      return error(ErrorCode::kSizeOutOfRange, "a step leaves the range of numbers")
          .where(place(name, i))
          .hint(kOtherUnit)
          .point(index)
          .value(h);
    }
  }
  return std::nullopt;
}

std::optional<Error> refuse_data(std::span<const double> data, std::size_t expected,
                                 std::string_view name) {
  if (data.size() != expected) {
    return error(ErrorCode::kUsage,
                 fmt::format("{} {}s given, {} expected", data.size(), name, expected))
        .hint("give one per node, integrals one per cell")
        .value(static_cast<double>(data.size()));
  }
  return refuse_infinite(
      data, name,
      error(ErrorCode::kNotFinite, fmt::format("a {} is not a finite number", name))
          .hint("remove or repair it"));
}

std::optional<Error> refuse_overflow(std::span<const double> result, std::string_view name) {
  return refuse_infinite(result, name,
                         error(ErrorCode::kSizeOutOfRange,
                               fmt::format("a {} of the spline leaves the range of numbers", name))
                             .hint(kOtherUnit));
}

}  // namespace obvid::idspline
