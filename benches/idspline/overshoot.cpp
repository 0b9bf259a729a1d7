// SPDX-License-Identifier: Apache-2.0
// How far splines leave the range of the values between which they run.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "methods.h"
#include "obvid/io/read_points.h"

namespace obvid::bench {
namespace {

struct Overshoot {
  double monotone = 0.0;  ///< beyond both neighbours where the values go one way
  double range = 0.0;     ///< beyond all values
  double move = 0.0;      ///< of a value
};

/// The values of four neighbouring nodes go one way.
bool goes_one_way(const std::vector<double>& f, std::size_t i) {
  const std::size_t first = i > 0 ? i - 1 : 0, last = std::min(i + 2, f.size() - 1);
  bool up = true, down = true;
  for (std::size_t k = first; k < last; ++k) {
    up = up && f[k + 1] >= f[k];
    down = down && f[k + 1] <= f[k];
  }
  return up || down;
}

double beyond(double y, double a, double b) {
  return std::max({0.0, y - std::max(a, b), std::min(a, b) - y});
}

/// All in per cent of the range of values.
Overshoot overshoot(const AnySpline& s, const std::vector<double>& x,
                    const std::vector<double>& f) {
  const auto [low, high] = std::minmax_element(f.begin(), f.end());
  constexpr int kPlaces = 200;
  Overshoot out;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    for (int k = 0; k <= kPlaces; ++k) {
      const double y = s.at(x[i] + (x[i + 1] - x[i]) * k / kPlaces).value;
      out.range = std::max(out.range, beyond(y, *low, *high));
      if (goes_one_way(f, i)) out.monotone = std::max(out.monotone, beyond(y, f[i], f[i + 1]));
    }
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    out.move = std::max(out.move, std::abs(s.at(x[i]).value - f[i]));
  }
  const double scale = 100.0 / (*high - *low);
  return {scale * out.monotone, scale * out.range, scale * out.move};
}

void print_series(const std::string& folder, const std::string& name) {
  const auto series = read_points(folder + "/" + name + ".csv");
  if (!series) {
    fmt::print("{}\n", to_line(series.error()));
    return;
  }
  std::vector<double> x, f;
  for (const Vec2 p : series->points) {
    x.push_back(p.x);
    f.push_back(p.y);
  }
  for (const Method& method : methods()) {
    if (method.wants_integrals) continue;
    const Overshoot o = overshoot(method.make(x, f, {}), x, f);
    fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.2f} |\n", name, method.name, o.monotone, o.range,
               o.move);
  }
}

}  // namespace

void print_overshoot(const std::string& folder) {
  fmt::print("\nOvershoot, per cent of the range of values\n\n");
  fmt::print("| series | spline | beyond neighbours | beyond all | value moved |\n");
  fmt::print("|---|---|---:|---:|---:|\n");
  for (const char* name : {"akima1970", "akima_uneven_a", "fritsch_carlson_rpn15a",
                           "titanium_heat12", "titanium_heat49", "spaeth10"}) {
    print_series(folder, name);
  }
}

}  // namespace obvid::bench
