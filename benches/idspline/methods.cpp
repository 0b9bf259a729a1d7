// SPDX-License-Identifier: Apache-2.0
#include "methods.h"

#include <fmt/format.h>

#include <cstdlib>
#include <memory>
#include <utility>

#include "obvid/idspline/internal/id_spline.h"
#include "obvid/idspline/internal/scalar_cubic.h"

namespace obvid::bench {
namespace {

template <class Spline>
AnySpline any(Result<Spline> spline) {
  if (!spline) {
    fmt::print(stderr, "{}\n", to_line(spline.error()));
    std::exit(EXIT_FAILURE);
  }
  const auto s = std::make_shared<const Spline>(std::move(*spline));
  return {[s](double x) { return evaluate(*s, x); },
          [s](double a, double b) { return integral(*s, a, b); }};
}

Method id(std::string name, int degree, IdSmoothing smoothing, bool integrals = false) {
  return {std::move(name), integrals,
          [=](const std::vector<double>& x, const std::vector<double>& f,
              const std::vector<double>& sums) {
            return any(
                id_spline({x, f, integrals ? sums : std::vector<double>{}}, {degree, smoothing}));
          }};
}

}  // namespace

std::vector<Method> methods() {
  using Data = std::vector<double>;
  std::vector<Method> out;
  out.push_back({"cubic, local", false,
                 [](const Data& x, const Data& f, const Data&) { return any(local_cubic(x, f)); }});
  out.push_back({"cubic, slopes", false, [](const Data& x, const Data& f, const Data&) {
                   return any(global_cubic_by_slopes(x, f));
                 }});
  out.push_back({"cubic, second derivatives", false, [](const Data& x, const Data& f, const Data&) {
                   return any(global_cubic_by_seconds(x, f));
                 }});
  out.push_back(id("ID 2", 2, IdSmoothing::kNone));
  out.push_back(id("ID 2, values free", 2, IdSmoothing::kValuesFree));
  out.push_back(id("ID 2, integrals given", 2, IdSmoothing::kNone, true));
  out.push_back(id("ID 2, integrals given, values free", 2, IdSmoothing::kValuesFree, true));
  out.push_back(id("ID 4", 4, IdSmoothing::kNone));
  out.push_back(id("ID 4, values kept", 4, IdSmoothing::kValuesKept));
  out.push_back(id("ID 4, values free", 4, IdSmoothing::kValuesFree));
  out.push_back(id("ID 6", 6, IdSmoothing::kNone));
  out.push_back(id("ID 6, values kept", 6, IdSmoothing::kValuesKept));
  out.push_back(id("ID 6, values free", 6, IdSmoothing::kValuesFree));
  return out;
}

}  // namespace obvid::bench
