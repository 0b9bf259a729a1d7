// SPDX-License-Identifier: Apache-2.0
#include "approximate_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace obvid {
namespace {

constexpr std::size_t kBand = kMostLineDegree + 1;  // B-splines that are not zero at a parameter

using BandRow = std::array<double, kBand>;

/// (a, b) turned: a becomes c a + s b, b becomes c b - s a.
void rotate(Vec3* a, Vec3* b, std::size_t count, double c, double s) {
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 old = a[i];
    a[i] = c * old + s * b[i];
    b[i] = c * b[i] - s * old;
  }
}

/// Upper triangle of a banded system that takes one equation after the other; their first columns
/// must not descend.
class Triangle {
 public:
  Triangle(std::size_t size, std::size_t width) : band_(size, BandRow{}) {
    right_.width = width;
    right_.points.assign(size * width, Vec3{});
  }

  /// Coefficient k is given.
  void set(std::size_t k, const Vec3* value) {
    band_[k] = {1.0};
    std::copy(value, value + right_.width, right_.row(k));
  }

  void add(std::size_t first, BandRow row, std::vector<Vec3>& right) {
    for (std::size_t k = first; k < band_.size(); ++k) {
      if (row[0] != 0.0) {
        BandRow& pivot = band_[k];
        const double length = std::hypot(pivot[0], row[0]);
        const double c = pivot[0] / length, s = row[0] / length;
        for (std::size_t j = 0; j < kBand; ++j) {
          const double old = pivot[j];
          pivot[j] = c * old + s * row[j];
          row[j] = c * row[j] - s * old;
        }
        rotate(right_.row(k), right.data(), right_.width, c, s);
      }
      std::rotate(row.begin(), row.begin() + 1, row.end());
      row.back() = 0.0;
      if (row == BandRow{}) return;
    }
  }

  /// Solution x of R^T R x = right, R this triangle.
  [[nodiscard]] std::vector<double> solve_twice(std::vector<double> right) const {
    const std::size_t n = band_.size();
    for (std::size_t k = 0; k < n; ++k) {
      right[k] /= band_[k][0];
      for (std::size_t j = 1; j < kBand && k + j < n; ++j) right[k + j] -= band_[k][j] * right[k];
    }
    for (std::size_t k = n; k-- > 0;) {
      for (std::size_t j = 1; j < kBand && k + j < n; ++j) right[k] -= band_[k][j] * right[k + j];
      right[k] /= band_[k][0];
    }
    return right;
  }

  [[nodiscard]] bool solve(Rows& solution) {
    // B-splines sum to 1: a pivot this small means that a coefficient has nearly no data
    constexpr double kSmallestPivot = 1e-9;
    const std::size_t n = band_.size(), width = right_.width;
    for (std::size_t k = n; k-- > 0;) {
      if (!(std::abs(band_[k][0]) > kSmallestPivot)) return false;
      Vec3* here = right_.row(k);
      for (std::size_t j = 1; j < kBand && k + j < n; ++j) {
        const double factor = band_[k][j];
        if (factor == 0.0) continue;
        const Vec3* known = right_.row(k + j);
        for (std::size_t i = 0; i < width; ++i) here[i] = here[i] - factor * known[i];
      }
      const double inverse = 1.0 / band_[k][0];
      for (std::size_t i = 0; i < width; ++i) here[i] = inverse * here[i];
    }
    solution = std::move(right_);
    return true;
  }

 private:
  std::vector<BandRow> band_;
  Rows right_;
};

}  // namespace

Rows transposed(const Rows& rows) {
  constexpr std::size_t kTile = 16;  // both sides of a tile stay in the nearest cache
  const std::size_t count = rows.count(), width = rows.width;
  Rows out{count, std::vector<Vec3>(rows.points.size())};
  for (std::size_t j0 = 0; j0 < count; j0 += kTile) {
    for (std::size_t i0 = 0; i0 < width; i0 += kTile) {
      for (std::size_t j = j0; j < std::min(count, j0 + kTile); ++j) {
        for (std::size_t i = i0; i < std::min(width, i0 + kTile); ++i) {
          out.points[i * count + j] = rows.points[j * width + i];
        }
      }
    }
  }
  return out;
}

