// SPDX-License-Identifier: Apache-2.0
#include "cell_judge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "obvid/geom/internal/chord.h"

namespace obvid::mesh {
namespace {

/// Steps within a span of degree 2 and more: quarters see parabolas at their highest and the two
/// bulges of a cubic at 0.97 of it. Cells of several spans get halves of each.
constexpr std::size_t kStepsInSpan = 4;
constexpr std::size_t kStepsPerSpan = 2;
/// Cells of more spans are looked at with so many steps first: most fail there.
constexpr std::size_t kFewSteps = 4;
/// Rows that are held at a time when all spans of a large cell are looked at.
constexpr std::size_t kRows = 64;
/// Cells smaller than this part of the chord tolerance may bend as they like: normals at cusps and
/// folds never settle.
constexpr double kPoint = 1.0 / 32.0;
/// Samples see a little less than the greatest distance and angle.
constexpr double kOfTolerance = 0.97;
constexpr double kOfAngle = 0.98;

/// Places of a cell in one direction, at most `most` steps (0: all that the spans need).
void spread_places(const PatchAxis& axis, Line from, Line to, std::size_t most,
                   std::vector<Place>& out) {
  out.clear();
  const std::size_t first = span_of(from), spans = spans_between(from, to);
  const double low = axis.at(from), high = axis.at(to);
  const std::size_t per_span = spans == 1 && axis.degree() > 1 ? kStepsInSpan : kStepsPerSpan;
  const std::size_t steps = spans * per_span;
  const std::size_t taken = most == 0 ? steps : std::min(most, steps);
  for (std::size_t i = 0; i < taken; ++i) {
    const std::size_t step = i * steps / taken, k = first + step / per_span;
    const double begin = std::max(low, axis.end(k)), end = std::min(high, axis.end(k + 1));
    const double part = static_cast<double>(step % per_span) / static_cast<double>(per_span);
    out.push_back({k, begin + part * (end - begin)});
  }
  out.push_back({first + spans - 1, high});
}

/// Gap between a triangle's point and the surface's: what of it lies along the normal.
double height(Vec3 gap, Vec3 normal) {
  return normal == Vec3{} ? norm(gap) : std::fabs(dot(gap, normal));
}

}  // namespace

std::size_t spans_between(Line from, Line to) { return span_of(to - 1) - span_of(from) + 1; }

struct CellJudge::Grid {
  const std::vector<Place>& us;
  const std::vector<Place>& vs;
  const std::vector<Sample>& samples;
  double u0, u1, v0, v1;
  Vec3 corner[4];                 ///< (u0, v0), (u1, v0), (u0, v1), (u1, v1)
  bool border_u[2], border_v[2];  ///< the side lies on the patch's border

