// SPDX-License-Identifier: Apache-2.0
// Any bytes give points or an error, and points keep what read_points.h promises.
#include "obvid/io/read_points.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "promise.h"

using obvid::require;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto series = obvid::parse_points({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!series) {
    // a point that stands twice may have two headings or two radii
    require(series.error().code == obvid::ErrorCode::kFixedDataContradict ||
            obvid::exit_code(series.error().code) == 3);
    require(!series.error().what.empty() && !series.error().where.empty());
    return 0;
  }
  require(series->points.size() >= 2);
  if (series->points.size() == 2) {
    const auto heading = [](const obvid::FixedData& data) { return data.theta || data.thetas; };
    require(series->fixed.size() == 2 && heading(series->fixed[0]) && heading(series->fixed[1]));
  }
  require(series->fixed.empty() || series->fixed.size() == series->points.size());
  for (std::size_t i = 0; i < series->points.size(); ++i) {
    require(std::isfinite(series->points[i].x) && std::isfinite(series->points[i].y));
    require(i == 0 || series->points[i] != series->points[i - 1]);
  }
  for (const obvid::FixedData& fixed : series->fixed) {
    require(!fixed.theta || std::isfinite(*fixed.theta));
    require(!fixed.kappa || std::isfinite(*fixed.kappa));
    require(!fixed.tolerance || *fixed.tolerance >= 0.0);
  }
  return 0;
}