/// Coefficients that the point and the derivatives at an end leave no choice. At the last end
/// lengths are counted backwards: odd derivatives change their sign.
bool end_coefficients(int degree, const std::vector<double>& knots, const LineEnds& kept,
                      Rows& first, Rows& last) {
  const auto p = static_cast<std::size_t>(degree);
  const std::size_t most = knots.size() - p - 1;
  const auto rows = [](const Rows& r) { return r.width == 0 ? 0 : r.count(); };
  const std::size_t at_first = rows(kept.first), at_last = rows(kept.last);
  if (at_first + at_last > most || std::max(at_first, at_last) > 3) return false;
  const double d = degree;
  const auto made = [&](const Rows& given, std::size_t count, bool backwards) {
    Rows out = given;
    // distance of the inner knot number k from that end
    const auto length = [&](std::size_t k) {
      return backwards ? knots.back() - knots[knots.size() - 1 - p - k]
                       : knots[p + k] - knots.front();
    };
    const double sign = backwards ? -1.0 : 1.0;
    for (std::size_t j = 0; j < given.width && count > 1; ++j) {
      const Vec3 slope = sign * given.row(1)[j];
      out.row(1)[j] = given.row(0)[j] + length(1) / d * slope;
      if (count < 3) continue;
      const Vec3 bend = given.row(2)[j];
      const Vec3 next = slope / d + length(1) / (d * (d - 1.0)) * bend;
      out.row(2)[j] = out.row(1)[j] + length(2) * next;
    }
    return out;
  };
  first = made(kept.first, at_first, false);
  const Rows mirrored = made(kept.last, at_last, true);
  last = mirrored;
  for (std::size_t k = 0; k < at_last; ++k) {
    std::copy_n(mirrored.row(k), mirrored.width, last.row(at_last - 1 - k));
  }
  return true;
}

std::vector<double> knot_needs(int degree, const std::vector<double>& knots,
                               const Rows& coefficients) {
  const auto p = static_cast<std::size_t>(degree);
  const std::size_t inner = knots.size() - 2 * p - 2, width = coefficients.width;
  std::vector<double> need(inner, 0.0);
  Rows differences = coefficients;  // of order r: r-th derivatives but for a factor
  for (std::size_t r = 1; r <= p && inner > 0; ++r) {
    for (std::size_t k = 0; k + r < coefficients.count(); ++k) {
      const double inverse = 1.0 / (knots[k + p + 1] - knots[k + r]);
      Vec3* here = differences.row(k);
      const Vec3* next = differences.row(k + 1);
      for (std::size_t i = 0; i < width; ++i) here[i] = inverse * (next[i] - here[i]);
    }
  }
  for (std::size_t k = 0; k < inner; ++k) {
    const double h = (knots[p + k + 2] - knots[p + k]) / 2.0;
    double jump = 0.0;
    for (std::size_t i = 0; i < width; ++i) {
      jump = std::max(jump, norm(differences.row(k + 1)[i] - differences.row(k)[i]));
    }
    need[k] = jump * std::pow(h, degree);
  }
  return need;
}

SplineLine::SplineLine(std::vector<double> parameters, int degree, double most_swing)
    : degree_(std::min(degree, static_cast<int>(parameters.size()) - 1)),
      most_swing_(most_swing),
      at_(std::move(parameters)) {
  const auto order = static_cast<std::size_t>(degree_) + 1;
  std::vector<double> knots(order, at_.front());
  knots.insert(knots.end(), order, at_.back());
  set_knots(std::move(knots));
}

void SplineLine::set_knots(std::vector<double> knots) {
  knots_ = std::move(knots);
  basis_.clear();
  basis_.reserve(at_.size());
  for (const double t : at_) basis_.push_back(basis_at(degree_, knots_, t, 0));
}

