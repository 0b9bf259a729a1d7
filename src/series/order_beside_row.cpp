// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "obvid/numeric/internal/median.h"
#include "order_by_tree.h"

namespace obvid {
namespace {

constexpr std::size_t kFewestOfRow = 20;            ///< points that are left
constexpr double kNearest = 2.0, kFarthest = 64.0;  ///< they are apart, in steps
constexpr double kMostBeside = 0.25;                ///< of that distance: others lie beside the row
constexpr double kMostGap = 2.0;  ///< of the longest step: ends that points lie between

/// Indices of points none of which is nearer than `apart` to one before it.
std::vector<std::size_t> thinned(const std::vector<Vec2>& points, double apart) {
  using Cell = std::pair<double, double>;  // numbers of cells: integers may not hold them
  std::map<Cell, std::vector<std::size_t>> cells;
  const auto cell_of = [&](Vec2 p) {
    return Cell{std::floor((p.x - points.front().x) / apart),
                std::floor((p.y - points.front().y) / apart)};
  };
  const auto is_near = [&](Vec2 p, const Cell& cell) {
    const auto found = cells.find(cell);
    return found != cells.end() &&
           std::any_of(found->second.begin(), found->second.end(),
                       [&](std::size_t k) { return norm(points[k] - p) < apart; });
  };
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [column, row] = cell_of(points[i]);
    bool near = false;
    for (const double dx : {-1.0, 0.0, 1.0}) {
      for (const double dy : {-1.0, 0.0, 1.0}) {
        near = near || is_near(points[i], {column + dx, row + dy});
      }
    }
    if (near) continue;
    cells[{column, row}].push_back(i);
    out.push_back(i);
  }
  return out;
}

/// Where a point lies along a row of others.
struct PlaceOnRow {
  std::size_t leg = 0;  ///< from this point of the row to the next one
  double along = 0.0;   ///< from its start, units; beyond the ends of the row also outside
  double off = 0.0;     ///< distance from the row
};

class RowOfPoints {
 public:
  /// `closes`: behind the last one comes the first one again.
  RowOfPoints(std::vector<Vec2> row, bool closes) : row_(std::move(row)), closes_(closes) {}

  [[nodiscard]] PlaceOnRow place_of(Vec2 p) const {
    PlaceOnRow best{0, 0.0, HUGE_VAL};
    const std::size_t legs = row_.size() - (closes_ ? 0 : 1);
    for (std::size_t k = 0; k < legs; ++k) {
      const Vec2 leg = row_[(k + 1) % row_.size()] - row_[k];
      const double length = norm(leg);
      const double along = dot(p - row_[k], leg) / length;
      const bool begins = !closes_ && k == 0, ends = !closes_ && k + 1 == legs;
      const double on = std::clamp(along, begins ? along : 0.0, ends ? along : length);
      const double off = norm(p - (row_[k] + (on / length) * leg));
      // beyond a joint the leg nearer in direction has it: `along` tells how far beyond
      if (off < best.off) best = {k, along, off};
    }
    return best;
  }

