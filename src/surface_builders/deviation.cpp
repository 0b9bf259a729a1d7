// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/deviation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "climb.h"
#include "obvid/core/internal/parallel.h"
#include "obvid/surface/internal/trim.h"

namespace obvid {
namespace {

/// Searches between two questions whether to go on: some ms.
constexpr std::size_t kBlock = 64;
/// Of a surface's raster: whole rows of them, about.
constexpr std::size_t kPlacesTogether = 65'536;

/// Sums over places in their order: the same for any number of threads.
class Sums {
 public:
  void add(const MeasuredPlace& place, double weight) {
    if (deviation_.places == 0 || place.off < deviation_.least.off) deviation_.least = place;
    if (deviation_.places == 0 || place.off > deviation_.most.off) deviation_.most = place;
    ++deviation_.places;
    weight_ += weight;
    squares_ += weight * place.off * place.off;
    sum_ += weight * place.off;
    if (place.nearest.beside) beside_ += weight;
  }
  [[nodiscard]] Deviation taken() {
    if (weight_ > 0.0) {
      deviation_.root_mean_square = std::sqrt(squares_ / weight_);
      deviation_.mean = sum_ / weight_;
      deviation_.beside = beside_ / weight_;
    }
    return std::move(deviation_);
  }

 private:
  Deviation deviation_;
  double weight_ = 0.0, squares_ = 0.0, sum_ = 0.0, beside_ = 0.0;
};

/// The nearest places of all points, on all processors.
Result<std::vector<NearestPlace>> nearest_of(const std::vector<Vec3>& points,
                                             const NearestOnModel& from, const RunContext& run) {
  std::vector<NearestPlace> out(points.size());
  const std::size_t blocks = (points.size() + kBlock - 1) / kBlock;
  OBVID_TRY(in_parallel(blocks, run, [&](std::size_t block) {
    const std::size_t end = std::min(points.size(), (block + 1) * kBlock);
    for (std::size_t i = block * kBlock; i < end; ++i) out[i] = from.at(points[i]);
  }));
  return out;
}

std::vector<Node> even_or_by_spans(const std::vector<double>& knots, const Range& domain,
                                   std::size_t samples) {
  constexpr std::size_t kMostSpans = 4;  // for each sample
  if (knots.size() > kMostSpans * samples) return nodes_of({domain.to}, domain, samples);
  return nodes_of(knots, domain, samples);
}

/// What of a patch is there; nothing: all of it.
std::optional<TrimRegion> trims_left_of(const SurfacePatch& patch) {
  if (patch.trims.empty()) return std::nullopt;
  return TrimRegion(patch);
}

struct Start {
  std::size_t patch = 0;
  Peak peak;
};

void keep_best(std::vector<Start>& starts, std::size_t patch, const Peaks& peaks) {
  constexpr std::size_t kClimbs = 4;  // of all patches together
  for (const Peak& peak : peaks.highest()) starts.push_back({patch, peak});
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.peak.value > b.peak.value; });
  starts.resize(std::min(starts.size(), kClimbs));
}

}  // namespace

Result<Deviation> deviation_of(const std::vector<Vec3>& points, const NearestOnModel& from,
                               const RunContext& run) {
  const auto nearest = nearest_of(points, from, run);
  OBVID_TRY(nearest);
  Sums sums;
  std::vector<double> offs;
  offs.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const NearestPlace& there = (*nearest)[i];
    sums.add({there.off, points[i], i, 0.0, 0.0, there}, 1.0);
    offs.push_back(there.off);
  }
  Deviation out = sums.taken();
  out.offs = std::move(offs);
  return out;
}

Result<Deviation> deviation_of(const SurfaceModel& model, const NearestOnModel& from,
                               std::size_t samples, const RunContext& run) {
  Sums sums;
  std::array<std::vector<Start>, 2> starts;  // of the least, of the greatest
  constexpr std::array kSigns = {-1.0, 1.0};
  for (std::size_t patch = 0; patch < model.patches.size(); ++patch) {
    const NurbsSurface& s = model.patches[patch].surface;
    const auto region = trims_left_of(model.patches[patch]);
    const auto us = even_or_by_spans(s.knots_u, domain_u(s), samples);
    const auto vs = even_or_by_spans(s.knots_v, domain_v(s), samples);
    std::array<Peaks, 2> peaks{Peaks(us.size(), vs.size()), Peaks(us.size(), vs.size())};
    const std::size_t rows = std::max<std::size_t>(1, kPlacesTogether / us.size());
    for (std::size_t first = 0; first < vs.size(); first += rows) {
      std::vector<Vec3> points;
      std::vector<double> areas;
      std::vector<std::array<std::size_t, 2>> numbers;
      for (std::size_t j = first; j < std::min(vs.size(), first + rows); ++j) {
        OBVID_TRY(may_go_on(run));
        for (std::size_t i = 0; i < us.size(); ++i) {
          const Node& u = us[i];
          if (region && !region->contains(u.at, vs[j].at)) continue;
          numbers.push_back({i, j});
          const SurfaceJet jet = evaluate(s, u.at, vs[j].at);
          points.push_back(jet.point);
          areas.push_back(norm(cross(jet.du, jet.dv)) * u.weight * vs[j].weight);
        }
      }
      const auto nearest = nearest_of(points, from, run);
      OBVID_TRY(nearest);
      for (std::size_t k = 0; k < points.size(); ++k) {
        const auto [i, j] = numbers[k];
        const NearestPlace& there = (*nearest)[k];
        sums.add({there.off, points[k], patch, us[i].at, vs[j].at, there}, areas[k]);
        for (std::size_t side = 0; side < 2; ++side) {
          peaks[side].look_at(kSigns[side] * there.off, i, j, us[i], vs[j]);
        }
      }
    }
    for (std::size_t side = 0; side < 2; ++side) keep_best(starts[side], patch, peaks[side]);
  }
  Deviation out = sums.taken();
  for (std::size_t side = 0; side < 2; ++side) {
    MeasuredPlace& extreme = side == 0 ? out.least : out.most;
    for (const Start& start : starts[side]) {
      OBVID_TRY(may_go_on(run));
      const NurbsSurface& s = model.patches[start.patch].surface;
      const auto region = trims_left_of(model.patches[start.patch]);
      const double sign = kSigns[side];
      const Peak top = climbed(
          [&](double u, double v) {
            if (region && !region->contains(u, v)) return std::nan("");
            return sign * from.at(evaluate(s, u, v).point).off;
          },
          start.peak);
      if (!(top.value > kSigns[side] * extreme.off)) continue;
      const Vec3 point = evaluate(s, top.u.at, top.v.at).point;
      const NearestPlace there = from.at(point);
      extreme = {there.off, point, start.patch, top.u.at, top.v.at, there};
    }
  }
  return out;
}

}  // namespace obvid