bool SplineLine::fit(const Rows& data, const LineEnds& kept, Rows& coefficients) const {
  const std::size_t n = this->coefficients(), m = at_.size(), width = data.width;
  Rows first, last;
  if (!end_coefficients(degree_, knots_, kept, first, last)) return false;
  const std::size_t from = first.width == 0 ? 0 : first.count();
  const std::size_t to = n - (last.width == 0 ? 0 : last.count());
  const auto known = [&](std::size_t k) {
    return k < from ? first.row(k) : k >= to ? last.row(k - to) : nullptr;
  };
  Triangle triangle(n, width);
  for (std::size_t k = 0; k < n; ++k) {
    if (const Vec3* row = known(k)) triangle.set(k, row);
  }
  std::vector<Vec3> right(width);
  for (std::size_t i = from > 0 ? 1 : 0; i < (to < n ? m - 1 : m); ++i) {
    const BasisValues& basis = basis_[i];
    BandRow row{};
    std::copy_n(basis.value[0].begin(), static_cast<std::size_t>(degree_) + 1, row.begin());
    std::copy(data.row(i), data.row(i) + width, right.begin());
    for (std::size_t k = 0; k <= static_cast<std::size_t>(degree_); ++k) {
      const Vec3* given = known(basis.first + k);
      if (given == nullptr) continue;
      const double factor = std::exchange(row[k], 0.0);
      for (std::size_t j = 0; j < width; ++j) right[j] = right[j] - factor * given[j];
    }
    triangle.add(basis.first, row, right);
  }
  return triangle.solve(coefficients);
}

Rows SplineLine::values(const Rows& coefficients) const {
  Rows out{coefficients.width, std::vector<Vec3>(at_.size() * coefficients.width)};
  for (std::size_t i = 0; i < at_.size(); ++i) {
    Vec3* here = out.row(i);
    for (std::size_t k = 0; k <= static_cast<std::size_t>(degree_); ++k) {
      const double share = basis_[i].value[0][k];
      if (share == 0.0) continue;
      const Vec3* from = coefficients.row(basis_[i].first + k);
      for (std::size_t j = 0; j < out.width; ++j) here[j] = here[j] + share * from[j];
    }
  }
  return out;
}

bool SplineLine::determined(const std::vector<double>& knots) const {
  const auto order = static_cast<std::size_t>(degree_) + 1;
  const std::size_t n = knots.size() - order;
  std::size_t next = 0;
  for (std::size_t k = 0; k < n; ++k) {
    // the first and the last B-spline are 1 at the ends; all others vanish at their outer knots
    while (next < at_.size() && k > 0 && !(at_[next] > knots[k])) ++next;
    if (next == at_.size() || (k + 1 < n && !(at_[next] < knots[k + order]))) return false;
    ++next;
  }
  return true;
}

/// How far each coefficient can swing at most when the data swing between -1 and 1. The matrix of
/// least squares is totally positive, so its inverse has signs like a chess board and the worst
/// right side alternates: one solution gives the norm exactly.
std::vector<double> SplineLine::swings() const {
  Triangle triangle(coefficients(), 0);
  std::vector<double> sums(coefficients(), 0.0);
  std::vector<Vec3> nothing;
  for (const BasisValues& basis : basis_) {
    BandRow row{};
    for (std::size_t k = 0; k <= static_cast<std::size_t>(degree_); ++k) {
      row[k] = basis.value[0][k];
      if (row[k] != 0.0) sums[basis.first + k] += row[k];
    }
    triangle.add(basis.first, row, nothing);
  }
  for (std::size_t k = 1; k < sums.size(); k += 2) sums[k] = -sums[k];
  return triangle.solve_twice(std::move(sums));
}

