// SPDX-License-Identifier: Apache-2.0
// Tables of arc length: docs/methods/curve.md, "Arc length".
#include "obvid/curve/internal/contour_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "obvid/core/internal/questions.h"
#include "obvid/numeric/internal/gauss.h"

namespace obvid {
namespace {

constexpr std::size_t kNodes = 8;
/// The error of the polynomial through the speeds at the nodes is largest at the ends of a cell;
/// that of its integral is some 0.03 of it, times the width.
constexpr double kOfEndError = 0.1;
constexpr double kSpeedRounding = 1e-13;  // of the piece's mean speed: smaller errors are noise
/// Halvings of the parameter. What still turns by more than a right angle within the last of them
/// is a cusp, at any accuracy.
constexpr int kDeepest = 24;
/// Of the root of the accuracy, and of a cell: after a step of Newton that is shorter the next one
/// would be some square of it.
constexpr double kOfRoot = 0.1;
constexpr double kShortestStep = 1e-8, kLongestStep = 1e-4;  // whatever the accuracy
constexpr std::size_t kMostCells = 1024;  // some 50 at a cusp; speeds that are noise need no more

using Nodes = std::array<double, kNodes>;
using Square = std::array<Nodes, kNodes>;

constexpr double node(std::size_t i) {
  return i < 4 ? -GaussRule<8>::kNode[3 - i] : GaussRule<8>::kNode[i - 4];
}
constexpr double weight(std::size_t i) { return GaussRule<8>::kWeight[i < 4 ? 3 - i : i - 4]; }

/// [k][i]: what the speed at node i gives to the factor of Legendre's polynomial k.
constexpr Square kToLegendre = [] {
  Square table{};
  for (std::size_t i = 0; i < kNodes; ++i) {
    double before = 0.0, here = 1.0;
    for (std::size_t k = 0; k < kNodes; ++k) {
      const auto n = static_cast<double>(k);
      table[k][i] = (n + 0.5) * weight(i) * here;
      const double next = ((2.0 * n + 1.0) * node(i) * here - n * before) / (n + 1.0);
      before = here;
      here = next;
    }
  }
  return table;
}();

/// [k][j]: factor of y^j in the mean over [0, y] of Legendre's polynomial k on [0, 1].
constexpr Square kMeanPowers = [] {
  Square table{};
  for (std::size_t k = 0; k < kNodes; ++k) {
    double factor = k % 2 == 0 ? 1.0 : -1.0;  // (-1)^(k+j) (k choose j) (k+j choose j)
    for (std::size_t j = 0; j <= k; ++j) {
      const auto n = static_cast<double>(k), m = static_cast<double>(j);
      table[k][j] = factor / (m + 1.0);
      factor *= -(n - m) * (n + m + 1.0) / ((m + 1.0) * (m + 1.0));
    }
  }
  return table;
}();

}  // namespace

/// Cuts a rational piece into cells.
class PieceLength::Builder {
 public:
  Builder(const RationalBezier& piece, double accuracy, PieceLength& out)
      : piece_(piece), accuracy_(accuracy), out_(out) {}

  void run() {
    const End start = end_at(0.0), end = end_at(1.0);
    mean_speed_ = std::max(gauss_integral<8>(0.0, 1.0, [&](double t) { return speed(t); }),
                           norm(end.point - start.point));
    if (!(mean_speed_ > 0.0)) {  // all in one point
      out_.cusp_ = 0.0;
      return;
    }
    cut(start, end, kDeepest);
  }

 private:
  struct End {
    double t = 0.0;
    Vec2 point, d1;
    double speed = 0.0;
  };

  [[nodiscard]] double speed(double t) const { return norm(evaluate(piece_, t).d1); }
  [[nodiscard]] End end_at(double t) const {
    const Jet jet = evaluate(piece_, t);
    return {t, jet.point, jet.d1, norm(jet.d1)};
  }

