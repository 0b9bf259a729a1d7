// SPDX-License-Identifier: Apache-2.0
#include "scallop_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "moves.h"
#include "obvid/core/internal/parallel.h"

namespace obvid::toolpath {
namespace {

constexpr int kMostRounds = 10;
constexpr std::size_t kSpotsTogether = 256;  // before whoever waits is asked whether to go on
constexpr double kTakenOff = 0.9;            // of a height: more than that is nothing taken off
constexpr int kMostInVain = 3;               // passes one after the other that took nothing off
constexpr double kPassMargin = 3.0;          // cells that a pass goes beyond high places
constexpr double kPassesTogether = 2.0;      // diameters: passes nearer to each other become one
constexpr double kLeastPassStep = 0.002;     // of the level step: nearer passes help no more
constexpr double kLeastLine = 1e-7;          // of the range of parameters, likewise

/// As they are printed where no arcs stand for them.
void append_sweeps(const Pass& pass, double within, std::vector<Sweep>& sweeps) {
  for (const auto& piece : pass.pieces) {
    std::vector<Vec3> tips;
    for (const PassPoint& p : piece) tips.push_back(p.place.tip);
    tips = thinned(tips, within);
    for (std::size_t i = 1; i < tips.size(); ++i) sweeps.push_back({tips[i - 1], tips[i]});
  }
}

void append_sweeps(const std::vector<Pass>& passes, double within, std::size_t threads,
                   std::vector<Sweep>& sweeps) {
  std::vector<std::vector<Sweep>> all(passes.size());
  in_parallel(all.size(), threads,
              [&](std::size_t k) { append_sweeps(passes[k], within, all[k]); });
  for (const auto& some : all) sweeps.insert(sweeps.end(), some.begin(), some.end());
}

}  // namespace

ScallopSurvey::ScallopSurvey(const Part& part, const ToolpathOptions& options, const StepRule& rule,
                             const SurfaceCells& cells, LargeList<Nearest>& reach,
                             const Leftover* left, Walker& walker)
    : part_(part),
      walker_(walker),
      of_parameters_(options.strategy == ToolpathStrategy::kIsoparametric),
      along_v_(options.along_v),
      frame_(pass_frame(part, options.angle_deg)),
      level_(rule.level()),
      spacing_(cells.spacing()),
      scallop_(options.scallop.value_or(0.0)),
      print_(print_within(options)),
      flat_from_(flat_from(options).value_or(-1.0)),
      simulation_(part, cells, reach, options.threads) {
  simulation_.judge_only(left);
}

Result<std::size_t> ScallopSurvey::complete(Family& family, LevelPasses* levels, double share,
                                            const RunContext& run) {
  std::size_t count = 0;
  if (!(scallop_ > 0.0)) return count;
  std::vector<Sweep> sweeps;
  if (!begun_) {
    append_sweeps(family, print_, walker_.threads(), sweeps);
    if (levels != nullptr) append_sweeps(levels->passes(), print_, walker_.threads(), sweeps);
  }
  begun_ = true;
  for (int round = 0; round < kMostRounds; ++round) {
    const double part = static_cast<double>(round) / kMostRounds;
    OBVID_TRY(tell(run, "scallops", part));
    OBVID_TRY(simulation_.cut(sweeps, run));
    sweeps.clear();
    auto high = simulation_.above(share * scallop_, kScallopWithin * scallop_, run);
    OBVID_TRY(high);
    give_up(*high);
    if (levels != nullptr) {
      const auto wall = std::stable_partition(
          high->begin(), high->end(), [&](const HighSpot& s) { return s.normal.z > flat_from_; });
      const auto added = levels->add({wall, high->end()}, run);
      OBVID_TRY(added);
      append_sweeps(*added, print_, walker_.threads(), sweeps);
      count += added->size();
      high->erase(wall, high->end());
    }
    const auto extra = wanted(family, *high, run);
    OBVID_TRY(extra);
    std::vector<Rail> rails;
    for (auto one = extra->rbegin(); one != extra->rend(); ++one) rails.push_back(one->rail);
    auto passes = walker_.walk(rails, run);
    OBVID_TRY(passes);
    append_sweeps(*passes, print_, walker_.threads(), sweeps);
    std::reverse(passes->begin(), passes->end());
    count += insert(family, *extra, std::move(*passes));
    if (sweeps.empty()) break;
  }
  return count;
}

std::size_t ScallopSurvey::insert(Family& family, const std::vector<Wanted>& wanted,
                                  std::vector<Pass> passes) {
  std::size_t count = 0, next = 0;
  Family out;
  for (std::size_t i = 0; i < family.size(); ++i) {
    out.push_back(std::move(family[i]));
    for (; next < wanted.size() && wanted[next].behind == i; ++next) {
      if (passes[next].empty()) continue;
      out.push_back(std::move(passes[next]));
      ++count;
    }
  }
  family = std::move(out);
  return count;
}

void ScallopSurvey::give_up(std::vector<HighSpot>& high) {
  std::erase_if(high, [&](const HighSpot& spot) {
    const auto [at, fresh] = tried_.try_emplace(spot.cell);
    Tried& tried = at->second;
    const bool vain =
        !fresh && std::isfinite(spot.height) && spot.height > kTakenOff * tried.height;
    tried.times = vain ? tried.times + 1 : 0;
    tried.height = spot.height;
    return tried.times >= kMostInVain;
  });
}

ScallopSurvey::Across ScallopSurvey::across(const HighSpot& spot) const {
  if (of_parameters_) {
    const NurbsSurface& surface = part_.model().patches[spot.place.patch].surface;
    const Range range = along_v_ ? domain_v(surface) : domain_u(surface);
    const double along = along_v_ ? spot.place.v : spot.place.u;
    return {(along - range.from) / range.length(), along_v_ ? spot.place.u : spot.place.v};
  }
  return {(dot(spot.axis, frame_.along) - frame_.a0) / (frame_.a1 - frame_.a0),
          dot(spot.axis, frame_.across())};
}

/// Where the rail runs at `t`; nothing: it does not come by.
std::optional<double> ScallopSurvey::across(const Rail& rail, const HighSpot& spot,
                                            double t) const {
  if (t < rail.from || t > rail.to) return std::nullopt;
  if (!of_parameters_) return dot(rail.axis_at(t), frame_.across());
  if (rail.patch != spot.place.patch) return std::nullopt;
  return rail.fixed;
}

/// The nearest passes on both sides of where the cutter touches the place.
std::optional<ScallopSurvey::Sides> ScallopSurvey::sides(const Family& family,
                                                         const HighSpot& spot) const {
  const Across aim = across(spot);
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  Sides out;
  for (std::size_t i = 0; i < family.size(); ++i) {
    if (family[i].empty()) continue;
    const auto at = across(family[i].rail, spot, aim.t);
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
    const NurbsSurface& surface = part_.model().patches[spot.place.patch].surface;
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
Vec2 ScallopSurvey::outside(const Rail& rail, const Spots& spots) const {
  double farthest = 0.0;
  for (const HighSpot* spot : spots) {
    const Across aim = across(*spot);
    const double off = aim.across - dot(rail.axis_at(aim.t), frame_.across());
    if (std::abs(off) > std::abs(farthest)) farthest = off;
  }
  return farthest * frame_.across();
}

Result<std::vector<ScallopSurvey::Wanted>> ScallopSurvey::wanted(const Family& family,
                                                                 const std::vector<HighSpot>& high,
                                                                 const RunContext& run) {
  std::vector<std::optional<Sides>> beside(high.size());
  const std::size_t blocks = (high.size() + kSpotsTogether - 1) / kSpotsTogether;
  OBVID_TRY(in_parallel(blocks, with_threads(run, walker_.threads()), [&](std::size_t k) {
    const std::size_t end = std::min(high.size(), (k + 1) * kSpotsTogether);
    for (std::size_t i = k * kSpotsTogether; i < end; ++i) beside[i] = sides(family, high[i]);
  }));
  std::map<Sides, Spots> places;
  for (std::size_t i = 0; i < high.size(); ++i) {
    if (beside[i]) places[*beside[i]].push_back(&high[i]);
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
    for (const HighSpot* spot : spots) ts.push_back(across(*spot).t);
    std::sort(ts.begin(), ts.end());
    const double whole = std::max(length(rail), part_.cutter().radius);
    const double margin = kPassMargin * spacing_ / whole;
    const double together = kPassesTogether * 2.0 * part_.cutter().radius / whole;
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
