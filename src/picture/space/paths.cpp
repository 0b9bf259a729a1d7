// SPDX-License-Identifier: Apache-2.0
#include "space/paths.h"

#include <algorithm>
#include <cmath>

#include "obvid/geom/internal/chord.h"

namespace obvid::picture {
namespace {

constexpr double kTenths = 10.0;
/// Points that are thinned at once: keeps the cost linear for long tool paths.
constexpr std::size_t kChunk = 512;

}  // namespace

void TenthsPath::pair(long x, long y) {
  if (text_.back() >= '0' && text_.back() <= '9' && x >= 0) text_ += ' ';
  text_ += std::to_string(x);
  if (y >= 0) text_ += ' ';
  text_ += std::to_string(y);
}

void TenthsPath::move(Vec2 p) {
  x_ = std::lround(kTenths * p.x);
  y_ = std::lround(kTenths * p.y);
  text_ += 'M';
  pair(x_, y_);
  drawing_ = false;
}

void TenthsPath::line(Vec2 p) {
  const long x = std::lround(kTenths * p.x), y = std::lround(kTenths * p.y);
  if (x == x_ && y == y_) return;
  if (!drawing_) text_ += 'l';
  pair(x - x_, y - y_);
  drawing_ = true;
  x_ = x;
  y_ = y;
}

std::vector<Vec2> thinned(const std::vector<Vec2>& line, double tolerance) {
  if (line.size() < 3) return line;
  std::vector<bool> kept(line.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open;
  for (std::size_t from = 0; from + 1 < line.size(); from += kChunk) {
    open.emplace_back(from, std::min(from + kChunk, line.size() - 1));
  }
  while (!open.empty()) {  // Douglas and Peucker
    const auto [from, to] = open.back();
    open.pop_back();
    kept[from] = kept[to] = true;
    double most = tolerance;
    std::size_t farthest = 0;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double d = distance_from_chord(line[i], line[from], line[to]);
      if (d > most) {
        most = d;
        farthest = i;
      }
    }
    if (farthest == 0) continue;
    open.emplace_back(from, farthest);
    open.emplace_back(farthest, to);
  }
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (kept[i]) out.push_back(line[i]);
  }
  return out;
}

}  // namespace obvid::picture