  void cut(const End& a, const End& b, int halvings) {
    const Cell cell = cell_between(a, b);
    const bool turns = !(dot(a.d1, b.d1) > 0.0);
    const bool goes_on = halvings > 0 && out_.cells_.size() < kMostCells;
    if (goes_on && (turns || !is_near(cell, a, b))) {
      const End middle = end_at(0.5 * (a.t + b.t));
      cut(a, middle, halvings - 1);
      cut(middle, b, halvings - 1);
      return;
    }
    if (turns && !out_.cusp_) out_.cusp_ = a.speed < b.speed ? a.t : b.t;
    out_.cells_.push_back(cell);
    out_.length_ += cell.length;
  }

  [[nodiscard]] Cell cell_between(const End& a, const End& b) const {
    Cell cell;
    cell.from = a.t;
    cell.width = b.t - a.t;
    cell.start = out_.length_;
    Nodes speeds{}, legendre{};
    for (std::size_t i = 0; i < kNodes; ++i) {
      speeds[i] = cell.width * speed(a.t + cell.width * 0.5 * (1.0 + node(i)));
    }
    for (std::size_t k = 0; k < kNodes; ++k) {
      for (std::size_t i = 0; i < kNodes; ++i) legendre[k] += kToLegendre[k][i] * speeds[i];
      cell.end_slope += legendre[k];
      for (std::size_t j = 0; j <= k; ++j) cell.c[j] += kMeanPowers[k][j] * legendre[k];
    }
    cell.length = within(cell, 1.0);
    return cell;
  }

  [[nodiscard]] bool is_near(const Cell& cell, const End& a, const End& b) const {
    const double error = std::max(std::abs(cell.c[0] - cell.width * a.speed),
                                  std::abs(cell.end_slope - cell.width * b.speed));
    if (error <= kSpeedRounding * mean_speed_ * cell.width) return true;
    // where nearly all of the way lies between two nodes it is shorter than its chord
    const double chord = norm(b.point - a.point);
    return kOfEndError * error <= accuracy_ * mean_speed_ &&
           chord - cell.length <= accuracy_ * mean_speed_;
  }

