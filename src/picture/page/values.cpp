// SPDX-License-Identifier: Apache-2.0
#include "page/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "obvid/core/internal/parallel.h"

namespace obvid::picture {
namespace {

/// Parts of the area beyond both ends of the colours.
constexpr double kPercentile = 0.02;
/// Values that differ by less than this part of themselves are one value.
constexpr double kSameValue = 1e-4;
/// An end on the other side of 0 that is shorter than this part of the other counts as 0.
constexpr double kShortEnd = 0.02;
/// Curvatures below this divided by the size of the surface are those of a plane.
constexpr double kPlaneCurvature = 1e-9;
/// Deviations below this part of the size are none.
constexpr double kNoDeviation = 1e-12;
/// A derivative that would carry less far than this part of the size vanishes.
constexpr double kCollapsed = 1e-6;
/// How far from a pole curvatures are read, parts of the domain.
constexpr double kBeside[] = {1e-4, 1e-3, 1e-2};
/// Bound of curvatures (1/unit): their products stay within single precision.
constexpr double kMostCurvature = 1e18;

bool is_regular(const NurbsSurface& surface, const SurfaceJet& jet, double size) {
  const double least = kCollapsed * size;
  return norm(jet.du) * domain_u(surface).length() > least &&
         norm(jet.dv) * domain_v(surface).length() > least && norm(curvature(jet).normal) > 0.0;
}

double towards_middle(Range range, double at, double part) {
  const double middle = 0.5 * (range.from + range.to);
  return at + (at < middle ? part : -part) * range.length();
}

double bounded(double k) {
  return std::isfinite(k) ? std::clamp(k, -kMostCurvature, kMostCurvature) : 0.0;
}

/// Value below which this part of the weight lies; values ascend.
double quantile(const std::vector<WeighedValue>& values, double total, double part) {
  double sum = 0.0;
  for (const WeighedValue& v : values) {
    sum += v.weight;
    if (sum >= part * total) return v.value;
  }
  return values.back().value;
}

/// Blue, pale, red; told apart by colour-blind eyes.
constexpr Rgb kDiverging[] = {{30, 74, 138},   {54, 117, 181},  {112, 167, 211},
                              {181, 211, 232}, {244, 243, 238}, {247, 205, 172},
                              {234, 146, 101}, {203, 79, 62},   {148, 25, 44}};
/// Dark blue to light yellow, evenly lighter.
constexpr Rgb kSequential[] = {{48, 36, 92},   {49, 72, 134},  {38, 107, 148},
                               {35, 138, 150}, {52, 168, 139}, {110, 195, 111},
                               {178, 215, 82}, {240, 228, 92}, {253, 246, 190}};

}  // namespace

SurfaceCurvature curvature_at(const NurbsSurface& surface, double size, double u, double v) {
  SurfaceJet jet = evaluate(surface, u, v);
  for (const double part : kBeside) {
    if (is_regular(surface, jet, size)) break;
    jet = evaluate(surface, towards_middle(domain_u(surface), u, part),
                   towards_middle(domain_v(surface), v, part));
  }
  return curvature(jet);
}

PrincipalCurvatures principal_at(const NurbsSurface& surface, double size, double u, double v) {
  const SurfaceCurvature k = curvature_at(surface, size, u, v);
  return {bounded(k.k1), bounded(k.k2)};
}

double quantity(SurfaceColouring colouring, PrincipalCurvatures k) {
  switch (colouring) {
    case SurfaceColouring::kGaussian:
      return k.k1 * k.k2;
    case SurfaceColouring::kMean:
      return 0.5 * (k.k1 + k.k2);
    case SurfaceColouring::kK1:
      return k.k1;
    case SurfaceColouring::kK2:
      return k.k2;
    default:
      return 0.0;
  }
}

bool has_scale(SurfaceColouring colouring) {
  return is_curvature(colouring) || colouring == SurfaceColouring::kDeviation;
}

std::string_view title_of(SurfaceColouring colouring) {
  switch (colouring) {
    case SurfaceColouring::kGaussian:
      return "Gaussian curvature";
    case SurfaceColouring::kMean:
      return "Mean curvature";
    case SurfaceColouring::kK1:
      return "Larger principal curvature k1";
    case SurfaceColouring::kK2:
      return "Smaller principal curvature k2";
    default:
      return {};
  }
}

std::string unit_of(SurfaceColouring colouring, const std::string& units) {
  if (colouring == SurfaceColouring::kDeviation) return units;
  return "1/" + units + (colouring == SurfaceColouring::kGaussian ? "²" : "");
}

double resolution_of(SurfaceColouring colouring, double size) {
  if (colouring == SurfaceColouring::kDeviation) return kNoDeviation * size;
  const double flat = kPlaneCurvature / size;
  return colouring == SurfaceColouring::kGaussian ? flat / size : flat;
}

ValueScale value_scale(std::vector<WeighedValue> values, double resolution) {
  ValueScale scale;
  if (values.empty()) return scale;
  std::sort(values.begin(), values.end(),
            [](const WeighedValue& a, const WeighedValue& b) { return a.value < b.value; });
  double total = 0.0;
  for (const WeighedValue& v : values) total += v.weight;
  scale.least = values.front().value;
  scale.most = values.back().value;
  scale.low = quantile(values, total, kPercentile);
  scale.high = quantile(values, total, 1.0 - kPercentile);
  const double largest = std::max(std::abs(scale.low), std::abs(scale.high));
  if (largest <= resolution) {
    scale.low = scale.high = 0.0;
    return scale;
  }
  if (scale.high - scale.low <= kSameValue * largest) {
    scale.low = scale.high = 0.5 * (scale.low + scale.high);
    return scale;
  }
  const double shorter = std::min(-scale.low, scale.high);
  if (shorter > kShortEnd * largest) {
    scale.diverging = true;
    scale.low = -largest;
    scale.high = largest;
  } else if (shorter > 0.0) {
    (scale.high > -scale.low ? scale.low : scale.high) = 0.0;
  }
  return scale;
}

Result<void> check_deviation(SurfaceColouring colouring,
                             const std::optional<ShownDeviation>& deviation) {
  const bool wanted = colouring == SurfaceColouring::kDeviation || deviation;
  if (!wanted) return {};
  if (!deviation || (!deviation->of_place && deviation->dots.empty())) {
    return error(ErrorCode::kBadOption, "colours of a deviation need something measured against")
        .hint("obvid surface check SURFACE --against FILE");
  }
  for (std::size_t i = 0; i < deviation->dots.size(); ++i) {
    const SceneDot& dot = deviation->dots[i];
    if (!is_finite(dot.point) || !std::isfinite(dot.value)) {
      return error(ErrorCode::kNotFinite, "a measured point is not finite").point(i);
    }
  }
  return {};
}

Result<std::vector<double>> offs_at(const ShownDeviation& deviation, std::size_t count,
                                    const std::function<Vec3(std::size_t)>& place,
                                    const RunContext& run) {
  constexpr std::size_t kBlock = 64;  // searches between two questions whether to go on: some ms
  std::vector<double> out(count);
  OBVID_TRY(in_parallel((count + kBlock - 1) / kBlock, run, [&](std::size_t block) {
    const std::size_t end = std::min(count, (block + 1) * kBlock);
    for (std::size_t i = block * kBlock; i < end; ++i) out[i] = deviation.of_place(place(i));
  }));
  return out;
}

ValueScale scale_of_dots(const std::vector<SceneDot>& dots, double size) {
  std::vector<WeighedValue> values;
  values.reserve(dots.size());
  for (const SceneDot& dot : dots) values.push_back({dot.value, 1.0});
  return value_scale(std::move(values), resolution_of(SurfaceColouring::kDeviation, size));
}

std::vector<SceneDot> shown_dots(const std::vector<SceneDot>& dots, std::size_t most) {
  if (dots.size() <= most) return dots;
  std::vector<std::size_t> order(dots.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t farthest = most / 4;
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(farthest),
                   order.end(), [&](std::size_t a, std::size_t b) {
                     const double x = std::abs(dots[a].value), y = std::abs(dots[b].value);
                     return x != y ? x > y : a < b;
                   });
  std::vector<bool> kept(dots.size(), false);
  for (std::size_t k = 0; k < farthest; ++k) kept[order[k]] = true;
  for (std::size_t k = 0; k < most - farthest; ++k)
    kept[k * dots.size() / (most - farthest)] = true;
  std::vector<SceneDot> out;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    if (kept[i]) out.push_back(dots[i]);
  }
  return out;
}

Rgb palette(bool diverging, double part) {
  const std::span<const Rgb> stops = diverging ? std::span<const Rgb>(kDiverging) : kSequential;
  const double place = std::clamp(part, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double f = place - static_cast<double>(i);
  Rgb colour{};
  for (std::size_t c = 0; c < colour.size(); ++c) {
    colour[c] =
        static_cast<std::uint8_t>(std::lround((1.0 - f) * stops[i][c] + f * stops[i + 1][c]));
  }
  return colour;
}

std::string hex(Rgb colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

}  // namespace obvid::picture
