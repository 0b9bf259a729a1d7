// SPDX-License-Identifier: Apache-2.0
#include "openings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace obvid {
namespace {

constexpr std::size_t kOpenPlaces = 32;  ///< of a span

/// A short part of a border.
struct Step {
  Vec3 middle;
  double dx = 0.0, dy = 0.0, length = 0.0;
  double depth = 0.0;
};

struct OpenBorder {
  const TopologyEdge* edge = nullptr;
  std::vector<Step> steps;  ///< below the water
  std::size_t group = 0;    ///< of borders that are connected there
};

std::vector<Vec3> places_of(const SpaceCurve& curve) {
  std::vector<Vec3> out;
  for (const SpaceCurve& span : spans(curve)) {
    const Range range = domain(span);
    if (out.empty()) out.push_back(evaluate(span, range.from).point);
    for (std::size_t k = 1; k <= kOpenPlaces; ++k) {
      out.push_back(
          evaluate(span, range.at(static_cast<double>(k) / static_cast<double>(kOpenPlaces)))
              .point);
    }
  }
  return out;
}

/// The part of a chord below the water.
std::vector<Step> wet_steps(const std::vector<Vec3>& places, double water) {
  std::vector<Step> out;
  for (std::size_t k = 1; k < places.size(); ++k) {
    Vec3 a = places[k - 1], b = places[k];
    const double below_a = water - a.z, below_b = water - b.z;
    if (below_a <= 0.0 && below_b <= 0.0) continue;
    if (below_a < 0.0) a = a + below_a / (below_a - below_b) * (b - a);
    if (below_b < 0.0) b = b + below_b / (below_b - below_a) * (a - b);
    const Vec3 middle = 0.5 * (a + b);
    out.push_back({middle, b.x - a.x, b.y - a.y, norm(b - a), water - middle.z});
  }
  return out;
}

std::vector<OpenBorder> open_borders(const Topology& topology, double water) {
  std::vector<OpenBorder> out;
  std::vector<std::size_t> group(topology.vertices.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  for (const TopologyEdge& edge : topology.edges) {
    if (edge.point || edge.uses.size() != 1) continue;
    OpenBorder border{&edge, wet_steps(places_of(edge.curve), water), 0};
    if (border.steps.empty()) continue;
    const auto is_wet = [&](std::size_t vertex) {
      return topology.vertices[vertex].point.z < water;
    };
    if (is_wet(edge.from) && is_wet(edge.to)) group[root(edge.from)] = root(edge.to);
    border.group = is_wet(edge.from) ? edge.from : edge.to;
    out.push_back(std::move(border));
  }
  for (OpenBorder& border : out) border.group = root(border.group);
  return out;
}

using Group = std::vector<const OpenBorder*>;

/// Whether one vertical plane holds all: through the mean along the principal direction.
bool is_in_vertical_plane(const Group& group, double tolerance) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  const Vec3 first = group.front()->steps.front().middle;
  for (const OpenBorder* border : group) {
    for (const Step& step : border->steps) {
      const Vec3 p = step.middle - first;
      n += 1.0, x += p.x, y += p.y, xx += p.x * p.x, xy += p.x * p.y, yy += p.y * p.y;
    }
  }
  const double angle = 0.5 * std::atan2(2.0 * (xy - x * y / n), xx - x * x / n - yy + y * y / n);
  const double c = std::cos(angle), s = std::sin(angle);
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const OpenBorder* border : group) {
    for (const Step& step : border->steps) {
      const Vec3 p = step.middle - first;
      const double off = c * p.y - s * p.x;
      least = std::min(least, off);
      most = std::max(most, off);
    }
  }
  return most - least <= 2.0 * tolerance;
}

/// The y with the least volume between it and the borders: their median, weighted.
double nearest_y(const Group& group) {
  std::vector<std::pair<double, double>> weighted;
  double all = 0.0;
  for (const OpenBorder* border : group) {
    for (const Step& step : border->steps) {
      weighted.emplace_back(step.middle.y, step.depth * std::abs(step.dx));
      all += weighted.back().second;
    }
  }
  std::sort(weighted.begin(), weighted.end());
  double sum = 0.0;
  for (const auto& [y, weight] : weighted) {
    sum += weight;
    if (2.0 * sum >= all) return y;
  }
  return weighted.back().first;
}

/// How far another border is from a place, at the least; those that share a corner count where
/// they lie on it only, as where one side meets parts of two others.
double to_other_border(const OpenBorder& own, Vec3 place, const std::vector<OpenBorder>& all,
                       double same) {
  double least = std::numeric_limits<double>::infinity();
  for (const OpenBorder& other : all) {
    if (other.edge == own.edge) continue;
    const SpaceCurve& curve = other.edge->curve;
    const double distance = norm(evaluate(curve, nearest_parameter(curve, place)).point - place);
    if (other.group == own.group && distance > same) continue;
    least = std::min(least, distance);
  }
  return least;
}

}  // namespace

Result<Openings> openings_below(const Topology& topology, double water, double size, bool half,
                                const RunContext& run) {
  const double same = kSameBorder * size;
  const std::vector<OpenBorder> borders = open_borders(topology, water);
  Openings out;
  std::vector<bool> done(borders.size(), false);
  for (std::size_t i = 0; i < borders.size(); ++i) {
    if (done[i]) continue;
    Group group;
    for (std::size_t k = i; k < borders.size(); ++k) {
      if (borders[k].group != borders[i].group) continue;
      done[k] = true;
      group.push_back(&borders[k]);
    }
    if (!half && is_in_vertical_plane(group, same)) continue;
    const double y = half ? 0.0 : nearest_y(group);
    for (const OpenBorder* border : group) {
      OBVID_TRY(tell(run, "measuring", 1.0));
      for (const Step& step : border->steps) {
        double width = std::abs(step.middle.y - y), along = std::abs(step.dx);
        if (width <= same || along == 0.0) continue;
        const double other = to_other_border(*border, step.middle, borders, same);
        if (other <= same) continue;
        if (const double level = std::hypot(step.dx, step.dy); other * level < width * along) {
          width = other;
          along = level;
        }
        out.volume += width * step.depth * along;
        // across a border that is nearly in a plane of constant x hardly anything is open
        width *= along / step.length;
        if (width <= out.width) continue;
        out.width = width;
        out.at = step.middle;
      }
    }
  }
  return out;
}

}  // namespace obvid
