// SPDX-License-Identifier: Apache-2.0
#include "advice/uniform_tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "fit/prepare.h"

namespace obvid::pipeline_detail {

Result<Fit> fit_within(const PointSeries& series, FitJob job, double tolerance, Watch& watch) {
  job.noise = tolerance;
  job.noise_from_rounding = false;
  job.noise_from_scatter = false;
  PointSeries allowed = series;
  for (FixedData& data : allowed.fixed) {
    if (data.tolerance && *data.tolerance < tolerance) data.tolerance.reset();
  }
  return fit(allowed, job, watch);
}

FitJob with_closing(const PointSeries& series, FitJob job) {
  const auto prepared = prepare(series, job);
  if (prepared) job.closing = prepared->closed ? Closing::kClosed : Closing::kOpen;
  return job;
}

double coordinate_rounding(const PointSeries& series) {
  constexpr double kRoundings = 32.0;  // twice what `prepare` takes for no move at all
  double largest = 0.0;
  for (const Vec2 p : series.points) largest = std::max(largest, std::abs(p.x) + std::abs(p.y));
  return kRoundings * 0x1p-53 * largest;
}

double printable(double tolerance) {
  if (!(tolerance > 0.0) || !std::isfinite(tolerance)) return tolerance;
  constexpr double kStep = 0.01;  // of the first digit
  const double unit = kStep * std::pow(10.0, std::floor(std::log10(tolerance)));
  constexpr double kRounding = 1e-9;  // of a step: a tolerance of three digits stays what it is
  // through text, so that the double is the one that the printed digits mean
  const std::string text = fmt::format("{:.2e}", std::ceil(tolerance / unit - kRounding) * unit);
  return std::strtod(text.c_str(), nullptr);
}

}  // namespace obvid::pipeline_detail
