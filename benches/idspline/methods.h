// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "obvid/idspline/internal/cell.h"

namespace obvid::bench {

/// A spline of any kind, as far as tables look at it.
struct AnySpline {
  std::function<ScalarJet(double)> at;
  std::function<double(double, double)> integral;
};

/// A way to make one from nodes, values and, where it wants them, integrals over the cells.
struct Method {
  std::string name;
  bool wants_integrals = false;
  std::function<AnySpline(const std::vector<double>& x, const std::vector<double>& f,
                          const std::vector<double>& integrals)>
      make;
};

/// Every spline of the module. `make` ends the program when a spline is refused: tables are made
/// from data that are known to be good.
[[nodiscard]] std::vector<Method> methods();

void print_convergence();
void print_two_variables();
void print_curves();
/// From the folder of published series; says so when it is not there.
void print_overshoot(const std::string& folder);

}  // namespace obvid::bench
