// SPDX-License-Identifier: Apache-2.0
#include "surface/longitudinals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "obvid/core/internal/figures.h"
#include "obvid/curve/internal/basis.h"
#include "obvid/numeric/internal/gauss.h"

namespace obvid::pipeline_detail {
namespace {

constexpr std::size_t kLongitudinals = 10;  // of all patches together
constexpr std::size_t kPlacesOnSpan = 24;
constexpr double kSignRounding = 1e-6;  // of a line's largest curvature, as in `check_surface`

/// Curvature along a line, and where the parameters `marks` lie on it.
LineCurvature curvature_along(const NurbsSurface& s, double u, const std::vector<double>& marks,
                              std::vector<double>* marked) {
  LineCurvature out;
  const std::vector<double> ends = distinct(s.knots_v);
  double length = 0.0;
  const auto speed = [&](double v) { return norm(evaluate(s, u, v).dv); };
  const auto place = [&](double v) {
    const SurfaceJet jet = evaluate(s, u, v);
    const Vec3 normal = curvature(jet).normal;
    const double square = dot(jet.dv, jet.dv);
    if (normal == Vec3{} || !(square > 0.0)) return;  // a pole
    out.s.push_back(length);
    out.k.push_back(dot(jet.dvv, normal) / square);
  };
  const Range domain = domain_v(s);
  std::size_t next = 0;
  place(domain.from);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const Range span{std::max(ends[i], domain.from), std::min(ends[i + 1], domain.to)};
    if (!(span.length() > 0.0)) continue;
    for (std::size_t k = 1; k <= kPlacesOnSpan; ++k) {
      const auto at = [&](std::size_t n) {
        return span.at(static_cast<double>(n) / static_cast<double>(kPlacesOnSpan));
      };
      const double from = at(k - 1), to = at(k);
      for (; marked != nullptr && next < marks.size() && marks[next] <= to; ++next) {
        const double v = std::max(marks[next], from);
        marked->push_back(length + (v > from ? gauss_integral<4>(from, v, speed) : 0.0));
      }
      length += gauss_integral<4>(from, to, speed);
      place(to);
    }
  }
  double largest = 0.0, sign = 0.0;
  for (const double k : out.k) largest = std::max(largest, std::abs(k));
  for (const double k : out.k) {
    if (std::abs(k) <= kSignRounding * largest) continue;
    if (sign * k < 0.0) ++out.changes;
    sign = k;
  }
  return out;
}

}  // namespace

Result<LongitudinalsPicture> longitudinals_of(const SurfaceModel& model,
                                              const ShownLongitudinals& shown,
                                              const RunContext& run) {
  LongitudinalsPicture out;
  out.title = model.name;
  out.units = model.units.text();
  out.of_sections = !shown.sections.empty();
  const std::size_t count = model.patches.size();
  const std::size_t each =
      std::max<std::size_t>(1, (kLongitudinals + count - 1) / std::max<std::size_t>(count, 1));
  for (std::size_t p = 0; p < count; ++p) {
    const NurbsSurface& s = model.patches[p].surface;
    const auto knots = out.of_sections ? shown.sections : distinct(s.knots_v);
    for (std::size_t i = 0; i < each; ++i) {
      OBVID_TRY(may_go_on(run));
      const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(each);
      const double u = domain_u(s).at(part);
      Longitudinal line;
      line.now = curvature_along(s, u, knots, &line.sections);
      if (p < shown.before.size()) {
        line.before =
            curvature_along(shown.before[p], domain_u(shown.before[p]).at(part), {}, nullptr);
      }
      line.name = fmt::format("{}, u = {}", model.patches[p].name, significant(u, 3));
      out.lines.push_back(std::move(line));
    }
  }
  return out;
}

}  // namespace obvid::pipeline_detail