  [[nodiscard]] const Sample& at(std::size_t i, std::size_t j) const {
    return samples[j * us.size() + i];
  }
  [[nodiscard]] double x(std::size_t i) const { return (us[i].t - u0) / (u1 - u0); }
  [[nodiscard]] double y(std::size_t j) const { return (vs[j].t - v0) / (v1 - v0); }
};

struct CellJudge::Errors {
  double rising = 0.0, falling = 0.0;
};

CellJudge::CellJudge(PatchSampler& sampler, const TessellationOptions& options)
    : sampler_(sampler),
      chord_(kOfTolerance * options.chord_tolerance),
      spread_(2.0 * std::sin(std::min(kOfAngle * options.angle, std::numbers::pi) / 4.0)),
      bend_(2.0 * std::sin(std::min(kOfAngle * options.angle, std::numbers::pi) / 2.0)) {}

CellJudge::Grid CellJudge::grid_of(const Cell& cell) const {
  const PatchAxis &u = sampler_.u(), &v = sampler_.v();
  Grid g{us_,
         vs_,
         samples_,
         u.at(cell.u0),
         u.at(cell.u1),
         v.at(cell.v0),
         v.at(cell.v1),
         {},
         {cell.u0 == 0, cell.u1 == u.last()},
         {cell.v0 == 0, cell.v1 == v.last()}};
  const std::size_t nu = us_.size(), n = samples_.size();
  g.corner[0] = samples_[0].point;
  g.corner[1] = samples_[nu - 1].point;
  g.corner[2] = samples_[n - nu].point;
  g.corner[3] = samples_[n - 1].point;
  return g;
}

// Both ways of cutting the cell into two triangles at once.
CellJudge::Errors CellJudge::errors_of(const Grid& g) const {
  Errors worst;
  const Vec3 &a = g.corner[0], &b = g.corner[1], &c = g.corner[2], &d = g.corner[3];
  for (std::size_t j = 0; j < g.vs.size(); ++j) {
    const double y = g.y(j);
    for (std::size_t i = 0; i < g.us.size(); ++i) {
      const double x = g.x(i);
      const Sample& s = g.at(i, j);
      const Vec3 rising = y < x ? a + x * (b - a) + y * (d - b) : a + y * (c - a) + x * (d - c);
      const Vec3 falling = x + y < 1.0 ? a + x * (b - a) + y * (c - a)
                                       : d + (1.0 - x) * (c - d) + (1.0 - y) * (b - d);
      worst.rising = std::max(worst.rising, height(rising - s.point, s.normal));
      worst.falling = std::max(worst.falling, height(falling - s.point, s.normal));
      if (std::min(worst.rising, worst.falling) > chord_) return worst;
    }
  }
  return worst;
}

/// Sides on the border have to lie near the border itself, not only near the surface.
double CellJudge::border_error(const Grid& g) const {
  double worst = 0.0;
  const std::size_t nu = g.us.size(), nv = g.vs.size();
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t i = 0; g.border_v[side] && i < nu; ++i) {
      const Vec3 p = g.at(i, side == 0 ? 0 : nv - 1).point;
      worst = std::max(worst, distance_from_chord(p, g.corner[2 * side], g.corner[2 * side + 1]));
    }
    for (std::size_t j = 0; g.border_u[side] && j < nv; ++j) {
      const Vec3 p = g.at(side == 0 ? 0 : nu - 1, j).point;
      worst = std::max(worst, distance_from_chord(p, g.corner[side], g.corner[side + 2]));
    }
  }
  return worst;
}

bool CellJudge::bends_too_much(const Grid& g, Vec3 middle) const {
  bool bends = false;
  double size2 = 0.0;
  for (const Sample& s : g.samples) {
    const Vec3 gap = s.normal - middle, way = s.point - g.corner[0];
    bends = bends || (dot(gap, gap) > spread_ * spread_ && s.normal != Vec3{});
    size2 = std::max(size2, dot(way, way));
  }
  const double smallest = kPoint * chord_;
  return bends && size2 > smallest * smallest;
}

/// Across which direction the cell is more bent; a twisted cell is cut across its longer side.
bool CellJudge::cut_is_u(const Grid& g) const {
  const std::size_t nu = g.us.size(), nv = g.vs.size();
  double error[2] = {}, turn[2] = {}, length[2] = {};
  const auto look = [&](int way, std::size_t count, bool border, double part_of, auto&& sample) {
    const Sample &first = sample(0), &last = sample(count - 1);
    double run = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      const Sample& s = sample(k);
      const double part = way == 0 ? g.x(k) : g.y(k);
      const Vec3 gap = first.point + part * (last.point - first.point) - s.point;
      const double off =
          border ? distance_from_chord(s.point, first.point, last.point) : height(gap, s.normal);
      error[way] = std::max(error[way], off);
      turn[way] =
          std::max({turn[way], norm(s.normal - first.normal), norm(s.normal - last.normal)});
      if (k > 0) run += norm(s.point - sample(k - 1).point);
    }
    length[way] = std::max(length[way], part_of * run);
  };
  for (std::size_t j = 0; j < nv; ++j) {
    const bool border = (j == 0 && g.border_v[0]) || (j + 1 == nv && g.border_v[1]);
    look(0, nu, border, 1.0, [&](std::size_t i) -> const Sample& { return g.at(i, j); });
  }
  for (std::size_t i = 0; i < nu; ++i) {
    const bool border = (i == 0 && g.border_u[0]) || (i + 1 == nu && g.border_u[1]);
    look(1, nv, border, 1.0, [&](std::size_t j) -> const Sample& { return g.at(i, j); });
  }
  const Vec3 twist = 0.25 * (g.corner[0] - g.corner[1] - g.corner[2] + g.corner[3]);
  error[length[0] >= length[1] ? 0 : 1] += height(twist, g.at(nu / 2, nv / 2).normal);
  const auto score = [&](int way) {
    return std::max(error[way] / chord_, turn[way] * turn[way] / (bend_ * bend_));
  };
  const double su = score(0), sv = score(1);
  return su != sv ? su > sv : length[0] >= length[1];
}