  const RationalBezier& piece_;
  double accuracy_;
  double mean_speed_ = 0.0;
  PieceLength& out_;
};

PieceLength::PieceLength(const Piece& piece, double accuracy)
    : settled_(std::clamp(kOfRoot * std::sqrt(accuracy), kShortestStep, kLongestStep)) {
  if (const auto* rational = std::get_if<RationalBezier>(&piece)) {
    Builder(*rational, std::max(accuracy, kFinestLength), *this).run();
  } else {
    length_ = arc_length(piece, 0.0);  // closed forms: nothing to refine
  }
}

double PieceLength::within(const Cell& cell, double y) {
  double sum = cell.c.back();
  for (std::size_t j = kTerms - 1; j-- > 0;) sum = sum * y + cell.c[j];
  return y * sum;
}

/// Newton's method for y, kept between bounds.
double PieceLength::inverse(const Cell& cell, double s) const {
  // The inverse function's cubic by values and slopes at the ends of the cell is good to some 1e-4
  // where the speed is even: one or two steps of Newton leave rounding.
  const double x = s / cell.length, z = 1.0 - x;
  double y = x * x * (3.0 - 2.0 * x) + cell.length * x * z * (z / cell.c[0] - x / cell.end_slope);
  double low = 0.0, high = 1.0;
  constexpr int kMostSteps = 60;  // halvings of [0, 1] to rounding

  for (int step = 0; step < kMostSteps; ++step) {
    if (!(y > low && y < high)) y = 0.5 * (low + high);
    double sum = cell.c.back(), slope = 0.0;
    for (std::size_t j = kTerms - 1; j-- > 0;) {
      slope = slope * y + sum;
      sum = sum * y + cell.c[j];
    }
    const double error = y * sum - s;
    (error > 0.0 ? high : low) = y;
    const double move = error / (sum + y * slope);
    y -= move;
    if (std::abs(move) < settled_) break;
  }
  return std::clamp(y, 0.0, 1.0);
}

double PieceLength::at(double t) const {
  t = std::clamp(t, 0.0, 1.0);
  if (cells_.empty() || t == 1.0) return t * length_;
  const auto above = std::upper_bound(cells_.begin() + 1, cells_.end(), t,
                                      [](double x, const Cell& cell) { return x < cell.from; });
  const Cell& cell = *(above - 1);
  return cell.start + within(cell, (t - cell.from) / cell.width);
}

double PieceLength::parameter(double s) const {
  if (!(s > 0.0)) return 0.0;
  if (s >= length_) return 1.0;
  if (cells_.empty()) return s / length_;
  const auto above = std::upper_bound(cells_.begin() + 1, cells_.end(), s,
                                      [](double x, const Cell& cell) { return x < cell.start; });
  const Cell& cell = *(above - 1);
  return cell.from + cell.width * inverse(cell, std::min(s - cell.start, cell.length));
}

ContourPath::ContourPath(std::span<const Piece> pieces, double accuracy, Watch* watch)
    : pieces_(pieces) {
  lengths_.reserve(pieces.size());
  start_.reserve(pieces.size() + 1);
  start_.push_back(0.0);
  const Piece none = LinePiece{};
  Questions questions(watch);
  for (const Piece& piece : pieces) {
    lengths_.emplace_back(questions.end() ? none : piece, accuracy);
    start_.push_back(start_.back() + lengths_.back().length());
  }
}

Result<ContourPath> ContourPath::without_cusps(std::span<const Piece> pieces, double accuracy) {
  ContourPath path(pieces, accuracy);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const auto cusp = path.lengths_[k].cusp();
    if (!cusp) continue;
    const Vec2 p = evaluate(pieces[k], *cusp).point;
    return error(ErrorCode::kChordReversal,
                 fmt::format("the curve has no tangent at ({:.10g}, {:.10g})", p.x, p.y))
        .hint("cut it there")
        .point(k)
        .value(*cusp);
  }
  return path;
}

double ContourPath::length_at(std::size_t piece, double t) const {
  return t >= 1.0 ? start_[piece + 1] : start_[piece] + lengths_[piece].at(t);
}

ContourPath::Parameter ContourPath::parameter(double s, bool before_joint) const {
  const auto first = start_.begin() + 1, last = start_.end() - 1;
  const auto above =
      before_joint ? std::lower_bound(first, last, s) : std::upper_bound(first, last, s);
  const auto k = static_cast<std::size_t>(above - first);
  if (s >= start_[k + 1]) return {k, 1.0};
  return {k, lengths_[k].parameter(s - start_[k])};
}

Jet ContourPath::jet(double s, bool before_joint) const {
  const Parameter here = parameter(s, before_joint);
  return evaluate(pieces_[here.piece], here.t);
}

ContourPath::Place ContourPath::at(double s, bool before_joint) const {
  const Jet here = jet(s, before_joint);
  return {here.point, here.d1 / norm(here.d1), curvature(here)};
}

double ContourPath::nearest(Vec2 p, double guess, double from, double to) const {
  double s = std::clamp(guess, from, to);
  const double settled = kFinestLength * length();  // arc lengths are not known better
  for (int step = 0; step < 50; ++step) {
    const Place place = at(s);
    const Vec2 away = p - place.point;
    // Newton for the foot of the perpendicular; where the point lies beyond the centre of
    // curvature the plain step goes downhill all the same
    const double bend = 1.0 - place.kappa * dot(away, left_normal(place.tangent));
    const double move = dot(away, place.tangent) / std::max(bend, 0.5);
    const double next = std::clamp(s + move, from, to);
    if (std::abs(next - s) <= settled) return next;
    s = next;
  }
  return s;
}

}  // namespace obvid
