// SPDX-License-Identifier: Apache-2.0
// The G2 clothoid spline: docs/methods/clothoids.md, section 3.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "chord_clothoid.h"
#include "chords.h"
#include "obvid/contour/clothoids.h"
#include "obvid/geom/internal/angle.h"

namespace obvid {
namespace {

using clothoids::ChordClothoid;
using clothoids::Chords;
using clothoids::ChordSlopes;

constexpr int kMostSplineSteps = 60;
constexpr double kLargestStep = 0.5;    // rad, of a heading; farther the model says nothing
constexpr double kConverged = 1e-13;    // of a heading, rad
constexpr double kLargestJump = 1e-10;  // of curvature, times the chord: what counts as G2

/// End curvatures and sharpness of one chord's clothoid with their slopes by both end headings,
/// made free of units by the chord.
struct Segment {
  double kappa0 = 0.0, kappa1 = 0.0, sharpness = 0.0;
  std::array<double, 2> kappa0_by{}, kappa1_by{}, sharpness_by{};
  double shrink = 1.0;
};

bool evaluate_segment(double alpha, double beta, Segment& out) {
  if (!(std::max(std::abs(alpha), std::abs(beta)) < std::numbers::pi)) return false;
  ChordSlopes slopes;
  const ChordClothoid c = clothoids::solve_chord(alpha, beta, slopes);
  if (!c.found) return false;
  const double start = c.linear - 2.0 * c.square, end = c.linear + 2.0 * c.square;
  out.shrink = c.shrink;
  out.kappa0 = 2.0 * c.shrink * start;
  out.kappa1 = 2.0 * c.shrink * end;
  out.sharpness = 8.0 * c.square * c.shrink * c.shrink;
  for (std::size_t j = 0; j < 2; ++j) {
    const double linear_by = j == 0 ? -0.5 : 0.5;
    const double square_by = 0.5 * slopes.square_by_half_sum + linear_by * slopes.square_by_linear;
    const double shrink_by = 0.5 * slopes.shrink_by_half_sum + linear_by * slopes.shrink_by_linear;
    out.kappa0_by[j] = 2.0 * (shrink_by * start + c.shrink * (linear_by - 2.0 * square_by));
    out.kappa1_by[j] = 2.0 * (shrink_by * end + c.shrink * (linear_by + 2.0 * square_by));
    out.sharpness_by[j] = 8.0 * c.shrink * (square_by * c.shrink + 2.0 * c.square * shrink_by);
  }
  return true;
}

/// One equation per heading: coefficients of the headings before, here and behind.
struct Row {
  double before = 0.0, here = 0.0, behind = 0.0, right = 0.0;
};

class SplineSolver {
 public:
  SplineSolver(const std::vector<Vec2>& points, Chords chords, const EndHeadings& ends)
      : points_(points), chords_(std::move(chords)), ends_(ends), segments_(points.size() - 1) {
    start_with_circles();
  }

  Result<ClothoidSpline> run() {
    for (int step = 0; step < kMostSplineSteps; ++step) {
      if (!evaluate_all()) return refuse();
      ++steps_;
      if (take_step() <= kConverged) break;
    }
    if (!evaluate_all() || !(largest_jump() <= kLargestJump)) return refuse();
    return result();
  }

 private:
  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] double h(std::size_t i) const { return chords_.length[i]; }

  /// Headings of the circles through three neighbours.
  void start_with_circles() {
    const auto& w = chords_.omega;
    const std::size_t n = size();
    theta_.resize(n);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      theta_[i] = (w[i - 1] * h(i) + w[i] * h(i - 1)) / (h(i - 1) + h(i));
    }
    const auto near = [](double given, double own) { return nearest_angle(given, own); };
    const double first = 2.0 * w.front() - theta_[1], last = 2.0 * w.back() - theta_[n - 2];
    theta_.front() = ends_.start ? near(*ends_.start, w.front()) : first;
    theta_.back() = ends_.end ? near(*ends_.end, w.back()) : last;
  }

