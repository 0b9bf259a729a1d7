// SPDX-License-Identifier: Apache-2.0
#include "scallop_meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace obvid::toolpath {
namespace {

constexpr double kCellOfRadius = 0.25;
constexpr double kMostCells = 1e6;
constexpr int kTraceSteps = 24;
constexpr double kTraced = 1e-3;     // of the allowed height
constexpr double kLookedFor = 8.0;   // allowed heights: beyond, the exact height says no more
constexpr double kOfAllowed = 0.02;  // of the scallop: what is left between kept places
constexpr double kHeld = 0.5;        // of the tolerance: still taken for touching
constexpr double kLevel = 1e-6;      // size of x and y of normals
constexpr int kRim = 8;              // places of flat bottoms besides the middle
constexpr double kInside = 0.99;     // of the bottom's radius
constexpr double kFarApart = 3.0;    // contacts against tips: the cutter leaps over a valley
constexpr std::array<double, 3> kParts = {0.35, 0.5, 0.65};  // between contacts

}  // namespace

double held_up(const Part& part, const Place& surface) {
  const Vec3 tip = part.cutter().tip(surface.contact, surface.normal);
  const auto held_at = [&](Vec2 axis) {
    const auto rest = part.drop(axis);
    if (!rest) return 0.0;
    return (rest->tip.z - tip.z) * std::max(surface.normal.z, rest->normal.z);
  };
  double held = held_at({tip.x, tip.y});
  const double flat = part.cutter().flat();
  if (!(flat > 0.0) || std::hypot(surface.normal.x, surface.normal.y) > kLevel) return held;
  for (int k = 0; k < kRim && held > 0.0; ++k) {  // level: each place of the bottom touches
    const double angle = 2.0 * std::numbers::pi * k / kRim;
    const Vec2 out{std::cos(angle), std::sin(angle)};
    held = std::min(held, held_at(Vec2{tip.x, tip.y} + kInside * flat * out));
  }
  return held;
}

ScallopMeter::ScallopMeter(const Part& part, double allowed) : part_(part), allowed_(allowed) {
  const double r = part.cutter().radius;
  const Vec3 low = part.field().low(), high = part.field().high();
  const double dx = high.x - low.x + 4.0 * r, dy = high.y - low.y + 4.0 * r;
  size_ = std::max(kCellOfRadius * r, std::sqrt(dx * dy / kMostCells));
  low_ = {low.x - 2.0 * r, low.y - 2.0 * r};
  nx_ = static_cast<std::size_t>(dx / size_) + 1;
  ny_ = static_cast<std::size_t>(dy / size_) + 1;
  cells_.resize(nx_ * ny_);
}

std::size_t ScallopMeter::cell(double value, double low, std::size_t count) const {
  const double k = std::floor((value - low) / size_);
  return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(count - 1)));
}

/// Places of the cutter between which it leaves nothing to speak of, as in `Walker`.
bool ScallopMeter::says_the_same(Vec3 a, Vec3 b) const {
  const CutterShape& cutter = part_.cutter();
  const double share = kOfAllowed * allowed_;
  const Vec3 way = b - a;
  const double level2 = way.x * way.x + way.y * way.y;
  return dot(way, way) <= 8.0 * cutter.corner * share ||
         (level2 <= 4.0 * cutter.flat() * share && std::abs(way.z) <= share);
}

void ScallopMeter::add(const Pass& pass) {
  for (const auto& piece : pass.pieces) {
    const Vec3* last = nullptr;
    for (const PassPoint& p : piece) {
      const Vec3& tip = p.place.tip;
      if (last != nullptr && &p != &piece.back() && says_the_same(*last, tip)) continue;
      last = &tip;
      cells_[cell(tip.y, low_.y, ny_) * nx_ + cell(tip.x, low_.x, nx_)].push_back(tip);
    }
  }
}

double ScallopMeter::distance(Vec3 p) const {
  const CutterShape& cutter = part_.cutter();
  const double reach = cutter.radius + size_;
  double best = std::numeric_limits<double>::infinity();
  const std::size_t x1 = cell(p.x + reach, low_.x, nx_), y1 = cell(p.y + reach, low_.y, ny_);
  for (std::size_t y = cell(p.y - reach, low_.y, ny_); y <= y1; ++y) {
    for (std::size_t x = cell(p.x - reach, low_.x, nx_); x <= x1; ++x) {
      for (const Vec3 tip : cells_[y * nx_ + x]) best = std::min(best, cutter.distance(p - tip));
    }
  }
  return best;
}

/// Up along the normal until the cutter has been there.
double ScallopMeter::left_over(const Place& q) const {
  const double most = allowed_;
  double up = 0.0;
  for (int k = 0; k < kTraceSteps && up < kLookedFor * most; ++k) {
    const double d = distance(q.contact + up * q.normal);
    if (d <= kTraced * most) break;
    up += d;
  }
  return std::min(up, kLookedFor * most);
}

void ScallopMeter::look_at(Vec3 middle, double reach, Gap& gap, double from, double to) const {
  const auto q = part_.surface_over({middle.x, middle.y});
  if (!q || std::abs(q->contact.z - middle.z) > reach) return;
  if (held_up(part_, *q) > kHeld * part_.tolerance()) return;
  const double height = left_over(*q);
  if (height <= allowed_) {
    gap.scallop = std::max(gap.scallop, height);
    return;
  }
  gap.too_high = true;
  gap.high.push_back(*q);
  gap.from = std::min(gap.from, from);
  gap.to = std::max(gap.to, to);
}

// Between the contacts; where they lie on different sides of the cutter, between the tips.
void ScallopMeter::measure(const PassPoint& a, const PassPoint& b, Gap& gap) const {
  const double from = std::min(a.t, b.t), to = std::max(a.t, b.t);
  const Vec3 tips = b.place.tip - a.place.tip, contacts = b.place.contact - a.place.contact;
  const bool leaps = norm(contacts) > kFarApart * norm(tips) || a.place.open || b.place.open;
  const Vec3 start = leaps ? a.place.tip : a.place.contact, way = leaps ? tips : contacts;
  const double reach = leaps ? 2.0 * part_.cutter().radius : norm(way);
  for (const double part : kParts) look_at(start + part * way, reach, gap, from, to);
}

Gap ScallopMeter::between(const Pass& a, const Pass& b, double spacing) const {
  std::vector<const PassPoint*> others;
  for (const auto& piece : b.pieces) {
    for (const PassPoint& p : piece) others.push_back(&p);
  }
  Gap gap;
  for (const auto& piece : a.pieces) {
    Vec3 last = piece.front().place.tip;
    bool first = true;
    for (const PassPoint& p : piece) {
      if (!first && norm(p.place.tip - last) < spacing) continue;
      first = false;
      last = p.place.tip;
      auto at = std::lower_bound(others.begin(), others.end(), p.t,
                                 [](const PassPoint* o, double t) { return o->t < t; });
      if (at == others.end()) continue;
      if (at != others.begin() && p.t - (*(at - 1))->t < (*at)->t - p.t) --at;
      if (norm((*at)->place.tip - last) > kFarApart * part_.cutter().radius) continue;
      measure(p, **at, gap);
    }
  }
  return gap;
}

}  // namespace obvid::toolpath
