// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "pass_families.h"

namespace obvid::toolpath {
namespace {

constexpr double kLeastParameterStep = 1e-4;  // of the range of the parameter: poles, folds

/// From a line of which nothing is seen, there or touched: a step as on a level surface, where the
/// line moves fastest.
double step_past(const NurbsSurface& surface, const StepRule& rule, const Rail& rail,
                 double length) {
  constexpr int kPlaces = 64;
  const Range along = rail.along_v ? domain_v(surface) : domain_u(surface);
  double speed = 0.0;
  for (int k = 0; k <= kPlaces; ++k) {
    const double t = along.at(static_cast<double>(k) / kPlaces);
    const SurfaceJet jet =
        evaluate(surface, rail.along_v ? rail.fixed : t, rail.along_v ? t : rail.fixed);
    speed = std::max(speed, norm(rail.along_v ? jet.du : jet.dv));
  }
  const double step = speed > 0.0 ? rule.level() / speed : length;
  return std::clamp(step, kLeastParameterStep * length, length);
}

/// To the next line of parameters: as far as the narrowest place allows.
double step_of(const Part& part, const StepRule& rule, const Pass& pass, double length,
               std::size_t threads) {
  const Rail& rail = pass.rail;
  const NurbsSurface& surface = part.model().patches[rail.patch].surface;
  const bool any = std::any_of(pass.pieces.begin(), pass.pieces.end(), [](const auto& piece) {
    return std::any_of(piece.begin(), piece.end(), [](const PassPoint& p) { return !p.lifted; });
  });
  if (!any) return step_past(surface, rule, rail, length);
  const double step = least_over(pass, length, threads, [&](const PassPoint& p) {
    if (p.lifted) return length;
    const SurfaceJet jet = evaluate(surface, p.place.u, p.place.v);
    const Vec3 along = unit(rail.along_v ? jet.dv : jet.du);
    const Vec3 to = rail.along_v ? jet.du : jet.dv;
    const double speed = norm(to - dot(to, along) * along);
    return speed > 0.0 ? rule.across(part, p.place, along) / speed : length;
  });
  return std::max(step, kLeastParameterStep * length);
}

}  // namespace

Result<Family> isoparametric(const Part& part, const ToolpathOptions& options, const StepRule& rule,
                             Walker& walker, const Leftover* left, const RunContext& run) {
  Family family;
  const auto& patches = part.model().patches;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const NurbsSurface& surface = patches[k].surface;
    const Range range = options.along_v ? domain_u(surface) : domain_v(surface);
    double at = range.from;
    while (true) {
      Rail rail;
      rail.patch = k;
      rail.along_v = options.along_v;
      rail.fixed = at;
      auto pass = walker.walk(rail);
      OBVID_TRY(pass);
      const double step = step_of(part, rule, *pass, range.length(), walker.threads());
      if (left != nullptr) left->keep(*pass);
      family.push_back(std::move(*pass));
      if (at >= range.to) break;
      at = std::min(at + step, range.to);
      const double share = (static_cast<double>(k) + (at - range.from) / range.length()) /
                           static_cast<double>(patches.size());
      OBVID_TRY(tell(run, "passes", share));
    }
    family.emplace_back();  // nothing between patches
  }
  return family;
}

}  // namespace obvid::toolpath