  bool evaluate_all() {
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      const double omega = chords_.omega[i];
      if (!evaluate_segment(theta_[i] - omega, theta_[i + 1] - omega, segments_[i])) return false;
    }
    return true;
  }

  [[nodiscard]] double jump(std::size_t i) const {
    return segments_[i - 1].kappa1 / h(i - 1) - segments_[i].kappa0 / h(i);
  }

  [[nodiscard]] double largest_jump() const {
    double worst = 0.0;
    for (std::size_t i = 1; i + 1 < size(); ++i) {
      worst = std::max(worst, std::abs(jump(i)) * std::min(h(i - 1), h(i)));
    }
    return worst;
  }

  [[nodiscard]] Row joint_row(std::size_t i) const {
    const Segment &left = segments_[i - 1], &right = segments_[i];
    return {left.kappa1_by[0] / h(i - 1), left.kappa1_by[1] / h(i - 1) - right.kappa0_by[0] / h(i),
            -right.kappa0_by[1] / h(i), -jump(i)};
  }

  /// Sharpness of chords i and i + 1 is the same: coefficients of headings i, i + 1, i + 2.
  [[nodiscard]] Row sharpness_row(std::size_t i) const {
    const double a = 1.0 / (h(i) * h(i)), b = 1.0 / (h(i + 1) * h(i + 1));
    const Segment &s = segments_[i], &t = segments_[i + 1];
    return {a * s.sharpness_by[0], a * s.sharpness_by[1] - b * t.sharpness_by[0],
            -b * t.sharpness_by[1], b * t.sharpness - a * s.sharpness};
  }

  [[nodiscard]] Row first_row(const Row& second) const {
    if (ends_.start) return {0.0, 1.0, 0.0, 0.0};
    const Row r = sharpness_row(0);
    const double f = r.behind / second.behind;  // takes the third heading out of the first row
    return {0.0, r.before - f * second.before, r.here - f * second.here,
            r.right - f * second.right};
  }

  [[nodiscard]] Row last_row(const Row& last_but_one) const {
    if (ends_.end) return {0.0, 1.0, 0.0, 0.0};
    const std::size_t n = size();
    if (n == 3 && !ends_.start) {  // three points say no more than a circle
      const Segment& s = segments_[1];
      return {s.sharpness_by[0], s.sharpness_by[1], 0.0, -s.sharpness};
    }
    const Row r = sharpness_row(n - 3);
    const double f = r.before / last_but_one.before;
    return {r.here - f * last_but_one.here, r.behind - f * last_but_one.behind, 0.0,
            r.right - f * last_but_one.right};
  }

  /// Solves the tridiagonal system and moves the headings; returns the largest move.
  double take_step() {
    const std::size_t n = size();
    rows_.resize(n);
    for (std::size_t i = 1; i + 1 < n; ++i) rows_[i] = joint_row(i);
    rows_[0] = first_row(rows_[1]);
    rows_[n - 1] = last_row(rows_[n - 2]);
    for (std::size_t i = 1; i < n; ++i) {
      const double f = rows_[i].before / rows_[i - 1].here;
      rows_[i].here -= f * rows_[i - 1].behind;
      rows_[i].right -= f * rows_[i - 1].right;
    }
    double largest = 0.0, after = 0.0;
    for (std::size_t i = n; i-- > 0;) {
      after = (rows_[i].right - rows_[i].behind * after) / rows_[i].here;
      rows_[i].right = after;
      largest = std::max(largest, std::abs(after));
    }
    const double part = largest > kLargestStep ? kLargestStep / largest : 1.0;
    for (std::size_t i = 0; i < n; ++i) theta_[i] += part * rows_[i].right;
    return largest;
  }

  [[nodiscard]] tl::unexpected<Error> refuse() const {
    return tl::unexpected(
        Error{ErrorCode::kNotProved, "no clothoid spline was found through the points", "",
              "add points where the series turns far, or use another carrier", -1, largest_jump()});
  }

  [[nodiscard]] ClothoidSpline result() const {
    ClothoidSpline out;
    const std::size_t n = size();
    for (std::size_t i = 0; i < n; ++i) {
      // both sides agree to rounding; neighbours share one number
      const double left = i > 0 ? segments_[i - 1].kappa1 / h(i - 1) : segments_[0].kappa0 / h(0);
      const double right = i + 1 < n ? segments_[i].kappa0 / h(i) : left;
      out.elements.push_back({points_[i], theta_[i], 0.5 * (left + right)});
    }
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const Element &a = out.elements[i], &b = out.elements[i + 1];
      out.pieces.push_back(
          {a.point, b.point, a.theta, a.kappa, b.kappa, h(i) / segments_[i].shrink});
    }
    out.newton_steps = steps_;
    return out;
  }

  const std::vector<Vec2>& points_;
  Chords chords_;
  EndHeadings ends_;
  std::vector<Segment> segments_;
  std::vector<double> theta_;
  std::vector<Row> rows_;
  int steps_ = 0;
};

}  // namespace

Result<ClothoidSpline> clothoid_spline(const std::vector<Vec2>& points, const EndHeadings& ends) {
  constexpr std::size_t kFewest = 3;
  auto chords = clothoids::chords_of(points, kFewest);
  if (!chords) return tl::unexpected(chords.error());
  return SplineSolver(points, std::move(*chords), ends).run();
}

}  // namespace obvid