CellJudge::Verdict CellJudge::judge_grid(const Grid& g) const {
  Vec3 sum;
  for (const Sample& s : g.samples) sum = sum + s.normal;
  const Vec3 middle = unit(sum);
  const Errors e = errors_of(g);
  Verdict verdict;
  verdict.rising = e.rising <= e.falling;
  verdict.good = std::min(e.rising, e.falling) <= chord_ && border_error(g) <= chord_ &&
                 !bends_too_much(g, middle);
  if (!verdict.good) verdict.cut_u = cut_is_u(g);
  return verdict;
}

/// A large cell that looks good: every span, some rows at a time.
CellJudge::Verdict CellJudge::judge_all(const Cell& cell, Vec3 middle) {
  Grid g = grid_of(cell);  // corners as they are
  spread_places(sampler_.u(), cell.u0, cell.u1, 0, us_);
  std::vector<Place> all;
  spread_places(sampler_.v(), cell.v0, cell.v1, 0, all);
  Errors worst;
  Verdict verdict;
  verdict.cut_u = spans_between(cell.u0, cell.u1) >= spans_between(cell.v0, cell.v1);
  const bool borders[2] = {g.border_v[0], g.border_v[1]};
  for (std::size_t row = 0; row < all.size(); row += kRows) {
    const std::size_t end = std::min(all.size(), row + kRows);
    vs_.assign(all.begin() + static_cast<std::ptrdiff_t>(row),
               all.begin() + static_cast<std::ptrdiff_t>(end));
    sampler_.block(us_, vs_, samples_);
    g.border_v[0] = borders[0] && row == 0;
    g.border_v[1] = borders[1] && end == all.size();
    const Errors e = errors_of(g);
    worst = {std::max(worst.rising, e.rising), std::max(worst.falling, e.falling)};
    const bool good = std::min(worst.rising, worst.falling) <= chord_ &&
                      border_error(g) <= chord_ && !bends_too_much(g, middle);
    if (!good) return verdict;
  }
  verdict.good = true;
  verdict.rising = worst.rising <= worst.falling;
  return verdict;
}

void CellJudge::look_at(const Cell& cell) {
  spread_places(sampler_.u(), cell.u0, cell.u1, kFewSteps, us_);
  spread_places(sampler_.v(), cell.v0, cell.v1, kFewSteps, vs_);
  sampler_.block(us_, vs_, samples_);
}

bool CellJudge::cut_u(const Cell& cell) {
  look_at(cell);
  return cut_is_u(grid_of(cell));
}

CellJudge::Verdict CellJudge::judge(const Cell& cell) {
  const std::size_t nu = spans_between(cell.u0, cell.u1), nv = spans_between(cell.v0, cell.v1);
  look_at(cell);
  const Verdict verdict = judge_grid(grid_of(cell));
  const bool seen = std::max(nu, nv) * kStepsPerSpan <= kFewSteps;
  if (!verdict.good || seen) return verdict;
  Vec3 sum;
  for (const Sample& s : samples_) sum = sum + s.normal;
  return judge_all(cell, unit(sum));
}

}  // namespace obvid::mesh
