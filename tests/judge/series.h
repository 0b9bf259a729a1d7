// SPDX-License-Identifier: Apache-2.0
// A generator of hostile series: points, options, and the curve behind them where there is one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "input.h"

namespace judge {

/// The same numbers on every machine (splitmix64).
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  double unit();  ///< in [0, 1)
  double between(double a, double b) { return a + (b - a) * unit(); }
  double logarithmic(double a, double b);  ///< equal chances per decade
  int whole(int a, int b);                 ///< both included
  bool chance(double p) { return unit() < p; }
  double normal();

 private:
  std::uint64_t state_;
};

struct Series {
  std::string family;
  std::string text;                  ///< of the points file
  std::vector<std::string> options;  ///< of fit, without outputs
  std::optional<Truth> truth;
  std::size_t points = 0;
};

Series make_series(std::uint64_t seed, std::uint64_t index);

/// Shapes before scaling, turning and moving; about 1 in size.
struct Shape {
  std::string family;
  std::vector<Vec> points;
  std::optional<Truth> truth;
  bool closed = false;
};
Shape make_shape(Dice& dice);

}  // namespace judge
