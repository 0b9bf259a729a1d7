// SPDX-License-Identifier: Apache-2.0
#include "scallop_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace obvid::toolpath {
namespace {

constexpr double kRasterOfRadius = 1.0 / 16.0;
constexpr double kRasterOfStep = 0.25;
constexpr double kWithin = 0.02;          // of the scallop: stays between points of a pass at most
constexpr double kLimit = 0.97;           // of the scallop: the rest is for what the raster misses
constexpr double kRasterMargin = 3.0;     // nodes of the raster that a pass goes beyond high places
constexpr double kTogether = 2.0;         // diameters: passes nearer to each other become one
constexpr double kLeastPassStep = 0.002;  // of the level step: nearer passes help no more
constexpr double kLeastLine = 1e-7;       // of the range of parameters, likewise

double spacing_of(const CutterShape& cutter, const StepRule& rule) {
  return std::min(kRasterOfRadius * cutter.radius, kRasterOfStep * rule.level());
}

}  // namespace

ScallopSurvey::ScallopSurvey(const Part& part, const ToolpathOptions& options, const StepRule& rule,
                             Walker& walker)
    : part_(part),
      walker_(walker),
      of_parameters_(options.strategy == ToolpathStrategy::kIsoparametric),
      along_v_(options.along_v),
      frame_(pass_frame(part, options.angle_deg)),
      level_(rule.level()),
      limit_(kLimit * options.scallop.value_or(0.0)),
      stock_(part, spacing_of(part.cutter(), rule),
             options.scallop ? kWithin * *options.scallop : part.tolerance()) {}

ScallopSurvey::Across ScallopSurvey::across(const Place& place) const {
  if (of_parameters_) {
    const NurbsSurface& surface = part_.model().patches[place.patch].surface;
    const Range range = along_v_ ? domain_v(surface) : domain_u(surface);
    const double along = along_v_ ? place.v : place.u;
    return {(along - range.from) / range.length(), along_v_ ? place.u : place.v};
  }
  const Vec3 tip = part_.cutter().tip(place.contact, place.normal);
  const Vec2 axis{tip.x, tip.y};
  return {(dot(axis, frame_.along) - frame_.a0) / (frame_.a1 - frame_.a0),
          dot(axis, frame_.across())};
}

/// Where the rail runs at `t`; nothing: it does not come by.
std::optional<double> ScallopSurvey::across(const Rail& rail, const Place& place, double t) const {
  if (t < rail.from || t > rail.to) return std::nullopt;
  if (!of_parameters_) return dot(rail.axis_at(t), frame_.across());
  if (rail.patch != place.patch) return std::nullopt;
  return rail.fixed;
}

/// The nearest passes on both sides of where the cutter touches the place.
std::optional<ScallopSurvey::Sides> ScallopSurvey::sides(const Family& family,
                                                         const Place& place) const {
  const Across aim = across(place);
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  Sides out;
  for (std::size_t i = 0; i < family.size(); ++i) {
    if (family[i].empty()) continue;
    const auto at = across(family[i].rail, place, aim.t);
    if (!at) continue;
    if (*at <= aim.across && *at > low) {
      low = *at;
      out.low = i;
    } else if (*at > aim.across && *at < high) {
      high = *at;
      out.high = i;
    }
  }
  double least = kLeastPassStep * level_;
  if (of_parameters_) {
    const NurbsSurface& surface = part_.model().patches[place.patch].surface;
    least = kLeastLine * (along_v_ ? domain_u(surface) : domain_v(surface)).length();
  }
  if (high - low <= least) return std::nullopt;
  if (!std::isfinite(low)) out.low = out.high;
  if (!std::isfinite(high)) out.high = out.low;
  if (!std::isfinite(low) && !std::isfinite(high)) return std::nullopt;
  return out;
}

/// About: of parameters, the straight way between the ends.
double ScallopSurvey::length(const Rail& rail) const {
  if (!of_parameters_) return frame_.a1 - frame_.a0;
  const NurbsSurface& surface = part_.model().patches[rail.patch].surface;
  const auto point = [&](double s) {
    const double u = along_v_ ? rail.fixed : domain_u(surface).at(s);
    const double v = along_v_ ? domain_v(surface).at(s) : rail.fixed;
    return evaluate(surface, u, v).point;
  };
  return norm(point(0.5) - point(0.0)) + norm(point(1.0) - point(0.5));
}

/// From the last rail to the farthest of places beyond it.
Vec2 ScallopSurvey::outside(const Rail& rail, const std::vector<Place>& places) const {
  double farthest = 0.0;
  for (const Place& place : places) {
    const Across aim = across(place);
    const double off = aim.across - dot(rail.axis_at(aim.t), frame_.across());
    if (std::abs(off) > std::abs(farthest)) farthest = off;
  }
  return farthest * frame_.across();
}

std::vector<ScallopSurvey::Wanted> ScallopSurvey::wanted(const Family& family) {
  std::map<Sides, std::vector<Place>> places;
  for (const HighSpot& spot : stock_.above(limit_)) {
    if (const auto both = sides(family, spot.place)) {
      places[*both].push_back(spot.place);
    }
  }
  std::vector<Wanted> out;
  for (const auto& [both, spots] : places) {
    Rail rail = between(family[both.low].rail, family[both.high].rail);
    if (both.low == both.high) {  // beyond the last pass
      if (of_parameters_) continue;
      const Vec2 out_there = outside(rail, spots);
      for (Vec2& axis : rail.axis) axis = axis + out_there;
    }
    std::vector<double> ts;
    for (const Place& place : spots) ts.push_back(across(place).t);
    std::sort(ts.begin(), ts.end());
    const double whole = std::max(length(rail), part_.cutter().radius);
    const double margin = kRasterMargin * stock_.spacing() / whole;
    const double together = kTogether * 2.0 * part_.cutter().radius / whole;
    for (std::size_t i = 0; i < ts.size();) {
      std::size_t end = i + 1;
      while (end < ts.size() && ts[end] - ts[end - 1] <= together) ++end;
      Wanted one{both.low, rail};
      one.rail.from = std::max(0.0, ts[i] - margin);
      one.rail.to = std::min(1.0, ts[end - 1] + margin);
      out.push_back(std::move(one));
      i = end;
    }
  }
  return out;  // ascending by `behind`
}

}  // namespace obvid::toolpath
