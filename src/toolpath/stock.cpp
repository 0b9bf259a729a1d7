// SPDX-License-Identifier: Apache-2.0
#include "stock.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "moves.h"
#include "scallop_meter.h"

namespace obvid::toolpath {
namespace {

constexpr double kMostNodes = 4e6;  // some 130 MB; larger parts get a coarser raster

constexpr double kCellRounding = 1e-6;  // of a cell: else nodes could stand on the border

/// Height of a disc over a node `p` on the way from `a` to `b`, at its lowest; infinite: never over
/// it.
double lowest_of_disc(double radius, Vec2 p, Vec3 a, Vec3 b) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Vec2 way{b.x - a.x, b.y - a.y}, to = p - Vec2{a.x, a.y};
  const double length2 = dot(way, way), ahead = dot(to, way);
  double from = 0.0, end = 1.0;
  const double out = dot(to, to) - radius * radius;
  if (length2 > 0.0) {
    const double root = ahead * ahead - length2 * out;
    if (root < 0.0) return kNever;
    from = std::max(0.0, (ahead - std::sqrt(root)) / length2);
    end = std::min(1.0, (ahead + std::sqrt(root)) / length2);
    if (from > end) return kNever;
  } else if (out > 0.0) {
    return kNever;
  }
  return a.z + (b.z - a.z) * (b.z > a.z ? from : end);
}

}  // namespace

Stock::Stock(const Part& part, double spacing, double within) : part_(part), within_(within) {
  const Vec3 low = part.field().low(), high = part.field().high();
  const double dx = high.x - low.x, dy = high.y - low.y;
  spacing_ = std::max({spacing, std::sqrt(dx * dy / kMostNodes), (dx + dy) / kMostNodes});
  const auto cells = [&](double size) {
    return static_cast<std::size_t>(std::max(1.0, std::ceil(size / spacing_ - kCellRounding)));
  };
  nx_ = cells(dx);
  ny_ = cells(dy);
  const auto rest = [&](double size, std::size_t n) {
    return 0.5 * (size - static_cast<double>(n - 1) * spacing_);
  };
  low_ = {low.x + rest(dx, nx_), low.y + rest(dy, ny_)};
  nodes_.resize(nx_ * ny_);
  const double full = high.z + 2.0 * part.cutter().radius;
  for (std::size_t y = 0; y < ny_; ++y) {
    for (std::size_t x = 0; x < nx_; ++x) {
      if (const auto q = part.surface_over(at(x, y))) {
        nodes_[y * nx_ + x] = {q->contact.z, full, q->normal.z, Reach::kUnknown};
      }
    }
  }
}

Vec2 Stock::at(std::size_t x, std::size_t y) const {
  return {low_.x + static_cast<double>(x) * spacing_, low_.y + static_cast<double>(y) * spacing_};
}

/// Lowers nodes of a rectangle to height(place).
template <class Height>
void Stock::lower(Vec2 low, Vec2 high, const Height& height) {
  const auto first = [&](double value) { return std::max(0.0, std::ceil(value / spacing_)); };
  const auto end = [&](double value, std::size_t n) {
    return std::min(static_cast<double>(n), std::floor(value / spacing_) + 1.0);
  };
  const double x1 = end(high.x - low_.x, nx_), y1 = end(high.y - low_.y, ny_);
  for (double y = first(low.y - low_.y); y < y1; y += 1.0) {
    for (double x = first(low.x - low_.x); x < x1; x += 1.0) {
      Node& node = nodes_[static_cast<std::size_t>(y) * nx_ + static_cast<std::size_t>(x)];
      if (node.lean <= 0.0) continue;
      const double z = height(Vec2{low_.x + x * spacing_, low_.y + y * spacing_});
      if (z < node.top) node.top = z;
    }
  }
}

// Sharp corners: the whole way of a disc. Round ones: the place at its end, the next is near.
void Stock::sweep(Vec3 a, Vec3 b) {
  const CutterShape& cutter = part_.cutter();
  const double r = cutter.radius;
  if (cutter.corner <= 0.0) {
    lower({std::min(a.x, b.x) - r, std::min(a.y, b.y) - r},
          {std::max(a.x, b.x) + r, std::max(a.y, b.y) + r},
          [&](Vec2 p) { return lowest_of_disc(r, p, a, b); });
    return;
  }
  lower({b.x - r, b.y - r}, {b.x + r, b.y + r}, [&](Vec2 p) {
    const double out2 = (p.x - b.x) * (p.x - b.x) + (p.y - b.y) * (p.y - b.y);
    if (out2 > r * r) return std::numeric_limits<double>::infinity();
    return b.z + cutter.height(std::sqrt(out2));
  });
}

/// Round cutters: places between `a` and `b` take off no more than `within`.
bool Stock::skips(Vec3 a, Vec3 b) const {
  return dot(b - a, b - a) <= 8.0 * part_.cutter().corner * within_;
}

void Stock::cut(const Pass& pass) {
  for (const auto& piece : pass.pieces) {
    std::vector<Vec3> tips;
    for (const PassPoint& p : piece) tips.push_back(p.place.tip);
    if (part_.cutter().corner <= 0.0) tips = thinned(tips, within_);
    Vec3 last = tips.front();
    sweep(last, last);
    for (std::size_t i = 1; i < tips.size(); ++i) {
      if (i + 1 < tips.size() && skips(last, tips[i + 1])) continue;
      sweep(last, tips[i]);
      last = tips[i];
    }
  }
}

bool Stock::reached(std::size_t x, std::size_t y) {
  Node& node = nodes_[y * nx_ + x];
  if (node.reach == Reach::kUnknown) {
    const auto q = part_.surface_over(at(x, y));
    node.reach = q && held_up(part_, *q) <= part_.tolerance() ? Reach::kYes : Reach::kNo;
  }
  return node.reach == Reach::kYes;
}

std::vector<HighSpot> Stock::above(double limit) {
  std::vector<HighSpot> out;
  for (std::size_t y = 0; y < ny_; ++y) {
    for (std::size_t x = 0; x < nx_; ++x) {
      const Node& node = nodes_[y * nx_ + x];
      if (node.lean <= 0.0 || node.left() <= limit || !reached(x, y)) continue;
      if (const auto q = part_.surface_over(at(x, y))) out.push_back({node.left(), *q});
    }
  }
  return out;
}

HighSpot Stock::highest() {
  HighSpot best;
  for (std::size_t y = 0; y < ny_; ++y) {
    for (std::size_t x = 0; x < nx_; ++x) {
      const Node& node = nodes_[y * nx_ + x];
      if (node.lean <= 0.0 || node.left() <= best.height || !reached(x, y)) continue;
      if (const auto q = part_.surface_over(at(x, y))) best = {node.left(), *q};
    }
  }
  return best;
}

}  // namespace obvid::toolpath