 private:
  std::vector<Vec2> row_;
  bool closes_ = false;
};

/// Residuals of offsets over places along a line, from the parabola of least squares.
std::vector<double> beside_parabola(const std::vector<Vec2>& at) {
  const auto n = static_cast<double>(at.size());
  Vec2 middle{};
  for (const Vec2 p : at) middle = middle + p / n;
  double xx = 0.0, xxx = 0.0, xy = 0.0;
  for (const Vec2 p : at) {
    const Vec2 d = p - middle;
    xx += d.x * d.x, xxx += d.x * d.x * d.x, xy += d.x * d.y;
  }
  const auto bow = [&](double x) { return x * x - xxx / xx * x - xx / n; };
  double squares = 0.0, with_bow = 0.0;
  for (const Vec2 p : at) {
    const double b = bow(p.x - middle.x);
    squares += b * b, with_bow += b * (p.y - middle.y);
  }
  std::vector<double> out;
  for (const Vec2 p : at) {
    const double x = p.x - middle.x;
    out.push_back(p.y - middle.y - xy / xx * x - with_bow / squares * bow(x));
  }
  return out;
}

/// Whether points of a row lie on two sides of it somewhere, as of a thin part whose sides are one
/// row by mistake: scatter has a kurtosis of 3, or of 1.8 where it is even, two sides have 1.
bool has_two_sides(const std::vector<Vec2>& points, const std::vector<std::size_t>& order) {
  constexpr std::size_t kWindow = 40;
  constexpr double kOfTwoSides = 1.4;
  for (std::size_t first = 0; first + kWindow <= order.size(); first += kWindow / 2) {
    const Vec2 origin = points[order[first]];
    const Vec2 chord = points[order[first + kWindow - 1]] - origin;
    const double length = norm(chord);
    if (!(length > 0.0)) return true;
    std::vector<Vec2> at;
    for (std::size_t k = first; k < first + kWindow; ++k) {
      const Vec2 d = points[order[k]] - origin;
      at.push_back({dot(d, chord) / length, cross(chord, d) / length});
    }
    double squares = 0.0, fourth = 0.0;
    for (const double off : beside_parabola(at)) {
      squares += off * off;
      fourth += off * off * off * off;
    }
    const double kurtosis = fourth * static_cast<double>(kWindow) / (squares * squares);
    if (kurtosis < kOfTwoSides) return true;
  }
  return false;
}

std::optional<CurveOrder> order_at(const std::vector<Vec2>& points, double apart) {
  const std::vector<std::size_t> kept = thinned(points, apart);
  if (kept.size() < kFewestOfRow) return std::nullopt;
  std::vector<Vec2> few;
  for (const std::size_t i : kept) few.push_back(points[i]);
  const auto found = order_along_curve(few);
  if (!found) return std::nullopt;
  std::vector<Vec2> row;
  for (const std::size_t i : found->order) row.push_back(few[i]);
  const bool closes = found->is_outline || found->gap <= kMostGap * found->largest_step;
  const RowOfPoints legs(row, closes);
  std::vector<std::pair<PlaceOnRow, std::size_t>> places;
  for (std::size_t k = 0; k < found->order.size(); ++k) {
    places.push_back({{k, 0.0, 0.0}, kept[found->order[k]]});
  }
  if (!closes) {  // the last point ends the last leg
    places.back().first = {row.size() - 2, norm(row.back() - row[row.size() - 2]), 0.0};
  }
  std::vector<bool> is_kept(points.size(), false);
  for (const std::size_t i : kept) is_kept[i] = true;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_kept[i]) continue;
    const PlaceOnRow place = legs.place_of(points[i]);
    if (place.off > kMostBeside * apart) return std::nullopt;
    places.emplace_back(place, i);
  }
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.leg, a.first.along) < std::pair(b.first.leg, b.first.along);
  });
  CurveOrder out;
  for (const auto& [place, i] : places) out.order.push_back(i);
  if (has_two_sides(points, out.order)) return std::nullopt;
  for (std::size_t k = 1; k < out.order.size(); ++k) {
    out.largest_step =
        std::max(out.largest_step, norm(points[out.order[k]] - points[out.order[k - 1]]));
  }
  out.gap = norm(points[out.order.back()] - points[out.order.front()]);
  out.is_outline = found->is_outline;
  out.thinned = kept.size();
  out.apart = apart;
  return out;
}

}  // namespace

Result<CurveOrder> order_beside_row(const std::vector<Vec2>& points) {
  OBVID_TRY(check_order_count(points));
  const std::vector<Edge> tree = shortest_tree(points);
  auto whole = order_by_tree(points, tree);
  if (whole || whole.error().code != ErrorCode::kOutOfOrder) return whole;
  std::vector<double> steps;
  for (const auto& [a, b] : tree) steps.push_back(norm(points[a] - points[b]));
  const double step = median_of(std::move(steps));
  for (double apart = kNearest; step > 0.0 && apart <= kFarthest; apart *= 2.0) {
    if (auto found = order_at(points, apart * step)) return std::move(*found);
  }
  return whole;
}

}  // namespace obvid