/// Inserts parameters as knots but those that let coefficients swing too far.
std::size_t SplineLine::insert(const std::vector<double>& added) {
  const std::vector<double> old = knots_;
  std::vector<double> left = added;
  while (!left.empty()) {
    std::vector<double> knots(old.size() + left.size());
    std::merge(old.begin(), old.end(), left.begin(), left.end(), knots.begin());
    set_knots(std::move(knots));
    const std::vector<double> swing = swings();
    const std::size_t before = left.size();
    for (std::size_t k = 0; k < swing.size(); ++k) {
      if (std::abs(swing[k]) <= most_swing_) continue;
      const double from = knots_[k], to = knots_[k + static_cast<std::size_t>(degree_) + 1];
      std::erase_if(left, [&](double t) { return from <= t && t <= to; });
    }
    if (left.size() == before) {
      if (this->swing() <= most_swing_) return left.size();
      left.clear();
    }
  }
  set_knots(old);
  return 0;
}

std::size_t SplineLine::split(const std::vector<double>& errors, double threshold) {
  if (at_.size() <= coefficients()) return 0;
  const auto p = static_cast<std::size_t>(degree_);
  const std::size_t spans = knots_.size() - 2 * p - 1;
  std::vector<double> knots = knots_, added;
  std::size_t begin = 0;
  for (std::size_t span = 0; span < spans; ++span) {
    std::size_t end = begin;
    double worst = 0.0;
    const double to = knots_[p + span + 1];
    while (end < at_.size() && (at_[end] < to || span + 1 == spans)) {
      worst = std::max(worst, errors[end++]);
    }
    const std::size_t count = end - begin;
    if (worst >= threshold && count >= 2) {
      const auto place = static_cast<std::ptrdiff_t>(p + span + 1 + added.size());
      const double middle = at_[begin + count / 2];
      knots.insert(knots.begin() + place, middle);
      if (determined(knots)) {
        added.push_back(middle);
      } else {
        knots.erase(knots.begin() + place);
      }
    }
    begin = end;
  }
  return insert(added);
}

void SplineLine::saturate() {
  if (degree_ < 3) return;
  const auto p = static_cast<std::size_t>(degree_);
  std::vector<double> knots(p + 1, at_.front());
  for (std::size_t i = 2; i + 2 < at_.size(); ++i) knots.push_back(at_[i]);
  knots.insert(knots.end(), p + 1, at_.back());
  set_knots(std::move(knots));
}

double SplineLine::swing() const {
  double worst = 0.0;
  for (const double x : swings()) worst = std::max(worst, std::abs(x));
  return worst;
}

void SplineLine::remove(const std::vector<std::size_t>& inner) {
  std::vector<double> knots;
  std::size_t next = 0;
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    const std::size_t place = static_cast<std::size_t>(degree_) + 1;
    if (next < inner.size() && k == place + inner[next]) {
      ++next;
    } else {
      knots.push_back(knots_[k]);
    }
  }
  set_knots(std::move(knots));
}

std::vector<std::vector<std::size_t>> least_needed(const std::vector<std::vector<double>>& needs,
                                                   std::size_t most) {
  struct Candidate {
    double need;
    std::size_t line, knot;
  };
  std::vector<Candidate> all;
  std::vector<std::vector<char>> taken;  // with a place before the first knot and behind the last
  for (std::size_t line = 0; line < needs.size(); ++line) {
    taken.emplace_back(needs[line].size() + 2, 0);
    for (std::size_t k = 0; k < needs[line].size(); ++k) all.push_back({needs[line][k], line, k});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& a, const Candidate& b) { return a.need < b.need; });
  std::vector<std::vector<std::size_t>> out(needs.size());
  std::size_t count = 0;
  for (const Candidate& c : all) {
    std::vector<char>& marks = taken[c.line];
    if (count == most || marks[c.knot] || marks[c.knot + 2]) continue;
    marks[c.knot + 1] = 1;
    out[c.line].push_back(c.knot);
    ++count;
  }
  for (std::vector<std::size_t>& knots : out) std::sort(knots.begin(), knots.end());
  return out;
}

}  // namespace obvid
